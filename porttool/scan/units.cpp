// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/units.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/scan/constants.h"
#include "porttool/scan/head.h"
#include "porttool/scan/variables.h"

namespace porttool {
namespace {

class UnitFinder {
public:
    UnitFinder(const LexedText& lexed, const Structure& structure, Language language)
        : lexed_(lexed),
          structure_(structure),
          macros_(read_macros(lexed)),
          angles_(lexed, structure),
          context_{lexed, structure, language, macros_, angles_} {}

    UnitList run() {
        end_ = static_cast<uint32_t>(structure_.tokens.size());
        scopes_.push_back({end_, 0, false, kNoUnit, 0});
        while (at_ < end_ || scopes_.size() > 1) step();
        declare(start_, end_);
        return std::move(out_);
    }

private:
    static constexpr size_t kNoUnit = static_cast<size_t>(-1);
    // Scopes in scopes, and many small units in a scope of a long name, would fill the memory with their names.
    static constexpr size_t kLongestPrefix = 1024, kDeepestPrefix = 16;
    // Classes within more than so many others are text of the one around them, not units: nobody writes them, and a
    // file of nothing else would be one small unit for every dozen bytes.
    static constexpr size_t kDeepestClass = 64;
    static constexpr size_t kMostPrefixes(size_t text) { return 8 * text + 262'144; }

    struct Scope {
        uint32_t close;  ///< position of the closing brace, or the end of the file
        size_t prefix;   ///< how much of prefix_ holds in it
        bool is_class;
        size_t unit;               ///< the innermost class around, as a unit
        uint32_t namespaces = 0;   ///< length of the prefix that is namespaces
        bool is_argument = false;  ///< of a macro
    };

    std::string_view word(uint32_t at) const {
        return at < end_ ? lexed_.view(structure_.tokens[at]) : std::string_view();
    }
    uint32_t token(uint32_t at) const { return structure_.tokens[at]; }

    void step() {
        if (at_ >= scopes_.back().close || at_ >= end_) return leave_scope();
        const Token& current = lexed_.tokens[token(at_)];
        if (current.kind != TokenKind::Punctuator || current.length != 1) {
            if (current.kind == TokenKind::Identifier && word(at_) == "template" && word(at_ + 1) == "<") {
                const uint32_t after = angles_.skip(at_ + 1, std::min(scopes_.back().close, at_ + 1024));
                if (after != kNoMatch) at_ = after - 1;
            }
            ++at_;
            return;
        }
        switch (lexed_.text[current.offset]) {
            case '(':
                if (holds_program(at_)) return enter_argument();
                [[fallthrough]];
            case '[':
                at_ = inside(structure_.match[at_]) ? structure_.match[at_] + 1 : at_ + 1;
                break;
            case ';':
                end_statement();
                break;
            case '{':
                read_brace();
                break;
            case '}':
                next_statement(at_ + 1);
                break;
            case '=':
                assigned_ = assigned_ || word(at_ - 1) != "operator" || at_ == start_;
                ++at_;
                break;
            case ':':
                read_colon();
                break;
            default:
                ++at_;
                break;
        }
    }

    bool inside(uint32_t match) const { return match != kNoMatch && match < scopes_.back().close; }

    /// True if a macro's argument, outside of any unit, is code that has functions of its own: kernels that the host
    /// has as a string.
    ///
    ///     const char *kernels = STRINGIFY( __kernel void scale(__global float *x) { ... } )
    bool holds_program(uint32_t open) const {
        if (in_argument_ || scopes_.back().is_class || open == start_ || !inside(structure_.match[open])) return false;
        if (lexed_.tokens[token(open - 1)].kind != TokenKind::Identifier) return false;
        for (uint32_t at = open + 1; at < structure_.match[open]; ++at) {
            if (word(at) == "{" && at > open + 1 && word(at - 1) == ")" && is_plain_head(open + 1, at - 1)) return true;
            const bool opens = word(at) == "(" || word(at) == "[" || word(at) == "{";
            if (opens && structure_.match[at] != kNoMatch) at = structure_.match[at];
        }
        return false;
    }

    /// True for `float f(...)` that ends at the bracket `close`: two words, and the parameters.
    bool is_plain_head(uint32_t first, uint32_t close) const {
        const uint32_t open = structure_.match[close];
        const auto is_name = [&](uint32_t at) { return lexed_.tokens[token(at)].kind == TokenKind::Identifier; };
        return open != kNoMatch && open >= first + 2 && is_name(open - 1) && is_name(open - 2);
    }

    void enter_argument() {
        const uint32_t close = structure_.match[at_];
        in_argument_ = true;
        enter_scope(close, "", false);
        scopes_.back().is_argument = true;
    }

    void declare(uint32_t first, uint32_t end) {
        if (first < end) out_.declarations.push_back({token(first), token(end - 1) + 1});
    }

    void next_statement(uint32_t start) {
        declare(start_, std::min(start, end_));
        begin_statement(start);
    }

    void begin_statement(uint32_t start) {
        start_ = at_ = start;
        assigned_ = initialiser_list_ = variable_ = false;
    }

    void read_colon() {
        const std::string_view before = at_ > start_ ? word(at_ - 1) : "";
        if (scopes_.back().is_class && word_is(before, kLabel)) return next_statement(at_ + 1);
        if (before == ")" || (at_ >= start_ + 2 && word(at_ - 2) == ")")) initialiser_list_ = true;
        ++at_;
    }

    void end_statement() {
        const bool constants = (assigned_ || variable_) && add_constants();
        if (scopes_.back().is_class)
            read_member_defaults(context_, start_, at_, out_.variables);
        else if (!constants)
            read_variables(context_, start_, at_, out_.variables);
        if (declares_old_parameters()) {
            ++at_;
            return;
        }
        next_statement(at_ + 1);
    }

    /// C before prototypes: `int add(a, b) int a; int b; {`. The head goes on after the semicolon.
    bool declares_old_parameters() const {
        if (!traits_of(context_.language).parameters_before_body || assigned_ || at_ >= end_) return false;
        for (uint32_t at = start_; at + 2 < at_; ++at) {
            if (word(at) == "typedef") return false;
            if (word(at) != "(" || structure_.match[at] == kNoMatch) continue;
            const uint32_t after = structure_.match[at] + 1;
            if (at == start_ || word_is(word(at - 1), kTakesArguments)) return false;
            const bool begins_type = word(after) == "register" || !word_is(word(after), kTakesArguments);
            return after + 1 < at_ && lexed_.tokens[token(after)].kind == TokenKind::Identifier && begins_type &&
                   word(after + 1) != "(";
        }
        return false;
    }

    bool add_constants() {
        const auto constants = read_constants(context_, start_, at_);
        for (const ConstantDeclaration& constant : constants) {
            Unit unit = new_unit(UnitKind::Constant, constant.name, constant.first, constant.end);
            unit.name_token = token(constant.name_at);
            add(std::move(unit));
        }
        return !constants.empty();
    }

    /// A unit over the positions [first, end).
    Unit new_unit(UnitKind kind, std::string_view name, uint32_t first, uint32_t end) {
        Unit unit;
        unit.kind = kind;
        unit.name = std::string(name);
        if (prefixes_ < kMostPrefixes(lexed_.text.size())) {
            prefixes_ += prefix_.size();
            unit.name.insert(0, prefix_);
            unit.namespace_length = scopes_.back().namespaces;
        }
        unit.tokens = {token(first), token(end - 1) + 1};
        unit.start_line = lexed_.tokens[token(first)].line;
        unit.end_line = lexed_.tokens[token(end - 1)].line;
        unit.name_token = token(first);
        return unit;
    }

    size_t add(Unit unit) {
        if (const size_t around = scopes_.back().unit; around != kNoUnit)
            out_.units[around].holes.push_back(unit.tokens);
        out_.units.push_back(std::move(unit));
        return out_.units.size() - 1;
    }

    void read_brace() {
        const uint32_t close = inside(structure_.match[at_]) ? structure_.match[at_] : scopes_.back().close;
        if (assigned_ || variable_) {
            at_ = std::min(close + 1, scopes_.back().close);
            return;
        }
        context_.in_class = scopes_.back().is_class;
        const Head head = read_head(context_, start_, at_);
        const std::string_view after = word(close + 1);
        if (head.kind == HeadKind::Function && initialiser_list_ && (after == "," || after == "{") &&
            word(at_ - 1) != ")") {
            at_ = close + 1;  // a member's initialiser: y{b}
            return;
        }
        switch (head.kind) {
            case HeadKind::Namespace:
                enter_scope(close, head.name, false);
                break;
            case HeadKind::Linkage:
                enter_scope(close, "", false);
                break;
            case HeadKind::Struct:
                enter_class(head, close);
                break;
            case HeadKind::Enum:
            case HeadKind::Block:
                add_closed(head, close);
                break;
            case HeadKind::Function:
                add_function(head, close);
                break;
            case HeadKind::Unknown:
                skip_block(close, after);
                break;
        }
    }

    /// `int x{1};` goes on to its semicolon; any other block is stepped over.
    void skip_block(uint32_t close, std::string_view after) {
        if (at_ > start_ && (after == ";" || after == ",")) {
            variable_ = true;
            at_ = close + 1;
            return;
        }
        next_statement(std::min(close + 1, scopes_.back().close));
    }

    void enter_scope(uint32_t close, const std::string& name, bool is_class, size_t unit = kNoUnit) {
        declare(start_, at_ + 1);
        if (!name.empty() && prefix_.size() < kLongestPrefix && scopes_.size() <= kDeepestPrefix)
            prefix_ += name + "::";
        const auto namespaces = is_class ? scopes_.back().namespaces : static_cast<uint32_t>(prefix_.size());
        scopes_.push_back({close, prefix_.size(), is_class, unit == kNoUnit ? scopes_.back().unit : unit, namespaces});
        begin_statement(at_ + 1);
    }

    void leave_scope() {
        const uint32_t close = scopes_.back().close;
        if (scopes_.back().is_argument) in_argument_ = false;
        declare(start_, std::min(close, end_));
        if (close < end_) declare(close, close + 1);
        if (scopes_.size() > 1) scopes_.pop_back();
        prefix_.resize(scopes_.back().prefix);
        begin_statement(std::min(close + 1, scopes_.back().close));
        if (close >= end_) at_ = start_ = end_;
    }

    /// The name that follows the closing brace: `typedef struct { ... } Ray;`
    std::string trailing_name(uint32_t close) const {
        uint32_t at = close + 1;
        while (at < end_ && (word(at) == "*" || word_is(word(at), kTakesArguments) || word(at) == "(")) {
            at = word(at) == "(" && structure_.match[at] != kNoMatch ? structure_.match[at] + 1 : at + 1;
        }
        if (at >= end_ || lexed_.tokens[token(at)].kind != TokenKind::Identifier) return {};
        return std::string(word(at));
    }

    /// Behind the attributes that begin at `at`: `} __attribute__((packed)) name;`
    uint32_t after_attributes(uint32_t at) const {
        while (at + 1 < end_ && (word(at) == "__attribute__" || word(at) == "__attribute") && word(at + 1) == "(" &&
               inside(structure_.match[at + 1]))
            at = structure_.match[at + 1] + 1;
        return std::min(at, end_);
    }

    void enter_class(const Head& head, uint32_t close) {
        std::string name = head.name;
        if (name.empty()) name = trailing_name(close);
        if (scopes_.size() > kDeepestClass) return next_statement(std::min(close + 1, scopes_.back().close));
        if (name.empty()) return enter_scope(close, "", true);
        const uint32_t end = std::min(close + 1, end_), attributed = after_attributes(end);
        Unit unit = new_unit(UnitKind::Struct, name, head.first, end);
        unit.body = {token(at_) + 1, token(end - 1)};
        unit.tokens.end = token(attributed - 1) + 1;
        if (head.name_at != kNoMatch) unit.name_token = token(head.name_at);
        const size_t index = add(std::move(unit));
        enter_scope(close, name, true, index);
    }

    /// Enums and interface blocks: nothing inside is a unit.
    void add_closed(const Head& head, uint32_t close) {
        std::string name = head.name.empty() ? trailing_name(close) : head.name;
        if (name.empty()) name = std::string(word(at_ + 1));
        const uint32_t end = std::min(close + 1, end_);
        if (name.empty() || name == "}") return next_statement(end);
        Unit unit =
            new_unit(head.kind == HeadKind::Enum ? UnitKind::Constant : UnitKind::Struct, name, head.first, end);
        unit.body = {token(at_) + 1, token(end - 1)};
        if (head.name_at != kNoMatch) unit.name_token = token(head.name_at);
        if (head.kind == HeadKind::Block) read_block_variables(context_, {head.first, at_, close}, out_.variables);
        declare(start_, head.first);
        add(std::move(unit));
        begin_statement(end);
    }

    void add_function(const Head& head, uint32_t close) {
        const uint32_t parameters_end = structure_.match[head.parameters];
        if (parameters_end == kNoMatch)  // `int (*{ f( }) {`: a brace closed before the list did
            return next_statement(std::min(close + 1, scopes_.back().close));
        uint32_t end = std::min(close + 1, end_);
        while (word(end) == "catch" && word(end + 1) == "(" && structure_.match[end + 1] != kNoMatch) {
            const uint32_t block = structure_.match[end + 1] + 1;
            if (word(block) != "{" || !inside(structure_.match[block])) break;
            end = structure_.match[block] + 1;
        }
        // A body that runs into its scope's closing brace lost its own.
        if (close == scopes_.back().close) end = std::min(close, end_);
        Unit unit = new_unit(head.kernel ? UnitKind::Kernel : UnitKind::Function, head.name, head.first, end);
        unit.parameters = {token(head.parameters) + 1, token(parameters_end)};
        unit.body = {token(at_) + 1, token(end - 1)};
        unit.name_token = token(head.name_at);
        declare(start_, head.first);
        add(std::move(unit));
        begin_statement(end);
    }

    const LexedText& lexed_;
    const Structure& structure_;
    MacroTable macros_;
    AngleTable angles_;
    HeadContext context_;
    UnitList out_;
    std::vector<Scope> scopes_;
    uint32_t end_ = 0;
    uint32_t at_ = 0;
    uint32_t start_ = 0;
    std::string prefix_;             ///< "A::B::", of the scope at hand
    size_t prefixes_ = 0;            ///< bytes of all names that are scopes
    bool in_argument_ = false;       ///< within a scope that is a macro's argument
    bool assigned_ = false;          ///< the statement has an initialiser
    bool initialiser_list_ = false;  ///< ... a colon after a parameter list
    bool variable_ = false;          ///< ... a braced initialiser
};

}  // namespace

UnitList find_units(const LexedText& lexed, const Structure& structure, Language language) {
    return UnitFinder(lexed, structure, language).run();
}

}  // namespace porttool
