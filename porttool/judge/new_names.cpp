// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/new_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "porttool/language/words.h"
#include "porttool/normal/locals.h"
#include "porttool/read/map_file.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

using Kind = DeclaredWord::Kind;

constexpr size_t kMostAlike = 64;  ///< of one name: more are not told apart

/// Of macros MacroEdits tells.
bool is_macro(const UnitState& unit) {
    return unit.kind == UnitKind::File ||
           (unit.kind == UnitKind::Constant && !unit.text.empty() && unit.text[0] == "#");
}

/// The signatures of units by their leaves, up to 64 of each.
class Signatures {
public:
    explicit Signatures(const UnitsById& units) {
        for (const auto& [id, unit] : units)
            if (!is_macro(unit)) units_.emplace(bare_leaf_of(unit.name), &unit);
    }
    bool has(std::string_view leaf) const { return units_.contains(leaf); }
    /// True if one of that name says the same.
    bool has_text_of(const UnitState& unit) const {
        const auto [first, last] = units_.equal_range(bare_leaf_of(unit.name));
        return std::any_of(first, last,
                           [&](const auto& one) { return one.second->prints.written == unit.prints.written; });
    }
    const std::vector<Signature>& of(const std::string& leaf) const {
        const auto [known, is_new] = by_leaf_.try_emplace(leaf);
        const auto [first, last] = units_.equal_range(leaf);
        for (auto one = first; is_new && one != last && known->second.size() < kMostAlike; ++one)
            known->second.push_back(signature_of(*one->second));
        return known->second;
    }

private:
    std::unordered_multimap<std::string_view, const UnitState*> units_;
    mutable std::unordered_map<std::string, std::vector<Signature>> by_leaf_;
};

/// `a::B::` of `a::B::f`.
std::string_view scope_of(std::string_view name) {
    const size_t end = name.rfind("::");
    return end == std::string_view::npos ? std::string_view() : name.substr(0, end + 2);
}

std::string_view last_scope(std::string_view scope) {
    if (scope.size() < 2) return {};
    scope.remove_suffix(2);
    return leaf_of(scope);
}

/// True for a member of a type that is there for several arguments: a name does not say which of them.
bool is_specialised(const Signature& own, const Signatures& now) {
    for (std::string_view scope = own.scope; scope.size() > 2;) {
        scope.remove_suffix(2);
        for (const Signature& one : now.of(std::string(leaf_of(scope))))
            if (!one.is_function && !one.types.empty()) return true;
        scope = scope_of(scope);
    }
    return false;
}

/// A constructor that copies or takes nothing, a destructor, an assignment, a conversion: what is called unnamed.
bool is_special(const Signature& one) {
    const std::string_view type = last_scope(one.scope);
    if (type.empty() || !one.is_function) return false;
    if (one.leaf == "operator=" || one.leaf == "~" + std::string(type)) return true;
    if (one.leaf == type) return one.types.empty() || (one.types.size() == 1 && one.types[0] == type);
    return one.leaf.starts_with("operator ") && one.types.empty();
}

std::string_view sign_of(std::string_view leaf) {
    constexpr std::string_view kOperator = "operator";
    if (!leaf.starts_with(kOperator) || leaf.size() == kOperator.size()) return {};
    leaf.remove_prefix(kOperator.size());
    return is_word_token(leaf) || leaf[0] == ' ' ? std::string_view() : leaf;
}

/// True if a text has a type of the parameters that is not the language's.
bool has_type_of(const Signature& one, const NormalText& text) {
    for (const std::string& type : one.types) {
        const std::string_view name = std::string_view(type).substr(0, type.find(' '));
        for (size_t i = 0; i < text.size() && is_word_token(name) && !is_type_word(name); ++i)
            if (text[i] == name) return true;
    }
    return false;
}

/// The declaration of a function.
bool is_head(const NewWord& one) {
    return one.said.name_token + 1 < one.said.tokens.end && one.file->lexed.view(one.said.name_token + 1) == "(";
}

/// A unit at the merge base: under its id, or, where others of its name came before it, one that says the same.
const UnitState* as_it_was(const UnitsById& then, const UnitState& unit) {
    const auto known = then.find(unit.id);
    if (known != then.end() && known->second.prints.written == unit.prints.written) return &known->second;
    const std::string first = unit.id.substr(0, unit.id.rfind('#'));
    for (size_t number = 1; number <= kMostAlike; ++number) {
        const auto one = then.find(number == 1 ? first : fmt::format("{}#{}", first, number));
        if (one == then.end()) break;
        if (one->second.prints.written == unit.prints.written) return &one->second;
    }
    return known == then.end() ? nullptr : &known->second;
}

/// True for what makes a variable, with or without a value.
bool is_definition(const NewWord& one) {
    const std::vector<Token>& tokens = one.file->lexed.tokens;
    bool is_outside = false, has_value = false;
    for (uint32_t at = one.said.tokens.first; at < one.said.tokens.end && at < tokens.size(); ++at) {
        is_outside = is_outside || one.file->lexed.view(at) == "extern";
        has_value = has_value || one.file->lexed.view(at) == "=";
    }
    return !is_head(one) && (has_value || !is_outside);
}

/// A name as a file has it, with its namespaces.
std::string place_of(const std::string& file, std::string_view scope, std::string_view leaf) {
    return file + '\n' + std::string(scope) + std::string(leaf);
}

}  // namespace

void NewNames::judge(JudgedPair& pair) {
    BySide<Uses> found = {changed_uses(pair, Side::Source), changed_uses(pair, Side::Target)};
    std::set<std::string> both;  // what both sides say alike
    if (!found.source.empty() && !found.target.empty()) {
        std::set<std::string> of_source;
        for (const Meaning* one : found.source)
            if (one->said != nullptr) of_source.insert(one->said->text());
        for (const Meaning* one : found.target)
            if (one->said != nullptr && of_source.contains(one->said->text())) both.insert(one->said->text());
    }
    for (const Side side : kBothSides)
        for (const Meaning* one : found[side])
            if (one->said == nullptr || !both.contains(one->said->text())) tell(pair, side, *one);
}

/// What a text that uses it already used at the merge base, as far as its words say.
NewNames::Uses NewNames::changed_uses(const JudgedPair& pair, Side side) {
    const UnitState* unit = pair.unit[side];
    if (facts_.at_base[side] == nullptr || unit == nullptr || fresh(side).meanings.empty()) return {};
    const UnitState* then = as_it_was(*facts_.at_base[side], *unit);
    if (then == nullptr) return {};
    Uses before = uses_of(side, *unit, then->text);
    if (before.empty() || then->prints.written == unit->prints.written) return before;
    const Uses now = uses_of(side, *unit, unit->text);
    std::erase_if(before, [&](const Meaning* one) { return !now.contains(one); });
    return before;
}

const NewNames::Fresh& NewNames::fresh(Side side) {
    if (fresh_[side]) return *fresh_[side];
    Fresh& out = fresh_[side].emplace();
    if (facts_.new_words != nullptr) out.opened = (*facts_.new_words)[side].opened;
    if (!is_contract(facts_.map.reference, side)) add_units(side, out);
    add_words(side, out);
    const auto keep = [](auto& all, const Meaning& one) {
        if (all.count(one.word) < kMostAlike) all.emplace(one.word, &one);
    };
    for (const Meaning& one : out.meanings) {
        const bool of_unit_alone =
            one.said != nullptr && (one.said->said.kind == Kind::Macro || one.said->said.kind == Kind::Attributed);
        if (!of_unit_alone) keep(out.by_word, one);
        const bool is_second = one.reason == Reason::Doubled || one.reason == Reason::Competes;
        if (of_unit_alone || is_second || one.stands_for_unit) keep(out.by_name, one);
    }
    return out;
}

/// What a word may mean now by units that are new: one under a name that no unit had, or one beside those that had it.
void NewNames::add_units(Side side, Fresh& out) const {
    const UnitsById& then = *facts_.at_base[side];
    std::vector<const UnitState*> fresh;
    for (const auto& [id, unit] : facts_.units(side)) {
        if (is_macro(unit)) continue;
        const auto known = then.find(id);  // an overload before others takes the first number
        if (known == then.end() || known->second.prints.written != unit.prints.written) fresh.push_back(&unit);
    }
    if (fresh.empty()) return;
    const Signatures before(then), now(facts_.units(side));
    for (const UnitState* unit : fresh) {
        const Signature own = signature_of(*unit);
        const std::vector<Signature>& old = before.of(own.leaf);
        if (const auto twins = std::count(old.begin(), old.end(), own); twins > 0) {  // it was moved, or is one more
            const std::vector<Signature>& all = now.of(own.leaf);
            if (std::count(all.begin(), all.end(), own) > twins && !before.has_text_of(*unit) &&
                !is_specialised(own, now))
                out.meanings.push_back({own.leaf, Reason::Doubled, unit, nullptr, own});
            continue;
        }
        const std::string_view type = last_scope(own.scope);
        if (is_special(own)) {
            const auto is_same = [&](const Signature& one) { return one.scope == own.scope && one.types == own.types; };
            if (before.has(type) && std::none_of(old.begin(), old.end(), is_same))
                out.meanings.push_back({std::string(type), Reason::Special, unit, nullptr, own});
        } else if (!before.has(own.leaf)) {
            out.meanings.push_back({own.leaf, Reason::Taken, unit, nullptr, own});
        } else {
            const std::vector<Signature>& still = now.of(own.leaf);  // an edited one is no overload of itself
            std::optional<Reason> reason;
            for (const Signature& one : old)
                if (!reason && std::find(still.begin(), still.end(), one) != still.end())
                    reason = beside(own, one, out);
            const std::string_view sign = sign_of(own.leaf);
            if (reason)
                out.meanings.push_back({sign.empty() ? own.leaf : std::string(sign), *reason, unit, nullptr, own});
        }
    }
}

/// What a new unit does beside another of its name.
std::optional<NewNames::Reason> NewNames::beside(const Signature& own, const Signature& one, const Fresh& out) {
    const bool is_operator = !sign_of(own.leaf).empty();
    if (own.is_function && one.is_function && is_operator)
        return compete(own, one) && !own.takes_anything ? std::optional(Reason::Competes) : std::nullopt;
    if (own.scope.size() > one.scope.size() && own.scope.starts_with(one.scope)) return Reason::Hidden;
    const bool together = own.scope == one.scope || one.scope.starts_with(own.scope) ||
                          out.opened.contains(std::string(last_scope(one.scope))) ||
                          out.opened.contains(std::string(last_scope(own.scope)));
    if (!together) return std::nullopt;
    if (!own.is_function) return own.types.empty() ? std::nullopt : std::optional(Reason::Competes);
    return one.is_function && compete(own, one) ? std::optional(Reason::Competes) : std::nullopt;
}

/// What is said of words outside of units.
void NewNames::add_words(Side side, Fresh& out) const {
    if (facts_.new_words == nullptr) return;
    const std::vector<NewWord>& words = (*facts_.new_words)[side].words;
    if (words.empty()) return;
    std::unordered_set<std::string_view> had, has;  // what units are called
    std::unordered_set<std::string> places;
    for (const auto& [id, unit] : *facts_.at_base[side]) had.insert(bare_leaf_of(unit.name));
    for (const auto& [id, unit] : facts_.units(side)) {
        has.insert(bare_leaf_of(unit.name));
        if (!is_macro(unit)) places.insert(place_of(unit.file, scope_of(unit.name), bare_leaf_of(unit.name)));
    }
    for (const NewWord& one : words) {
        if (one.said.kind == Kind::Opened) {
            OpenedIn& opened = out.opened_now[std::string(one.word())];
            opened.by_file.emplace(one.file->path, &one);
            if (opened.header == nullptr && is_header(one.file->path)) opened.header = &one;
            continue;
        }
        const std::string word(one.word());
        if (one.said.kind == Kind::Attributed && !has.contains(word)) continue;
        const bool stands_for_unit = one.said.kind == Kind::Linked || one.said.kind == Kind::Pragma ||
                                     (one.said.kind == Kind::Declared && has.contains(word) && is_definition(one) &&
                                      places.contains(place_of(one.file->path, *one.said.scope, word)));
        if (one.said.kind == Kind::Declared && !stands_for_unit &&
            (one.is_known || has.contains(word) || (is_head(one) && had.contains(word))))
            continue;
        out.meanings.push_back({word, Reason::Said, nullptr, &one, {{}, word, {}, {}, false, false}, stands_for_unit});
    }
    if (out.opened_now.empty()) return;
    for (const auto& [id, unit] : facts_.units(side)) {
        if (is_macro(unit)) continue;
        Signature own = signature_of(unit);
        if (out.opened_now.contains(last_scope(own.scope)))
            out.meanings.push_back({own.leaf, Reason::Opened, &unit, nullptr, own});
    }
}

NewNames::Uses NewNames::uses_of(Side side, const UnitState& user, const NormalText& text) const {
    const Fresh& all = *fresh_[side];
    Uses out;
    const auto [first_named, last_named] = all.by_name.equal_range(bare_leaf_of(user.name));
    for (auto one = first_named; one != last_named; ++one)
        if (one->second->unit != nullptr ? defines(side, *one->second, user) : means(side, *one->second, user, text, 0))
            out.insert(one->second);
    std::optional<std::vector<size_t>> locals;
    for (size_t i = 0; i < text.size(); ++i) {
        const auto [first, last] = all.by_word.equal_range(text[i]);
        for (auto one = first; one != last; ++one) {
            if (out.contains(one->second) || !means(side, *one->second, user, text, i)) continue;
            if (!locals) locals = local_numbers(text.words());
            const bool is_call = i + 1 < text.size() && text[i + 1] == "(";
            if (locals->empty() ? is_call || !is_word_token(text[i]) : (*locals)[i] == 0) out.insert(one->second);
        }
    }
    return out;
}

/// True if the word at a place of a text can have that meaning there.
bool NewNames::means(Side side, const Meaning& meaning, const UnitState& user, const NormalText& text,
                     size_t at) const {
    const std::string_view before = at > 0 ? text[at - 1] : std::string_view();
    const std::string_view after = at + 1 < text.size() ? text[at + 1] : std::string_view();
    if (meaning.unit == &user || before == "." || before == "->" || before == "::") return false;
    const Fresh& all = *fresh_[side];
    if (meaning.said != nullptr && meaning.said->said.kind == Kind::Attributed)  // of its own file the text tells
        return meaning.said->file->path != user.file && is_included(side, meaning.said->file->path, user) &&
               is_seen(*meaning.said->said.scope, user, all);
    if (meaning.said != nullptr)
        return (meaning.said->file->path == user.file || is_header(meaning.said->file->path)) &&
               is_seen(*meaning.said->said.scope, user, all);
    if (meaning.reason == Reason::Special) return true;
    if (meaning.reason == Reason::Doubled && !sees_definition(side, meaning, user)) return false;
    if (!sign_of(meaning.signature.leaf).empty()) return has_type_of(meaning.signature, text);
    if (meaning.reason == Reason::Opened) {
        if (opened_for(side, meaning, user) == nullptr) return false;
    } else if (!is_seen(meaning.signature.scope, user, all)) {
        return false;
    }
    if (!meaning.signature.is_function)
        return meaning.unit->kind == UnitKind::Struct ? meaning.reason != Reason::Competes || after == "<" : true;
    if (meaning.reason != Reason::Taken && meaning.signature.takes_anything) return after == "(" || after == "<";
    return after == "(" && (meaning.reason == Reason::Hidden || may_take(*meaning.unit, text, at + 1));
}

/// True if a unit's file has a second definition, or includes the header that has it.
bool NewNames::sees_definition(Side side, const Meaning& meaning, const UnitState& user) const {
    const std::string& file = meaning.unit->file;
    if (meaning.unit == &user || file == user.file) return meaning.unit != &user;
    return is_included(side, file, user);
}

/// True if a unit's file includes a header.
bool NewNames::is_included(Side side, const std::string& file, const UnitState& user) const {
    if (!is_header(file) || !facts_.files) return false;
    if (!includes_[side]) includes_[side].emplace((*facts_.files)[side].macros());
    return includes_[side]->sees(user.file, file);
}

/// True if a new unit defines once more what a unit defines.
bool NewNames::defines(Side side, const Meaning& meaning, const UnitState& unit) const {
    const Signature own = signature_of(unit);
    return own.scope == meaning.signature.scope && own.is_function == meaning.signature.is_function &&
           own.types == meaning.signature.types && sees_definition(side, meaning, unit);
}

/// True for what is seen by its bare name from a unit: both stand in one scope, or it stands in one around that, or in
/// one that is opened.
bool NewNames::is_seen(const std::string& scope, const UnitState& user, const Fresh& fresh) {
    for (size_t at = 0; at < scope.size();) {
        const size_t end = scope.find("::", at) + 2;
        if (!user.name.starts_with(std::string_view(scope).substr(0, end)) &&
            !fresh.opened.contains(scope.substr(at, end - 2 - at)))
            return false;
        at = end;
    }
    return true;
}

/// The new `using namespace` by which a unit sees another; nothing where it saw it before.
const NewWord* NewNames::opened_for(Side side, const Meaning& meaning, const UnitState& user) const {
    const std::string scope(last_scope(meaning.signature.scope));
    if (user.name.starts_with(meaning.signature.scope)) return nullptr;
    const std::set<std::pair<std::string, std::string>>& known = (*facts_.new_words)[side].brought_before;
    if (known.contains({user.file, scope}) || known.contains({user.file, meaning.word})) return nullptr;
    const OpenedIn& opened = fresh_[side]->opened_now.find(scope)->second;
    const auto own = opened.by_file.find(user.file);
    return own == opened.by_file.end() ? opened.header : own->second;
}

void NewNames::tell(JudgedPair& pair, Side side, const Meaning& meaning) {
    const NewWord* said = meaning.reason == Reason::Opened ? opened_for(side, meaning, *pair.unit[side]) : meaning.said;
    const std::string key =
        "new name " + (meaning.unit != nullptr ? meaning.unit->id : meaning.word + " " + said->text());
    const std::string told_as = (side == Side::Source ? "source " : "target ") + key;
    if (told_.has_told(told_as)) {
        return;
    }
    Finding& finding =
        findings_.add(side == Side::Source ? Rule::SourceChanged : Rule::TargetChanged, pair, {}, "", key);
    finding.message =
        fmt::format("{} says something else, unedited: ", side == Side::Source ? "the source" : "the port") +
        change_of(meaning, said);
    const bool is_attribute = said != nullptr && said->said.kind == Kind::Attributed;
    finding.remedy = std::string(is_attribute ? "Say the same of the other side" : "Give it another name") +
                     "; if it is meant so, run: porttool ignore " +
                     argument(pair.id.source + "=" + pair.id.target, finding) + " --reason TEXT";
    if (said != nullptr) finding.details.push_back("+ " + said->text());
    told_.tell(told_as, finding);
}

std::string NewNames::change_of(const Meaning& meaning, const NewWord* said) {
    const std::string& word = meaning.word;
    const std::string place =
        said == nullptr ? "" : fmt::format("`{}` ({}:{})", said->text(), said->file->path, said->line());
    switch (meaning.reason) {
        case Reason::Said:
            if (said->said.kind == Kind::Attributed) return fmt::format("{} is declared as {} now", word, place);
            return fmt::format("its word {} is {} now", word, place);
        case Reason::Opened:
            return fmt::format("its {} may be {} now, by {}", word, meaning.unit->id, place);
        case Reason::Special:
            return fmt::format("its type {} has the new {}", word, meaning.unit->id);
        case Reason::Hidden:
            return fmt::format("its {} is the nearer new {} now", word, meaning.unit->id);
        case Reason::Competes:
        case Reason::Doubled:
            return fmt::format("its {} may be the new {} now", word, meaning.unit->id);
        case Reason::Taken:
            break;
    }
    return fmt::format("its {} {} is one of the new {} now", meaning.signature.is_function ? "call of" : "word", word,
                       meaning.unit->id);
}

void NewNames::tell_how_many() {
    told_.tell_how_many(findings_,
                        [](const std::string&, size_t more) { return "; so is that of " + more_pairs(more); });
}

}  // namespace porttool
