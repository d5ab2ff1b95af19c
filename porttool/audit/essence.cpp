// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/essence.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/statements.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

/// True where an operand begins behind these words: a `*`, `&` or `-` there has one operand.
bool begins_operand(const Text& before) {
    if (before.empty()) return true;
    const std::string& last = before.back();
    if (last == "return") return true;
    return !is_word_token(last) && !is_number_token(last) && last != ")" && last != "]";
}

/// The place of the `=` that gives the statement's variable its value, or the end.
size_t assignment_in(const Text& words) {
    int depth = 0;
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "(" || words[i] == "[" || words[i] == "{") ++depth;
        if (words[i] == ")" || words[i] == "]" || words[i] == "}") --depth;
        if (depth == 0 && words[i] == "=") return i;
    }
    return words.size();
}

/// True for `a += b`: no declaration, whatever stands on its right side.
bool steps_value(const Text& words) {
    constexpr std::string_view kSigns = "+-*/%&|^";
    for (size_t i = 1; i < words.size() && words[i] != "(" && words[i] != "="; ++i)
        if (words[i].size() == 2 && words[i][1] == '=' && kSigns.find(words[i][0]) != std::string_view::npos)
            return true;
    return false;
}

/// Without the words of a declaration before its name.
Text without_declaration(const Text& words) {
    const size_t end = assignment_in(words);
    size_t name = 0;
    for (size_t i = 0; i < end; ++i) {
        const bool after_word =
            i > 0 && (is_word_token(words[i - 1]) || words[i - 1] == "*" || words[i - 1] == "&" || words[i - 1] == ">");
        if (words[i] == "(" || words[i] == "[" || words[i] == "." || words[i] == "->") break;
        if (is_word_token(words[i]) && after_word) name = i;
    }
    const bool control = !words.empty() && word_is(words[0], kKeyword) && !is_type_word(words[0]);
    if (control || steps_value(words)) return words;
    Text out(words.begin() + static_cast<ptrdiff_t>(name), words.end());
    const bool constructs =
        name > 0 && is_word_token(words[name - 1]) && out.size() > 2 && out[1] == "(" && out.back() == ")";
    if (constructs) out.insert(out.begin() + 1, {"=", words[name - 1]});
    return out;
}

/// Where the `)` of a cast stands that begins there; the place itself where none does. `( name ) name` is one whatever
/// the name.
size_t end_of_cast(const Text& words, size_t first, const Text& before) {
    if (words[first] != "(" || !begins_operand(before)) return first;
    size_t end = first + 1;
    bool is_type = false;
    for (; end < words.size() && (is_word_token(words[end]) || words[end] == "::"); ++end)
        is_type = is_type || is_type_word(words[end]);
    if (end == first + 1) return first;
    for (; end < words.size() && (words[end] == "*" || words[end] == "&"); ++end) is_type = true;
    if (end + 1 >= words.size() || words[end] != ")") return first;
    const std::string& next = words[end + 1];
    const bool alone = end == first + 2 && next == "(";
    return is_type || alone || is_word_token(next) || is_number_token(next) ? end : first;
}

/// Where the `]` of `& a . b [ i ]`, or the `)` of `& a . b ( i )`, stands that begins there, if nothing goes into the
/// element; else the place itself.
size_t end_of_element(const Text& words, size_t first) {
    size_t i = first + 1;
    while (i < words.size() && (is_word_token(words[i]) || words[i] == "." || words[i] == "->")) ++i;
    if (i == first + 1 || i >= words.size() || !is_one_of(words[i], {"[", "("})) return first;
    const std::string opens = words[i], closes = opens == "[" ? "]" : ")";
    int depth = 0;
    for (; i < words.size(); ++i) {
        depth += words[i] == opens ? 1 : words[i] == closes ? -1 : 0;
        if (depth == 1 && opens == "(" && words[i] == ",") return first;  // more than one place
        if (depth == 0) break;
    }
    if (opens == "(" && words[i > 0 ? i - 1 : 0] == "(") return first;
    const bool goes_on = i + 1 < words.size() &&
                         (words[i + 1] == "." || words[i + 1] == "->" || words[i + 1] == "[" || words[i + 1] == "(");
    return i >= words.size() || goes_on ? first : i;
}

/// Where the `>` of `< const T * >` stands that begins there; 0 where none does.
size_t at_type(const Text& words, size_t first) {
    int depth = 0;
    for (size_t i = first; i < words.size(); ++i) {
        depth += words[i] == "<" ? 1 : words[i] == ">" ? -1 : words[i] == ">>" ? -2 : 0;
        if (depth <= 0) return i > first ? i : 0;
        if (!is_word_token(words[i]) && !is_number_token(words[i]) &&
            !is_one_of(words[i], {"*", "&", "::", ",", "<", ">"}))
            return 0;
    }
    return 0;
}

/// True for a function that gives its argument as another type: `as_device_type ( x )`.
bool gives_as_type(const std::string& name) {
    constexpr std::string_view kEnd = "type";
    const std::string plain = folded(name);
    return plain.size() > kEnd.size() && plain.ends_with(kEnd) && plain != "decltype";
}

/// Without casts, and without what only says by which cache a value comes: `__ldg ( & a [ i ] )` is `( a [ i ] )`.
Text without_casts(const Text& words) {
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        if (const size_t end = end_of_cast(words, i, out); end != i) {
            i = end;
        } else if (is_one_of(folded(words[i]), {"staticcast", "reinterpretcast", "constcast"}) &&
                   at_type(words, i + 1) != 0) {
            i = at_type(words, i + 1);
        } else if (i > 0 && i + 1 < words.size() && words[i + 1] == "(" && gives_as_type(words[i])) {
            continue;
        } else if (words[i].ends_with("ldg") && i + 2 < words.size() && words[i + 1] == "(" && words[i + 2] == "&") {
            out.emplace_back("(");
            i += 2;
        } else {
            out.push_back(words[i]);
        }
    }
    return out;
}

/// `& a [ i ]`, `& ( a [ i ] )` and `& a ( i )` as `a + i`.
Text with_plain_places(const Text& words) {
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        const bool asks = words[i] == "&" && begins_operand(out);
        const bool in_brackets = asks && i + 1 < words.size() && words[i + 1] == "(";
        if (in_brackets) ++i;
        const size_t end = asks ? end_of_element(words, i) : i;
        if (end == i || (in_brackets && (end + 1 >= words.size() || words[end + 1] != ")"))) {
            out.push_back(words[i]);
            continue;
        }
        const std::string opens = words[end] == ")" ? "(" : "[";
        const bool at_start = words[end - 1] == "0" && words[end - 2] == opens;
        bool opened = false;
        for (size_t k = i + 1; k < end; ++k) {
            if (words[k] == opens && !opened) {
                opened = true;
                if (at_start) break;
                out.emplace_back("+");
            } else {
                out.push_back(words[k]);
            }
        }
        i = in_brackets ? end + 1 : end;
    }
    return out;
}

/// Where `& a . b . x )` ends that begins there, behind its `)`, and how long the way to the vector is; the place
/// itself where none does.
std::pair<size_t, size_t> end_of_vector_place(const Text& words, size_t first) {
    if (first + 4 >= words.size() || words[first] != "&" || !is_word_token(words[first + 1])) return {first, 0};
    size_t i = first + 2;
    while (i + 1 < words.size() && is_one_of(words[i], {".", "->"}) && is_word_token(words[i + 1])) i += 2;
    const bool is_vector = i > first + 3 && i < words.size() && words[i] == ")" && words[i - 1] == "x";
    return is_vector ? std::pair(i + 1, i - 2 - (first + 1)) : std::pair(first, size_t{0});
}

/// A vector that is read or written by the address of its first component as the vector itself: `LOAD3 ( & p . n . x )`
/// and `vload3 ( 0 , & p . n . x )` are `p . n`, and `STORE3 ( v , & p . n . x )` is `p . n = v`.
Text with_plain_vectors(const Text& words) {
    Text out;
    const auto is_named = [](const std::string& word, std::string_view what) {
        return is_word_token(word) && in_small_letters(word).find(what) != std::string::npos;
    };
    for (size_t i = 0; i < words.size(); ++i) {
        const bool calls = i + 2 < words.size() && words[i + 1] == "(";
        const bool loads = calls && is_named(words[i], "load");
        const size_t place = i + (loads && words[i + 2] == "0" && words[i + 3] == "," ? 4 : 2);
        if (const auto [end, way] = end_of_vector_place(words, place); loads && end > place) {
            out.insert(out.end(), words.begin() + static_cast<ptrdiff_t>(place) + 1,
                       words.begin() + static_cast<ptrdiff_t>(place + 1 + way));
            i = end - 1;
            continue;
        }
        out.push_back(words[i]);
    }
    if (out.size() < 6 || out[1] != "(" || !is_named(out[0], "store")) return out;
    const auto comma = std::find(out.rbegin(), out.rend(), ",");
    if (comma == out.rend()) return out;
    const auto at = static_cast<size_t>(out.rend() - comma);
    const auto [end, way] = end_of_vector_place(out, at);
    if (end != out.size() || at < 4) return out;
    Text set(out.begin() + static_cast<ptrdiff_t>(at) + 1, out.begin() + static_cast<ptrdiff_t>(at + 1 + way));
    set.emplace_back("=");
    set.insert(set.end(), out.begin() + 2, out.begin() + static_cast<ptrdiff_t>(at) - 1);
    return set;
}

/// Without `*` and `&` before an operand, template arguments and the names of what holds a name.
Text without_marks(const Text& words) {
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        if ((words[i] == "*" || words[i] == "&") && begins_operand(out)) continue;
        if (words[i] == "<" && i > 0 && is_word_token(words[i - 1])) {
            size_t end = i + 1;
            while (
                end < words.size() && end < i + 8 &&
                (is_word_token(words[end]) || is_number_token(words[end]) || words[end] == "," || words[end] == "::"))
                ++end;
            if (end + 1 < words.size() && words[end] == ">" && words[end + 1] == "(") {
                i = end;
                continue;
            }
        }
        const size_t held = words[i][0] == '"' ? std::string::npos : words[i].rfind("::");
        out.push_back(words[i] == "->"                                           ? "."
                      : held == std::string::npos || held + 2 == words[i].size() ? words[i]
                                                                                 : words[i].substr(held + 2));
    }
    return out;
}

/// `a ++` and `++ a` as `a += 1`, where nothing else takes the value.
Text with_plain_steps(const Text& words) {
    Text out;
    const auto ends = [&](size_t i) {
        return i >= words.size() || words[i] == ")" || words[i] == ";" || words[i] == ",";
    };
    const auto begins = [&] { return out.empty() || out.back() == ";" || out.back() == ","; };
    const auto is_step = [](const std::string& word) { return word == "++" || word == "--"; };
    for (size_t i = 0; i < words.size(); ++i) {
        const bool before =
            i + 1 < words.size() && is_step(words[i]) && is_word_token(words[i + 1]) && begins() && ends(i + 2);
        const bool behind =
            i + 1 < words.size() && is_step(words[i + 1]) && is_word_token(words[i]) && begins() && ends(i + 2);
        if (!before && !behind) {
            out.push_back(words[i]);
            continue;
        }
        out.push_back(words[before ? i + 1 : i]);
        out.push_back(words[before ? i : i + 1].substr(0, 1) + "=");
        out.emplace_back("1");
        ++i;
    }
    return out;
}

/// `a += b` as `a = a + b`.
Text with_plain_assignment(const Text& words) {
    for (size_t i = 1; i < words.size() && words[i] != "("; ++i) {
        const std::string& sign = words[i];
        constexpr std::string_view kSigns = "+-*/%&|^";
        if (sign.size() != 2 || sign[1] != '=' || kSigns.find(sign[0]) == std::string_view::npos) continue;
        Text out(words.begin(), words.begin() + static_cast<ptrdiff_t>(i));
        out.emplace_back("=");
        out.insert(out.end(), words.begin(), words.begin() + static_cast<ptrdiff_t>(i));
        out.push_back(sign.substr(0, 1));
        out.insert(out.end(), words.begin() + static_cast<ptrdiff_t>(i) + 1, words.end());
        return out;
    }
    return words;
}

bool hands_out_memory(const std::string& method) {
    return is_one_of(folded(method), {"data", "get", "cstr", "getdata", "getconstdata", "constdata", "ptr"});
}

/// `seed` of `getSeed` and `get_seed`; "" for other names.
std::string what_is_got(const std::string& method) {
    constexpr std::string_view kStart = "get";
    const std::string plain = folded(method);
    return plain.size() > kStart.size() + 2 && plain.starts_with(kStart) ? plain.substr(kStart.size()) : "";
}

/// Methods as functions of their object: `a . b . Length ( x )` is `Length ( a . b , x )`. Those that hand out what
/// their object holds are left out: `a . data ( )` is `a`, and `a . getSeed ( )` is `a . seed`.
Text with_plain_calls(const Text& words) {
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        const bool calls = words[i] == "." && i > 0 && i + 2 < words.size() && is_word_token(words[i - 1]) &&
                           is_word_token(words[i + 1]) && words[i + 2] == "(" && i + 3 < words.size();
        if (!calls) {
            out.push_back(words[i]);
            continue;
        }
        if (words[i + 3] == ")" && hands_out_memory(words[i + 1])) {
            i += 3;
            continue;
        }
        if (const std::string member = what_is_got(words[i + 1]); words[i + 3] == ")" && !member.empty()) {
            out.insert(out.end(), {".", member});
            i += 3;
            continue;
        }
        size_t first = out.size() - 1;  // of the object
        while (first >= 2 && out[first - 1] == "." && is_word_token(out[first - 2])) first -= 2;
        out.insert(out.begin() + static_cast<ptrdiff_t>(first), {words[i + 1], "("});
        i += 2;
        if (i + 1 < words.size() && words[i + 1] != ")") out.emplace_back(",");
    }
    return out;
}

/// `a == NULL` as `! a` and `a != NULL` as `a`.
Text with_plain_nulls(const Text& words) {
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        const bool compares = (words[i] == "==" || words[i] == "!=") && i > 0 && i + 1 < words.size() &&
                              is_one_of(words[i + 1], {"NULL", "nullptr"});
        if (!compares) {
            out.push_back(words[i]);
            continue;
        }
        size_t first = out.size();  // of the operand
        for (int depth = 0; first > 0; --first) {
            const std::string& last = out[first - 1];
            depth += last == "]" ? 1 : last == "[" ? -1 : 0;
            if (depth < 0 || (depth == 0 && last != "[" && last != "." && !is_word_token(last))) break;
        }
        if (words[i] == "==") out.insert(out.begin() + static_cast<ptrdiff_t>(first), "!");
        ++i;
    }
    return out;
}

/// The end of the way to a value that begins there, `a . b`; the place itself where none does.
size_t end_of_way(const Text& words, size_t first) {
    if (first >= words.size() || !is_word_token(words[first])) return first;
    size_t end = first + 1;
    while (end + 1 < words.size() && words[end] == "." && is_word_token(words[end + 1])) end += 2;
    return end;
}

/// Where `v . x , v . y , v . z` ends that begins there, behind all its components, and how long the way to `v` is; the
/// place itself where a list has less than three.
std::pair<size_t, size_t> end_of_components(const Text& words, size_t first) {
    constexpr std::string_view kComponents = "xyzw";
    constexpr size_t kFewest = 3;
    const size_t end = end_of_way(words, first);
    if (end < first + 3 || words[end - 1] != "x") return {first, 0};
    const size_t way = end - first - 2;
    size_t at = end, found = 1;
    while (found < kComponents.size() && at < words.size() && words[at] == "," &&
           end_of_way(words, at + 1) == at + 1 + way + 2 && words[at + way + 2] == kComponents.substr(found, 1) &&
           std::equal(words.begin() + static_cast<ptrdiff_t>(first),
                      words.begin() + static_cast<ptrdiff_t>(first + way),
                      words.begin() + static_cast<ptrdiff_t>(at + 1))) {
        at += way + 3;
        ++found;
    }
    const bool ends = at >= words.size() || words[at] == "," || words[at] == ")";
    return found >= kFewest && ends ? std::pair(at, way) : std::pair(first, size_t{0});
}

bool is_zero(const std::string& word) {
    return is_number_token(word) && word.find_first_not_of("0.fFuUlL") == std::string::npos;
}

/// `( v . x , v . y , v . z )` as `( v )`, and a list of zeros, `( 0 , 0 , 0 )`, as `( )`: so an empty list is read.
Text with_whole_vectors(const Text& words) {
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        const bool begins = i > 0 && (words[i - 1] == "(" || words[i - 1] == ",");
        const auto [end, way] = begins ? end_of_components(words, i) : std::pair(i, size_t{0});
        if (end != i) {
            out.insert(out.end(), words.begin() + static_cast<ptrdiff_t>(i),
                       words.begin() + static_cast<ptrdiff_t>(i + way));
            i = end - 1;
            continue;
        }
        out.push_back(words[i]);
        if (words[i] != "(") continue;
        size_t close = i + 1;
        while (close + 1 < words.size() && is_zero(words[close]) && words[close + 1] == ",") close += 2;
        const bool fills = i > 0 && is_type_word(words[i - 1]);  // with the one number
        const bool zeros =
            (close > i + 1 || fills) && close + 1 < words.size() && is_zero(words[close]) && words[close + 1] == ")";
        if (zeros) i = close;
    }
    return out;
}

}  // namespace

std::string plain_word(const std::string& word, const Dialect& dialect) {
    constexpr size_t kShort = 3;  // N and n are two things
    if (is_number_token(word)) return number_value(word);
    if (!is_word_token(word) || word.size() < kShort) return word;
    if (const std::string* known = dialect.find(in_small_letters(word)); known != nullptr && !known->empty())
        return *known;
    return folded(word);
}

Text essence_of(const Text& words, const Dialect& dialect) {
    Text out = with_plain_nulls(with_plain_assignment(with_plain_steps(with_plain_calls(
        without_marks(with_plain_places(with_plain_vectors(without_casts(without_declaration(words)))))))));
    for (std::string& word : out) word = plain_word(word, dialect);
    std::erase_if(out, [](const std::string& word) { return word == "this"; });
    return with_whole_vectors(out);
}

}  // namespace porttool
