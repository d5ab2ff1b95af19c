// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/judge/judge.h"

namespace porttool {

/// Files of one side that files of the other include: what stands in them is the text of both, and has no port.
///
///     src/scan-cuda/reference.h      float reference(...) {...}
///     src/scan-sycl/main.cpp         #include "reference.h"          where src/scan-sycl/ has no such file
class SharedFiles {
public:
    /// `facts` must outlive it.
    explicit SharedFiles(const Case& facts) : facts_(facts) {}

    /// True if a file of that side includes one of the other side.
    bool includes(Side side, std::string_view path, std::string_view there);

    /// True if a file of that side includes one of the other side, and its own side has no file that it may mean.
    bool surely_includes(Side side, std::string_view path, std::string_view there);

    /// True if any file in the folder of a file of that side does, which need not be there any more. The header beside
    /// one of the other side that has its name stands for it where that side calls what is in it and has it nowhere.
    bool folder_includes(Side side, std::string_view path, std::string_view there);

private:
    /// What files include that they do not have beside them, by a file or folder and the last part of the name.
    using Includes = std::map<std::string, std::vector<std::string>, std::less<>>;
    struct Foreign {
        Includes by_file;    ///< the last part as it is
        Includes by_folder;  ///< ... without its suffix
    };

    const Foreign& foreign_includes(Side side);
    bool is_called_by(Side side, std::string_view there);

    const Case& facts_;
    BySide<std::optional<Foreign>> foreign_;          ///< filled when first asked
    BySide<std::set<std::string, std::less<>>> own_;  ///< the last parts of the side's paths, with that
    /// The other side's files with units that a side names and has not itself; filled when first asked.
    BySide<std::optional<std::set<std::string_view>>> called_;
};

}  // namespace porttool
