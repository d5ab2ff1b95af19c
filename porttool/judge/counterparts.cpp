// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/counterparts.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "porttool/match/match.h"
#include "porttool/match/words.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

using Files = std::vector<ScannedFile>;

constexpr size_t kMostTokens = 500'000;  // of one side that are matched: about 50,000 lines
constexpr size_t kMostOfRelatives = 250'000;
constexpr float kMostOfPaired = 0.89f;  // a target that has its source already is a guess

/// Files of one side, by their numbers there in order, until there are too many tokens in them; those with more
/// `better` first, and of those without it `least` any.
std::set<size_t> limited(const FilesOfSide& files, const std::vector<size_t>& numbers,
                         const std::vector<size_t>& better, size_t most = kMostTokens, size_t least = 0) {
    std::vector<size_t> order(numbers.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return better[a] > better[b]; });
    std::set<size_t> kept;
    size_t tokens = 0;
    for (const size_t i : order) {
        tokens += files.tokens(numbers[i]);
        if ((tokens > most && !kept.empty()) || better[i] < least) break;
        kept.insert(numbers[i]);
    }
    return kept;
}

/// The words of names that are looked for which names of a file have, or its own.
std::vector<std::set<std::string>> shared_words(const FilesOfSide& files, const std::vector<size_t>& numbers,
                                                const std::vector<const UnitState*>& fresh) {
    std::unordered_set<std::string> wanted;
    for (const UnitState* unit : fresh) {
        for (std::string& word : split_words(unit->name)) wanted.insert(std::move(word));
        for (std::string& word : split_words(file_stem(unit->file))) wanted.insert(std::move(word));
    }
    std::vector<std::set<std::string>> out;
    for (const size_t file : numbers) {
        std::set<std::string>& found = out.emplace_back();
        const auto look = [&](std::string_view name) {
            for (const std::string& word : split_words(name))
                if (wanted.contains(word)) found.insert(word);
        };
        look(file_stem(files.path(file)));
        for (const std::string_view name : files.unit_names(file)) look(name);
    }
    return out;
}

std::vector<size_t> how_many(const std::vector<std::set<std::string>>& words) {
    std::vector<size_t> out;
    for (const std::set<std::string>& of_file : words) out.push_back(of_file.size());
    return out;
}

/// The same where a word counts the more the fewer files have it: every shader has `main`.
std::vector<size_t> how_rare(const std::vector<std::set<std::string>>& words) {
    constexpr size_t kOfOne = 1'000'000;
    std::unordered_map<std::string_view, size_t> files;
    for (const std::set<std::string>& of_file : words)
        for (const std::string& word : of_file) ++files[word];
    std::vector<size_t> out;
    for (const std::set<std::string>& of_file : words) {
        size_t& sum = out.emplace_back();
        for (const std::string& word : of_file) sum += kOfOne / files[word];
    }
    return out;
}

class Search {
public:
    Search(const Case& facts, const std::vector<JudgedPair>& pairs, Side side, const TargetSets& sets,
           const std::string& set, const std::vector<const UnitState*>& fresh)
        : facts_(facts), side_(side), dialect_(facts.map.dialect) {
        std::set<std::string> paths;
        for (const UnitState* unit : fresh) {
            open_.emplace(unit->id, unit);
            paths.insert(unit->file);
        }
        const FilesOfSide &here = (*facts.files)[side], &there = (*facts.files)[other(side)];
        for (size_t i = 0; i < here.size(); ++i)
            if (paths.contains(here.path(i))) files_[side].push_back(here.scanned(i));
        const bool one_port = side == Side::Source && !set.empty();
        std::vector<size_t> numbers;
        for (size_t i = 0; i < there.size(); ++i)
            if (!one_port || sets.of_path(there.path(i)) == set) numbers.push_back(i);
        for (const size_t i : limited(there, numbers, how_many(shared_words(there, numbers, fresh))))
            files_[other(side)].push_back(there.scanned(i));
        for (const JudgedPair& pair : pairs) {
            if (pair.unit.source == nullptr || pair.unit.target == nullptr) continue;
            if (sets.of_id(pair.id.target) != set) continue;
            pairs_.emplace_back(pair.unit.source->id, pair.unit.target->id);
            partner_.emplace(pair.unit[other(side)]->id, pair.unit[side]->id);
        }
    }

    Counterparts run() {
        take(match({pairs_, ignored()}), 1);
        if (!open_.empty()) take(match({others(), ignored()}), kMostOfPaired);
        if (add_relatives()) take(match({pairs_, ignored(), true}), kMostOfPaired);
        return std::move(out_);
    }

private:
    std::vector<std::string> ignored() const {
        std::vector<std::string> out;
        for (const MapIgnore& ignore : facts_.map.ignores) out.push_back(ignore.id);
        return out;
    }

    /// All units of this side but those that are still looked for, as if they were settled.
    std::vector<std::pair<std::string, std::string>> others() const {
        std::vector<std::pair<std::string, std::string>> out;
        for (const ScannedFile& file : files_[side_])
            for (const Unit& unit : file.units) {
                const std::string id = unit_id(file, unit);
                if (open_.contains(id)) continue;
                out.emplace_back(side_ == Side::Source ? id : "", side_ == Side::Source ? "" : id);
            }
        return out;
    }

    /// Takes in files of this side that have a word of what is still looked for: a variant of a unit that has its port
    /// is known by what that is, `padding_pack4.comp` by `padding.comp`. False if there is nothing to look for, or
    /// none.
    bool add_relatives() {
        std::vector<const UnitState*> left;
        for (const auto& [id, unit] : open_)
            if (unit->kind != UnitKind::Constant) left.push_back(unit);
        if (left.empty()) return false;
        std::set<std::string_view> known;
        for (const ScannedFile& file : files_[side_]) known.insert(file.path);
        const FilesOfSide& here = (*facts_.files)[side_];
        std::vector<size_t> numbers;
        for (size_t i = 0; i < here.size(); ++i)
            if (!known.contains(here.path(i))) numbers.push_back(i);
        const std::set<size_t> more =
            limited(here, numbers, how_rare(shared_words(here, numbers, left)), kMostOfRelatives, 1);
        for (const size_t i : more) files_[side_].push_back(here.scanned(i));
        return !more.empty();
    }

    /// True if the counterpart is named as its partner is, and not as the unit: `load_q8` is the port of `load_q8`, and
    /// `load_q1` is one more of their kind.
    static bool is_sibling(const UnitState& unit, const std::string& partner_id, const UnitState& counterpart) {
        const auto subject = [](std::string_view name) {
            std::vector<std::string> words = split_words(leaf_of(name));
            std::erase_if(words, [](const std::string& word) { return tells_how(word); });
            return words;
        };
        const std::vector<std::string> there = subject(counterpart.name);
        return !there.empty() && there == subject(split_id(partner_id).second) && there != subject(unit.name);
    }

    /// What a project computes once more to check its kernels with resembles what ports them.
    static bool is_reference_of(const UnitState& unit, const UnitState& counterpart) {
        const std::vector<std::string> there = split_words(counterpart.name);
        for (const std::string& word : split_words(unit.name))
            if (marks_reference(word) && std::find(there.begin(), there.end(), word) == there.end()) return true;
        return false;
    }

    using Places = std::pair<std::string_view, std::string_view>;  ///< a file or folder of each side

    static std::string_view folder_of(std::string_view file) { return file.substr(0, file.rfind('/') + 1); }

    /// The files, and the folders, of both sides that are tied to each other by functions, kernels or structs: by
    /// pairs, and by units that look alike and of which the other side's is in no pair.
    std::set<Places> tied_places(const Matching& matching) const {
        std::set<Places> out;
        for (const MatchedPair& pair : matching.pairs) {
            const auto source = facts_.source.find(pair.source), target = facts_.target.find(pair.target);
            if (source == facts_.source.end() || target == facts_.target.end()) continue;
            const UnitState &here = source->second, &there = target->second;
            if (here.kind == UnitKind::Constant || there.kind == UnitKind::Constant) continue;
            const bool is_pair = pair.state == PairState::Confirmed;
            if (!is_pair && partner_.contains(side_ == Side::Source ? there.id : here.id)) continue;
            out.insert({here.file, there.file});
            out.insert({folder_of(here.file), folder_of(there.file)});
        }
        return out;
    }

    /// A helper that many places have for themselves, as copies, is ported where their own units are: a constant in the
    /// same file, a function or struct in the same folder.
    bool is_anothers(const UnitState& unit, const UnitState& counterpart, const std::string& partner_id,
                     const std::set<Places>& tied) const {
        if (unit.kind == UnitKind::Kernel) return false;
        const auto place = [&](std::string_view file) {
            return unit.kind == UnitKind::Constant ? file : folder_of(file);
        };
        const std::string_view here = place(unit.file), there = place(counterpart.file);
        if (place(split_id(partner_id).first) == here) return false;
        return !tied.contains(side_ == Side::Source ? Places(here, there) : Places(there, here));
    }

    Matching match(const Settled& settled) const {
        return match_units(files_.source, files_.target, settled, dialect_);
    }

    void take(const Matching& matching, float most) {
        const auto& there = side_ == Side::Source ? facts_.target : facts_.source;
        const std::set<Places> tied = tied_places(matching);
        std::vector<std::string> found;
        for (const MatchedPair& pair : matching.pairs) {
            if (pair.state == PairState::Confirmed) continue;
            const auto open = open_.find(side_ == Side::Source ? pair.source : pair.target);
            const auto unit = there.find(side_ == Side::Source ? pair.target : pair.source);
            if (open == open_.end() || unit == there.end()) continue;
            const auto partner = partner_.find(unit->first);
            if (partner != partner_.end() && (is_reference_of(*open->second, unit->second) ||
                                              is_sibling(*open->second, partner->second, unit->second) ||
                                              is_anothers(*open->second, unit->second, partner->second, tied)))
                continue;
            Counterpart& best = out_[open->second];
            if (best.unit != nullptr && best.score >= pair.score) continue;
            best = {&unit->second, std::min(pair.score, most), partner == partner_.end() ? "" : partner->second};
            found.push_back(open->first);
        }
        for (const std::string& id : found) open_.erase(id);
    }

    const Case& facts_;
    Side side_;
    Dialect dialect_;
    BySide<Files> files_;
    std::unordered_map<std::string, const UnitState*> open_;  ///< by id: without a counterpart so far
    std::vector<std::pair<std::string, std::string>> pairs_;
    std::unordered_map<std::string, std::string> partner_;  ///< of units of the other side
    Counterparts out_;
};

}  // namespace

Counterparts find_counterparts(const Case& facts, const std::vector<JudgedPair>& pairs, Side side,
                               const TargetSets& sets, const std::string& set,
                               const std::vector<const UnitState*>& fresh) {
    if (fresh.empty() || !facts.files) return {};
    return Search(facts, pairs, side, sets, set, fresh).run();
}

}  // namespace porttool
