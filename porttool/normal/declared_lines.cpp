// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/declared_lines.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <unordered_map>

#include "porttool/normal/normal_form.h"
#include "porttool/scan/declared_words.h"
#include "porttool/scan/macros.h"
#include "porttool/text/fingerprint.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

class DeclarationReader {
public:
    explicit DeclarationReader(const ScannedFile& file) : file_(file), lexed_(file.lexed) {}

    std::vector<MacroLine> run() {
        std::unordered_map<uint32_t, const Unit*> by_brace;  // structs, by the token that opens them
        for (const Unit& unit : file_.units) {
            if (unit.kind == UnitKind::Constant) add_constant(unit);
            if (unit.kind == UnitKind::Struct && unit.body.first > 0) by_brace.emplace(unit.body.first - 1, &unit);
            if (unit.kind == UnitKind::Struct && is_one_of(lexed_.view(unit.tokens.first), {"cbuffer", "tbuffer"}))
                add_members(unit);
        }
        for (const FileVariable& variable : file_.variables) {
            if (variable.about != FileVariable::Declares) continue;
            const auto block = by_brace.find(variable.tokens.end);
            if (block != by_brace.end())
                add(variable.name_token, text_of({behind_layout(variable.tokens), block->second->body.end + 1}));
        }
        for (const DeclaredWord& one : declared_words(file_))
            if (one.kind == DeclaredWord::Kind::Type || gives_value(one)) add(one.name_token, text_of(one.tokens));
        std::stable_sort(out_.begin(), out_.end(),
                         [](const MacroLine& a, const MacroLine& b) { return a.line < b.line; });
        return std::move(out_);
    }

private:
    bool is_code(uint32_t at) const {
        const Token& token = lexed_.tokens[at];
        return (token.flags & kDead) == 0;
    }

    /// A block without its `layout(binding = 0)` in front: where the host puts it. How it is packed stands before each
    /// text that uses it.
    uint32_t behind_layout(TokenRange tokens) const {
        if (lexed_.view(tokens.first) != "layout") return tokens.first;
        uint32_t at = tokens.first;
        while (at < tokens.end && lexed_.view(at) != ")") ++at;
        return std::min(at + 1, tokens.end);
    }

    std::string text_of(TokenRange tokens) const {
        std::string out;
        const auto end = std::min(tokens.end, static_cast<uint32_t>(lexed_.tokens.size()));
        for (uint32_t at = tokens.first; at < end; ++at) {
            if (!is_code(at) || (lexed_.view(at) == ";" && at + 1 == end)) continue;
            if (!out.empty()) out += ' ';
            if (lexed_.tokens[at].kind == TokenKind::Number)
                out += normal_number(lexed_.view(at));
            else
                out += lexed_.view(at);
        }
        return out;
    }

    /// A variable with its first value; how one without is declared stands before each text that uses it.
    bool gives_value(const DeclaredWord& one) const {
        if (one.kind != DeclaredWord::Kind::Declared) return false;
        uint32_t at = one.name_token + 1;
        while (at < one.tokens.end && lexed_.view(at) == "[")
            while (at < one.tokens.end && lexed_.view(at++) != "]") {
            }
        return at < one.tokens.end && lexed_.view(at) == "=";
    }

    void add(uint32_t name, const std::string& text) {
        out_.push_back({"=" + std::string(lexed_.view(name)), in_short(text), lexed_.tokens[name].line});
    }

    /// The members of one of HLSL's blocks, which functions name as they name variables.
    void add_members(const Unit& block) {
        uint32_t first = block.body.first;
        for (uint32_t at = first; at < block.body.end; ++at) {
            if (lexed_.view(at) != ";") continue;
            uint32_t name = first;
            for (uint32_t k = first; k < at && !is_one_of(lexed_.view(k), {"[", ":"}); ++k)
                if (lexed_.tokens[k].kind == TokenKind::Identifier) name = k;
            if (is_code(name) && lexed_.tokens[name].kind == TokenKind::Identifier) add(name, text_of({first, at}));
            first = at + 1;
        }
    }

    /// A long text with the hash of its value, or of all of it, in the place of most of that: of a table of numbers no
    /// more is kept.
    static std::string in_short(const std::string& text) {
        constexpr size_t kLong = 240, kHead = 120, kShown = 40;
        if (text.size() <= kLong) return text;
        const size_t sign = text.find(" = ");
        const size_t value = sign == std::string::npos || sign > kHead ? 0 : sign + 3;
        Fingerprinter print;
        print.add(std::string_view(text).substr(value));
        return text.substr(0, value + kShown) + " ... " + print.digits();
    }

    /// Not of macros with arguments, which are functions rather.
    void add_constant(const Unit& unit) {
        if (lexed_.view(unit.tokens.first) == "#") {
            if (!is_function_like(lexed_, unit.name_token)) add(unit.name_token, text_of(unit.tokens));
            return;
        }
        uint32_t at = unit.tokens.first;
        while (at < unit.tokens.end && lexed_.view(at) != "enum" && lexed_.view(at) != "{" && lexed_.view(at) != "=")
            ++at;
        if (at < unit.tokens.end && lexed_.view(at) == "enum") return add_enumerators(at, unit.tokens.end);
        add(unit.name_token, text_of(unit.tokens));
    }

    void add_enumerators(uint32_t at, uint32_t end) {
        while (at < end && lexed_.view(at) != "{") ++at;
        std::string last = "";  // what was written of the value that the others count from
        int64_t more = 0;
        for (++at; at < end && lexed_.view(at) != "}";) {
            if (lexed_.tokens[at].kind != TokenKind::Identifier || !is_code(at)) {
                ++at;
                continue;
            }
            const uint32_t name = at++;
            if (at < end && lexed_.view(at) == "=") {
                const uint32_t first = ++at;
                int depth = 0;
                for (; at < end && (depth > 0 || (lexed_.view(at) != "," && lexed_.view(at) != "}")); ++at)
                    depth += lexed_.view(at) == "(" ? 1 : lexed_.view(at) == ")" ? -1 : 0;
                last = text_of({first, at});
                more = 0;
            }
            const std::string value = counted(last, more++);
            const bool is_directive = lexed_.view(name - 1) == "#";  // counted all the same, as in locks of before
            if (!is_directive) add(name, "enum " + std::string(lexed_.view(name)) + " = " + value);
        }
    }

    /// The value of an enumerator that many behind one of which the value is written; "" is 0.
    static std::string counted(const std::string& written, int64_t more) {
        if (written.empty()) return std::to_string(more);
        int64_t number = 0;
        const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), number);
        const bool is_number = error == std::errc() && end == written.data() + written.size();
        constexpr int64_t kMost = int64_t{1} << 62;
        if (is_number && number < kMost) return std::to_string(number + more);
        return more == 0 ? written : written + " + " + std::to_string(more);
    }

    const ScannedFile& file_;
    const LexedText& lexed_;
    std::vector<MacroLine> out_;
};

}  // namespace

std::vector<MacroLine> declared_lines(const ScannedFile& file) { return DeclarationReader(file).run(); }

}  // namespace porttool
