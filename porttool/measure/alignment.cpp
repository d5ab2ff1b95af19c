// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/alignment.h"

#include <algorithm>
#include <unordered_map>

#include "porttool/normal/diff.h"
#include "porttool/normal/normal_form.h"

namespace porttool {
namespace {

struct Word {
    std::string common;  ///< in the common vocabulary; "" for what has no counterpart
    std::string_view written;
    uint32_t column = 0;  ///< from 0
};

struct Line {
    uint32_t number = 0;
    std::vector<Word> words;
    std::string key;  ///< equal for lines that are equal once translated
};

using Lines = std::vector<Line>;

bool is_number(std::string_view text) {
    return !text.empty() &&
           (text[0] == '.' ? text.size() > 1 && text[1] >= '0' && text[1] <= '9' : text[0] >= '0' && text[0] <= '9');
}

std::string common_word(std::string_view written, const Dialect& dialect) {
    if (const std::string* known = dialect.find(written)) return *known;
    return is_number(written) ? number_value(written) : std::string(written);
}

/// The lines of an excerpt with their words. Comments have no words: a line of them is equal to any other such line.
Lines lines_of(const Excerpt& excerpt, const Dialect& dialect) {
    const ScannedFile& file = *excerpt.file;
    const uint32_t start = excerpt.unit != nullptr ? excerpt.unit->start_line : 1,
                   end = excerpt.unit != nullptr ? excerpt.unit->end_line : file.lexed.line_count,
                   last = std::max(start, std::min(end, file.lexed.line_count));
    Lines lines(last - start + 1);
    for (size_t i = 0; i < lines.size(); ++i) lines[i].number = start + static_cast<uint32_t>(i);
    const auto& tokens = file.lexed.tokens;
    const auto before = [](const Token& token, uint32_t line) { return token.line < line; };
    auto token = std::lower_bound(tokens.begin(), tokens.end(), start, before), stop = tokens.end();
    if (excerpt.unit != nullptr) {
        // Of a line that holds hundreds of units each has its own words laid side by side, and a few around them.
        constexpr ptrdiff_t kMostBeside = 64;
        const ptrdiff_t first = excerpt.unit->tokens.first, end_of_own = excerpt.unit->tokens.end;
        token = std::max(token, tokens.begin() + std::max<ptrdiff_t>(first - kMostBeside, 0));
        stop = tokens.begin() + std::min<ptrdiff_t>(end_of_own + kMostBeside, tokens.end() - tokens.begin());
    }
    for (; token < stop && token->line <= last; ++token) {
        const std::string_view written = file.lexed.view(*token);
        const bool own_name = excerpt.unit != nullptr && token - tokens.begin() == excerpt.unit->name_token;
        Line& line = lines[token->line - start];
        line.words.push_back({own_name ? "@" : common_word(written, dialect), written, file.lexed.column(*token) - 1});
    }
    for (Line& line : lines) {
        for (const Word& word : line.words)
            if (!word.common.empty()) line.key += word.common + ' ';
        if (line.key.empty() && !line.words.empty()) line.key = "\x01";  // words that all lack a counterpart
        const size_t at = line.number - 1;
        if (line.words.empty() && at < file.lines.size() && file.lines[at] == LineClass::Blank) line.key = "\x02";
    }
    return lines;
}

using Match = std::pair<size_t, size_t>;

/// A half-open stretch of both sides that is still to be aligned.
struct Stretch {
    size_t source, source_end, target, target_end;
};

/// Lines that stand once in each side, in the longest order that both share: cheap and trustworthy anchors.
std::vector<Match> anchors(const Lines& source, const Lines& target) {
    struct Seen {
        size_t source_count = 0, target_count = 0, target_at = 0;
    };
    std::unordered_map<std::string_view, Seen> seen;
    for (const Line& line : source) ++seen[line.key].source_count;
    for (size_t i = 0; i < target.size(); ++i) {
        Seen& one = seen[target[i].key];
        ++one.target_count;
        one.target_at = i;
    }
    std::vector<Match> unique;
    for (size_t i = 0; i < source.size(); ++i)
        if (const Seen& one = seen[source[i].key]; one.source_count == 1 && one.target_count == 1)
            unique.emplace_back(i, one.target_at);
    // The longest increasing run of targets, by patience sorting.
    std::vector<size_t> piles, previous(unique.size());
    for (size_t i = 0; i < unique.size(); ++i) {
        const auto pile = std::lower_bound(piles.begin(), piles.end(), unique[i].second,
                                           [&](size_t top, size_t value) { return unique[top].second < value; });
        previous[i] = pile == piles.begin() ? unique.size() : *(pile - 1);
        if (pile == piles.end())
            piles.push_back(i);
        else
            *pile = i;
    }
    std::vector<Match> chain;
    for (size_t i = piles.empty() ? unique.size() : piles.back(); i < unique.size(); i = previous[i])
        chain.push_back(unique[i]);
    std::reverse(chain.begin(), chain.end());
    return chain;
}

/// Lines that are equal once translated.
void match_equal(const Lines& source, const Lines& target, const Stretch& stretch, std::vector<Match>& out) {
    std::vector<std::string> before, now;
    for (size_t i = stretch.source; i < stretch.source_end; ++i) before.push_back(source[i].key);
    for (size_t i = stretch.target; i < stretch.target_end; ++i) now.push_back(target[i].key);
    for (const DiffStep& step : diff(before, now))
        if (step.kind == DiffStep::Keep) out.emplace_back(stretch.source + step.before, stretch.target + step.now);
}

std::vector<std::string> keys_of(const std::vector<Word>& words) {
    std::vector<std::string> keys;
    for (const Word& word : words) keys.push_back(word.common);
    return keys;
}

/// The share of words that two lines have in common, regardless of order: cheap, for pairing lines.
float likeness(const Line& a, const Line& b) {
    std::vector<std::string> left = keys_of(a.words), right = keys_of(b.words), both;
    if (left.empty() || right.empty()) return 0;
    std::sort(left.begin(), left.end());
    std::sort(right.begin(), right.end());
    std::set_intersection(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(both));
    return 2.0f * static_cast<float>(both.size()) / static_cast<float>(left.size() + right.size());
}

/// Pairs lines of a stretch without equal ones by likeness, keeping their order.
void match_alike(const Lines& source, const Lines& target, const Stretch& stretch, std::vector<Match>& out) {
    constexpr size_t kMostCells = 40'000;
    constexpr float kLeastLikeness = 0.45f;
    const size_t rows = stretch.source_end - stretch.source, columns = stretch.target_end - stretch.target;
    if (rows == 0 || columns == 0 || rows * columns > kMostCells) return;
    std::vector<float> best((rows + 1) * (columns + 1), 0), alike(rows * columns);
    auto cell = [&](size_t i, size_t k) -> float& { return best[i * (columns + 1) + k]; };
    for (size_t i = rows; i-- > 0;) {
        for (size_t k = columns; k-- > 0;) {
            const float one = likeness(source[stretch.source + i], target[stretch.target + k]);
            alike[i * columns + k] = one >= kLeastLikeness ? one : 0;
            cell(i, k) = std::max({cell(i + 1, k), cell(i, k + 1), cell(i + 1, k + 1) + alike[i * columns + k]});
        }
    }
    for (size_t i = 0, k = 0; i < rows && k < columns;) {
        const float one = alike[i * columns + k];
        if (one > 0 && cell(i, k) == cell(i + 1, k + 1) + one)
            out.emplace_back(stretch.source + i++, stretch.target + k++);
        else if (cell(i, k) == cell(i + 1, k))
            ++i;
        else
            ++k;
    }
}

/// Calls `fill` for each stretch between the matches found so far and returns all matches in order.
template <class Fill>
std::vector<Match> filled(const Lines& source, const Lines& target, const std::vector<Match>& found, Fill fill) {
    std::vector<Match> out;
    size_t i = 0, k = 0;
    for (const Match& match : found) {
        fill(source, target, Stretch{i, match.first, k, match.second}, out);
        out.push_back(match);
        i = match.first + 1;
        k = match.second + 1;
    }
    fill(source, target, Stretch{i, source.size(), k, target.size()}, out);
    return out;
}

void mark(std::vector<Mark>& marks, const Word& word, bool translated) {
    const auto length = static_cast<uint32_t>(word.written.size());
    if (!marks.empty() && marks.back().translated == translated &&
        marks.back().first + marks.back().length + 1 >= word.column) {
        marks.back().length = word.column + length - marks.back().first;  // neighbours become one
        return;
    }
    marks.push_back({word.column, length, translated});
}

/// Marks what differs between two lines that stand side by side.
AlignedRow row_of(const Line& source, const Line& target) {
    AlignedRow row{source.number, target.number, {}, {}};
    for (const DiffStep& step : diff(keys_of(source.words), keys_of(target.words))) {
        if (step.kind == DiffStep::Keep) {
            const Word &left = source.words[step.before], &right = target.words[step.now];
            if (left.written == right.written) continue;
            mark(row.source_marks, left, true);
            mark(row.target_marks, right, true);
        } else if (step.kind == DiffStep::Remove) {
            const Word& word = source.words[step.before];
            mark(row.source_marks, word, word.common.empty());
        } else {
            const Word& word = target.words[step.now];
            mark(row.target_marks, word, word.common.empty());
        }
    }
    return row;
}

}  // namespace

std::vector<AlignedRow> align_units(const Excerpt& source, const Excerpt& target, const Dialect& dialect) {
    const Lines left = lines_of(source, dialect), right = lines_of(target, dialect);
    std::vector<Match> matches = filled(left, right, anchors(left, right), match_equal);
    matches = filled(left, right, matches, match_alike);
    std::vector<AlignedRow> rows;
    size_t i = 0, k = 0;
    auto alone = [&](size_t source_end, size_t target_end) {
        for (; i < source_end; ++i) rows.push_back({left[i].number, 0, {}, {}});
        for (; k < target_end; ++k) rows.push_back({0, right[k].number, {}, {}});
    };
    for (const Match& match : matches) {
        alone(match.first, match.second);
        rows.push_back(row_of(left[i++], right[k++]));
    }
    alone(left.size(), right.size());
    return rows;
}

}  // namespace porttool
