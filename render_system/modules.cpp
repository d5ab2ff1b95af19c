// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/modules.h"

#include <dlfcn.h>

namespace render_system {

std::vector<std::filesystem::path> module_folders() {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path above = program.parent_path().parent_path();
    return {above / PATHTRACER_MODULES, above.parent_path() / PATHTRACER_MODULES};
}

Result<std::filesystem::path> find_module(const std::string& name) {
    const auto folders = module_folders();
    for (const auto& folder : folders) {
        std::error_code error;
        if (std::filesystem::exists(folder / name, error)) return folder / name;
    }
    return Status::error(StatusCode::not_found,
                         "there is no " + (folders[0] / name).string() + "; install the program anew");
}

Result<void*> load_module(const std::filesystem::path& file, const char* symbol) {
    void* module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    void* address = module == nullptr ? nullptr : dlsym(module, symbol);
    if (address != nullptr) return address;
    const char* said = dlerror();
    return Status::error(StatusCode::not_found, file.string() + " cannot be loaded (" +
                                                    (said == nullptr ? "it has no entry" : said) +
                                                    "); install the program anew");
}

}  // namespace render_system
