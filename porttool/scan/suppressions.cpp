// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/suppressions.h"

#include <algorithm>
#include <queue>

#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// Tells which units the comments of a file belong to. Each question costs little whatever the file holds, so that
/// thousands of comments in thousands of units are no burden: the lines are asked for in ascending order.
class OwnerFinder {
public:
    explicit OwnerFinder(const ScannedFile& file) : file_(file), owner_of_(file.lexed.tokens.size(), kNobody) {
        for (uint32_t unit = 0; unit < file.units.size(); ++unit) {
            claim(unit);
            by_start_.push_back(unit);
        }
        std::stable_sort(by_start_.begin(), by_start_.end(),
                         [&](uint32_t a, uint32_t b) { return start_of(a) < start_of(b); });
        find_comment_lines();
    }

    /// The units that a comment on `line` belongs to; `line` never falls from call to call.
    std::vector<uint32_t> owners(uint32_t line) {
        if (const auto [first, end] = tokens_on(line); first < end) return owners_of_tokens(first, end);
        const uint32_t next = line_after_comments(line);
        const auto less = [&](uint32_t unit, uint32_t at) { return start_of(unit) < at; };
        std::vector<uint32_t> out;
        for (auto at = std::lower_bound(by_start_.begin(), by_start_.end(), next, less);
             at != by_start_.end() && start_of(*at) == next; ++at)
            out.push_back(*at);
        if (out.empty())
            if (const uint32_t around = innermost_around(line); around != kNobody) out.push_back(around);
        return out;
    }

private:
    static constexpr uint32_t kNobody = 0xFFFFFFFFu;

    uint32_t start_of(uint32_t unit) const { return file_.units[unit].start_line; }

    /// Units never share a token.
    void claim(uint32_t index) {
        const Unit& unit = file_.units[index];
        size_t hole = 0;
        for (uint32_t at = unit.tokens.first; at < unit.tokens.end; ++at) {
            while (hole < unit.holes.size() && unit.holes[hole].end <= at) ++hole;
            if (hole < unit.holes.size() && unit.holes[hole].first <= at)
                at = unit.holes[hole].end - 1;
            else
                owner_of_[at] = index;
        }
    }

    void find_comment_lines() {
        std::vector<int32_t> change(file_.lines.size() + 2, 0);
        for (const LineSpan& comment : file_.lexed.comments) {
            if (comment.first > file_.lines.size()) continue;
            ++change[comment.first];
            --change[std::min<size_t>(comment.last, file_.lines.size()) + 1];
        }
        // From the last line up, so that each line knows where the comments that it begins end.
        after_.assign(file_.lines.size() + 2, 0);
        std::vector<bool> commented(file_.lines.size() + 2, false);
        int32_t depth = 0;
        for (size_t line = 1; line <= file_.lines.size(); ++line) commented[line] = (depth += change[line]) > 0;
        after_.back() = static_cast<uint32_t>(file_.lines.size()) + 1;
        std::vector<bool> coded(file_.lines.size() + 2, false);
        for (const Token& token : file_.lexed.tokens)
            if (token.line < coded.size()) coded[token.line] = true;
        for (size_t line = file_.lines.size(); line >= 1; --line)
            after_[line] = commented[line] && !coded[line] ? after_[line + 1] : static_cast<uint32_t>(line);
    }

    /// The first line after `line` that is no comment.
    uint32_t line_after_comments(uint32_t line) const { return after_[std::min<size_t>(line + 1, after_.size() - 1)]; }

    TokenRange tokens_on(uint32_t line) const {
        const std::vector<Token>& tokens = file_.lexed.tokens;
        const auto first = std::lower_bound(tokens.begin(), tokens.end(), line,
                                            [](const Token& token, uint32_t at) { return token.line < at; });
        const auto end = std::upper_bound(first, tokens.end(), line,
                                          [](uint32_t at, const Token& token) { return at < token.line; });
        return {static_cast<uint32_t>(first - tokens.begin()), static_cast<uint32_t>(end - tokens.begin())};
    }

    std::vector<uint32_t> owners_of_tokens(uint32_t first, uint32_t end) const {
        std::vector<uint32_t> out;
        for (uint32_t at = first; at < end; ++at)
            if (owner_of_[at] != kNobody && (out.empty() || out.back() != owner_of_[at])) out.push_back(owner_of_[at]);
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    }

    /// Of the units around a line the one that starts last.
    uint32_t innermost_around(uint32_t line) {
        for (; next_ < by_start_.size() && start_of(by_start_[next_]) <= line; ++next_) open_.push(next_);
        while (!open_.empty() && file_.units[by_start_[open_.top()]].end_line < line) open_.pop();
        return open_.empty() ? kNobody : by_start_[open_.top()];
    }

    const ScannedFile& file_;
    std::vector<uint32_t> owner_of_;    ///< of each token, the unit
    std::vector<uint32_t> by_start_;    ///< units by their first line
    std::vector<uint32_t> after_;       ///< of each line, itself or the first after the comments that begin there
    std::priority_queue<size_t> open_;  ///< places in by_start_ of units that may be around the line
    size_t next_ = 0;
};

}  // namespace

void read_suppressions(std::string_view comment, uint32_t line, std::vector<Suppression>& out) {
    constexpr std::string_view kMark = "porttool: ignore(";
    constexpr size_t kLongestRule = 128, kLongestReason = 1024;
    size_t counted = 0;
    for (size_t at = comment.find(kMark); at != std::string_view::npos; at = comment.find(kMark, at + 1)) {
        const std::string_view rule = comment.substr(at + kMark.size(), kLongestRule);
        const size_t close = rule.find(')');
        if (close == std::string_view::npos) continue;
        std::string_view reason = comment.substr(at + kMark.size() + close + 1, kLongestReason);
        reason = reason.substr(0, reason.find('\n'));
        if (const size_t end = reason.find("*/"); end != std::string_view::npos) reason = reason.substr(0, end);
        while (!reason.empty() && reason.front() == ' ') reason.remove_prefix(1);
        while (!reason.empty() && reason.back() == ' ') reason.remove_suffix(1);
        const std::string_view before = comment.substr(counted, at - counted);
        line += static_cast<uint32_t>(std::count(before.begin(), before.end(), '\n'));
        counted = at;
        out.push_back({std::string(rule.substr(0, close)), std::string(reason), line});
    }
}

void attach_suppressions(ScannedFile& file) {
    if (file.lexed.suppressions.empty()) return;
    OwnerFinder finder(file);
    uint32_t line = 0;
    std::shared_ptr<const std::vector<std::string>> units;  // one list for all comments of a line
    for (Suppression& comment : file.lexed.suppressions) {
        if (units == nullptr || comment.line != line) {
            std::vector<std::string> ids;
            for (const uint32_t unit : finder.owners(comment.line)) ids.push_back(unit_id(file, file.units[unit]));
            if (file.units.empty()) ids.push_back(unit_id(file, whole_file_unit(file)));
            units = std::make_shared<const std::vector<std::string>>(std::move(ids));
            line = comment.line;
        }
        comment.units = units;
    }
}

}  // namespace porttool
