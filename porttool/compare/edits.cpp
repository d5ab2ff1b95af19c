// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/edits.h"

#include <algorithm>
#include <map>

#include "porttool/compare/renaming.h"
#include "porttool/compare/statements.h"

namespace porttool {
namespace {

std::vector<std::string> keys(const std::vector<Statement>& statements) {
    std::vector<std::string> out;
    for (const Statement& statement : statements) out.push_back(statement.key);
    return out;
}

/// An edit as statements, with where they stand.
struct StatementEdit {
    std::vector<Statement> before, now;
    std::vector<size_t> lost, gained;  ///< indices into before and now
};

StatementEdit statement_edit(const std::vector<std::string>& before, const std::vector<std::string>& now,
                             const Dialect& dialect) {
    StatementEdit edit{split_statements(before, dialect), split_statements(now, dialect), {}, {}};
    for (const DiffStep& step : diff(keys(edit.before), keys(edit.now))) {
        if (step.kind == DiffStep::Remove) edit.lost.push_back(step.before);
        if (step.kind == DiffStep::Add) edit.gained.push_back(step.now);
    }
    return edit;
}

std::vector<std::string> chosen_keys(const std::vector<Statement>& statements, const std::vector<size_t>& indices) {
    std::vector<std::string> out;
    for (const size_t i : indices)
        if (statements[i].key != "}") out.push_back(statements[i].key);
    return out;
}

/// Where a statement stands that occurs once.
std::map<std::string, size_t> unique_places(const std::vector<Statement>& statements) {
    std::map<std::string, size_t> places, count;
    for (size_t i = 0; i < statements.size(); ++i) {
        places[statements[i].key] = i;
        ++count[statements[i].key];
    }
    std::erase_if(places, [&](const auto& place) { return count[place.first] > 1; });
    return places;
}

/// True if a gained statement stands on the other side of one that both texts have: put in at another place.
bool stands_elsewhere(const StatementEdit& source, const StatementEdit& target, size_t source_at, size_t target_at) {
    const auto here = unique_places(source.now), there = unique_places(target.now);
    for (const auto& [key, place] : here) {
        const auto other = there.find(key);
        if (other == there.end() || key == source.now[source_at].key) continue;
        if ((place < source_at) != (other->second < target_at)) return true;
    }
    return false;
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

size_t common_words(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    size_t count = 0;
    for (const DiffStep& step : diff(a, b)) count += step.kind == DiffStep::Keep ? 1 : 0;
    return count;
}

/// How alike two statements are, 0 to 1.
double likeness(const Statement& a, const Statement& b) {
    const size_t words = a.common.size() + b.common.size();
    return words == 0 ? 1.0 : 2.0 * static_cast<double>(common_words(a.common, b.common)) / static_cast<double>(words);
}

/// True if the edits are to statements that stand for each other: no other statement of the target's old text is more
/// like what the source's edit took away. Else the same words were changed in another place.
bool same_places(const StatementEdit& source, const StatementEdit& target) {
    if (source.lost.size() != target.lost.size() || source.gained.size() != target.gained.size()) return false;
    constexpr size_t kMostComparisons = 100'000;  // beyond, a person is asked
    if (source.lost.size() * target.before.size() > kMostComparisons) return false;
    for (size_t k = 0; k < source.lost.size(); ++k) {
        const Statement& here = source.before[source.lost[k]];
        const double found = likeness(here, target.before[target.lost[k]]);
        for (const Statement& other : target.before)
            if (likeness(here, other) > found) return false;
    }
    return true;
}

bool same_hunks(const std::vector<Hunk>& a, const std::vector<Hunk>& b) {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const Hunk& x, const Hunk& y) { return x.same_edit(y); });
}

Edit shown(const StatementEdit& edit) {
    Edit out;
    for (const size_t i : edit.gained)
        if (edit.now[i].key != "}") out.gained.push_back(edit.now[i].shown);
    for (const size_t i : edit.lost)
        if (edit.before[i].key != "}") out.lost.push_back(edit.before[i].shown);
    return out;
}

/// Says which statements of one side's list the other side's lacks.
void name_missing(const std::vector<Statement>& here, const std::vector<size_t>& indices,
                  std::vector<std::string> others, const char* side, const char* other, const char* verb,
                  std::vector<std::string>& out) {
    for (const size_t i : indices) {
        if (here[i].key == "}") continue;
        const auto found = std::find(others.begin(), others.end(), here[i].key);
        if (found != others.end()) {
            others.erase(found);
            continue;
        }
        out.push_back(std::string("the ") + side + " " + verb + " `" + here[i].shown + "`; the " + other + " did not");
    }
}

/// Compares the edits by the names that the texts have.
EditComparison compare_as_named(const std::vector<std::string>& source_before,
                                const std::vector<std::string>& source_now,
                                const std::vector<std::string>& target_before,
                                const std::vector<std::string>& target_now, const Dialect& dialect) {
    const StatementEdit source = statement_edit(source_before, source_now, dialect);
    const StatementEdit target = statement_edit(target_before, target_now, dialect);
    EditComparison out;
    out.source = shown(source);
    out.target = shown(target);
    const auto source_gained = chosen_keys(source.now, source.gained),
               target_gained = chosen_keys(target.now, target.gained);
    const auto source_lost = chosen_keys(source.before, source.lost),
               target_lost = chosen_keys(target.before, target.lost);
    const bool same_braces =
        source.gained.size() - source_gained.size() == target.gained.size() - target_gained.size() &&
        source.lost.size() - source_lost.size() == target.lost.size() - target_lost.size();
    if (source_gained == target_gained && source_lost == target_lost && same_braces) {
        for (size_t i = 0, k = 0; i < source.gained.size() && k < target.gained.size(); ++i, ++k)
            if (stands_elsewhere(source, target, source.gained[i], target.gained[k])) {
                out.differences.push_back("both sides gained `" + source.now[source.gained[i]].shown +
                                          "`, but at different places");
                return out;
            }
        out.equivalent = true;
        return out;
    }
    if (same_braces && same_places(source, target) && same_hunks(hunks(source), hunks(target))) {
        out.equivalent = true;
        return out;
    }
    name_missing(source.now, source.gained, target_gained, "source", "port", "gained", out.differences);
    name_missing(source.before, source.lost, target_lost, "source", "port", "lost", out.differences);
    name_missing(target.now, target.gained, source_gained, "port", "source", "gained", out.differences);
    name_missing(target.before, target.lost, source_lost, "port", "source", "lost", out.differences);
    if (out.differences.empty()) out.differences.emplace_back("the two sides were rearranged differently");
    return out;
}

}  // namespace

Change classify(const Fingerprints& before, const Fingerprints& now) {
    if (before.written == now.written) return Change::None;
    if (before.renamed == now.renamed) return Change::Cosmetic;
    return before.blanked == now.blanked ? Change::Constant : Change::Semantic;
}

Edit edit_of(const std::vector<std::string>& before, const std::vector<std::string>& now) {
    return shown(statement_edit(before, now, Dialect()));
}

EditComparison compare_edits(const std::vector<std::string>& source_before, const std::vector<std::string>& source_now,
                             const std::vector<std::string>& target_before, const std::vector<std::string>& target_now,
                             const Dialect& dialect) {
    EditComparison out = compare_as_named(source_before, source_now, target_before, target_now, dialect);
    if (out.equivalent) return out;
    const auto source = with_old_names(source_before, source_now, dialect);
    const auto target = with_new_names_of_source(source_before, source, target_before,
                                                 with_old_names(target_before, target_now, dialect), dialect);
    if (source == source_now && target == target_now) return out;
    EditComparison renamed = compare_as_named(source_before, source, target_before, target, dialect);
    out.equivalent = renamed.equivalent;
    out.differences = std::move(renamed.differences);
    return out;
}

std::string value_in_common_words(const std::vector<std::string>& tokens, const Dialect& dialect, bool is_struct) {
    std::vector<std::string> value;
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
