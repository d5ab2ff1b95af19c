// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/unit_state.h"

#include <algorithm>
#include <unordered_set>

#include "porttool/normal/declarations.h"
#include "porttool/normal/locals.h"
#include "porttool/normal/prelude.h"
#include "porttool/scan/scan.h"
#include "porttool/text/text_numbers.h"

namespace porttool {
namespace {

/// What prints take for a number, `.*` among it: a recorded print must not change.
bool is_blanked(std::string_view text) {
    return !text.empty() && ((text[0] >= '0' && text[0] <= '9') || text[0] == '.') && text != "." && text != "...";
}

/// Leaves out of the places of declarations those of locals that the unit hands to a macro that takes their spelling:
/// `CHECK(x)` that prints `#x`. Such a name is no matter of taste.
void drop_spelled(const ScannedFile& file, const Unit& unit, std::vector<uint32_t>& places) {
    if (file.spelling_macros.empty() || places.empty()) return;
    const LexedText& lexed = file.lexed;
    std::unordered_set<std::string_view> spelled;
    int depth = 0;  // of brackets within such a macro's
    for (uint32_t at = unit.body.first; at < unit.body.end; ++at) {
        const std::string_view word = lexed.view(at);
        if (depth > 0) {
            if (word == "(") ++depth;
            if (word == ")") --depth;
            if (lexed.tokens[at].kind == TokenKind::Identifier) spelled.insert(word);
        } else if (lexed.tokens[at].kind == TokenKind::Identifier && at + 1 < unit.body.end &&
                   lexed.view(at + 1) == "(" &&
                   std::binary_search(file.spelling_macros.begin(), file.spelling_macros.end(), word)) {
            depth = 1;
            ++at;
        }
    }
    std::erase_if(places, [&](uint32_t place) { return spelled.contains(lexed.view(place)); });
}

/// The three prints of a unit, word by word.
class UnitPrinter {
public:
    /// `local`: the number of the local that the word names, or 0.
    void add(std::string_view word, size_t local) {
        written_.add(word);
        const std::string numbered = local == 0 ? std::string() : "%" + std::to_string(local);
        if (local != 0) word = numbered;
        renamed_.add(word);
        blanked_.add(is_blanked(word) ? "#" : word);
    }
    Fingerprints take() const { return {Print(written_), Print(renamed_), Print(blanked_)}; }

private:
    Fingerprinter written_, renamed_, blanked_;
};

}  // namespace

std::vector<std::string> local_names(const ScannedFile& file, const Unit& unit) {
    if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) return {};
    std::vector<std::string> names;
    TextNumbers seen;
    for (const uint32_t place : declaring_tokens(file.lexed, unit.parameters, unit.body)) {
        const std::string_view name = file.lexed.view(place);
        if (seen.number(name) == names.size()) names.emplace_back(name);
    }
    return names;
}

UnitState unit_state(const ScannedFile& file, const Unit& unit) {
    UnitState state;
    state.id = unit_id(file, unit);
    state.file = file.path;
    state.name = unit.name;
    state.kind = unit.kind;
    state.start_line = unit.start_line;
    state.end_line = unit.end_line;
    const bool code = unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel;
    std::vector<uint32_t> places =
        code ? declaring_tokens(file.lexed, unit.parameters, unit.body) : std::vector<uint32_t>();
    UnitPrinter prints;
    NormalText text;
    write_prelude(file, unit, places, [&](std::string_view word) {
        text.add(word);
        prints.add(word, 0);
    });
    drop_spelled(file, unit, places);
    LocalNumbers numbers(std::move(places));
    write_normal_form(file, unit, [&](std::string_view word, uint32_t token) {
        text.add(word);
        prints.add(word, numbers.next(word, token));
    });
    text.as_recorded();
    text.shrink();
    state.text = std::move(text);
    state.prints = prints.take();
    return state;
}

Fingerprints prints_of_text(const NormalText& text) {
    const Words words = text.words();
    const std::vector<size_t> locals = local_numbers(words);
    UnitPrinter prints;
    for (size_t i = 0; i < words.size(); ++i) prints.add(words[i], locals.empty() ? 0 : locals[i]);
    return prints.take();
}

}  // namespace porttool
