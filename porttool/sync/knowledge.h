// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What the pairs of a project tell of how one side says what the other says; each thing is learned when it is asked
// for.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "porttool/judge/check_project.h"
#include "porttool/sync/drafts.h"
#include "porttool/sync/examples.h"
#include "porttool/sync/head_manner.h"
#include "porttool/sync/known_words.h"
#include "porttool/sync/local_writes.h"
#include "porttool/sync/proposal.h"
#include "porttool/sync/translator.h"

namespace porttool {

constexpr Side other_side(Side side) { return side == Side::Source ? Side::Target : Side::Source; }

class Knowledge {
public:
    /// Must outlive it.
    explicit Knowledge(const CheckedProject& checked);
    Knowledge(const Knowledge&) = delete;
    Knowledge& operator=(const Knowledge&) = delete;

    const Dialect& dialect() const { return dialect_; }
    const std::vector<ScannedFile>& files(Side side) const {
        return side == Side::Source ? checked_.project.source : checked_.project.target;
    }
    const ScannedFile* file_of(Side side, const std::string& path) const;
    /// A unit of such a file; nullptr for none.
    const Unit* unit_of(const ScannedFile& file, const std::string& id);

    /// The words of a file, as it was before this run.
    const KnownWords& known_words(Side from, const ScannedFile& file, const ScannedFile& other);
    /// True if `other` declares locals `const` where `file` does not, as they were before this run.
    bool makes_constants(const ScannedFile& file, const ScannedFile& other);
    /// What the units of one side are called on the other.
    const UnitNames& unit_names(Side from);
    /// What other pairs of the same two files say alike. Those that changed do not count, so it is the same for each
    /// pair of two files.
    const Examples& beside(const std::string& source_file, const std::string& target_file, Side from);
    /// The same of pairs between the same two folders, within bounds.
    const Examples& in_folders(const std::string& source_file, const std::string& target_file, Side from);
    /// Both, for a unit of `here` and its port in `there`.
    LearnedBeside learned_beside(Side from, const std::string& here, const std::string& there);
    /// Which arguments functions of a side may write through a reference.
    const HandsBack& hands_back(Side side) const { return hands_back_[side]; }

    /// How heads are written: by the pairs of two files of the sides `from` and the other, by all pairs.
    const HeadManners& heads_beside(Side from, const ScannedFile& file, const ScannedFile& other);
    const HeadManners& heads(Side from);

    /// Pairs that this run brings, in place of those that it brought before: their names are known, and one to the
    /// dialect.
    struct FreshIds {
        Side from;
        BySide<std::string> id;
    };
    void set_fresh(const std::vector<FreshIds>& pairs);

    /// What parts of ports do without.
    const Valueless& valueless() const { return valueless_; }
    /// True if any of these are new.
    bool add_valueless(const Valueless& functions) {
        const size_t known = valueless_.size();
        valueless_.insert(functions.begin(), functions.end());
        return valueless_.size() > known;
    }

private:
    bool is_handed_back(Side side, const std::string& function, size_t argument);
    void learn_heads(Side from, const ScannedFile* file, const ScannedFile* other, HeadManners& out) const;

    const CheckedProject& checked_;
    Dialect dialect_;
    Dialect base_;  ///< without pairs that this run brings
    BySide<SideWords> words_;
    BySide<HandsBack> hands_back_;
    /// By the function's name; overloads together.
    BySide<std::optional<std::unordered_map<std::string, std::set<size_t>>>> written_arguments_;
    BySide<std::optional<UnitNames>> names_;
    BySide<std::set<std::string>> fresh_names_;
    std::map<std::pair<const ScannedFile*, const ScannedFile*>, std::unique_ptr<KnownWords>> known_;
    std::map<std::pair<const ScannedFile*, const ScannedFile*>, bool> makes_constants_;
    using ExamplesOf = BySide<std::map<std::pair<std::string, std::string>, Examples>>;
    /// Pairs that did not change, by their files and by the folders of these.
    struct PairPlaces {
        BySide<std::unordered_map<std::string_view, std::vector<size_t>>> in_file;
        std::map<std::pair<std::string_view, std::string_view>, std::vector<size_t>> in_folders;
    };
    const PairPlaces& pair_places();
    /// Learns from pairs, up to so many words.
    void learn(Side from, size_t most_words, const std::vector<size_t>& pairs, Examples& out) const;

    std::optional<PairPlaces> places_;
    ExamplesOf beside_;      ///< by the files of source and target
    ExamplesOf in_folders_;  ///< by their folders
    std::map<std::pair<const ScannedFile*, const ScannedFile*>, HeadManners> heads_beside_;
    BySide<std::optional<HeadManners>> heads_;
    BySide<std::map<std::string_view, const ScannedFile*>> by_path_;
    std::map<const ScannedFile*, UnitPlaces> units_;
    Valueless valueless_;
};

}  // namespace porttool
