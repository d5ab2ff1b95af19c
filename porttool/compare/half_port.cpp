// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/half_port.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/scan/side.h"

namespace porttool {
namespace {

constexpr std::string_view kParts[] = {"xyzw", "rgba", "0123"};

/// True if the names differ by one part: `qx` and `qy`, `x` and `y`, `red_0` and `red_1`.
bool differ_by_a_part(std::string_view here, std::string_view there) {
    if (here.size() != there.size() || here.empty()) return false;
    const size_t last = here.size() - 1;
    const auto are_parts = [&](size_t at) {
        return std::any_of(std::begin(kParts), std::end(kParts), [&](std::string_view manner) {
            return manner.find(here[at]) != std::string_view::npos && manner.find(there[at]) != std::string_view::npos;
        });
    };
    return (here.substr(0, last) == there.substr(0, last) && are_parts(last)) ||
           (here.substr(1) == there.substr(1) && are_parts(0));
}

/// How much the names of siblings may differ.
enum class NamesOfParts : uint8_t { Any, ByOnePart };

/// What one sibling says where the other says something else.
using Mapping = std::map<std::string_view, std::string_view>;

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

    /// How the other says of another part what this one says of one; nothing if it does not, or is the same.
    std::optional<Mapping> mapping_to(const Outline& other, NamesOfParts names) const {
        if (words.size() != other.words.size()) return {};
        Mapping out, back;
        bool any = subscripts != other.subscripts;
        for (size_t i = 0; i < words.size(); ++i) {
            const std::string_view here = words[i], there = other.words[i];
            if (here != there) {
                const bool is_name = is_word_token(here) && is_word_token(there) && !is_type_word(here) &&
                                     !is_type_word(there) && !word_is(here, kKeyword) && !word_is(there, kKeyword);
                const bool is_called = i + 1 < words.size() && words[i + 1] == "(";
                if (!is_name || is_called || (names == NamesOfParts::ByOnePart && !differ_by_a_part(here, there)))
                    return {};
                any = true;
            }
            if (!is_word_token(here)) continue;
            if (out.emplace(here, there).first->second != there || back.emplace(there, here).first->second != here)
                return {};
        }
        return any ? std::optional(std::move(out)) : std::nullopt;
    }

    bool has(std::string_view word) const { return std::find(words.begin(), words.end(), word) != words.end(); }

    /// True if one of the words that tell siblings apart stands here: then it is said of that part alone.
    bool has_any_of(const Outline& one, const Outline& sibling) const {
        for (size_t i = 0; i < one.words.size(); ++i)
            if (one.words[i] != sibling.words[i] && (has(one.words[i]) || has(sibling.words[i]))) return true;
        return one.words == sibling.words &&
               std::any_of(subscripts.begin(), subscripts.end(), [](auto word) { return is_number_token(word); });
    }
};

/// One side's statements before its edit, and which of them the edit took away.
class EditedFamilies {
public:
    EditedFamilies(const StatementEdit& edit, NamesOfParts names) : edit_(edit), names_(names) {
        for (const Statement& statement : edit.before) outlines_.emplace_back(statement);
    }

    const Outline& lost(size_t k) const { return outlines_[edit_.lost[k]]; }

    /// A statement of the family of the k-th that went, in the same block, which the edit left as it was; none if there
    /// is none.
    const Statement* left_behind(size_t k) const {
        for (size_t i = 0; i < outlines_.size(); ++i) {
            const bool counts =
                !is_lost(i) && !edit_.before[i].is_brace() &&
                (names_ == NamesOfParts::ByOnePart || edit_.before[i].head == edit_.before[edit_.lost[k]].head);
            if (counts && lost(k).mapping_to(outlines_[i], names_)) return &edit_.before[i];
        }
        return nullptr;
    }

    /// True if no statement of the text says of another part what the k-th that went said.
    bool is_alone(size_t k) const {
        return std::none_of(outlines_.begin(), outlines_.end(),
                            [&](const Outline& one) { return lost(k).mapping_to(one, names_).has_value(); });
    }

    /// True if a statement of the text stands before the k-th that went.
    bool is_before(const Statement& statement, size_t k) const {
        return &statement < edit_.before.data() + edit_.lost[k];
    }

    /// True if another statement before the k-th that went, or behind it, says something of all that it and one of the
    /// other side have in common, so that this one may be its port.
    bool has_another_for(size_t k, const Outline& of_other_side, bool before) const {
        std::vector<std::string_view> shared;
        for (size_t i = 0; i < of_other_side.words.size(); ++i) {
            const std::string_view word = of_other_side.words[i];
            const bool is_called = i + 1 < of_other_side.words.size() && of_other_side.words[i + 1] == "(";
            if (is_word_token(word) && !is_type_word(word) && !is_called && lost(k).has(word)) shared.push_back(word);
        }
        const auto says_it = [&](const Outline& one) {
            return &one != &lost(k) && (&one < &lost(k)) == before && !one.has("@") &&
                   (shared.size() > 1 || are_much_alike(one, of_other_side)) &&
                   std::all_of(shared.begin(), shared.end(), [&](std::string_view word) { return one.has(word); });
        };
        if (shared.empty()) return names_ == NamesOfParts::Any;  // nothing tells that it is one of a family
        return std::any_of(outlines_.begin(), outlines_.end(), says_it);
    }

private:
    /// True if a third of all words, and a little more, are those of both.
    static bool are_much_alike(const Outline& one, const Outline& other) {
        std::multiset<std::string_view> left(one.words.begin(), one.words.end());
        size_t shared = 0;
        for (const std::string_view word : other.words)
            if (const auto found = left.find(word); found != left.end()) {
                left.erase(found);
                ++shared;
            }
        constexpr size_t kLeast = 35, kAll = 100;
        return 2 * kAll * shared >= kLeast * (one.words.size() + other.words.size());
    }

    bool is_lost(size_t i) const { return std::binary_search(edit_.lost.begin(), edit_.lost.end(), i); }

    const StatementEdit& edit_;
    NamesOfParts names_;
    std::vector<Outline> outlines_;
};

StatementEdit edit_as_written(const Words& before, const Words& now) {
    return statement_edit(before, now, [](const Words& statement, bool) {
        return std::vector<std::string>(statement.begin(), statement.end());
    });
}

/// A side's texts without the statements of all parts but the first that its edit changed.
class FirstPart {
public:
    FirstPart(const StatementEdit& edit, const Words& before, const Words& now, NamesOfParts names)
        : edit_(edit), names_(names), before_(before.begin(), before.end()), now_(now.begin(), now.end()) {
        for (const size_t i : edit.lost) lost_.emplace_back(edit.before[i]);
        for (const size_t i : edit.gained) gained_.emplace_back(edit.now[i]);
        is_sure_ = lost_.size() == gained_.size();
        for (size_t k = 1; is_sure_ && k < lost_.size(); ++k) drop(k);
    }

    bool any() const { return any_ && is_sure_; }
    const std::vector<std::string>& before() const { return before_; }
    const std::vector<std::string>& now() const { return now_; }

    /// A text with the names of parts after a dot, and the numbers in brackets, left out of the first parts'
    /// statements.
    std::vector<std::string> in_words_of_whole(bool of_now) const {
        std::vector<std::string> out = of_now ? now_ : before_;
        for (const size_t first : firsts_) {
            const std::vector<std::string>& words =
                of_now ? edit_.now[edit_.gained[first]].common : edit_.before[edit_.lost[first]].common;
            replace_once(words, without_parts(words), out);
        }
        return out;
    }

private:
    /// Where an earlier statement that went is a sibling of the k-th, and what came for both are siblings alike.
    void drop(size_t k) {
        for (size_t first = 0; first < k; ++first) {
            const auto mapping = lost_[first].mapping_to(lost_[k], names_);
            if (!mapping || !follows(first, k, *mapping)) continue;
            const bool found = replace_once(edit_.now[edit_.gained[k]].common, {}, now_) &&
                               replace_once(edit_.before[edit_.lost[k]].common, {}, before_);
            is_sure_ = is_sure_ && found;  // else which of them it is cannot be told
            any_ = true;
            firsts_.insert(first);
            for (const auto& [here, there] : *mapping)
                if (here != there) parts_.insert(here);
            return;
        }
    }

    /// Puts other words in the place of some that stand there once, with the semicolon where there are none.
    static bool replace_once(const std::vector<std::string>& words, const std::vector<std::string>& others,
                             std::vector<std::string>& text) {
        const auto at = std::search(text.begin(), text.end(), words.begin(), words.end());
        if (at == text.end() || std::search(at + 1, text.end(), words.begin(), words.end()) != text.end()) return false;
        auto end = at + static_cast<std::ptrdiff_t>(words.size());
        if (others.empty() && end != text.end() && *end == ";") ++end;
        text.insert(text.erase(at, end), others.begin(), others.end());
        return true;
    }

    std::vector<std::string> without_parts(const std::vector<std::string>& words) const {
        std::vector<std::string> out;
        for (size_t i = 0; i < words.size(); ++i) {
            const bool is_member = words[i] == "." && i + 1 < words.size() && parts_.contains(words[i + 1]);
            const bool is_element =
                words[i] == "[" && i + 2 < words.size() && is_number_token(words[i + 1]) && words[i + 2] == "]";
            if (is_member || is_element)
                i += is_member ? 1 : 2;
            else
                out.push_back(words[i]);
        }
        return out;
    }

    /// True if what came for the k-th is what came for the first, with each word that stood for the first's part in the
    /// words of the k-th, and with the subscripts that each had.
    bool follows(size_t first, size_t k, const Mapping& mapping) const {
        const Outline &one = gained_[first], &other = gained_[k];
        if (one.words.size() != other.words.size()) return false;
        for (size_t i = 0; i < one.words.size(); ++i) {
            const auto found = mapping.find(one.words[i]);
            if ((found == mapping.end() ? one.words[i] : found->second) != other.words[i]) return false;
        }
        return subscripts_follow(first, k);
    }

    /// True if all subscripts are what stood there before, or what stood for them.
    bool subscripts_follow(size_t first, size_t k) const {
        const auto of = [](const Outline& outline) {
            std::vector<std::vector<std::string_view>> out;
            for (size_t i = 0, open = 0; i < outline.subscripts.size(); ++i) {
                if (open == 0) out.emplace_back();
                out.back().push_back(outline.subscripts[i]);
                open += outline.subscripts[i] == "[" ? 1 : 0;
                open -= outline.subscripts[i] == "]" ? 1 : 0;
            }
            return out;
        };
        const auto old_one = of(lost_[first]), old_other = of(lost_[k]), new_one = of(gained_[first]),
                   new_other = of(gained_[k]);
        if (old_one.size() != old_other.size() || new_one.size() != new_other.size()) return false;
        std::map<std::vector<std::string_view>, std::vector<std::string_view>> stands_for;
        for (size_t i = 0; i < old_one.size(); ++i)
            if (stands_for.emplace(old_one[i], old_other[i]).first->second != old_other[i]) return false;
        for (size_t i = 0; i < new_one.size(); ++i) {
            const auto found = stands_for.find(new_one[i]);
            if (found == stands_for.end() || found->second != new_other[i]) return false;
        }
        return true;
    }

    const StatementEdit& edit_;
    NamesOfParts names_;
    std::vector<std::string> before_, now_;
    std::vector<Outline> lost_, gained_;
    std::set<size_t> firsts_;
    std::set<std::string_view> parts_;  ///< names of the first part
    bool any_ = false, is_sure_ = true;
};

/// True if each statement that went says it for all parts at once: no sibling of it stands there, and it names nothing
/// by which those of the other side are told apart.
bool speaks_of_all_parts(const StatementEdit& whole, const StatementEdit& by_parts, NamesOfParts names) {
    const EditedFamilies families(whole, names), parts(by_parts, names);
    for (size_t k = 0; k < whole.lost.size(); ++k)
        if (!families.is_alone(k)) return false;
    for (size_t a = 0; a < by_parts.lost.size(); ++a)
        for (size_t b = a + 1; b < by_parts.lost.size(); ++b) {
            if (!parts.lost(a).mapping_to(parts.lost(b), names)) continue;
            for (size_t k = 0; k < whole.lost.size(); ++k)
                if (families.lost(k).has_any_of(parts.lost(a), parts.lost(b))) return false;
        }
    return true;
}

bool leaves_no_part_behind(const StatementEdit& edit, NamesOfParts names) {
    const EditedFamilies families(edit, names);
    for (size_t k = 0; k < edit.lost.size(); ++k)
        if (families.left_behind(k) != nullptr) return false;
    return true;
}

/// What the side that says it part by part left behind where the other side says it for all parts at once.
const Statement* left_of_parts(const EditedFamilies& whole, const EditedFamilies& by_parts, size_t k) {
    const Statement* left = by_parts.left_behind(k);
    if (left == nullptr || !whole.is_alone(k)) return nullptr;
    const Outline sibling(*left);
    if (whole.lost(k).has_any_of(by_parts.lost(k), sibling)) return nullptr;  // both say it of this one part
    return whole.has_another_for(k, sibling, by_parts.is_before(*left, k)) ? nullptr : left;
}

constexpr size_t kMostLostByParts = 16, kMostWordsByParts = 20'000;
constexpr NamesOfParts kManners[] = {NamesOfParts::Any, NamesOfParts::ByOnePart};

}  // namespace

EditsByParts::EditsByParts(const PairTexts& texts)
    : texts_(texts), is_short_(texts.source_before.size() + texts.target_before.size() <= kMostWordsByParts) {
    if (!is_short_) return;
    source_ = edit_as_written(texts.source_before, texts.source_now);
    target_ = edit_as_written(texts.target_before, texts.target_now);
    is_short_ = std::max(source_.lost.size(), target_.lost.size()) <= kMostLostByParts;
}

std::string EditsByParts::half_of_a_port() const {
    if (!is_short_ || source_.lost.size() != target_.lost.size()) return {};
    for (const NamesOfParts names : kManners) {
        const EditedFamilies here(source_, names), there(target_, names);
        for (size_t k = 0; k < source_.lost.size(); ++k) {
            if (source_.before[source_.lost[k]].is_brace() || target_.before[target_.lost[k]].is_brace()) continue;
            if (const Statement* left = left_of_parts(here, there, k))
                return "the port left " + quoted(*left) + " as it was, which the edit of the source says with the rest";
            if (const Statement* left = left_of_parts(there, here, k))
                return "the source left " + quoted(*left) + " as it was, which the edit of the port says with the rest";
        }
    }
    return {};
}

std::vector<EditOfOnePart> EditsByParts::of_one_part() const {
    if (!is_short_ || source_.lost.size() == target_.lost.size()) return {};
    const bool in_target = target_.lost.size() > source_.lost.size();
    const StatementEdit &whole = in_target ? source_ : target_, &by_parts = in_target ? target_ : source_;
    const auto in_order = [&](const std::vector<std::string>& before, const std::vector<std::string>& now) {
        const auto owned = [](const Words& words) { return std::vector<std::string>(words.begin(), words.end()); };
        return in_target ? EditOfOnePart{owned(texts_.source_before), owned(texts_.source_now), before, now}
                         : EditOfOnePart{before, now, owned(texts_.target_before), owned(texts_.target_now)};
    };
    for (const NamesOfParts names : kManners) {
        if (!speaks_of_all_parts(whole, by_parts, names) || !leaves_no_part_behind(by_parts, names)) continue;
        const FirstPart first(by_parts, in_target ? texts_.target_before : texts_.source_before,
                              in_target ? texts_.target_now : texts_.source_now, names);
        if (!first.any()) continue;
        return {in_order(first.before(), first.now()),
                in_order(first.in_words_of_whole(false), first.in_words_of_whole(true))};
    }
    return {};
}

}  // namespace porttool
