// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/value_graph/values.h"

namespace porttool {

/// How a text is read.
struct ReadingManner {
    const Dialect& dialect;
    bool shading = false;  ///< a real number without a suffix is a float
    /// What this text calls types that the other one calls otherwise.
    std::map<std::string, std::string, std::less<>> types = {};
    /// Nothing is taken for granted that a class, a macro or an overload could have otherwise: `a += b` is `a = a + b`
    /// of numbers alone, what a call is given counts as it is written, and a type or a built-in is what it is called.
    bool own_operators = false;
};

/// What a program holds at a point: its locals by their numbers, and all else there is, the world, as one value. What
/// reads the world is a node on the world, what changes it gives another one, so that the order of these counts.
struct MachineState {
    std::map<size_t, Value> locals;
    Value world = 0;
};

/// What is known of a local.
struct LocalKind {
    std::string type;     ///< "" where it is not known
    bool cell = false;    ///< a reference to an object of the world; its value is the address
    bool array = false;   ///< declared with bounds
    bool opaque = false;  ///< its type may hold a pointer
};

/// Evaluates expressions and what is assigned; throws Unread for all that it is not sure of. Locals are words such as
/// "%3", all others are what the text has.
class Machine {
public:
    Machine(ValueTable& table, const ReadingManner& manner) : table_(table), manner_(manner) {}

    using Text = std::vector<std::string>;

    /// The value of the words from `first` to `end`, which is one expression without assignments.
    Value value_of(const Text& words, size_t first, size_t end, MachineState& state);

    /// Runs a statement that controls nothing: an assignment, a step, a call, a declaration.
    void run_plain(const Text& words, size_t first, size_t end, MachineState& state);

    /// Declares the parameters that stand between `first` and `end`, and returns their types in their order.
    std::vector<std::string> declare_parameters(const Text& words, size_t first, size_t end, MachineState& state);

    /// A type by its common name; a star for each pointer.
    std::string type_name(const Text& words, size_t first, size_t end) const;

    const LocalKind& kind(size_t local) const { return kinds_.at(local); }

private:
    struct Place {
        enum class Kind : uint8_t { None, Local, World } kind = Kind::None;
        size_t local = 0;
        std::vector<Value> path;  ///< of a local: members and elements, from the outermost
        Value address = 0;
    };
    struct Operand {
        Value value;
        Place place;
    };
    /// The words that are left to read.
    struct Reader {
        const Text& words;
        size_t at, end;
        std::string_view peek(size_t ahead = 0) const {
            return at + ahead < end ? std::string_view(words[at + ahead]) : std::string_view();
        }
        bool take(std::string_view word) {
            if (peek() != word) return false;
            ++at;
            return true;
        }
        void expect(std::string_view word) {
            if (!take(word)) throw Unread();
        }
    };

    void check_choice(Value condition, Value yes, Value no) const;
    bool is_truth(Value value) const;
    static bool holds_foreign_name(const Text& words, size_t first, size_t end, bool is_one_name);
    std::string as_written(const Reader& in, size_t first) const;
    Operand expression(Reader& in, MachineState& state);
    Operand binary(Reader& in, MachineState& state, int least);
    Operand unary(Reader& in, MachineState& state);
    Operand cast_or_group(Reader& in, MachineState& state);
    Operand postfix(Reader& in, MachineState& state, Operand operand);
    Operand primary(Reader& in, MachineState& state);
    Operand named(Reader& in, MachineState& state);
    Operand call(const std::string& name, Reader& in, MachineState& state);
    Operand method(const std::string& name, Operand object, Reader& in, MachineState& state);
    Operand member(const Operand& object, std::string_view name, bool arrow, const MachineState& state);
    Operand element(const Operand& object, Value index, const MachineState& state);
    Operand of_local(size_t local, const MachineState& state);
    Operand of_world(Value address, std::string_view type, const MachineState& state);
    std::vector<Operand> arguments(Reader& in, MachineState& state, std::string_view closing);
    Value both_ways(Reader& in, MachineState& state, std::string_view operation, Value left, int least);
    Value unknown_call(const std::string& name, std::vector<Value> values, const std::vector<Operand>& operands,
                       MachineState& state);
    Value constructed(const std::string& type, const std::vector<Operand>& operands);
    Value whole(const Operand& operand) const;
    Value store(const Place& place, Value value, MachineState& state);
    void note_written(const Place& place, Value whole, Value value, const LocalKind& kind, MachineState& state);
    Value replaced(Value whole, const std::vector<Value>& path, size_t at, Value value);

    Value updated(const std::string& operation, Value left, Value right);
    Value stored_in_unknown(Value value, std::string_view type);
    Value assigned(Reader& in, MachineState& state, bool is_taken);
    static std::string bounds(Reader& in);
    Value initial_value(Reader& in, const LocalKind& kind, const std::string& bounds, bool copies, MachineState& state);
    bool starts_declaration(const Text& words, size_t first, size_t end, const MachineState& state) const;
    void declaration(Reader& in, MachineState& state);
    void parameter(const Text& words, size_t first, size_t end, MachineState& state, std::vector<std::string>& types);
    std::string common_type(std::string_view word) const;

    ValueTable& table_;
    const ReadingManner& manner_;
    std::map<size_t, LocalKind> kinds_;
    int depth_ = 0;
};

/// True for words that begin what a machine does not read, or stand for it: `new`, `throw`, `switch`.
bool is_beyond(std::string_view word);

/// The number of a local that a word names, or 0.
size_t local_of(std::string_view word);

/// The state after a choice: what both ways have, chosen by the condition.
MachineState chosen(ValueTable& table, Value condition, const MachineState& yes, const MachineState& no);

}  // namespace porttool
