// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The first steps in docs/porttool.md are run as they stand there, with the real program; and what the page of the
// architecture names is there.
#include <sys/wait.h>

#include <cstdlib>
#include <regex>

#include "tests/porttool/fixtures.h"

namespace porttool::testing::docs_test {
namespace {

std::string page() { return read_text(std::filesystem::path(REPOSITORY) / "docs/porttool.md"); }

/// The first block of a language behind a mark.
std::string block_behind(const std::string& text, const std::string& mark, const std::string& language) {
    const size_t first = text.find('\n', text.find("```" + language + "\n", text.find(mark))) + 1;
    return text.substr(first, text.find("```", first) - first);
}

std::vector<std::string> tested_lines() {
    std::istringstream block(block_behind(page(), "<!-- tested: first steps -->", "sh"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(block, line);) lines.push_back(line);
    return lines;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
}

TEST(Docs, TheFirstStepsWorkAsWritten) {
    const auto home = std::filesystem::temp_directory_path() / "porttool_docs_test";
    std::filesystem::remove_all(home);
    write_text(home / "my-repository/cuda/shade.cu", block_behind(page(), "`cuda/shade.cu`, the source:", "cuda"));
    write_text(home / "my-repository/glsl/shade.glsl", block_behind(page(), "`glsl/shade.glsl`, its port:", "glsl"));
    std::filesystem::path folder = home;
    const auto lines = tested_lines();
    ASSERT_EQ(lines.size(), 10u);
    for (const std::string& line : lines) {
        if (line.starts_with("cd ")) {
            folder /= line.substr(3);
            continue;
        }
        const size_t exits = line.find("# exits ");
        const int expected = exits == std::string::npos ? 0 : line[exits + 8] - '0';
        const std::string command =
            "( cd '" + folder.string() + "' && PATH='" + program_folder() + "':$PATH && " + line + "\n) > /dev/null";
        const int status = std::system(command.c_str());
        ASSERT_TRUE(WIFEXITED(status));
        EXPECT_EQ(WEXITSTATUS(status), expected) << line;
    }
    std::filesystem::remove_all(home);
}

/// `a/{b,c}.h` as `a/b.h` and `a/c.h`.
std::vector<std::string> without_braces(const std::string& path) {
    const size_t open = path.find('{'), close = path.find('}');
    if (open == std::string::npos || close < open) return {path};
    std::vector<std::string> out;
    std::istringstream choices(path.substr(open + 1, close - open - 1));
    for (std::string choice; std::getline(choices, choice, ',');)
        for (std::string& whole : without_braces(path.substr(0, open) + choice + path.substr(close + 1)))
            out.push_back(std::move(whole));
    return out;
}

/// Whether some file beneath the root has a path; `*`, NAME and SUFFIX in its last part stand for anything.
bool is_there(const std::string& path) {
    const auto whole = std::filesystem::path(REPOSITORY) / path;
    if (std::filesystem::exists(whole)) return true;
    const std::string name = std::regex_replace(std::regex_replace(whole.filename().string(), std::regex("[.]"), "[.]"),
                                                std::regex("[*]|NAME|SUFFIX"), ".+");
    if (name.find(".+") == std::string::npos || !std::filesystem::is_directory(whole.parent_path())) return false;
    for (const auto& entry : std::filesystem::directory_iterator(whole.parent_path()))
        if (std::regex_match(entry.path().filename().string(), std::regex(name))) return true;
    return false;
}

TEST(Docs, EachPathOfOneMoreOfAKindIsThere) {
    const std::string text = read_text(std::filesystem::path(REPOSITORY) / "docs/architecture.md");
    const size_t first = text.find("\n| ", text.find("### One more of a kind"));
    ASSERT_NE(first, std::string::npos);
    const std::string table = text.substr(first, text.find("\n\n", first) - first);
    const std::regex quoted("`([^`]+)`"), of_file(R"([A-Za-z0-9_.,{}*/-]+(/|[.]([a-z{},]+|[*]|SUFFIX[.a-z]*)))");
    size_t found = 0;
    for (std::sregex_iterator at(table.begin(), table.end(), quoted), end; at != end; ++at) {
        const std::string said = (*at)[1];
        if (!std::regex_match(said, of_file) && said.find('/') == std::string::npos) continue;
        if (said == "CMakeLists.txt") continue;  // of the folders named before it
        for (const std::string& path : without_braces(said)) {
            EXPECT_TRUE(is_there(path)) << path << ": no path from the root";
            ++found;
        }
    }
    EXPECT_GT(found, 100u);
    EXPECT_FALSE(is_there("porttool/judge/unwatched_.cpp"));
    EXPECT_FALSE(is_there("porttool/no_room/NAME_command.cpp"));
    EXPECT_FALSE(is_there("unwatched.cpp"));
}

}  // namespace
}  // namespace porttool::testing::docs_test
