// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/body_traits.h"

#include <algorithm>
#include <array>

#include "porttool/text/letters.h"

namespace porttool {
namespace {

/// True if the name has one of the words, whatever the case: `clEnqueueNDRangeKernel` has `enqueue`.
template <size_t N>
bool has_any(std::string_view name, const std::array<std::string_view, N>& words) {
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return holds_in_any_case(name, word); });
}

/// The name of a call that hands a kernel an argument.
bool is_argument_name(std::string_view name) {
    constexpr std::array<std::string_view, 2> kWhat = {"arg", "param"};
    constexpr std::array<std::string_view, 5> kHow = {"set", "add", "assign", "bind", "pass"};
    return holds_in_any_case(name, "kernel") && has_any(name, kWhat) && has_any(name, kHow);
}

/// The name of a call that enqueues a kernel or hands it an argument: what all APIs, and the wrappers that projects
/// write around them, have in common are the words.
bool is_launch_name(std::string_view name) {
    constexpr std::array<std::string_view, 6> kStart = {"enqueue", "launch", "dispatch", "invoke", "execute", "run"};
    constexpr std::array<std::string_view, 4> kWork = {"kernel", "ndrange", "nd_range", "task"};
    constexpr std::array<std::string_view, 4> kGrid = {"compute", "cmd", "thread", "group"};
    if (is_argument_name(name)) return true;
    if (holds_in_any_case(name, "kernel")) return !holds_in_any_case(name, "arg") && has_any(name, kStart);
    if (holds_in_any_case(name, "enqueue")) return has_any(name, kWork);
    if (holds_in_any_case(name, "dispatch")) return has_any(name, kGrid);
    return name == "parallel_for" || name == "single_task" || name == "optixLaunch" ||
           holds_in_any_case(name, "cmdtracerays");
}

/// Methods that hand a kernel object its arguments; they say so only where the body speaks of kernels.
bool is_argument_method(std::string_view name) {
    constexpr std::array<std::string_view, 7> kNames = {"setArg", "setArgs", "set_arg", "set_args",
                                                        "addArg", "add_arg", "args"};
    return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

class TraitReader {
public:
    explicit TraitReader(const ScannedFile& file) : lexed_(file.lexed) {}

    BodyTraits read(const Unit& unit) {
        for (uint32_t i = unit.body.first; i < unit.body.end; ++i) {
            const Token& token = lexed_.tokens[i];
            if (token.flags & kDead) continue;
            if (token.kind == TokenKind::Identifier)
                read_word(i, unit.body.end);
            else if (token.kind == TokenKind::Punctuator && token.length == 1)
                read_sign(lexed_.text[token.offset], i, unit);
        }
        traits_.sets_arguments = traits_.sets_arguments || (takes_arguments_ && speaks_of_kernels(unit));
        traits_.launches = traits_.launches || traits_.sets_arguments;
        traits_.computes = traits_.stores || loops_ || operators_ > 0 || stars_ > 1;  // a star also makes a pointer
        traits_.acts = traits_.stores || loops_;
        traits_.works = traits_.stores || loops_ || operators_ + stars_ >= kMuch;
        return traits_;
    }

private:
    static constexpr uint32_t kMuch = 4;

    void read_word(uint32_t i, uint32_t end) {
        const std::string_view text = lexed_.view(i);
        if (text == "for" || text == "while") loops_ = true;
        if (i + 1 >= end || lexed_.view(i + 1) != "(") return;
        if (is_launch_name(text)) traits_.launches = true;
        if (is_argument_name(text)) traits_.sets_arguments = true;
        if ((text == "parallel_for" || text == "single_task") && takes_long_lambda(i + 1, end))
            traits_.holds_kernel = true;
        const std::string_view before = i > 0 ? lexed_.view(i - 1) : std::string_view();
        if ((before == "." || before == "->") && is_argument_method(text)) takes_arguments_ = true;
    }

    /// `(range, [=](item<1> i) { ... })` with more in its braces than a call of what works.
    bool takes_long_lambda(uint32_t open, uint32_t end) const {
        constexpr int kStatements = 2;
        int depth = 0, braces = 0, statements = 0;
        for (uint32_t i = open; i < end; ++i) {
            const std::string_view text = lexed_.view(i);
            if (text == "(") ++depth;
            if (text == ")" && --depth == 0) break;
            if (text == "{") ++braces;
            if (text == "}") --braces;
            if (text == ";" && braces > 0) ++statements;
        }
        return statements >= kStatements;
    }

    bool speaks_of_kernels(const Unit& unit) const {
        for (uint32_t i = unit.body.first; i < unit.body.end; ++i)
            if (lexed_.tokens[i].kind == TokenKind::Identifier && holds_in_any_case(lexed_.view(i), "kernel"))
                return true;
        return false;
    }

    void read_sign(char sign, uint32_t i, const Unit& unit) {
        if (sign == '<' && i + 2 < unit.body.end && touches(i, i + 1) && touches(i + 1, i + 2) &&
            lexed_.view(i + 1) == "<" && lexed_.view(i + 2) == "<")
            traits_.launches = true;  // kernel<<<grid, block>>>(...)
        if (sign == '+' || sign == '/' || sign == '^' || sign == '%' || sign == '?') ++operators_;
        if (sign == '*' && multiplies(i, unit)) ++stars_;
        if (sign == ']' && writes_after(i + 1, unit.body.end) && i > 0 &&
            lexed_.tokens[i - 1].kind != TokenKind::Number)
            traits_.stores = true;
        if (sign == ')' && i + 1 < unit.body.end && lexed_.view(i + 1) == "=" && stores_at_call(i, unit))
            traits_.stores = true;
    }

    /// No cast (`(Image *) p`), no pointer to a pointer, and no declaration (`; Image *p`).
    bool multiplies(uint32_t i, const Unit& unit) const {
        if (i < unit.body.first + 2 || i + 1 >= unit.body.end) return false;
        const std::string_view after = lexed_.view(i + 1), before = lexed_.view(i - 2);
        if (after == ")" || after == "*" || after == "," || after == ">") return false;
        return before != ";" && before != "{" && before != "}" && before != "const";
    }

    /// `PIXEL(x, y) = v`, `image.at(i) = v`: an index as a macro or a call has it.
    bool stores_at_call(uint32_t close, const Unit& unit) const {
        int depth = 0;
        for (uint32_t at = close; at > unit.body.first; --at) {
            const std::string_view text = lexed_.view(at);
            if (text == ")") ++depth;
            if (text == "(" && --depth == 0)
                return at + 1 < close && lexed_.tokens[at - 1].kind == TokenKind::Identifier;
            if (text == ";" || text == "{" || text == "}") return false;
        }
        return false;
    }

    bool touches(uint32_t a, uint32_t b) const {
        return lexed_.tokens[a].offset + lexed_.tokens[a].length == lexed_.tokens[b].offset;
    }

    /// True if an assignment follows that is no declaration's `sizes[n] = {...}`. `a[i].x = b` counts.
    bool writes_after(uint32_t at, uint32_t end) const {
        if (at + 2 < end && (lexed_.view(at) == "." || lexed_.view(at) == "->")) at += 2;
        if (at + 1 >= end) return false;
        std::string_view text = lexed_.view(at);
        if (text == "=") return lexed_.view(at + 1) != "{";
        return text.size() > 1 && text.size() <= 3 && text.back() == '=' && text != "==" && text != "!=" &&
               text != "<=" && text != ">=";
    }

    const LexedText& lexed_;
    BodyTraits traits_;
    bool loops_ = false, takes_arguments_ = false;
    uint32_t operators_ = 0, stars_ = 0;
};

}  // namespace

BodyTraits read_body_traits(const ScannedFile& file, const Unit& unit) { return TraitReader(file).read(unit); }

}  // namespace porttool
