// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/cpp_text.h"

#include <algorithm>
#include <array>
#include <utility>

#include "porttool/difftest/old_style.h"
#include "porttool/difftest/prelude.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// Words that qualify in one language and may be names in another.
bool is_left_out(std::string_view word, Language language) {
    switch (language) {
        case Language::Glsl:
            return is_one_of(word, {"in", "highp", "mediump", "lowp", "precise", "uniform", "shared", "flat",
                                    "coherent", "readonly", "writeonly"});
        case Language::Hlsl:
        case Language::Slang:
            return is_one_of(
                word, {"in", "uniform", "precise", "groupshared", "nointerpolation", "row_major", "column_major"});
        case Language::OpenCl:
            return is_one_of(word, {"global", "local", "private", "constant", "kernel", "generic"});
        case Language::Metal:
            return is_one_of(word, {"thread", "device", "constant", "threadgroup", "kernel"});
        case Language::Ispc:
            return is_one_of(word, {"uniform", "varying", "export", "unmasked"});
        default:
            return false;
    }
}

/// Components of a vector, as indices for a template: "xzy" is "0,2,1"; "" for other words.
std::string components(std::string_view word) {
    if (word.size() < 2 || word.size() > 4) return {};
    for (const std::string_view set : {"xyzw", "rgba", "stpq"}) {
        std::string out;
        for (const char c : word) {
            const size_t at = set.find(c);
            if (at == std::string_view::npos) break;
            out += (out.empty() ? "" : ",") + std::to_string(at);
        }
        if (out.size() == 2 * word.size() - 1) return out;
    }
    return {};
}

bool is_assignment(std::string_view sign) { return is_one_of(sign, {"=", "+=", "-=", "*=", "/="}); }

/// The language that a file is read in: a header of C that a shader includes is the shader's.
Language language_of(const ScannedFile& file, const CppManner& manner) {
    const bool shared =
        file.language == Language::C || file.language == Language::Cpp || file.language == Language::Unknown;
    return shared && has_vector_types(manner.language) ? manner.language : file.language;
}

/// What stands for a word where floats become doubles; "" for the word itself.
std::string widened(std::string_view word) {
    if (word == "float" || word == "half") return "double";
    if (word.size() == 6 && word.starts_with("float") && is_vector_type(word))
        return "double" + std::string(word.substr(5));
    if (word.starts_with("make_float") && word.size() == 11) return "make_double" + std::string(word.substr(10));
    if (word.size() == 4 && (word.starts_with("vec") || word.starts_with("mat")) && is_vector_type(word))
        return "d" + std::string(word);
    // sinf, sin
    if (word.size() > 2 && word.back() == 'f' && prelude_names().contains(word) &&
        is_one_of(word.substr(0, word.size() - 1),
                  {"sqrt", "sin",   "cos", "tan",  "asin",  "acos",  "atan",  "sinh",  "cosh",     "tanh",  "exp",
                   "exp2", "expm1", "log", "log2", "log10", "log1p", "floor", "ceil",  "trunc",    "round", "rint",
                   "fabs", "cbrt",  "erf", "pow",  "fmod",  "fmin",  "fmax",  "atan2", "copysign", "hypot"}))
        return std::string(word.substr(0, word.size() - 1));
    return {};
}

/// Where a function goes on behind its parameters: of a member without `const`, `override` and their like, which stand
/// before its body or `-> R`.
uint32_t behind_qualifiers(const Definition& function) {
    const Unit& unit = *function.unit;
    uint32_t at = unit.parameters.end + 1;
    if (is_old_style(function.file->lexed, unit) || has_two_heads(function.file->lexed, unit))
        return unit.body.first - 1;
    if (function.owner.empty()) return at;
    while (at + 1 < unit.body.first && function.file->lexed.view(at) != "->") ++at;
    return at;
}

/// Where the head of a function begins, where its name stands, and where its list opens: of two heads those of the
/// newer one.
struct HeadOfFunction {
    uint32_t first = 0, name = 0, open = 0;
};
HeadOfFunction head_of(const Definition& function) {
    const LexedText& lexed = function.file->lexed;
    const Unit& unit = *function.unit;
    const TokenRange newer = newer_list(lexed, unit);
    if (newer.empty() || newer.first == unit.parameters.first)
        return {function.tokens.first, unit.name_token, unit.parameters.first - 1};
    uint32_t first = newer.first - 2;
    while ((lexed.tokens[first - 1].flags & kInDirective) == 0) --first;
    return {first, newer.first - 2, newer.first - 1};
}

/// The directives that decide whether a function counts, without those that only choose one of its two heads.
std::vector<uint32_t> conditions_of_head(const Definition& function) {
    std::vector<uint32_t> out = function.conditions;
    const LexedText& lexed = function.file->lexed;
    const Unit& unit = *function.unit;
    if (!has_two_heads(lexed, unit)) return out;
    int closed = 0;
    for (const Directive& line : lexed.directives) {
        if (line.first_token < function.tokens.first || line.first_token >= unit.body.first) continue;
        if (line.kind == DirectiveKind::Endif) ++closed;
        if (line.kind == DirectiveKind::If) --closed;
    }
    while (closed > 0 && !out.empty()) {
        if (lexed.directives[out.back()].kind == DirectiveKind::If) --closed;
        out.pop_back();
    }
    return out;
}

class Writer {
public:
    Writer(const ScannedFile& file, const CppManner& manner)
        : file_(file),
          lexed_(file.lexed),
          manner_(manner),
          language_(language_of(file, manner)),
          shading_(traits_of(language_).literals == Literals::Shading),
          vectors_(has_vector_types(language_)) {}

    std::string out;

    void tokens(TokenRange range, const std::vector<TokenRange>& left_out) {
        auto hole = left_out.begin();
        for (uint32_t i = range.first; i < range.end;) {
            while (hole != left_out.end() && hole->end <= i) ++hole;
            if (hole != left_out.end() && hole->first <= i) {
                i = hole->end;
                continue;
            }
            i = token(i, range.end);
        }
    }

    /// The tokens of a function's parameter list, with `out` as a reference, and as C++ has it.
    void parameters(const Unit& function) {
        const TokenRange newer = newer_list(lexed_, function);
        if (!newer.empty()) return parameters(newer);
        if (!is_old_style(lexed_, function)) return parameters(function.parameters);
        bool is_first = true;
        for (const OldStyleParameter& one : old_style_parameters(lexed_, function)) {
            if (!std::exchange(is_first, false)) append(",", false);
            if (one.type.empty()) append("int", true);
            tokens(one.type, {});
            out += ' ';
            tokens(one.name, {});
        }
    }

private:
    void parameters(TokenRange range) {
        uint32_t first = range.first;
        int depth = 0;
        for (uint32_t i = range.first; i <= range.end; ++i) {
            const std::string_view word = i < range.end ? view(i) : std::string_view(",");
            if (word == "(" || word == "[" || word == "{") ++depth;
            if (word == ")" || word == "]" || word == "}") --depth;
            if (word != "," || (depth != 0 && i < range.end)) continue;
            parameter({first, i});
            if (i < range.end) append(",", true);
            first = i + 1;
        }
    }

    std::string_view view(uint32_t i) const { return lexed_.view(i); }

    void append(std::string_view text, bool apart) {
        if ((apart || left_out_) && !out.empty() && out.back() != '\n') out += ' ';
        left_out_ = false;
        out += text;
    }

    /// Goes on after tokens that are not written.
    uint32_t leave_out(uint32_t next) {
        left_out_ = true;
        return next;
    }

    void parameter(TokenRange range) {
        const bool outward = shading_ && range.first < range.end && [&] {
            for (uint32_t i = range.first; i < range.end; ++i)
                if (is_one_of(view(i), {"out", "inout"})) return true;
            return false;
        }();
        if (!outward) return tokens(range, {});
        uint32_t name = range.first, end = range.end;
        for (uint32_t i = range.first; i < range.end; ++i) {
            if (view(i) == "[" || view(i) == "=") {
                end = i;
                break;
            }
        }
        for (uint32_t i = range.first; i < end; ++i)
            if (lexed_.tokens[i].kind == TokenKind::Identifier) name = i;
        for (uint32_t i = range.first; i < range.end;) {
            if (is_one_of(view(i), {"out", "inout", "in"})) {
                ++i;
                continue;
            }
            if (i == name && (end == range.end || view(end) != "[")) append("&", false);
            i = token(i, range.end);
        }
    }

    /// Writes the token at `i`, or more where several are one thing; the index after them.
    uint32_t token(uint32_t i, uint32_t end) {
        const Token& token = lexed_.tokens[i];
        const bool in_directive = (token.flags & kInDirective) != 0;
        if ((token.flags & kDead) != 0) return i + 1;
        const bool starts_directive = in_directive && view(i) == "#" && (token.flags & kStartsLine) != 0;
        const bool after_directive = !in_directive && i > 0 && (lexed_.tokens[i - 1].flags & kInDirective) != 0;
        if ((starts_directive || after_directive) && !out.empty() && out.back() != '\n') out += '\n';
        const std::string_view word = lexed_.view(token);
        const Token* const before = i > 0 ? &lexed_.tokens[i - 1] : nullptr;
        const bool apart = before != nullptr && before->offset + before->length != token.offset;
        if (starts_directive && i + 1 < end && is_one_of(view(i + 1), {"pragma", "extension", "version", "include"})) {
            const uint32_t line = token.line;
            while (i < end && lexed_.tokens[i].line == line) ++i;
            return i;
        }
        if (token.kind == TokenKind::Number) {
            append(number(word), apart);
            return i + 1;
        }
        if (token.kind == TokenKind::Identifier) return identifier(i, end, word, apart);
        if (word == "::" && (i == 0 || lexed_.tokens[i - 1].kind != TokenKind::Identifier) && view(i - (i > 0)) != ">")
            return leave_out(i + 1);
        if (vectors_ && word == "(" && i + 3 < end && is_vector_type(view(i + 1)) && view(i + 2) == ")" &&
            view(i + 3) == "(") {
            append(view(i + 1), apart);
            return i + 3;
        }
        append(word, apart);
        return i + 1;
    }

    uint32_t identifier(uint32_t i, uint32_t end, std::string_view word, bool apart) {
        const bool member = i > 0 && (view(i - 1) == "." || view(i - 1) == "->");
        const std::string_view next = i + 1 < end ? view(i + 1) : std::string_view();
        if (member && (vectors_ || language_ == Language::Cuda || language_ == Language::Sycl) && next != "(" &&
            (manner_.fields == nullptr || !manner_.fields->contains(word))) {
            if (const std::string indices = components(word); !indices.empty()) {
                append((is_assignment(next) ? "parts<" : "swizzle<") + indices + ">()", false);
                return i + 1;
            }
        }
        if (member && is_sycl_component(i, end)) {
            append(word, false);
            return i + 3;
        }
        if (is_name_in_c(word, language_)) {
            append(std::string(word) + "_", apart && !member);
            return i + 1;
        }
        if (member) {
            append(word, false);
            return i + 1;
        }
        if (is_left_out(word, language_)) return leave_out(i + 1);
        if (word == "friend" && is_friend_class(i, end)) {
            while (i < end && view(i) != ";") ++i;
            return leave_out(i + 1);
        }
        if (next == "::" && manner_.namespaces != nullptr &&
            (manner_.namespaces->contains(word) || is_one_of(word, {"sycl", "cl", "metal"})))
            return leave_out(i + 2);
        // Of a member that runs as a function of its own.
        if (word == "virtual" && !manner_.rename.empty()) return leave_out(i + 1);
        if (word == "using" && next == "namespace") {
            while (i < end && view(i) != ";") ++i;
            return leave_out(i + 1);
        }
        if (word == "__cplusplus" && shading_) {
            append("porttool_is_no_cplusplus", apart);
            return i + 1;
        }
        if (is_one_of(word, {"ext_vector_type", "__ext_vector_type__"}) && next == "(") {
            if (const std::string element = element_of_typedef(i); !element.empty()) {  // Clang's, as GCC has it
                append("vector_size(sizeof(" + element + ") * ", apart);
                uint32_t close = i + 2;
                while (close < end && view(close) != ")") ++close;
                tokens({i + 2, close}, {});
                return close;
            }
        }
        if (word == "restrict") {
            append("__restrict", apart);
            return i + 1;
        }
        if (is_one_of(word, {"private", "protected"}) && next == ":") {
            append("public", apart);
            return i + 1;
        }
        if (word == "class" && i + 2 < end && is_one_of(view(i + 2), {"{", ":", "final"})) {
            append("struct", apart);
            return i + 1;
        }
        // float[3](a, b, c), float[](a, b, c)
        if (shading_ && next == "[" && is_type_word(word) && i > 0 &&
            is_one_of(view(i - 1), {"=", "(", ",", "return"})) {
            uint32_t close = i + 2;
            while (close < end && view(close) != "]") ++close;
            if (close + 1 < end && view(close + 1) == "(") return braced(close + 1, end);
        }
        if (!manner_.recursive.empty() && word == manner_.recursive && (next == "(" || next == "<")) {
            append(manner_.rename, apart);
            return i + 1;
        }
        const std::string wide = manner_.widens ? widened(word) : std::string();
        append(wide.empty() ? word : wide, apart);
        return i + 1;
    }

    /// `T` of `typedef T name __attribute__((...` where that stands before `i`; "" for others.
    std::string element_of_typedef(uint32_t i) const {
        constexpr uint32_t kNear = 16;  // tokens
        uint32_t first = i;
        while (first > 0 && i - first < kNear && !is_one_of(view(first), {"typedef", ";", "}"})) --first;
        uint32_t end = first;
        while (end < i && view(end) != "__attribute__") ++end;
        if (view(first) != "typedef" || end < first + 3 || end == i) return {};
        std::string type;
        for (uint32_t at = first + 1; at + 1 < end; ++at) (type.empty() ? type : type += ' ') += view(at);
        return type;
    }

    /// True for `v.x()` as SYCL asks for a component, in a file that speaks of SYCL and has no function of that name.
    bool is_sycl_component(uint32_t i, uint32_t end) const {
        constexpr std::string_view kComponents = "xyzwrgba";
        if (i + 2 >= end || view(i + 1) != "(" || view(i + 2) != ")" || view(i).size() != 1 ||
            kComponents.find(view(i)[0]) == std::string_view::npos)
            return false;
        const auto speaks_of_sycl = [&](const Token& token) {
            const std::string_view word = lexed_.view(token);
            return word.find("sycl") != std::string_view::npos || word.find("dpct") != std::string_view::npos;
        };
        return std::any_of(lexed_.tokens.begin(), lexed_.tokens.end(), speaks_of_sycl) &&
               std::none_of(file_.units.begin(), file_.units.end(),
                            [&](const Unit& unit) { return leaf_of(unit.name) == view(i); });
    }

    /// True for `friend class X;`, which asks for a name and gives nothing that is needed here.
    bool is_friend_class(uint32_t i, uint32_t end) const {
        while (i < end && view(i) != ";" && view(i) != "(" && view(i) != "{") ++i;
        return i < end && view(i) == ";";
    }

    /// Writes `( ... )` as `{ ... }`.
    uint32_t braced(uint32_t open, uint32_t end) {
        int depth = 0;
        uint32_t i = open;
        while (i < end) {
            if (view(i) == "(") ++depth;
            if (view(i) == ")" && --depth == 0) break;
            if (i == open) {
                out += " {";
                ++i;
            } else
                i = token(i, end);
        }
        out += "}";
        return i + 1;
    }

    std::string number(std::string_view word) const {
        const bool hex = word.starts_with("0x") || word.starts_with("0X");
        const bool real = !hex && word.find_first_of(".eE") != std::string_view::npos;
        if (word.ends_with("lf") || word.ends_with("LF")) return std::string(word.substr(0, word.size() - 2));
        if (!shading_ || !real) return std::string(word);
        const char last = word.back();
        if (last == 'f' || last == 'F') return std::string(word);
        if (last == 'h' || last == 'H') return std::string(word.substr(0, word.size() - 1)) + "f";
        return std::string(word) + "f";
    }

    const ScannedFile& file_;
    const LexedText& lexed_;
    const CppManner& manner_;
    const Language language_;
    const bool shading_, vectors_;
    bool left_out_ = false;
};

}  // namespace

bool is_name_in_c(std::string_view word, Language language) {
    return language == Language::C &&
           is_one_of(word, {"new",    "delete",  "class",     "this",      "template", "typename", "virtual",
                            "public", "private", "protected", "namespace", "operator", "try",      "catch",
                            "throw",  "friend",  "explicit",  "export",    "typeid",   "mutable"});
}

std::string cpp_text_of(const ScannedFile& file, TokenRange range, const CppManner& manner) {
    Writer writer(file, manner);
    writer.tokens(range, {});
    return std::move(writer.out);
}

std::string under_conditions(const Definition& one, std::string text, const CppManner& manner) {
    const LexedText& lexed = one.file->lexed;
    std::string before, behind;
    for (const uint32_t directive : one.conditions) {
        const Directive& line = lexed.directives[directive];
        before += cpp_text_of(*one.file, {line.first_token, line.end_token}, manner) + "\n";
        if (line.kind == DirectiveKind::If) behind += "#endif\n";
    }
    return before + std::move(text) + behind;
}

std::string cpp_text(const Piece& piece, const CppManner& manner) {
    const Definition& one = *piece.definition;
    const LexedText& lexed = one.file->lexed;
    std::string out;
    const bool function = one.kind == Definition::Kind::Function && one.unit != nullptr && !one.unit->body.empty();
    for (const uint32_t directive : function ? conditions_of_head(one) : one.conditions) {
        const Directive& line = lexed.directives[directive];
        out += cpp_text_of(*one.file, {line.first_token, line.end_token}, manner) + "\n";
    }
    Writer writer(*one.file, manner);
    if (function) {
        const Unit& unit = *one.unit;
        const bool renames = !manner.rename.empty();
        // Up to its name, its parameters, and what is left of its head.
        const HeadOfFunction head = head_of(one);
        uint32_t first = head.first;
        // A specialisation, under a name that is no template's.
        if (renames && lexed.view(first) == "template" && lexed.view(first + 1) == "<" && lexed.view(first + 2) == ">")
            first += 3;
        writer.tokens({first, renames ? head.name : head.open}, {});
        if (renames) writer.out += " " + manner.rename;
        writer.out += "(";
        writer.parameters(unit);
        const uint32_t rest = manner.body ? unit.body.first - 1 : one.tokens.end;
        const bool parts = renames || is_old_style(lexed, unit) || has_two_heads(lexed, unit);
        writer.tokens({unit.parameters.end, parts ? unit.parameters.end + 1 : rest}, piece.left_out);
        if (parts) writer.tokens({behind_qualifiers(one), rest}, piece.left_out);
        if (manner.body) writer.out += "\n" + *manner.body;
    } else {
        writer.tokens(one.tokens, piece.left_out);
    }
    out += writer.out + "\n";
    if (one.kind == Definition::Kind::Constant && writer.out.find(';') == std::string::npos) out += ";\n";
    for (uint32_t i = 0; i < one.open_conditions; ++i) out += "#endif\n";
    return out;
}

bool is_conditional(const Definition& function) { return !conditions_of_head(function).empty(); }

std::string prototype(const Definition& function, const CppManner& manner) {
    const Unit& unit = *function.unit;
    const LexedText& lexed = function.file->lexed;
    if (unit.body.empty() || unit.parameters.first == 0 || !function.owner.empty()) return {};
    if (has_two_heads(lexed, unit)) {
        Writer writer(*function.file, manner);
        const HeadOfFunction head = head_of(function);
        writer.tokens({head.first, head.open}, {});
        writer.out += "(";
        writer.parameters(unit);
        return writer.out + ");\n";
    }
    for (uint32_t i = function.tokens.first; i < unit.body.first; ++i) {
        const std::string_view word = lexed.view(i);
        if (word == "template" || word == "=" || word == "operator" || (lexed.tokens[i].flags & kInDirective) != 0)
            return {};
    }
    Writer writer(*function.file, manner);
    writer.tokens({function.tokens.first, unit.parameters.first - 1}, {});
    writer.out += "(";
    writer.parameters(unit);
    writer.tokens({unit.parameters.end, is_old_style(lexed, unit) ? unit.parameters.end + 1 : unit.body.first - 1}, {});
    return writer.out + ";\n";
}

std::string undone(const Definition& definition) {
    return definition.kind == Definition::Kind::Macro ? "#undef " + definition.name + "\n" : std::string();
}

}  // namespace porttool
