// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/device/kernel_files.h"

#include <filesystem>
#include <utility>
#include <vector>

#include "render_system/input_file.h"

namespace source_core {

namespace {

// Ours have at most some thousand bytes.
constexpr uint64_t LARGEST_KERNEL = uint64_t{1} << 24;

}  // namespace

Result<std::map<std::string, std::string>> read_kernel_files(const std::string& directory) {
    std::map<std::string, std::string> files;
    for (unsigned i = 0; i < EMBEDDED_KERNEL_COUNT; ++i) {
        files.emplace(EMBEDDED_KERNELS[i].name, EMBEDDED_KERNELS[i].text);
    }
    if (directory.empty()) {
        return files;
    }
    std::error_code error;
    if (!std::filesystem::is_directory(directory, error)) {
        return Status::error(StatusCode::not_found, directory + ": the folder of kernels does not exist");
    }
    for (auto& [name, text] : files) {
        Result<std::string> read =
            render_system::read_input_file(std::filesystem::path(directory) / name, LARGEST_KERNEL);
        if (!read.ok()) {
            read.status.message += "; this kernel is needed in the folder of kernels";
            return read.status;
        }
        text = std::move(*read);
    }
    for (const auto& entry : std::filesystem::directory_iterator(directory, error)) {
        const std::string name = entry.path().filename().string();
        if (!entry.is_regular_file(error) || files.contains(name)) {
            continue;  // a file that somebody added beside ours may be included too
        }
        Result<std::string> read = render_system::read_input_file(entry.path(), LARGEST_KERNEL);
        if (read.ok()) {
            files.emplace(name, std::move(*read));
        }
    }
    return files;
}

std::map<std::string, std::string> texts_of_kernel(const std::map<std::string, std::string>& files, Kernel kernel) {
    std::map<std::string, std::string> texts;
    std::vector<std::string> reached{std::string(kernel_name(kernel)) + ".comp"};
    const std::string include = "#include \"";
    while (!reached.empty()) {
        const auto file = files.find(reached.back());
        reached.pop_back();
        if (file == files.end() || !texts.insert(*file).second) {
            continue;
        }
        const std::string& text = file->second;
        for (size_t at = text.find(include); at != std::string::npos; at = text.find(include, at + 1)) {
            const size_t name = at + include.size();
            reached.push_back(text.substr(name, text.find('"', name) - name));
        }
    }
    return texts;
}

}  // namespace source_core
