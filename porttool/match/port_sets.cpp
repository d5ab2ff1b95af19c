// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/port_sets.h"

#include <algorithm>

#include "porttool/match/port_folders.h"
#include "porttool/read/glob.h"

namespace porttool {
namespace {

constexpr uint32_t kSeveral = 0xFFFFFFFFu;

/// The port of each file, or kSeveral.
std::vector<uint32_t> port_of_files(const std::vector<PortFiles>& ports, size_t files) {
    std::vector<uint32_t> port_of(files, kSeveral);
    std::vector<uint32_t> ports_with(files, 0);
    for (uint32_t port = 0; port < ports.size(); ++port)
        for (const uint32_t file : ports[port].files) port_of[file] = ports_with[file]++ == 0 ? port : kSeveral;
    return port_of;
}

/// The folder that holds all of a port's files, with the slash behind it.
std::string folder_of_port(const PortFiles& port, const std::vector<ScannedFile>& target) {
    std::string_view common = target[port.files.front()].path;
    for (const uint32_t file : port.files) {
        const std::string& path = target[file].path;
        const auto parted = std::mismatch(common.begin(), common.end(), path.begin(), path.end()).first;
        common = common.substr(0, static_cast<size_t>(parted - common.begin()));
    }
    return std::string(common.substr(0, common.rfind('/') + 1));
}

/// `src/**/*.cpp` within `src/omp/`: `src/omp/**/*.cpp`. Empty for other globs.
std::string narrowed(const std::string& glob, const std::string& folder) {
    constexpr std::string_view kWild = "*?[]{}\\";
    const size_t stars = glob.find("**");
    if (stars == std::string::npos || folder.find_first_of(kWild) != std::string::npos) return {};
    const std::string_view before = std::string_view(glob).substr(0, stars);
    if (before.find_first_of(kWild) != std::string_view::npos || !folder.starts_with(before)) return {};
    return folder + glob.substr(stars);
}

/// The globs of the list that are a port's own, or narrowed to it.
std::vector<std::string> globs_of_port(uint32_t port, const std::string& folder, const std::vector<uint32_t>& port_of,
                                       const std::vector<ScannedFile>& target, const std::vector<std::string>& globs) {
    std::vector<std::string> out;
    for (const std::string& text : globs) {
        const Glob glob(text);
        bool own = false, others = false;
        for (size_t file = 0; file < target.size(); ++file)
            if (glob.matches(target[file].path)) (port_of[file] == port ? own : others) = true;
        if (own) out.push_back(others ? narrowed(text, folder) : text);
    }
    return out;
}

bool match_exactly(const std::vector<std::string>& globs, uint32_t port, const std::vector<uint32_t>& port_of,
                   const std::vector<ScannedFile>& target) {
    std::vector<Glob> all;
    for (const std::string& text : globs) {
        if (text.empty()) return false;
        all.emplace_back(text);
    }
    for (size_t file = 0; file < target.size(); ++file) {
        const bool matched =
            std::any_of(all.begin(), all.end(), [&](const Glob& glob) { return glob.matches(target[file].path); });
        if (matched != (port_of[file] == port)) return false;
    }
    return true;
}

}  // namespace

std::vector<TargetSet> port_sets(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target,
                                 const std::vector<std::string>& globs) {
    const std::vector<PortFiles> ports = find_ports(source, target);
    const std::vector<uint32_t> port_of = port_of_files(ports, target.size());
    if (ports.empty() || std::find(port_of.begin(), port_of.end(), kSeveral) != port_of.end()) return {};
    std::vector<TargetSet> out;
    for (uint32_t port = 0; port < ports.size(); ++port) {
        TargetSet set{ports[port].name,
                      globs_of_port(port, folder_of_port(ports[port], target), port_of, target, globs)};
        if (!is_set_name(set.name) || !match_exactly(set.globs, port, port_of, target)) return {};
        out.push_back(std::move(set));
    }
    std::sort(out.begin(), out.end(), [](const TargetSet& a, const TargetSet& b) { return a.name < b.name; });
    return out;
}

}  // namespace porttool
