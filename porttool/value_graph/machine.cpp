// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/value_graph/machine.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/value_graph/pure_calls.h"

namespace porttool {
namespace {

constexpr int kDeepestExpression = 200;

/// How tightly a binary operator binds, and how many words it is; 0 for what is none.
struct BinaryOperator {
    int binds = 0;
    size_t words = 1;
    std::string_view name;
};

BinaryOperator binary_operator(std::string_view word, std::string_view next) {
    if (word == "<" && next == "<") return {8, 2, "<<"};
    if (word == ">" && next == ">") return {8, 2, ">>"};
    if (is_one_of(word, {"*", "/", "%"})) return {10, 1, word};
    if (is_one_of(word, {"+", "-"})) return {9, 1, word};
    if (is_one_of(word, {"<", ">", "<=", ">="})) return {7, 1, word};
    if (is_one_of(word, {"==", "!="})) return {6, 1, word};
    if (word == "&") return {5, 1, word};
    if (word == "^") return {4, 1, word};
    if (word == "|") return {3, 1, word};
    if (word == "&&") return {2, 1, word};
    if (word == "||") return {1, 1, word};
    return {};
}

/// After the template arguments that begin at `i`, if a call follows them; else `i`.
size_t after_arguments(const std::vector<std::string>& words, size_t i, size_t end) {
    if (i >= end || words[i] != "<") return i;
    for (size_t k = i + 1; k + 1 < end && k < i + 16; ++k) {
        if (words[k] == ">") return words[k + 1] == "(" ? k + 1 : i;
        const bool plain =
            is_word_token(words[k]) || is_number_token(words[k]) || is_one_of(words[k], {",", "::", "*"});
        if (!plain) return i;
    }
    return i;
}

}  // namespace

bool is_beyond(std::string_view word) {
    return is_one_of(word, {"new",   "delete",  "throw",  "operator", "decltype", "typename", "typeid",
                            "asm",   "try",     "catch",  "goto",     "co_await", "co_yield", "co_return",
                            "case",  "default", "switch", "template", "using",    "typedef",  "struct",
                            "class", "union",   "enum",   "else",     "alignof",  "requires", "@"});
}

size_t local_of(std::string_view word) {
    if (word.size() < 2 || word[0] != '%') return 0;
    size_t number = 0;
    for (const char c : word.substr(1)) {
        if (c < '0' || c > '9') return 0;
        number = number * 10 + static_cast<size_t>(c - '0');
    }
    return number;
}

MachineState chosen(ValueTable& table, Value condition, const MachineState& yes, const MachineState& no) {
    MachineState out;
    out.world = table.choice(condition, yes.world, no.world);
    for (const auto& [local, value] : yes.locals)
        if (const auto other = no.locals.find(local); other != no.locals.end())
            out.locals.emplace(local, table.choice(condition, value, other->second));
    return out;
}

Value Machine::whole(const Operand& operand) const {
    // An array that is taken for a pointer would let others write into it.
    if (operand.place.kind == Place::Kind::Local && operand.place.path.empty() && kinds_.at(operand.place.local).array)
        throw Unread();
    return operand.value;
}

Value Machine::value_of(const Text& words, size_t first, size_t end, MachineState& state) {
    Reader in{words, first, end};
    const Value value = whole(expression(in, state));
    if (in.at != end) throw Unread();
    return value;
}

Machine::Operand Machine::expression(Reader& in, MachineState& state) {
    if (++depth_ > kDeepestExpression) throw Unread();
    Operand out = binary(in, state, 1);
    if (in.take("?")) {
        const Value condition = whole(out);
        MachineState no_state = state;
        const Value yes = whole(expression(in, state));
        in.expect(":");
        const Value no = whole(expression(in, no_state));
        check_choice(condition, yes, no);
        out = {table_.choice(condition, yes, no), {}};
        state = chosen(table_, condition, state, no_state);
    }
    --depth_;
    return out;
}

/// Two numbers of two types become one type first, whichever is given; a vector is chosen by its parts.
void Machine::check_choice(Value condition, Value yes, Value no) const {
    const std::string_view one = table_.type(yes), other = table_.type(no);
    if (one != other && (manner_.own_operators || (!one.empty() && !other.empty()))) throw Unread();
    if (manner_.own_operators && !is_truth(condition)) throw Unread();
}

/// True for what is known to be taken as a condition as it is.
bool Machine::is_truth(Value value) const {
    const std::string_view type = table_.type(value);
    return type == "bool" || is_scalar_type(type) || is_pointer(type);
}

/// `a && b`: what b does to the world is done only where a holds.
Value Machine::both_ways(Reader& in, MachineState& state, std::string_view operation, Value left, int least) {
    MachineState after = state;
    const Value right = whole(binary(in, after, least));
    state = operation == "&&" ? chosen(table_, left, after, state) : chosen(table_, left, state, after);
    if (manner_.own_operators && !(is_truth(left) && is_truth(right))) return table_.node(operation, {left, right});
    return table_.binary(operation, left, right);
}

Machine::Operand Machine::binary(Reader& in, MachineState& state, int least) {
    Operand left = unary(in, state);
    for (;;) {
        const BinaryOperator found = binary_operator(in.peek(), in.peek(1));
        const bool assigns = (in.peek() == "<" || in.peek() == ">") && in.peek(1) == std::string(in.peek()) + "=";
        if (found.binds < least || found.binds == 0 || assigns) return left;
        in.at += found.words;
        const std::string name(found.name);
        if (name == "&&" || name == "||") {
            left = {both_ways(in, state, name, whole(left), found.binds + 1), {}};
            continue;
        }
        const Value first = whole(left), second = whole(binary(in, state, found.binds + 1));
        left = {table_.binary(name, first, second), {}};
    }
}

Machine::Operand Machine::unary(Reader& in, MachineState& state) {
    const std::string word(in.peek());
    if (word == "+" || word == "-" || word == "!" || word == "~") {
        ++in.at;
        if (++depth_ > kDeepestExpression) throw Unread();
        const Value value = whole(unary(in, state));
        --depth_;
        if (word == "+" && is_scalar_type(table_.type(value))) return {value, {}};
        if (word == "!" && manner_.own_operators && !is_truth(value)) throw Unread();
        const std::string type(word == "!" ? std::string_view("bool") : table_.type(value));
        return {table_.node(word == "-" ? "negative" : word, {value}, type), {}};
    }
    if (word == "*") {
        ++in.at;
        const Operand pointer = unary(in, state);
        const std::string type = pointed_at(table_.type(pointer.value));
        return of_world(whole(pointer), type, state);
    }
    if (word == "&") {
        ++in.at;
        const Operand object = unary(in, state);
        if (object.place.kind != Place::Kind::World) throw Unread();  // others may write into the local
        return {object.place.address, {}};
    }
    if (word == "(") return cast_or_group(in, state);
    return postfix(in, state, primary(in, state));
}

/// True for brackets around one name that is no local, or around the name of a macro.
bool Machine::holds_foreign_name(const Text& words, size_t first, size_t end, bool is_one_name) {
    if (is_one_name) return true;
    return std::any_of(
        words.begin() + static_cast<std::ptrdiff_t>(first), words.begin() + static_cast<std::ptrdiff_t>(end),
        [](const std::string& word) { return is_word_token(word) && is_shouted(word) && word != "NULL"; });
}

Machine::Operand Machine::cast_or_group(Reader& in, MachineState& state) {
    size_t close = in.at + 1;
    bool may_be_type = close < in.end && is_word_token(in.words[close]);
    while (close < in.end && in.words[close] != ")") {
        const std::string& word = in.words[close];
        may_be_type = may_be_type && (is_word_token(word) || is_one_of(word, {"*", "::"}));
        ++close;
    }
    const std::string_view next = close + 1 < in.end ? std::string_view(in.words[close + 1]) : std::string_view();
    const bool operand_follows = is_word_token(next) || is_number_token(next) || next == "(" || local_of(next) != 0;
    if (may_be_type && operand_follows) {
        const std::string type = type_name(in.words, in.at + 1, close);
        in.at = close + 1;
        const Value value = whole(unary(in, state));
        return {table_.converted(value, type), {}};
    }
    // `( T ) - a` is a cast if T is a type, and `( N ) * 2` may be more than N is where that is a macro.
    if (manner_.own_operators && holds_foreign_name(in.words, in.at + 1, close, may_be_type)) throw Unread();
    ++in.at;
    Operand inner = expression(in, state);
    in.expect(")");
    return postfix(in, state, std::move(inner));
}

Machine::Operand Machine::postfix(Reader& in, MachineState& state, Operand operand) {
    for (;;) {
        if (in.peek() == "." || in.peek() == "->") {
            const bool arrow = in.peek() == "->";
            const std::string name(in.peek(1));
            if (!is_word_token(name) || is_beyond(name)) throw Unread();
            in.at += 2;
            operand = in.peek() == "(" ? method((arrow && manner_.own_operators ? "-> " : ". ") + name,
                                                std::move(operand), in, state)
                                       : member(operand, name, arrow, state);
        } else if (in.take("[")) {
            const Value index = whole(expression(in, state));
            in.expect("]");
            operand = element(operand, index, state);
        } else {
            return operand;
        }
    }
}

Machine::Operand Machine::member(const Operand& object, std::string_view name, bool arrow, const MachineState& state) {
    // In the common vocabulary the first elements of an array of numbers are read as components.
    const std::string_view type = table_.type(object.value);
    const size_t place = name.size() == 1 ? std::string_view("xyzw").find(name[0]) : std::string_view::npos;
    if (is_pointer(type) && is_scalar_type(pointed_at(type)) && place != std::string_view::npos)
        return element(object, table_.number(std::to_string(place), false), state);
    const Value part = table_.node(name);
    if (arrow || is_pointer(type)) return of_world(table_.node("member", {whole(object), part}), {}, state);
    if (object.place.kind == Place::Kind::World)
        return of_world(table_.node("member", {object.place.address, part}), {}, state);
    Operand out{table_.part(object.value, part), object.place};
    if (out.place.kind == Place::Kind::Local) out.place.path.push_back(part);
    return out;
}

Machine::Operand Machine::element(const Operand& object, Value index, const MachineState& state) {
    const bool local = object.place.kind == Place::Kind::Local && !is_pointer(table_.type(object.value));
    const LocalKind* declared = local ? &kinds_.at(object.place.local) : nullptr;
    if (local && declared->opaque && !declared->array)  // the elements may be anybody's
        return of_world(table_.node("element", {object.value, index}), {}, state);
    if (local) {
        const LocalKind& kind = *declared;
        const bool of_array = kind.array && object.place.path.empty();
        Operand out{table_.part(object.value, index, of_array ? std::string_view(kind.type) : std::string_view()),
                    object.place};
        out.place.path.push_back(index);
        return out;
    }
    const Value base = whole(object);
    const std::string type = pointed_at(table_.type(base));
    const bool first = table_.operation(index) == "number" && table_.operation(table_.parts(index)[0]) == "0";
    return of_world(first ? base : table_.binary("+", base, index), type, state);
}

Machine::Operand Machine::of_local(size_t local, const MachineState& state) {
    const auto found = state.locals.find(local);
    if (found == state.locals.end()) throw Unread();
    const LocalKind& kind = kinds_.at(local);
    if (kind.cell) return of_world(found->second, kind.type, state);
    return {found->second, {Place::Kind::Local, local, {}, 0}};
}

Machine::Operand Machine::of_world(Value address, std::string_view type, const MachineState& state) {
    // What was stored there last is there.
    const bool is_sure = !manner_.own_operators || !type.empty();
    if (is_sure && table_.operation(state.world) == "store" && table_.parts(state.world)[1] == address)
        return {table_.parts(state.world)[2], {Place::Kind::World, 0, {}, address}};
    return {table_.node("load", {state.world, address}, type), {Place::Kind::World, 0, {}, address}};
}

Machine::Operand Machine::primary(Reader& in, MachineState& state) {
    const std::string word(in.peek());
    if (word.empty()) throw Unread();
    if (const size_t local = local_of(word); local != 0) {
        ++in.at;
        return of_local(local, state);
    }
    if (is_number_token(word)) {
        ++in.at;
        return {table_.number(word, manner_.shading), {}};
    }
    if (word[0] == '"' || word[0] == '\'') {
        ++in.at;
        return {table_.node(word), {}};
    }
    if (word == "{") {
        ++in.at;
        std::vector<Value> parts;
        for (const Operand& part : arguments(in, state, "}")) parts.push_back(whole(part));
        return {table_.node("{}", std::move(parts)), {}};
    }
    if (!is_word_token(word) || is_beyond(word)) throw Unread();
    return named(in, state);
}

Machine::Operand Machine::named(Reader& in, MachineState& state) {
    const size_t first = in.at++;
    while (in.peek() == "::" && is_word_token(in.peek(1))) in.at += 2;
    in.at = after_arguments(in.words, in.at, in.end);
    std::string name;
    for (size_t i = first; i < in.at; ++i) name += in.words[i] + (i + 1 < in.at ? " " : "");
    if (name == "true" || name == "false") return {table_.node(name, {}, "bool"), {}};
    if (name == "sizeof") {
        in.expect("(");
        std::string what = "sizeof";
        for (; in.peek() != ")"; ++in.at) {
            if (in.peek().empty() || in.peek() == "(" || local_of(in.peek()) != 0) throw Unread();
            what += " " + std::string(in.peek());
        }
        ++in.at;
        return {table_.node(what), {}};
    }
    if (in.take("(")) return call(name, in, state);
    if (in.peek() == "{") throw Unread();
    if (is_fixed_name(name, manner_.dialect)) return {table_.node(name), {}};
    return of_world(table_.node(name), {}, state);
}

std::vector<Machine::Operand> Machine::arguments(Reader& in, MachineState& state, std::string_view closing) {
    std::vector<Operand> out;
    while (!in.take(closing)) {
        if (!out.empty()) in.expect(",");
        out.push_back(expression(in, state));
    }
    return out;
}

Value Machine::constructed(const std::string& type, const std::vector<Operand>& operands) {
    std::vector<Value> values;
    for (const Operand& operand : operands) values.push_back(whole(operand));
    if (values.size() == 1 && (is_scalar_type(type) || table_.type(values[0]) == type))
        return table_.converted(values[0], type);
    const bool by_component = is_plain_type(type) && type.back() == static_cast<char>('0' + values.size());
    for (Value& value : values)
        if (by_component) value = table_.converted(value, type[0] == 'i' ? "int" : type[0] == 'u' ? "uint" : "float");
    return table_.node(type, std::move(values), type);
}

Machine::Operand Machine::call(const std::string& name, Reader& in, MachineState& state) {
    const Value before = state.world;
    const size_t first = in.at;
    const std::vector<Operand> operands = arguments(in, state, ")");
    const std::string type = common_type(name);
    if (is_type_word(type)) return {constructed(type, operands), {}};
    std::vector<Value> values;
    const PureCall pure = pure_call(name, manner_.dialect);
    for (const Operand& operand : operands) values.push_back(pure.is_pure ? whole(operand) : operand.value);
    if (pure.is_pure && manner_.own_operators) return {table_.node(name, values), {}};  // nothing is known of overloads
    if (pure.is_pure) return {table_.node(pure.name, values, type_of_call(pure, table_, values)), {}};
    // A macro may evaluate what it is given more than once, or not at all.
    if (is_shouted(name) && state.world != before) throw Unread();
    return {unknown_call("call " + name + as_written(in, first), std::move(values), operands, state), {}};
}

/// What a macro is given counts as it is written.
std::string Machine::as_written(const Reader& in, size_t first) const {
    std::string out;
    if (!manner_.own_operators) return out;
    for (size_t i = first; i < in.at; ++i) out += " " + in.words[i];
    return out;
}

Machine::Operand Machine::method(const std::string& name, Operand object, Reader& in, MachineState& state) {
    in.expect("(");
    std::vector<Operand> operands = arguments(in, state, ")");
    operands.insert(operands.begin(), std::move(object));
    std::vector<Value> values;
    for (const Operand& operand : operands)
        values.push_back(operand.place.kind == Place::Kind::World && &operand == &operands[0] ? operand.place.address
                                                                                              : operand.value);
    return {unknown_call("call " + name, std::move(values), operands, state), {}};
}

/// Whatever the function does to the world and to what it is handed, it does the same where it is given the same.
Value Machine::unknown_call(const std::string& name, std::vector<Value> values, const std::vector<Operand>& operands,
                            MachineState& state) {
    values.push_back(state.world);
    const Value made = table_.node(name, std::move(values));
    for (size_t i = 0; i < operands.size(); ++i) {
        if (operands[i].place.kind != Place::Kind::Local) continue;
        const std::string type(table_.type(operands[i].value));
        const Value given_back = table_.node("given back", {made, table_.node(std::to_string(i))}, type);
        store(operands[i].place, given_back, state);
    }
    state.world = table_.node("after", {made});
    return made;
}

}  // namespace porttool
