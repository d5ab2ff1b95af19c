// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/call_carrier.h"

#include <algorithm>
#include <optional>

#include "porttool/normal/normal_text.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/file_text.h"

namespace porttool {
namespace {

std::string function_name(const std::string& unit) { return std::string(bare_leaf_of(unit)); }

std::string tokens_text(const LexedText& lexed, TokenRange range) {
    if (range.empty()) return {};
    const Token &first = lexed.tokens[range.first], &last = lexed.tokens[range.end - 1];
    return lexed.text.substr(first.offset, last.offset + last.length - first.offset);
}

/// The parameters of a normal text's head.
std::vector<std::string> parameters_of_text(const NormalText& text) {
    std::vector<std::string> out;
    size_t i = 0;
    while (i < text.size() && text[i] != "@") ++i;
    while (i < text.size() && text[i] != "(") ++i;
    std::string one;
    int depth = 0;
    for (++i; i < text.size(); ++i) {
        const std::string_view word = text[i];
        const bool ends = depth == 0 && (word == "," || word == ")");
        depth += word == "(" || word == "<" || word == "[" ? 1 : word == ")" || word == ">" || word == "]" ? -1 : 0;
        if (ends && !one.empty() && one != " void") out.push_back(one);
        if (ends) one.clear();
        if (ends && word == ")") break;
        if (!ends) one += " " + std::string(word);
    }
    return out;
}

/// Where in `now` what `before` has not stands; none if that lost something as well.
std::optional<std::vector<size_t>> gained(const std::vector<std::string>& before, const std::vector<std::string>& now) {
    std::vector<size_t> out;
    size_t i = 0;
    for (size_t k = 0; k < now.size(); ++k)
        if (i < before.size() && before[i] == now[k])
            ++i;
        else
            out.push_back(k);
    if (i < before.size()) return std::nullopt;
    return out;
}

/// True for what is the same wherever it stands: a number, or a word of the language for one.
bool is_literal(const std::string& text) {
    const std::string_view number = std::string_view(text).substr(text.starts_with("-") ? 1 : 0);
    return is_number_token(number) ? number.find(' ') == std::string_view::npos
                                   : text == "true" || text == "false" || text == "nullptr" || text == "NULL";
}

}  // namespace

CallCarrier::CallCarrier(const CheckedProject& checked, Knowledge& knowledge, Drafts& drafts)
    : checked_(checked), knowledge_(knowledge), drafts_(drafts), sets_(checked.project.map) {
    for (size_t i = 0; i < checked.judgement.pairs.size(); ++i)
        for (const Side side : kBothSides)
            if (const UnitState* unit = checked.judgement.pairs[i].unit[side]; unit != nullptr)
                paired_[side][unit->id].push_back(i);
}

/// The unit of a name, of the port that a file is of; nullptr for none, and for several: what goes wrong where a name
/// means several functions is not told.
const UnitState* CallCarrier::only_one(Side side, const std::string& file, const std::string& name) {
    const auto set_of = [&](const std::string& path) {
        return side == Side::Target ? sets_.of_path(path) : std::string();
    };
    if (only_[side].empty())
        for (const auto& [id, state] : checked_.states[side]) {
            if (state.kind == UnitKind::File) continue;
            const auto [found, is_new] =
                only_[side].try_emplace({set_of(state.file), function_name(state.name)}, &state);
            if (!is_new) found->second = nullptr;
        }
    const auto found = only_[side].find({set_of(file), name});
    return found == only_[side].end() ? nullptr : found->second;
}

bool CallCarrier::is_only_one(const JudgedPair& pair, Side side) {
    return only_one(side, pair.unit[side]->file, function_name(pair.unit[side]->name)) != nullptr;
}

std::vector<std::string> CallCarrier::parameters_now(const JudgedPair& pair, Side to) {
    const ScannedFile* file = knowledge_.file_of(to, pair.unit[to]->file);
    if (file == nullptr || (pair.unit[to]->kind != UnitKind::Function && pair.unit[to]->kind != UnitKind::Kernel))
        return {};
    Draft& draft = drafts_.of(to, *file);
    const ScannedFile& now = draft.scanned;
    const Unit* unit = draft.unit(pair.unit[to]->id);
    std::vector<std::string> out;
    if (unit != nullptr)
        for (const TokenRange one : parameters_of_head(now, *unit)) out.push_back(tokens_text(now.lexed, one));
    return out;
}

void CallCarrier::begin(const JudgedPair& pair, Side from, const NormalText& before) {
    from_[&pair] = from;
    before_ = parameters_now(pair, other_side(from));
    const size_t old_count = parameters_of_text(before).size(),
                 new_count = parameters_of_text(pair.unit[from]->text).size();
    const UnitKind kind = pair.unit[from]->kind;
    const bool is_function = kind == UnitKind::Function || kind == UnitKind::Kernel;
    if (is_function && old_count != new_count && is_only_one(pair, other_side(from)))
        wanted_.push_back({&pair, from, before_.size(), before_.size() + new_count - old_count});
}

template <class Take>
void CallCarrier::each_site(const JudgedPair& pair, Side side, const Take& take) {
    const std::string name = function_name(pair.unit[side]->name);
    const std::string& set = sets_.of_path(pair.unit[side]->file);
    const ScannedFile* own = knowledge_.file_of(side, pair.unit[side]->file);
    const Unit* unit = own == nullptr ? nullptr : unit_named(*own, pair.unit[side]->id);
    const bool of_class = unit != nullptr && unit->name.size() > unit->namespace_length + name.size() + 2;
    for (const ScannedFile& file : knowledge_.files(side)) {
        if (side == Side::Target && sets_.of_path(file.path) != set) continue;
        if (file.lexed.text.find(name) == std::string::npos) continue;
        const Draft* draft = drafts_.find(side, file.path);
        const ScannedFile& now = draft == nullptr ? file : draft->scanned;
        for (const CallSite& site : call_sites(now, name, of_class)) take(file, now, site);
    }
}

/// What calls of the source's function that no pair covers all give; "" unless that is one literal.
std::string CallCarrier::certain_argument(const JudgedPair& pair, Side from, size_t count, size_t place) {
    std::set<std::string> uncovered, covered;
    size_t covered_calls = 0;
    each_site(pair, from, [&](const ScannedFile& file, const ScannedFile& now, const CallSite& site) {
        if (site.declares || site.arguments.size() != count) return;
        const Unit* unit = unit_around(now, site.name);
        const bool is_covered = unit != nullptr && is_paired(from, unit_id(file, *unit));
        (is_covered ? covered : uncovered).insert(tokens_text(now.lexed, site.arguments[place]));
        covered_calls += is_covered;
    });
    const std::set<std::string>& all = uncovered.empty() ? covered : uncovered;
    if (all.size() != 1 || (uncovered.empty() && covered_calls < 2) || !is_literal(*all.begin())) return {};
    const std::string& text = *all.begin();
    if (!is_number_token(text)) return text;
    const Examples& examples = knowledge_.beside(pair.unit.source->file, pair.unit.target->file, from);
    if (examples.knows_mark_of(text)) return examples.number(text);
    const ScannedFile *file = knowledge_.file_of(from, pair.unit[from]->file),
                      *other = knowledge_.file_of(other_side(from), pair.unit[other_side(from)]->file);
    if (file == nullptr || other == nullptr) return {};
    return knowledge_.known_words(from, *file, *other).needs_float_marks() ? Examples::marked(text) : text;
}

void CallCarrier::edit_sites(const JudgedPair& pair, Side to, size_t old_count, const std::vector<Added>& added) {
    std::map<const ScannedFile*, std::vector<TextEdit>> edits;
    const bool certain =
        std::all_of(added.begin(), added.end(), [](const Added& one) { return !one.argument.empty(); });
    each_site(pair, to, [&](const ScannedFile& file, const ScannedFile& now, const CallSite& site) {
        if (site.arguments.size() != old_count || (!site.declares && !certain)) return;
        const Unit* unit = unit_around(now, site.name);
        if (unit != nullptr && is_paired(to, unit_id(now, *unit))) return;
        for (const Added& one : added) {
            const std::string& text = site.declares ? one.parameter : one.argument;
            const bool first = one.place == 0;
            const uint32_t token = first ? (site.arguments.empty() ? site.close : site.arguments[0].first)
                                         : site.arguments[one.place - 1].end - 1;
            const Token& there = now.lexed.tokens[token];
            const size_t at = first ? there.offset : there.offset + there.length;
            edits[&file].push_back({at, at, first ? text + (site.arguments.empty() ? "" : ", ") : ", " + text});
        }
    });
    for (auto& [file, list] : edits) {
        // A call within an argument of another comes later, and ends before it.
        std::stable_sort(list.begin(), list.end(),
                         [](const TextEdit& a, const TextEdit& b) { return a.first < b.first; });
        Draft& draft = drafts_.of(to, *file);
        if (draft.is_linked) continue;
        const std::optional<std::string> now = edit_file(draft.bytes, draft.scanned.lexed.text, list);
        if (!now) continue;
        ScannedFile scanned = scan_text(file->path, *now);
        if (scanned.units.size() == draft.scanned.units.size()) drafts_.write(draft, *now, std::move(scanned));
    }
}

void CallCarrier::carry(const JudgedPair& pair, Side from, const NormalText& before) {
    const Side to = other_side(from);
    const std::vector<std::string> now = parameters_now(pair, to);
    if (now == before_ || now.size() == before_.size() || !is_only_one(pair, to)) return;
    changed_.push_back({&pair, from, before_.size(), now.size()});
    const std::optional<std::vector<size_t>> fresh = gained(before_, now);
    const std::optional<std::vector<size_t>> of_source =
        gained(parameters_of_text(before), parameters_of_text(pair.unit[from]->text));
    if (!fresh) return;
    const bool alike = of_source && of_source->size() == fresh->size() && is_only_one(pair, from);
    const size_t count = parameters_of_text(pair.unit[from]->text).size();
    std::vector<Added> added;
    for (size_t i = 0; i < fresh->size(); ++i) {
        if (now[(*fresh)[i]].find('=') != std::string::npos) return;  // calls need not give it
        added.push_back({(*fresh)[i] - i, now[(*fresh)[i]],
                         alike ? certain_argument(pair, from, count, (*of_source)[i]) : std::string()});
    }
    edit_sites(pair, to, before_.size(), added);
}

/// Calls that were left as they are.
void CallCarrier::tell_old_calls(const Changed& one, const Places& places, std::vector<Proposal>& proposals) {
    Proposal& proposal = proposals[places.at(static_cast<size_t>(one.pair - checked_.judgement.pairs.data()))];
    const Side to = other_side(one.from);
    each_site(*one.pair, to, [&](const ScannedFile& file, const ScannedFile& now, const CallSite& site) {
        if (site.arguments.size() != one.old_count) return;
        const Unit* unit = unit_around(now, site.name);
        const std::string id = unit == nullptr ? file.path : unit_id(now, *unit);
        if (unit != nullptr && is_paired(to, id))
            for (const size_t other : paired_[to].at(id)) {
                const auto found = places.find(other);
                const bool is_due = checked_.judgement.pairs[other].changed && found == places.end();
                if (is_due) proposal.why.push_back("`" + id + "` calls it and is out of step itself");
                if (is_due || (found != places.end() && !proposals[found->second].left.empty())) return;
            }
        const uint32_t line = now.lexed.tokens[site.name].line, head = one.pair->unit[one.from]->start_line;
        proposal.left.push_back(
            {"`" + function_name(one.pair->unit[to]->name) + "` takes " + std::to_string(one.new_count) +
                 " arguments now; it is " + (site.declares ? "declared" : "called") + " with " +
                 std::to_string(one.old_count) + " in `" + id + "`, line " + std::to_string(line) + " of " + file.path,
             to == Side::Target ? head : line, to == Side::Target ? line : head});
        proposal.state = ProposalState::Partial;
    });
}

/// Calls that a proposal has made new, of a function whose head stays as it was.
void CallCarrier::tell_early_calls(const Changed& one, const Places& places, std::vector<Proposal>& proposals) {
    const Side to = other_side(one.from);
    each_site(*one.pair, to, [&](const ScannedFile&, const ScannedFile& now, const CallSite& site) {
        const Unit* unit = unit_around(now, site.name);
        if (unit == nullptr || site.arguments.size() != one.new_count || !is_paired(to, unit_id(now, *unit))) return;
        for (const size_t other : paired_[to].at(unit_id(now, *unit))) {
            const auto found = places.find(other);
            if (found == places.end() || proposals[found->second].state != ProposalState::Proposed) continue;
            const JudgedPair& pair = checked_.judgement.pairs[other];
            Proposal& proposal = proposals[found->second];
            proposal.left.push_back({"it calls `" + function_name(one.pair->unit[to]->name) + "` with " +
                                         std::to_string(one.new_count) + " arguments, whose own port is left",
                                     pair.unit.source->start_line, pair.unit.target->start_line});
            proposal.state = ProposalState::Partial;
        }
    });
}

bool CallCarrier::is_out_of_step(Side side, const std::string& id) const {
    const auto pairs = paired_[side].find(id);
    return pairs != paired_[side].end() && std::any_of(pairs->second.begin(), pairs->second.end(), [&](size_t pair) {
               return checked_.judgement.pairs[pair].changed;
           });
}

/// True unless a function surely takes another number of arguments.
bool CallCarrier::takes(const UnitState& function, Side side, size_t count) {
    const ScannedFile* file = knowledge_.file_of(side, function.file);
    if (file == nullptr || (function.kind != UnitKind::Function && function.kind != UnitKind::Kernel)) return true;
    const Draft* draft = drafts_.find(side, function.file);
    const ScannedFile& now = draft == nullptr ? *file : draft->scanned;
    const Unit* unit = unit_named(now, function.id);
    if (unit == nullptr) return true;
    const std::string name = function_name(function.name);
    const bool of_class = unit->name.size() > unit->namespace_length + name.size() + 2;
    const auto is_open = [](const LexedText& lexed, TokenRange range) {
        for (uint32_t i = range.first; i < range.end; ++i)
            if (lexed.view(i) == "=" || lexed.view(i) == "..." || lexed.view(i) == "#") return true;
        return false;
    };
    if (of_class || is_open(now.lexed, unit->parameters) || parameters_of_head(now, *unit).size() == count) return true;
    bool has_defaults = false;
    for (const ScannedFile& one : knowledge_.files(side)) {
        if (one.lexed.text.find(name) == std::string::npos) continue;
        for (const CallSite& site : call_sites(one, name, false))
            has_defaults |= site.declares && is_open(one.lexed, {site.name, site.close});
    }
    return has_defaults;
}

/// What a unit calls with another number of arguments than the only function of that name takes. What an edit of its
/// own may still change is passed over.
CallCarrier::Calls CallCarrier::misfitting_calls(const ScannedFile& file, const Unit& unit, Side side) {
    Calls out;
    for (const CallSite& site : calls_within(file, unit)) {
        const std::string name(file.lexed.view(site.name));
        const UnitState* function = only_one(side, file.path, name);
        if (function != nullptr && !is_out_of_step(side, function->id) &&
            !takes(*function, side, site.arguments.size()))
            out.emplace(name, site.arguments.size());
    }
    return out;
}

/// Calls that a proposal has made and that do not compile.
void CallCarrier::tell_misfits(const JudgedPair& pair, Side from, Proposal& proposal) {
    const Side to = other_side(from);
    const ScannedFile *file = knowledge_.file_of(to, pair.unit[to]->file),
                      *other = knowledge_.file_of(from, pair.unit[from]->file);
    const Draft* draft = drafts_.find(to, pair.unit[to]->file);
    if (file == nullptr || other == nullptr || draft == nullptr) return;
    const Unit *unit = unit_named(draft->scanned, pair.unit[to]->id), *before = unit_named(*file, pair.unit[to]->id),
               *source = unit_named(*other, pair.unit[from]->id);
    if (unit == nullptr || before == nullptr || source == nullptr) return;
    const Calls known = misfitting_calls(*file, *before, to);
    const auto line_of = [](const ScannedFile& text, const Unit& within, const std::string& name) {
        for (const CallSite& site : calls_within(text, within))
            if (text.lexed.view(site.name) == name) return text.lexed.tokens[site.name].line;
        return text.lexed.tokens[within.name_token].line;
    };
    for (const auto& [name, count] : misfitting_calls(draft->scanned, *unit, to)) {
        if (known.contains({name, count})) continue;
        const uint32_t here = line_of(*other, *source, name), there = line_of(*file, *before, name);
        proposal.left.push_back({"it would call `" + name + "` with " + std::to_string(count) +
                                     " arguments, which takes another number of them there",
                                 from == Side::Source ? here : there, from == Side::Source ? there : here});
        proposal.state = ProposalState::Partial;
    }
}

bool CallCarrier::gives_nothing(const UnitState& function, Side side, bool by_now) {
    const ScannedFile* file = knowledge_.file_of(side, function.file);
    if (file == nullptr || function.kind != UnitKind::Function) return false;
    const Draft* draft = by_now ? drafts_.find(side, function.file) : nullptr;
    const ScannedFile& now = draft == nullptr ? *file : draft->scanned;
    const Unit* unit = unit_named(now, function.id);
    if (unit == nullptr) return false;
    for (uint32_t i = unit->tokens.first; i < unit->name_token; ++i)
        if (now.lexed.view(i) == "void") return now.lexed.view(i + 1) != "*";
    return false;
}

std::map<const UnitState*, size_t> CallCarrier::values_taken(const ScannedFile& file, const Unit& unit, Side side) {
    std::map<const UnitState*, size_t> out;
    for (const CallSite& site : calls_within(file, unit)) {
        if (!takes_value(file.lexed.view(site.name - 1))) continue;
        const UnitState* function = only_one(side, file.path, std::string(file.lexed.view(site.name)));
        if (function != nullptr && gives_nothing(*function, side, false)) ++out[function];
    }
    return out;
}

/// A whole port stays as it is, beside what has to come first; a part of one does without the value.
void CallCarrier::tell_values_of_nothing(const JudgedPair& pair, Side from, const Places& places,
                                         std::vector<Proposal>& proposals) {
    const Side to = other_side(from);
    Proposal& proposal = proposals[places.at(static_cast<size_t>(&pair - checked_.judgement.pairs.data()))];
    const ScannedFile* file = knowledge_.file_of(to, pair.unit[to]->file);
    const Draft* draft = drafts_.find(to, pair.unit[to]->file);
    if (file == nullptr || draft == nullptr) return;
    const Unit *unit = unit_named(draft->scanned, pair.unit[to]->id), *before = unit_named(*file, pair.unit[to]->id);
    if (unit == nullptr || before == nullptr) return;
    const auto is_left = [&](const UnitState& function) {
        const auto own = paired_[to].find(function.id);
        return own != paired_[to].end() && std::any_of(own->second.begin(), own->second.end(), [&](size_t one) {
                   const auto found = places.find(one);
                   return found != places.end() && !proposals[found->second].left.empty();
               });
    };
    std::map<const UnitState*, size_t> known = values_taken(*file, *before, to);
    for (const auto& [function, times] : values_taken(draft->scanned, *unit, to)) {
        if (times <= known[function]) continue;
        const std::string name = function_name(function->name);
        const bool gives_none = gives_nothing(*function, to, true);
        if (gives_none && proposal.state == ProposalState::Partial) valueless_.insert({pair.unit[to]->id, name});
        if (gives_none || is_left(*function))
            proposal.why.push_back("it takes a value of `" + name + "`, which has to give one first");
    }
}

void CallCarrier::tell(const std::vector<size_t>& pairs, std::vector<Proposal>& proposals) {
    Places places;
    for (size_t i = 0; i < pairs.size(); ++i) places[pairs[i]] = i;
    for (const Changed& one : changed_) tell_old_calls(one, places, proposals);
    for (const Changed& one : wanted_) {
        const Proposal& proposal =
            proposals[places.at(static_cast<size_t>(one.pair - checked_.judgement.pairs.data()))];
        const bool is_left = proposal.state == ProposalState::Refused || proposal.state == ProposalState::Partial;
        const bool changed =
            std::any_of(changed_.begin(), changed_.end(), [&](const Changed& other) { return other.pair == one.pair; });
        if (is_left && !changed) tell_early_calls(one, places, proposals);
    }
    for (size_t i = 0; i < pairs.size(); ++i) {
        const JudgedPair& pair = checked_.judgement.pairs[pairs[i]];
        const auto from = from_.find(&pair);
        if (from == from_.end()) continue;
        if (proposals[i].state == ProposalState::Proposed) tell_misfits(pair, from->second, proposals[i]);
        const bool writes =
            proposals[i].state == ProposalState::Proposed || proposals[i].state == ProposalState::Partial;
        if (writes) tell_values_of_nothing(pair, from->second, places, proposals);
    }
}

}  // namespace porttool
