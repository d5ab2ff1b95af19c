// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The set-ups in docs/ci.md and the hooks: valid YAML, with commands that this porttool understands.
#include <sys/wait.h>

#include <cstdlib>

#include "porttool/command/options.h"
#include "tests/porttool/fixtures.h"

namespace porttool::testing::ci_docs_test {
namespace {

std::vector<std::string> yaml_texts() {
    const std::filesystem::path root = REPOSITORY;
    std::vector<std::string> texts = {read_text(root / ".pre-commit-hooks.yaml")};
    const std::string page = read_text(root / "docs/ci.md");
    for (size_t at = page.find("```yaml\n"); at != std::string::npos; at = page.find("```yaml\n", at + 1)) {
        const size_t first = page.find('\n', at) + 1;
        texts.push_back(page.substr(first, page.find("```", first) - first));
    }
    return texts;
}

int exit_code(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(CiDocs, EveryBlockIsValidYaml) {
    if (exit_code("python3 -c 'import yaml' 2> /dev/null") != 0) GTEST_SKIP() << "python3-yaml is not there";
    const auto texts = yaml_texts();
    ASSERT_EQ(texts.size(), 8u);
    const auto folder = std::filesystem::temp_directory_path() / "porttool_ci_docs_test";
    std::filesystem::create_directories(folder);
    std::string files;
    for (size_t i = 0; i < texts.size(); ++i) {
        const auto file = folder / (std::to_string(i) + ".yaml");
        std::ofstream(file) << texts[i];
        files += " '" + file.string() + "'";
    }
    EXPECT_EQ(exit_code("python3 -c 'import sys, yaml; [yaml.safe_load(open(name)) for name in sys.argv[1:]]'" + files),
              0);
    std::filesystem::remove_all(folder);
}

/// What any YAML reader refuses and people write by mistake; needs no Python.
TEST(CiDocs, NoTabsAndEvenIndents) {
    for (const std::string& text : yaml_texts()) {
        EXPECT_EQ(text.find('\t'), std::string::npos);
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            const size_t indent = line.find_first_not_of(' ');
            if (indent == std::string::npos) continue;
            EXPECT_EQ(indent % 2, 0u) << line;
        }
    }
}

TEST(CiDocs, EveryCallIsOneThatPorttoolUnderstands) {
    size_t calls = 0;
    for (const std::string& text : yaml_texts()) {
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            const size_t at = line.find("porttool check");
            if (at == std::string::npos) continue;
            std::istringstream words(line.substr(at));
            std::vector<std::string> arguments;
            for (std::string word; words >> word && word != "||";) arguments.push_back(word);
            std::vector<const char*> pointers;
            for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
            const ParsedOptions parsed = parse_options(static_cast<int>(pointers.size()), pointers.data());
            EXPECT_EQ(parsed.err, "") << line;
            EXPECT_EQ(parsed.options.command, "check") << line;
            ++calls;
        }
    }
    EXPECT_EQ(calls, 8u);
}

}  // namespace
}  // namespace porttool::testing::ci_docs_test
