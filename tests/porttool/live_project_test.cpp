// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// A project that is looked at again and again says what `check` says, and scans only what changed.
#include "porttool/live/live_project.h"

#include <random>

#include "porttool/report/check_report.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing {
namespace live_project_test {
namespace {

class LiveProjectTest : public TemporaryRepository {};

std::string kernels(int file, int number, const std::string& line_end = "\n") {
    std::string out;
    for (int i = 0; i < 3; ++i)
        out += "float f" + std::to_string(file) + std::to_string(i) + "(float a) {" + line_end + "    return a * " +
               std::to_string(i == 0 ? number : i) + ".5f;" + line_end + "}" + line_end;
    return out;
}

/// What a check from the beginning says of the project as it stands.
std::string checked_afresh(const CheckChoice& choice, Disk& disk) {
    std::ostringstream err;
    Workplace place{disk, err};
    try {
        return check_json(check_project(choice, place).judgement);
    } catch (const CannotDo& problem) {
        return problem.what();
    }
}

std::string looked_at(LiveProject& project) {
    try {
        return check_json(project.look().judgement);
    } catch (const CannotDo& problem) {
        return problem.what();
    }
}

TEST_F(LiveProjectTest, SaysWhatCheckSaysAfterAnyEdits) {
    for (int file = 0; file < 4; ++file) {
        write("src/k" + std::to_string(file) + ".cu", kernels(file, 1));
        write("port/k" + std::to_string(file) + ".h", kernels(file, 1));
    }
    ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    const std::string map = read_text(root / "portmap.toml");
    CheckChoice choice;
    choice.directory = root.string();
    LiveProject project(choice, disk);
    std::mt19937 random(20);
    std::set<std::string> seen;
    for (int round = 0; round < 120 / kLighter; ++round) {
        const std::string name = std::to_string(random() % 4);
        const std::string path = random() % 2 == 0 ? "src/k" + name + ".cu" : "port/k" + name + ".h";
        const std::string text = kernels(std::stoi(name), static_cast<int>(random() % 3), random() % 4 ? "\n" : "\r\n");
        switch (random() % 8) {
            case 0:
                std::filesystem::remove(root / path);
                break;
            case 1:  // as editors that save by renaming do
                write("saved", text);
                std::filesystem::rename(root / "saved", root / path);
                break;
            case 2:
                write("portmap.toml", random() % 2 ? map : map + "\n[rules]\n\"source-changed\" = \"note\"\n");
                break;
            case 3:
                write("portmap.toml", random() % 2 ? map : "version = 1\n[sides\n");
                break;
            case 4:
                porttool({"accept", "--all"});
                break;
            default:
                write(path, text);
        }
        const std::string said = looked_at(project);
        ASSERT_EQ(said, checked_afresh(choice, disk)) << "round " << round;
        seen.insert(said);
    }
    EXPECT_GT(seen.size(), static_cast<size_t>(20 / kLighter));
}

TEST_F(LiveProjectTest, ScansOnlyWhatChangedAndHonoursWhatIsNotSaved) {
    write("src/a.cu", kernels(0, 1));
    write("src/b.cu", kernels(1, 1, "\r\n"));
    write("port/a.h", kernels(0, 1));
    write("port/b.h", kernels(1, 1));
    ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    CheckChoice choice;
    choice.directory = root.string();
    LiveProject project(choice, disk);
    const auto tokens = [&] {
        const Project& now = project.look().project;
        return std::vector<const Token*>{now.source.at(0).lexed.tokens.data(), now.source.at(1).lexed.tokens.data(),
                                         now.target.at(0).lexed.tokens.data(), now.target.at(1).lexed.tokens.data()};
    };
    const auto before = tokens();
    EXPECT_EQ(tokens(), before);
    project.disk().show((root / "src/a.cu").string(), kernels(0, 2));
    const auto typed = tokens();
    EXPECT_NE(typed[0], before[0]);
    EXPECT_EQ(std::vector(typed.begin() + 1, typed.end()), std::vector(before.begin() + 1, before.end()));
    EXPECT_EQ(project.last().judgement.summary.drifted, 1u);
    project.disk().show_saved((root / "src/a.cu").string());
    EXPECT_EQ(project.look().judgement.summary.drifted, 0u);
    // What leads out of the tree is not read, whatever an editor shows in its place.
    std::filesystem::remove(root / "src/a.cu");
    std::filesystem::create_symlink("/etc/hostname", root / "src/a.cu");
    project.disk().show((root / "src/a.cu").string(), kernels(0, 1));
    EXPECT_EQ(project.look().project.skipped.size(), 1u);
}

}  // namespace
}  // namespace live_project_test
}  // namespace porttool::testing
