// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The example in docs/difftest.md gives what stands there.
#include "porttool/difftest/bounded_process.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing {
namespace {

std::string block_of_difftest_page(const std::string& mark) {
    const std::string text = read_text(std::filesystem::path(REPOSITORY) / "docs/difftest.md");
    const size_t at = text.find("<!-- tested: " + mark + " -->\n```");
    if (at == std::string::npos) throw std::runtime_error("docs/difftest.md has no block '" + mark + "'");
    const size_t first = text.find('\n', text.find("```", at)) + 1;
    return text.substr(first, text.find("\n```\n", first) + 1 - first);
}

class DifftestDocs : public TemporaryRepository {};

TEST_F(DifftestDocs, GiveWhatStandsThere) {
    if (program_path("g++").empty() && program_path("clang++").empty()) GTEST_SKIP() << "no compiler is installed";
    for (const char* name : {"gpu/weight.glsl", "cpu/weight.h"}) write(name, block_of_difftest_page(name));
    const CommandRun got = porttool({"difftest", "--source", "gpu/*", "--target", "cpu/*"});
    EXPECT_EQ(got.exit_code, 1) << got.err;
    EXPECT_EQ("$ porttool difftest --source 'gpu/*' --target 'cpu/*'\n" + got.out, block_of_difftest_page("run"));
}

}  // namespace
}  // namespace porttool::testing
