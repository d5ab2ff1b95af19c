// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/knowledge.h"

#include <algorithm>
#include <iterator>

#include "porttool/compare/paired_names.h"
#include "porttool/match/words.h"
#include "porttool/read/lock_lines.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/call_sites.h"
#include "porttool/sync/local_manner.h"
#include "porttool/sync/unit_words.h"

namespace porttool {
namespace {

constexpr size_t kMostWordsOfFile = 40000;  ///< that are learned from beside a pair
constexpr size_t kMostWordsOfFolder = 100000;
constexpr size_t kMostHeads = 2000;  ///< that are learned from all over a project

/// How many arguments a function takes.
size_t arguments_of(const NormalText& text) {
    size_t commas = 0, words = 0;
    int depth = 0;
    bool named = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const std::string_view word = text[i];
        if (!named) {
            named = word == "@";
            continue;
        }
        depth += word == "(" || word == "<" ? 1 : word == ")" || word == ">" ? -1 : 0;
        if (word == "{" || (depth == 0 && word == ")")) break;
        if (depth == 1 && word == ",") ++commas;
        ++words;
    }
    return words <= 1 ? 0 : commas + 1;
}

/// How a parameter says that the function may write what it is given.
bool says_handed_back(std::string_view word) { return word == "&" || word == "inout" || word == "out"; }

bool may_hand_back(const LexedText& lexed, const Unit& unit) {
    for (uint32_t i = unit.parameters.first; i < unit.parameters.end; ++i)
        if (says_handed_back(lexed.view(i))) return true;
    return false;
}

/// Which parameters of a function are references that it may write through.
std::vector<size_t> handed_back(const ScannedFile& file, const Unit& unit) {
    std::vector<size_t> out;
    const std::vector<TokenRange> all = parameters_of_head(file, unit);
    for (size_t place = 0; place < all.size(); ++place) {
        bool writes = false, constant = false;
        for (uint32_t i = all[place].first; i < all[place].end; ++i) {
            const std::string_view word = file.lexed.view(i);
            writes |= says_handed_back(word);
            constant |= word == "const";
        }
        if (writes && !constant) out.push_back(place);
    }
    return out;
}

std::map<std::string, const Unit*> units_by_id(const ScannedFile& file) {
    std::map<std::string, const Unit*> out;
    for (const Unit& unit : file.units) out.emplace(unit_id(file, unit), &unit);
    return out;
}

}  // namespace

Knowledge::Knowledge(const CheckedProject& checked)
    : checked_(checked),
      dialect_(dialect_of_edits(checked.project.map)),
      base_(dialect_),
      words_{SideWords(checked.project.source, dialect_), SideWords(checked.project.target, dialect_)} {
    for (const Side side : kBothSides)
        for (const ScannedFile& file : files(side)) by_path_[side].emplace(file.path, &file);
    for (const Side side : kBothSides)
        hands_back_[side] = [this, side](const std::string& function, size_t argument) {
            return is_handed_back(side, function, argument);
        };
}

bool Knowledge::is_handed_back(Side side, const std::string& function, size_t argument) {
    auto& known = written_arguments_[side];
    if (!known) {
        known.emplace();
        for (const ScannedFile& file : files(side))
            for (const Unit& unit : file.units)
                if (unit.kind == UnitKind::Function && may_hand_back(file.lexed, unit))
                    for (const size_t place : handed_back(file, unit))
                        (*known)[std::string(file.lexed.view(unit.name_token))].insert(place);
    }
    const auto found = known->find(function);
    return found != known->end() && found->second.contains(argument);
}

const ScannedFile* Knowledge::file_of(Side side, const std::string& path) const {
    const auto found = by_path_[side].find(path);
    return found == by_path_[side].end() ? nullptr : found->second;
}

const Unit* Knowledge::unit_of(const ScannedFile& file, const std::string& id) {
    return units_.try_emplace(&file, file).first->second.find(file, id);
}

const KnownWords& Knowledge::known_words(Side from, const ScannedFile& file, const ScannedFile& other) {
    std::unique_ptr<KnownWords>& known = known_[{&file, &other}];
    if (!known)
        known = std::make_unique<KnownWords>(WordsOfSide{words_[from], file},
                                             WordsOfSide{words_[other_side(from)], other}, dialect_);
    return *known;
}

bool Knowledge::makes_constants(const ScannedFile& file, const ScannedFile& other) {
    const auto [found, is_new] = makes_constants_.try_emplace({&file, &other});
    if (is_new) found->second = adds_const(file, other);
    return found->second;
}

const UnitNames& Knowledge::unit_names(Side from) {
    std::optional<UnitNames>& out = names_[from];
    if (out) return *out;
    out.emplace();
    const LinesByPair lines(checked_.lock);
    for (const JudgedPair& pair : checked_.judgement.pairs) {
        const Side to = other_side(from);
        if (pair.unit[from] == nullptr || pair.unit[to] == nullptr) continue;
        const std::string name(leaf_of(pair.unit[from]->name));
        out->names[name].emplace(leaf_of(pair.unit[to]->name));
        // A parameter that came to one side comes to the other with it.
        const LockedPair* line = lines.find(pair.id.source, pair.id.target);
        const auto recorded = [&](Side side) {
            const UnitState& unit = *pair.unit[side];
            if (line == nullptr) return arguments_of(unit.text);
            const Print print = (side == Side::Source ? line->source_prints : line->target_prints).written;
            if (print == unit.prints.written) return arguments_of(unit.text);
            const NormalText before = text_behind(checked_, print);
            return before.empty() ? arguments_of(unit.text) : arguments_of(before);
        };
        if (recorded(from) != recorded(to)) out->other_parameters.insert(name);
    }
    return *out;
}

/// Where the pairs are that did not change, in their order.
const Knowledge::PairPlaces& Knowledge::pair_places() {
    if (places_) return *places_;
    places_.emplace();
    const std::vector<JudgedPair>& pairs = checked_.judgement.pairs;
    for (size_t i = 0; i < pairs.size(); ++i) {
        if (pairs[i].changed || pairs[i].unit.source == nullptr || pairs[i].unit.target == nullptr) continue;
        for (const Side side : kBothSides) places_->in_file[side][pairs[i].unit[side]->file].push_back(i);
        places_->in_folders[{folder_of(pairs[i].unit.source->file), folder_of(pairs[i].unit.target->file)}].push_back(
            i);
    }
    return *places_;
}

void Knowledge::learn(Side from, size_t most_words, const std::vector<size_t>& pairs, Examples& out) const {
    const Side to = other_side(from);
    WordKeys keys(base_);
    size_t words = 0;
    for (const size_t place : pairs) {
        const JudgedPair& other = checked_.judgement.pairs[place];
        words += other.unit.source->text.size() + other.unit.target->text.size();
        if (words > most_words) break;
        const bool record = other.unit.source->kind == UnitKind::Struct;
        const UnitWords there = words_of_record(other.unit[to]->text);
        CalledForms forms;
        forms.add(Words(there.words.begin(), there.words.end()));
        const UnitWords here = in_forms_of(forms, words_of_record(other.unit[from]->text));
        const AlignedText a = keys.text(here.words, record), b = keys.text(there.words, record);
        out.learn(a, b, align(a, b, {}));
    }
}

const Examples& Knowledge::beside(const std::string& source_file, const std::string& target_file, Side from) {
    const auto [found, is_new] = beside_[from].try_emplace({source_file, target_file});
    if (!is_new) return found->second;
    const auto pairs_of = [&](Side side, const std::string& file) {
        const auto pairs = pair_places().in_file[side].find(file);
        return pairs == pair_places().in_file[side].end() ? std::vector<size_t>() : pairs->second;
    };
    const std::vector<size_t> here = pairs_of(Side::Source, source_file), there = pairs_of(Side::Target, target_file);
    std::vector<size_t> either;
    std::set_union(here.begin(), here.end(), there.begin(), there.end(), std::back_inserter(either));
    learn(from, kMostWordsOfFile, either, found->second);
    return found->second;
}

const Examples& Knowledge::in_folders(const std::string& source_file, const std::string& target_file, Side from) {
    const std::string source(folder_of(source_file)), target(folder_of(target_file));
    const auto [found, is_new] = in_folders_[from].try_emplace({source, target});
    if (!is_new) return found->second;
    const auto pairs = pair_places().in_folders.find({source, target});
    if (pairs != pair_places().in_folders.end()) learn(from, kMostWordsOfFolder, pairs->second, found->second);
    return found->second;
}

LearnedBeside Knowledge::learned_beside(Side from, const std::string& here, const std::string& there) {
    const BySide<std::string> file{from == Side::Source ? here : there, from == Side::Source ? there : here};
    return {[this, file, from]() -> const Examples& { return beside(file.source, file.target, from); },
            [this, file, from]() -> const Examples& { return in_folders(file.source, file.target, from); }};
}

void Knowledge::learn_heads(Side from, const ScannedFile* file, const ScannedFile* other, HeadManners& out) const {
    const Side to = other_side(from);
    std::map<const ScannedFile*, std::map<std::string, const Unit*>> units;
    const auto unit_of = [&](const ScannedFile& in, const std::string& id) -> const Unit* {
        const auto [found, is_new] = units.try_emplace(&in);
        if (is_new) found->second = units_by_id(in);
        const auto unit = found->second.find(id);
        return unit == found->second.end() ? nullptr : unit->second;
    };
    size_t count = 0;
    for (const JudgedPair& pair : checked_.judgement.pairs) {
        if (pair.changed || pair.unit[from] == nullptr || pair.unit[to] == nullptr) continue;
        if (file != nullptr && (pair.unit[from]->file != file->path || pair.unit[to]->file != other->path)) continue;
        const ScannedFile *here = file_of(from, pair.unit[from]->file), *there = file_of(to, pair.unit[to]->file);
        if (here == nullptr || there == nullptr || ++count > kMostHeads) continue;
        const Unit *unit = unit_of(*here, pair.unit[from]->id), *port = unit_of(*there, pair.unit[to]->id);
        if (unit != nullptr && port != nullptr) out.learn(*here, *unit, *there, *port);
    }
}

const HeadManners& Knowledge::heads_beside(Side from, const ScannedFile& file, const ScannedFile& other) {
    const auto [found, is_new] = heads_beside_.try_emplace({&file, &other});
    if (is_new) learn_heads(from, &file, &other, found->second);
    return found->second;
}

const HeadManners& Knowledge::heads(Side from) {
    if (!heads_[from]) learn_heads(from, nullptr, nullptr, heads_[from].emplace());
    return *heads_[from];
}

void Knowledge::set_fresh(const std::vector<FreshIds>& pairs) {
    for (const Side from : kBothSides) {
        (void)unit_names(from);
        for (const std::string& name : fresh_names_[from]) names_[from]->names.erase(name);
        fresh_names_[from].clear();
    }
    dialect_ = base_;
    std::vector<std::pair<std::string, std::string>> counterparts;
    for (const FreshIds& pair : pairs) {
        const std::string source(leaf_of(split_id(pair.id.source).second)),
            target(leaf_of(split_id(pair.id.target).second));
        const std::string &here = pair.from == Side::Source ? source : target,
                          &there = pair.from == Side::Source ? target : source;
        // As dialect_of_edits() has it of the map with these pairs; nothing else has their names.
        const bool is_plain = source != target && !names_.source->names.contains(target) &&
                              !names_.target->names.contains(source) && base_.meaning(source) == nullptr &&
                              base_.meaning(target) == nullptr;
        if (is_plain) counterparts.emplace_back(source, target);
        names_[pair.from]->names[here] = {there};
        fresh_names_[pair.from].insert(here);
    }
    dialect_.add_counterparts(counterparts);
}

}  // namespace porttool
