// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>

#include "porttool/read/cannot_do.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {

/// A folder of its own for one run, gone with it; or one that the user wants to keep.
class TemporaryFolder {
public:
    explicit TemporaryFolder(const std::string& kept) : is_kept_(!kept.empty()) {
        if (is_kept_) {
            std::error_code error;
            std::filesystem::create_directories(kept, error);
            path_ = std::filesystem::absolute(kept).string();
            if (error)
                throw CannotDo("--keep " + terminal_text(kept) + ": no folder can be made there: " + error.message());
            return;
        }
        std::string name = (std::filesystem::temp_directory_path() / "porttool-difftest-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw CannotDo("no temporary folder can be made: " + name);
        path_ = name;
    }
    ~TemporaryFolder() { remove(); }
    void remove() {
        if (is_kept_) return;
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::string& path() const { return path_; }

private:
    bool is_kept_;
    std::string path_;
};

}  // namespace porttool
