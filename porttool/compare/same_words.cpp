// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/same_words.h"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "porttool/normal/diff.h"
#include "porttool/scan/side.h"

namespace porttool {
namespace {

std::vector<std::string> chosen_keys(const std::vector<Statement>& statements, const std::vector<size_t>& indices) {
    std::vector<std::string> out;
    for (const size_t i : indices)
        if (!statements[i].is_brace()) out.push_back(statements[i].key);
    return out;
}

/// A changed spot within statements: what went, what came, the words beside it, and where in the old words it begins.
struct Hunk {
    std::vector<std::string> lost, gained;
    std::string before, after;
    size_t at = 0;

    bool same_edit(const Hunk& other) const {
        return lost == other.lost && gained == other.gained && (before == other.before || after == other.after);
    }
};

std::vector<std::string> words_of(const std::vector<Statement>& statements, const std::vector<size_t>& indices) {
    std::vector<std::string> out;
    for (const size_t i : indices) out.insert(out.end(), statements[i].common.begin(), statements[i].common.end());
    return out;
}

std::vector<Hunk> hunks(const std::vector<std::string>& before, const std::vector<std::string>& now) {
    std::vector<Hunk> out;
    bool open = false;
    std::string last;
    for (const DiffStep& step : diff(before, now)) {
        if (step.kind == DiffStep::Keep) {
            if (open) out.back().after = before[step.before];
            open = false;
            last = before[step.before];
            continue;
        }
        if (!open) {
            out.emplace_back();
            out.back().before = last;
            out.back().at = step.before;
        }
        open = true;
        if (step.kind == DiffStep::Remove)
            out.back().lost.push_back(before[step.before]);
        else
            out.back().gained.push_back(now[step.now]);
    }
    return out;
}

using Numbers = std::vector<uint32_t>;

/// The words of statements as numbers.
class WordNumbers {
public:
    Numbers of(const Statement& statement) {
        Numbers out;
        for (const std::string& word : statement.common)
            out.push_back(numbers_.try_emplace(word, static_cast<uint32_t>(numbers_.size())).first->second);
        return out;
    }

private:
    std::unordered_map<std::string_view, uint32_t> numbers_;
};

/// The length of the longest common subsequence.
size_t common_words(const Numbers& a, const Numbers& b) {
    Numbers row(b.size() + 1, 0);
    for (const uint32_t word : a) {
        uint32_t diagonal = 0;
        for (size_t k = 0; k < b.size(); ++k) {
            const uint32_t above = row[k + 1];
            row[k + 1] = word == b[k] ? diagonal + 1 : std::max(above, row[k]);
            diagonal = above;
        }
    }
    return row.back();
}

/// How alike two statements are, 0 to 1.
double likeness(const Numbers& a, const Numbers& b) {
    const size_t words = a.size() + b.size();
    return words == 0 ? 1.0 : 2.0 * static_cast<double>(common_words(a, b)) / static_cast<double>(words);
}

/// The best way to lay the statements of two texts side by side, in order, so that those that stand for each other are
/// as alike as can be: how alike all are together.
class BestLaying {
public:
    BestLaying(size_t rows, size_t columns) : columns_(columns), alike_(rows * columns) {}

    double& at(size_t row, size_t column) { return alike_[row * columns_ + column]; }

    double sum() const {
        std::vector<double> row(columns_ + 1, 0);
        for (size_t i = 0; columns_ > 0 && i < alike_.size() / columns_; ++i) {
            double diagonal = 0;
            for (size_t k = 0; k < columns_; ++k) {
                const double above = row[k + 1];
                row[k + 1] = std::max({above, row[k], diagonal + alike_[i * columns_ + k]});
                diagonal = above;
            }
        }
        return row.back();
    }

private:
    size_t columns_;
    std::vector<double> alike_;
};

/// Whether statements of two texts stand for each other, as far as there is time to compare them.
class MostAlike {
public:
    MostAlike(const std::vector<Statement>& source, const std::vector<Statement>& target) {
        for (const Statement& statement : source) here_.push_back(read(statement));
        for (const Statement& statement : target) there_.push_back(read(statement));
    }

    /// True if no other statement of either text is more like one of the two, and, where others are as like, all
    /// statements laid side by side are the most alike only if these two stand for each other.
    ///
    ///     a = clamp(a, lo, hi);      c = min(max(c, lo), hi);
    ///     b = clamp(b, lo, hi);      d = clamp(d, lo, hi);          `d` is `b`, though `a` is as like it
    bool are(size_t source, size_t target) {
        const Numbers &here = here_[source], &there = there_[target];
        if (here == there) return true;
        double found = 0;
        if (!compare(here, there, found)) return false;
        bool is_contested = false;
        if (!is_most(here, there_, target, found, is_contested) || !is_most(there, here_, source, found, is_contested))
            return false;
        return !is_contested || is_best_laid(source, target);
    }

private:
    Numbers read(const Statement& statement) { return statement.is_brace() ? Numbers() : numbers_.of(statement); }

    bool compare(const Numbers& a, const Numbers& b, double& found) {
        constexpr size_t kMostCells = 200'000'000;  // beyond, a person is asked
        if ((cells_ += a.size() * b.size() + 1) > kMostCells) return false;
        found = a.empty() || b.empty() ? 0 : likeness(a, b);
        return true;
    }

    bool is_most(const Numbers& statement, const std::vector<Numbers>& others, size_t at, double than,
                 bool& is_contested) {
        for (size_t i = 0; i < others.size(); ++i) {
            double found = 0;
            if (!compare(statement, others[i], found) || found > than) return false;
            is_contested = is_contested || (i != at && found == than);
        }
        return true;
    }

    /// The statements that both texts have once stand for each other: what the others are is told between these.
    void find_shared() {
        std::map<Numbers, uint32_t> ids;
        BySide<Numbers> texts;
        BySide<std::map<uint32_t, size_t>> times;
        for (const Side side : kBothSides)
            for (const Numbers& statement : side == Side::Source ? here_ : there_) {
                const auto id = ids.emplace(statement, static_cast<uint32_t>(ids.size())).first->second;
                texts[side].push_back(id);
                ++times[side][id];
            }
        shared_ = {{0, 0}};
        for (const DiffStep& step : diff(texts.source, texts.target)) {
            if (step.kind != DiffStep::Keep || here_[step.before].empty()) continue;
            const uint32_t id = texts.source[step.before];
            if (times.source[id] == 1 && times.target[id] == 1) shared_.emplace_back(step.before + 1, step.now + 1);
        }
        shared_.emplace_back(here_.size() + 1, there_.size() + 1);
    }

    bool is_best_laid(size_t source, size_t target) {
        if (shared_.empty()) find_shared();
        const auto next = std::partition_point(shared_.begin(), shared_.end(),
                                               [&](const auto& each) { return each.first <= source; });
        const auto [first, first_there] = *(next - 1);
        const auto [end, end_there] = *next;
        if (target < first_there || target + 1 >= end_there) return false;
        if (!laid_ || laid_first_ != first) {
            laid_.emplace(end - 1 - first, end_there - 1 - first_there);
            laid_first_ = first;
            for (size_t i = first; i + 1 < end; ++i)
                for (size_t k = first_there; k + 1 < end_there; ++k)
                    if (!compare(here_[i], there_[k], laid_->at(i - first, k - first_there))) return false;
            laid_sum_ = laid_->sum();
        }
        cells_ += (end - first) * (end_there - first_there);
        double& alike = laid_->at(source - first, target - first_there);
        const double was = std::exchange(alike, 0);
        const double without = laid_->sum();
        alike = was;
        constexpr double kLeast = 1e-6;
        return without + kLeast < laid_sum_;
    }

    WordNumbers numbers_;
    std::vector<Numbers> here_, there_;              ///< of a brace none
    std::vector<std::pair<size_t, size_t>> shared_;  ///< behind each, with an end before and behind all
    std::optional<BestLaying> laid_;                 ///< of what stands between two of these
    size_t laid_first_ = 0;                          ///< where that begins
    double laid_sum_ = 0;
    uint64_t cells_ = 0;
};

/// True if the edits are to statements that stand for each other. Else the same words were changed in another place.
bool same_statements(const StatementEdit& source, const StatementEdit& target) {
    if (source.lost.size() != target.lost.size() || source.gained.size() != target.gained.size()) return false;
    constexpr size_t kMostComparisons = 100'000;
    if (source.lost.size() * (source.before.size() + target.before.size()) > kMostComparisons) return false;
    MostAlike most(source.before, target.before);
    for (size_t k = 0; k < source.lost.size(); ++k)
        if (!most.are(source.lost[k], target.lost[k])) return false;
    return true;
}

/// In how many places of a text the edit of a hunk could stand: what it took away, beside one of its neighbours.
size_t places_for(const Hunk& hunk, const std::vector<std::string>& words) {
    size_t places = 0;
    for (size_t i = 0; i + hunk.lost.size() <= words.size(); ++i) {
        if (!std::equal(hunk.lost.begin(), hunk.lost.end(), words.begin() + static_cast<std::ptrdiff_t>(i))) continue;
        const size_t end = i + hunk.lost.size();
        const bool beside =
            (i > 0 ? words[i - 1] : "") == hunk.before || (end < words.size() && words[end] == hunk.after);
        places += beside ? 1 : 0;
    }
    return places;
}

/// True if the edits did the same in the same places. The places are told by laying the old words of both sides side by
/// side, and where that says nothing, by the edit's neighbours if only one place has them.
///
///     x > 0 && y > 0      source: x > 1 && y > 0      port: x > 0 && y > 1      the same words, another place
bool same_hunks(const StatementEdit& source, const StatementEdit& target) {
    const auto old_source = words_of(source.before, source.lost), old_target = words_of(target.before, target.lost);
    const auto a = hunks(old_source, words_of(source.now, source.gained)),
               b = hunks(old_target, words_of(target.now, target.gained));
    if (a.size() != b.size()) return false;
    constexpr size_t kNowhere = static_cast<size_t>(-1) / 2;      // no place, nor one before the first
    std::vector<size_t> beside(old_source.size() + 1, kNowhere);  // the target's word for each of the source's
    for (const DiffStep& step : diff(old_source, old_target))
        if (step.kind == DiffStep::Keep) beside[step.before] = step.now;
    size_t looked_through = 0;
    for (size_t k = 0; k < a.size(); ++k) {
        if (!a[k].same_edit(b[k])) return false;
        bool aligned = false;
        for (size_t i = a[k].at > 0 ? a[k].at - 1 : 0; i <= a[k].at + a[k].lost.size() && !aligned; ++i)
            aligned = beside[std::min(i, old_source.size())] == i + b[k].at - a[k].at;
        constexpr size_t kMost = 10'000'000;
        if (!aligned && ((looked_through += old_target.size()) > kMost || places_for(a[k], old_target) > 1))
            return false;
    }
    return true;
}

using Replacements = std::map<std::vector<std::string>, std::vector<std::string>>;

size_t occurrences(const std::vector<std::string>& of, const std::vector<std::string>& words) {
    size_t count = 0;
    for (auto at = words.begin(); (at = std::search(at, words.end(), of.begin(), of.end())) != words.end(); ++at)
        ++count;
    return count;
}

/// What an edit put in the place of what, if that is all that it did; else nothing.
Replacements replacements_of(const StatementEdit& edit) {
    constexpr size_t kMostInPlace = 20'000, kMostKinds = 16;
    const auto all_words = [](const std::vector<Statement>& statements) {
        std::vector<std::string> out;
        for (const Statement& statement : statements) {
            out.insert(out.end(), statement.common.begin(), statement.common.end());
            out.emplace_back(";");
        }
        return out;
    };
    const auto before = all_words(edit.before), now = all_words(edit.now);
    if (before.size() + now.size() > kMostInPlace) return {};
    Replacements out;
    std::map<std::vector<std::string>, size_t> counts;
    for (const Hunk& hunk : hunks(before, now)) {
        const bool names = std::any_of(hunk.lost.begin(), hunk.lost.end(),
                                       [](const std::string& word) { return is_word_token(word); });
        const auto known = out.try_emplace(hunk.lost, hunk.gained);
        if (!names || known.first->second != hunk.gained || out.size() > kMostKinds) return {};
        ++counts[hunk.lost];
    }
    for (const auto& [lost, count] : counts)
        if (occurrences(lost, before) != count || occurrences(lost, now) > 0) return {};
    return out;
}

/// Says which statements of one side's list the other side's lacks, and of one that only moved (it is in `opposite`,
/// what the same side lost, or gained) in which block.
void name_missing(const std::vector<Statement>& here, const std::vector<size_t>& indices,
                  const std::vector<std::string>& others, const std::vector<std::string>& opposite, bool is_source,
                  const char* verb, std::vector<std::string>& out) {
    std::unordered_map<std::string_view, size_t> free;
    for (const std::string& key : others) ++free[key];
    const std::unordered_set<std::string_view> turned(opposite.begin(), opposite.end());
    for (const size_t i : indices) {
        if (here[i].is_brace()) continue;
        if (const auto found = free.find(here[i].key); found != free.end() && found->second > 0) {
            --found->second;
            continue;
        }
        const bool moved = turned.contains(here[i].key);
        out.push_back(std::string(is_source ? "the source " : "the port ") + verb + " `" + here[i].shown + "`" +
                      (moved ? " in " + block_of(here, i) : "") +
                      (is_source ? "; the port did not" : "; the source did not"));
    }
}

/// Those of a side's statements that the other side's list lacks.
std::vector<size_t> unmatched(const std::vector<Statement>& here, const std::vector<size_t>& indices,
                              const std::vector<std::string>& others) {
    std::unordered_map<std::string_view, size_t> free;
    for (const std::string& key : others) ++free[key];
    std::vector<size_t> out;
    for (const size_t i : indices) {
        if (here[i].is_brace()) continue;
        const auto found = free.find(here[i].key);
        if (found != free.end() && found->second > 0)
            --found->second;
        else
            out.push_back(i);
    }
    return out;
}

/// The statements that an edit lost and gained.
struct LostAndGained {
    std::vector<size_t> lost, gained;
};

/// A statement that took the place of another, and what that did to its words.
struct ReplacedStatement {
    size_t lost = 0, gained = 0;
    std::vector<Hunk> words;

    bool same_edit(const ReplacedStatement& other) const {
        return std::equal(words.begin(), words.end(), other.words.begin(), other.words.end(),
                          [](const Hunk& a, const Hunk& b) { return a.same_edit(b); });
    }
};

/// The statements of an edit that were replaced one by one, where as many came as went.
std::vector<ReplacedStatement> replaced_statements(const StatementEdit& edit) {
    constexpr size_t kMost = 200;
    std::vector<ReplacedStatement> out;
    if (edit.lost.size() > kMost || edit.gained.size() > kMost) return out;
    const std::vector<size_t> kept = edit.kept();
    size_t lost = 0, gained = 0;
    const auto take_until = [&](size_t before, size_t now) {
        std::vector<size_t> went, came;
        for (; lost < edit.lost.size() && edit.lost[lost] < before; ++lost) went.push_back(edit.lost[lost]);
        for (; gained < edit.gained.size() && edit.gained[gained] < now; ++gained) came.push_back(edit.gained[gained]);
        for (size_t k = 0; k < went.size() && went.size() == came.size(); ++k)
            out.push_back({went[k], came[k], hunks(edit.before[went[k]].common, edit.now[came[k]].common)});
    };
    for (size_t i = 0; i < kept.size(); ++i)
        if (kept[i] != StatementEdit::kGone) take_until(i, kept[i]);
    take_until(edit.before.size(), edit.now.size());
    return out;
}

/// What the edits lost and gained, without the statements that both edited alike: `x - 1` in other words of each side
/// that became `x - 1.5`. Where the same was done to more statements of one side, it is not known which was left out.
BySide<LostAndGained> left_by_edits(const StatementEdit& source, const StatementEdit& target) {
    const BySide<std::vector<ReplacedStatement>> all{replaced_statements(source), replaced_statements(target)};
    BySide<std::unordered_set<size_t>> lost, gained;
    for (const ReplacedStatement& one : all.source) {
        BySide<std::vector<const ReplacedStatement*>> alike;
        for (const Side side : kBothSides)
            for (const ReplacedStatement& each : all[side])
                if (one.same_edit(each)) alike[side].push_back(&each);
        if (one.words.empty() || alike.source.size() != alike.target.size()) continue;
        for (const Side side : kBothSides)
            for (const ReplacedStatement* each : alike[side]) {
                lost[side].insert(each->lost);
                gained[side].insert(each->gained);
            }
    }
    BySide<LostAndGained> out{{source.lost, source.gained}, {target.lost, target.gained}};
    for (const Side side : kBothSides) {
        std::erase_if(out[side].lost, [&](size_t i) { return lost[side].contains(i); });
        std::erase_if(out[side].gained, [&](size_t i) { return gained[side].contains(i); });
    }
    return out;
}

/// What is left once the two edits are laid side by side: the two statements that came on both sides and are most
/// alike without being the same. "" if none are.
std::string closest_difference(const StatementEdit& source, const StatementEdit& target,
                               const BySide<LostAndGained>& left) {
    constexpr size_t kMost = 64, kMostCells = 20'000'000;
    constexpr double kAlike = 0.5;
    const auto here = unmatched(source.now, left.source.gained, chosen_keys(target.now, left.target.gained));
    const auto there = unmatched(target.now, left.target.gained, chosen_keys(source.now, left.source.gained));
    WordNumbers numbers;
    double best = kAlike;
    size_t cells = 0;
    std::string out;
    for (size_t a = 0; a < std::min(here.size(), kMost); ++a)
        for (size_t b = 0; b < std::min(there.size(), kMost); ++b) {
            const Statement &of_source = source.now[here[a]], &of_target = target.now[there[b]];
            if ((cells += of_source.common.size() * of_target.common.size()) > kMostCells) return out;
            const double found = likeness(numbers.of(of_source), numbers.of(of_target));
            if (found <= best) continue;
            best = found;
            out = "the source has " + quoted(of_source) + " where the port has " + quoted(of_target);
        }
    return out;
}

}  // namespace

bool same_words(const StatementEdit& source, const StatementEdit& target) {
    if (source.gained.size() != target.gained.size() || source.lost.size() != target.lost.size()) return false;
    if (chosen_keys(source.now, source.gained) == chosen_keys(target.now, target.gained) &&
        chosen_keys(source.before, source.lost) == chosen_keys(target.before, target.lost))
        return true;
    return same_statements(source, target) && same_hunks(source, target);
}

bool same_replacements(const StatementEdit& source, const StatementEdit& target) {
    const Replacements here = replacements_of(source);
    return !here.empty() && here == replacements_of(target);
}

MissingStatements missing_statements(const StatementEdit& source, const StatementEdit& target) {
    const auto said_of = [&](const BySide<LostAndGained>& left) {
        MissingStatements out;
        std::vector<std::string>& said = out.sentences;
        const auto source_gained = chosen_keys(source.now, left.source.gained),
                   target_gained = chosen_keys(target.now, left.target.gained);
        const auto source_lost = chosen_keys(source.before, left.source.lost),
                   target_lost = chosen_keys(target.before, left.target.lost);
        name_missing(source.now, left.source.gained, target_gained, source_lost, true, "gained", said);
        name_missing(source.before, left.source.lost, target_lost, source_gained, true, "lost", said);
        out.count.source = said.size();
        name_missing(target.now, left.target.gained, source_gained, target_lost, false, "gained", said);
        name_missing(target.before, left.target.lost, source_lost, target_gained, false, "lost", said);
        out.count.target = said.size() - out.count.source;
        if (std::string closest = closest_difference(source, target, left); !closest.empty())
            said.insert(said.begin(), std::move(closest));
        return out;
    };
    MissingStatements out = said_of(left_by_edits(source, target));
    return out.sentences.empty() ? said_of({{source.lost, source.gained}, {target.lost, target.gained}}) : out;
}

}  // namespace porttool
