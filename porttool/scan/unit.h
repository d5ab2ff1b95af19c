// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/language/language.h"
#include "porttool/scan/token.h"

namespace porttool {

enum class UnitKind : uint8_t { Function, Kernel, Struct, Constant, File };

/// "function", "kernel", "struct", "constant", "file".
std::string_view unit_kind_name(UnitKind kind);

/// A half-open range of indices into LexedText::tokens.
struct TokenRange {
    uint32_t first = 0;
    uint32_t end = 0;
    bool empty() const { return first >= end; }
};

/// A piece of a file that can have a counterpart. Units never share a token: what a class defines inside its body are
/// units of their own, and holes in the unit of the class.
struct Unit {
    std::string name;  ///< qualified, with #2, #3 for later ones of the same name
    UnitKind kind = UnitKind::Function;
    uint32_t start_line = 0;
    uint32_t end_line = 0;  ///< that of the closing brace; the lines of a class go around those of its inner units
    TokenRange tokens;
    TokenRange parameters;    ///< between the parentheses; functions only
    TokenRange body;          ///< between the braces
    uint32_t name_token = 0;  ///< where the name stands
    std::vector<TokenRange> holes;
    uint32_t namespace_length = 0;  ///< how much of the name is namespaces, which ports rarely share
};

/// A variable that a file declares outside of units, and how: the words before its value. A GLSL block of variables
/// counts for its instance, or for each of its members; what a GLSL file lays out without a name, as the sizes of
/// a kernel's groups, is that of `layout`.
/// Also what a file says beside it of a variable (`threadprivate`), and of a function apart from its definition:
/// defaults of its arguments, attributes, explicit instantiations.
struct FileVariable {
    enum About : uint8_t { Declares, Says, SaysOfFunction };
    uint32_t name_token = 0;
    TokenRange tokens;
    About about = Declares;
};

/// A pragma outside of functions, and for which tokens it holds.
struct FilePragma {
    TokenRange tokens;
    uint32_t first = 0, end = 0;
    bool lays_out = false;  ///< it is about structs, `pack`, else about functions
};

enum class LineClass : uint8_t { Blank, Comment, Directive, Declaration, Unit, Unclassified };

/// One file after scanning: its tokens, its units in order of appearance, and what each line belongs to.
struct ScannedFile {
    std::string path;
    Language language = Language::Unknown;
    LexedText lexed;
    std::vector<Unit> units;
    std::vector<LineClass> lines;         ///< lines[0] is line 1
    std::vector<FileVariable> variables;  ///< sorted by name
    std::vector<FilePragma> pragmas;
    std::vector<std::string> spelling_macros;  ///< names of macros that take arguments as they are spelled, sorted
    bool balanced = true;
};

}  // namespace porttool
