// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Machine-made edits of this repository's own kernels: every semantic one is found, no cosmetic one is flagged.
#include <cstdlib>
#include <functional>
#include <random>
#include <set>

#include "porttool/normal/unit_state.h"
#include "porttool/read/map_file.h"
#include "porttool/scan/scan.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::mutation_test {
namespace {

/// A place in a unit's body where an edit can be made, as offsets into the file without splices (our kernels have
/// none).
struct Body {
    std::string path;
    std::string text;
    ScannedFile file;
    Unit unit;

    std::string_view word(uint32_t i) const { return file.lexed.view(i); }
    uint32_t offset(uint32_t i) const { return file.lexed.tokens[i].offset; }
    uint32_t end(uint32_t i) const { return offset(i) + file.lexed.tokens[i].length; }
    std::string with(uint32_t first, uint32_t last, const std::string& replacement) const {
        return text.substr(0, first) + replacement + text.substr(last);
    }
};

using Random = std::mt19937;
/// Returns the file's text after the edit, or "" where the edit has no place in this body.
using Mutation = std::function<std::string(const Body&, Random&)>;

/// A random token of the body that fits, or 0.
uint32_t pick(const Body& body, Random& random, const std::function<bool(uint32_t)>& fits) {
    std::vector<uint32_t> found;
    for (uint32_t i = body.unit.body.first; i + 1 < body.unit.body.end; ++i)
        if ((body.file.lexed.tokens[i].flags & kInDirective) == 0 && fits(i)) found.push_back(i);
    return found.empty() ? 0 : found[random() % found.size()];
}

bool is_number(const Body& b, uint32_t i) { return b.file.lexed.tokens[i].kind == TokenKind::Number; }
bool is_name(const Body& b, uint32_t i) { return b.file.lexed.tokens[i].kind == TokenKind::Identifier; }

/// The start of a plain statement that ends with a semicolon: the token behind ; { or }.
uint32_t pick_statement(const Body& b, Random& random, uint32_t& semicolon) {
    const uint32_t start = pick(b, random, [&](uint32_t i) {
        if (i == b.unit.body.first || !(b.word(i - 1) == ";" || b.word(i - 1) == "{" || b.word(i - 1) == "}"))
            return false;
        if (!is_name(b, i) || b.word(i) == "if" || b.word(i) == "for" || b.word(i) == "while" || b.word(i) == "else")
            return false;
        int depth = 0;  // not within the head of a for
        for (uint32_t k = b.unit.body.first; k < i; ++k) depth += b.word(k) == "(" ? 1 : b.word(k) == ")" ? -1 : 0;
        return depth == 0;
    });
    semicolon = start;
    while (semicolon != 0 && semicolon < b.unit.body.end && b.word(semicolon) != ";") ++semicolon;
    return semicolon < b.unit.body.end ? start : 0;
}

// -- cosmetic edits --

std::string add_comment(const Body& b, Random& random) {
    const uint32_t i = pick(b, random, [](uint32_t) { return true; });
    return i == 0 ? "" : b.with(b.offset(i), b.offset(i), random() % 2 ? "/* why */ " : "// why\n");
}
std::string add_space(const Body& b, Random& random) {
    const uint32_t i = pick(b, random, [](uint32_t) { return true; });
    return i == 0 ? "" : b.with(b.offset(i), b.offset(i), random() % 2 ? "   " : "\n\n\t");
}
std::string respell_number(const Body& b, Random& random) {
    const uint32_t i = pick(b, random, [&](uint32_t k) {
        return is_number(b, k) && b.word(k).ends_with("f") && b.word(k).find('.') != std::string_view::npos;
    });
    if (i == 0) return "";
    std::string number(b.word(i));
    number.back() = 'F';
    number.insert(number.size() - 1, "0");
    if (number.find('e') != std::string::npos) return "";
    return b.with(b.offset(i), b.end(i), number);
}
std::string change_braces(const Body& b, Random& random) {
    // around one plain statement: away where there are some, there where there are none
    const uint32_t i = pick(b, random, [&](uint32_t k) {
        if (b.word(k) != ")") return false;
        const bool braced = b.word(k + 1) == "{";
        uint32_t end = k + (braced ? 2 : 1);
        if (!is_name(b, end) || b.word(end) == "if" || b.word(end) == "for" || b.word(end) == "while") return false;
        while (end < b.unit.body.end && b.word(end) != ";" && b.word(end) != "{" && b.word(end) != "}") ++end;
        return b.word(end) == ";" && (!braced || b.word(end + 1) == "}") && (braced || b.word(k + 1) == "return");
    });
    if (i == 0) return "";
    uint32_t end = i;
    while (b.word(end) != ";") ++end;
    if (b.word(i + 1) != "{")
        return b.with(b.offset(i + 1), b.end(end),
                      "{ " + b.text.substr(b.offset(i + 1), b.end(end) - b.offset(i + 1)) + " }");
    return b.with(b.offset(i + 1), b.end(end + 1), " " + b.text.substr(b.offset(i + 2), b.end(end) - b.offset(i + 2)));
}
std::string rename_local(const Body& b, Random& random) {
    const auto names = local_names(b.file, b.unit);
    if (names.empty()) return "";
    const std::string name = names[random() % names.size()];
    std::string text = b.text;
    for (uint32_t i = b.unit.tokens.end; i-- > b.unit.tokens.first;) {
        const bool member = i > 0 && (b.word(i - 1) == "." || b.word(i - 1) == "->" || b.word(i - 1) == "::");
        if (b.word(i) == name && !member) text.replace(b.offset(i), name.size(), name + "_renamed");
    }
    return text;
}
std::string swap_functions(const Body& b, Random&) {
    // moves this unit to the end of its file
    const uint32_t first = b.offset(b.unit.tokens.first), last = b.end(b.unit.tokens.end - 1);
    if (b.unit.name.find("::") != std::string::npos || b.unit.name.find('#') != std::string::npos) return "";
    for (const Directive& d : b.file.lexed.directives)
        if (d.kind == DirectiveKind::If) return "";
    const std::string unit = b.text.substr(first, last - first);
    return b.with(first, last, "") + "\n" + unit + "\n";
}

// -- semantic edits --

std::string change_number(const Body& b, Random& random) {
    const uint32_t i = pick(b, random, [&](uint32_t k) {
        return is_number(b, k) && b.word(k).find_first_of("xX") == std::string_view::npos;
    });
    return i == 0 ? "" : b.with(b.offset(i), b.offset(i), "7");
}
std::string change_operator(const Body& b, Random& random) {
    static const std::map<std::string, std::string, std::less<>> kOther = {
        {"+", "-"},   {"*", "+"},   {"<", "<="}, {">", ">="},  {"&&", "||"},
        {"||", "&&"}, {"==", "!="}, {"<=", "<"}, {"+=", "-="}, {"&", "|"}};
    const uint32_t i = pick(b, random, [&](uint32_t k) { return kOther.contains(b.word(k)); });
    return i == 0 ? "" : b.with(b.offset(i), b.end(i), kOther.find(b.word(i))->second);
}
std::string add_guard(const Body& b, Random& random) {
    uint32_t semicolon = 0;
    const uint32_t i = pick_statement(b, random, semicolon);
    return i == 0 ? "" : b.with(b.offset(i), b.offset(i), "if (guard <= 0.0f) return; ");
}
std::string drop_statement(const Body& b, Random& random) {
    uint32_t semicolon = 0;
    const uint32_t i = pick_statement(b, random, semicolon);
    return i == 0 ? "" : b.with(b.offset(i), b.end(semicolon), "");
}
std::string swap_call(const Body& b, Random& random) {
    const uint32_t i = pick(b, random, [&](uint32_t k) {
        return is_name(b, k) && b.word(k + 1) == "(" && b.word(k) != "if" && b.word(k) != "for" && b.word(k) != "while";
    });
    return i == 0 ? "" : b.with(b.offset(i), b.end(i), "other_call");
}
std::string swap_arguments(const Body& b, Random& random) {
    const uint32_t i = pick(b, random, [&](uint32_t k) {
        return k + 3 < b.unit.body.end && (b.word(k - 1) == "(" || b.word(k - 1) == ",") && is_name(b, k) &&
               b.word(k + 1) == "," && is_name(b, k + 2) && (b.word(k + 3) == ")" || b.word(k + 3) == ",") &&
               b.word(k) != b.word(k + 2);
    });
    if (i == 0) return "";
    return b.with(b.offset(i), b.end(i + 2), std::string(b.word(i + 2)) + ", " + std::string(b.word(i)));
}
std::string use_other_local(const Body& b, Random& random) {
    // one use of a local becomes another local: looks like a renaming and is none
    const auto names = local_names(b.file, b.unit);
    auto is_local = [&](uint32_t k) { return std::find(names.begin(), names.end(), b.word(k)) != names.end(); };
    const uint32_t i =
        pick(b, random, [&](uint32_t k) { return is_local(k) && b.word(k - 1) != "." && !is_name(b, k - 1); });
    if (i == 0 || names.size() < 2) return "";
    std::string other = names[random() % names.size()];
    if (other == b.word(i))
        other = names[(static_cast<size_t>(std::find(names.begin(), names.end(), other) - names.begin()) + 1) %
                      names.size()];
    return b.with(b.offset(i), b.end(i), other);
}
std::string move_statement(const Body& b, Random& random) {
    uint32_t semicolon = 0;
    const uint32_t i = pick_statement(b, random, semicolon);
    if (i == 0 || semicolon + 2 >= b.unit.body.end) return "";
    uint32_t next_end = semicolon + 1;
    while (next_end < b.unit.body.end && b.word(next_end) != ";" && b.word(next_end) != "{" && b.word(next_end) != "}")
        ++next_end;
    if (next_end >= b.unit.body.end || b.word(next_end) != ";" || !is_name(b, semicolon + 1)) return "";
    const std::string one = b.text.substr(b.offset(i), b.end(semicolon) - b.offset(i));
    const std::string two = b.text.substr(b.offset(semicolon + 1), b.end(next_end) - b.offset(semicolon + 1));
    if (one == two || b.word(semicolon + 1) == "if" || b.word(semicolon + 1) == "for" ||
        b.word(semicolon + 1) == "while" || b.word(semicolon + 1) == "else")
        return "";
    return b.with(b.offset(i), b.end(next_end), two + "\n" + one);
}

class Mutations : public ::testing::Test {
protected:
    void SetUp() override {
        const std::filesystem::path root = REPOSITORY;
        for (const char* side : {"source_core/kernels", "target_core/kernels"}) {
            if (!std::filesystem::exists(root / side)) GTEST_SKIP() << side << " is not there";
            for (const auto& entry : std::filesystem::directory_iterator(root / side))
                if (entry.is_regular_file())
                    disk.files["/r/" + std::string(side) + "/" + entry.path().filename().string()] =
                        read_text(entry.path());
        }
        const CommandRun started =
            run(disk, {"-C", "/r", "init", "--source", "source_core/kernels/*", "--target", "target_core/kernels/*"});
        ASSERT_EQ(started.exit_code, 0) << started.err;
        ASSERT_EQ(check(disk)["verdict"], "in_step");
        const ReadMap map = read_map("portmap.toml", disk.files["/r/portmap.toml"]);
        for (const MapPair& pair : map.map.pairs) paired.insert(pair.source);
        for (const auto& [path, text] : disk.files) {
            if (!path.starts_with("/r/source_core/kernels/")) continue;
            const ScannedFile file = scan_text(path.substr(3), text);
            for (const Unit& unit : file.units)
                if ((unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel) &&
                    paired.contains(unit_id(file, unit)))
                    bodies.push_back({path, file.lexed.text, file, unit});
        }
        ASSERT_GT(bodies.size(), 20u);
    }

    /// Makes `count` edits by turns of the given kinds; calls judge(kind, body, verdict).
    template <class Judge>
    void mutate(const std::vector<std::pair<std::string, Mutation>>& kinds, int count, const Judge& judge) {
        const char* seed = std::getenv("PORTTOOL_SEED");  // another one, to look further
        Random random(seed != nullptr ? static_cast<unsigned>(std::atoi(seed)) : 4711u);
        for (int made = 0, tries = 0; made < count && tries < 100 * count; ++tries) {
            const auto& [name, mutation] = kinds[static_cast<size_t>(tries) % kinds.size()];
            const Body& body = bodies[random() % bodies.size()];
            const std::string text = mutation(body, random);
            if (text.empty() || text == body.text) continue;
            ++made;
            disk.files[body.path] = text;
            judge(name, body, check(disk), text);
            disk.files[body.path] = body.text;
        }
    }

    MemoryDisk disk;
    std::set<std::string> paired;
    std::vector<Body> bodies;
};

TEST_F(Mutations, NoCosmeticEditIsFlagged) {
    const int kCount = 120 / kLighter;
    int made = 0;
    mutate({{"comment", add_comment},
            {"space", add_space},
            {"number", respell_number},
            {"braces", change_braces},
            {"rename", rename_local},
            {"order", swap_functions}},
           kCount,
           [&](const std::string& kind, const Body& body, const nlohmann::json& report, const std::string& text) {
               ++made;
               EXPECT_EQ(report["verdict"], "in_step")
                   << kind << " in " << body.path << " " << body.unit.name << report.dump(1) << text;
           });
    EXPECT_EQ(made, kCount);
}

TEST_F(Mutations, EverySemanticEditIsFound) {
    const int kCount = 200 / kLighter;
    int made = 0;
    mutate({{"number", change_number},
            {"operator", change_operator},
            {"guard", add_guard},
            {"drop", drop_statement},
            {"call", swap_call},
            {"arguments", swap_arguments},
            {"other local", use_other_local},
            {"moved", move_statement}},
           kCount, [&](const std::string& kind, const Body& body, const nlohmann::json& report, const std::string&) {
               ++made;
               ASSERT_EQ(report["verdict"], "drift")
                   << kind << " in " << body.path << " " << body.unit.name << report.dump(1);
               ASSERT_FALSE(report["findings"].empty());
               EXPECT_EQ(report["findings"][0]["source"]["id"], unit_id(body.file, body.unit)) << kind;
           });
    EXPECT_EQ(made, kCount);
}

/// Heads of every kind with an operator (`@`) before a global, which our kernels do not have.
std::string file_of_heads(const std::string& op) {
    const std::vector<std::string> heads = {"if (a @ gA) r = 1.0f;",
                                            "if (r > 0.5f && a @ gA) r = 2.0f;",
                                            "if (b) r = 3.0f; else if (a @ gA) r = 4.0f;",
                                            "for (int i = 0; i @ gA; ++i) r += 5.0f;",
                                            "for (int i = 0; i < 4 && a @ gA; ++i) r += 6.0f;",
                                            "for (; a @ gA;) r -= 7.0f;",
                                            "while (gX @ gA) r -= 8.0f;",
                                            "do r -= 9.0f; while (a @ gA);",
                                            "switch (a @ gA) { case 1: r = 10.0f; break; default: r = 11.0f; }",
                                            "if (a @ gA[2]) r = 12.0f;",
                                            "if (visible(a) @ gA(b)) r = 13.0f;",
                                            "gX @ gA; r += 14.0f;"};
    std::string text;
    for (size_t i = 0; i < heads.size(); ++i)
        text += "float head_" + std::to_string(i) + "(int a, int b) {\n    float r = " + std::to_string(i) +
                ".5f;\n    " + replaced(heads[i], "@", op) + "\n    return r;\n}\n";
    return text;
}

/// The places where `text` has `word`.
std::vector<size_t> places_of(const std::string& text, const std::string& word) {
    std::vector<size_t> places;
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) places.push_back(at);
    return places;
}

TEST(HeadMutations, AnotherNameBehindAnOperatorIsFound) {
    constexpr size_t kHeads = 12;
    for (const char* suffix : {".cu", ".cl", ".hlsl"})
        for (const char* op : {"<", ">", "<=", ">=", "==", "!=", "&&", "||", "&", "|", "^", "*", "-", "%", "and", "or",
                               "xor", "not_eq", "bitand"}) {
            const std::string text = file_of_heads(op), path = std::string("/r/src/k") + suffix;
            MemoryDisk disk;
            disk.files = {{path, text}, {"/r/port/k.cpp", text}};
            run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"});
            ASSERT_EQ(check(disk)["verdict"], "in_step") << op << suffix;
            const std::vector<size_t> places = places_of(text, "gA");
            ASSERT_EQ(places.size(), kHeads);
            for (const char* other : {"gB", "b"}) {
                std::string edited = text;  // each in a function of its own
                for (auto place = places.rbegin(); place != places.rend(); ++place) edited.replace(*place, 2, other);
                disk.files[path] = edited;
                const nlohmann::json report = check(disk);
                std::set<std::string> found;
                for (const nlohmann::json& finding : report["findings"])
                    if (finding["level"] == "error") found.insert(finding["source"]["id"].get<std::string>());
                EXPECT_EQ(found.size(), kHeads) << op << suffix << " -> " << other << report.dump(1);
            }
        }
}

}  // namespace
}  // namespace porttool::testing::mutation_test
