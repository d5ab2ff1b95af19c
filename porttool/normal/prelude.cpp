// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/prelude.h"

#include <algorithm>
#include <unordered_set>

#include "porttool/language/language.h"
#include "porttool/normal/normal_form.h"

namespace porttool {
namespace {

/// Where the prelude of a text ends. It begins and ends with an empty statement, as no unit does.
Words::const_iterator end_of_prelude(const Words& text) {
    if (text.size() < 4 || text[0] != ";" || text[1] != ";") return text.begin();
    for (auto at = text.begin() + 3; at != text.end(); ++at)
        if (*at == ";" && *(at - 1) == ";") return at + 1;
    return text.begin();
}

/// What a file says that belongs to a unit.
struct Said {
    TokenRange tokens;
    uint32_t name = kNoName;  ///< added at the end, where the tokens are those of several names
    bool of_function = false;

    static constexpr uint32_t kNoName = 0xFFFFFFFFu;
};

/// The last part of a function's name: `f` of `S::f`.
std::string_view own_name(const ScannedFile& file, const Unit& unit) {
    const LexedText& lexed = file.lexed;
    const uint32_t before_bracket = unit.parameters.first >= 2 ? unit.parameters.first - 2 : unit.name_token;
    const bool is_name = lexed.tokens[before_bracket].kind == TokenKind::Identifier;
    return lexed.view(is_name ? before_bracket : unit.name_token);
}

class PreludeReader {
public:
    PreludeReader(const ScannedFile& file, const Unit& unit) : file_(file), lexed_(file.lexed), unit_(unit) {}

    std::vector<Said> run(const std::vector<uint32_t>& places) {
        const bool is_code = unit_.kind == UnitKind::Function || unit_.kind == UnitKind::Kernel;
        if (is_code) {
            look_up(own_name(file_, unit_), true);
            read_body(places);
        }
        if (is_code || unit_.kind == UnitKind::Struct)
            for (const FilePragma& pragma : file_.pragmas)
                if (pragma.lays_out != is_code && pragma.first < unit_.tokens.first && unit_.tokens.first < pragma.end)
                    found_.push_back({pragma.tokens});
        std::stable_sort(found_.begin(), found_.end(),
                         [](const Said& a, const Said& b) { return a.tokens.first < b.tokens.first; });
        return std::move(found_);
    }

private:
    static constexpr size_t kMost = 64;

    void look_up(std::string_view name, bool of_function) {
        const auto less = [&](const FileVariable& variable, std::string_view text) {
            return lexed_.view(variable.name_token) < text;
        };
        auto at = std::lower_bound(file_.variables.begin(), file_.variables.end(), name, less);
        for (; at != file_.variables.end() && lexed_.view(at->name_token) == name && found_.size() < kMost; ++at)
            if ((at->about == FileVariable::SaysOfFunction) == of_function)
                found_.push_back(
                    {at->tokens, at->about == FileVariable::Says ? at->name_token : Said::kNoName, of_function});
    }

    void read_body(const std::vector<uint32_t>& places) {
        if (file_.variables.empty()) return;
        std::unordered_set<std::string_view> seen;
        for (const uint32_t place : places) seen.insert(lexed_.view(place));
        if (unit_.kind == UnitKind::Kernel && !traits_of(file_.language).entry_point.empty()) look_up("layout", false);
        for (uint32_t i = unit_.body.first; i < unit_.body.end && found_.size() < kMost; ++i) {
            const Token& token = lexed_.tokens[i];
            if (token.kind != TokenKind::Identifier || (token.flags & kDead) != 0) continue;
            const std::string_view before = i > 0 ? lexed_.view(i - 1) : std::string_view();
            if (before == "." || before == "->" || !seen.insert(lexed_.view(token)).second) continue;
            look_up(lexed_.view(token), false);
        }
    }

    const ScannedFile& file_;
    const LexedText& lexed_;
    const Unit& unit_;
    std::vector<Said> found_;
};

}  // namespace

void write_prelude(const ScannedFile& file, const Unit& unit, const std::vector<uint32_t>& places,
                   const std::function<void(std::string_view word)>& sink) {
    if (file.variables.empty() && file.pragmas.empty()) return;
    const LexedText& lexed = file.lexed;
    const std::vector<Said> found = PreludeReader(file, unit).run(places);
    const std::string_view name = own_name(file, unit);
    for (int i = 0; i < 2 && !found.empty(); ++i) sink(";");
    uint32_t last = 0;
    for (const Said& said : found) {
        const bool is_pragma = lexed.view(said.tokens.first) == "#";
        if (said.tokens.first < last && said.name == Said::kNoName) continue;  // two names of one declaration
        last = said.tokens.end;
        const std::string_view first = lexed.view(said.tokens.first);
        const bool is_default = said.of_function && first == name;
        const bool is_attribute = said.of_function && !is_default && first != "template";
        if (is_default) sink("default");
        for (uint32_t i = said.tokens.first; i < said.tokens.end; ++i) {
            const Token& token = lexed.tokens[i];
            if ((token.flags & (is_pragma ? kDead : kDead | kInDirective)) != 0) continue;
            const bool is_text = token.kind == TokenKind::String || token.kind == TokenKind::Character;
            if (is_text && !is_attribute && !is_pragma) continue;
            if (lexed.view(token).find_first_of("\x01\x02") != std::string_view::npos) continue;  // not as recorded
            if (token.kind == TokenKind::Number)
                sink(normal_number(lexed.view(token)));
            else
                sink(said.of_function && lexed.view(token) == name ? std::string_view("@") : lexed.view(token));
        }
        if (is_attribute) sink("@");
        if (said.name != Said::kNoName) sink(lexed.view(said.name));
        sink(";");
    }
    if (!found.empty()) sink(";");
}

Words prelude_of(const Words& text) { return {text.begin(), end_of_prelude(text)}; }

Words without_prelude(const Words& text) { return {end_of_prelude(text), text.end()}; }

}  // namespace porttool
