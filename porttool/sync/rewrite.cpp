// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/rewrite.h"

#include <algorithm>
#include <map>

#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/block_depth.h"
#include "porttool/sync/port_text.h"

namespace porttool {
namespace {

class UnitRewriter : PortText {
public:
    UnitRewriter(const Transplant& transplant, const PlacedUnit& source, const PlacedUnit& target,
                 const std::string& indent)
        : UnitRewriter(transplant, source, target, indent, result_clauses(transplant, source, target)) {}
    std::vector<TextEdit> run() {
        for (const WordsReplaced& one : transplant_.replaced) {
            order_ = order_at(one.first);
            replace(one);
        }
        for (size_t batch = 0; batch < transplant_.added.size(); ++batch) {
            order_ = order_of_new_.at(transplant_.added[batch].clauses.front().source);
            add(transplant_.added[batch], depth_.of_new(batch));
        }
        order_ = 0;
        for (const size_t clause : transplant_.removed) remove(clause);
        indent_moved();
        for (const size_t head : braces_.opened) open_block(head);
        for (const size_t head : braces_.unopened) unopen_block(head);
        for (const size_t end : braces_.closed) close_block(end);
        for (const size_t end : braces_.dropped) remove(end);
        std::stable_sort(edits_.begin(), edits_.end(), [](const OrderedEdit& a, const OrderedEdit& b) {
            return std::pair(a.edit.first, a.order) < std::pair(b.edit.first, b.order);
        });
        return merged();
    }

private:
    UnitRewriter(const Transplant& transplant, const PlacedUnit& source, const PlacedUnit& target,
                 const std::string& indent, const std::vector<ResultClause>& result)
        : PortText(source, target, indent, block_braces(result, transplant, source, target)),
          transplant_(transplant),
          depth_(transplant, source, target),
          order_of_(target.clauses.size(), 0) {
        for (size_t at = 0; at < result.size(); ++at)
            if (result[at].is_new)
                order_of_new_[result[at].clause] = at;
            else
                order_of_[result[at].clause] = at;
    }

    /// An edit, and where its clause stands in the result: of edits of one place the earlier clause's comes first.
    struct OrderedEdit {
        TextEdit edit;
        size_t order = 0;
    };

    // Words within a clause.

    void replace(const WordsReplaced& one) {
        const size_t before = placed_before(one.first), after = placed_from(one.end);
        const std::string indent = indent_of_line(before == kNone ? after : before);
        std::string now = written(one.words, indent);
        if (one.first == one.end) return insert(one, before, after, now);
        const size_t first = placed_from(one.first), last = placed_before(one.end);
        if (first == kNone || last == kNone || last < first) return insert(one, before, after, now);
        if (now.empty()) return cut(before, first, last, after);
        now += trail_of(one, last, after);
        if (closes_up(one, before, first)) return put(end_of(before), end_of(last), now);
        put(start_of(first), end_of(last), lead_of(one, before, first) + now);
    }

    /// True where a comma comes in place of an operator that stood apart: `( y , x )` for `( y / x )` is `(y, x)`.
    bool closes_up(const WordsReplaced& one, size_t before, size_t first) const {
        if (before == kNone || one.words.front().text != "," || one.words.front().from != one.source_first)
            return false;
        const size_t end = end_of(before), start = start_of(first);
        return source_gap(one.source_first).empty() && start > end && text().text.find_first_not_of(' ', end) == start;
    }

    /// A name or number in place of another stands as that did.
    static bool is_value(const std::string& word) { return is_word_token(word) || is_number_token(word); }

    /// The blank before words that the source sets apart, where those that they take the place of stood close: `i += 1`
    /// for `i++`.
    std::string lead_of(const WordsReplaced& one, size_t before, size_t first) const {
        const bool is_tight = before != kNone && end_of(before) == start_of(first);
        const bool is_apart = one.words.front().from == one.source_first && !source_gap(one.source_first).empty();
        if (is_value(target_.words.words[one.first]) && is_value(one.words.front().text)) return "";
        return is_tight && is_apart && stand_apart(target_.words.words[before], one.words.front().text) ? " " : "";
    }

    /// The same blank behind them: `atan2(y, x)` for `atan(y/x)`.
    std::string trail_of(const WordsReplaced& one, size_t last, size_t after) const {
        const bool is_tight = after != kNone && end_of(last) == start_of(after);
        const bool is_apart = one.words.back().from == one.source_end - 1 && !source_gap(one.source_end).empty();
        if (is_value(target_.words.words[one.end - 1]) && is_value(one.words.back().text)) return "";
        return is_tight && is_apart && stand_apart(one.words.back().text, target_.words.words[after]) ? " " : "";
    }

    void insert(const WordsReplaced& one, size_t before, size_t after, const std::string& now) {
        const bool begins_clause = std::any_of(target_.clauses.begin(), target_.clauses.end(),
                                               [&](const Clause& clause) { return clause.first == one.first; });
        const bool beside_directive = after != kNone && target_.words.words[after] == "#";
        if (beside_directive && before != kNone && !now.empty()) return insert_line(before, now);
        if (begins_clause && after != kNone && !now.empty())
            return put(start_of(after), start_of(after), now + after_new(one, after));
        if (before == kNone || now.empty()) {
            if (after != kNone && !now.empty()) put(start_of(after), start_of(after), now + " ");
            return;
        }
        const std::string lead = before_new(one, before), trail = after_new(one, after);
        const size_t end = end_of(before);
        const size_t next = after == kNone ? end : start_of(after);
        const std::string between = text().text.substr(end, next > end ? next - end : 0);
        if (between.find('\n') != std::string::npos || between.find('/') != std::string::npos || after == kNone)
            return put(end, end, lead + now);
        put(end, next, lead + now + trail);
    }

    /// Words at the end of a line that a directive follows, on a line of their own.
    void insert_line(size_t before, const std::string& now) {
        const size_t eol = end_of_comments(end_of(before));
        put(eol, eol, "\n" + indent_of_line(before) + now);
    }

    std::string before_new(const WordsReplaced& one, size_t before) const {
        if (one.words.front().from == one.source_first && one.source_first < one.source_end) {
            const std::string& last = target_.words.words[before];
            if (is_bracketed(last, one.words.front().text))
                return stands_apart_there(last, one.words.front().text) ? " " : "";
            // Behind the port's own argument a new one stands as others do there, whatever the source has before it.
            const bool is_first_in_source =
                last == "," && one.source_first > 0 && source_.words.words[one.source_first - 1] != ",";
            if (is_first_in_source) return stands_apart_there(last, one.words.front().text) ? " " : "";
            const std::string there = source_gap(one.source_first);
            const std::string& first = one.words.front().text;
            if (!there.empty()) return first == "." || first == "->" || first == "::" || first == "[" ? "" : " ";
            return must_part(target_.words.words[before], one.words.front().text) ? " " : "";
        }
        return stand_apart(target_.words.words[before], one.words.front().text) ? " " : "";
    }
    std::string after_new(const WordsReplaced& one, size_t after) const {
        if (after == kNone) return {};
        const std::string& next = target_.words.words[after];
        if (one.words.back().from == one.source_end - 1 && one.source_end < source_.words.size()) {
            if (is_bracketed(one.words.back().text, next))
                return stands_apart_there(one.words.back().text, next) ? " " : "";
            const std::string there = source_gap(one.source_end);
            if (!there.empty()) return " ";
            return must_part(one.words.back().text, next) ? " " : "";
        }
        return stand_apart(one.words.back().text, next) ? " " : "";
    }

    /// Takes words away, and the white space on one side of them.
    void cut(size_t before, size_t first, size_t last, size_t after) {
        size_t from = start_of(first), to = end_of(last);
        if (before == kNone || after == kNone) return put(from, to, "");
        const bool line = starts_line(text(), from);
        const std::string rest = text().text.substr(to, start_of(after) - to);
        const bool plain = rest.find_first_not_of(" \t") == std::string::npos;
        if (plain && (line || stand_apart(target_.words.words[before], target_.words.words[after]) == false ||
                      text().text[from - 1] == ' ')) {
            to = start_of(after);
            if (!line && !stand_apart(target_.words.words[before], target_.words.words[after]))
                from -= blanks_before(text(), from).size();
        } else if (!line) {
            from -= blanks_before(text(), from).size();
        }
        put(from, to, "");
    }

    // Clauses.

    size_t clause_before(size_t word) const {
        size_t out = kNone;
        for (size_t c = 0; c < target_.clauses.size() && target_.clauses[c].end <= word; ++c) out = c;
        return out;
    }

    size_t parent_at(size_t clause) const {
        if (clause == kNone) return kNone;
        const Clause& one = target_.clauses[clause];
        return one.opens ? clause : one.inside;
    }

    /// The indentation of what stands in a block: as its other lines have it.
    std::string indent_in(size_t head) const {
        for (size_t c = 0; c < target_.clauses.size(); ++c) {
            const Clause& one = target_.clauses[c];
            if (one.inside != head || one.closes || removed(c)) continue;
            const size_t first = placed_from(one.first);
            if (first == kNone || first >= one.end || !starts_line(text(), start_of(first))) continue;
            const std::string_view word = target_.words.words[first];
            if (word == "#" || word == "case" || word == "default") continue;
            return std::string(blanks_before(text(), start_of(first)));
        }
        return head == kNone ? std::string() : indent_of_line(placed_from(target_.clauses[head].first)) + unit_;
    }

    bool removed(size_t clause) const {
        return std::find(transplant_.removed.begin(), transplant_.removed.end(), clause) != transplant_.removed.end();
    }

    /// True if the source begins this clause on a line of its own.
    bool on_own_line(size_t source_clause) const {
        size_t first = source_.clauses[source_clause].first;
        while (first < source_.words.size() && source_.words.is_added(first)) ++first;
        return source_gap(first).find('\n') != std::string::npos;
    }

    /// The same in the target: an `else` follows the manner of its braces.
    bool begins_line(size_t source_clause) const {
        const Clause& one = source_.clauses[source_clause];
        const bool after_brace = brace_layout_ != 0 && one.opens && source_.words.words[one.first] == "else" &&
                                 source_clause > 0 && !source_.words.is_added(one.first - 1);
        return after_brace ? brace_layout_ > 0 : on_own_line(source_clause);
    }

    size_t blank_lines_before(size_t source_clause) const {
        const std::string gap = source_gap(source_.clauses[source_clause].first);
        const size_t first = gap.find('\n');
        if (first == std::string::npos) return 0;
        const size_t next = gap.find_first_not_of(" \t", first + 1);
        return next != std::string::npos && gap[next] == '\n' ? 1 : 0;
    }

    void add(const ClausesAdded& one, int levels) {
        size_t before = clause_before(one.before);
        if (before == kNone) return;
        const size_t parent = parent_at(before);
        const size_t last = placed_before(one.before), next = placed_from(one.before);
        const bool before_else = comes_before_else(last, next);
        const std::string base = before_else       ? indent_of_line(last)
                                 : parent == kNone ? indent_of_line(placed_from(target_.clauses[before].first))
                                                   : indent_in(parent);
        std::string out;
        std::string indent = deeper(base, before_else ? 0 : levels);
        bool first = true, behind_wait = false;
        for (const ClauseAdded& clause : one.clauses) {
            const Clause& from = source_.clauses[clause.source];
            if (from.closes) indent = deeper(indent, depth_.step(clause.source));
            const std::string code = written(clause.words, indent);
            if (!code.empty()) {
                const bool own_line = begins_line(clause.source);
                const bool joins = first ? before_else : !own_line;
                if (joins)
                    out += " " + code;
                else if (first && from.closes)
                    out += "\n" + indent + code;
                else
                    out += (!behind_wait && (!first || blank_fits(before))
                                ? std::string(blank_lines_before(clause.source), '\n')
                                : "") +
                           "\n" + indent + code;
                first = false;
                behind_wait = clause.is_wait;
            }
            if (from.opens) indent = deeper(indent, depth_.step(clause.source));
        }
        if (last == kNone || out.empty()) return;
        const size_t end = end_of(last), eol = end_of_comments(end);
        if (before_else) return put(end, end, out);
        const bool breaks_line =
            std::find(braces_.opened.begin(), braces_.opened.end(), before) != braces_.opened.end() &&
            has_statement_beside(before);
        if (breaks_line) return put(end, end, out);
        if (next != kNone && start_of(next) < eol) return put(end, end, on_one_line(out));
        put(eol, eol, out);
    }

    /// True between the brace that ends a branch and the `else` behind it on its line.
    bool comes_before_else(size_t last, size_t next) const {
        return last != kNone && next != kNone && target_.words.words[last] == "}" &&
               target_.words.words[next] == "else" && start_of(next) < line_end(text(), end_of(last));
    }

    /// The end of the line, or of the line that a comment which begins on it ends on.
    size_t end_of_comments(size_t offset) const {
        const std::string& all = text().text;
        size_t eol = line_end(text(), offset);
        for (size_t at = offset; at < eol;) {
            const size_t open = all.find("/*", at);
            if (open >= eol || all.find("//", at) < open) break;
            const size_t close = all.find("*/", open + 2);
            if (close == std::string::npos) break;
            at = close + 2;
            eol = line_end(text(), at);
        }
        return eol;
    }

    /// Below the head of a block no blank line is wanted.
    bool blank_fits(size_t before) const { return !target_.clauses[before].opens; }

    static std::string on_one_line(const std::string& text) {
        std::string out;
        for (const char c : text) {
            if (c == '\n' || c == '\t' || c == ' ') {
                if (out.empty() || out.back() != ' ') out += ' ';
            } else {
                out += c;
            }
        }
        return out;
    }

    void remove(size_t clause) {
        const Clause& one = target_.clauses[clause];
        const size_t first = placed_from(one.first), last = placed_before(one.end);
        if (first == kNone || last == kNone || first >= one.end || last < one.first) return;
        size_t from = start_of(first), to = end_of(last);
        const size_t eol = line_end(text(), to);
        const std::string rest = text().text.substr(to, eol - to);
        const size_t code = rest.find_first_not_of(" \t");
        const bool ends_line = code == std::string::npos || rest.compare(code, 2, "//") == 0;
        if (starts_line(text(), from) && ends_line) {
            from -= blanks_before(text(), from).size();
            to = std::min(eol + 1, text().text.size());
            const bool blank_above = from >= 2 && text().text[from - 1] == '\n' && text().text[from - 2] == '\n';
            const bool blank_below = to < text().text.size() && text().text[to] == '\n';
            if (blank_above && blank_below) ++to;
        } else if (code != std::string::npos || starts_line(text(), from)) {
            while (to < eol && text().text[to] == ' ') ++to;
        } else {
            from -= blanks_before(text(), from).size();
        }
        put(from, to, "");
    }

    /// Clauses that stand deeper or less deep than before are indented so.
    void indent_moved() {
        for (size_t c = 0; c < target_.clauses.size(); ++c)
            if (!removed(c) && depth_.of_clause(c) != 0) indent(target_.clauses[c], depth_.of_clause(c));
    }

    /// An indentation, some levels deeper or (negative) less deep.
    std::string deeper(std::string indent, int levels) const {
        for (; levels > 0; --levels) indent += unit_;
        const size_t less = unit_.size() * static_cast<size_t>(-levels);
        return indent.substr(0, indent.size() - std::min(indent.size(), less));
    }

    void indent(const Clause& clause, int levels) {
        size_t last_line = 0;
        for (size_t i = clause.first; i < clause.end; ++i) {
            if (is_added(i) || token(i).line == last_line) continue;
            last_line = token(i).line;
            const size_t at = start_of(i);
            if (!starts_line(text(), at) || target_.words.words[i] == "#") continue;
            if (levels > 0) {
                std::string more;
                for (int k = 0; k < levels; ++k) more += unit_;
                put(at, at, more);
            } else {
                const size_t blanks =
                    std::min(blanks_before(text(), at).size(), unit_.size() * static_cast<size_t>(-levels));
                put(at - blanks, at, "");
            }
        }
    }

    /// The indentation of the line that a clause of the target begins on, as it will be.
    std::string new_indent(size_t clause) const {
        return deeper(indent_of_line(placed_from(target_.clauses[clause].first)), depth_.of_clause(clause));
    }

    void open_block(size_t head) {
        order_ = order_of_[head];
        const size_t last = placed_before(target_.clauses[head].end);
        if (last == kNone) return;
        put(end_of(last), end_of(last), brace_layout_ > 0 ? "\n" + new_indent(head) + "{" : " {");
        if (!has_statement_beside(head)) return;
        order_ = order_of_[head + 1];
        const size_t inner = placed_from(target_.clauses[head + 1].first);
        put(end_of(last), start_of(inner), "\n" + deeper(indent_of_line(inner), depth_.of_clause(head + 1) + 1));
    }

    /// True for a head with its one statement behind it on a line: that goes to one of its own where a brace comes.
    bool has_statement_beside(size_t head) const {
        if (head + 1 >= target_.clauses.size() || target_.clauses[head + 1].opens || removed(head + 1)) return false;
        const Clause& one = target_.clauses[head + 1];
        const size_t last = placed_before(target_.clauses[head].end), first = placed_from(one.first),
                     end = placed_before(one.end), next = placed_from(one.end);
        if (last == kNone || first == kNone || end == kNone || first >= one.end) return false;
        return start_of(first) < line_end(text(), end_of(last)) &&
               (next == kNone || start_of(next) > line_end(text(), end_of(end)));
    }

    void unopen_block(size_t head) {
        const size_t brace = target_.clauses[head].end - 1, last = placed_before(brace);
        if (last != kNone && !is_added(brace)) put(end_of(last), end_of(brace), "");
    }

    void close_block(size_t end) {
        order_ = order_of_[end];
        const size_t inner = placed_before(target_.clauses[end].first), head = target_.clauses[end].partner;
        if (inner == kNone || head == kNone) return;
        const size_t eol = end_of_comments(end_of(inner)), next = placed_from(target_.clauses[end].first);
        const bool shares_line = next != kNone && start_of(next) < eol;
        const size_t place = shares_line ? end_of(inner) : eol;
        put(place, place, shares_line ? " }" : "\n" + new_indent(head) + "}");
    }

    void put(size_t first, size_t end, std::string text) {
        if (first == end && text.empty()) return;
        edits_.push_back({{first, end, std::move(text)}, order_});
    }

    /// Where the clause that holds a word of the target stands in the result.
    size_t order_at(size_t word) const {
        for (size_t c = 0; c < target_.clauses.size(); ++c)
            if (word < target_.clauses[c].end) return order_of_[c];
        return kNone;
    }

    /// True for an edit that takes whole lines away.
    bool takes_lines(const TextEdit& edit) const {
        return edit.text.empty() && edit.end > edit.first && text().text[edit.end - 1] == '\n' &&
               (edit.first == 0 || text().text[edit.first - 1] == '\n');
    }

    /// Edits of places that touch become one. Lines that come where others go take their place.
    std::vector<TextEdit> merged() {
        std::vector<TextEdit> out;
        bool lines = false;
        for (auto& [edit, order] : edits_) {
            if (!out.empty() && edit.first < out.back().end) {
                out.back().end = std::max(out.back().end, edit.end);
                const bool begins_line = lines && edit.first == edit.end && edit.text.starts_with('\n');
                out.back().text += begins_line ? edit.text.substr(1) + "\n" : edit.text;
            } else {
                lines = takes_lines(edit);
                out.push_back(std::move(edit));
            }
        }
        return out;
    }

    const Transplant& transplant_;
    BlockDepth depth_;
    std::vector<size_t> order_of_;           ///< of each clause of the target, where it stands in the result
    std::map<size_t, size_t> order_of_new_;  ///< of each clause of the source that the target gets
    size_t order_ = 0;                       ///< of the edits that are being made
    std::vector<OrderedEdit> edits_;
};

}  // namespace

std::vector<TextEdit> rewrite_unit(const Transplant& transplant, const PlacedUnit& source, const PlacedUnit& target,
                                   const std::string& indent) {
    return UnitRewriter(transplant, source, target, indent).run();
}

std::string with_edits(std::string_view text, const std::vector<TextEdit>& edits) {
    std::string out;
    size_t at = 0;
    for (const TextEdit& edit : edits) {
        out += text.substr(at, edit.first - at);
        out += edit.text;
        at = edit.end;
    }
    out += text.substr(at);
    return out;
}

}  // namespace porttool
