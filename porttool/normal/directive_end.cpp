// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/directive_end.h"

#include <algorithm>
#include <string>

namespace porttool {
namespace {

std::string_view word(const Words& words, size_t i) { return i < words.size() ? words[i] : std::string_view(); }

/// The bracket that closes the one at `open`, or the end.
size_t closing(const Words& words, size_t open) {
    int depth = 0;
    for (size_t i = open; i < words.size(); ++i) {
        depth += words[i] == "(" ? 1 : words[i] == ")" ? -1 : 0;
        if (depth == 0) return i;
    }
    return words.size();
}

/// OpenMP's `if ( ... )` goes on with another clause or ends before `{` or a loop; a statement's has a block.
bool takes_arguments(const Words& words, size_t i) {
    if (words[i] == "for") return false;
    const std::string_view next = word(words, closing(words, i + 1) + 1);
    return next == "for" || next == "map" || next == "schedule";
}

/// After the clauses of an OpenMP pragma: words of OpenMP's own, some with arguments.
size_t pragma_end(const Words& words, size_t i) {
    static constexpr std::string_view kWords =
        " parallel for simd target teams distribute atomic critical barrier single master masked ordered sections "
        "section task taskloop collapse reduction schedule num_threads private shared firstprivate lastprivate "
        "default map num_teams thread_limit nowait update read write capture data enter exit end declare flush "
        "loop "
        "is_device_ptr use_device_ptr if depend device safelen simdlen linear aligned to from kernels gang vector "
        "worker independent copy copyin copyout present seq async wait ";
    for (; i < words.size(); ++i) {
        if (words[i] == ",") continue;
        if (kWords.find(" " + std::string(words[i]) + " ") == std::string_view::npos) break;
        if (word(words, i + 1) != "(") continue;
        if ((words[i] == "for" || words[i] == "if") && !takes_arguments(words, i)) break;
        i = closing(words, i + 1);
    }
    return std::min(i, words.size());
}

/// After `defined ( A ) || ! defined B`, or 0 where the condition is another one: of that no word tells the end.
size_t condition_end(const Words& words, size_t i) {
    for (;;) {
        if (word(words, i) == "!") ++i;
        if (word(words, i) != "defined") return 0;
        i += word(words, i + 1) == "(" ? 4 : 2;
        if (i > words.size()) return 0;
        if (word(words, i) != "||" && word(words, i) != "&&") return i;
        ++i;
    }
}

}  // namespace

size_t directive_end(const Words& words, size_t at) {
    if (word(words, at) != "#") return 0;
    const std::string_view kind = word(words, at + 1);
    if (kind == "endif" || kind == "else") return at + 2;
    if (kind == "ifdef" || kind == "ifndef" || kind == "undef") return std::min(at + 3, words.size());
    if (kind == "if" || kind == "elif") return condition_end(words, at + 2);
    if (kind != "pragma") return 0;
    if (word(words, at + 2) == "unroll") return at + (is_number_token(word(words, at + 3)) ? 4 : 3);
    return word(words, at + 2) == "omp" || word(words, at + 2) == "acc" ? pragma_end(words, at + 3) : 0;
}

}  // namespace porttool
