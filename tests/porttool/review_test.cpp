// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The guided walk: what it asks, and, on a pseudo-terminal with the real program, what each answer writes.
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::review_test {
namespace {

const std::string kGain = "__device__ float gain(float a, float b) {\n    float c = a * b;\n    return c + 1.0f;\n}\n";
const std::string kGainPort = "float gain(float a, float b) {\n    float c = a * b;\n    return c + 2.0;\n}\n";
const std::string kMixer =
    "__device__ unsigned mixer(unsigned s) {\n    s ^= s >> 16;\n    s *= 0x7feb352du;\n    return s ^ (s >> 15);\n}\n";
const std::string kMixerPort =
    "uint mixer(uint s) {\n    s ^= s >> 16;\n    s *= 0x7feb352du;\n    return s ^ (s >> 15);\n}\n";
const std::string kAlone = "__global__ void alone(int* out) {\n    atomicAdd(out, threadIdx.x);\n}\n";
const std::string kOdd = "float odd_one(float t) {\n    return sin(t) * 0.5 + exp(t);\n}\n";

/// A pair that differs, and three sources that nothing watches; one of them has its port.
class Review : public TemporaryRepository {
protected:
    void SetUp() override {
        TemporaryRepository::SetUp();
        write("src/k.cu", kGain + kMixer + kAlone);
        write("port/k.comp", kGainPort + kMixerPort + kOdd);
        write("portmap.toml",
              "# by hand\nversion = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n\n[[pair]]\nsource = "
              "\"src/k.cu:gain\"\ntarget = \"port/k.comp:odd_one\"\n\n[[ignore]]\nid = \"src/k.cu:nothing\"\nreason = "
              "\"left as it is\"\n[rules]\n\"unused-suppression\" = \"off\"\n");
        EXPECT_EQ(porttool({"init"}).exit_code, 0);
    }

    /// Runs the program on a terminal of its own, types the answers, one line each, and returns what it showed.
    std::string typed(const std::string& answers) {
        int terminal = -1;
        winsize size{};
        size.ws_col = 100;
        size.ws_row = 50;
        const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
        if (child == 0) {
            const std::string program = program_folder() + "/porttool";
            execl(program.c_str(), "porttool", "-C", root.c_str(), "review", static_cast<char*>(nullptr));
            _exit(127);
        }
        EXPECT_EQ(::write(terminal, answers.data(), answers.size()), static_cast<ssize_t>(answers.size()));
        std::string shown;
        char buffer[4096];
        for (ssize_t count = 0; (count = ::read(terminal, buffer, sizeof buffer)) > 0;)
            shown.append(buffer, static_cast<size_t>(count));
        close(terminal);
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << shown;
        return shown;
    }

    nlohmann::json items() { return this->json({"review"})["items"]; }
    std::string map() const { return read_text(root / "portmap.toml"); }
};

TEST_F(Review, ListsTheSameForEditors) {
    const auto found = items();
    ASSERT_EQ(found.size(), 3u) << found.dump(1);
    EXPECT_EQ(found[0]["kind"], "doubtful");
    EXPECT_EQ(found[0]["source"], "src/k.cu:gain");
    EXPECT_EQ(found[0]["target"], "port/k.comp:odd_one");
    EXPECT_LT(found[0]["score"], 0.5);
    EXPECT_EQ(found[0]["candidates"][0]["target"], "port/k.comp:gain");
    EXPECT_EQ(found[1]["kind"], "unwatched");
    EXPECT_EQ(found[1]["source"], "src/k.cu:alone") << "kernels first";
    EXPECT_TRUE(found[1]["target"].is_null());
    EXPECT_TRUE(found[1]["candidates"].empty());
    EXPECT_EQ(found[2]["source"], "src/k.cu:mixer");
    EXPECT_EQ(found[2]["candidates"][0]["target"], "port/k.comp:mixer");
    EXPECT_GT(found[2]["candidates"][0]["score"], 0.5);
}

TEST_F(Review, ShowsBothTextsAndWritesEachAnswerAtOnce) {
    const std::string shown = typed("p\n1\ny\nn\ny\n");
    EXPECT_NE(shown.find("[1/3] a pair that nobody has verified"), std::string::npos) << shown;
    EXPECT_NE(shown.find("return c + 1.0f;"), std::string::npos);
    EXPECT_NE(shown.find(" |     return c + 2.0;"), std::string::npos) << "side by side";
    EXPECT_NE(shown.find("2 pairs taken, 1 rejected, 1 units without counterpart, 0 skipped; 0 left to look at"),
              std::string::npos)
        << shown;
    EXPECT_TRUE(map().starts_with("# by hand\nversion = 1\n")) << "what a person wrote stays";
    EXPECT_NE(map().find("left as it is"), std::string::npos);
    EXPECT_EQ(map().find("odd_one"), std::string::npos);
    for (const char* pair : {"source = \"src/k.cu:gain\"\ntarget = \"port/k.comp:gain\"\n",
                             "source = \"src/k.cu:mixer\"\ntarget = \"port/k.comp:mixer\"\n"})
        EXPECT_NE(map().find(pair), std::string::npos) << map();
    const auto report = this->json({"check"});
    EXPECT_EQ(report["summary"]["verified"], 2);
    EXPECT_EQ(report["summary"]["unpaired"], 0);
    EXPECT_TRUE(report["findings"].empty()) << report.dump(1);
    EXPECT_TRUE(items().empty());
    EXPECT_NE(porttool({"review"}).out.find("nothing to look at"), std::string::npos);
}

TEST_F(Review, ALongLineGoesOnInTheNextRow) {
    std::string sum = "t";
    for (int i = 0; i < 40; ++i) sum += " + part_" + std::to_string(i) + "(t)";
    write("src/long.cu", "__device__ float long_sum(float t) { return " + sum + "; }\n");
    const std::string shown = typed("s\ns\ns\ns\n");
    std::string left;  // the rows of the left column, joined
    for (size_t at = 0, end = 0; (end = shown.find(" | ", at)) != std::string::npos; at = shown.find('\n', end) + 1) {
        std::string row = shown.substr(shown.rfind('\n', end) + 1, end - shown.rfind('\n', end) - 1);
        row.erase(row.find_last_not_of(' ') + 1);
        left += row.starts_with("> ") ? row.substr(2) : row;
    }
    std::erase(left, ' ');
    std::erase(sum, ' ');
    EXPECT_NE(left.find(sum), std::string::npos) << shown;
}

TEST_F(Review, GoesOnWhereItWasLeft) {
    const std::string first = typed("what?\ns\nn\nq\n");
    EXPECT_NE(first.find("Please answer with one of these letters."), std::string::npos);
    EXPECT_NE(first.find("0 pairs taken, 0 rejected, 1 units without counterpart, 1 skipped; 2 left to look at"),
              std::string::npos)
        << first;
    ASSERT_EQ(items().size(), 2u);
    const std::string second = typed("n\nmixer\ny\n");
    EXPECT_NE(second.find("[1/2]"), std::string::npos);
    ASSERT_EQ(items().size(), 1u) << "what was rejected is unwatched now, and has a candidate";
    EXPECT_EQ(items()[0]["source"], "src/k.cu:gain");
    EXPECT_EQ(items()[0]["kind"], "unwatched");
    EXPECT_EQ(items()[0]["candidates"][0]["target"], "port/k.comp:gain");
    EXPECT_EQ(porttool({"check"}).exit_code, 0) << "a rejected pair raises nothing";
}

TEST_F(Review, PicksByAPartOfAnId) {
    const std::string shown = typed("p\nno such\nk.comp:ga\n1\ny\nq\n");
    EXPECT_NE(shown.find("No id has that in it."), std::string::npos) << shown;
    EXPECT_NE(map().find("source = \"src/k.cu:gain\"\ntarget = \"port/k.comp:gain\"\n"), std::string::npos) << shown;
}

TEST_F(Review, WithoutATerminalItSaysWhatToDo) {
    const std::string command =
        "'" + program_folder() + "/porttool' -C '" + root.string() + "' review < /dev/null > /dev/null 2>&1";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2);
}

}  // namespace
}  // namespace porttool::testing::review_test
