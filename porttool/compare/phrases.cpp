// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/phrases.h"

#include <algorithm>
#include <array>
#include <map>

#include "porttool/compare/runtime_calls.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

std::string_view word(const Text& words, size_t i) { return i < words.size() ? words[i] : std::string_view(); }

bool is_axis(std::string_view text) { return text == "x" || text == "y" || text == "z"; }

/// How many words `W . x` takes at `i`; 0 if that is not there.
bool is_index(const Text& words, size_t i, std::string_view name) {
    return word(words, i) == name && word(words, i + 1) == "." && is_axis(word(words, i + 2));
}

/// `get_local_id(0)` and its like, under their common names.
Text with_named_axes(const Text& words) {
    constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        out.push_back(words[i]);
        const bool known = is_one_of(words[i], {"local_id", "group_id", "group_size", "group_count", "global_id"});
        if (!known || (i > 0 && words[i - 1] == ".") || word(words, i + 1) != "(" || word(words, i + 3) != ")")
            continue;
        const std::string_view axis = word(words, i + 2);
        if (axis != "0" && axis != "1" && axis != "2") continue;
        out.insert(out.end(), {".", std::string(kAxes.at(static_cast<size_t>(axis[0] - '0')))});
        i += 3;
    }
    return out;
}

/// How many words of a product of the group's number and size stand at `i`, along one axis; 0 if none does.
size_t product_at(const Text& words, size_t i) {
    const bool brackets = word(words, i) == "(";
    const size_t first = i + (brackets ? 1 : 0);
    const bool is_product = word(words, first + 3) == "*" && word(words, first + 2) == word(words, first + 6) &&
                            ((is_index(words, first, "group_id") && is_index(words, first + 4, "group_size")) ||
                             (is_index(words, first, "group_size") && is_index(words, first + 4, "group_id")));
    if (!is_product || (brackets && word(words, first + 7) != ")")) return 0;
    return brackets ? 9 : 7;
}

/// How many words at `i` are the number of the thread among all, along one axis.
size_t global_id_at(const Text& words, size_t i) {
    if (i > 0 && !is_one_of(words[i - 1], {"=", "(", ",", "[", "return", "+", "+=", "<", ">", "==", "&&", "||"}))
        return 0;
    size_t end = 0;
    std::string_view axis, other;
    if (const size_t product = product_at(words, i); product > 0) {
        const size_t local = i + product + 1;
        if (word(words, local - 1) != "+" || !is_index(words, local, "local_id")) return 0;
        axis = word(words, i + (product == 9 ? 3 : 2));
        other = word(words, local + 2);
        end = local + 3;
    } else if (is_index(words, i, "local_id") && word(words, i + 3) == "+") {
        const size_t second = product_at(words, i + 4);
        if (second == 0) return 0;
        axis = word(words, i + 2);
        other = word(words, i + 4 + (second == 9 ? 3 : 2));
        end = i + 4 + second;
    }
    const bool goes_on = is_one_of(word(words, end), {"*", "/", "%", ".", "["});
    return end > 0 && axis == other && !goes_on ? end - i : 0;
}

Text with_global_ids(const Text& words) {
    Text out;
    for (size_t i = 0; i < words.size();) {
        const size_t length = global_id_at(words, i);
        if (length == 0) {
            out.push_back(words[i++]);
            continue;
        }
        const bool local_first = words[i] == "local_id";
        const std::string axis = words[local_first ? i + 2 : i + length - 1];
        out.insert(out.end(), {"global_id", ".", axis});
        i += length;
    }
    return out;
}

/// The number of components of `vec4`, `ivec2`; 0 for what is no vector.
size_t vector_size(std::string_view type) {
    for (const std::string_view family : {"vec", "ivec", "uvec"})
        if (type.size() == family.size() + 1 && type.starts_with(family) && type.back() >= '2' && type.back() <= '4')
            return static_cast<size_t>(type.back() - '0');
    return 0;
}

/// An argument that has no effect and costs nothing to say twice: names, numbers and members.
bool is_plain_value(const Text& argument) {
    return !argument.empty() && std::all_of(argument.begin(), argument.end(), [](const std::string& each) {
        return is_word_token(each) || is_number_token(each) || each == "." || each == "-";
    });
}

/// The arguments of the constructor whose bracket is at `open`, if all are plain values; where it ends in `end`.
std::vector<Text> plain_arguments(const Text& words, size_t open, size_t& end) {
    constexpr size_t kLongest = 64;
    std::vector<Text> out(1);
    for (size_t i = open + 1; i < words.size() && i < open + kLongest; ++i) {
        if (words[i] == ")") {
            end = i + 1;
            const bool plain = std::all_of(out.begin(), out.end(), is_plain_value);
            return plain ? out : std::vector<Text>();
        }
        if (words[i] == "(" || words[i] == "[" || words[i] == "{") return {};
        if (words[i] == ",")
            out.emplace_back();
        else
            out.back().push_back(words[i]);
    }
    return {};
}

/// `xy` of the arguments `v . x` and `v . y`; "" if they are no components of one vector.
std::string joint_components(const std::vector<Text>& arguments) {
    std::string out;
    for (const Text& argument : arguments) {
        const size_t n = argument.size();
        const bool is_component = n >= 3 && argument[n - 2] == "." && argument[n - 1].size() == 1 &&
                                  std::string_view("xyzw").find(argument[n - 1][0]) != std::string_view::npos;
        if (!is_component || n != arguments[0].size() ||
            !std::equal(argument.begin(), argument.end() - 1, arguments[0].begin()))
            return "";
        out += argument[n - 1];
    }
    return out;
}

Text with_plain_constructors(const Text& words) {
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        const size_t size = word(words, i + 1) == "(" ? vector_size(words[i]) : 0;
        size_t end = 0;
        const std::vector<Text> arguments = size > 0 ? plain_arguments(words, i + 1, end) : std::vector<Text>();
        if (arguments.size() != size || size == 0) {
            out.push_back(words[i]);
            continue;
        }
        if (const std::string components = joint_components(arguments); !components.empty()) {
            out.insert(out.end(), arguments[0].begin(), arguments[0].end() - 1);
            out.push_back(components);
        } else {
            const bool alike = std::all_of(arguments.begin(), arguments.end(),
                                           [&](const Text& argument) { return argument == arguments[0]; });
            if (alike) {
                out.insert(out.end(), {words[i], "("});
                out.insert(out.end(), arguments[0].begin(), arguments[0].end());
                out.emplace_back(")");
            } else {
                out.insert(out.end(), words.begin() + static_cast<std::ptrdiff_t>(i),
                           words.begin() + static_cast<std::ptrdiff_t>(end));
            }
        }
        i = end - 1;
    }
    return out;
}

constexpr size_t kLongestLaunch = 512;  // words, of a configuration and of a kernel's name each

/// Behind the bracket that closes the one at `open`; 0 if none does soon.
size_t after_brackets(const Text& words, size_t open) {
    int depth = 0;
    for (size_t i = open; i < words.size() && i < open + kLongestLaunch; ++i) {
        if (words[i] == "(" || words[i] == "[" || words[i] == "{") ++depth;
        if (words[i] == ")" || words[i] == "]" || words[i] == "}") --depth;
        if (depth == 0) return i + 1;
    }
    return 0;
}

/// True if there is a comma directly within the brackets [first, end).
bool has_parts(const Text& words, size_t first, size_t end) {
    int depth = 0;
    for (size_t i = first; i < end; ++i) {
        depth += words[i] == "(" || words[i] == "[" || words[i] == "{" ? 1 : 0;
        depth -= words[i] == ")" || words[i] == "]" || words[i] == "}" ? 1 : 0;
        if (depth == 1 && words[i] == ",") return true;
    }
    return false;
}

/// What stands between commas in [first, end); `dim3 ( n )` of one number is `n`, and brackets around all of it go.
std::vector<Text> launch_arguments(const Text& words, size_t first, size_t end) {
    std::vector<Text> out(1);
    int depth = 0;
    for (size_t i = first; i < end; ++i) {
        if (words[i] == "(" || words[i] == "[" || words[i] == "{") ++depth;
        if (words[i] == ")" || words[i] == "]" || words[i] == "}") --depth;
        if (depth == 0 && words[i] == ",")
            out.emplace_back();
        else
            out.back().push_back(words[i]);
    }
    for (Text& argument : out) {
        const bool is_named = is_one_of(word(argument, 0), {"dim3", "HIP_KERNEL_NAME", "cudakernelname"});
        const size_t open = is_named ? 1 : 0;
        if (word(argument, open) != "(" || after_brackets(argument, open) != argument.size()) continue;
        const bool one =
            !is_named || argument[0] != "dim3" || std::find(argument.begin(), argument.end(), ",") == argument.end();
        if (one) argument = Text(argument.begin() + static_cast<std::ptrdiff_t>(open) + 1, argument.end() - 1);
    }
    return out;
}

/// Where the kernel's name begins that ends before `at`, template arguments and scopes included.
size_t kernel_name_before(const Text& words, size_t at) {
    size_t first = at;
    if (first > 0 && words[first - 1] == ">") {
        int depth = 0;
        while (first > 0 && at - first < kLongestLaunch) {
            --first;
            if (words[first] == ">") ++depth;
            if (words[first] == "<" && --depth == 0) break;
        }
    }
    if (first == 0 || !is_word_token(words[first - 1])) return at;
    --first;
    while (first > 1 && words[first - 1] == "::" && is_word_token(words[first - 2])) first -= 2;
    return first;
}

void add_launch(Text& out, std::vector<Text> arguments) {
    out.insert(out.end(), {"hipLaunchKernelGGL", "("});
    for (size_t i = 0; i < arguments.size(); ++i) {
        if (i > 0) out.emplace_back(",");
        out.insert(out.end(), arguments[i].begin(), arguments[i].end());
    }
    out.emplace_back(")");
}

/// True where a parenthesis before `at` opens the arguments of a call, or follows a cast.
bool ends_operand(const Text& words, size_t at) {
    if (at == 0) return false;
    const std::string& last = words[at - 1];
    return last == ")" || last == "]" || last == ">" || is_number_token(last) ||
           (is_word_token(last) && last != "return");
}

/// The parenthesis that closes the idle one at `open`; 0 if that is none.
size_t end_of_idle(const Text& words, size_t open) {
    const auto is_value = [](std::string_view text) { return is_word_token(text) || is_number_token(text); };
    if (!is_value(word(words, open + 1))) return 0;
    size_t end = open + 2;
    while (is_one_of(word(words, end), {".", "->"}) && is_word_token(word(words, end + 1))) end += 2;
    const std::string_view next = word(words, end + 1);
    if (word(words, end) != ")" || is_value(next) || next == "(" || next == "{") return 0;
    const bool may_be_type = end == open + 2 && is_word_token(words[open + 1]);
    return may_be_type && is_one_of(next, {"*", "&", "-", "+", "!", "~", "++", "--"}) ? 0 : end;
}

/// Behind the operand at `at`: a name or number with members, elements and calls of it, or something in parentheses.
/// `at` if none is there.
size_t after_operand(const Text& words, size_t at) {
    constexpr size_t kLongest = 256;
    const std::string_view first = word(words, at);
    if (first == "(") {
        const size_t closed = after_brackets(words, at);
        return closed == 0 ? at : closed;
    }
    if ((!is_word_token(first) && !is_number_token(first)) || first == "return") return at;
    size_t end = at + 1;
    for (const size_t most = at + kLongest; end < most;) {
        const std::string_view next = word(words, end);
        if (is_one_of(next, {".", "->", "::"}) && is_word_token(word(words, end + 1))) {
            end += 2;
        } else if ((next == "(" || next == "[") && is_word_token(first)) {
            const size_t closed = after_brackets(words, end);
            if (closed == 0) return at;
            end = closed;
        } else {
            return end;
        }
    }
    return at;
}

/// The parenthesis that closes the one at `open`, where what stands in it would be taken together without it: a
/// product in a sum, or what comes first of its like. Of a few operands; 0 if that is not so.
///
///     ( a * b ) + c        ( a + b ) - c        not a - ( b - c )
size_t end_of_closer_operation(const Text& words, size_t open) {
    constexpr size_t kMostOperands = 8;
    const std::string_view before = open > 0 ? std::string_view(words[open - 1]) : std::string_view();
    const bool is_binary = open > 1 && ends_operand(words, open - 1);
    bool sum = false;
    size_t at = open + 1;
    for (size_t operands = 0; operands < kMostOperands; ++operands) {
        const size_t end = after_operand(words, at);
        if (end == at) return 0;
        at = end;
        const std::string_view sign = word(words, at);
        if (sign == ")") {
            const std::string_view next = word(words, at + 1);
            const bool ends = next.empty() || is_one_of(next, {")", ",", ";", "]", "?", ":", "==", "!=", "&&", "||"});
            const bool goes_on = is_one_of(next, {"+", "-"}) || (!sum && is_one_of(next, {"*", "/", "%"}));
            const bool starts = before.empty() || is_one_of(before, {"return", "=", "(", ",", "?", "[",
                                                                     "+=", "-=", "==", "!=", "&&", "||"});
            const bool of_sum = !sum && is_binary && is_one_of(before, {"+", "-"}) && !is_one_of(next, {"*", "/", "%"});
            return operands > 0 && (ends || goes_on) && (starts || of_sum) ? at : 0;
        }
        if (!is_one_of(sign, {"*", "/", "%", "+", "-"})) return 0;
        sum = sum || sign == "+" || sign == "-";
        ++at;
    }
    return 0;
}

}  // namespace

Text with_common_phrases(const Text& words) { return with_plain_constructors(with_global_ids(with_named_axes(words))); }

Text with_plain_global_ids(const Text& words, const Dialect& dialect) {
    bool any = false;
    Text common;
    for (const std::string& word : words) {
        const std::string* meaning = dialect.meaning(word);
        const bool is_part = meaning != nullptr && is_one_of(*meaning, {"local_id", "group_id", "group_size"});
        any = any || (is_part && *meaning == "group_id");
        common.push_back(is_part ? *meaning : word);
    }
    return any ? with_global_ids(with_named_axes(common)) : words;
}

Text without_idle_parentheses(const Text& words) {
    std::vector<bool> idle(words.size());
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i] != "(" || ends_operand(words, i)) continue;
        size_t end = end_of_idle(words, i);
        if (end == 0) end = end_of_closer_operation(words, i);
        if (end != 0) idle[i] = idle[end] = true;
    }
    Text out;
    for (size_t i = 0; i < words.size(); ++i)
        if (!idle[i]) out.push_back(words[i]);
    return out;
}

Text with_plain_launches(const Text& words) {
    constexpr size_t kConfiguration = 4;
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        // The second is the first as a Meaning spells it.
        if (is_one_of(words[i], {"hipLaunchKernelGGL", "cudalaunchkernelggl"}) && word(words, i + 1) == "(") {
            if (const size_t end = after_brackets(words, i + 1); end > 0) {
                add_launch(out, launch_arguments(words, i + 2, end - 1));
                i = end - 1;
                continue;
            }
        }
        const bool opens = words[i] == "<" && word(words, i + 1) == "<" && word(words, i + 2) == "<";
        size_t close = 0;
        for (size_t k = i + 3; opens && close == 0 && k + 3 < words.size() && k < i + kLongestLaunch; ++k)
            if (words[k] == ">" && words[k + 1] == ">" && words[k + 2] == ">" && words[k + 3] == "(") close = k;
        const size_t end = close > 0 ? after_brackets(words, close + 3) : 0;
        const size_t name = end > 0 ? kernel_name_before(out, out.size()) : out.size();
        if (name == out.size()) {
            out.push_back(words[i]);
            continue;
        }
        std::vector<Text> arguments = {Text(out.begin() + static_cast<std::ptrdiff_t>(name), out.end())};
        for (Text& each : launch_arguments(words, i + 3, close)) arguments.push_back(std::move(each));
        while (arguments.size() < 1 + kConfiguration) arguments.push_back({"0"});
        for (Text& each : launch_arguments(words, close + 4, end - 1))
            if (!each.empty()) arguments.push_back(std::move(each));
        out.erase(out.begin() + static_cast<std::ptrdiff_t>(name), out.end());
        add_launch(out, std::move(arguments));
        i = end - 1;
    }
    return out;
}

void drop_status_check(Text& words) {
    if (words.size() < 6 || words[1] != "(" || words[3] != "(" || !says_that_it_checks(words[0]) ||
        !is_runtime_call(words[2]) || after_brackets(words, 1) != words.size() ||
        after_brackets(words, 3) + 1 != words.size())
        return;
    words.pop_back();
    words.erase(words.begin(), words.begin() + 2);
}

Text with_constructed_literals(const Text& words) {
    std::vector<size_t> closing;  // of the literals that are open
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        const bool typed = words[i] == "(" && is_word_token(word(words, i + 1)) && word(words, i + 2) == ")" &&
                           (i == 0 || !is_word_token(words[i - 1]) || words[i - 1] == "return");
        const std::string_view bracket = typed ? word(words, i + 3) : std::string_view();
        const size_t end = bracket == "{" || bracket == "(" ? after_brackets(words, i + 3) : 0;
        if (end == 0 || (bracket == "(" && !has_parts(words, i + 3, end))) {
            const bool closes = !closing.empty() && closing.back() == i;
            if (closes) closing.pop_back();
            out.push_back(closes ? ")" : words[i]);
            continue;
        }
        out.insert(out.end(), {words[i + 1], "("});
        closing.push_back(end - 1);
        i += 3;
    }
    return out;
}

void write_plain_barrier(Text& words) {
    const size_t at = words.size() > 3 && words[1] == "." ? 2 : 0;
    if (word(words, at) != "barrier" || word(words, at + 1) != "(" || after_brackets(words, at + 1) != words.size())
        return;
    const bool names_other = std::any_of(words.begin(), words.end(), [](const std::string& each) {
        return holds_in_any_case(each, "global") || holds_in_any_case(each, "device");
    });
    if (!names_other) words = {"barrier", "(", ")"};
}

void drop_cast_to_declared_type(Text& words) {
    const bool is_cast = words.size() > 6 && is_word_token(words[1]) && words[2] == "=" && words[3] == words[0] &&
                         words[4] == "(" && words.back() == ")";
    if (!is_cast || !is_one_of(words[0], {"int", "uint", "float", "double", "short", "size_t", "int8_t", "uint8_t",
                                          "uint16_t", "int64", "uint64", "int64_t", "uint64_t", "bool", "half"}))
        return;
    int depth = 0;
    for (size_t i = 4; i < words.size(); ++i) {
        if (words[i] == "(" || words[i] == "[" || words[i] == "{") ++depth;
        if (words[i] == ")" || words[i] == "]" || words[i] == "}") --depth;
        if (depth == 1 && words[i] == ",") return;
        if (depth == 0 && i + 1 < words.size()) return;
    }
    words.pop_back();
    words.erase(words.begin() + 3, words.begin() + 5);
}

}  // namespace porttool
