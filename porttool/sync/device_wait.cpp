// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/device_wait.h"

#include <algorithm>
#include <set>

#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_text.h"

namespace porttool {
namespace {

/// The queues that a unit declares or is handed: `sycl :: queue q (`, `queue & q ,`.
std::set<std::string> queues_of(const std::vector<std::string>& words) {
    std::set<std::string> out;
    for (size_t i = 0; i + 2 < words.size(); ++i) {
        const size_t name = words[i + 1] == "&" ? i + 2 : i + 1;
        if (words[i] == "queue" && name + 1 < words.size() && is_word_token(words[name]) &&
            is_one_of(words[name + 1], {"(", "{", ";", ",", ")", "="}))
            out.insert(words[name]);
    }
    return out;
}

/// True for a file that hands work to a device by OpenMP's directives, and never says that it is not to be waited for.
bool offloads_by_openmp(const ScannedFile& file) {
    bool any = false;
    const LexedText& lexed = file.lexed;
    for (uint32_t i = 0; i + 3 < lexed.tokens.size(); ++i) {
        if (lexed.view(i) == "nowait") return false;
        any |= lexed.view(i) == "#" && lexed.view(i + 1) == "pragma" && lexed.view(i + 2) == "omp" &&
               lexed.view(i + 3) == "target";
    }
    return any;
}

}  // namespace

DeviceWait device_wait(const std::vector<std::string>& unit, const ScannedFile& file) {
    if (file.language != Language::Cpp && file.language != Language::C && file.language != Language::Sycl) return {};
    const std::set<std::string> queues = queues_of(unit);
    if (queues.size() == 1) return std::vector<std::string>{*queues.begin(), ".", "wait", "(", ")", ";"};
    if (queues.empty() && offloads_by_openmp(file)) return std::vector<std::string>();
    return {};
}

NormalText without_waits(const NormalText& text, const std::vector<std::string>& wait) {
    const Words words = text.words();
    const auto is_at = [&](size_t i, const std::vector<std::string>& statement) {
        return !statement.empty() && (i == 0 || is_one_of(words[i - 1], {";", "{", "}"})) &&
               i + statement.size() <= words.size() &&
               std::equal(statement.begin(), statement.end(), words.begin() + static_cast<std::ptrdiff_t>(i));
    };
    const std::vector<std::vector<std::string>> all = {
        {"cudaDeviceSynchronize", "(", ")", ";"}, {"hipDeviceSynchronize", "(", ")", ";"}, wait};
    NormalText out;
    for (size_t i = 0; i < words.size();) {
        const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return is_at(i, one); });
        if (found == all.end())
            out.add(words[i++]);
        else
            i += found->size();
    }
    return out;
}

bool waits_for_device(const std::vector<std::string>& words, size_t first, size_t end) {
    return end == first + 4 && is_one_of(words[first], {"cudaDeviceSynchronize", "hipDeviceSynchronize"}) &&
           words[first + 1] == "(" && words[first + 2] == ")" && words[first + 3] == ";";
}

}  // namespace porttool
