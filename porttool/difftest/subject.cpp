// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/subject.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include "porttool/difftest/assumed_macros.h"
#include "porttool/difftest/object_use.h"
#include "porttool/difftest/pointer_reach.h"
#include "porttool/difftest/struct_visitor.h"
#include "porttool/difftest/template_values.h"
#include "porttool/difftest/type_behind.h"

namespace porttool {
namespace {

/// A parameter that is a macro for several: its name, where that brings pointers along; "" for none.
std::string pointers_by_macro(const Definition& function, const Definitions& definitions) {
    const LexedText& lexed = function.file->lexed;
    for (uint32_t i = function.unit->parameters.first; i < function.unit->parameters.end; ++i) {
        if (lexed.tokens[i].kind != TokenKind::Identifier) continue;
        for (const Definition* found : definitions.find(*function.file, lexed.view(i))) {
            if (found->kind != Definition::Kind::Macro) continue;
            // One that takes arguments is none without them.
            if (takes_arguments(*found) && lexed.view(i + 1) != "(") continue;
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

Subject subject_of(const Definition& function, const Definitions& definitions, const StandIns& stand_ins,
                   const Definition& counterpart) {
    Subject out;
    out.function = &function;
    const ScannedFile& file = *function.file;
    const Unit& unit = *function.unit;
    if (unit.kind == UnitKind::Kernel) {
        out.reason = "a kernel: it takes its work from a launch";
    } else if (!function.owner.empty() && uses_its_object(function, definitions)) {
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
    supplied.arrays = stand_ins.arrays;
    for (const auto& [one, number] : stand_ins.functions)
        if (one != &function) supplied.functions.insert(one);
    out.closure = closure_of(function, definitions, supplied);
    out.reason = out.closure.missing;
    out.assumed = assumed_macros(function, definitions);
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
        if (parameter.elements != 0 && !parameter.is_untyped) continue;
        if (parameter.is_untyped && out.template_arguments.empty())
            parameter.behind = type_behind(function, parameter.name, manner_of(function, definitions, fields));
        parameter.can_be_array = parameter.can_be_array || !parameter.behind.empty();
        if (parameter.is_file)
            out.reason = "input and output: " + parameter.name;
        else if (!parameter.can_be_array)
            out.reason = "pointer of unknown length: " + parameter.name;
        parameter.is_guess = true;
        parameter.elements = kGuessedElements;
    }
    const CppManner manner = manner_of(function, definitions, fields);
    for (const Piece& piece : out.closure.pieces)  // a macro may open what another one closes
        if (out.reason.empty() && piece.definition->kind != Definition::Kind::Macro &&
            piece.definition->conditions.empty() && !closes(cpp_text(piece, manner)))
            out.reason = "does not compile as C++: the braces of " + piece.definition->name + " do not close";
    return out;
}

}  // namespace porttool
