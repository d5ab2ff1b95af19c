// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What changes a machine's state: assignments, declarations, parameters.
#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/value_graph/machine.h"

namespace porttool {

std::string Machine::common_type(std::string_view word) const {
    if (const auto found = manner_.types.find(word); found != manner_.types.end()) return found->second;
    if (manner_.own_operators && !is_type_word(word)) return std::string(word);  // `real` may be anything
    const std::string* known = manner_.dialect.meaning(word);
    return known != nullptr && !known->empty() ? *known : std::string(word);
}

std::string Machine::type_name(const Text& words, size_t first, size_t end) const {
    std::string out;
    size_t names = 0;
    for (size_t i = first; i < end; ++i) {
        if (is_one_of(words[i], {"const", "constexpr"})) continue;
        if (words[i] == "<") {  // arguments belong to the type's name
            int depth = 0;
            for (; i < end; ++i) {
                depth += words[i] == "<" ? 1 : words[i] == ">" ? -1 : 0;
                out += words[i] + " ";
                if (depth == 0) break;
            }
            continue;
        }
        const bool scope = words[i] == "::" || (i > first && words[i - 1] == "::");
        const bool star = words[i] == "*";
        if (!scope && !star && (!is_word_token(words[i]) || ++names > 1)) throw Unread();  // a qualifier is none here
        if (word_is(words[i], kQualifier) || is_beyond(words[i])) throw Unread();
        out += scope || star ? words[i] : common_type(words[i]);
    }
    return out == "auto" ? std::string() : out;
}

Value Machine::replaced(Value whole, const std::vector<Value>& path, size_t at, Value value) {
    if (at == path.size()) return value;
    const Value inner = at + 1 == path.size() ? value : replaced(table_.part(whole, path[at]), path, at + 1, value);
    return table_.with_part(whole, path[at], inner);
}

/// In the common vocabulary `p->x` is `p.x`: what is written so may be written into the world.
void Machine::note_written(const Place& place, Value whole, Value value, const LocalKind& kind, MachineState& state) {
    if (kind.type.empty()) throw Unread();
    std::vector<Value> parts = {state.world, whole, value};
    parts.insert(parts.end(), place.path.begin(), place.path.end());
    state.world = table_.node("wrote", std::move(parts));
}

/// What becomes of a value in a place whose type is not known.
Value Machine::stored_in_unknown(Value value, std::string_view type) {
    return manner_.own_operators && type.empty() ? table_.node("stored", {value}) : value;
}

/// Returns what stands there now.
Value Machine::store(const Place& place, Value value, MachineState& state) {
    if (place.kind == Place::Kind::None) throw Unread();
    if (place.kind == Place::Kind::World) {
        const std::string type = pointed_at(table_.type(place.address));
        value = stored_in_unknown(table_.converted(value, type), type);
        state.world = table_.node("store", {state.world, place.address, value});
        return value;
    }
    const LocalKind& kind = kinds_.at(place.local);
    const bool all_of_it = place.path.empty();
    if (all_of_it && kind.array) throw Unread();
    const bool has_type = all_of_it || (kind.array && place.path.size() == 1);
    value = has_type ? table_.converted(value, kind.type) : stored_in_unknown(value, {});
    Value& local = state.locals.at(place.local);
    if (!all_of_it && kind.opaque) note_written(place, local, value, kind, state);
    local = replaced(local, place.path, 0, value);
    return value;
}

Value Machine::updated(const std::string& operation, Value left, Value right) {
    const std::string type(table_.type(left));
    if (!manner_.own_operators || is_scalar_type(type) || is_pointer(type))
        return table_.binary(operation, left, right);
    return table_.node(operation + "=", {left, right}, type);
}

/// `is_taken`: something is done with the value.
Value Machine::assigned(Reader& in, MachineState& state, bool is_taken) {
    const bool points = in.peek() == "*";
    const bool step_first = in.peek() == "++" || in.peek() == "--";
    const std::string step(step_first ? in.words[in.at++] : std::string());
    const Operand left = expression(in, state);
    const std::string word(in.peek());
    if (step_first || word == "++" || word == "--") {
        if (!step_first) ++in.at;
        if (!step_first && (points || is_taken)) throw Unread();  // `* p ++` steps p; `a = b ++` takes what was
        const std::string operation = (step_first ? step : word).substr(0, 1);
        return store(left.place, updated(operation, whole(left), table_.number("1", manner_.shading)), state);
    }
    if (word == "=") {
        ++in.at;
        return store(left.place, assigned(in, state, true), state);
    }
    const bool shifts = (word == "<" || word == ">") && in.peek(1) == word + "=";
    const std::string operation = shifts ? word + word : word.substr(0, word.empty() ? 0 : word.size() - 1);
    const bool compound = shifts || (word.size() == 2 &&
                                     is_one_of(operation, {"+", "-", "*", "/", "%", "&", "|", "^"}) && word[1] == '=');
    if (!compound) return whole(left);
    in.at += shifts ? 2 : 1;
    const Value right = whole(expression(in, state));
    return store(left.place, updated(operation, whole(left), right), state);
}

bool Machine::starts_declaration(const Text& words, size_t first, size_t end, const MachineState& state) const {
    if (first >= end || !is_word_token(words[first])) return false;
    for (size_t i = first + 1; i < end; ++i) {
        if (const size_t local = local_of(words[i]); local != 0) return !state.locals.contains(local);
        if (!is_word_token(words[i]) && !is_one_of(words[i], {"::", "<", ">", "*", "&", ","}) &&
            !is_number_token(words[i]))
            return false;
    }
    return false;
}

/// The bounds of an array, as they are written.
std::string Machine::bounds(Reader& in) {
    std::string out;
    while (in.take("[")) {
        out += "[";
        while (!in.take("]")) {
            if (in.peek().empty() || in.peek() == "[" || local_of(in.peek()) != 0) throw Unread();
            out += " " + in.words[in.at++];
        }
        out += "]";
    }
    return out;
}

/// What a variable is declared with.
Value Machine::initial_value(Reader& in, const LocalKind& kind, const std::string& bounds, bool copies,
                             MachineState& state) {
    if (in.take("=")) {
        const Operand given = expression(in, state);
        if (!copies && given.place.kind != Place::Kind::None) throw Unread();  // another name for it
        if (kind.array) return table_.node("filled" + bounds, {given.value});
        return table_.converted(whole(given), kind.type);
    }
    if (in.take("(")) {
        const std::vector<Operand> operands = arguments(in, state, ")");
        if (kind.array || !copies) throw Unread();
        if (is_plain_type(kind.type)) return constructed(kind.type, operands);
        std::vector<Value> values;
        for (const Operand& operand : operands) values.push_back(operand.value);
        return unknown_call("call " + kind.type, std::move(values), operands, state);
    }
    if (copies && !kind.array && is_scalar_type(kind.type) && in.take("{")) {
        const std::vector<Operand> operands = arguments(in, state, "}");
        if (operands.size() == 1) return table_.converted(whole(operands[0]), kind.type);
        throw Unread();
    }
    if (!copies || in.peek() == "{") throw Unread();
    // Of a class that is not known a constructor may run.
    if (kind.opaque && !is_pointer(kind.type)) return unknown_call("call " + kind.type + bounds, {}, {}, state);
    return table_.node("undefined " + kind.type + bounds, {}, kind.array ? std::string() : kind.type);
}

void Machine::declaration(Reader& in, MachineState& state) {
    const size_t first = in.at;
    int depth = 0;
    while (in.at < in.end && (depth > 0 || (local_of(in.peek()) == 0 && in.peek() != "&" && in.peek() != "*"))) {
        depth += in.peek() == "<" ? 1 : in.peek() == ">" ? -1 : 0;
        ++in.at;
    }
    const std::string base = type_name(in.words, first, in.at);
    do {
        LocalKind kind;
        kind.type = base;
        bool reference = false;
        for (; is_one_of(in.peek(), {"*", "&", "const"}); ++in.at) {
            reference = reference || in.peek() == "&";
            if (in.peek() == "*") kind.type += "*";
        }
        const size_t local = local_of(in.peek());
        if (local == 0 || state.locals.contains(local)) throw Unread();
        ++in.at;
        const std::string of_array = bounds(in);
        kind.array = !of_array.empty();
        kind.opaque = !is_plain_type(kind.type);
        kinds_[local] = kind;
        const Value value = initial_value(in, kind, of_array, !reference, state);
        state.locals[local] = value;
    } while (in.take(","));
}

void Machine::run_plain(const Text& words, size_t first, size_t end, MachineState& state) {
    Reader in{words, first, end};
    if (starts_declaration(words, first, end, state)) {
        declaration(in, state);
        if (in.at != end) throw Unread();
        return;
    }
    while (in.at < end) {
        const MachineState before = state;
        const Value value = assigned(in, state, false);
        // Nobody takes the value: if anything comes of it, it is by an operator or a function of its own making.
        const bool did_something = state.world != before.world || state.locals != before.locals;
        if (!did_something || manner_.own_operators) state.world = table_.node("evaluated", {state.world, value});
        if (in.at < end) in.expect(",");
    }
}

void Machine::parameter(const Text& words, size_t first, size_t end, MachineState& state,
                        std::vector<std::string>& types) {
    size_t name = end;
    for (size_t i = first; i < end; ++i)
        if (local_of(words[i]) != 0) {
            name = i;
            break;
        }
    const std::string place = std::to_string(types.size());
    LocalKind kind;
    bool reference = false, array = false;
    Text type;
    for (size_t i = first; i < std::min(name, end); ++i) {
        const std::string& word = words[i];
        if (word == "&")
            reference = true;
        else
            type.push_back(word);
    }
    for (size_t i = name; i < end; ++i) {
        if (words[i] == "[") array = true;
        if (words[i] == "=") break;
    }
    kind.type = type_name(type, 0, type.size()) + (array ? "*" : "");
    kind.cell = reference;
    kind.opaque = !is_plain_type(kind.type);
    types.push_back(kind.cell ? kind.type + "*" : kind.type);
    if (name == end) return;
    const size_t local = local_of(words[name]);
    kinds_[local] = kind;
    state.locals[local] = table_.node("parameter " + place, {}, types.back());
}

std::vector<std::string> Machine::declare_parameters(const Text& words, size_t first, size_t end, MachineState& state) {
    std::vector<std::string> types;
    int depth = 0;
    size_t start = first;
    for (size_t i = first; i <= end; ++i) {
        const std::string_view word = i < end ? std::string_view(words[i]) : std::string_view(",");
        if (is_one_of(word, {"(", "[", "<", "{"})) ++depth;
        if (is_one_of(word, {")", "]", ">", "}"})) --depth;
        if (depth != 0 || word != ",") continue;
        const bool none = start == i || (i == end && i == start + 1 && words[start] == "void" && types.empty());
        if (!none) parameter(words, start, i, state, types);
        start = i + 1;
    }
    return types;
}

}  // namespace porttool
