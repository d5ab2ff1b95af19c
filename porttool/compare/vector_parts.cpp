// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/vector_parts.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

#include "porttool/language/language.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

std::string_view word_at(const Text& words, size_t i) {
    return i < words.size() ? std::string_view(words[i]) : std::string_view();
}

/// Every swizzle of colours or texture coordinates with the one of positions; made once.
const std::map<std::string, std::string, std::less<>>& plain_swizzles() {
    static const auto table = [] {
        std::map<std::string, std::string, std::less<>> out;
        constexpr std::string_view kPlain = "xyzw";
        for (const std::string_view names : {"rgba", "stpq"}) {
            std::vector<std::pair<std::string, std::string>> last = {{"", ""}};
            for (size_t length = 1; length <= 4; ++length) {
                std::vector<std::pair<std::string, std::string>> next;
                for (const auto& [from, to] : last)
                    for (size_t i = 0; i < names.size(); ++i) next.emplace_back(from + names[i], to + kPlain[i]);
                out.insert(next.begin(), next.end());
                last = std::move(next);
            }
        }
        return out;
    }();
    return table;
}

bool is_vector_type(std::string_view type) {
    const bool sized = type.size() > 1 && type.back() >= '2' && type.back() <= '4';
    return sized && is_type_word(type) && (type.size() < 3 || type[type.size() - 2] != 'x') && !type.starts_with("mat");
}

/// Where the brackets open that close with the last word of [0, end); `end` if they do not soon.
size_t opening_of(const Text& words, size_t end) {
    constexpr size_t kFarthest = 128;
    int depth = 0;
    for (size_t i = end; i > 0 && end - i < kFarthest; --i) {
        depth += is_one_of(words[i - 1], {")", "]", "}"}) ? 1 : is_one_of(words[i - 1], {"(", "[", "{"}) ? -1 : 0;
        if (depth == 0) return i - 1;
    }
    return end;
}

/// What stands between the brackets that open at `open`, by commas; where they close in `close`. Nothing if they do not
/// soon, or hold nothing.
std::vector<Text> arguments_at(const Text& words, size_t open, size_t& close) {
    constexpr size_t kFarthest = 128;
    std::vector<Text> out(1);
    int depth = 0;
    for (close = open; close < words.size() && close - open < kFarthest; ++close) {
        const std::string& word = words[close];
        depth += is_one_of(word, {"(", "[", "{"}) ? 1 : is_one_of(word, {")", "]", "}"}) ? -1 : 0;
        if (depth == 0) return out.back().empty() ? std::vector<Text>() : out;
        if (close == open) continue;
        if (depth == 1 && word == ",")
            out.emplace_back();
        else
            out.back().push_back(word);
    }
    return {};
}

enum class Component : uint8_t { Real, Unsigned, Other };

Component component_of(std::string_view type) {
    if (type.starts_with("float") || type.starts_with("vec") || type.starts_with("half") ||
        type.starts_with("double") || type.starts_with("dvec") || type.starts_with("f16vec"))
        return Component::Real;
    return type.starts_with("uint") || type.starts_with("uvec") ? Component::Unsigned : Component::Other;
}

/// A number that a component holds to the last bit, whichever way it is written: `0`, `0.0` and `0f` are `0` as a real.
/// Others stay as they are.
std::string as_component(const std::string& number, Component component) {
    constexpr double kMost = 2048;  // every whole number up to that is one of half as many bits
    constexpr std::string_view kHexadecimal = "xX";
    const bool is_plain = number.find_first_of(kHexadecimal) == std::string::npos &&
                          !(number.size() > 1 && number[0] == '0' && number[1] >= '0' && number[1] <= '9');
    const size_t end = number.find_last_not_of(component == Component::Real ? "fFhHuU" : "uU") + 1;
    if (!is_plain || component == Component::Other || end == 0) return number;
    const std::string digits = number.substr(0, end);
    if (digits.find_first_not_of(component == Component::Real ? "0123456789." : "0123456789") != std::string::npos)
        return number;
    const double value = std::strtod(digits.c_str(), nullptr);
    const auto whole = static_cast<long>(value);
    return value <= kMost && value == static_cast<double>(whole) ? std::to_string(whole) : number;
}

/// Writes a number, or a number with a sign, as the component takes it. There are two zeros.
void write_as_component(Text& argument, Component component) {
    const bool is_negative = argument.size() == 2 && argument[0] == "-";
    if (argument.size() != 1 && !is_negative) return;
    if (!is_number_token(argument.back())) return;
    std::string plain = as_component(argument.back(), component);
    if (!is_negative || plain != "0") argument.back() = std::move(plain);
}

/// True if an argument has one value however often it is said.
bool is_steady(const Text& argument, bool may_change) {
    return std::all_of(argument.begin(), argument.end(), [&](const std::string& word) {
        return is_number_token(word) || word == "-" || (!may_change && (is_word_token(word) || word == "."));
    });
}

/// True for what declares nothing though a name follows it.
bool is_no_type(std::string_view word) {
    return is_one_of(word, {"return", "else", "case", "goto", "in", "out", "inout", "const", "do", "discard"});
}

/// Behind SYCL's type of a vector at `i`, or `i`.
size_t after_class_of_vectors(const Words& text, size_t i) {
    const auto is = [&](size_t at, std::string_view word) { return at < text.size() && text[at] == word; };
    if (!is(i, "sycl") || !is(i + 1, "::") || i + 2 >= text.size()) return i;
    if (is_vector_type(text[i + 2])) return i + 3;
    const bool is_template = is(i + 2, "vec") && is(i + 3, "<") && is(i + 5, ",") && is(i + 7, ">");
    return is_template ? i + 8 : i;
}

}  // namespace

void note_vectors(const Words& text, Language language, VectorNames& names) {
    for (size_t i = 0; i + 2 < text.size(); ++i) {
        const bool is_declared =
            is_word_token(text[i + 1]) && is_one_of(text[i + 2], {",", ")", ";", "="}) && is_vector_type(text[i]);
        const bool of_library = i > 1 && text[i - 1] == "::" && text[i - 2] == "glm";
        if (is_declared && (of_library || traits_of(language).vectors)) names.insert(text[i + 1]);
    }
}

void write_plain_components(Words& statement, const VectorNames& names) {
    for (size_t i = 1; i + 1 < statement.size() && !names.empty(); ++i) {
        const bool of_member = i > 1 && is_one_of(statement[i - 2], {".", "->", "::"});
        const bool is_call = i + 2 < statement.size() && statement[i + 2] == "(";  // which no part has
        if (statement[i] != "." || of_member || is_call || !names.contains(statement[i - 1])) continue;
        const auto found = plain_swizzles().find(statement[i + 1]);
        if (found != plain_swizzles().end()) statement[i + 1] = found->second;
    }
}

bool VectorSpelling::brings_vectors() const { return traits_of(language_).vectors; }

void VectorSpelling::note(const Words& text) {
    for (size_t i = 0; i + 2 < text.size(); ++i) {
        may_change_ = may_change_ || is_one_of(text[i], {"volatile", "coherent"});
        if (!is_word_token(text[i])) continue;
        if (const size_t name = after_class_of_vectors(text, i); name != i && name < text.size()) {
            const size_t at = text[name] == "&" ? name + 1 : name;
            if (at < text.size() && is_word_token(text[at])) class_names_.insert(text[at]);
        }
        const bool by_reference = is_vector_type(text[i]) && text[i + 1] == "&";
        const size_t name = by_reference ? i + 2 : i + 1;
        const bool ends = name + 1 < text.size() && is_one_of(text[name + 1], {",", ")", ";", "=", ":", "[", "(", "{"});
        if (!ends || !is_word_token(text[name]) || is_no_type(text[i])) continue;
        const bool is_one = is_vector_type(text[i]) && text[name + 1] != "[";
        (is_one ? names_ : others_).insert(text[name]);
        for (size_t next = name + 1; is_one && next + 2 < text.size() && text[next] == ","; next += 2) {
            if (!is_word_token(text[next + 1]) || !is_one_of(text[next + 2], {",", ";", "="})) break;
            names_.insert(text[next + 1]);
        }
    }
}

/// A part as it stands in the languages that have all of them: `w` of `s3` and `a`.
std::string VectorSpelling::plain_part(const std::string& part) const {
    if (const auto found = plain_swizzles().find(part); found != plain_swizzles().end()) return found->second;
    const bool is_numbered = language_ == Language::OpenCl && part.size() > 1 && (part[0] == 's' || part[0] == 'S') &&
                             part.find_first_not_of("0123", 1) == std::string::npos;
    if (!is_numbered) return part;
    std::string out;
    for (size_t i = 1; i < part.size(); ++i) out += "xyzw"[part[i] - '0'];
    return out;
}

/// True if the brackets at `open` are those of a constructor or a built-in that gives a vector.
bool VectorSpelling::gives_vector(const Text& words, size_t open) const {
    if (open == 0 || (open > 1 && is_one_of(words[open - 2], {".", "->", "::"}))) return false;
    const std::string& name = words[open - 1];
    if (is_vector_type(name)) return true;
    if (language_ == Language::Glsl)
        return is_one_of(name, {"imageLoad", "texture", "textureLod", "textureGrad", "textureProj", "textureOffset",
                                "textureGather", "texelFetch", "texelFetchOffset", "subpassLoad", "unpackUnorm4x8",
                                "unpackSnorm4x8", "unpackHalf2x16", "unpackUnorm2x16", "unpackSnorm2x16"});
    return language_ == Language::OpenCl &&
           is_one_of(name, {"read_imagef", "read_imagei", "read_imageui", "vload2", "vload3", "vload4"});
}

/// True if what ends with the last word of [0, end) is sure to be a vector.
bool VectorSpelling::is_vector_before(const Text& words, size_t end) const {
    const std::string& last = words[end - 1];
    if (last == ")") {
        const size_t open = opening_of(words, end);
        return brings_vectors() && open != end && gives_vector(words, open);
    }
    const bool of_member = end > 1 && is_one_of(words[end - 2], {".", "->", "::"});
    return !of_member && names_.contains(last) && !others_.contains(last);
}

void VectorSpelling::write_parts(Text& words) const {
    const bool has_elements = brings_vectors() && language_ != Language::OpenCl;
    for (size_t i = 1; i + 1 < words.size(); ++i) {
        if (brings_vectors() && words[i] == "." && is_word_token(words[i + 1]) && word_at(words, i + 2) != "(") {
            std::string plain = plain_part(words[i + 1]);
            if (plain != words[i + 1] && is_vector_before(words, i)) words[i + 1] = std::move(plain);
        }
        const bool is_element = has_elements && words[i] == "[" && word_at(words, i + 2) == "]" &&
                                is_one_of(words[i + 1], {"0", "1", "2", "3"});
        if (!is_element || !is_vector_before(words, i)) continue;
        words[i + 1] = std::string(1, "xyzw"[words[i + 1][0] - '0']);
        words[i] = ".";
        words.erase(words.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    }
}

/// SYCL's vectors have a method and an element for each component.
void VectorSpelling::write_methods(Text& words) const {
    for (size_t i = 1; i + 3 < words.size(); ++i) {
        if (words[i] != "." || words[i + 2] != "(" || words[i + 3] != ")") continue;
        const bool of_member = i > 1 && is_one_of(words[i - 2], {".", "->", "::"});
        if (of_member || !class_names_.contains(words[i - 1]) || others_.contains(words[i - 1])) continue;
        const std::string plain = plain_part(words[i + 1]);
        const size_t place = plain.size() == 1 ? std::string_view("xyzw").find(plain[0]) : std::string_view::npos;
        if (place == std::string_view::npos) continue;
        words[i] = "[";
        words[i + 1] = std::to_string(place);
        words[i + 2] = "]";
        words.erase(words.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    }
}

void VectorSpelling::write_constructors(Text& words) const {
    const bool has_literals = language_ == Language::OpenCl || is_hlsl();
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        // ( float4 ) ( a , b , c , d )
        const bool is_literal = has_literals && words[i] == "(" && is_vector_type(word_at(words, i + 1)) &&
                                word_at(words, i + 2) == ")" && word_at(words, i + 3) == "(" &&
                                (i == 0 || !is_word_token(words[i - 1]) || words[i - 1] == "return");
        const size_t type = is_literal ? i + 1 : i, open = is_literal ? i + 3 : i + 1;
        const bool of_sycl = i > 1 && words[i - 1] == "::" && words[i - 2] == "sycl";
        size_t close = 0;
        std::vector<Text> arguments;
        if ((brings_vectors() || of_sycl) && is_vector_type(words[type]) && word_at(words, open) == "(")
            arguments = arguments_at(words, open, close);
        if (arguments.empty()) {
            out.push_back(words[i]);
            continue;
        }
        for (Text& argument : arguments) {
            write_constructors(argument);
            write_as_component(argument, component_of(words[type]));
        }
        const bool alike =
            arguments.size() == static_cast<size_t>(words[type].back() - '0') && is_steady(arguments[0], may_change_) &&
            std::all_of(arguments.begin(), arguments.end(), [&](const Text& each) { return each == arguments[0]; });
        if (alike) arguments.resize(1);
        out.insert(out.end(), {words[type], "("});
        for (size_t k = 0; k < arguments.size(); ++k) {
            if (k > 0) out.emplace_back(",");
            out.insert(out.end(), arguments[k].begin(), arguments[k].end());
        }
        out.emplace_back(")");
        i = close;
    }
    words = std::move(out);
}

void VectorSpelling::write_plain(Text& statement) const {
    if (!class_names_.empty()) write_methods(statement);
    write_constructors(statement);
    write_parts(statement);
}

}  // namespace porttool
