// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/branches.h"

#include <algorithm>
#include <optional>

namespace porttool {
namespace {

/// How far a run of tokens opens and closes brackets, enough to join runs without reading them again.
struct Balance {
    int64_t depth = 0;   ///< net braces
    int64_t lowest = 0;  ///< lowest depth on the way
    int64_t parens = 0;
    int64_t lowest_parens = 0;

    void add(char c) {
        if (c == '{') ++depth;
        if (c == '}') lowest = std::min(lowest, --depth);
        if (c == '(') ++parens;
        if (c == ')') lowest_parens = std::min(lowest_parens, --parens);
    }
    void append(const Balance& next) {
        lowest = std::min(lowest, depth + next.lowest);
        depth += next.depth;
        lowest_parens = std::min(lowest_parens, parens + next.lowest_parens);
        parens += next.parens;
    }
    bool even() const { return depth == 0 && lowest == 0 && parens == 0 && lowest_parens == 0; }
};

struct Branch {
    uint32_t first_token = 0;
    uint32_t end_token = 0;
    uint32_t size = 0;  ///< tokens that count, without directives
    Balance balance;
    bool dead = false;
    bool ends_statement = true;
};

struct Range {
    uint32_t first;
    uint32_t end;
};

struct Group {
    std::vector<Branch> branches;
    std::vector<Range> directives;
    bool all_constant = true;    ///< every condition is a literal: the lines themselves are as good as comments
    bool mid_statement = false;  ///< opened in the middle of a statement
    bool true_branch_seen = false;
};

bool ends_statement(char c) { return c == ';' || c == '}' || c == '{'; }

/// The value of a condition that is one literal: `#if 0`, `#elif 1`.
std::optional<bool> constant_condition(const LexedText& lexed, const Directive& directive) {
    if (directive.end_token != directive.first_token + 3) return std::nullopt;
    const std::string_view keyword = lexed.view(directive.first_token + 1);
    if (keyword != "if" && keyword != "elif") return std::nullopt;
    const std::string_view value = lexed.view(directive.first_token + 2);
    if (value == "0" || value == "false") return false;
    if (value == "1" || value == "true") return true;
    return std::nullopt;
}

class BranchChooser {
public:
    explicit BranchChooser(LexedText& lexed) : lexed_(lexed) {}

    void run() {
        open_.push_back({{Branch{}}, {}});
        uint32_t token = 0;
        for (const Directive& directive : lexed_.directives) {
            read_tokens(token, directive.first_token);
            token = directive.end_token;
            read_directive(directive);
        }
        read_tokens(token, static_cast<uint32_t>(lexed_.tokens.size()));
        while (open_.size() > 1) close_group(static_cast<uint32_t>(lexed_.tokens.size()));
        flag(dead_, kDead);
        flag(off_, kOffStructure);
    }

private:
    Branch& current() { return open_.back().branches.back(); }

    void read_tokens(uint32_t first, uint32_t end) {
        Branch& branch = current();
        for (uint32_t i = first; i < end; ++i) {
            const Token& token = lexed_.tokens[i];
            ++branch.size;
            branch.ends_statement = false;
            if (token.kind != TokenKind::Punctuator) continue;
            const std::string_view text = lexed_.view(token);
            if (text.size() != 1) continue;
            branch.balance.add(text[0]);
            branch.ends_statement = ends_statement(text[0]);
        }
    }

    void read_directive(const Directive& directive) {
        switch (directive.kind) {
            case DirectiveKind::If: {
                Group group;
                group.mid_statement = !current().ends_statement;
                group.branches.push_back(new_branch(directive, group));
                open_.push_back(std::move(group));
                break;
            }
            case DirectiveKind::Elif:
            case DirectiveKind::Else:
                if (open_.size() < 2) break;  // one without its #if: reads as a plain line
                current().end_token = directive.first_token;
                open_.back().branches.push_back(new_branch(directive, open_.back()));
                break;
            case DirectiveKind::Endif:
                if (open_.size() < 2) break;
                open_.back().directives.push_back({directive.first_token, directive.end_token});
                close_group(directive.first_token);
                break;
            default:
                break;
        }
    }

    Branch new_branch(const Directive& directive, Group& group) {
        Branch branch;
        branch.first_token = directive.end_token;
        const auto value = constant_condition(lexed_, directive);
        group.directives.push_back({directive.first_token, directive.end_token});
        if (!value && directive.kind != DirectiveKind::Else) group.all_constant = false;
        branch.dead = group.true_branch_seen || value == false;
        if (value == true) group.true_branch_seen = true;
        return branch;
    }

    void close_group(uint32_t end_token) {
        Group group = std::move(open_.back());
        open_.pop_back();
        group.branches.back().end_token = end_token;
        if (group.all_constant) dead_.insert(dead_.end(), group.directives.begin(), group.directives.end());
        const std::vector<bool> kept = keep(group);
        Branch& parent = current();
        for (size_t i = 0; i < group.branches.size(); ++i) {
            const Branch& branch = group.branches[i];
            if (branch.dead) dead_.push_back({branch.first_token, branch.end_token});
            if (!kept[i] && !branch.dead) off_.push_back({branch.first_token, branch.end_token});
            if (!kept[i]) continue;
            parent.balance.append(branch.balance);
            parent.size += branch.size;
            if (branch.size > 0) parent.ends_statement = branch.ends_statement;
        }
    }

    static std::vector<bool> keep(const Group& group) {
        const auto& branches = group.branches;
        std::vector<bool> kept(branches.size(), false);
        const bool whole = std::all_of(branches.begin(), branches.end(), [&](const Branch& b) {
            return b.dead || b.size == 0 || (b.balance.even() && b.ends_statement && !group.mid_statement);
        });
        if (whole) {
            for (size_t i = 0; i < branches.size(); ++i) kept[i] = !branches[i].dead;
            return kept;
        }
        constexpr uint64_t kMuchLonger = 4;
        size_t best = branches.size();
        for (size_t i = 0; i < branches.size(); ++i) {
            if (branches[i].dead) continue;
            if (best == branches.size() || branches[i].size >= kMuchLonger * std::max(1u, branches[best].size))
                best = i;
        }
        if (best < branches.size()) kept[best] = true;
        return kept;
    }

    void flag(const std::vector<Range>& ranges, uint8_t bit) {
        if (ranges.empty()) return;
        std::vector<int32_t> change(lexed_.tokens.size() + 1, 0);
        for (const Range& range : ranges) {
            ++change[range.first];
            --change[std::max(range.first, range.end)];
        }
        int32_t depth = 0;
        for (size_t i = 0; i < lexed_.tokens.size(); ++i) {
            depth += change[i];
            if (depth > 0) lexed_.tokens[i].flags |= bit;
        }
    }

    LexedText& lexed_;
    std::vector<Group> open_;
    std::vector<Range> dead_, off_;
};

}  // namespace

void choose_branches(LexedText& lexed) { BranchChooser(lexed).run(); }

}  // namespace porttool
