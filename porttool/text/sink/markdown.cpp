// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/sink/markdown.h"

#include <algorithm>

#include "porttool/text/letters.h"
#include "porttool/text/visible.h"

namespace porttool {
namespace {

bool is_alnum(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c < 0; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

size_t longest_run_of_backticks(std::string_view text) {
    size_t longest = 0, run = 0;
    for (const char c : text) {
        run = c == '`' ? run + 1 : 0;
        longest = std::max(longest, run);
    }
    return longest;
}

/// Text without bars as a code span. Its fence is longer than any run of backticks within.
std::string code_span(std::string_view text) {
    if (text.empty()) return {};
    const std::string fence(longest_run_of_backticks(text) + 1, '`');
    const bool has_edge = text.front() == '`' || text.back() == '`';
    const bool loses_blanks = text.front() == ' ' && text.back() == ' ' && text.find_first_not_of(' ') != text.npos;
    const char* blank = has_edge || loses_blanks ? " " : "";
    return fence + blank + std::string(text) + blank + fence;
}

/// Two code spans side by side would share their fences.
void add(std::string& out, const std::string& piece) {
    if (out.ends_with('`') && piece.starts_with('`')) out += ' ';
    out += piece;
}

std::string code_of(std::string_view text) {
    std::string out;
    while (true) {
        const size_t bar = text.find('|');
        out += code_span(text.substr(0, bar));
        if (bar == std::string_view::npos) return out;
        out += "\\|";
        text.remove_prefix(bar + 1);
    }
}

/// Whether a text begins with `lower`.
bool is_folded(std::string_view text, std::string_view lower) {
    return is_in_any_case(text.substr(0, lower.size()), lower);
}

/// `:name:`, an emoji where one has that name.
bool has_emoji_name(std::string_view word) {
    const auto is_name = [](char c) { return (is_alnum(c) && c > 0) || c == '_' || c == '+' || c == '-'; };
    for (size_t at = word.find(':'); at != std::string_view::npos; at = word.find(':', at + 1)) {
        size_t end = at + 1;
        while (end < word.size() && is_name(word[end])) ++end;
        const bool apart = (at == 0 || word[at - 1] != ':') && (end + 1 >= word.size() || word[end + 1] != ':');
        if (end > at + 1 && end < word.size() && word[end] == ':' && apart) return true;
    }
    return false;
}

/// GH-12, an issue of GitHub.
bool is_issue_key(std::string_view text) { return text.size() > 3 && is_folded(text, "gh-") && is_digit(text[3]); }

/// What forges link or draw in the text of a page, after its Markdown was read: there escapes are gone already.
bool acts_after_escaping(std::string_view word) {
    constexpr std::string_view kReferences = "!&~%^";  // before a number: merge requests, epics, labels, ...
    for (size_t i = 0; i < word.size(); ++i) {
        const char next = i + 1 < word.size() ? word[i + 1] : '\0';
        if (word[i] == '$' || (word[i] == '@' && (is_alnum(next) || next == '_'))) return true;
        const bool begins = i == 0 || !is_alnum(word[i - 1]);
        if (is_digit(next) && (word[i] == '#' || (begins && kReferences.find(word[i]) != std::string_view::npos)))
            return true;
        if (begins && is_issue_key(word.substr(i))) return true;
    }
    return word.find("://") != std::string_view::npos || holds_in_any_case(word, "www.") || has_emoji_name(word);
}

std::string escaped_word(std::string_view word) {
    constexpr std::string_view kSpecial = "\\`|<*_[]&~";
    std::string out;
    for (const char c : word) {
        if (kSpecial.find(c) != std::string_view::npos) out += '\\';
        out += c;
    }
    return out;
}

/// The pieces between blanks, each as `word_of` makes it, with the blanks between.
template <class WordOf>
std::string by_words(std::string_view text, const WordOf& word_of) {
    std::string out;
    while (true) {
        const size_t blank = text.find(' ');
        add(out, word_of(text.substr(0, blank)));
        if (blank == std::string_view::npos) return out;
        out += ' ';
        text.remove_prefix(blank + 1);
    }
}

std::string escaped_text(std::string_view text) {
    return by_words(
        text, [](std::string_view word) { return acts_after_escaping(word) ? code_of(word) : escaped_word(word); });
}

/// Takes a message apart into what stands between single backticks and the rest. A backtick that has no partner, and a
/// run of several, belong to the rest.
template <class CodeOf, class TextOf>
std::string by_spans(std::string_view message, const CodeOf& code, const TextOf& text) {
    std::string out;
    const auto single = [&](size_t at) {
        return (at == 0 || message[at - 1] != '`') && (at + 1 >= message.size() || message[at + 1] != '`');
    };
    size_t rest = 0;
    for (size_t open = message.find('`'); open != std::string_view::npos;) {
        const size_t close = message.find('`', open + 1);
        if (close == std::string_view::npos) break;
        if (!single(open) || !single(close) || close == open + 1) {
            open = close;
            continue;
        }
        add(out, text(message.substr(rest, open - rest)));
        add(out, code(message.substr(open + 1, close - open - 1)));
        rest = close + 1;
        open = message.find('`', rest);
    }
    add(out, text(message.substr(rest)));
    return out;
}

/// In a table a bar is escaped even in code.
std::string cell_code(std::string_view code) {
    std::string out = "`";
    for (const char c : code) {
        if (c == '|') out += '\\';
        out += c;
    }
    return out + "`";
}

/// Whether a word means more to Markdown than its letters.
bool acts(std::string_view word) {
    if (acts_after_escaping(word) || word.find('`') != std::string_view::npos) return true;
    const auto is_inner = [](char c) { return is_alnum(c) || c == '_'; };
    for (size_t i = 0; i < word.size(); ++i) {
        const char c = word[i], next = i + 1 < word.size() ? word[i + 1] : '\0';
        if (c == '<' && (is_alnum(next) || next == '/' || next == '!' || next == '?')) return true;
        if (c == '&' && (is_alnum(next) || next == '#')) return true;
        if (c == '[' || c == '~' || (c == '*' && word.size() > 1)) return true;
        if (c == '_' && (i == 0 || !is_inner(word[i - 1]) || !is_inner(next))) return true;
        if (c == '\\' && (next == '\0' || !is_alnum(next))) return true;
    }
    return false;
}

}  // namespace

std::string markdown_text(std::string_view text) { return escaped_text(visible(text)); }

std::string markdown_cell(std::string_view message) { return by_spans(visible(message), cell_code, escaped_text); }

std::string markdown_fence(std::string_view text) {
    constexpr size_t kLeast = 3;
    return std::string(std::max(longest_run_of_backticks(text) + 1, kLeast), '`');
}

std::string markdown_code(std::string_view text) { return code_of(visible(text)); }

std::string markdown_sentence(std::string_view message) {
    const std::string text = visible(message);
    bool first = true;  // a mark of a list, a heading, a quotation
    const auto code = [](std::string_view span) { return "`" + std::string(span) + "`"; };
    const auto words = [&](std::string_view part) {
        return by_words(part, [&](std::string_view word) {
            const bool is_mark = first && word.find_first_of("#>-+*=0123456789") == 0;
            first = false;
            return is_mark || acts(word) ? code_span(word) : std::string(word);
        });
    };
    return by_spans(std::string_view(text).substr(std::min(text.find_first_not_of(' '), text.size())), code, words);
}

}  // namespace porttool
