// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/new_unit.h"

#include <algorithm>
#include <map>

#include "porttool/language/language.h"
#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/normal/unit_state.h"
#include "porttool/sync/code_text.h"
#include "porttool/sync/local_manner.h"
#include "porttool/sync/rewrite.h"
#include "porttool/sync/unit_extent.h"

namespace porttool {
namespace {

std::string with_name(const std::string& text, const std::string& name) {
    const size_t at = text.find('@');
    return at == std::string::npos ? text : text.substr(0, at) + name + text.substr(at + 1);
}

std::string quoted_list(const std::set<std::string>& words) {
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? "`" : ", `") + word + "`";
    return out;
}

class NewUnitWriter {
public:
    NewUnitWriter(const UnitToPort& source, const PortManners& manners)
        : source_(source),
          manners_(manners),
          lexed_(source.file.lexed),
          here_(source.file.language),
          there_(manners.target.language),
          extent_(extent_of(source.file, source.unit)),
          names_(names_within(source.file, source.unit)) {}

    NewUnit run() {
        NewUnit out;
        const std::string code = written();
        if (failure_.empty() && !unknown_.empty())
            failure_ = "nothing tells how the port says " + quoted_list(unknown_);
        if (!failure_.empty()) return {"", failure_};
        const size_t column = extent_.code - lexed_.line_starts[lexed_.tokens[extent_.tokens.first].line - 1];
        const std::string text = comment(column) + code + comment_behind();
        if (text.find("porttool:") != std::string::npos) return {"", "a comment in it speaks to porttool"};
        return {indented(text, indent_unit(lexed_), column, indent_unit(manners_.target.lexed), ""), ""};
    }

private:
    std::string comment(size_t column) const {
        if (extent_.comment == extent_.code) return {};
        const std::string text = lexed_.text.substr(extent_.comment, extent_.code - extent_.comment);
        return text.substr(std::min(text.find_first_not_of(" \t"), column));
    }

    std::string comment_behind() const {
        const Token& last = lexed_.tokens[extent_.tokens.end - 1];
        const size_t end = last.offset + last.length;
        return lexed_.text.substr(end, extent_.end - end);
    }

    void fail(std::string why) {
        if (failure_.empty()) failure_ = std::move(why);
    }

    std::string written() {
        if (!extent_.has_lines) fail("other code stands on its lines");
        for (const std::string& name : names_)
            if (word_is(name, kKeyword | kTypePart) || is_type_word(name))
                fail("`" + name + "` may mean something else in the port's language");
        const bool is_macro = lexed_.view(extent_.tokens.first) == "#";
        if (is_macro) return macro();
        if (source_.unit.kind == UnitKind::Function) return function();
        if (source_.unit.kind == UnitKind::Struct) return record();
        if (source_.unit.kind == UnitKind::Constant) return constant();
        fail("a kernel, or a whole file, is not ported as a helper");
        return {};
    }

    /// Tokens in the port's words. The unit's own name is the new one.
    std::string carried(TokenRange range) {
        const CodeWords code = code_words(source_.file, range);
        CarriedWords words =
            manners_.translator.carry(code.words, 0, code.words.size(), [&](size_t i) { return code.written(i); });
        unknown_.insert(words.unknown.begin(), words.unknown.end());
        require_names_kept(code.words, words.words);
        if (source_.unit.kind == UnitKind::Function && range.end == source_.unit.tokens.end) add_const(code, words);
        return code_text(code, words.words, brace_manner(manners_.target));
    }

    /// Locals that never change are `const` where the port's others are.
    void add_const(const CodeWords& code, CarriedWords& words) const {
        if (!adds_const(source_.file, manners_.target)) return;
        for (const uint32_t token : constant_locals(source_.file, source_.unit, false)) {
            const auto from = static_cast<size_t>(token - code.first);
            const auto type = std::find_if(words.words.begin(), words.words.end(),
                                           [&](const CarriedWord& word) { return word.from == from; });
            if (type == words.words.end()) continue;
            type->from = CarriedWord::kNoSource;
            words.words.insert(type, {"const", from});
        }
    }

    /// A name of its own stays what it is: what another function calls so is something else.
    void require_names_kept(const std::vector<std::string>& before, const std::vector<CarriedWord>& now) {
        std::map<std::string_view, int> count;
        for (const std::string& word : before)
            if (names_.contains(word)) ++count[word];
        for (const CarriedWord& word : now)
            if (names_.contains(word.text)) --count[word.text];
        for (const auto& [name, more] : count)
            if (more != 0) fail("nothing tells what `" + std::string(name) + "` is in the port");
    }

    // Functions.

    std::string function() {
        const std::optional<HeadParts> head = read_head_parts(source_.file, source_.unit);
        if (!head) {
            fail("its head is more than a type, a name and parameters");
            return {};
        }
        std::string out = template_prefix(*head);
        const std::string before = marks(head->marks);
        if (source_.on_device && before.find("__device__") == std::string::npos)
            fail("no function beside it tells how the port marks what runs on a device");
        out += before + (before.empty() ? "" : " ") + type(head->type);
        if (out.back() != '*' && out.back() != '&') out += " ";
        out += source_.name + "(" + parameters(*head) + ")";
        const uint32_t open = source_.unit.body.first - 1;
        const Token &close = lexed_.tokens[source_.unit.parameters.end], &brace = lexed_.tokens[open];
        const size_t end = close.offset + close.length;
        std::string gap = lexed_.text.substr(end, brace.offset - end);
        const bool one_line = brace.line == lexed_.tokens[source_.unit.body.end].line;
        const BraceLine manner = one_line ? BraceLine::Unknown : brace_manner(manners_.target).head;
        if (manner == BraceLine::Own && gap.find('\n') == std::string::npos) gap = "\n";
        if (manner == BraceLine::Same && gap.find_first_not_of(" \t\n") == std::string::npos) gap = " ";
        return out + gap + carried({open, source_.unit.tokens.end});
    }

    std::string template_prefix(const HeadParts& head) {
        if (head.template_prefix.empty()) return {};
        if (!traits_of(here_).references || !traits_of(there_).references) fail("it is a template");
        const Token &last = lexed_.tokens[head.template_prefix.end - 1],
                    &next = lexed_.tokens[head.template_prefix.end];
        const size_t end = last.offset + last.length;
        return carried(head.template_prefix) + lexed_.text.substr(end, next.offset - end);
    }

    std::string marks(const HeadWords& source) {
        for (const HeadManners* manners : {&manners_.beside, &manners_.project}) {
            if (const auto text = manners->marks(source)) return *text;
            if (manners->disagree_on_marks(source)) break;
        }
        for (const HeadManners* manners : {&manners_.beside, &manners_.project})
            if (const auto text = manners->any_marks()) return *text;
        fail("no function beside it tells how the port's heads begin");
        return {};
    }

    std::string type(const HeadWords& source) {
        for (const HeadManners* manners : {&manners_.beside, &manners_.project}) {
            if (const auto text = manners->type(source)) return *text;
            if (manners->disagree_on_type(source)) {
                fail("the port has `" + source.text + "` as several types");
                return source.text;
            }
        }
        return carried_type(source);
    }

    std::string parameters(const HeadParts& head) {
        std::string out;
        for (size_t i = 0; i < head.parameters.size(); ++i) {
            const HeadWords& one = head.parameters[i];
            if (i > 0) {
                const Token& comma = lexed_.tokens[head.parameters[i - 1].tokens.end];
                const size_t end = comma.offset + comma.length;
                out += "," + lexed_.text.substr(end, lexed_.tokens[one.tokens.first].offset - end);
            }
            out += parameter(one);
        }
        return out;
    }

    std::string parameter(const HeadWords& source) {
        for (const HeadManners* manners : {&manners_.beside, &manners_.project}) {
            if (const auto text = manners->parameter(source)) return with_name(*text, source.name);
            if (manners->disagree_on_parameter(source)) {
                fail("the port has parameters `" + source.text + "` in several ways");
                return source.text;
            }
        }
        if (const auto type = HeadManners::type_word(source.words))
            for (const HeadManners* manners : {&manners_.beside, &manners_.project})
                if (const auto shape = manners->shape(source)) {
                    const uint32_t token = source.tokens.first + static_cast<uint32_t>(*type);
                    std::string text = *shape;
                    text.replace(text.find('$'), 1, carried({token, token + 1}));
                    return with_name(text, source.name);
                }
        return carried_type(source);
    }

    /// A type that no head beside it has: it is said as elsewhere, if it is one that is passed so in both languages.
    std::string carried_type(const HeadWords& source) {
        for (const std::string& word : source.words) {
            const bool references = word == "&" || word == "&&";
            const bool directions = word == "in" || word == "out" || word == "inout";
            if ((references && !traits_of(there_).references) || (word == "*" && !traits_of(there_).pointers) ||
                (directions && here_ != there_))
                fail("no head beside it tells how the port says `" + with_name(source.text, source.name) + "`");
        }
        const bool whole =
            source.words.size() == 2 && source.words[1] == "@" && !is_type_word(source.words[0]) && here_ != there_;
        if (whole) fail("no head beside it tells how the port takes a `" + source.words[0] + "`");
        return carried(source.tokens);
    }

    // Others.

    std::string record() {
        if (!source_.unit.holes.empty()) fail("it has functions of its own");
        if (here_ != there_ && lexed_.view(extent_.tokens.first) == "typedef") fail("it is a type definition");
        return carried(extent_.tokens);
    }

    std::string macro() {
        if (!traits_of(there_).macros) fail("it is a macro");
        const size_t name = lexed_.tokens[source_.unit.name_token].offset;
        return lexed_.text.substr(extent_.code, name - extent_.code) +
               carried({source_.unit.name_token, extent_.tokens.end});
    }

    std::string constant() {
        const std::optional<HeadParts> head = read_head_parts(source_.file, source_.unit);
        if (!head) return carried(extent_.tokens);
        for (const HeadManners* manners : {&manners_.beside, &manners_.project})
            if (const auto text = manners->constant(head->type))
                return *text + " " + carried({source_.unit.name_token, extent_.tokens.end});
        const bool plain = std::all_of(head->type.words.begin(), head->type.words.end(), [](const std::string& word) {
            return word == "const" || word == "static" || is_type_word(word) || word_is(word, kTypePart);
        });
        if (here_ != there_ && (!plain || there_ == Language::OpenCl || there_ == Language::C))
            fail("no constant beside it tells how the port declares one");
        return carried(extent_.tokens);
    }

    const UnitToPort& source_;
    const PortManners& manners_;
    const LexedText& lexed_;
    Language here_, there_;
    UnitExtent extent_;
    std::set<std::string, std::less<>> names_;
    std::set<std::string> unknown_;
    std::string failure_;
};

}  // namespace

NewUnit port_new_unit(const UnitToPort& source, const PortManners& manners) {
    return NewUnitWriter(source, manners).run();
}

std::set<std::string, std::less<>> names_within(const ScannedFile& file, const Unit& unit) {
    const LexedText& lexed = file.lexed;
    std::set<std::string, std::less<>> out;
    for (const std::string& name : local_names(file, unit)) out.insert(name);
    const auto is_identifier = [&](uint32_t i) { return lexed.tokens[i].kind == TokenKind::Identifier; };
    const bool is_macro = lexed.view(unit.tokens.first) == "#";
    if (is_macro) {
        const uint32_t open = unit.name_token + 1;
        const bool adjacent =
            open < unit.tokens.end && lexed.view(open) == "(" &&
            lexed.tokens[open].offset == lexed.tokens[open - 1].offset + lexed.tokens[open - 1].length;
        for (uint32_t i = open + 1; adjacent && i < unit.tokens.end && lexed.view(i) != ")"; ++i)
            if (is_identifier(i)) out.emplace(lexed.view(i));
        return out;
    }
    if (unit.kind == UnitKind::Function) {
        if (lexed.view(unit.tokens.first) != "template") return out;
        for (uint32_t i = unit.tokens.first + 1; i + 1 < unit.name_token && lexed.view(i) != ">"; ++i)
            if (is_identifier(i) && (lexed.view(i + 1) == "," || lexed.view(i + 1) == ">" || lexed.view(i + 1) == "="))
                out.emplace(lexed.view(i));
        return out;
    }
    const bool lists = unit.kind == UnitKind::Struct || lexed.view(unit.tokens.first) == "enum";
    if (!lists || unit.body.empty()) return out;
    for (uint32_t i = unit.body.first; i < unit.body.end && i + 1 < lexed.tokens.size(); ++i) {
        const std::string_view next = lexed.view(i + 1);
        const bool ends = next == ";" || next == "[" || next == "," || next == "=" || next == "}" || next == ":";
        if (is_identifier(i) && ends && !is_type_word(lexed.view(i))) out.emplace(lexed.view(i));
    }
    return out;
}

}  // namespace porttool
