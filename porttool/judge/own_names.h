// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "porttool/compare/respelled_calls.h"
#include "porttool/judge/judge.h"
#include "porttool/language/dialect.h"

namespace porttool {

/// True if a file's text has `word` as a whole word, be it in a comment.
bool says_word(std::string_view text, std::string_view word);

/// True if some file of the side has that word elsewhere than in a comment.
bool is_in_code(const Case& facts, Side side, std::string_view word);

/// The same of one file.
bool is_in_code_of(const Case& facts, Side side, std::string_view path, std::string_view word);

/// The units of both sides by the last part of their names, and what a name means where it stands without its scope.
class OwnNames {
public:
    explicit OwnNames(const Case& facts) : facts_(facts) {}

    /// The units of a side that bear a name, or nullptr for none.
    const std::vector<const UnitState*>* of(Side side, std::string_view name);

    /// True if both units of a pair are known by one name that no class beside theirs has as well. A method that a
    /// whole family has, `Layer::forward`, is known by its class; an entry point `main` by its file.
    bool are_one(const BySide<const UnitState*>& units);

    /// True if a name surely is one thing with its scope and without, as `unit` says it: the scope is that of a library
    /// (`std::`), of the unit itself or of a `using` of its file, and nothing else of that side is called so there.
    ///
    ///     std :: sqrt            sqrt             one function
    ///     std :: sqrt            sqrt             two, where the side has a `sqrt` of its own
    ///     coarse :: lobe         lobe             two; one where the file says `using namespace coarse`
    ///     native :: sin          sin              two, of which one is less exact
    bool is_one_thing(const RescopedName& name, const UnitState& unit, Side side);

    /// True if a macro that a text uses, defined anywhere on its side, says the name of one of the text's locals.
    bool are_locals_in_macros(const Words& text, Side side) const;

    /// A name in capitals in a text, of no local, that no file of its side defines or declares and no compiler brings:
    /// a macro of a header elsewhere, to all appearance, which may say the name of any local. "" for none.
    ///
    ///     return SCALE ( d ) * k ;        with `#define SCALE(x) ((x) * gain)` where no glob of the map leads
    std::string macro_of_elsewhere(const Words& text, Side side, const Dialect& dialect);

    /// True if no file of the side defines that macro and none of the other side speaks of it: who builds the side asks
    /// for it, and never for the other one.
    bool is_asked_for_elsewhere(const std::string& macro, Side side) const;

private:
    using ByName = std::unordered_map<std::string_view, std::vector<const UnitState*>>;

    bool is_seen_without(std::string_view scope, std::string_view name, const UnitState& unit, Side side) const;

    const Case& facts_;
    BySide<std::optional<ByName>> by_name_;  ///< filled when first asked
};

}  // namespace porttool
