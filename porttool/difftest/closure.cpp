// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/closure.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "porttool/difftest/argument_list.h"
#include "porttool/difftest/old_style.h"
#include "porttool/difftest/prelude.h"
#include "porttool/difftest/variable_type.h"
#include "porttool/normal/unit_state.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

constexpr size_t kMostPieces = 1000;  ///< a function that needs more is no function of its own
constexpr int kMostRounds = 4;

bool is_member_access(const LexedText& lexed, uint32_t i) {
    if (i == 0) return false;
    const std::string_view before = lexed.view(i - 1);
    return before == "." || before == "->";
}

/// True for `operator<<` and its like on streams, which no kernel needs.
bool is_about_streams(const ScannedFile& file, const Unit& unit) {
    for (uint32_t i = unit.tokens.first; i < unit.body.first; ++i) {
        const std::string_view word = file.lexed.view(i);
        if (word.find("stream") != std::string_view::npos || word == "string" ||
            word.find("serial") != std::string_view::npos)
            return true;
    }
    return false;
}

/// The names that a macro gives its arguments.
std::set<std::string, std::less<>> macro_parameters(const Definition& macro) {
    const LexedText& lexed = macro.file->lexed;
    std::set<std::string, std::less<>> out;
    if (!takes_arguments(macro)) return out;
    uint32_t i = macro.tokens.first + 3;  // # define NAME
    for (++i; i < macro.tokens.end && lexed.view(i) != ")"; ++i) out.insert(std::string(lexed.view(i)));
    return out;
}

/// True for the name of a field where it is declared: `float x, y[3];`. `depth`: of the parentheses that it stands in.
bool is_field(const LexedText& lexed, uint32_t i, uint32_t end, int depth) {
    if (depth != 0 || i == 0 || i + 1 >= end) return false;
    const std::string_view before = lexed.view(i - 1), next = lexed.view(i + 1);
    const bool after_type = lexed.tokens[i - 1].kind == TokenKind::Identifier || before == "*" || before == "&" ||
                            before == ">" || before == ",";
    return after_type && before != "return" &&
           (next == ";" || next == "," || next == "[" || next == "=" || next == ":");
}

/// True for a function's name and the scopes that stand before it.
bool is_of_name(const Unit& function, uint32_t i) {
    return i == function.name_token || (i > function.name_token && i + 1 < function.parameters.first);
}

/// True for a word behind which, if it is a class, an object is made: `C x`, `C(x)`, `C{x}`; not of `C* x` or `C& x`.
bool makes_object(const LexedText& lexed, uint32_t i, uint32_t end) {
    if (i + 1 >= end) return false;
    const std::string_view next = lexed.view(i + 1);
    return lexed.tokens[i + 1].kind == TokenKind::Identifier || next == "(" || next == "{" || next == "<";
}

class Collector {
public:
    /// `members`: names that something asks an object for; `made`: classes of which objects are made.
    Collector(const Definitions& definitions, const Supplied& supplied,
              const std::set<std::string, std::less<>>& members, const std::set<std::string, std::less<>>& made,
              const ScannedFile& root)
        : definitions_(definitions),
          supplied_(supplied),
          members_(members),
          made_(made),
          root_(root),
          has_vectors_(has_vector_types(root.language)) {}

    Closure out;
    std::set<std::string, std::less<>> seen_members, seen_made;

    /// Brings what a definition names, then the definition itself.
    void bring(const Definition& one) {
        if (state_.contains(&one) || !out.missing.empty()) return;
        state_[&one] = false;
        if (out.pieces.size() + open_ > kMostPieces) {
            out.missing = "it needs more than " + std::to_string(kMostPieces) + " other definitions";
            return;
        }
        if (one.kind == Definition::Kind::Variable) return bring_variable(one);
        ++open_;

        Piece piece{&one, {}, {}};
        if (one.kind == Definition::Kind::Struct) piece.left_out = unneeded(one);
        follow(one, piece.left_out, &piece.words);
        --open_;
        out.pieces.push_back(std::move(piece));
        if (one.kind == Definition::Kind::Struct) {
            for (const Definition* member : definitions_.members(one.name))
                if (!is_inside(*member, one)) bring_member(*member, one);
            bring_operators(one.name);
        }
    }

    /// Brings what stands in the text of a definition.
    void follow(const Definition& one, const std::vector<TokenRange>& left_out,
                std::set<std::string, std::less<>>* words = nullptr) {
        const LexedText& lexed = one.file->lexed;
        for (const uint32_t directive : one.conditions) {
            const Directive& line = lexed.directives[directive];
            for (uint32_t i = line.first_token + 1; i < line.end_token; ++i)
                if (lexed.tokens[i].kind == TokenKind::Identifier)
                    for (const Definition* found : asked_for(one, line, i))
                        if (found->kind == Definition::Kind::Macro && found != &one) bring(*found);
        }
        std::set<std::string, std::less<>> locals;
        if (one.unit != nullptr && one.kind == Definition::Kind::Function) {
            for (std::string& name : local_names(*one.file, *one.unit)) locals.insert(std::move(name));
            if (is_old_style(lexed, *one.unit) || has_two_heads(lexed, *one.unit))
                for (const TokenRange name : list_parts(lexed, one.unit->parameters))
                    locals.insert(std::string(lexed.view(name.end - 1)));
        }
        if (one.kind == Definition::Kind::Macro) locals = macro_parameters(one);
        TokenRange range = one.tokens;
        if (supplied_.functions.contains(&one)) range.end = one.unit->body.first;
        names_in(one, range, left_out, locals, words);
    }

private:
    /// A member that stands outside of its class, where it is named. A constructor or an operator may be used without
    /// being named, and need not be: one that cannot be brought along is missing where it is used.
    void bring_member(const Definition& member, const Definition& owner) {
        if (members_.contains(member.name)) return bring(member);
        const bool constructs = member.name == owner.name && made_.contains(owner.name);
        if (!constructs && !is_kept_operator(member)) return;
        const auto pieces = static_cast<std::ptrdiff_t>(out.pieces.size());
        const std::map<const Definition*, bool> state = state_;
        const std::set<std::string, std::less<>> vectors = vectors_;
        bring(member);
        if (out.missing.empty()) return;
        out.missing.clear();
        out.pieces.erase(out.pieces.begin() + pieces, out.pieces.end());
        state_ = state;
        vectors_ = vectors;
    }

    void bring_variable(const Definition& one) {
        const VariableType type = type_of_variable(one);
        if (!(type.is_single() ? supplied_.variables : supplied_.arrays).contains(one.name) || type.name.empty()) {
            out.missing = "binding " + one.name +
                          (type.name.empty() ? ": a type that no run can make" : ": the other side has none like it");
            return;
        }
        const auto is_same = [&](const Piece& piece) {
            return piece.definition->kind == Definition::Kind::Variable && piece.definition->name == one.name;
        };
        if (std::any_of(out.pieces.begin(), out.pieces.end(), is_same)) return;  // announced in a header, too
        std::istringstream words(type.name + " " + type.bounds);
        for (std::string word; words >> word;)
            for (const Definition* found : definitions_.find(*one.file, word))
                if (found->owner.empty()) bring(*found);
        out.pieces.push_back(Piece{&one, {}, {}});
    }

    void bring_operators(std::string_view type) {
        for (const Definition* one : definitions_.operators(root_, type))
            if (!is_about_streams(*one->file, *one->unit)) bring(*one);
    }

    /// An operator that a class declares stays in it, and needs its text.
    static bool is_kept_operator(const Definition& member) {
        return member.name.starts_with("operator") && member.unit != nullptr &&
               !is_about_streams(*member.file, *member.unit);
    }

    static bool is_inside(const Definition& member, const Definition& owner) {
        return member.file == owner.file && member.tokens.first >= owner.tokens.first &&
               member.tokens.end <= owner.tokens.end;
    }

    /// What a class only declares of how its objects begin and end, and with it the types that this takes.
    static void leave_out_constructors(const Definition& one, std::vector<TokenRange>& left_out) {
        const LexedText& lexed = one.file->lexed;
        int depth = 0;
        for (uint32_t i = one.tokens.first; i + 1 < one.tokens.end; ++i) {
            if (lexed.view(i) == "{") ++depth;
            if (lexed.view(i) == "}") --depth;
            if (depth != 1 || lexed.view(i) != one.name || lexed.view(i + 1) != "(") continue;
            uint32_t first = i;
            while (is_one_of(lexed.view(first - 1), {"~", "explicit", "virtual", "constexpr", "inline"})) --first;
            if (!is_one_of(lexed.view(first - 1), {"{", "}", ";", ":"})) continue;
            uint32_t end = i;
            while (end < one.tokens.end && lexed.view(end) != ";" && lexed.view(end) != "{") ++end;
            if (end < one.tokens.end && lexed.view(end) == ";") left_out.push_back({first, end + 1});
        }
    }

    std::vector<TokenRange> unneeded(const Definition& one) const {
        std::vector<TokenRange> left_out;
        for (const Unit& unit : one.file->units) {
            if (unit.tokens.first <= one.tokens.first || unit.tokens.end > one.tokens.end) continue;
            if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) continue;
            const std::string leaf = [&] {
                std::string name = unit.name.substr(0, unit.name.find('#'));
                const size_t at = name.rfind("::");
                return at == std::string::npos ? name : name.substr(at + 2);
            }();
            const bool constructs = leaf == one.name && made_.contains(one.name);
            const bool is_operator = leaf.starts_with("operator");
            if (((constructs || is_operator) && !is_about_streams(*one.file, unit)) || members_.contains(leaf))
                continue;
            left_out.push_back({unit.tokens.first, end_of_function(one.file->lexed, unit)});
        }
        if (!made_.contains(one.name)) leave_out_constructors(one, left_out);
        std::sort(left_out.begin(), left_out.end(), [](TokenRange a, TokenRange b) { return a.first < b.first; });
        return left_out;
    }

    void names_in(const Definition& one, TokenRange range, const std::vector<TokenRange>& left_out,
                  const std::set<std::string, std::less<>>& locals, std::set<std::string, std::less<>>* words) {
        const LexedText& lexed = one.file->lexed;
        auto hole = left_out.begin();
        int depth = 0, braces = 0;
        for (uint32_t i = range.first; i < range.end && out.missing.empty(); ++i) {
            while (hole != left_out.end() && hole->end <= i) ++hole;
            if (hole != left_out.end() && hole->first <= i) {
                i = hole->end - 1;
                continue;
            }
            const Token& token = lexed.tokens[i];
            if (lexed.view(token) == "(") ++depth;
            if (lexed.view(token) == ")") --depth;
            if (lexed.view(token) == "{") ++braces;
            if (lexed.view(token) == "}") --braces;
            if (token.kind != TokenKind::Identifier || (token.flags & kDead) != 0) continue;
            const std::string_view word = lexed.view(token);
            if (words != nullptr) words->insert(std::string(word));
            if ((one.kind != Definition::Kind::Struct || braces > 1) && makes_object(lexed, i, range.end))
                seen_made.insert(std::string(word));
            if (one.kind == Definition::Kind::Function && one.unit != nullptr && is_of_name(*one.unit, i)) continue;
            if (is_member_access(lexed, i) || (i > 0 && lexed.view(i - 1) == "::"))
                seen_members.insert(std::string(word));
            // A class calls what is its own by the bare name.
            if ((one.kind == Definition::Kind::Struct ? braces > 1 : !one.owner.empty()) && i + 1 < range.end &&
                lexed.view(i + 1) == "(")
                seen_members.insert(std::string(word));
            if (is_member_access(lexed, i) || locals.contains(word) || word == "defined" || word == "operator")
                continue;
            if (one.kind == Definition::Kind::Struct && is_field(lexed, i, range.end, depth)) continue;
            if (is_vector_type(word)) {
                // Languages that have vectors themselves let nobody define them, or their operators.
                if (has_vectors_) continue;
                if (vectors_.insert(std::string(word)).second && definitions_.find(*one.file, word).empty())
                    bring_operators(word);
            }
            for (const Definition* found : callable(meant_by(one, word), arguments_of_call(lexed, i, range.end)))
                if (found->owner.empty() && found != &one) bring(*found);
        }
    }

    /// The macro that a condition asks for. A header may ask whether those who include it define one before that.
    std::vector<const Definition*> asked_for(const Definition& one, const Directive& line, uint32_t i) const {
        const LexedText& lexed = one.file->lexed;
        std::vector<const Definition*> own = definitions_.find_macro(*one.file, lexed.view(i));
        const bool denies = lexed.view(line.first_token + 1) == "ifndef";  // a default, which stands where it is
        return own.empty() && !denies && one.file != &root_ ? definitions_.find_macro(root_, lexed.view(i)) : own;
    }

    /// What a name in a piece means. A macro is written where it is used: what its own file does not know, that of the
    /// function may.
    const std::vector<const Definition*>& meant_by(const Definition& one, std::string_view word) const {
        const std::vector<const Definition*>& own = definitions_.find(*one.file, word);
        return own.empty() && one.kind == Definition::Kind::Macro ? definitions_.find(root_, word) : own;
    }

    const Definitions& definitions_;
    const Supplied& supplied_;
    const std::set<std::string, std::less<>>& members_;
    const std::set<std::string, std::less<>>& made_;
    const ScannedFile& root_;
    const bool has_vectors_;
    std::set<std::string, std::less<>> vectors_;  ///< built-in types whose operators were looked for
    std::map<const Definition*, bool> state_;
    size_t open_ = 0;
};

}  // namespace

Closure closure_of(const Definition& function, const Definitions& definitions, const Supplied& supplied) {
    std::set<std::string, std::less<>> members, made;
    for (int round = 0;; ++round) {
        Collector collector(definitions, supplied, members, made, *function.file);
        collector.follow(function, {}, &collector.out.words);
        const size_t known = members.size() + made.size();
        members.insert(collector.seen_members.begin(), collector.seen_members.end());
        made.insert(collector.seen_made.begin(), collector.seen_made.end());
        if (members.size() + made.size() != known && round != kMostRounds && collector.out.missing.empty()) continue;
        std::vector<const ScannedFile*> files;
        for (const Piece& piece : collector.out.pieces) files.push_back(piece.definition->file);
        files.push_back(function.file);
        const ReadingOrder order = definitions.reading_order(files);
        const auto place = [&](const Piece& piece) {
            const ScannedFile& file = *piece.definition->file;
            return order.place(file, file.lexed.tokens[piece.definition->tokens.first].offset);
        };
        std::stable_sort(collector.out.pieces.begin(), collector.out.pieces.end(),
                         [&](const Piece& a, const Piece& b) { return place(a) < place(b); });
        return collector.out;
    }
}

}  // namespace porttool
