// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "porttool/command/run.h"

namespace porttool::testing {

struct CommandRun {
    int exit_code;
    std::string out, err;
};

/// Runs a command line on a disk in memory.
inline CommandRun run(Disk& disk, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "porttool");
    std::vector<const char*> pointers;
    for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
    std::ostringstream out, err;
    const int code = run_porttool(static_cast<int>(pointers.size()), pointers.data(), disk, out, err);
    return {code, out.str(), err.str()};
}

/// A repository at /r with two sides, mapped and recorded.
inline MemoryDisk started(const std::string& source, const std::string& target) {
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", source}, {"/r/port/k.comp", target}};
    run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"});
    return disk;
}

inline nlohmann::json check(Disk& disk) {
    return nlohmann::json::parse(run(disk, {"-C", "/r", "check", "--format", "json"}).out);
}

using Rules = std::vector<std::string>;

/// The rules of the findings of a report of `check`.
inline Rules rules(const nlohmann::json& report) {
    Rules out;
    for (const auto& finding : report["findings"]) out.push_back(finding["rule"]);
    return out;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error("'" + from + "' is not in the text");
    return text.replace(at, from.size(), to);
}

}  // namespace porttool::testing
