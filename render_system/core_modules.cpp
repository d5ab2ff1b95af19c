// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/core_modules.h"

#include <cstring>
#include <set>

#include "render_system/core_interface.h"

namespace render_system {

namespace {

constexpr std::string_view kBefore = "pathtracer-core-", kBehind = ".so";

/// Empty where the file is called otherwise, or by a name that --core does not take or a terminal might obey.
std::string id_of(const std::string& name) {
    if (name.size() <= kBefore.size() + kBehind.size() || !name.starts_with(kBefore) || !name.ends_with(kBehind))
        return "";
    std::string id = name.substr(kBefore.size(), name.size() - kBefore.size() - kBehind.size());
    const bool is_plain = id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") == std::string::npos;
    return is_plain && id != "auto" && id != "null" ? id : "";
}

Status no_core(const std::string& why) { return Status::error(StatusCode::no_core, why); }

Status core_refused(const std::filesystem::path& file, const std::string& why) {
    return no_core(file.string() + " " + why + "; build or install it anew, or remove it");
}

}  // namespace

std::string core_module_name(const std::string& id) { return std::string(kBefore) + id + std::string(kBehind); }

std::vector<std::string> core_module_ids() {
    std::set<std::string> ids;
    for (const std::filesystem::path& folder : module_folders()) {
        std::error_code error;
        for (const auto& entry : std::filesystem::directory_iterator(folder, error))
            if (std::string id = id_of(entry.path().filename().string()); !id.empty()) ids.insert(std::move(id));
    }
    return {ids.begin(), ids.end()};
}

Result<std::filesystem::path> find_core_module(const std::string& id) {
    auto file = find_module(core_module_name(id));
    return file.ok() ? file : no_core(file.status.message);
}

Result<const CoreModule*> load_core_module(const std::string& id, ModuleSource source) {
    const auto file = find_core_module(id);
    if (!file.ok()) return file.status;
    const auto address = load_module(*file, "pathtracer_core", source);
    if (!address.ok()) return no_core(address.status.message + "; build or install it anew, or remove it");
    const CoreModule* module = reinterpret_cast<decltype(&pathtracer_core)>(*address)();
    if (module == nullptr || module->interface == nullptr) return core_refused(*file, "tells nothing of its core");
    if (std::strcmp(module->interface, core_interface()) != 0)
        return core_refused(*file, "is of another version (its interface is \"" + std::string(module->interface) +
                                       "\", that of this program \"" + core_interface() + "\")");
    if (module->id != id) return core_refused(*file, "calls its core \"" + std::string(module->id) + "\"");
    return module;
}

}  // namespace render_system
