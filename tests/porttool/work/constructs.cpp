// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/porttool/work/constructs.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

namespace porttool::testing {
namespace {

std::string filled(const std::string& pattern, size_t number, bool edited) {
    std::string out;
    for (size_t at = 0; at < pattern.size(); ++at) {
        const bool is_number = pattern.compare(at, 3, "{i}") == 0, is_edit = pattern.compare(at, 3, "{e}") == 0;
        if (!is_number && !is_edit) {
            out += pattern[at];
            continue;
        }
        out += is_number ? std::to_string(number) : edited ? "2" : "1";
        at += 2;
    }
    return out;
}

}  // namespace

std::string Construct::text(size_t repetitions, EditOf edit) const {
    const bool other = edit != EditOf::None, turned = edit == EditOf::Order;
    std::string opening, closing;
    for (size_t k = 0; k < repetitions; ++k) {
        const bool edited = edit == EditOf::All || (edit == EditOf::One && k == repetitions / 2);
        opening += filled(open, turned ? repetitions - 1 - k : k, edited);
        closing += filled(close, turned ? k : repetitions - 1 - k, edited);
    }
    return filled(before, 0, other) + opening + filled(middle, 0, other) + closing + filled(after, 0, other);
}

size_t Construct::repetitions(size_t bytes) const {
    const size_t one = filled(open, 1234, false).size() + filled(close, 1234, false).size();
    return std::max<size_t>(1, bytes / std::max<size_t>(1, one));
}

std::vector<Construct> read_constructs(const std::string& path) {
    std::ifstream file(path);
    std::vector<Construct> out;
    for (const auto& entry : nlohmann::json::parse(file))
        out.push_back({entry["name"], entry["before"], entry["open"], entry["middle"], entry["close"], entry["after"]});
    return out;
}

}  // namespace porttool::testing
