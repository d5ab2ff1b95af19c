// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

#include "porttool/compare/struct_fields.h"
#include "porttool/difftest/argument_list.h"
#include "porttool/difftest/cpp_text.h"
#include "porttool/difftest/prelude.h"
#include "porttool/language/words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/unit_state.h"

namespace porttool {
namespace {

constexpr int kDeepest = 4;  ///< calls that a pointer is followed through
constexpr int kMostElements = 64;

SubjectParameter parameter_of(const ScannedFile& file, TokenRange range, const CppManner& manner) {
    const LexedText& lexed = file.lexed;
    SubjectParameter out;
    bool is_text = false;  // strings, and what is behind `void*`, are drawn by nobody
    for (uint32_t i = range.first; i < range.end; ++i) {
        const std::string_view word = lexed.view(i);
        if (word == "=") break;
        if (word == "[") {
            uint32_t close = i;
            while (close < range.end && lexed.view(close) != "]") ++close;
            out.bound = cpp_text_of(file, {i + 1, close}, manner);
            out.is_pointer = out.bound.empty();
            out.can_be_array = out.is_pointer && !is_text;
            break;
        }
        if (word == "*") {
            out.can_be_array = !out.is_pointer && !is_text;
            out.is_pointer = true;
        }
        is_text = is_text || word == "char" || word == "void" || word == "FILE";
        if (lexed.tokens[i].kind == TokenKind::Identifier) out.name = word;
    }
    return out;
}

std::vector<SubjectParameter> parameters_of(const ScannedFile& file, const Unit& unit, const CppManner& manner) {
    std::vector<SubjectParameter> out;
    for (const TokenRange part : list_parts(file.lexed, unit.parameters))
        if (part.end != part.first + 1 || file.lexed.view(part.first) != "void")
            out.push_back(parameter_of(file, part, manner));
    return out;
}

/// How many elements behind a pointer a function looks at; 0 if that cannot be told.
class PointerReach {
public:
    PointerReach(const Definitions& definitions) : definitions_(definitions) {}

    int of(const Definition& function, std::string_view name, int depth = 0) {
        if (depth > kDeepest || function.unit == nullptr) return 0;
        if (const auto [known, is_new] = seen_.try_emplace({&function, std::string(name)}, 1); !is_new)
            return known->second;
        return seen_[{&function, std::string(name)}] = look(function, name, depth);
    }

private:
    int look(const Definition& function, std::string_view name, int depth) {
        const LexedText& lexed = function.file->lexed;
        const TokenRange body = function.unit->body;
        int most = 1;
        for (uint32_t i = body.first; i < body.end; ++i) {
            if (lexed.view(i) != name || lexed.tokens[i].kind != TokenKind::Identifier) continue;
            const std::string_view before = lexed.view(i - 1), next = i + 1 < body.end ? lexed.view(i + 1) : "";
            if (before == "." || before == "->") continue;
            int here = 0;
            if (next == "->" || next == "==" || next == "!=" || before == "!")
                here = 1;
            else if (next == "[")
                here = index_at(lexed, i + 1, body.end);
            else if (before == "*" && !is_value(lexed, i - 2))
                here = 1;
            else if (before == "(" && lexed.view(i - 2) == "if" && next == ")")
                here = 1;
            else if ((before == "(" || before == ",") && (next == ")" || next == ","))
                here = through_call(function, i, depth);
            if (here == 0) return 0;
            most = std::max(most, here);
        }
        return most;
    }

    static bool is_value(const LexedText& lexed, uint32_t i) {
        const Token& token = lexed.tokens[i];
        if (token.kind == TokenKind::Number) return true;
        if (token.kind == TokenKind::Identifier) return lexed.view(i) != "return";
        return lexed.view(i) == ")" || lexed.view(i) == "]";
    }
    static int index_at(const LexedText& lexed, uint32_t open, uint32_t end) {
        if (open + 2 >= end || lexed.view(open + 2) != "]") return 0;
        const std::string_view word = lexed.view(open + 1);
        int index = 0;
        const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), index);
        if (error != std::errc() || index < 0 || index >= kMostElements) return 0;
        return index + 1;
    }
    int through_call(const Definition& function, uint32_t at, int depth) {
        const LexedText& lexed = function.file->lexed;
        int nested = 0;
        size_t place = 0;
        uint32_t open = at;
        while (open > function.unit->body.first) {
            const std::string_view word = lexed.view(--open);
            if (word == ")" || word == "]") ++nested;
            if (word == "[" || (word == "(" && nested > 0))
                --nested;
            else if (word == "(")
                break;
            if (word == "," && nested == 0) ++place;
            if (word == ";" || word == "{" || word == "}") return 0;
        }
        if (open == 0 || lexed.tokens[open - 1].kind != TokenKind::Identifier) return 0;
        const std::string_view callee = lexed.view(open - 1);
        if (callee == "sincos" || callee == "sincosf" || callee == "__sincosf" || callee == "modf" || callee == "frexp")
            return 1;
        int most = 0;
        for (const Definition* found : definitions_.find(*function.file, callee)) {
            if (found->kind != Definition::Kind::Function || found == &function) continue;
            const std::vector<SubjectParameter> parameters = parameters_of(*found->file, *found->unit, {});
            if (place >= parameters.size()) continue;
            const int here = of(*found, parameters[place].name, depth + 1);
            if (here == 0) return 0;
            most = std::max(most, here);
        }
        return most;
    }

    const Definitions& definitions_;
    std::map<std::pair<const Definition*, std::string>, int> seen_;  ///< 1 while one is looked at: it may call itself
};

/// True for a body that does with its numbers what can be done to whole ones alone.
bool shifts(const Definition& function) {
    const LexedText& lexed = function.file->lexed;
    for (uint32_t i = function.unit->body.first; i < function.unit->body.end; ++i) {
        const std::string_view word = lexed.view(i);
        for (const char* one : {">>", "<<", "%", "|", "^", ">>=", "<<=", "%=", "|=", "&=", "^="})
            if (word == one) return true;
        // Two that close lists of a template are read one by one, and so is a shift.
        if (word == ">" && i + 2 < function.unit->body.end && lexed.view(i + 1) == ">" &&
            lexed.tokens[i + 1].offset == lexed.tokens[i].offset + 1 &&
            (lexed.tokens[i + 2].kind == TokenKind::Number || lexed.view(i + 2) == "("))
            return true;
    }
    return false;
}

/// What a function works on, by the types of its parameters: whole numbers where there are no others.
std::string number_type_of(const Definition& function) {
    const LexedText& lexed = function.file->lexed;
    std::string whole;
    for (uint32_t i = function.unit->parameters.first; i < function.unit->parameters.end; ++i) {
        const std::string_view word = lexed.view(i);
        const auto is_of = [&](std::string_view name) {
            return word.starts_with(name) && word.size() <= name.size() + 1;  // float4
        };
        for (const char* name : {"float", "double", "half", "vec", "real"})
            if (is_of(name)) return "float";
        for (const char* name : {"uint", "unsigned", "uvec", "uint32_t"})
            if (is_of(name)) whole = "unsigned int";
        for (const char* name : {"int", "ivec", "int32_t", "size_t"})
            if (whole.empty() && is_of(name)) whole = "int";
    }
    return whole.empty() && shifts(function) ? "unsigned int" : whole.empty() ? "float" : whole;
}

/// True for the type of a value that a template can be made for.
bool is_whole_type(std::string_view word) {
    return word == "int" || word == "unsigned" || word == "size_t" || word == "uint" || word == "uint32_t" ||
           word == "int32_t" || word == "long" || word == "short";
}

/// `<float, 4>` for `template <class T, int N>`; "?" where a parameter is neither a type nor a number.
std::string template_arguments(const ScannedFile& file, const Unit& unit, const std::string& type) {
    const LexedText& lexed = file.lexed;
    if (lexed.view(unit.tokens.first) != "template" || lexed.view(unit.tokens.first + 1) != "<") return {};
    std::string out;
    uint32_t i = unit.tokens.first + 2;
    for (int depth = 1; i < unit.name_token; ++i) {
        const std::string_view word = lexed.view(i);
        if (word == "<") ++depth;
        if (word == ">" && --depth == 0) break;
        if (depth > 1) return "?";
    }
    for (const TokenRange part : list_parts(lexed, {unit.tokens.first + 2, i})) {
        uint32_t first = part.first;
        while (first < part.end && lexed.view(first) == "const") ++first;
        const std::string_view word = lexed.view(first);
        constexpr const char* kValue = "4";  // as wide as vectors are, and a power of two
        const std::string argument = word == "class" || word == "typename" ? type
                                     : word == "bool"                      ? "true"
                                     : is_whole_type(word)                 ? kValue
                                                                           : "";
        if (argument.empty()) return "?";
        out += (out.empty() ? "<" : ", ") + argument;
    }
    return out.empty() ? out : out + ">";
}

/// What each parameter of a template stands for, by name.
std::map<std::string, std::string> template_values(const ScannedFile& file, const Unit& unit,
                                                   const std::string& arguments) {
    std::map<std::string, std::string> out;
    if (arguments.empty()) return out;
    const LexedText& lexed = file.lexed;
    uint32_t end = unit.tokens.first + 2;
    while (end < unit.name_token && lexed.view(end) != ">") ++end;
    size_t at = 1;
    for (const TokenRange part : list_parts(lexed, {unit.tokens.first + 2, end})) {
        const size_t next = std::min(arguments.find_first_of(",>", at), arguments.size());
        std::string_view name;
        for (uint32_t i = part.first; i < part.end && lexed.view(i) != "="; ++i)
            if (lexed.tokens[i].kind == TokenKind::Identifier) name = lexed.view(i);
        out.emplace(name, arguments.substr(at, next - at));
        at = std::min(next + 2, arguments.size());
    }
    return out;
}

/// The head `template <class F>` of a struct and its arguments `<F>`; both "" for others.
std::pair<std::string, std::string> template_head(const Definition& one, const CppManner& manner) {
    const LexedText& lexed = one.file->lexed;
    uint32_t i = one.tokens.first;
    if (lexed.view(i) != "template") return {};
    const uint32_t first = i;
    int depth = 0;
    for (++i; i < one.tokens.end; ++i) {
        if (lexed.view(i) == "<") ++depth;
        if (lexed.view(i) == ">" && --depth == 0) break;
    }
    std::string arguments;
    for (const TokenRange part : list_parts(lexed, {first + 2, i})) {
        std::string_view name;
        for (uint32_t at = part.first; at < part.end && lexed.view(at) != "="; ++at)
            if (lexed.tokens[at].kind == TokenKind::Identifier) name = lexed.view(at);
        arguments += (arguments.empty() ? "" : ", ") + std::string(name);
    }
    return {cpp_text_of(*one.file, {first + 2, i}, manner), "<" + arguments + ">"};
}

/// The names of a struct's fields, in their order.
std::vector<std::string> fields_of(const Definition& one) {
    std::vector<std::string> out;
    if (one.unit == nullptr) return out;
    const UnitState state = unit_state(*one.file, *one.unit);
    const Words words = data_fields(state.text.words());
    auto at = std::find(words.begin(), words.end(), "{");
    std::string name;
    bool named = false, starts = true;
    int depth = 0;
    for (at = at == words.end() ? at : at + 1; at != words.end(); ++at) {
        if (*at == "{") ++depth;
        if (*at == "}" && depth-- == 0) break;
        if (*at == ";" && depth == 0) {
            if (!name.empty()) out.push_back(name);
            name.clear();
            named = false;
            starts = true;
            continue;
        }
        if (depth > 0) continue;
        // `using value_type = T;` and `static constexpr int n = 4;` are no fields.
        if (std::exchange(starts, false) && (*at == "using" || *at == "typedef" || *at == "static")) {
            at = std::find(at, words.end(), ";");
            if (at == words.end()) break;
            starts = true;
            continue;
        }
        if (*at == "[" || *at == "=" || *at == ":") named = true;
        if (!named && is_word_token(*at)) name = *at;
    }
    return out;
}

/// The classes that a class is made from.
std::vector<std::string> bases_of(const Definition& one) {
    const LexedText& lexed = one.file->lexed;
    std::vector<std::string> out;
    bool listed = false;
    int depth = 0, rounds = 0;
    for (uint32_t i = one.tokens.first; i < one.tokens.end && lexed.view(i) != "{" && lexed.view(i) != ";"; ++i) {
        if (lexed.view(i) == "(") ++rounds;
        if (lexed.view(i) == ")") --rounds;
        if (lexed.view(i) == ":" && rounds == 0) listed = true;
        if (!listed) continue;
        if (lexed.view(i) == "<") ++depth;
        if (lexed.view(i) == ">") --depth;
        const bool ends = lexed.view(i + 1) == "{" || lexed.view(i + 1) == ",";
        if (depth == 0 && ends && lexed.tokens[i].kind == TokenKind::Identifier) out.emplace_back(lexed.view(i));
    }
    return out;
}

/// `struct NAME;`, so that what stands before it may name it; "" where it has no name of its own.
std::string announced(const Definition& one, const CppManner& manner) {
    const LexedText& lexed = one.file->lexed;
    for (uint32_t i = one.tokens.first; i < one.tokens.end && lexed.view(i) != "{"; ++i) {
        if (lexed.view(i) == "typedef") return {};
        if (lexed.view(i) != one.name) continue;
        const std::string head = template_head(one, manner).first;
        return (head.empty() ? "" : "template <" + head + "> ") + "struct " + one.name + ";\n";
    }
    return {};
}

std::string visitor(const Definition& one, const CppManner& manner) {
    const auto [head, arguments] = template_head(one, manner);
    std::string out = fmt::format("template <{}{}class porttool_V> void porttool_visit({}{}& x, porttool_V& v) {{\n",
                                  head, head.empty() ? "" : ", ", one.name, arguments);
    for (const std::string& base : bases_of(one))
        out += fmt::format("porttool_harness::walk(v, \"\", static_cast<{}&>(x));\n", base);
    for (const std::string& field : fields_of(one))
        out += fmt::format("porttool_harness::walk(v, \"{0}\", x.{0});\n", field);
    return out + "}\n";
}

CppManner manner_of(const Definition& function, const Definitions& definitions,
                    const std::set<std::string, std::less<>>& fields) {
    CppManner out;
    out.language = function.file->language;
    out.namespaces = &definitions.namespaces();
    out.fields = &fields;
    return out;
}

std::set<std::string, std::less<>> fields_in(const Closure& closure) {
    std::set<std::string, std::less<>> out;
    for (const Piece& piece : closure.pieces)
        if (piece.definition->kind == Definition::Kind::Struct)
            for (std::string& field : fields_of(*piece.definition)) out.insert(std::move(field));
    return out;
}

/// The text of a function that another stands in for: an answer made of its arguments.
std::string answer(const Definition& one, int number) {
    std::string arguments;
    for (const SubjectParameter& parameter : parameters_of(*one.file, *one.unit, {}))
        arguments += ", " + parameter.name;
    if (gives_nothing(one)) return fmt::format("{{ porttool_harness::noted({}{}); }}", number, arguments);
    const std::string list = arguments.empty() ? "" : arguments.substr(2);
    return fmt::format("{{ return porttool_harness::answered<decltype({}({}))>({}{}); }}", one.name, list, number,
                       arguments);
}

}  // namespace

namespace {

/// A parameter that is a macro for several: its name, where that brings pointers along; "" for none.
std::string pointers_by_macro(const Definition& function, const Definitions& definitions) {
    const LexedText& lexed = function.file->lexed;
    for (uint32_t i = function.unit->parameters.first; i < function.unit->parameters.end; ++i) {
        if (lexed.tokens[i].kind != TokenKind::Identifier) continue;
        for (const Definition* found : definitions.find(*function.file, lexed.view(i))) {
            if (found->kind != Definition::Kind::Macro) continue;
            for (uint32_t at = found->tokens.first; at < found->tokens.end; ++at)
                if (found->file->lexed.view(at) == "*") return found->name;
        }
    }
    return {};
}

/// True where every brace that opens closes.
bool closes(const std::string& text) {
    int depth = 0;
    char quote = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        if (quote != 0) {
            if (text[i] == '\\')
                ++i;
            else if (text[i] == quote)
                quote = 0;
            continue;
        }
        // 1'000 is a number.
        if (text[i] == '"' ||
            (text[i] == '\'' && (i == 0 || std::isalnum(static_cast<unsigned char>(text[i - 1])) == 0)))
            quote = text[i];
        if (text[i] == '{') ++depth;
        if (text[i] == '}' && --depth < 0) return false;
    }
    return depth == 0 && quote == 0;
}

}  // namespace

bool gives_nothing(const Definition& function) {
    for (uint32_t i = function.unit->tokens.first; i < function.unit->name_token; ++i)
        if (function.file->lexed.view(i) == "void") return true;
    return false;
}

namespace {

/// Which of what can be supplied the subject asks for.
void take_stand_ins(Subject& subject, const StandIns& stand_ins) {
    const auto take = [&](const std::set<std::string, std::less<>>& words) {
        for (const auto& [name, answer] : stand_ins.named)
            if (words.contains(name)) {
                subject.named.insert(name);
                subject.stood_in.insert(answer.number);
                subject.has_notes = subject.has_notes || answer.type == "void";
            }
    };
    take(subject.closure.words);
    for (const Piece& piece : subject.closure.pieces) {
        const Definition& one = *piece.definition;
        if (one.kind == Definition::Kind::Variable) subject.variables.push_back(&one);
        const auto stood = stand_ins.functions.find(&one);
        if (stood == stand_ins.functions.end()) {
            take(piece.words);
            continue;
        }
        subject.stood_in.insert(stood->second);
        subject.has_notes = subject.has_notes || gives_nothing(one);
    }
    std::sort(subject.variables.begin(), subject.variables.end(),
              [](const Definition* a, const Definition* b) { return a->name < b->name; });
}

}  // namespace

Subject subject_of(const Definition& function, const Definitions& definitions, const StandIns& stand_ins,
                   const Definition& counterpart) {
    Subject out;
    out.function = &function;
    const ScannedFile& file = *function.file;
    const Unit& unit = *function.unit;
    if (unit.kind == UnitKind::Kernel) {
        out.reason = "a kernel: it takes its work from a launch";
    } else if (!function.owner.empty()) {
        out.reason = "a member function of " + function.owner;
    } else if (function.name == "main") {
        out.reason = "the start of a program";
    } else if (unit.body.empty()) {
        out.reason = "an empty body";
    }
    if (const std::string macro = pointers_by_macro(function, definitions); !macro.empty() && out.reason.empty())
        out.reason = "pointer of unknown length: in " + macro;
    if (!out.reason.empty()) return out;
    Supplied supplied;
    supplied.variables = stand_ins.variables;
    for (const auto& [one, number] : stand_ins.functions)
        if (one != &function) supplied.functions.insert(one);
    out.closure = closure_of(function, definitions, supplied);
    out.reason = out.closure.missing;
    if (!out.reason.empty()) return out;
    take_stand_ins(out, stand_ins);
    out.template_arguments = template_arguments(file, unit, number_type_of(counterpart));
    if (out.template_arguments == "?") {
        out.reason = "a template over more than types";
        return out;
    }
    const std::set<std::string, std::less<>> fields = fields_in(out.closure);
    out.parameters = parameters_of(file, unit, manner_of(function, definitions, fields));
    PointerReach reach(definitions);
    const std::map<std::string, std::string> values = template_values(file, unit, out.template_arguments);
    for (SubjectParameter& parameter : out.parameters) {
        if (const auto value = values.find(parameter.bound); value != values.end()) parameter.bound = value->second;
        if (!parameter.is_pointer) continue;
        parameter.elements = reach.of(function, parameter.name);
        if (parameter.elements != 0) continue;
        if (!parameter.can_be_array) out.reason = "pointer of unknown length: " + parameter.name;
        parameter.is_guess = true;
        parameter.elements = kGuessedElements;
    }
    const CppManner manner = manner_of(function, definitions, fields);
    for (const Piece& piece : out.closure.pieces)
        if (out.reason.empty() && piece.definition->conditions.empty() && !closes(cpp_text(piece, manner)))
            out.reason = "does not compile as C++: the braces of " + piece.definition->name + " do not close";
    return out;
}

std::string subject_text(const Subject& subject, int number, const Definitions& definitions, const StandIns& stand_ins,
                         bool widens) {
    const std::set<std::string, std::less<>> fields = fields_in(subject.closure);
    CppManner manner = manner_of(*subject.function, definitions, fields);
    manner.widens = widens;
    std::string before, announcements, pieces, visitors, after;
    std::set<std::string> used;
    std::map<std::string, std::vector<const Definition*>> later;  // functions that are not written yet
    for (const Piece& piece : subject.closure.pieces)
        if (piece.definition->kind == Definition::Kind::Function && piece.definition->conditions.empty())
            later[piece.definition->name].push_back(piece.definition);
    for (const Piece& piece : subject.closure.pieces) {
        const Definition& one = *piece.definition;
        if (const auto written = later.find(one.name); written != later.end()) std::erase(written->second, &one);
        for (const std::string& word : piece.words)
            if (const auto called = later.find(word); called != later.end() && one.kind != Definition::Kind::Macro)
                for (const Definition* function : std::exchange(called->second, {}))
                    pieces += prototype(*function, manner);
        if (one.kind == Definition::Kind::Function && prelude_names().contains(one.name)) used.insert(one.name);
        if (one.kind == Definition::Kind::Variable) {
            pieces += std::string(type_of_variable(one)) + " " + one.name + ";\n";
            continue;
        }
        const auto stand_in = stand_ins.functions.find(&one);
        manner.body.reset();
        if (stand_in != stand_ins.functions.end() && one.kind == Definition::Kind::Function)
            manner.body = answer(one, stand_in->second);
        (one.kind == Definition::Kind::Macro ? before : pieces) += cpp_text(piece, manner);
        if (one.kind == Definition::Kind::Struct) {
            visitors += visitor(one, manner);
            announcements += announced(one, manner);
        }
        after += undone(one);
    }
    if (prelude_names().contains(subject.function->name)) used.insert(subject.function->name);
    manner.body.reset();
    manner.rename = "porttool_subject";
    std::string out = fmt::format("#line 1 \"subject_{}\"\n", number);
    out += before;
    out += fmt::format("namespace subject_{} {{ namespace {{\nusing namespace porttool_prelude;\n", number);
    for (const std::string& name : used) out += fmt::format("using porttool_prelude::{};\n", name);
    out += announcements;
    for (const std::string& name : subject.named) {
        const NamedAnswer& answer = stand_ins.named.find(name)->second;
        if (answer.type == "void")
            out += fmt::format("template <class... A> void {}(A... a) {{ porttool_harness::noted({}, a...); }}\n", name,
                               answer.number);
        else
            out += fmt::format(
                "template <class... A> auto {}(A... a) {{ return porttool_harness::answered<{}>({}, a...); }}\n", name,
                answer.type, answer.number);
    }
    out += pieces;
    out += cpp_text(Piece{subject.function, {}, {}}, manner);
    out += "const porttool_harness::Param porttool_params[] = {";
    for (const SubjectParameter& parameter : subject.parameters) {
        const std::string count =
            parameter.bound.empty() ? std::to_string(parameter.elements) : "static_cast<int>(" + parameter.bound + ")";
        out += fmt::format("{{\"{}\", {}}}, ", parameter.name, count);
    }
    out += "{nullptr, 0}};\n";  // a bound may be spelled with a macro
    out += after;
    out += visitors;
    out += fmt::format(
        "struct PorttoolGlobals {{ static constexpr bool kHasNotes = {}; template <class V> void operator()(V& v) "
        "const {{",
        subject.has_notes);
    for (const Definition* one : subject.variables)
        out += fmt::format(" porttool_harness::walk(v, \"{0}\", {0});", one->name);
    out += " } };\n";
    const std::string pointer = "&porttool_subject" + subject.template_arguments;
    out +=
        fmt::format("void porttool_list() {{ porttool_harness::list({}, porttool_params, PorttoolGlobals(), {}); }}\n",
                    pointer, !subject.stood_in.empty());
    out += fmt::format(
        "void porttool_run(const uint64_t* in, size_t is, uint64_t* out, size_t os, size_t n) {{ "
        "porttool_harness::run({}, "
        "porttool_params, PorttoolGlobals(), in, is, out, os, n); }}\n",
        pointer);
    out += "} }\n";
    return out;
}

}  // namespace porttool
