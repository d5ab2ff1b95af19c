// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/application/run_pathtracer.h"

/// Why `core` cannot run here, as `pathtracer info` tells it; empty if it can.
inline std::string reason_against(const std::string& core) {
    const RunResult result = run_pathtracer({"info", "--format", "json"}, ".");
    const auto info = nlohmann::json::parse(result.out, nullptr, false);
    if (!info.is_object()) return "pathtracer info failed: " + result.err;
    for (const auto& entry : info["cores"]) {
        if (entry["id"] == core) return entry["available"].get<bool>() ? "" : entry["reason"].get<std::string>();
    }
    return "pathtracer info does not list it";
}

#define SKIP_WITHOUT(core) \
    if (const std::string reason = reason_against(core); !reason.empty()) GTEST_SKIP() << core << ": " << reason
