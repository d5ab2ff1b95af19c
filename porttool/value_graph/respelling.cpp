// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/value_graph/respelling.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/normal_text.h"

namespace porttool {
namespace {

using Text = Machine::Text;

constexpr size_t kMostStatements = 2'000;  // of a function
constexpr size_t kMostWordsOfStatement = 400;

bool is_null(std::string_view word) { return is_one_of(word, {"NULL", "nullptr"}); }

/// The names of a statement, without those that a respelling brings or takes, `NULL` and `while`, and its numbers.
struct NamesAndNumbers {
    std::set<std::string_view> names;
    std::set<std::string_view> reals;
    std::set<std::string> wholes;  ///< by their values

    explicit NamesAndNumbers(const Text& words) {
        for (const std::string& word : words) {
            if (is_number_token(word)) {
                const bool is_real = word.find_first_of(".fh") != std::string::npos && !word.starts_with("0x");
                if (is_real)
                    reals.insert(word);
                else
                    wholes.insert(number_value(word));
            } else if ((is_word_token(word) || local_of(word) != 0) && !is_null(word) &&
                       !is_one_of(word, {"while", "for"})) {
                names.insert(word);
            }
        }
    }

    /// True if each real number that this one has and the other has not stands for a whole one there: `0.0f` for `0`.
    /// Whole numbers come and go but for that as 0 and 1 may.
    bool may_say(const NamesAndNumbers& other) const {
        if (names != other.names) return false;
        return std::all_of(reals.begin(), reals.end(),
                           [&](std::string_view real) {
                               return other.reals.contains(real) || other.wholes.contains(number_value(real));
                           }) &&
               std::all_of(wholes.begin(), wholes.end(), [&](const std::string& whole) {
                   return other.wholes.contains(whole) || is_one_of(whole, {"0", "1"}) || other.has_real_of(whole);
               });
    }

private:
    bool has_real_of(const std::string& whole) const {
        return std::any_of(reals.begin(), reals.end(),
                           [&](std::string_view real) { return number_value(real) == whole; });
    }
};

/// A stretch of a statement's words.
using Part = std::pair<size_t, size_t>;

/// What stands between the semicolons of `for ( ... )`.
std::vector<Part> parts_of_for(const Text& words) {
    std::vector<Part> out;
    size_t first = 2;
    int depth = 0;
    for (size_t i = 1; i < words.size(); ++i) {
        depth += is_one_of(words[i], {"(", "[", "{"}) ? 1 : is_one_of(words[i], {")", "]", "}"}) ? -1 : 0;
        const bool ends = depth == 0 || (depth == 1 && words[i] == ";");
        if (!ends) continue;
        out.emplace_back(first, i);
        first = i + 1;
        if (depth == 0 && i + 1 != words.size()) throw Unread();
    }
    return out;
}

/// One of the two texts, read statement by statement with nothing known of what its locals hold.
class Reading {
public:
    Reading(ValueTable& table, const ReadingManner& manner) : table_(table), machine_(table, manner) {}

    void read_head(const Text& words) {
        const auto name = static_cast<size_t>(std::find(words.begin(), words.end(), "@") - words.begin());
        if (name + 2 >= words.size() || words[name + 1] != "(") return;
        if (name > 0 && is_word_token(words[name - 1])) result_ = words[name - 1];
        int depth = 0;
        size_t first = name + 2;
        for (size_t i = name + 1; i < words.size(); ++i) {
            depth += is_one_of(words[i], {"(", "[", "<", "{"}) ? 1 : is_one_of(words[i], {")", "]", ">", "}"}) ? -1 : 0;
            const bool ends = depth == 0 || (depth == 1 && words[i] == ",");
            if (ends) declare_parameter(words, {first, i});
            if (depth == 0) return;
            if (ends) first = i + 1;
        }
    }

    /// Notes what a statement declares that need not be compared.
    void pass(const Text& words) {
        try {
            run(words);
        } catch (const Unread&) {
        }
    }

    /// All that a statement does, as one value. Throws Unread.
    Value run(const Text& words) {
        if (words.empty() || words.size() > kMostWordsOfStatement) throw Unread();
        const std::string& word = words[0];
        if (is_one_of(word, {"#", "else", "do", "case", "default", "@"})) throw Unread();
        if (word == "return")
            return words.size() == 1 ? table_.node("nothing") : value_of(words, {1, words.size()}, result_);
        if (is_one_of(word, {"if", "while"})) {
            if (words.size() < 4 || words[1] != "(" || words.back() != ")") throw Unread();
            const Value held = condition_of(words, {2, words.size() - 1}), nothing = table_.node("nothing");
            return word == "if" ? table_.node("if", {held}) : table_.node("for", {nothing, held, nothing});
        }
        if (word == "for") {
            const std::vector<Part> parts = parts_of_for(words);
            if (parts.size() != 3) throw Unread();
            const Value first = done_by(words, parts[0]), held = condition_of(words, parts[1]);
            return table_.node("for", {first, held, done_by(words, parts[2])});
        }
        return done_by(words, {0, words.size()});
    }

private:
    /// Of a parameter that is not read nothing is known, and of no statement with it.
    void declare_parameter(const Text& words, Part part) {
        MachineState state;
        try {
            machine_.declare_parameters(words, part.first, part.second, state);
        } catch (const Unread&) {
            return;
        }
        note_locals(state);
    }

    void note_locals(const MachineState& state) {
        for (const auto& [local, value] : state.locals) {
            const LocalKind& kind = machine_.kind(local);
            const std::string type = kind.cell ? kind.type + "*" : kind.array ? "" : kind.type;
            locals_.emplace(local, table_.node("local " + std::to_string(local), {}, type));
        }
    }

    /// A state in which a local holds what nobody knows.
    MachineState unknown() const {
        MachineState out;
        out.world = table_.node("world");
        out.locals = locals_;
        return out;
    }

    /// A value as a `type`, where that is a number's.
    Value value_of(const Text& words, Part part, std::string_view type) {
        MachineState state = unknown();
        Value value = machine_.value_of(words, part.first, part.second, state);
        if (is_scalar_type(type) && is_scalar_type(table_.type(value))) value = table_.converted(value, type);
        return table_.node("value", {value, all_of(state)});
    }

    Value condition_of(const Text& words, Part part) {
        if (part.first == part.second) return table_.node("always");
        MachineState state = unknown();
        const Value value = machine_.value_of(words, part.first, part.second, state);
        return table_.node("condition", {truth_of(value), all_of(state)});
    }

    /// A value as a condition takes it: `p != NULL` is `p`, `n == 0` is `! n`.
    Value truth_of(Value value) {
        const std::string_view operation = table_.operation(value);
        const std::vector<Value>& parts = table_.parts(value);
        if (operation == "!") return negated(truth_of(parts[0]));
        if (operation == "&&" || operation == "||")
            return table_.node(operation, {truth_of(parts[0]), truth_of(parts[1])});
        if ((operation == "==" || operation == "!=") && parts.size() == 2)
            for (const size_t at : {size_t{0}, size_t{1}}) {
                if (!is_nothing(parts[at], parts[1 - at])) continue;
                const Value other = table_.node("is", {parts[1 - at]});
                return operation == "!=" ? other : negated(other);
            }
        return table_.node("is", {value});
    }

    Value negated(Value truth) {
        return table_.operation(truth) == "!" ? table_.parts(truth)[0] : table_.node("!", {truth});
    }

    /// True for a null pointer, and for the number 0 that a number or a pointer is compared with.
    bool is_nothing(Value value, Value other) const {
        const std::string_view operation = table_.operation(value);
        const std::string_view type = table_.type(other);
        if (operation == "load")
            return is_null(table_.operation(table_.parts(value)[1])) && (type.empty() || is_pointer(type));
        const bool zero = operation == "number" && table_.operation(table_.parts(value)[0]) == "0";
        return zero && (is_scalar_type(type) || is_pointer(type));
    }

    Value done_by(const Text& words, Part part) {
        if (part.first == part.second) return table_.node("nothing");
        MachineState state = unknown();
        machine_.run_plain(words, part.first, part.second, state);
        note_locals(state);
        return all_of(state);
    }

    /// What a state is, with what kind of thing each local is.
    Value all_of(const MachineState& state) {
        std::vector<Value> parts = {state.world};
        for (const auto& [local, value] : state.locals) {
            const LocalKind& kind = machine_.kind(local);
            const std::string shape = kind.cell ? "reference" : kind.array ? "array" : "";
            parts.insert(parts.end(), {table_.node(std::to_string(local) + shape, {}, kind.type), value});
        }
        return table_.node("all", std::move(parts));
    }

    ValueTable& table_;
    Machine machine_;
    std::string result_;              ///< the type of what is given back
    std::map<size_t, Value> locals_;  ///< that were declared: what each holds, or where it is
};

bool same_words(const Statement& one, const Statement& other) { return one.key == other.key; }

/// A function's head in which a parameter `float a [ ]` is `float * a`. Of ISPC's words each binds to its own.
Text with_pointers(const Text& head) {
    if (std::any_of(head.begin(), head.end(), [](const auto& word) { return is_one_of(word, {"uniform", "varying"}); }))
        return head;
    Text out;
    for (size_t i = 0; i < head.size(); ++i) {
        const bool is_array = i + 3 < head.size() && local_of(head[i]) != 0 && head[i + 1] == "[" &&
                              head[i + 2] == "]" && is_one_of(head[i + 3], {",", ")"});
        if (is_array) out.emplace_back("*");
        out.push_back(head[i]);
        i += is_array ? 2 : 0;
    }
    return out;
}

}  // namespace

bool are_respelled(const ReadFunction& one, const ReadFunction& other) {
    const std::vector<Statement>&here = one.statements, &there = other.statements;
    if (here.size() != there.size() || here.empty() || here.size() > kMostStatements) return false;
    for (size_t i = 0; i < here.size(); ++i)
        if (here[i].head != there[i].head || here[i].is_brace() != there[i].is_brace()) return false;
    if (with_pointers(here[0].common) != with_pointers(there[0].common)) return false;
    ValueTable table(true);
    Reading first(table, one.manner), second(table, other.manner);
    first.read_head(here[0].common);
    second.read_head(there[0].common);
    try {
        for (size_t i = 1; i < here.size(); ++i) {
            if (here[i].is_brace()) continue;
            if (same_words(here[i], there[i])) {
                first.pass(here[i].common);
                second.pass(there[i].common);
                continue;
            }
            const NamesAndNumbers one_says(here[i].common), other_says(there[i].common);
            if (!one_says.may_say(other_says) || !other_says.may_say(one_says)) return false;
            if (first.run(here[i].common) != second.run(there[i].common)) return false;
        }
    } catch (const Unread&) {
        return false;
    }
    return true;
}

}  // namespace porttool
