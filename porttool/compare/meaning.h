// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/compare/plain_updates.h"
#include "porttool/compare/runtime_calls.h"
#include "porttool/compare/vector_parts.h"
#include "porttool/language/dialect.h"
#include "porttool/language/language.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/side.h"

namespace porttool {

/// The texts of a pair when it was last in step, and now, as tokens in normal form.
struct PairTexts {
    const Words &source_before, &source_now, &target_before, &target_now;
};

/// Translates the statements of one pair, whose texts must outlive it, so that equal words mean the same: where two
/// names could be meant, they stay apart. The words that measures and the matcher go by (common_word()) fold more.
///
///     CUDA     const float3 d = make_float3 ( x , y , z ) * 2f ;
///     GLSL     vec3 d = vec3 ( x , y , z ) * 2.0 ;
///     both     vec3 d = vec3 ( x , y , z ) * 2.0 ;              between CUDA and C++ the number stays 2.0f
///     OpenCL, CUDA, C        v . s1        v . y        v [ 1 ]            one component: v . y
class Meaning {
public:
    /// `updates`: how what is updated and limited is written (Updates).
    enum class Updates : uint8_t {
        AsWritten,
        InOneManner,  ///< `x = x + a` is `x += a`, and `clamp ( x , a , b )` is `min ( max ( x , a ) , b )`
    };
    Meaning(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages,
            Updates updates = Updates::AsWritten);

    /// A statement's words. `in_body`: not the function's head, so that storage (`static`, group-shared memory) counts.
    /// `has_updates`, where it is given, becomes true if the words are others with updates in one manner.
    std::vector<std::string> translate(const Words& statement, Side side, bool in_body,
                                       bool* has_updates = nullptr) const;

private:
    using Spellings = std::map<std::string, std::set<std::string_view>, std::less<>>;
    using Scopes = std::map<std::string_view, std::set<std::string_view>>;

    void note_names(const Words& tokens, Side side);
    void note_objects(const PairTexts& texts, Side side);
    bool is_implied_object(const Words& tokens, size_t i, Side side) const;
    void note_scopes(const Words& source, const Words& target);
    std::string word(std::string_view token, Side side) const;
    std::string number(std::string_view token) const;
    std::vector<std::string> in_one_manner(const std::vector<std::string>& words) const;
    std::string scoped(std::string_view scope, std::string_view name, Side side) const;

    const Dialect& dialect_;
    BySide<Language> languages_;
    Literals literals_;                                     ///< Shading if one side at least is of that kind
    BySide<Spellings> spellings_;                           ///< by folded name
    BySide<Scopes> scopes_;                                 ///< by name
    BySide<std::set<std::string_view>> old_scopes_;         ///< in the texts before
    std::map<std::string_view, std::string_view> renamed_;  ///< the source's scope for one of the port's
    BySide<std::set<std::string_view>> objects_;  ///< parameters whose members the other side names without an object
    BySide<PlainCounters> counters_;              ///< loops' whose type is a matter of manner
    BySide<VectorNames> vectors_;                 ///< what each side declares as vectors
    BySide<ContextNames> contexts_;               ///< what each side hands on and the other does not name
    Updates updates_;
    bool directed_ = false, in_order_ = false;  ///< see TransferRules
};

}  // namespace porttool
