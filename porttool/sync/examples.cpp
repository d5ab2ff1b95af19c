// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/examples.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/normal_text.h"
#include "porttool/normal/statements.h"
#include "porttool/sync/name_manner.h"
#include "porttool/sync/operands.h"

namespace porttool {
namespace {

/// True for a run of words that can stand by itself: its brackets close within it, and no statement ends in it.
bool stands_alone(const std::vector<std::string>& words, size_t first, size_t end) {
    int depth = 0;
    for (size_t i = first; i < end; ++i) {
        const std::string& word = words[i];
        if (word == ";" || word == "{" || word == "}") return false;
        if (word == "(" || word == "[") ++depth;
        if ((word == ")" || word == "]") && --depth < 0) return false;
    }
    return depth == 0;
}

/// An operator or a comma at an end binds a phrase to what stands beside it.
bool is_bound(const std::string& word) {
    return !is_word_token(word) && !is_number_token(word) && word != ")" && word != "]" && word != "(" && word != "*" &&
           word != "&" && word != "-" && word != "!" && word != "~";
}

/// The same of the target's words at either end: `std ::` belongs to what follows it, `[ i ]` to what it follows.
bool are_bound(const std::vector<std::string>& words) {
    if (words.empty()) return false;
    const std::string &first = words.front(), &last = words.back();
    return is_bound(first) || is_bound(last) || first == "[" || first == ")" || first == "]" || last == "(" ||
           last == "*" || last == "&" || last == "-" || last == "!" || last == "~";
}

/// True for what is one value by itself: a name with what is called, indexed or picked of it.
bool is_primary(const std::vector<std::string>& words, size_t first, size_t end) {
    // `( * p ) . x` is one as `p -> x` is.
    constexpr size_t kPointedTo = 4;
    const bool is_pointed_to = end > first + kPointedTo && words[first] == "(" && words[first + 1] == "*" &&
                               is_word_token(words[first + 2]) && words[first + 3] == ")" &&
                               is_accessor(words[first + kPointedTo]);
    if (is_pointed_to) first += 2;
    if (!is_word_token(words[first])) return false;
    int depth = 0;
    for (size_t i = first; i < end; ++i) {
        const std::string& word = words[i];
        if (word == "(" || word == "[") ++depth;
        if ((word == ")" && !(is_pointed_to && i == first + 1)) || word == "]") --depth;
        if (depth > 0 || word == ")" || word == "]") continue;
        const bool name = is_word_token(word) || is_number_token(word);
        const bool after_name = i > first && (is_word_token(words[i - 1]) || is_number_token(words[i - 1]));
        if (name ? after_name : word != "." && word != "->" && word != "::") return false;
    }
    return true;
}

/// A name with what picks a member of it: `aux ->` where the other side has `aux .`, or nothing.
bool is_prefix(const std::vector<std::string>& words, size_t first, size_t end) {
    if (end - first < 2 || !is_word_token(words[first])) return false;
    for (size_t i = first; i < end; ++i) {
        const bool picks = words[i] == "." || words[i] == "->" || words[i] == "::";
        if ((i - first) % 2 == 0 ? !is_word_token(words[i]) : !picks) return false;
    }
    return (end - first) % 2 == 0;
}

/// A number says its value, not where it is used: that it stands for another one is true of that place alone.
bool changes_number(const std::vector<std::string>& source, size_t first, size_t end,
                    const std::vector<std::string>& target) {
    if (end - first != 1 || target.size() != 1) return false;
    return is_number_token(source[first]) || is_number_token(target[0]);
}

/// True for `float x`: in a declaration with a type of its own, a name alone stands for a part of it.
bool declares(const std::vector<std::string>& words) {
    for (size_t i = 0; i + 1 < words.size(); ++i)
        if (is_word_token(words[i]) && is_word_token(words[i + 1])) return true;
    return false;
}

/// True if two runs of words of one length have the same operators and numbers: `a > b` does not stand for `a <= b`,
/// nor `a [ 8 ]` for `a [ 12 ]`.
bool same_operators(const std::vector<std::string>& source, size_t first, size_t end,
                    const std::vector<std::string>& target, size_t there) {
    for (size_t i = first; i < end; ++i) {
        const std::string &here = source[i], &other = target[there + (i - first)];
        const bool name = is_word_token(here) || is_number_token(here);
        if (name != (is_word_token(other) || is_number_token(other))) return false;
        if (!name && here != other && !(is_accessor(here) && is_accessor(other))) return false;
        if (is_number_token(here) && is_number_token(other) && number_value(here) != number_value(other)) return false;
    }
    return true;
}

/// Where a parameter lies is true of that function's parameters alone: what a kernel is handed in `__constant` memory
/// may come in `__global` memory there, and `__constant` stays what it is for all else.
bool is_address_space(std::string_view word) {
    return is_one_of(word, {"__global", "__local", "__constant", "__private", "global", "local", "constant", "device",
                            "threadgroup", "thread"});
}

/// What a phrase goes by that is true of heads alone.
std::string in_heads(const std::string& phrase) { return "\x02" + phrase; }

/// True if a phrase has a comma outside of brackets.
bool lists_several(const std::string& phrase) {
    int depth = 0;
    for (const char c : phrase) {
        depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
        if (depth == 0 && c == ',') return true;
    }
    return false;
}

bool is_hexadecimal(std::string_view number) { return number.size() > 1 && (number[1] == 'x' || number[1] == 'X'); }

bool is_real(std::string_view number) {
    return !is_hexadecimal(number) &&
           (number.find('.') != std::string_view::npos || number.find_first_of("eE") != std::string_view::npos ||
            number.back() == 'f' || number.back() == 'F');
}

/// A name cut where it changes its manner: `mutable`, `_`, `cpu`, `_`, `data` of `mutable_cpu_data`, `Forward` and
/// `Gpu` of `ForwardGpu`.
std::vector<std::string_view> parts_of_name(std::string_view name) {
    const auto kind = [](char c) { return c == '_' ? 0 : c >= '0' && c <= '9' ? 1 : c >= 'A' && c <= 'Z' ? 2 : 3; };
    std::vector<std::string_view> out;
    size_t first = 0;
    for (size_t i = 1; i <= name.size(); ++i) {
        const bool goes_on = i < name.size() && (kind(name[i]) == kind(name[i - 1]) ||
                                                 (kind(name[i]) == 3 && kind(name[i - 1]) == 2 && i == first + 1));
        if (goes_on) continue;
        out.push_back(name.substr(first, i - first));
        first = i;
    }
    return out;
}

bool has_prefix(std::string_view name) { return name.size() > 2 && name[1] == '_' && name[0] != '_'; }

/// The mark of a number's type: 'f' or 'u'; for one without 'r' or 'i', as it is real or whole.
char mark_of(std::string_view number) {
    const char last = number.empty() ? ' ' : number.back();
    if (is_real(number)) return last == 'f' || last == 'F' ? 'f' : 'r';
    return last == 'u' || last == 'U' ? 'u' : 'i';
}

}  // namespace

std::string joined(const std::vector<std::string>& words, size_t first, size_t end) {
    std::string out;
    for (size_t i = first; i < end; ++i) {
        out += words[i];
        out += '\x1f';
    }
    return out;
}

void Examples::learn(const AlignedText& source, const AlignedText& target, const Alignment& alignment) {
    for (size_t c = 0; c < source.clauses.size(); ++c) {
        const size_t other = alignment.clause_of[c];
        if (other == Alignment::kNone || source.clauses[c].closes) continue;
        const Clause &here = source.clauses[c], &there = target.clauses[other];
        // Where a run of the source's words ends in the target; kNone where the word beside it has no counterpart.
        const auto before = [&](size_t i) {
            if (i == here.first) return there.first;
            const size_t k = alignment.word_of[i - 1];
            return k == Alignment::kNone ? k : k + 1;
        };
        for (size_t i = here.first; i < here.end; ++i)
            if (const size_t k = alignment.word_of[i]; k != Alignment::kNone && is_number_token(source.words[i]) &&
                                                       is_number_token(target.words[k]) &&
                                                       number_value(source.words[i]) == number_value(target.words[k]))
                ++marks_[{mark_of(source.words[i]), mark_of(target.words[k])}];
        const auto after = [&](size_t i) { return i == here.end ? there.end : alignment.word_of[i]; };
        // What a function gives back, and how it is called, is true of its head alone.
        size_t from = here.first;
        if (c == 0)
            while (from < here.end && source.words[from] != "(") ++from;
        for (size_t i = from; i < here.end; ++i) {
            const size_t first = before(i);
            if (first == Alignment::kNone || is_bound(source.words[i])) continue;
            for (size_t end = i + 1; end <= std::min(here.end, i + kLongest); ++end) {
                const size_t last = after(end);
                if (last == Alignment::kNone || last < first || last - first > 2 * kLongest) continue;
                if (is_prefix(source.words, i, end) && (last == first || is_prefix(target.words, first, last)) &&
                    (i == here.first || !is_accessor(source.words[i - 1]))) {
                    note(source, i, end, target, first, last);
                    continue;
                }
                if (last == first || is_bound(source.words[end - 1]) || !stands_alone(source.words, i, end) ||
                    !stands_alone(target.words, first, last))
                    continue;
                // A parameter of the port's own is no part of how the next one is said.
                if (lists_several(joined(target.words, first, last)) && !lists_several(joined(source.words, i, end)) &&
                    c == 0)
                    continue;
                const std::vector<std::string> said(target.words.begin() + static_cast<std::ptrdiff_t>(first),
                                                    target.words.begin() + static_cast<std::ptrdiff_t>(last));
                if (end - i > 1 && said.size() == end - i && !same_operators(source.words, i, end, target.words, first))
                    continue;
                if (end - i > 1 && said.size() != end - i &&
                    (!is_primary(source.words, i, end) || !is_primary(target.words, first, last)))
                    continue;
                if (changes_number(source.words, i, end, said) || (end - i < said.size() && are_bound(said))) continue;
                // `threadIdx . x` may be `item . get_local_id ( 0 )`: that is no example of what `v . x` is.
                if (i > here.first && is_accessor(source.words[i - 1]) && said.size() > end - i &&
                    said.front() != source.words[i])
                    continue;
                if (end == i + 1 && said.size() != 1 && (word_is(source.words[i], kKeyword) || declares(said)))
                    continue;
                // `const T a` for `Image a`: of what kind a parameter is says nothing of `const`.
                if (end == i + 1 && word_is(source.words[i], kQualifier) && !is_address_space(source.words[i]) &&
                    said.size() == 1 && !word_is(said[0], kQualifier) && !is_address_space(said[0]))
                    continue;
                // `Vec ( x , y )` for `( float2 ) ( x , y )` tells how values are made, not what the type is called.
                if (end == i + 1 && said.size() == 3 && said.front() == "(" && said.back() == ")" && is_name(said[1]))
                    continue;
                note(source, i, end, target, first, last);
            }
        }
    }
    learn_parameter_types(source, target, alignment);
    learn_statements(source, target, alignment);
}

/// `REAL4 z` is `CVector4 & z` there: a parameter's type is that of what it stands for, however it is handed over.
void Examples::learn_parameter_types(const AlignedText& source, const AlignedText& target, const Alignment& alignment) {
    if (source.clauses.empty() || alignment.clause_of[0] != 0) return;
    // The type alone in front of a name, and whether the name is a reference; kNone for pointers and what has more
    // words.
    const auto type_before = [](const AlignedText& text, size_t name) -> std::pair<size_t, bool> {
        const bool refers = name > 1 && text.words[name - 1] == "&";
        const size_t type = name - (refers ? 2 : 1);
        const bool is_alone =
            type > 1 && is_name(text.words[type]) &&
            (text.words[type - 1] == "," || text.words[type - 1] == "(" || (refers && text.words[type - 1] == "const"));
        return {is_alone ? type : Alignment::kNone, refers};
    };
    const Clause& here = source.clauses[0];
    for (size_t i = here.first + 2; i + 1 < here.end; ++i) {
        const size_t k = alignment.word_of[i];
        const bool ends = source.words[i + 1] == "," || source.words[i + 1] == ")";
        if (!ends || k == Alignment::kNone || k < target.clauses[0].first + 2 || source.words[i] != target.words[k])
            continue;
        const auto [type, refers] = type_before(source, i);
        const auto [said, refers_there] = type_before(target, k);
        if (type != Alignment::kNone && said != Alignment::kNone && refers != refers_there)
            note(source, type, type + 1, target, said, said + 1);
    }
}

/// Where each time one statement of the source and one of the target, as unlike as they are, stand between the same
/// neighbours, they say the same: `__syncthreads ( ) ;` and `item . barrier ( ) ;`.
void Examples::learn_statements(const AlignedText& source, const AlignedText& target, const Alignment& alignment) {
    std::map<std::string, std::vector<std::pair<size_t, size_t>>> found;
    const auto is_statement = [](const AlignedText& text, const Clause& clause) {
        return !clause.opens && !clause.closes && text.words[clause.end - 1] == ";";
    };
    for (size_t c = 1; c + 1 < source.clauses.size(); ++c) {
        const size_t left = alignment.clause_of[c - 1], right = alignment.clause_of[c + 1];
        if (alignment.clause_of[c] != Alignment::kNone || left == Alignment::kNone || right != left + 2) continue;
        const Clause &here = source.clauses[c], &there = target.clauses[left + 1];
        if (!is_statement(source, here) || !is_statement(target, there) || here.size() > kLongest) continue;
        found[joined(source.words, here.first, here.end)].emplace_back(c, left + 1);
    }
    for (const auto& [words, places] : found) {
        const Clause& first = target.clauses[places.front().second];
        const std::string said = joined(target.words, first.first, first.end);
        const bool always = std::all_of(places.begin(), places.end(), [&](const auto& place) {
            const Clause& there = target.clauses[place.second];
            return joined(target.words, there.first, there.end) == said;
        });
        if (places.size() < 2 || !always) continue;
        const Clause& here = source.clauses[places.front().first];
        for (size_t i = 0; i < places.size(); ++i)
            note(source, here.first, here.end - 1, target, first.first, first.end - 1);
    }
}

bool Examples::is_said_variously(const std::string& word) const {
    const auto found = phrases_.find(word + '\x1f');
    return found != phrases_.end() && found->second.times.size() > 1;
}

bool Examples::knows_mark_of(std::string_view written) const {
    const char mark = mark_of(written);
    return std::any_of(marks_.begin(), marks_.end(), [&](const auto& row) { return row.first.first == mark; });
}

std::string Examples::marked(const std::string& written) { return mark_of(written) == 'r' ? written + "f" : written; }

std::string Examples::number(std::string_view written) const {
    const char mark = mark_of(written);
    const auto times = [&](char there) {
        const auto found = marks_.find({mark, there});
        return found == marks_.end() ? size_t{0} : found->second;
    };
    std::string out(written);
    const char other = mark == 'f' ? 'r' : mark == 'r' ? 'f' : mark == 'u' ? 'i' : 'u';
    if (times(other) <= times(mark)) return out;
    if (mark == 'f' || mark == 'u')
        out.pop_back();
    else
        out += other;
    return out;
}

void Examples::note(const AlignedText& source, size_t first, size_t end, const AlignedText& target, size_t there,
                    size_t there_end) {
    const std::string phrase = joined(source.words, first, end);
    const bool of_head = is_address_space(source.words[first]) && first < source.clauses.front().end;
    Said& known = phrases_[of_head ? in_heads(phrase) : phrase];
    ++known.times[joined(target.words, there, there_end)];
    ++known.all;
    if (end - first != 1 || there_end - there != 1) return;
    const std::string &here = source.words[first], &said = target.words[there];
    if (!is_word_token(here) || !is_word_token(said)) return;
    if (has_prefix(here) && (here == said || folded(here).substr(1) == folded(said))) prefixed_.emplace(here, said);
    if (here != said) return note_name(here, said);
    kept_.insert(here);
    for (const std::string_view part : parts_of_name(here)) kept_parts_.emplace(part);
}

void Examples::note_name(const std::string& here, const std::string& said) {
    // `hipFree` is `cudaFree`: what both end with, from a capital letter on, is the name.
    size_t same = 0;
    while (same < std::min(here.size(), said.size()) && here[here.size() - 1 - same] == said[said.size() - 1 - same])
        ++same;
    while (same > 0 && (here[here.size() - same] < 'A' || here[here.size() - same] > 'Z')) --same;
    constexpr size_t kShortest = 4;
    if (same >= kShortest && same < here.size() && same < said.size())
        begins_[here.substr(0, here.size() - same)][said.substr(0, said.size() - same)].insert(here);
    note_part(here, said);
    note_part_gained(here, said);
}

/// `blas_gpu_add` for `blas_add`: a part and what binds it, behind the first part.
void Examples::note_part_gained(const std::string& here, const std::string& said) {
    const std::vector<std::string_view> mine = parts_of_name(here), theirs = parts_of_name(said);
    constexpr size_t kGained = 2;
    if (mine.size() < 3 || theirs.size() != mine.size() + kGained || mine[1] != "_" || theirs[3] != "_") return;
    if (!std::equal(mine.begin(), mine.begin() + kGained, theirs.begin()) ||
        !std::equal(mine.begin() + kGained, mine.end(), theirs.begin() + 2 * kGained))
        return;
    const std::string begin = std::string(mine[0]) + "_";
    gained_[begin][begin + std::string(theirs[2]) + "_"].insert(here);
}

std::optional<std::string> Examples::with_part_gained(std::string_view word) const {
    const size_t cut = word.find('_');
    const auto found = cut == std::string_view::npos ? gained_.end() : gained_.find(word.substr(0, cut + 1));
    if (found == gained_.end()) return std::nullopt;
    const auto& [said, names] = *found->second.begin();
    const auto kept = kept_.lower_bound(found->first);
    const bool some_stay = kept != kept_.end() && kept->starts_with(found->first);
    if (some_stay || found->second.size() != 1 || names.size() < 2) return std::string();
    return word.starts_with(said) ? std::string(word) : said + std::string(word.substr(cut + 1));
}

void Examples::note_part(const std::string& here, const std::string& said) {
    const std::vector<std::string_view> mine = parts_of_name(here), theirs = parts_of_name(said);
    if (mine.size() != theirs.size() || mine.size() < 2) return;
    size_t other = mine.size();
    for (size_t i = 0; i < mine.size(); ++i) {
        if (mine[i] == theirs[i]) continue;
        if (other != mine.size()) return;
        other = i;
    }
    if (other == mine.size() || mine[other].size() < 2 || !is_word_token(mine[other]) || !is_word_token(theirs[other]))
        return;
    parts_[std::string(mine[other])][std::string(theirs[other])].insert(here);
}

bool Examples::has_other_part(std::string_view word) const {
    const std::vector<std::string_view> parts = parts_of_name(word);
    return std::any_of(parts.begin(), parts.end(), [&](std::string_view part) { return parts_.contains(part); });
}

std::string Examples::with_prefix_there(std::string_view word) const {
    std::string name(word);
    if (!has_prefix(word)) return name;
    std::vector<std::pair<std::string, std::string>> alike;
    for (auto one = prefixed_.lower_bound(word.substr(0, 2));
         one != prefixed_.end() && one->first.starts_with(word.substr(0, 2)); ++one)
        alike.emplace_back(*one);
    if (alike.size() == 1 && alike[0].first != alike[0].second) return {};
    return alike.empty() ? name : name_in_manner(name, alike);
}

std::string Examples::with_other_part(std::string_view word) const {
    std::string out;
    size_t changed = 0;
    const std::vector<std::string_view> parts = parts_of_name(word);
    const size_t fewest = parts.size() > 2 ? 2 : 3;  // of a short name the part is much
    for (const std::string_view part : parts) {
        const auto found = parts_.find(part);
        if (found == parts_.end()) {
            out += part;
            continue;
        }
        const auto& [said, names] = *found->second.begin();
        if (found->second.size() != 1 || names.size() < fewest || kept_parts_.contains(part)) return {};
        out += said;
        ++changed;
    }
    return changed == 1 && parts.size() > 1 ? out : std::string();
}

std::string Examples::renamed(std::string_view word) const {
    for (size_t cut = word.size() - 1; cut > 0; --cut) {
        const auto found = begins_.find(word.substr(0, cut));
        if (found == begins_.end() || found->second.size() != 1 || found->second.begin()->second.size() < 2) continue;
        return found->second.begin()->first + std::string(word.substr(cut));
    }
    return {};
}

Examples::Phrase Examples::longest(const std::vector<std::string>& words, size_t at, size_t end, bool in_head) const {
    std::string key;
    if (in_head && at < words.size() && is_address_space(words[at])) key = in_heads(key);
    Phrase out;
    for (size_t i = at; i < std::min(end, at + kLongest); ++i) {
        key += words[i];
        key += '\x1f';
        // `aux . i < n && aux` must not part the last name from what picks a member of it.
        if (i + 1 < words.size() && is_accessor(words[i + 1]) && is_word_token(words[i]) &&
            !is_primary(words, at, i + 1))
            continue;
        const auto found = phrases_.find(key);
        if (found == phrases_.end()) continue;
        const auto& times = found->second.times;
        const auto most = std::max_element(times.begin(), times.end(), [](const auto& a, const auto& b) {
            return a.second != b.second ? a.second < b.second : a.first > b.first;
        });
        if (4 * most->second < 3 * found->second.all) continue;  // said in several ways: which one depends on more
        // What are several arguments there is nothing that can be called, or a member be picked of.
        if (i + 1 < words.size() && goes_on(words[i + 1]) && lists_several(most->first)) continue;
        out.length = i + 1 - at;
        out.target.clear();
        for (size_t k = 0; k < most->first.size();) {
            const size_t cut = most->first.find('\x1f', k);
            out.target.push_back(most->first.substr(k, cut - k));
            k = cut + 1;
        }
    }
    return out;
}

}  // namespace porttool
