// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/file_pragmas.h"

#include <algorithm>
#include <map>
#include <string>

#include "porttool/language/words.h"

namespace porttool {
namespace {

constexpr uint32_t kNoEnd = 0xFFFFFFFFu;

bool is_any(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

class PragmaReader {
public:
    PragmaReader(const LexedText& lexed, const std::vector<Unit>& units) : lexed_(lexed) {
        for (const Unit& unit : units)
            if (unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel) bodies_.push_back(unit.tokens);
        std::sort(bodies_.begin(), bodies_.end(), [](TokenRange a, TokenRange b) { return a.first < b.first; });
    }

    std::vector<FilePragma> run() {
        constexpr size_t kMost = 64;
        for (const Directive& directive : lexed_.directives) {
            if (out_.size() >= kMost) break;
            const uint32_t first = directive.first_token;
            if (word(directive, 1) != "pragma" || (lexed_.tokens[first].flags & kDead) != 0 || in_body(first)) continue;
            if (word(directive, 2) == "pack")
                read_pack(directive);
            else if (word(directive, 2) == "clang" && word(directive, 3) == "attribute")
                read_attribute(directive);
            else if (const std::string subject = arithmetic(directive); !subject.empty())
                read_arithmetic(directive, subject);
            else if (word(directive, 2) == "GCC" && is_any(word(directive, 3), {"pop_options", "reset_options"}))
                for (const char* each : {"GCC optimize", "GCC target"}) finish(each, first);
        }
        return std::move(out_);
    }

private:
    static constexpr const char* kPack = "pack";

    std::string_view word(const Directive& directive, uint32_t i) const {
        const uint32_t at = directive.first_token + i;
        return at < directive.end_token ? lexed_.view(at) : std::string_view();
    }

    bool in_body(uint32_t token) const {
        const auto after =
            std::partition_point(bodies_.begin(), bodies_.end(), [&](TokenRange body) { return body.first <= token; });
        return after != bodies_.begin() && token < (after - 1)->end;
    }

    /// What a pragma about arithmetic or the code that is made of it decides; "" for others.
    std::string arithmetic(const Directive& directive) const {
        const std::string_view first = word(directive, 2), second = word(directive, 3);
        if (is_any(first, {"float_control", "fp_contract", "fenv_access", "optimize"})) return std::string(first);
        const bool known = (is_any(first, {"STDC", "OPENCL"}) &&
                            is_any(second, {"FP_CONTRACT", "FENV_ACCESS", "FENV_ROUND", "CX_LIMITED_RANGE"})) ||
                           (first == "clang" && second == "fp") ||
                           (first == "GCC" && is_any(second, {"optimize", "target"}));
        return known ? std::string(first) + " " + std::string(second) : std::string();
    }

    void finish(const std::string& subject, uint32_t at) {
        const auto open = open_.find(subject);
        if (open == open_.end()) return;
        out_[open->second].end = at;
        open_.erase(open);
    }

    void begin(const std::string& subject, TokenRange tokens, uint32_t from) {
        finish(subject, from);
        open_[subject] = out_.size();
        out_.push_back({tokens, from, kNoEnd, subject == kPack});
    }

    void read_arithmetic(const Directive& directive, const std::string& subject) {
        begin(subject, {directive.first_token, directive.end_token}, directive.first_token);
    }

    /// `#pragma clang attribute push(__attribute__((weak)), apply_to = function)`, within each other
    void read_attribute(const Directive& directive) {
        const auto subject = [&] { return "clang attribute " + std::to_string(attributes_); };
        if (word(directive, 4) == "pop" && attributes_ > 0) {
            finish(subject(), directive.first_token);
            --attributes_;
        } else if (word(directive, 4) == "push") {
            ++attributes_;
            if (!is_idle_attribute(directive)) read_arithmetic(directive, subject());
        }
    }

    /// True if the attribute that it pushes only says how functions are linked or inlined, or what is warned of.
    bool is_idle_attribute(const Directive& directive) const {
        for (uint32_t i = 5; !word(directive, i).empty(); ++i) {
            const bool is_name = lexed_.tokens[directive.first_token + i].kind == TokenKind::Identifier;
            if (is_name && word(directive, i) != "__attribute__" && word(directive, i + 1) != "::")
                return word_is(word(directive, i), kIdleAttribute);
        }
        return false;
    }

    void read_pack(const Directive& directive) {
        const bool is_pop = word(directive, 4) == "pop", is_push = word(directive, 4) == "push";
        const auto open = open_.find(kPack);
        const TokenRange now = open == open_.end() ? TokenRange{} : out_[open->second].tokens;
        finish(kPack, directive.first_token);
        TokenRange next{directive.first_token, directive.end_token};
        if (is_push) packs_.push_back(now);
        if (is_push && word(directive, 5) == ")") next = now;
        if (is_pop && !packs_.empty()) {
            next = packs_.back();
            packs_.pop_back();
        } else if (is_pop || word(directive, 4) == ")") {
            next = {};
        }
        if (!next.empty()) begin(kPack, next, directive.first_token);
    }

    const LexedText& lexed_;
    std::vector<TokenRange> bodies_;
    std::vector<FilePragma> out_;
    std::map<std::string, size_t> open_;  ///< what holds, by what it is about
    std::vector<TokenRange> packs_;       ///< what a pop brings back
    size_t attributes_ = 0;               ///< pushed and not popped
};

}  // namespace

std::vector<FilePragma> read_file_pragmas(const LexedText& lexed, const std::vector<Unit>& units) {
    return PragmaReader(lexed, units).run();
}

void read_variable_pragmas(const LexedText& lexed, std::vector<FileVariable>& out) {
    for (const Directive& directive : lexed.directives) {
        const uint32_t first = directive.first_token;
        if (directive.end_token < first + 5 || lexed.view(first + 1) != "pragma" || lexed.view(first + 2) != "omp" ||
            lexed.view(first + 3) != "threadprivate" || (lexed.tokens[first].flags & kDead) != 0)
            continue;
        for (uint32_t at = first + 5; at < directive.end_token; ++at)
            if (lexed.tokens[at].kind == TokenKind::Identifier)
                out.push_back({at, {first, first + 4}, FileVariable::Says});
    }
}

}  // namespace porttool
