// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/edits.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "porttool/compare/places.h"
#include "porttool/compare/renaming.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

std::vector<std::string> chosen_keys(const std::vector<Statement>& statements, const std::vector<size_t>& indices) {
    std::vector<std::string> out;
    for (const size_t i : indices)
        if (!statements[i].is_brace()) out.push_back(statements[i].key);
    return out;
}

/// A changed spot within statements: what went, what came, and the words beside it.
struct Hunk {
    std::vector<std::string> lost, gained;
    std::string before, after;

    bool same_edit(const Hunk& other) const {
        return lost == other.lost && gained == other.gained && (before == other.before || after == other.after);
    }
};

std::vector<Hunk> hunks(const StatementEdit& edit) {
    std::vector<std::string> before, now;
    for (const size_t i : edit.lost)
        before.insert(before.end(), edit.before[i].common.begin(), edit.before[i].common.end());
    for (const size_t i : edit.gained) now.insert(now.end(), edit.now[i].common.begin(), edit.now[i].common.end());
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

/// True if the edits are to statements that stand for each other: no other statement of the target's old text is more
/// like what the source's edit took away. Else the same words were changed in another place.
bool same_places(const StatementEdit& source, const StatementEdit& target) {
    if (source.lost.size() != target.lost.size() || source.gained.size() != target.gained.size()) return false;
    constexpr size_t kMostComparisons = 100'000, kMostCells = 200'000'000;  // beyond, a person is asked
    if (source.lost.size() * target.before.size() > kMostComparisons) return false;
    WordNumbers numbers;
    std::vector<Numbers> there;
    for (const Statement& statement : target.before) there.push_back(numbers.of(statement));
    uint64_t cells = 0;
    for (size_t k = 0; k < source.lost.size(); ++k) {
        const Numbers here = numbers.of(source.before[source.lost[k]]);
        const Numbers& stands = there[target.lost[k]];
        if ((cells += here.size() * stands.size()) > kMostCells) return false;
        const double found = here == stands ? 1 : likeness(here, stands);
        for (size_t i = 0; i < there.size() && found < 1; ++i) {
            if ((cells += here.size() * there[i].size()) > kMostCells || likeness(here, there[i]) > found) return false;
        }
    }
    return true;
}

/// What an edit that only moved closing braces did: statements that stand in another block now.
void show_moved(const StatementEdit& edit, Edit& out) {
    const std::vector<size_t> now_of = edit.kept();
    for (size_t i = 0; i < edit.before.size(); ++i) {
        if (edit.before[i].is_brace() || now_of[i] == StatementEdit::kGone) continue;
        const std::string old_block = block_of(edit.before, i), new_block = block_of(edit.now, now_of[i]);
        if (old_block == new_block) continue;
        out.lost.push_back(edit.before[i].shown + " (in " + old_block + ")");
        out.gained.push_back(edit.before[i].shown + " (in " + new_block + ")");
    }
}

bool same_hunks(const std::vector<Hunk>& a, const std::vector<Hunk>& b) {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const Hunk& x, const Hunk& y) { return x.same_edit(y); });
}

Edit shown(const StatementEdit& edit) {
    Edit out;
    for (const size_t i : edit.gained)
        if (!edit.now[i].is_brace()) out.gained.push_back(edit.now[i].shown);
    for (const size_t i : edit.lost)
        if (!edit.before[i].is_brace()) out.lost.push_back(edit.before[i].shown);
    if (out.gained.empty() && out.lost.empty()) show_moved(edit, out);
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

/// Says what the one side has and the other has not.
std::vector<std::string> missing(const StatementEdit& source, const StatementEdit& target) {
    std::vector<std::string> out;
    const auto source_gained = chosen_keys(source.now, source.gained),
               target_gained = chosen_keys(target.now, target.gained);
    const auto source_lost = chosen_keys(source.before, source.lost),
               target_lost = chosen_keys(target.before, target.lost);
    name_missing(source.now, source.gained, target_gained, source_lost, true, "gained", out);
    name_missing(source.before, source.lost, target_lost, source_gained, true, "lost", out);
    name_missing(target.now, target.gained, source_gained, target_lost, false, "gained", out);
    name_missing(target.before, target.lost, source_lost, target_gained, false, "lost", out);
    return out;
}

/// Compares the edits by the names that the texts have.
EditComparison compare_as_named(const PairTexts& texts, const Dialect& dialect, Literals literals) {
    const Meaning meaning(texts, dialect, literals);
    const auto translator = [&](Side side) {
        return [&meaning, side](const Words& statement, bool in_body) {
            return meaning.translate(statement, side, in_body);
        };
    };
    const StatementEdit source = statement_edit(texts.source_before, texts.source_now, translator(Side::Source));
    const StatementEdit target = statement_edit(texts.target_before, texts.target_now, translator(Side::Target));
    EditComparison out;
    const bool same_counts = source.gained.size() == target.gained.size() && source.lost.size() == target.lost.size();
    const bool same_statements = chosen_keys(source.now, source.gained) == chosen_keys(target.now, target.gained) &&
                                 chosen_keys(source.before, source.lost) == chosen_keys(target.before, target.lost);
    const bool same_words =
        same_counts && (same_statements || (same_places(source, target) && same_hunks(hunks(source), hunks(target))));
    out.differences = same_words ? other_places(source, target) : missing(source, target);
    out.equivalent = same_words && out.differences.empty();
    if (out.differences.empty() && !same_words) out.differences = other_places(source, target);
    if (out.differences.empty() && !same_words)
        out.differences.emplace_back("the two sides were rearranged differently");
    return out;
}

}  // namespace

Change classify(const Fingerprints& before, const Fingerprints& now) {
    if (before.written == now.written) return Change::None;
    if (before.renamed == now.renamed) return Change::Cosmetic;
    return before.blanked == now.blanked ? Change::Constant : Change::Semantic;
}

Edit edit_of(const Words& before, const Words& now) {
    const auto as_written = [](const Words& statement, bool) {
        return std::vector<std::string>(statement.begin(), statement.end());
    };
    return shown(statement_edit(before, now, as_written));
}

EditComparison compare_edits(const PairTexts& texts, const Dialect& dialect, Literals literals) {
    EditComparison out = compare_as_named(texts, dialect, literals);
    if (out.equivalent) return out;
    const auto source = with_old_names(texts.source_before, texts.source_now, dialect);
    const auto target =
        with_new_names_of_source(texts.source_before, source, texts.target_before,
                                 with_old_names(texts.target_before, texts.target_now, dialect), dialect);
    if (source == texts.source_now && target == texts.target_now) return out;
    return compare_as_named({texts.source_before, source, texts.target_before, target}, dialect, literals);
}

std::string value_in_common_words(const Words& tokens, const Dialect& dialect, bool is_struct) {
    Words value;
    auto first = tokens.begin();
    if (is_struct) {
        first = std::find(tokens.begin(), tokens.end(), "{");
    } else {
        // behind the first `=` or `{`, or behind a macro's name
        first = std::find_if(tokens.begin(), tokens.end(), [](const auto& t) { return t == "=" || t == "{"; });
        if (tokens.size() > 2 && tokens[0] == "#") first = tokens.begin() + 2;
    }
    if (first != tokens.end()) value.assign(first + 1, tokens.end());
    std::string out;
    for (const Statement& statement : split_statements(value, dialect)) out += statement.key + ";";
    return out;
}

}  // namespace porttool
