// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/effort/port_effort.h"

#include <algorithm>
#include <map>
#include <set>

#include "porttool/measure/measure.h"
#include "porttool/measure/symbols.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/statements.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

constexpr size_t kMostOfALine = 100'000, kMostOfAnEdit = 1'000'000;  // tokens; beyond, no person wrote it

struct TextLine {
    uint32_t line = 0;
    std::string key;                  ///< its tokens, numbers in one spelling
    std::vector<std::string> tokens;  ///< as written
};

/// `with_tokens` false leaves the tokens out: of a text that was, only the keys are of use.
std::vector<TextLine> lines_of(const Excerpt& excerpt, bool with_tokens) {
    std::vector<TextLine> out;
    if (excerpt.file == nullptr) return out;
    const LexedText& lexed = excerpt.file->lexed;
    for (const std::vector<uint32_t>& run : code_runs(excerpt))
        for (const uint32_t index : run) {
            const Token& token = lexed.tokens[index];
            if (out.empty() || out.back().line != token.line) out.push_back({token.line, "", {}});
            const std::string word =
                token.kind == TokenKind::Number ? normal_number(lexed.view(token)) : std::string(lexed.view(token));
            out.back().key += word + " ";
            if (with_tokens && out.back().tokens.size() < kMostOfALine) out.back().tokens.push_back(word);
        }
    // What is left out of a line must not make it equal to another.
    for (TextLine& line : out)
        if (line.tokens.size() >= kMostOfALine) line.tokens.push_back(std::to_string(hash_text(line.key)));
    return out;
}

std::vector<std::string> common_words(const std::vector<std::string>& tokens, const Dialect& dialect) {
    std::vector<std::string> words;
    for (const Statement& statement : split_statements(tokens, dialect))
        words.insert(words.end(), statement.common.begin(), statement.common.end());
    return words;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += word + " ";
    return text;
}

/// An edit of one excerpt: the lines before and now, and which of the latter are new.
struct Edited {
    std::vector<TextLine> now;
    std::vector<size_t> added;  ///< indices into `now`
    LineEdit edit;
};

Edited edited(const std::vector<TextLine>& before, std::vector<TextLine> now) {
    Edited out;
    auto keys = [](const std::vector<TextLine>& lines) {
        std::vector<std::string> texts;
        texts.reserve(lines.size());
        for (const TextLine& line : lines) texts.push_back(line.key);
        return texts;
    };
    for (const DiffStep& step : diff(keys(before), keys(now))) {
        if (step.kind == DiffStep::Remove) ++out.edit.removed;
        if (step.kind == DiffStep::Add) out.added.push_back(step.now);
    }
    out.edit.added = out.added.size();
    out.now = std::move(now);
    return out;
}

/// The units of one side by id.
class SideIndex {
public:
    explicit SideIndex(const std::vector<ScannedFile>& files) {
        for (const ScannedFile& file : files) {
            for (const Unit& unit : file.units) add(unit_id(file, unit), {&file, &unit}, unit.name);
            add(file.path + ":@file", {&file, nullptr}, "");
        }
    }

    Excerpt find(const std::string& id) const {
        const auto found = units_.find(id);
        return found == units_.end() ? Excerpt{} : found->second;
    }

    /// What a unit was before: the one of that id, or the only one of its name whose id is gone now.
    Excerpt find_before(const std::string& id, const SideIndex& now) const {
        if (const Excerpt same = find(id); same.file != nullptr) return same;
        Excerpt moved{};
        const auto [first, last] = names_.equal_range(id.substr(id.find(':') + 1));
        for (auto at = first; at != last; ++at) {
            if (now.find(at->second).file != nullptr) continue;
            if (moved.file != nullptr) return {};
            moved = find(at->second);
        }
        return moved;
    }

private:
    void add(const std::string& id, const Excerpt& excerpt, const std::string& name) {
        units_.emplace(id, excerpt);
        if (!name.empty()) names_.emplace(name, id);
    }
    std::map<std::string, Excerpt> units_;
    std::multimap<std::string, std::string> names_;
};

using LineSet = std::set<uint32_t>;

/// Lines of the port at least half of whose tokens lie in common runs: what `compare` calls shared.
LineSet half_shared(const Excerpt& source, const Excerpt& target, const Dialect& dialect) {
    LineSet out;
    for (const auto& excerpt : measure_shares({source}, {target}, dialect).b_lines)
        for (const CodeLine& line : excerpt)
            if (line.shared) out.insert(line.line);
    return out;
}

/// A line's place in a sequence of symbols.
struct LineRange {
    uint32_t line = 0;
    size_t first = 0, last = 0;
};

std::vector<LineRange> line_ranges(const std::vector<PlacedToken>& tokens, const SymbolSequence& sequence) {
    std::vector<LineRange> out;
    for (size_t i = 0; i < sequence.symbols.size(); ++i) {
        if (sequence.tokens[i] == kNoToken) continue;
        const uint32_t line = tokens[sequence.tokens[i]].line;
        if (out.empty() || out.back().line != line) out.push_back({line, i, i});
        out.back().last = i;
    }
    return out;
}

/// Of each line that lies as a whole in one run of at least 12 common tokens, however the lines are broken: the lines
/// of the other side that the same tokens stand on. One run must hold it all: where something was deleted, both sides
/// of the seam are common and the line is not.
using LinesInRuns = std::map<uint32_t, LineSet>;

struct RunsOfBoth {
    LinesInRuns source, target;
};

void take_lines_in_run(const std::vector<LineRange>& here, const std::vector<LineRange>& there, size_t first,
                       size_t other_first, size_t length, LinesInRuns& out) {
    auto line = std::lower_bound(here.begin(), here.end(), first,
                                 [](const LineRange& range, size_t place) { return range.first < place; });
    for (; line != here.end() && line->last < first + length; ++line) {
        const size_t from = line->first - first + other_first, to = line->last - first + other_first;
        auto other = std::lower_bound(there.begin(), there.end(), from,
                                      [](const LineRange& range, size_t place) { return range.last < place; });
        for (; other != there.end() && other->first <= to; ++other) out[line->line].insert(other->line);
    }
}

RunsOfBoth lines_in_runs(const Excerpt& source, const Excerpt& target, const Dialect& dialect) {
    SymbolTable table(dialect);
    const std::vector<PlacedToken> left = table.place({source}), right = table.place({target});
    const SymbolSequence a = table.sequence(left, Vocabulary::Dialect, 0),
                         b = table.sequence(right, Vocabulary::Dialect, 1);
    const std::vector<LineRange> a_lines = line_ranges(left, a), b_lines = line_ranges(right, b);
    RunsOfBoth out;
    for (const metrics::TokenMatch& run : metrics::winnowing_matches(a.symbols, b.symbols, {12, 1})) {
        take_lines_in_run(a_lines, b_lines, run.a, run.b, run.length, out.source);
        take_lines_in_run(b_lines, a_lines, run.b, run.a, run.length, out.target);
    }
    return out;
}

/// One side's lines in the common vocabulary, and which of them its edit gained.
struct SideLines {
    std::vector<std::string> texts;        ///< as Edited::now
    std::map<std::string, size_t> kept;    ///< how often a text stands on lines that were there before
    std::map<std::string, size_t> gained;  ///< and on those that are new
    LineSet new_lines;
};

SideLines side_lines(const Edited& side, const Dialect& dialect) {
    SideLines out;
    for (const size_t i : side.added) out.new_lines.insert(side.now[i].line);
    for (const TextLine& line : side.now) {
        out.texts.push_back(joined(common_words(line.tokens, dialect)));
        ++(out.new_lines.contains(line.line) ? out.gained : out.kept)[out.texts.back()];
    }
    return out;
}

size_t count_of(const std::map<std::string, size_t>& counts, const std::string& text) {
    const auto found = counts.find(text);
    return found == counts.end() ? 0 : found->second;
}

/// The gained lines (indices into Edited::now) that the other side has as well: as a whole line, where each line of the
/// other side answers for one, or else in one run. Of the other side only what it gained counts, unless `old_code`:
/// then also what it had and this side had not. A lone brace goes with the gained line before it.
std::set<size_t> answered(const Edited& side, const SideLines& here, const SideLines& there, const LinesInRuns& runs,
                          bool old_code) {
    std::map<std::string, size_t> free = there.gained;
    if (old_code)
        for (const auto& [text, count] : there.kept) {
            size_t& left = free[text];
            left += count;
            left -= std::min(left, count_of(here.kept, text));
        }
    const auto in_one_run = [&](uint32_t line) {
        const auto run = runs.find(line);
        return run != runs.end() &&
               (old_code || std::any_of(run->second.begin(), run->second.end(),
                                        [&](uint32_t other) { return there.new_lines.contains(other); }));
    };
    std::set<size_t> out;
    for (size_t n = 0; n < side.added.size(); ++n) {
        const size_t i = side.added[n];
        const std::string& text = here.texts[i];
        if (text.empty() && n > 0) {
            if (out.contains(side.added[n - 1])) out.insert(i);
            continue;
        }
        const bool stands_there = count_of(there.gained, text) + count_of(there.kept, text) > 0;
        if (const auto found = free.find(text); found != free.end() && found->second > 0) {
            --found->second;
            out.insert(i);
        } else if (!stands_there && in_one_run(side.now[i].line)) {
            out.insert(i);
        }
    }
    return out;
}

/// The gained lines of a port that its source has, under three readings, as indices into Edited::now.
struct CarriedLines {
    std::set<size_t> strict, usual, loose;

    void add(const CarriedLines& more) {
        strict.insert(more.strict.begin(), more.strict.end());
        usual.insert(more.usual.begin(), more.usual.end());
        loose.insert(more.loose.begin(), more.loose.end());
    }
    void count_into(metrics::SharedLines& out) const {
        out.shared += static_cast<double>(usual.size());
        out.shared_low += static_cast<double>(strict.size());
        out.shared_high += static_cast<double>(loose.size());
    }
};

std::vector<std::string> added_words(const Edited& side, const Dialect& dialect) {
    std::vector<std::string> tokens;
    for (const size_t i : side.added)
        if (tokens.size() < kMostOfAnEdit)
            tokens.insert(tokens.end(), side.now[i].tokens.begin(), side.now[i].tokens.end());
    std::vector<std::string> words = common_words(tokens, dialect);
    std::erase(words, "}");
    std::sort(words.begin(), words.end());
    return words;
}

void compare_added(const Edited& source, const Edited& target, const Dialect& dialect, PortedEdit& out) {
    const std::vector<std::string> left = added_words(source, dialect), right = added_words(target, dialect);
    std::vector<std::string> both;
    std::set_intersection(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(both));
    out.source_tokens = left.size();
    out.target_tokens = right.size();
    out.common_tokens = both.size();
}

/// Counts what the source gained and the port has; hands out what the port gained and the source has.
CarriedLines count_carried(const Excerpt& source_now, const Excerpt& target_now, const Edited& source,
                           const Edited& target, const Dialect& dialect, PortedEdit& out) {
    out.carried.lines = static_cast<double>(target.edit.added);
    CarriedLines carried;
    if (source_now.file == nullptr || target_now.file == nullptr) return carried;
    const RunsOfBoth runs = lines_in_runs(source_now, target_now, dialect);
    const SideLines left = side_lines(source, dialect), right = side_lines(target, dialect);
    out.ported = static_cast<double>(answered(source, left, right, runs.source, false).size());
    carried.usual = answered(target, right, left, runs.target, true);
    std::set<std::string> written;
    for (const TextLine& line : source.now) written.insert(line.key);
    for (const size_t i : carried.usual)
        if (written.contains(target.now[i].key)) carried.strict.insert(i);
    const LineSet half = half_shared(source_now, target_now, dialect);
    carried.loose = carried.usual;
    for (const size_t i : target.added)
        if (half.contains(target.now[i].line)) carried.loose.insert(i);
    carried.count_into(out.carried);
    return carried;
}

/// One side of a change, with what its pairs have accounted for.
struct Side {
    SideIndex before, now;
    std::map<std::string, std::set<uint32_t>> lines_before, lines_now;  ///< by file: lines of paired units

    Edited edit(const std::string& id) {
        const Excerpt old = before.find_before(id, now), fresh = now.find(id);
        std::vector<TextLine> old_lines = lines_of(old, false), new_lines = lines_of(fresh, true);
        for (const TextLine& line : old_lines) lines_before[old.file->path].insert(line.line);
        for (const TextLine& line : new_lines) lines_now[fresh.file->path].insert(line.line);
        return edited(old_lines, std::move(new_lines));
    }
};

std::vector<TextLine> lines_outside(const ScannedFile& file, const std::map<std::string, std::set<uint32_t>>& paired) {
    std::vector<TextLine> lines = lines_of({&file, nullptr}, true);
    if (const auto found = paired.find(file.path); found != paired.end())
        std::erase_if(lines, [&](const TextLine& line) { return found->second.contains(line.line); });
    return lines;
}

/// The edits that no pair accounts for, file by file; their texts are added to `words`.
std::vector<FileEffort> outside(const std::vector<ScannedFile>& before, const std::vector<ScannedFile>& now,
                                const Side& side, const Dialect& dialect, size_t& tokens) {
    std::map<std::string, std::pair<const ScannedFile*, const ScannedFile*>> files;
    for (const ScannedFile& file : before) files[file.path].first = &file;
    for (const ScannedFile& file : now) files[file.path].second = &file;
    std::vector<FileEffort> out;
    for (const auto& [path, versions] : files) {
        const auto [old, fresh] = versions;
        if (old != nullptr && fresh != nullptr && old->lexed.text == fresh->lexed.text) continue;
        const Edited edit = edited(old != nullptr ? lines_outside(*old, side.lines_before) : std::vector<TextLine>(),
                                   fresh != nullptr ? lines_outside(*fresh, side.lines_now) : std::vector<TextLine>());
        if (edit.edit.changed() == 0) continue;
        out.push_back({path, edit.edit});
        tokens += added_words(edit, dialect).size();
    }
    return out;
}

void add(LineEdit& total, const LineEdit& edit) {
    total.added += edit.added;
    total.removed += edit.removed;
}

/// Sums over the pairs that do not depend on their order: a unit's lines count once, wherever it stands.
class Totals {
public:
    void add_pair(const PairEffort& pair, const CarriedLines& carried) {
        const PortedEdit& edit = pair.edit;
        OfSource& source = sources_[pair.source];
        source.edit = edit.source;
        source.ported += edit.ported;
        ++source.targets;
        OfTarget& target = targets_[pair.target];
        target.edit = edit.target;
        target.carried.add(carried);
        sum_.source_tokens += edit.source_tokens;
        sum_.target_tokens += edit.target_tokens;
        sum_.common_tokens += edit.common_tokens;
    }

    PortedEdit sum() const {
        PortedEdit out = sum_;
        for (const auto& [id, one] : sources_) {
            add(out.source, one.edit);
            out.ported += one.ported / one.targets;
        }
        for (const auto& [id, one] : targets_) {
            add(out.target, one.edit);
            one.carried.count_into(out.carried);
        }
        return out;
    }

private:
    struct OfSource {
        LineEdit edit;
        double ported = 0, targets = 0;
    };
    struct OfTarget {
        LineEdit edit;
        CarriedLines carried;
    };
    PortedEdit sum_;  ///< of the tokens alone
    std::map<std::string, OfSource> sources_;
    std::map<std::string, OfTarget> targets_;
};

}  // namespace

std::optional<double> PortedEdit::similarity() const {
    if (source_tokens == 0 || target_tokens == 0) return std::nullopt;
    return 2.0 * static_cast<double>(common_tokens) / static_cast<double>(source_tokens + target_tokens);
}

std::optional<double> PortedEdit::carried_over() const {
    if (source.added == 0) return std::nullopt;
    return ported / static_cast<double>(source.added);
}

PortEffort port_effort(const std::vector<MapPair>& pairs, const ChangedSides& sides, const Dialect& dialect) {
    Side source{SideIndex(sides.source_before), SideIndex(sides.source_now), {}, {}};
    Side target{SideIndex(sides.target_before), SideIndex(sides.target_now), {}, {}};
    PortEffort out;
    Totals totals;
    for (const MapPair& pair : pairs) {
        const Edited left = source.edit(pair.source);
        for (const std::string& id : pair.targets) {
            const Edited right = target.edit(id);
            PairEffort effort{pair.source, id, {}};
            effort.edit.source = left.edit;
            effort.edit.target = right.edit;
            if (left.edit.changed() + right.edit.changed() == 0) continue;
            const CarriedLines carried =
                count_carried(source.now.find(pair.source), target.now.find(id), left, right, dialect, effort.edit);
            compare_added(left, right, dialect, effort.edit);
            totals.add_pair(effort, carried);
            out.pairs.push_back(std::move(effort));
        }
    }
    out.totals = totals.sum();
    std::sort(out.pairs.begin(), out.pairs.end(), [](const PairEffort& a, const PairEffort& b) {
        return a.source != b.source ? a.source < b.source : a.target < b.target;
    });
    out.source_outside = outside(sides.source_before, sides.source_now, source, dialect, out.totals.source_tokens);
    out.target_outside = outside(sides.target_before, sides.target_now, target, dialect, out.totals.target_tokens);
    for (const FileEffort& file : out.source_outside) add(out.totals.source, file.edit);
    for (const FileEffort& file : out.target_outside) add(out.totals.target, file.edit);
    out.totals.carried.lines = static_cast<double>(out.totals.target.added);
    return out;
}

}  // namespace porttool
