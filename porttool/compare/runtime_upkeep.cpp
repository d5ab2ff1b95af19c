// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/runtime_upkeep.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/compare/runtime_calls.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

std::vector<Statement> statements_of(const Words& text) {
    return split_statements(
        text, [](const Words& words, bool) { return std::vector<std::string>(words.begin(), words.end()); });
}

/// True for a function of a runtime that neither moves data nor launches nor waits.
bool is_upkeep_call(std::string_view name) {
    if (!is_runtime_call(name)) return false;
    for (const std::string_view part : {"memcpy", "memset", "copy", "fill", "write", "read", "launch", "enqueue",
                                        "sync", "wait", "finish", "barrier", "kernelarg", "cmd", "submit", "gemm"})
        if (holds_in_any_case(name, part)) return false;
    return true;
}

/// `cudaStream_t s`, `VkBuffer b`.
bool declares_runtime_object(const std::vector<std::string>& words) {
    return words.size() >= 2 && (is_runtime_call(words[0]) || words[0].starts_with("cl_")) && is_word_token(words[1]) &&
           std::find(words.begin(), words.end(), "(") == words.end();
}

/// True for a statement that calls a runtime, at least once, and nothing else. What such a call gives may be kept, not
/// reckoned with.
bool is_upkeep(const std::vector<std::string>& words) {
    if (words.empty() || declares_runtime_object(words)) return !words.empty();
    size_t calls = 0;
    for (size_t i = 0; i < words.size(); ++i) {
        if (is_one_of(words[i], {"return", "goto", "break", "continue", "throw", "#", "++", "--", "<<", ">>"}))
            return false;
        if (i + 1 == words.size() || words[i + 1] != "(" || !is_word_token(words[i])) continue;
        if (words[i] == "sizeof" || says_that_it_checks(words[i]) || is_type_word(words[i])) continue;
        if (!is_upkeep_call(words[i])) return false;
        ++calls;
    }
    const auto writes = [&](const std::string& sign) {
        return sign.size() == 2 && sign[1] == '=' && !is_one_of(sign, {"==", "!=", "<=", ">="});
    };
    return calls > 0 && std::none_of(words.begin(), words.end(), writes);
}

/// True for a macro that does nothing but check: `CHECK_INPUT`, `KERNEL_LAUNCH_CHECK`.
bool is_check_macro(std::string_view name) {
    if (std::any_of(name.begin(), name.end(), is_small_letter)) return false;
    return name == "CHECK" || name.starts_with("CHECK_") || name.ends_with("_CHECK") ||
           name.find("_CHECK_") != std::string_view::npos;
}

/// True for a function that only waits, or asks how a device fared, or for the stream that is used.
bool is_of_driving(std::string_view name) {
    for (const std::string_view memory : {"alloc", "free", "release"})
        if (holds_in_any_case(name, memory)) return false;
    if (is_upkeep_call(name)) return true;
    if (is_runtime_call(name)) return holds_in_any_case(name, "synchronize") || holds_in_any_case(name, "finish");
    const bool of_device = holds_in_any_case(name, "cuda") || holds_in_any_case(name, "hip");
    return of_device && (holds_in_any_case(name, "stream") || holds_in_any_case(name, "guard"));
}

/// A statement that does nothing but drive a device, or, with `checks`, check. A check by another name, around what
/// drives one, is one, too.
bool drives_alone(const std::vector<std::string>& words, bool checks) {
    if (words.empty() || declares_runtime_object(words)) return !words.empty();
    bool any = false;
    for (size_t i = 0; i < words.size(); ++i) {
        if (is_one_of(words[i],
                      {"return", "goto", "break", "continue", "throw", "#", "++", "--", "<<", ">>", "+=", "-="}))
            return false;
        if (i + 1 == words.size() || words[i + 1] != "(" || !is_word_token(words[i])) continue;
        if (words[i] == "sizeof" || is_type_word(words[i])) continue;
        if (any && holds_in_any_case(words[i], "device") && !holds_in_any_case(words[i], "copy")) continue;
        const bool wraps_driver =
            i == 0 && says_that_it_checks(words[i]) && words.size() > 3 && words[3] == "(" && is_of_driving(words[2]);
        const bool is_declared = i > 0 && is_word_token(words[i - 1]);
        if (!wraps_driver && !is_of_driving(is_declared ? words[i - 1] : words[i]) &&
            !(checks && is_check_macro(words[i])))
            return false;
        any = true;
    }
    return any;
}

/// A text whose launches say neither how much memory their blocks have nor in which stream they run.
Words without_streams(const Words& text) {
    Words out;
    for (size_t i = 0; i < text.size(); ++i) {
        out.push_back(text[i]);
        if (!opens_launch(text, i)) continue;
        out.insert(out.end(), {"<", "<"});
        size_t commas = 0;
        int depth = 0;
        for (i += 3; i < text.size() && !is_one_of(text[i], {";", "{", "}"}); ++i) {
            if (depth == 0 && text[i] == ">" && i + 2 < text.size() && text[i + 1] == ">" && text[i + 2] == ">") break;
            depth += is_one_of(text[i], {"(", "["}) ? 1 : is_one_of(text[i], {")", "]"}) ? -1 : 0;
            if (depth == 0 && text[i] == ",") ++commas;
            if (commas < 2) out.push_back(text[i]);
        }
        if (i < text.size()) out.push_back(text[i]);
    }
    return out;
}

/// One text's statements, of which some are not in the other.
struct EditedText {
    std::vector<Statement> statements;
    std::vector<bool> is_edited, heads;

    explicit EditedText(const Words& text) : statements(statements_of(text)) {
        is_edited.assign(statements.size(), false);
        heads.assign(statements.size(), false);
        for (const Statement& one : statements)
            if (one.head < statements.size()) heads[one.head] = true;
    }

    std::vector<std::string> keys() const {
        std::vector<std::string> out;
        for (const Statement& one : statements) out.push_back(one.key);
        return out;
    }

    bool is_edited_at_all() const { return std::find(is_edited.begin(), is_edited.end(), true) != is_edited.end(); }

    /// True if every statement that came or went does nothing but drive a device.
    bool only_drives(bool checks) const {
        for (size_t i = 0; i < statements.size(); ++i)
            if (is_edited[i] && (heads[i] || statements[i].is_brace() || !drives_alone(statements[i].common, checks)))
                return false;
        return true;
    }

    /// A head counts with what stands in its block; that must all have come or gone with it.
    bool only_upkeep() const {
        for (size_t i = 0; i < statements.size(); ++i) {
            const Statement& one = statements[i];
            const bool in_block = one.head < statements.size() && i != one.head;
            if (in_block && is_edited[one.head] && !is_edited[i]) return false;
            if (!is_edited[i]) continue;
            if (one.is_brace() ? !(in_block && is_edited[one.head]) : !is_fit(i)) return false;
        }
        return true;
    }

private:
    bool is_fit(size_t i) const {
        const std::vector<std::string>& words = statements[i].common;
        if (!heads[i]) return is_upkeep(words);
        const bool asks = !words.empty() && is_one_of(words[0], {"if", "else"});
        return asks && (std::find(words.begin(), words.end(), "(") == words.end() || is_question(words));
    }

    /// A condition that changes nothing.
    static bool is_question(const std::vector<std::string>& words) {
        for (size_t i = 0; i + 1 < words.size(); ++i) {
            if (is_one_of(words[i], {"=", "++", "--"})) return false;
            const bool calls = words[i + 1] == "(" && is_word_token(words[i]) && words[i] != "if";
            if (calls && !says_that_it_checks(words[i]) && !is_upkeep_call(words[i])) return false;
        }
        return true;
    }
};

struct EditedTexts {
    EditedText then, today;

    EditedTexts(const Words& before, const Words& now) : then(before), today(now) {
        for (const DiffStep& step : diff(then.keys(), today.keys())) {
            if (step.kind == DiffStep::Remove) then.is_edited[step.before] = true;
            if (step.kind == DiffStep::Add) today.is_edited[step.now] = true;
        }
    }
};

/// A text without waiting for a runtime, and how often it does.
struct WithoutWaits {
    Words words;
    size_t waits = 0;

    explicit WithoutWaits(const Words& text) {
        for (size_t i = 0; i < text.size();) {
            const size_t end = end_of_wait(text, i);
            if (end == i) {
                words.push_back(text[i++]);
                continue;
            }
            ++waits;
            const bool is_all = text[i] == "." && end < text.size() && text[end] == ";" && words.size() >= 2 &&
                                starts_statement(words, words.size() - 1);
            if (is_all) words.pop_back();  // `q . wait ( ) ;`
            i = end + (is_all ? 1 : 0);
        }
    }

private:
    static bool starts_statement(const Words& text, size_t i) {
        return is_word_token(text[i]) && i > 0 && is_one_of(text[i - 1], {";", "{", "}"});
    }

    /// Behind `. wait ( )`, or a statement that calls a function which waits; `i` where none begins there.
    static size_t end_of_wait(const Words& text, size_t i) {
        const auto at = [&](size_t k) { return k < text.size() ? text[k] : std::string_view(); };
        if (at(i) == "." && is_one_of(at(i + 1), {"wait", "wait_and_throw"}) && at(i + 2) == "(" && at(i + 3) == ")")
            return i + 4;
        if (i >= text.size() || !starts_statement(text, i) || !is_runtime_call(text[i]) || at(i + 1) != "(") return i;
        const bool waits = holds_in_any_case(text[i], "synchronize") || holds_in_any_case(text[i], "finish");
        const bool is_bare = at(i + 2) == ")" || at(i + 3) == ")";
        const size_t end = i + (at(i + 2) == ")" ? 3 : 4);
        return waits && is_bare && at(end) == ";" ? end + 1 : i;
    }
};

}  // namespace

bool only_waits_more(const Words& before, const Words& now) {
    const WithoutWaits then(before), today(now);
    return today.waits > then.waits && then.words == today.words;
}

bool only_tends_runtime(const Words& before, const Words& now) {
    const EditedTexts texts(before, now);
    return texts.then.only_upkeep() && texts.today.only_upkeep();
}

bool only_drives_device(const Words& before, const Words& now, bool streams) {
    const EditedTexts texts(streams ? without_streams(before) : before, streams ? without_streams(now) : now);
    // One check in the place of another may ask for something else.
    const bool checks = texts.then.is_edited_at_all() != texts.today.is_edited_at_all();
    return texts.then.only_drives(checks) && texts.today.only_drives(checks);
}

bool may_drive_device(const Words& text) {
    ContextNames contexts;
    note_contexts(text, contexts);
    if (!contexts.empty() || drives_device(text)) return true;
    for (size_t i = 1; i < text.size(); ++i)
        if (is_one_of(text[i - 1], {".", "->"}) &&
            is_one_of(text[i], {"wait", "wait_and_throw", "finish", "memcpy", "memset", "single_task", "enqueue"}))
            return true;
    return false;
}

bool only_tends_foreign_runtime(const Words& before, const Words& now, const Words& other) {
    const auto calls_one = [&](size_t i) { return other[i + 1] == "(" && is_runtime_call(other[i]); };
    for (size_t i = 0; i + 1 < other.size(); ++i)
        if (calls_one(i)) return false;
    const EditedTexts texts(before, now);
    return texts.then.is_edited_at_all() != texts.today.is_edited_at_all() && texts.then.only_upkeep() &&
           texts.today.only_upkeep();
}

}  // namespace porttool
