// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/object_use.h"

#include <algorithm>

#include "porttool/difftest/struct_visitor.h"
#include "porttool/normal/unit_state.h"

namespace porttool {
namespace {

using NameSet = std::set<std::string, std::less<>>;

/// What a class declares, and a little more: every name behind which a parenthesis opens, a declaration ends, or goes
/// on.
void add_declared(const Definition& one, NameSet& out) {
    const LexedText& lexed = one.file->lexed;
    int depth = 0, rounds = 0;
    for (uint32_t i = one.tokens.first; i + 1 < one.tokens.end; ++i) {
        const std::string_view word = lexed.view(i), next = lexed.view(i + 1);
        if (word == "{") ++depth;
        if (word == "}") --depth;
        if (word == "(") ++rounds;
        if (word == ")") --rounds;
        if (depth == 1 && rounds == 0 && lexed.tokens[i].kind == TokenKind::Identifier &&
            (next == "(" || next == ";" || next == "," || next == "=" || next == "[" || next == "{" || next == ":"))
            out.insert(std::string(word));
    }
}

/// The names that a class and those that it is made from declare.
void add_members(const ScannedFile& from, const std::string& name, const Definitions& definitions, NameSet& seen,
                 NameSet& out) {
    if (!seen.insert(name).second) return;
    for (const Definition* one : definitions.find(from, name)) {
        if (one->kind != Definition::Kind::Struct) continue;
        add_declared(*one, out);
        for (const std::string& base : bases_of(*one)) add_members(*one->file, base, definitions, seen, out);
    }
}

}  // namespace

bool uses_its_object(const Definition& function, const Definitions& definitions) {
    const ScannedFile& file = *function.file;
    const LexedText& lexed = file.lexed;
    const Unit& unit = *function.unit;
    if (function.name == function.owner || function.name.starts_with("operator") || function.name.starts_with("~"))
        return true;
    NameSet members, seen;
    add_members(file, function.owner, definitions, seen, members);
    const std::vector<std::string> names = local_names(file, unit);
    const NameSet locals(names.begin(), names.end());
    for (uint32_t i = unit.body.first; i < unit.body.end; ++i) {
        if (lexed.tokens[i].kind != TokenKind::Identifier) continue;
        const std::string_view word = lexed.view(i), before = lexed.view(i - 1);
        if (word == "this") return true;
        if (before == "." || before == "->" || before == "::" || locals.contains(word)) continue;
        if (members.contains(word)) return true;
    }
    return false;
}

}  // namespace porttool
