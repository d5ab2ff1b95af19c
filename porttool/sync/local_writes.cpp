// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/local_writes.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/locals.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/operands.h"
#include "porttool/sync/scopes.h"

namespace porttool {
namespace {

bool is_assignment(const std::string& word) {
    return is_one_of(word, {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="});
}

bool touches(const VariableWrite& write, const std::string& part) {
    return write.part.empty() || part.empty() || write.part == part;
}

/// The words as declarations are read in them: without preprocessor lines, and with a qualifier for what may be one.
Words plainly_declared(const std::vector<std::string>& words) {
    Words out = without_directives(words);
    for (const auto& [macro, name] : declared_behind_macro(out)) out[macro] = "const";
    return out;
}

}  // namespace

LocalWrites::LocalWrites(const AlignedText& text, const HandsBack& hands_back)
    : text_(text), hands_back_(hands_back), locals_(local_numbers(plainly_declared(text.words))), declared_(1) {
    for (size_t i = 0; i < locals_.size(); ++i) {
        if (locals_[i] >= declared_.size()) declared_.resize(locals_[i] + 1, i);
        std::vector<VariableWrite> found;
        if (locals_[i] != 0) note_write(i, found);
        if (!found.empty()) written_in_[locals_[i]].insert(clause_at(i));
    }
}

const std::string& LocalWrites::word(size_t i) const {
    static const std::string kNothing;
    return i < text_.words.size() ? text_.words[i] : kNothing;
}

LocalPart LocalWrites::part(size_t i) const {
    const bool picks = word(i + 1) == "." || word(i + 1) == "->";
    return {local(i), picks ? word(i + 2) : std::string()};
}

size_t LocalWrites::local_at(size_t place, const std::string& name) const {
    while (place > 1 && is_accessor(word(place - 1))) place -= 2;
    if (std::find(text_.words.begin(), text_.words.end(), name) == text_.words.end() || locals_.empty()) return 0;
    if (clause_at(place) == 0) {  // in the head a name is a parameter before it, and a type no name of one
        for (size_t i = place; i-- > 0;)
            if (locals_[i] != 0 && word(i) == name) return locals_[i];
        return 0;
    }
    std::vector<std::string> words(text_.words);
    // As a statement of its own, where one begins; else as the first of two values.
    const bool begins = std::any_of(text_.clauses.begin(), text_.clauses.end(),
                                    [&](const Clause& clause) { return clause.first == place; });
    words.insert(words.begin() + static_cast<std::ptrdiff_t>(place), {name, begins ? ";" : "+"});
    const std::vector<size_t> numbers = local_numbers(plainly_declared(words));
    return place < numbers.size() ? numbers[place] : 0;
}

bool LocalWrites::is_constant(size_t local, bool parts) const {
    const size_t name = declared_.at(local);
    int depth = 0;
    bool constant = false, parts_constant = false, points = false;
    for (size_t i = name; i-- > 0;) {
        if (word(i) == ">") ++depth;
        if (word(i) == "<" && --depth < 0) break;
        if (depth > 0) continue;
        if (is_one_of(word(i), {";", "{", "}", "(", ",", ")"})) break;
        if (word(i) == "*") points = true;
        // Behind the last `*` it is the pointer's own: `float * const v` may be written through.
        if (word(i) == "const" || word(i) == "constexpr") (points ? parts_constant : constant) = true;
    }
    return points && parts ? parts_constant : constant;
}

size_t LocalWrites::clause_at(size_t at) const {
    const auto found = std::upper_bound(text_.clauses.begin(), text_.clauses.end(), at,
                                        [](size_t i, const Clause& clause) { return i < clause.end; });
    return static_cast<size_t>(found - text_.clauses.begin());
}

UsePlace LocalWrites::place_of(size_t at) const {
    const size_t clause = clause_at(at);
    if (clause == text_.clauses.size()) return {clause, Clause::kNone, false};
    return {clause, text_.clauses[clause].inside, true};
}

UsePlace LocalWrites::place_before(size_t at) const {
    const size_t clause = clause_at(at);
    if (clause == text_.clauses.size()) return {clause, Clause::kNone, false};
    const Clause& one = text_.clauses[clause];
    return {clause, one.closes ? one.partner : one.inside, false};
}

UsePlace LocalWrites::place_behind(size_t clause) const {
    if (clause >= text_.clauses.size()) return {0, Clause::kNone, false};
    const Clause& one = text_.clauses[clause];
    return {clause + 1, one.opens ? clause : one.inside, false};
}

bool LocalWrites::is_in(size_t clause, size_t head) const {
    const size_t end = text_.clauses[head].partner;
    return clause > head && (end == Clause::kNone || clause < end);
}

bool LocalWrites::is_loop(size_t clause) const {
    const std::string& head = word(text_.clauses[clause].first);
    return text_.clauses[clause].opens && (word_is(head, kLoopHead) || head == "while" || head == "do");
}

bool LocalWrites::surely_runs(size_t clause, const UsePlace& place) const {
    const size_t around = text_.clauses[clause].inside;
    if (around == Clause::kNone || around == place.block) return true;
    for (size_t block = place.block; block != Clause::kNone; block = text_.clauses[block].inside)
        if (block == around || block == clause) return true;
    return false;
}

std::set<size_t> LocalWrites::writing(const LocalPart& written) const {
    std::set<size_t> out;
    const auto found = written_in_.find(written.local);
    if (found == written_in_.end()) return out;
    for (const size_t clause : found->second)
        if (!writes(clause, word(declared_[written.local]), written.part).empty()) out.insert(clause);
    return out;
}

std::set<size_t> LocalWrites::reaching(const LocalPart& read, const UsePlace& place) const {
    const std::set<size_t> written = writing(read);
    std::set<size_t> out;
    const bool heads_loop = place.is_within && place.clause < text_.clauses.size() && is_loop(place.clause);
    const size_t before = heads_loop ? place.clause + 1 : place.clause;
    size_t last = Clause::kNone;
    for (const size_t clause : written) {
        if (clause >= before) break;
        const std::vector<VariableWrite> here = writes(clause, word(declared_[read.local]), read.part);
        const bool whole = std::any_of(here.begin(), here.end(), [&](const VariableWrite& write) {
            return write.is_whole && (write.part.empty() || write.part == read.part);
        });
        if (whole && surely_runs(clause, place)) out.clear(), last = clause;
        out.insert(clause);
    }
    const auto add_loop = [&](size_t head) {
        if (!is_loop(head) || apart_.contains(head) || (last != Clause::kNone && is_in(last, head))) return;
        for (const size_t clause : written)
            if (is_in(clause, head)) out.insert(clause);
    };
    if (heads_loop) add_loop(place.clause);
    for (size_t block = place.block; block != Clause::kNone; block = text_.clauses[block].inside) add_loop(block);
    return out;
}

std::vector<VariableWrite> LocalWrites::writes(size_t clause, const std::string& name, const std::string& part) const {
    std::vector<VariableWrite> out;
    for (size_t i = text_.clauses[clause].first; i < text_.clauses[clause].end; ++i)
        if (locals_[i] != 0 && word(i) == name) note_write(i, out);
    std::erase_if(out, [&](const VariableWrite& write) { return !touches(write, part); });
    return out;
}

void LocalWrites::note_write(size_t i, std::vector<VariableWrite>& out) const {
    const bool declares = declared_[locals_[i]] == i;
    if (declares && clause_at(i) == 0) return out.push_back({std::string(VariableWrite::kParameter), {}, i, i, true});
    size_t next = i + 1;
    while (word(next) == "[" || word(next) == "." || word(next) == "->")
        next = word(next) == "[" ? closing(next) + 1 : next + 2;
    const std::string member = part(i).part;
    const bool whole = next == (member.empty() ? i + 1 : i + 3);
    if (declares && (word(next) == "(" || word(next) == "{"))
        return out.push_back({"=", {}, next + 1, closing(next), true});
    if (declares && word(next) == ":")
        return out.push_back({std::string(VariableWrite::kEach), {}, next + 1, end_of_value(next + 1), true});
    const bool steps_before = i > 0 && is_one_of(word(i - 1), {"++", "--"});
    if (is_one_of(word(next), {"++", "--"}) || steps_before) {
        const std::string& step = steps_before ? word(i - 1) : word(next);
        return out.push_back({step == "++" ? "+=" : "-=", member, next, next, false});
    }
    if (i > 1 && word(i - 1) == "&" && is_one_of(word(i - 2), {"(", ",", "="}) && !declares)
        return out.push_back({std::string(VariableWrite::kAddress), member, next, next, false});
    if (!declares && is_handed_back(i, next))
        return out.push_back({std::string(VariableWrite::kAddress), member, next, next, false});
    if (!is_assignment(word(next))) return;
    VariableWrite write{word(next), member, next + 1, end_of_value(next + 1), whole && word(next) == "="};
    // `n = n - 1` is `n -= 1`.
    const bool again =
        write.op == "=" && write.first < write.end && locals_[write.first] == locals_[i] && member.empty() && whole;
    if (again && write.end > write.first + 2 &&
        is_one_of(word(write.first + 1), {"+", "-", "*", "/", "%", "&", "|", "^", "<<", ">>"}) &&
        is_operand(text_.words, write.first + 2, write.end)) {
        write.op = word(write.first + 1) + "=";
        write.first += 2;
        write.is_whole = false;
    }
    out.push_back(std::move(write));
}

/// True for words [first, end) that are all of an argument which the function may write.
bool LocalWrites::is_handed_back(size_t first, size_t end) const {
    if (first == 0 || !is_one_of(word(first - 1), {"(", ","}) || !is_one_of(word(end), {")", ","})) return false;
    size_t argument = 0;
    int depth = 0;
    for (size_t i = first; i-- > 0;) {
        if (is_one_of(word(i), {")", "]", "}"})) ++depth;
        if (word(i) == ";" || (is_one_of(word(i), {"[", "{"}) && --depth < 0)) return false;
        if (word(i) == "," && depth == 0) ++argument;
        if (word(i) == "(" && --depth < 0) return i > 0 && is_name(word(i - 1)) && hands_back_(word(i - 1), argument);
    }
    return false;
}

size_t LocalWrites::end_of_value(size_t first) const {
    int depth = 0;
    for (size_t i = first; i < text_.words.size(); ++i) {
        if (is_one_of(word(i), {"(", "[", "{"})) ++depth;
        if (is_one_of(word(i), {")", "]", "}"}) && --depth < 0) return i;
        if (depth == 0 && is_one_of(word(i), {";", ","})) return i;
    }
    return text_.words.size();
}

size_t LocalWrites::closing(size_t open) const {
    int depth = 0;
    for (size_t i = open; i < text_.words.size(); ++i) {
        if (is_one_of(word(i), {"(", "[", "{"})) ++depth;
        if (is_one_of(word(i), {")", "]", "}"}) && --depth == 0) return i;
    }
    return text_.words.size();
}

}  // namespace porttool
