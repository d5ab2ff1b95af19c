// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/port_effort.h"

#include <algorithm>
#include <map>
#include <set>

#include "porttool/compare/measure.h"
#include "porttool/compare/normal_form.h"
#include "porttool/compare/statements.h"
#include "porttool/compare/symbols.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

struct TextLine {
    uint32_t line = 0;
    std::string key;                  ///< its tokens, numbers in one spelling
    std::vector<std::string> tokens;  ///< as written
};

std::vector<TextLine> lines_of(const Excerpt& excerpt) {
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
            out.back().tokens.push_back(word);
        }
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

/// Lines of one text that the other has, too, under one reading.
using LineSet = std::set<uint32_t>;

struct SharedNow {
    LineSet source, target;
};

/// Lines at least half of whose tokens lie in common runs: what `compare` calls shared.
SharedNow half_shared(const Excerpt& source, const Excerpt& target, const Dialect& dialect) {
    SharedNow out;
    const Similarity similarity = measure_shares({source}, {target}, dialect);
    auto take = [](const std::vector<std::vector<CodeLine>>& lines, LineSet& shared) {
        for (const auto& excerpt : lines)
            for (const CodeLine& line : excerpt)
                if (line.shared) shared.insert(line.line);
    };
    take(similarity.a_lines, out.source);
    take(similarity.b_lines, out.target);
    return out;
}

void take_covered_lines(const std::vector<PlacedToken>& tokens, const SymbolSequence& sequence,
                        const std::vector<uint8_t>& covered, LineSet& shared) {
    LineSet open;
    for (size_t i = 0; i < sequence.symbols.size(); ++i) {
        if (sequence.tokens[i] == kNoToken) continue;
        const uint32_t line = tokens[sequence.tokens[i]].line;
        (covered[i] != 0 ? shared : open).insert(line);
    }
    for (const uint32_t line : open) shared.erase(line);
}

/// Lines all of whose tokens lie in common runs of 12, however the lines are broken.
SharedNow wholly_shared(const Excerpt& source, const Excerpt& target, const Dialect& dialect) {
    SymbolTable table(dialect);
    const std::vector<PlacedToken> left = table.place({source}), right = table.place({target});
    const SymbolSequence a = table.sequence(left, Vocabulary::Dialect, 0),
                         b = table.sequence(right, Vocabulary::Dialect, 1);
    const auto matches = metrics::winnowing_matches(a.symbols, b.symbols, {12, 1});
    SharedNow out;
    take_covered_lines(left, a, metrics::covered_in_a(matches, a.symbols.size()), out.source);
    take_covered_lines(right, b, metrics::covered_in_b(matches, b.symbols.size()), out.target);
    return out;
}

/// Lines that stand as a whole on the other side, in the words that `words` makes of them.
template <class Words>
void take_equal_lines(const std::vector<TextLine>& here, const std::vector<TextLine>& there, const Words& words,
                      LineSet& shared) {
    std::set<std::string> texts;
    for (const TextLine& line : there) texts.insert(words(line));
    for (const TextLine& line : here)
        if (texts.contains(words(line))) shared.insert(line.line);
}

size_t count_added(const Edited& side, const LineSet& shared) {
    return static_cast<size_t>(std::count_if(side.added.begin(), side.added.end(),
                                             [&](size_t i) { return shared.contains(side.now[i].line); }));
}

std::vector<std::string> added_words(const Edited& side, const Dialect& dialect) {
    std::vector<std::string> tokens;
    for (const size_t i : side.added) tokens.insert(tokens.end(), side.now[i].tokens.begin(), side.now[i].tokens.end());
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

void count_carried(const Excerpt& source_now, const Excerpt& target_now, const Edited& source, const Edited& target,
                   const Dialect& dialect, PortedEdit& out) {
    out.carried.lines = static_cast<double>(target.edit.added);
    if (source_now.file == nullptr || target_now.file == nullptr) return;
    const auto written = [](const TextLine& line) { return line.key; };
    const auto translated = [&](const TextLine& line) { return joined(common_words(line.tokens, dialect)); };
    LineSet strict;
    take_equal_lines(target.now, source.now, written, strict);
    SharedNow usual = wholly_shared(source_now, target_now, dialect);
    take_equal_lines(source.now, target.now, translated, usual.source);
    take_equal_lines(target.now, source.now, translated, usual.target);
    LineSet loose = half_shared(source_now, target_now, dialect).target;
    loose.insert(usual.target.begin(), usual.target.end());
    out.ported = count_added(source, usual.source);
    out.carried.shared = static_cast<double>(count_added(target, usual.target));
    out.carried.shared_low = static_cast<double>(count_added(target, strict));
    out.carried.shared_high = static_cast<double>(count_added(target, loose));
}

/// One side of a change, with what its pairs have accounted for.
struct Side {
    SideIndex before, now;
    std::set<std::string> counted;                                      ///< ids whose edits are in the totals
    std::map<std::string, std::set<uint32_t>> lines_before, lines_now;  ///< by file: lines of paired units

    Edited edit(const std::string& id) {
        const Excerpt old = before.find_before(id, now), fresh = now.find(id);
        std::vector<TextLine> old_lines = lines_of(old), new_lines = lines_of(fresh);
        for (const TextLine& line : old_lines) lines_before[old.file->path].insert(line.line);
        for (const TextLine& line : new_lines) lines_now[fresh.file->path].insert(line.line);
        return edited(old_lines, std::move(new_lines));
    }
};

std::vector<TextLine> lines_outside(const ScannedFile& file, const std::map<std::string, std::set<uint32_t>>& paired) {
    std::vector<TextLine> lines = lines_of({&file, nullptr});
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

/// Adds a pair to the totals; a side that stands in an earlier pair, too, is there already.
void add_pair(PortedEdit& totals, const PairEffort& pair, Side& source, Side& target) {
    const PortedEdit& edit = pair.edit;
    if (source.counted.insert(pair.source).second) {
        add(totals.source, edit.source);
        totals.ported += edit.ported;
        totals.source_tokens += edit.source_tokens;
    }
    if (target.counted.insert(pair.target).second) {
        add(totals.target, edit.target);
        totals.carried.shared += edit.carried.shared;
        totals.carried.shared_low += edit.carried.shared_low;
        totals.carried.shared_high += edit.carried.shared_high;
        totals.target_tokens += edit.target_tokens;
        totals.common_tokens += edit.common_tokens;
    }
}

}  // namespace

std::optional<double> PortedEdit::similarity() const {
    if (source_tokens == 0 || target_tokens == 0) return std::nullopt;
    return 2.0 * static_cast<double>(common_tokens) / static_cast<double>(source_tokens + target_tokens);
}

std::optional<double> PortedEdit::carried_over() const {
    if (source.added == 0) return std::nullopt;
    return static_cast<double>(ported) / static_cast<double>(source.added);
}

PortEffort port_effort(const std::vector<MapPair>& pairs, const ChangedSides& sides, const Dialect& dialect) {
    Side source{SideIndex(sides.source_before), SideIndex(sides.source_now), {}, {}, {}};
    Side target{SideIndex(sides.target_before), SideIndex(sides.target_now), {}, {}, {}};
    PortEffort out;
    for (const MapPair& pair : pairs) {
        const Edited left = source.edit(pair.source);
        for (const std::string& id : pair.targets) {
            const Edited right = target.edit(id);
            PairEffort effort{pair.source, id, {}};
            effort.edit.source = left.edit;
            effort.edit.target = right.edit;
            if (left.edit.changed() + right.edit.changed() == 0) continue;
            count_carried(source.now.find(pair.source), target.now.find(id), left, right, dialect, effort.edit);
            compare_added(left, right, dialect, effort.edit);
            add_pair(out.totals, effort, source, target);
            out.pairs.push_back(std::move(effort));
        }
    }
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
