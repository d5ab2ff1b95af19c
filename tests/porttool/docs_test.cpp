// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The first steps in docs/porttool.md are run as they stand there, with the real program.
#include <sys/wait.h>

#include <cstdlib>

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

}  // namespace
}  // namespace porttool::testing::docs_test
