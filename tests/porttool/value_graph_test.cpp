// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Functions that compute the same in other words: labelled by hand from what the languages say, and random
// programs, edited at random, which an interpreter judges.
#include <gtest/gtest.h>

#include <random>

#include "porttool/compare/computed_values.h"
#include "porttool/compare/lone_edit.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/scan.h"

namespace porttool::testing::value_graph_test {
namespace {

UnitState function_of(const std::string& path, const std::string& text) {
    const ScannedFile file = scan_text(path, text);
    EXPECT_EQ(file.units.size(), 1u) << text;
    return unit_state(file, file.units.at(0));
}

/// True if two functions of C++ are taken for the same.
bool alike(const std::string& one, const std::string& other) {
    const UnitState first = function_of("a.cpp", one), second = function_of("b.cpp", other);
    return compute_alike({first.text.words(), second.text.words()}, Dialect(), {Language::Cpp, Language::Cpp});
}

/// True if an edit of a function of C++ is taken for one that changes no value, statement by statement.
bool means_nothing(const std::string& before, const std::string& now) {
    const UnitState first = function_of("a.cpp", before), second = function_of("a.cpp", now);
    return lone_edit(first.text.words(), second.text.words(), UnitKind::Function, Language::Cpp, Dialect(), false)
        .means_nothing;
}

struct LabelledEdit {
    std::string before, now;
};

TEST(ValueGraph, WhatIsSaidOtherwiseIsTheSame) {
    const std::vector<LabelledEdit> kEdits = {
        {"float f(float a, float b) { return a * b + b; }",
         "float f(float a, float b) { float t = b * a; return b + t; }"},
        {"int f(int a) { if (a < 0) return 0; return g(a); }", "int f(int a) { return a >= 0 ? g(a) : 0; }"},
        {"int f(int a, int b) { if (a > 0 && b > 0) { return 1; } return 2; }",
         "int f(int a, int b) { if (a > 0) { if (b > 0) { return 1; } } return 2; }"},
        {"void f(float* p, int n) { for (int i = 0; i < n; ++i) p[i] = 0; }",
         "void f(float* p, int n) { int i = 0; while (i < n) { p[i] = 0; i += 1; } }"},
        {"int f(const int* p, int n) { for (int i = 0; i < n; ++i) { if (p[i] == 3) break; n -= 1; } return n; }",
         "int f(const int* p, int n) { for (int i = 0; n > i; i++) { if (!(p[i] != 3)) { break; } --n; } return n; }"},
        {"void f(float* p) { *p = 1; p[1] = 2; }", "void f(float* p) { p[0] = 1; *(p + 1) = 2; }"},
        {"void f(S* s, int k) { s->a = k; s->b = k; }", "void f(S* s, int k) { int t = k; (*s).a = t; (*s).b = t; }"},
        {"vec3 f(vec3 v) { v.x = 1.0f; v.y = 2.0f; return v; }",
         "vec3 f(vec3 v) { v.x = 1.0f; v.y = v.x + v.x; return v; }"},
        {"float f(float a) { float t = a; t *= 2; return t; }", "float f(float a) { return a * 2.0f; }"},
        {"int f(int a) { do { a = h(a); } while (a > 9); return a; }",
         "int f(int a) { do { const int t = h(a); a = t; } while (9 < a); return a; }"},
    };
    size_t seen = 0;
    for (const LabelledEdit& edit : kEdits) {
        // The eighth adds two equal numbers where two was written: no number is worked out, so that is not known.
        EXPECT_EQ(alike(edit.before, edit.now), seen++ != 7) << edit.before << "\n" << edit.now;
    }
}

TEST(ValueGraph, WhatMayDifferInABitIsNot) {
    const std::vector<LabelledEdit> kEdits = {
        {"float f(float a, float b, float c) { return a + b + c; }",
         "float f(float a, float b, float c) { return a + (b + c); }"},
        {"float f(float a) { return a / 2.0f; }", "float f(float a) { return 2.0f / a; }"},
        {"float f(float a) { double t = a; return t * 0.1f; }", "float f(float a) { float t = a; return t * 0.1f; }"},
        {"int f(float a) { return a; }", "int f(float a) { int t = a + 0.5f; return t; }"},
        {"float f(float a) { float t = a; return t; }", "float f(float a) { int t = a; return t; }"},
        {"int f(int a) { g(); h(); return a; }", "int f(int a) { h(); g(); return a; }"},
        {"int f(int* p) { int t = p[0]; p[0] = 1; return t; }", "int f(int* p) { p[0] = 1; int t = p[0]; return t; }"},
        {"int f(int* p, int* q) { int t = *q; *p = 1; return t; }", "int f(int* p, int* q) { *p = 1; return *q; }"},
        {"int f(int a) { int t = a; g(t); return t; }", "int f(int a) { int t = a; g(t); return a; }"},
        {"int f(int a) { for (int i = 0; i < 3; ++i) { if (a == i) { break; } a += 1; } return a; }",
         "int f(int a) { for (int i = 0; i < 3; ++i) { if (a == i) { continue; } a += 1; } return a; }"},
        {"int f(int a, int n) { int i = 0; for (; i < n; i++) { if (g(i)) break; } return i; }",
         "int f(int a, int n) { int i = 0; while (i < n) { if (g(i)) { i++; break; } i++; } return i; }"},
        {"void f(View v, int i) { v[i] = 1; }", "void f(View v, int i) { }"},
        {"bool f(int a) { return g(a) && h(a); }", "bool f(int a) { bool s = h(a); return g(a) && s; }"},
        {"int f(int a) { return N(a); }", "int f(int a) { int t = g(a); return N(t); }"},
        {"int f(int a) { static int n = 0; n += a; return n; }", "int f(int a) { int n = 0; n += a; return n; }"},
        {"float f(float a) { return a; }", "double f(float a) { return a; }"},
        {"float f(float a) { return a; }", "float f(float a, float b) { return a; }"},
        {"uint f(uint a) { return a >> 1; }", "uint f(int a) { return a >> 1; }"},
        {"bool f(float a, float b) { return !(a < b); }", "bool f(float a, float b) { return a >= b; }"},
        {"int f(int a) { return TWICE(g(a)); }", "int f(int a) { int t = g(a); return TWICE(t); }"},
    };
    for (const LabelledEdit& edit : kEdits)
        EXPECT_FALSE(alike(edit.before, edit.now)) << edit.before << "\n" << edit.now;
}

/// A program of whole numbers that wrap around: an expression or a statement.
struct Node {
    enum class Kind : uint8_t {
        Number,
        Local,
        Element,
        Binary,
        Call,
        Block,
        Declare,
        Set,
        Add,
        Store,
        If,
        For,
        While,
        Return
    };
    Kind kind;
    int value = 0;  ///< of a number; which local, operator or call
    std::vector<Node> parts;
};
using Kind = Node::Kind;
constexpr std::array kOperators = {"+", "-", "*", "<", "==", "&"};

/// Runs programs, and notes what they do to the world.
class Interpreter {
public:
    Interpreter(uint32_t seed) : memory_(4) {
        std::mt19937 random(seed);
        for (uint32_t& cell : memory_) cell = random() % 5;
        for (int local = 0; local < 3; ++local) locals_[local] = random() % 5;
    }

    std::string outcome(const Node& body) {
        run(body);
        for (const uint32_t cell : memory_) log_ += " " + std::to_string(cell);
        return log_ + " -> " + (returned_ ? std::to_string(result_) : "nothing");
    }

private:
    uint32_t value(const Node& node) {
        switch (node.kind) {
            case Kind::Number:
                return static_cast<uint32_t>(node.value);
            case Kind::Local:
                return locals_[node.value];
            case Kind::Element:
                return memory_[value(node.parts[0]) & 3u];
            case Kind::Call: {
                const uint32_t given = value(node.parts[0]);
                log_ += " call " + std::to_string(node.value) + "(" + std::to_string(given) + ")";
                memory_[given & 3u] += static_cast<uint32_t>(node.value) + 1;
                return given * 3 + static_cast<uint32_t>(++calls_);
            }
            default:
                break;
        }
        const uint32_t a = value(node.parts[0]), b = value(node.parts[1]);
        const std::array<uint32_t, 6> results = {a + b, a - b, a * b, a < b ? 1u : 0u, a == b ? 1u : 0u, a & b};
        return results.at(static_cast<size_t>(node.value));
    }

    void run(const Node& node) {
        if (returned_ || ++steps_ > 300) return;
        switch (node.kind) {
            case Kind::Block:
                for (const Node& part : node.parts) run(part);
                break;
            case Kind::Declare:
            case Kind::Set:
                locals_[node.value] = value(node.parts[0]);
                break;
            case Kind::Add:
                locals_[node.value] += value(node.parts[0]);
                break;
            case Kind::Store: {
                const uint32_t place = value(node.parts[0]) & 3u;
                memory_[place] = value(node.parts[1]);
                break;
            }
            case Kind::If:
                run(node.parts[value(node.parts[0]) != 0 ? 1 : 2]);
                break;
            case Kind::For:
            case Kind::While:
                for (locals_[node.value] = 0; !returned_ && steps_ <= 300 && locals_[node.value] < value(node.parts[0]);
                     ++locals_[node.value])
                    run(node.parts[1]);
                break;
            case Kind::Return:
                result_ = value(node.parts[0]);
                returned_ = true;
                break;
            default:
                break;
        }
    }

    std::map<int, uint32_t> locals_;
    std::vector<uint32_t> memory_;
    std::string log_;
    uint32_t result_ = 0;
    int calls_ = 0, steps_ = 0;
    bool returned_ = false;
};

/// Writes a program as C.
std::string written(const Node& node) {
    const auto part = [&](size_t i) { return written(node.parts[i]); };
    const std::string local = "v" + std::to_string(node.value);
    switch (node.kind) {
        case Kind::Number:
            return std::to_string(node.value) + "u";
        case Kind::Local:
            return local;
        case Kind::Element:
            return "p[" + part(0) + " & 3u]";
        case Kind::Binary:
            return "(" + part(0) + " " + kOperators.at(static_cast<size_t>(node.value)) + " " + part(1) + ")";
        case Kind::Call:
            return "call" + std::to_string(node.value) + "(" + part(0) + " + 0u)";
        case Kind::Declare:
            return "uint " + local + " = " + part(0) + ";\n";
        case Kind::Set:
            return local + " = " + part(0) + ";\n";
        case Kind::Add:
            return local + " += " + part(0) + ";\n";
        case Kind::Store:
            return "p[" + part(0) + " & 3u] = " + part(1) + ";\n";
        case Kind::If:
            return "if (" + part(0) + ") {\n" + part(1) + "} else {\n" + part(2) + "}\n";
        case Kind::For:
            return "for (uint " + local + " = 0u; " + local + " < " + part(0) + "; ++" + local + ") {\n" + part(1) +
                   "}\n";
        case Kind::While:
            return "uint " + local + " = 0u;\nwhile (" + local + " < " + part(0) + ") {\n" + part(1) + local +
                   " += 1u;\n}\n";
        case Kind::Return:
            return "return " + part(0) + ";\n";
        case Kind::Block:
            break;
    }
    std::string out;
    for (const Node& each : node.parts) out += written(each);
    return out;
}

std::string function_text(const Node& body) {
    return "uint f(uint v0, uint v1, uint v2, uint* p) {\n" + written(body) + "}\n";
}

/// Makes programs and edits them.
class Generator {
public:
    explicit Generator(uint32_t seed) : random_(seed) {}

    Node body() {
        known_ = {0, 1, 2};
        next_ = 3;
        Node out = block(4, 2);
        out.parts.push_back({Kind::Return, 0, {expression(2)}});
        return out;
    }

    /// Edits a program in one place; what kind of edit it is, is the answer.
    int edit(Node& body) {
        const int kind = below(6);
        std::vector<Node*> places;
        collect(body, places);
        if (kind == 5)
            std::erase_if(places, [](const Node* node) { return node->kind != Kind::Add && node->kind != Kind::For; });
        if (places.empty()) return kind;
        Node& place = *places[static_cast<size_t>(below(static_cast<int>(places.size())))];
        switch (kind) {
            case 0:
                if (place.kind == Kind::Binary) std::swap(place.parts[0], place.parts[1]);
                break;
            case 1:
                if (place.kind == Kind::Number || place.kind == Kind::Binary) place.value = (place.value + 1) % 6;
                break;
            case 2:
                if (place.kind == Kind::If) {
                    std::swap(place.parts[1], place.parts[2]);
                    place.parts[0] = {Kind::Binary, 4, {place.parts[0], {Kind::Number, 0, {}}}};
                }
                break;
            case 3:
                name_a_part(body);
                break;
            case 4:
                if (place.kind == Kind::Block && place.parts.size() > 1 && place.parts[0].kind != Kind::Declare)
                    std::swap(place.parts[0], place.parts[1]);
                break;
            default:
                if (place.kind == Kind::Add)
                    place = {
                        Kind::Set, place.value, {{Kind::Binary, 0, {{Kind::Local, place.value, {}}, place.parts[0]}}}};
                else if (place.kind == Kind::For)
                    place.kind = Kind::While;
        }
        return kind;
    }

private:
    int below(int bound) { return static_cast<int>(random_() % static_cast<uint32_t>(bound)); }

    Node expression(int depth) {
        const int pick = below(depth > 0 ? 6 : 2);
        if (pick == 0) return {Kind::Number, below(4), {}};
        if (pick == 1) return {Kind::Local, known_[static_cast<size_t>(below(static_cast<int>(known_.size())))], {}};
        if (pick == 2) return {Kind::Element, 0, {expression(depth - 1)}};
        if (pick == 3 && below(2) == 0) return {Kind::Call, below(2), {expression(depth - 1)}};
        Node left = expression(depth - 1);
        return {Kind::Binary, below(6), {std::move(left), expression(depth - 1)}};
    }

    Node statement(int depth) {
        const int local = known_[static_cast<size_t>(below(static_cast<int>(known_.size())))];
        switch (below(depth > 0 ? 7 : 4)) {
            case 0:
                return {Kind::Set, local, {expression(2)}};
            case 1:
                return {Kind::Add, local, {expression(2)}};
            case 2: {
                Node place = expression(1);
                return {Kind::Store, 0, {std::move(place), expression(2)}};
            }
            case 3: {
                Node made{Kind::Declare, next_, {expression(2)}};
                known_.push_back(next_++);
                return made;
            }
            case 4: {
                Node condition = expression(1);
                Node yes = block(2, depth - 1);
                return {Kind::If, 0, {std::move(condition), std::move(yes), block(2, depth - 1)}};
            }
            case 5: {
                Node yes = {Kind::Block, 0, {{Kind::Return, 0, {expression(1)}}}};
                Node condition = expression(1);
                return {Kind::If, 0, {std::move(condition), std::move(yes), {Kind::Block, 0, {}}}};
            }
            default: {
                const int counter = next_++;
                return {Kind::For, counter, {{Kind::Number, below(4), {}}, block(2, depth - 1)}};
            }
        }
    }

    Node block(int statements, int depth) {
        const std::vector<int> before = known_;
        Node out{Kind::Block, 0, {}};
        for (int i = 0; i < statements; ++i) out.parts.push_back(statement(depth));
        if (depth < 2) known_ = before;
        return out;
    }

    void collect(Node& node, std::vector<Node*>& out) {
        out.push_back(&node);
        for (Node& part : node.parts) collect(part, out);
    }

    /// `return a * b` becomes `uint t = a * b; return t`.
    void name_a_part(Node& body) {
        Node& last = body.parts.back();
        const int name = next_++;
        Node made{Kind::Declare, name, {last.parts[0]}};
        last.parts[0] = {Kind::Local, name, {}};
        body.parts.insert(body.parts.end() - 1, std::move(made));
    }

    std::mt19937 random_;
    std::vector<int> known_;
    int next_ = 3;
};

TEST(ValueGraph, WhatItTakesForTheSameGivesTheSameInAnInterpreter) {
    std::array<size_t, 6> edits{}, known{};
    size_t respellings = 0;
    for (uint32_t seed = 0; seed < 600; ++seed) {
        Generator generator(seed);
        const Node before = generator.body();
        Node now = before;
        const auto kind = static_cast<size_t>(generator.edit(now));
        const std::string text = function_text(before), edited = function_text(now);
        if (text == edited) continue;
        ++edits.at(kind);
        const bool respelled = means_nothing(text, edited);
        respellings += respelled ? 1 : 0;
        if (!respelled && !alike(text, edited)) continue;
        ++known.at(kind);
        for (uint32_t input = 0; input < 20; ++input)
            ASSERT_EQ(Interpreter(input).outcome(before), Interpreter(input).outcome(now)) << text << edited;
    }
    // A name for a part and another way to write a loop or a sum are always known for what they are.
    for (const size_t kind : {3u, 5u}) {
        EXPECT_GT(edits.at(kind), 50u);
        EXPECT_EQ(known.at(kind), edits.at(kind)) << kind;
    }
    EXPECT_GT(edits[0], 8u);
    EXPECT_GT(known[0], 2u);
    EXPECT_LT(known[0], edits[0]) << "swapped operands of a difference";
    EXPECT_GT(respellings, 40u);
}

}  // namespace
}  // namespace porttool::testing::value_graph_test
