// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/edit_shapes.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "porttool/language/words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/normal_text.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

using WordList = std::vector<std::string_view>;

/// Without the parameters and arguments that are `name`, or declare it.
WordList without_item(const WordList& words, std::string_view name) {
    WordList out;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string_view after = i + 1 < words.size() ? words[i + 1] : std::string_view();
        out.push_back(words[i]);
        if (words[i] != name || (after != "," && after != ")")) continue;
        size_t first = out.size() - 1;
        int depth = 0;
        while (first > 0 && (depth > 0 || (out[first - 1] != "," && out[first - 1] != "("))) {
            depth += out[first - 1] == ")" || out[first - 1] == "]" ? 1 : out[first - 1] == "[" ? -1 : 0;
            if (--first > 0 && out[first] == ";") break;
        }
        if (first == 0 || depth != 0) continue;
        const bool is_plain = std::all_of(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                                          [](auto word) { return is_word_token(word) || word == "*" || word == "&"; });
        if (!is_plain) continue;
        const bool leads = out[first - 1] == ",";
        out.resize(leads ? first - 1 : first);
        if (!leads && after == ",") ++i;
    }
    return out;
}

/// The first word that `longer` has where it goes on otherwise than `shorter`, up to the end of its argument: its last.
std::string_view first_item_beyond(const WordList& shorter, const WordList& longer) {
    size_t i = 0;
    while (i < std::min(shorter.size(), longer.size()) && shorter[i] == longer[i]) ++i;
    while (i < longer.size() && !is_word_token(longer[i])) ++i;
    while (i + 1 < longer.size() && longer[i + 1] != "," && longer[i + 1] != ")") ++i;
    return i < longer.size() && is_word_token(longer[i]) ? longer[i] : std::string_view();
}

/// Cuts an edit, as the words that went and that came, into its spots.
class SpotReader {
public:
    SpotReader(const WordList& went, const WordList& came) : went_(went), came_(came) {}

    std::set<EditSpot> run() {
        for (const DiffStep& step : diff(went_, came_)) {
            if (step.kind == DiffStep::Keep)
                end_spot(step.before);
            else if (step.kind == DiffStep::Remove)
                lost_.push_back(went_[step.before]);
            else
                gained_.push_back(came_[step.now]);
        }
        end_spot(went_.size());
        return std::move(out_);
    }

private:
    static bool counts(std::string_view word) { return word == "#" || is_word_token(word) || is_number_token(word); }

    static bool is_in(const WordList& words, std::string_view word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    }

    /// `f > g` where `(` follows, which stayed, and `f` is gone and `g` is new throughout.
    bool is_of_call(size_t next) const {
        const bool is_exchange = lost_.size() == 1 && gained_.size() == 1 && is_word_token(lost_[0]) &&
                                 is_word_token(gained_[0]) && !word_is(lost_[0], kKeyword) &&
                                 !word_is(gained_[0], kKeyword);
        return is_exchange && next < went_.size() && went_[next] == "(" && !is_in(came_, lost_[0]) &&
               !is_in(went_, gained_[0]);
    }

    void end_spot(size_t next) {
        if (lost_.empty() && gained_.empty()) return;
        EditSpot spot;
        for (const std::string_view word : lost_) (spot.text += word) += ' ';
        spot.text += '>';
        for (const std::string_view word : gained_) (spot.text += ' ') += word;
        for (const WordList* words : {&lost_, &gained_})
            spot.words += static_cast<size_t>(std::count_if(words->begin(), words->end(), counts));
        spot.of_call = is_of_call(next);
        const auto known = out_.insert(std::move(spot));
        if (!known.second && !is_of_call(next)) forget_call(known.first);
        lost_.clear();
        gained_.clear();
    }

    /// The same words beside others are no call's name.
    void forget_call(std::set<EditSpot>::iterator known) {
        EditSpot spot = *known;
        spot.of_call = false;
        out_.erase(known);
        out_.insert(std::move(spot));
    }

    const WordList &went_, &came_;
    WordList lost_, gained_;
    std::set<EditSpot> out_;
};

}  // namespace

std::vector<std::string_view> shown_words(std::string_view text) {
    std::vector<std::string_view> out;
    for (size_t i = 0; i < text.size();) {
        size_t end = i;
        const bool is_number = is_number_token(text.substr(i, 2));
        while (end < text.size() && (is_word_token(text.substr(end, 1)) || is_number_token(text.substr(end, 1)) ||
                                     (is_number && text[end] == '.')))
            ++end;
        if (end == i) ++end;
        if (text[i] != ' ') out.push_back(text.substr(i, end - i));
        i = end;
    }
    return out;
}

bool is_long_edit(const std::vector<std::string>& lines) {
    if (lines.size() != 2 || lines[0][0] == lines[1][0]) return lines.size() > 1;
    const std::string_view a = lines[0], b = lines[1];
    const size_t most = std::min(a.size(), b.size());
    size_t front = 1, back = 0;  // behind the sign
    while (front < most && a[front] == b[front]) ++front;
    while (front + back < most && a[a.size() - 1 - back] == b[b.size() - 1 - back]) ++back;
    const auto words = [&](std::string_view text) {
        const std::string_view middle = text.substr(front, text.size() - back - front);
        return std::count(middle.begin(), middle.end(), ' ');
    };
    constexpr std::ptrdiff_t kLeast = 3;
    return words(a) + words(b) >= kLeast;
}

bool is_of_branches(const std::vector<std::string>& lines) {
    std::map<char, std::ptrdiff_t> open;  // more that open than close, of those that came and of those that went
    for (const std::string_view line : lines) {
        const std::string_view branch = line.substr(1);
        const bool opens = branch.starts_with(" # ifdef ") && std::count(branch.begin(), branch.end(), ' ') == 3;
        if (!opens && branch != " # endif") return false;
        open[line[0]] += opens ? 1 : -1;
    }
    return lines.size() > 1 && open['+'] == 0 && open['-'] == 0;
}

std::string types_exchanged(const std::vector<std::string>& lines) {
    if (lines.size() != 2 || lines[0][0] != '-' || lines[1][0] != '+') return {};
    std::array<std::vector<std::string_view>, 2> heads = {shown_words(std::string_view(lines[0]).substr(1)),
                                                          shown_words(std::string_view(lines[1]).substr(1))};
    for (auto& head : heads) {
        if (std::find(head.begin(), head.end(), "@") == head.end()) return {};
        std::erase_if(head, [](std::string_view word) { return word == "const" || word == "&"; });
    }
    const auto names_type = [](const std::vector<std::string_view>& head, size_t i) {
        const bool is_before = i + 1 < head.size() && (head[i + 1] == "<" || is_word_token(head[i + 1]));
        return is_before && is_word_token(head[i]) && !is_type_word(head[i]) && !word_is(head[i], kKeyword);
    };
    std::set<std::string_view> gone, came;
    for (const DiffStep& step : diff(heads[0], heads[1])) {
        if (step.kind == DiffStep::Keep) continue;
        const bool goes = step.kind == DiffStep::Remove;
        const size_t i = goes ? step.before : step.now;
        if (!names_type(heads[goes ? 0 : 1], i)) return {};
        (goes ? gone : came).insert(heads[goes ? 0 : 1][i]);
    }
    const bool stays = std::any_of(heads[1].begin(), heads[1].end(), [&](auto word) { return gone.contains(word); });
    if (gone.empty() || came.empty() || stays) return {};
    std::string out;
    for (const std::string_view type : gone) (out += type) += ' ';
    out += '>';
    for (const std::string_view type : came) (out += ' ') += type;
    return out;
}

std::string handed_on(const std::vector<std::string>& lines) {
    std::vector<WordList> went, came;
    for (const std::string_view line : lines) (line[0] == '-' ? went : came).push_back(shown_words(line.substr(1)));
    if (went.empty() || went.size() != came.size()) return {};
    const bool is_new = came[0].size() > went[0].size();
    const std::vector<WordList>&shorter = is_new ? went : came, &longer = is_new ? came : went;
    const std::string_view name = first_item_beyond(shorter[0], longer[0]);
    if (name.empty()) return {};
    for (size_t i = 0; i < longer.size(); ++i) {
        const auto has = [&](const WordList& words) {
            return std::find(words.begin(), words.end(), name) != words.end();
        };
        if (has(shorter[i]) || !has(longer[i]) || without_item(longer[i], name) != shorter[i]) return {};
    }
    return (is_new ? "+ " : "- ") + std::string(name);
}

EditShape shape_of_edit(const std::vector<std::string>& lines) {
    constexpr size_t kLeast = 8, kMost = 4'000;  // words: names and numbers that came or went; all
    EditShape out;
    std::map<std::string_view, size_t> numbers;
    size_t all = 0;
    for (const std::string_view line : lines) {
        for (const std::string_view word : shown_words(line)) {
            ++all;
            if (!is_word_token(word) || is_type_word(word) || word_is(word, kKeyword)) {
                (out.text += word) += ' ';
                continue;
            }
            const auto [known, is_new] = numbers.try_emplace(word, numbers.size());
            if (is_new) out.names.emplace_back(word);
            out.text += "n" + std::to_string(known->second) + " ";
        }
        out.text += '\n';
    }
    const bool is_of_one_side = std::all_of(lines.begin(), lines.end(), [](const std::string& line) {
        return line.starts_with("- ") || line.starts_with("+ ");
    });
    size_t edited = all;
    if (is_of_one_side) {
        edited = 0;
        for (const EditSpot& spot : spots_of(lines)) edited += spot.words;
    }
    return edited >= kLeast && lines.size() > 1 && all <= kMost ? out : EditShape();
}

bool names_tell_apart(const std::vector<std::string>& names, std::string_view unit,
                      const std::vector<std::string>& other_names, std::string_view other_unit) {
    const auto is_inside = [](std::string_view name, size_t i) {
        return i > 0 && i < name.size() && name[i - 1] != '_' && name[i] != '_';
    };
    const size_t least = std::min(unit.size(), other_unit.size());
    size_t same = 0, tail = 0;
    while (same < least && unit[same] == other_unit[same]) ++same;
    while (same > 0 && (is_inside(unit, same) || is_inside(other_unit, same))) --same;
    while (tail < least - same && unit[unit.size() - 1 - tail] == other_unit[other_unit.size() - 1 - tail]) ++tail;
    while (tail > 0 && (is_inside(unit, unit.size() - tail) || is_inside(other_unit, other_unit.size() - tail))) --tail;
    const std::string part = in_small_letters(unit.substr(same, unit.size() - tail - same));
    const std::string other = in_small_letters(other_unit.substr(same, other_unit.size() - tail - same));
    if (names.size() != other_names.size()) return false;
    for (size_t i = 0; i < names.size(); ++i) {
        if (names[i] == other_names[i]) continue;
        std::string name = in_small_letters(names[i]);
        if (part.empty()) return false;
        for (size_t at = name.find(part); at != std::string::npos; at = name.find(part, at + other.size()))
            name.replace(at, part.size(), other);
        if (name != in_small_letters(other_names[i])) return false;
    }
    return true;
}

std::set<EditSpot> spots_of(const std::vector<std::string>& lines) {
    constexpr size_t kMostWords = 4'000;
    WordList went, came;
    for (const std::string_view line : lines) {
        if (line.size() < 2 || (line[0] != '-' && line[0] != '+')) continue;
        WordList& side = line[0] == '-' ? went : came;
        for (const std::string_view word : shown_words(line.substr(1))) side.push_back(word);
        side.push_back(";");
    }
    if (went.size() + came.size() > kMostWords) return {};
    return SpotReader(went, came).run();
}

bool is_work(const std::vector<std::string>& lines) {
    constexpr size_t kDozen = 12;
    size_t shown = 0, edited = 0;
    for (const std::string& line : lines)
        if (line.size() > 1 && (line[0] == '-' || line[0] == '+')) shown += shown_words(line.substr(1)).size();
    if (shown < kDozen) return false;
    const std::set<EditSpot> spots = spots_of(lines);
    for (const EditSpot& spot : spots) edited += spot.words;
    return spots.empty() || edited >= kDozen;
}

}  // namespace porttool
