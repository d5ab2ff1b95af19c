// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/subject_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "porttool/difftest/prelude.h"
#include "porttool/difftest/side_text.h"
#include "porttool/difftest/struct_visitor.h"
#include "porttool/difftest/variable_type.h"

namespace porttool {
namespace {

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

/// The visitors of the variables that are inputs, and of those that are outputs, each under a number of its own.
std::string globals_text(const Subject& subject) {
    std::string taken, given;
    int number = 9000;  // behind the parameters
    for (const Definition* one : subject.variables) {
        const std::string visit = fmt::format(" v.begin({}); porttool_harness::walk_variable(v, \"{}\", {});", number++,
                                              one->name, one->name);
        taken += visit;
        if (subject.given.contains(one->name)) given += visit;
    }
    return fmt::format(
        "struct PorttoolGlobals {{ static constexpr bool kHasNotes = {}; template <class V> void operator()(V& v) "
        "const {{{} }} template <class V> void give(V& v) const {{{} }} }};\n",
        subject.has_notes, taken, given);
}

}  // namespace

std::string subject_text(const Subject& subject, int number, const Definitions& definitions, const StandIns& stand_ins,
                         std::set<std::string, std::less<>> words, bool widens) {
    const std::set<std::string, std::less<>> fields = fields_in(subject.closure);
    words.merge(words_of_side(subject.closure));
    CppManner manner = manner_of(*subject.function, definitions, fields);
    manner.widens = widens;
    std::string before, announcements, pieces, visitors, conditional, after;
    std::set<std::string> used;
    std::map<std::string, std::vector<const Definition*>> later;  // functions that are not written yet
    for (const Piece& piece : subject.closure.pieces)
        if (piece.definition->kind == Definition::Kind::Function && piece.definition->unit != nullptr &&
            !is_conditional(*piece.definition))
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
            pieces += declaration_of(one);
            continue;
        }
        const auto stand_in = stand_ins.functions.find(&one);
        manner.body.reset();
        if (stand_in != stand_ins.functions.end() && one.kind == Definition::Kind::Function)
            manner.body = answer(one, stand_in->second);
        (one.kind == Definition::Kind::Macro ? before : pieces) += cpp_text(piece, manner);
        if (one.kind == Definition::Kind::Struct) {
            const std::string visit = visitor(one, manner, words);
            const bool needs_macros = !one.conditions.empty() || visit.find("PORTTOOL_MEMBER") != std::string::npos;
            (needs_macros ? conditional : visitors) += under_conditions(one, visit, manner);
            if (const std::string head = announced(one, manner); !head.empty())
                announcements += under_conditions(one, head, manner);
        }
        after += undone(one);
    }
    if (prelude_names().contains(subject.function->name)) used.insert(subject.function->name);
    manner.body.reset();
    manner.rename = "porttool_subject";
    const bool is_overloaded =
        std::any_of(subject.closure.pieces.begin(), subject.closure.pieces.end(),
                    [&](const Piece& piece) { return piece.definition->name == subject.function->name; });
    if (!is_overloaded && !prelude_names().contains(subject.function->name)) manner.recursive = subject.function->name;
    std::string out = fmt::format("#line 1 \"subject_{}\"\n", number);
    for (const auto& [name, value] : subject.assumed) {
        out += fmt::format("#define {} {}\n", name, value);
        after += fmt::format("#undef {}\n", name);
    }
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
    out += conditional;
    out += after;
    out += visitors;
    out += globals_text(subject);
    std::string pointer = "&porttool_subject" + subject.template_arguments, types;
    bool is_typed = false;
    for (const SubjectParameter& parameter : subject.parameters) {
        types += ", " + (parameter.behind.empty() ? "void" : parameter.behind);
        is_typed = is_typed || !parameter.behind.empty();
    }
    if (is_typed) pointer = "&porttool_harness::Typed<&porttool_subject" + types + ">::call";
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
