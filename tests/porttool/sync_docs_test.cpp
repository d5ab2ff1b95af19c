// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The examples in docs/sync.md give what stands there, with the real program.
#include <sys/wait.h>

#include "tests/porttool/temporary_repository.h"

namespace porttool::testing {
namespace {

/// The block of the page behind a mark.
std::string block_of_sync_page(const std::string& mark) {
    const std::string text = read_text(std::filesystem::path(REPOSITORY) / "docs/sync.md");
    const size_t at = text.find("<!-- tested: " + mark + " -->\n```");
    if (at == std::string::npos) throw std::runtime_error("docs/sync.md has no block '" + mark + "'");
    const size_t first = text.find('\n', text.find("```", at)) + 1;
    return text.substr(first, text.find("\n```\n", first) + 1 - first);
}

class SyncDocs : public TemporaryRepository {
protected:
    /// Runs each line of a block; `# exits N` says how it ends, 0 unless it says so.
    void expect_lines(const std::string& mark) const {
        std::istringstream block(block_of_sync_page(mark));
        for (std::string line; std::getline(block, line);) {
            const size_t exits = line.find("# exits ");
            const int expected = exits == std::string::npos ? 0 : line[exits + 8] - '0';
            const std::string command =
                "( cd '" + root.string() + "' && PATH='" + program_folder() + "':$PATH && " + line + "\n) > /dev/null";
            const int status = std::system(command.c_str());
            ASSERT_TRUE(WIFEXITED(status));
            EXPECT_EQ(WEXITSTATUS(status), expected) << line;
        }
    }
};

TEST_F(SyncDocs, OnOurCores) {
    const std::filesystem::path here = REPOSITORY;
    const auto all = std::filesystem::copy_options::recursive;
    for (const char* name : {"source_core", "target_core", "portmap.base", "portmap.toml", "portmap.lock"})
        std::filesystem::copy(here / name, root / name, all);
    commit("cores");
    expect_lines("sync on our cores");
    EXPECT_EQ(read_text(root / "port.patch"), block_of_sync_page("patch on our cores"));
}

TEST_F(SyncDocs, FromCudaToSycl) {
    for (const char* name : {"cuda/sharpen.cu", "sycl/sharpen.cpp"}) write(name, block_of_sync_page(name));
    ASSERT_EQ(porttool({"init", "--source", "cuda/**", "--target", "sycl/**"}).exit_code, 0);
    commit("one");
    expect_lines("edit of cuda/sharpen.cu");
    const CommandRun got = porttool({"sync", "--format", "patch"});
    EXPECT_EQ(got.exit_code, 0);
    EXPECT_EQ(got.out, block_of_sync_page("patch of sycl/sharpen.cpp"));
    EXPECT_EQ(porttool({"sync", "--apply"}).exit_code, 0);
    EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0);
    git("checkout -q .");
    expect_lines("left of sycl/sharpen.cpp");
}

}  // namespace
}  // namespace porttool::testing
