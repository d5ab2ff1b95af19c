// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

/// What an edit did to the names, numbers and operators of a text, whatever their order. Common words; hints to the
/// compiler, words that only promise something, types, asides and `!= 0` of a truth are left out; the arms of a switch
/// are in the order of their labels.
struct SideEdit {
    SideEdit(const Words& before_words, const Words& now_words, const Dialect& dialect);

    std::vector<std::string> before, now;
    std::map<std::string, size_t> had, has;        ///< how often each stood there, and stands there
    std::set<std::string> gained, lost;            ///< what came and went somewhere
    std::map<std::string, long> guarded;           ///< words that are never silent, and how many more there are now
    std::map<std::string, std::string> new_names;  ///< that stood nowhere before and are not declared there, as spelled
    size_t gained_words = 0;                       ///< how many names and numbers came
    size_t size = 0;                               ///< how many words came and went

private:
    void count_guarded(const std::vector<std::string>& text, long times);
};

/// How often it is there, in `had` or `has`.
size_t times_in(const std::map<std::string, size_t>& words, const std::string& word);

/// True if an edit brought a name that the other side says more often: what it does with that, to all appearance, lacks
/// a part.
///
///     other      int h = i * 7; h ^= h >> 4; y = h;
///     edit       int h = i * 7; y = h;
bool brings_part_of(const SideEdit& other, const SideEdit& edit);

/// True if half of the words that two names are made of are the same, or all of their letters.
///
///     ggml_cuda_op_add    ggmlSyclAdd            like
///     ggml_cuda_op_add    ggml_cuda_pool_free    not
bool are_like(std::string_view a, std::string_view b);

}  // namespace porttool
