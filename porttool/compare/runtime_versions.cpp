// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/runtime_versions.h"

#include <string>
#include <string_view>
#include <vector>

#include "porttool/compare/runtime_calls.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

/// What a runtime called otherwise in an earlier version. A `*` in the later one stands for an argument, `@` for the
/// object that a method is called of.
struct Respelling {
    std::vector<std::string_view> earlier, later;
};

const std::vector<Respelling>& respellings() {
    static const std::vector<Respelling> kRows = {
        {{"@", ".", "shuffle_down", "("}, {"sycl", "::", "shift_group_left", "(", "@", ","}},
        {{"@", ".", "shuffle_up", "("}, {"sycl", "::", "shift_group_right", "(", "@", ","}},
        {{"@", ".", "shuffle_xor", "("}, {"sycl", "::", "permute_group_by_xor", "(", "@", ","}},
        {{"@", ".", "shuffle", "("}, {"sycl", "::", "select_from_group", "(", "@", ","}},
        {{".", "get_pointer", "(", ")"},
         {".", "get_multi_ptr", "<", "sycl", "::", "access", "::", "decorated", "::", "no", ">", "(", ")", ".", "get",
          "(", ")"}},
        {{"gpu_selector", "(", ")"}, {"gpu_selector_v"}},
        {{"gpu_selector", "{", "}"}, {"gpu_selector_v"}},
        {{"cpu_selector", "(", ")"}, {"cpu_selector_v"}},
        {{"cpu_selector", "{", "}"}, {"cpu_selector_v"}},
        {{"__shfl", "("}, {"__shfl_sync", "(", "*", ","}},
        {{"__shfl_up", "("}, {"__shfl_up_sync", "(", "*", ","}},
        {{"__shfl_down", "("}, {"__shfl_down_sync", "(", "*", ","}},
        {{"__shfl_xor", "("}, {"__shfl_xor_sync", "(", "*", ","}},
        {{"__any", "("}, {"__any_sync", "(", "*", ","}},
        {{"__all", "("}, {"__all_sync", "(", "*", ","}},
        {{"__ballot", "("}, {"__ballot_sync", "(", "*", ","}},
        {{"cudaThreadSynchronize", "("}, {"cudaDeviceSynchronize", "("}},
        {{"hipThreadIdx_x"}, {"threadIdx", ".", "x"}},
        {{"hipThreadIdx_y"}, {"threadIdx", ".", "y"}},
        {{"hipThreadIdx_z"}, {"threadIdx", ".", "z"}},
        {{"hipBlockIdx_x"}, {"blockIdx", ".", "x"}},
        {{"hipBlockIdx_y"}, {"blockIdx", ".", "y"}},
        {{"hipBlockIdx_z"}, {"blockIdx", ".", "z"}},
        {{"hipBlockDim_x"}, {"blockDim", ".", "x"}},
        {{"hipBlockDim_y"}, {"blockDim", ".", "y"}},
        {{"hipBlockDim_z"}, {"blockDim", ".", "z"}},
        {{"hipGridDim_x"}, {"gridDim", ".", "x"}},
        {{"hipGridDim_y"}, {"gridDim", ".", "y"}},
        {{"hipGridDim_z"}, {"gridDim", ".", "z"}},
    };
    return kRows;
}

/// Behind the words of a row where they stand at `i`, or 0. `object` is what `@` stands for, once one of the two is
/// read.
size_t behind_row(const std::vector<std::string_view>& row, const Words& text, size_t i, std::string_view& object) {
    constexpr size_t kLongest = 32;
    for (const std::string_view word : row) {
        if (word == "*") {
            int depth = 0;
            const size_t first = i;
            for (; i < text.size() && i < first + kLongest && (depth > 0 || text[i] != ","); ++i) {
                depth += text[i] == "(" ? 1 : text[i] == ")" ? -1 : 0;
                if (depth < 0 || text[i] == ";") return 0;
            }
            if (i == first) return 0;
            continue;
        }
        if (i >= text.size()) return 0;
        if (word == "@") {
            if (!is_word_token(text[i]) || (!object.empty() && object != text[i])) return 0;
            object = text[i];
        } else if (text[i] != word) {
            return 0;
        }
        ++i;
    }
    return i;
}

/// Goes past a row whose two spellings stand at `i` and `k`.
bool step_past_row(const Words& before, size_t& i, const Words& now, size_t& k) {
    for (const Respelling& row : respellings())
        for (const bool is_update : {true, false}) {
            std::string_view object;
            const size_t end = behind_row(is_update ? row.earlier : row.later, before, i, object);
            const size_t there = end > 0 ? behind_row(is_update ? row.later : row.earlier, now, k, object) : 0;
            if (there == 0) continue;
            i = end;
            k = there;
            return true;
        }
    return false;
}

/// A runtime's name without what tells the runtime and the version, in small letters: `dotex` of `hipblasDotEx_64`.
std::string stem_of(std::string_view name) {
    if (!is_runtime_call(name)) return {};
    for (const std::string_view runtime :
         {"cublas", "hipblas", "cusparse", "hipsparse", "cusolver", "hipsolver", "cuda", "hip"})
        if (name.starts_with(runtime)) {
            name.remove_prefix(runtime.size());
            break;
        }
    for (const std::string_view version : {"_v2", "_v3", "_64", "_t"})
        if (name.ends_with(version)) {
            name.remove_suffix(version.size());
            break;
        }
    return in_small_letters(name);
}

/// `hipblasDotEx_v2` and `hipblasDotEx_64`, `hipblasDatatype_t` and `hipDataType`: of one vendor.
bool are_versions(std::string_view before, std::string_view now) {
    constexpr size_t kLeast = 4;  // letters that tell
    if (before.substr(0, 2) != now.substr(0, 2)) return false;
    const std::string stem = stem_of(before);
    return stem.size() >= kLeast && stem == stem_of(now);
}

}  // namespace

bool only_follows_runtime(const Words& before, const Words& now) {
    bool any = false;
    size_t i = 0, k = 0;
    while (i < before.size() && k < now.size()) {
        if (step_past_row(before, i, now, k)) {
            any = true;
        } else if (before[i] == now[k] || are_versions(before[i], now[k])) {
            any = any || before[i] != now[k];
            ++i;
            ++k;
        } else {
            return false;
        }
    }
    return any && i == before.size() && k == now.size();
}

}  // namespace porttool
