// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// universal-ctags as an oracle: what it sees as a function is one of ours, at the same lines, but for its known errors.
#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/porttool/fixtures.h"

namespace porttool::testing::ctags_test {
namespace {

std::string output_of(const std::string& command) {
    std::string out;
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::array<char, 4096> buffer{};
    while (pipe && fgets(buffer.data(), buffer.size(), pipe.get()) != nullptr) out += buffer.data();
    return out;
}

std::string last_part(const std::string& name) {
    std::string part = name.substr(0, name.find('#'));
    const size_t colons = part.rfind("::");
    if (colons != std::string::npos) part = part.substr(colons + 2);
    std::erase(part, ' ');
    return part;
}

/// Functions that ctags reports wrongly in our fixtures: macros, attributes, lambdas, local structs, layout blocks,
/// code in raw strings' neighbourhood, and names that a macro builds.
bool ctags_is_wrong(const std::string& name) {
    static const std::set<std::string> kWrong = {"__launch_bounds__",
                                                 "layout",
                                                 "DEFINE_FILL",
                                                 "DEFINE_WHOLE",
                                                 "PREFIX",
                                                 "KERNEL_NAME",
                                                 "y",
                                                 "second",
                                                 "third",
                                                 "reqd_sub_group_size",
                                                 "attribute",
                                                 "__attribute__",
                                                 "BEGIN_MODULE",
                                                 "buffer",
                                                 "stage_in",
                                                 "fourth",
                                                 "register"};
    return kWrong.contains(name) || name.starts_with("__anon");
}

TEST(Ctags, SeesNoFunctionThatWeMiss) {
    if (output_of("ctags --version 2>/dev/null").find("Universal Ctags") == std::string::npos)
        GTEST_SKIP() << "universal-ctags is not installed";
    size_t compared = 0;
    for (const auto& path : fixture_files()) {
        if (path.filename() == "broken.cpp") continue;  // ctags loses its way there
        const ScannedFile file = scan_text(path.string(), read_text(path));
        const std::string tags =
            output_of("ctags --language-force=C++ --kinds-C++=f --fields=+ne --output-format=json -o - '" +
                      path.string() + "' 2>/dev/null");
        std::istringstream lines(tags);
        for (std::string line; std::getline(lines, line);) {
            const auto tag = nlohmann::json::parse(line);
            const std::string name = last_part(tag["name"]);
            if (ctags_is_wrong(name)) continue;
            const auto at = tag["line"].get<uint32_t>();
            const auto unit = std::find_if(file.units.begin(), file.units.end(), [&](const Unit& u) {
                return u.kind != UnitKind::Struct && last_part(u.name) == name && u.start_line <= at &&
                       at <= u.end_line;
            });
            ASSERT_NE(unit, file.units.end()) << path.filename() << ":" << at << " " << name;
            if (tag.contains("end")) {
                EXPECT_EQ(unit->end_line, tag["end"].get<uint32_t>()) << path.filename() << " " << name;
            }
            ++compared;
        }
    }
    EXPECT_GT(compared, 40u);
}

}  // namespace
}  // namespace porttool::testing::ctags_test
