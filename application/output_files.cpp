// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/output_files.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <map>
#include <utility>

namespace application {
namespace {

using FileIdentity = std::pair<dev_t, ino_t>;

/// False where there is no such file.
bool identify(const std::filesystem::path& file, FileIdentity& identity) {
    struct stat info {};
    if (file.empty() || stat(file.c_str(), &info) != 0) return false;
    identity = {info.st_dev, info.st_ino};
    return true;
}

}  // namespace

render_system::Status check_outputs(const std::vector<OutputFile>& outputs, const std::vector<InputFile>& inputs) {
    std::map<FileIdentity, std::string> readers;
    FileIdentity identity;
    for (const InputFile& input : inputs)
        if (identify(input.file, identity)) readers.emplace(identity, input.reader);
    for (const OutputFile& output : outputs) {
        if (!identify(output.file, identity)) continue;
        if (const auto found = readers.find(identity); found != readers.end())
            return render_system::Status::invalid(fmt::format("{} {}: {} reads this file; give another name",
                                                              output.option, output.file.string(), found->second));
    }
    return render_system::Status::success();
}

}  // namespace application
