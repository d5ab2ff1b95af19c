// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/language/hazards.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "porttool/language/word_list.h"

namespace porttool {
namespace {

struct HazardRow {
    std::string_view calls;  ///< separated by blanks
    std::string_view says;
};

constexpr std::array kHazards = {
    HazardRow{"pow powf __powf powr native_powr",
              "pow of a zero or negative base is undefined in GLSL and HLSL and defined in C++ and CUDA"},
    HazardRow{"mod fmod fmodf",
              "GLSL's mod takes the sign of the divisor, fmod that of the dividend: they differ for negatives"},
    HazardRow{"min max fmin fmax fminf fmaxf",
              "min and max with a NaN give either argument in GLSL and HLSL, and the other one with fmin and fmax"},
    HazardRow{"normalize fast_normalize",
              "normalize of a zero vector is undefined in GLSL and HLSL and NaN or zero elsewhere"},
    HazardRow{"int uint int32_t uint32_t __float2int_rz __float2uint_rz convert_int convert_uint",
              "a float out of range becomes an undefined integer in GLSL and C++ and saturates in CUDA"},
    HazardRow{"round rint roundf rintf",
              "halves are rounded away from zero by C++'s round and in any direction by GLSL's"},
};

bool calls(const std::vector<std::string>& statements, std::string_view name) {
    const std::string call = std::string(name) + "(";
    return std::any_of(statements.begin(), statements.end(), [&](const std::string& statement) {
        for (size_t at = statement.find(call); at != std::string::npos; at = statement.find(call, at + 1)) {
            const char before = at > 0 ? statement[at - 1] : ' ';
            const bool inside_word = before == '_' || before == '.' || (before >= '0' && before <= '9') ||
                                     (before >= 'a' && before <= 'z') || (before >= 'A' && before <= 'Z');
            if (!inside_word) return true;
        }
        return false;
    });
}

}  // namespace

std::vector<std::string> hazards_of(const std::vector<std::string>& gained, const std::vector<std::string>& lost) {
    std::vector<std::string> out;
    for (const HazardRow& row : kHazards) {
        bool now = false, before = false;
        for_each_word(row.calls, [&](std::string_view word) {
            now = now || calls(gained, word);
            before = before || calls(lost, word);
        });
        if (now && !before) out.emplace_back(row.says);
    }
    return out;
}

}  // namespace porttool
