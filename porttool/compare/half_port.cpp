// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/half_port.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/compare/statement_edit.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/scan/side.h"

namespace porttool {
namespace {

constexpr std::string_view kParts[] = {"xyzw", "rgba", "0123"};

/// Two names of different parts, and which parts.
struct PartNames {
    size_t here, there;
    bool operator==(const PartNames&) const = default;
};

/// `qx` and `qy`, `x` and `y`, `red_0` and `red_1`: one letter apart, the last or the first.
std::optional<PartNames> parts_of_names(std::string_view here, std::string_view there) {
    if (here.size() != there.size() || here.empty() || !is_word_token(here) || !is_word_token(there)) return {};
    const size_t last = here.size() - 1;
    const auto letters_at = [&](size_t at) -> std::optional<PartNames> {
        for (const std::string_view manner : kParts) {
            const PartNames found{manner.find(here[at]), manner.find(there[at])};
            if (found.here != std::string_view::npos && found.there != std::string_view::npos &&
                found.here != found.there)
                return found;
        }
        return {};
    };
    if (here.substr(0, last) == there.substr(0, last)) return letters_at(last);
    if (here.substr(1) == there.substr(1)) return letters_at(0);
    return {};
}

/// A statement's words without its subscripts, and these.
struct Outline {
    std::vector<std::string_view> words, subscripts;

    explicit Outline(const Statement& statement) {
        size_t open = 0;
        for (const std::string& word : statement.common) {
            if (word == "[") ++open;
            (open > 0 ? subscripts : words).push_back(word);
            if (word == "]" && open > 0) --open;
        }
    }

    /// True if it says of one part what the other says of another.
    bool is_sibling(const Outline& other) const {
        if (words.size() != other.words.size()) return false;
        std::optional<PartNames> parts;
        for (size_t i = 0; i < words.size(); ++i) {
            if (words[i] == other.words[i]) continue;
            const auto found = parts_of_names(words[i], other.words[i]);
            if (!found || (parts && *parts != *found)) return false;
            parts = found;
        }
        return parts || subscripts != other.subscripts;
    }

    /// True if it names a part itself, whichever it is.
    bool names_a_part() const {
        const auto is_part = [](std::string_view word) {
            return word.size() == 1 && (std::string_view("xyzwrgba").find(word[0]) != std::string_view::npos);
        };
        for (size_t i = 1; i < words.size(); ++i)
            if (is_part(words[i]) && (words[i - 1] == "." || words[i - 1] == "->")) return true;
        return std::any_of(subscripts.begin(), subscripts.end(),
                           [](std::string_view word) { return is_number_token(word); });
    }

    bool has(std::string_view word) const { return std::find(words.begin(), words.end(), word) != words.end(); }
};

/// One side's statements before its edit, and which of them the edit took away.
class EditedFamilies {
public:
    explicit EditedFamilies(const StatementEdit& edit) : edit_(edit) {
        for (const Statement& statement : edit.before) outlines_.emplace_back(statement);
    }

    const Outline& lost(size_t k) const { return outlines_[edit_.lost[k]]; }

    /// A statement of the family of the k-th that went which the edit left as it was; none if there is none.
    const Statement* left_behind(size_t k) const {
        for (size_t i = 0; i < outlines_.size(); ++i)
            if (!is_lost(i) && !edit_.before[i].is_brace() && outlines_[i].is_sibling(lost(k))) return &edit_.before[i];
        return nullptr;
    }

    /// True if no statement of the text says of another part what the k-th that went said.
    bool is_alone(size_t k) const {
        return std::none_of(outlines_.begin(), outlines_.end(),
                            [&](const Outline& one) { return one.is_sibling(lost(k)); });
    }

private:
    bool is_lost(size_t i) const { return std::find(edit_.lost.begin(), edit_.lost.end(), i) != edit_.lost.end(); }

    const StatementEdit& edit_;
    std::vector<Outline> outlines_;
};

StatementEdit edit_as_written(const Words& before, const Words& now) {
    return statement_edit(before, now, [](const Words& statement, bool) {
        return std::vector<std::string>(statement.begin(), statement.end());
    });
}

/// A side's text now with the edits of all parts but the first taken back.
class FirstPart {
public:
    FirstPart(const StatementEdit& edit, const Words& now) : edit_(edit), now_(now.begin(), now.end()) {
        for (const size_t i : edit.lost) lost_.emplace_back(edit.before[i]);
        for (const size_t i : edit.gained) gained_.emplace_back(edit.now[i]);
        if (lost_.size() == gained_.size())
            for (size_t k = 1; k < lost_.size(); ++k) take_back(k);
    }

    bool any() const { return any_; }
    std::vector<std::string> text() && { return std::move(now_); }

private:
    /// Where an earlier statement that went is a sibling of the k-th, and what came for both are siblings alike.
    void take_back(size_t k) {
        for (size_t first = 0; first < k; ++first) {
            if (!lost_[first].is_sibling(lost_[k]) || !follows(first, k)) continue;
            const std::vector<std::string>& new_words = edit_.now[edit_.gained[k]].common;
            const std::vector<std::string>& old_words = edit_.before[edit_.lost[k]].common;
            const auto at = std::search(now_.begin(), now_.end(), new_words.begin(), new_words.end());
            if (at == now_.end() || std::search(at + 1, now_.end(), new_words.begin(), new_words.end()) != now_.end())
                return;  // which of them it is cannot be told
            now_.insert(now_.erase(at, at + static_cast<std::ptrdiff_t>(new_words.size())), old_words.begin(),
                        old_words.end());
            any_ = true;
            return;
        }
    }

    /// True if what came for the k-th is what came for the first, with each word that stood for the first's part in the
    /// words of the k-th, and with the subscripts that each had.
    bool follows(size_t first, size_t k) const {
        if (gained_[first].subscripts != lost_[first].subscripts || gained_[k].subscripts != lost_[k].subscripts ||
            gained_[first].words.size() != gained_[k].words.size())
            return false;
        std::map<std::string_view, std::string_view> stands_for;
        for (size_t i = 0; i < lost_[k].words.size(); ++i) {
            const auto known = stands_for.emplace(lost_[first].words[i], lost_[k].words[i]);
            if (known.first->second != lost_[k].words[i]) return false;
        }
        for (size_t i = 0; i < gained_[k].words.size(); ++i) {
            const auto found = stands_for.find(gained_[first].words[i]);
            if ((found == stands_for.end() ? gained_[first].words[i] : found->second) != gained_[k].words[i])
                return false;
        }
        return true;
    }

    const StatementEdit& edit_;
    std::vector<std::string> now_;
    std::vector<Outline> lost_, gained_;
    bool any_ = false;
};

/// True if each statement that went says it for all parts at once.
bool speaks_of_all_parts(const StatementEdit& edit) {
    const EditedFamilies families(edit);
    for (size_t k = 0; k < edit.lost.size(); ++k)
        if (!families.is_alone(k) || families.lost(k).names_a_part()) return false;
    return true;
}

bool leaves_no_part_behind(const StatementEdit& edit) {
    const EditedFamilies families(edit);
    for (size_t k = 0; k < edit.lost.size(); ++k)
        if (families.left_behind(k) != nullptr) return false;
    return true;
}

/// What the side that says it part by part left behind where the other side says it for all parts at once.
const Statement* left_behind(const EditedFamilies& whole, const EditedFamilies& by_parts, size_t k) {
    const Statement* left = by_parts.left_behind(k);
    if (left == nullptr || !whole.is_alone(k) || whole.lost(k).names_a_part()) return nullptr;
    const Outline sibling(*left);
    for (size_t i = 0; i < sibling.words.size(); ++i)
        if (const std::string_view word = by_parts.lost(k).words[i];
            word != sibling.words[i] && whole.lost(k).has(word))
            return nullptr;  // both say it of this one part
    return left;
}

constexpr size_t kMostLostByParts = 16, kMostWordsByParts = 20'000;

}  // namespace

std::string half_of_a_port(const PairTexts& texts) {
    if (texts.source_before.size() + texts.target_before.size() > kMostWordsByParts) return {};
    const StatementEdit source = edit_as_written(texts.source_before, texts.source_now),
                        target = edit_as_written(texts.target_before, texts.target_now);
    if (source.lost.size() != target.lost.size() || source.lost.size() > kMostLostByParts) return {};
    const EditedFamilies here(source), there(target);
    for (size_t k = 0; k < source.lost.size(); ++k) {
        const bool is_brace = source.before[source.lost[k]].is_brace() || target.before[target.lost[k]].is_brace();
        if (is_brace) continue;
        if (const Statement* left = left_behind(here, there, k))
            return "the port left " + quoted(*left) + " as it was, which the edit of the source says with the rest";
        if (const Statement* left = left_behind(there, here, k))
            return "the source left " + quoted(*left) + " as it was, which the edit of the port says with the rest";
    }
    return {};
}

EditOfOnePart edit_of_one_part(const PairTexts& texts) {
    EditOfOnePart out;
    if (texts.source_before.size() + texts.target_before.size() > kMostWordsByParts) return out;
    const StatementEdit source = edit_as_written(texts.source_before, texts.source_now),
                        target = edit_as_written(texts.target_before, texts.target_now);
    if (source.lost.size() == target.lost.size() || std::max(source.lost.size(), target.lost.size()) > kMostLostByParts)
        return out;
    const bool target_by_parts = target.lost.size() > source.lost.size();
    if (!speaks_of_all_parts(target_by_parts ? source : target)) return out;
    if (!leaves_no_part_behind(target_by_parts ? target : source)) return out;
    FirstPart here(target_by_parts ? target : source, target_by_parts ? texts.target_now : texts.source_now);
    out.any = here.any();
    const Words& whole = target_by_parts ? texts.source_now : texts.target_now;
    (target_by_parts ? out.target_now : out.source_now) = std::move(here).text();
    (target_by_parts ? out.source_now : out.target_now).assign(whole.begin(), whole.end());
    return out;
}

}  // namespace porttool
