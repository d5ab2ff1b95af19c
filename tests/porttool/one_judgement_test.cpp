// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// `check` and `history` judge a pair by one routine: what one calls a finding is open debt to the other.
#include <set>

#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::one_judgement_test {
namespace {

/// A pair when last in step and now. Whether it drifted is told by what the code means, not by what porttool says.
struct Row {
    const char* says;
    const char *source_file, *target_file;
    std::string source_before, source_now, target_before, target_now;
    bool drifted;
};

std::string unit(const std::string& body) { return "float N(float a, int n) {\n" + body + "    return a * a;\n}\n"; }

std::vector<Row> rows() {
    const std::string was_int = "const int N = 16;\n", was_struct = "struct N { float was; };\n";
    const std::string was = unit("    a = a * 2.0f;\n"), was_glsl = unit("    a = a * 2.0;\n");
    const auto line = [](const std::string& text) { return unit("    a = a * 2.0f;\n    " + text + "\n"); };
    const auto line_glsl = [](const std::string& text) { return unit("    a = a * 2.0;\n    " + text + "\n"); };
    return {
        {"one value in two spellings", "a.cu", "a.comp", "#define N 16u\n", "#define N 32u\n", "const uint N = 16u;\n",
         "const uint N = 1u << 5;\n", false},
        {"two values", "b.cu", "b.comp", was_int, "const int N = 32;\n", was_int, "const int N = 64;\n", true},
        {"a name is no value", "c.cu", "c.comp", was_int, "const int N = MOST;\n", was_int, "const int N = 64;\n",
         true},
        {"another spelling on one side alone", "d.cu", "d.comp", was_int, "const int N = 1 << 4;\n", was_int, was_int,
         true},
        {"another value on one side alone", "e.cu", "e.comp", was_int, was_int, was_int, "const int N = 17;\n", true},
        {"back where the other side stands", "f.cu", "f.comp", was_int, "const int N = 17;\n", "const int N = 17;\n",
         "const int N = 17;\n", true},
        {"the same fields", "g.cu", "g.comp", was_struct, "struct N { float3 o, d; unsigned int k; };\n", was_struct,
         "struct N { vec3 o; vec3 d; uint k; };\n", false},
        {"fields in another order", "h.cu", "h.comp", was_struct, "struct N { float3 o; float d; };\n", was_struct,
         "struct N { float d; vec3 o; };\n", true},
        {"a field on one side alone", "i.cu", "i.comp", was_struct, "struct N { float was; float more; };\n",
         was_struct, was_struct, true},
        {"float against double", "j.cu", "j.cpp", was, unit("    a = a * 3.0f;\n"), was, unit("    a = a * 3.0;\n"),
         true},
        {"float on both sides of C", "k.cu", "k.cpp", was, unit("    a = a * 3.0f;\n"), was, unit("    a = a * 3.f;\n"),
         false},
        {"GLSL has no suffix", "l.cu", "l.comp", unit("    a = a * 6.0f;\n"), unit("    a = a * 3.0f;\n"),
         unit("    a = a * 6.0;\n"), unit("    a = a * 3.0;\n"), false},
        {"another number in GLSL", "m.cu", "m.comp", was, unit("    a = a * 3.0f;\n"), was_glsl,
         unit("    a = a * 4.0;\n"), true},
        {"abs is for floats in GLSL", "n.cu", "n.comp", was, line("a = fabsf(a);"), was_glsl, line_glsl("a = abs(a);"),
         false},
        {"abs may be for integers in C", "o.cu", "o.cpp", was, line("a = fabsf(a);"), was, line("a = abs(a);"), true},
        {"one cast in two spellings", "p.cu", "p.comp", was, line("a += (float)n;"), was_glsl,
         line_glsl("a += float(n);"), false},
        {"two casts", "q.cu", "q.comp", was, line("a += (float)(int)a;"), was_glsl, line_glsl("a += float(uint(a));"),
         true},
        {"one statement, and another", "r.cu", "r.comp", was, line("a += 1.0f;"), was_glsl, line_glsl("a -= 1.0;"),
         true},
        {"more on one side", "s.cu", "s.comp", was, line("a += 1.0f;"), was_glsl, line_glsl("a += 1.0; a /= 3.0;"),
         true},
        {"the source alone", "t.cu", "t.comp", was, line("a += 1.0f;"), was_glsl, was_glsl, true},
        {"the port alone", "u.cu", "u.comp", was, was, was_glsl, line_glsl("a += 1.0;"), true},
        {"looks alone", "v.cu", "v.comp", line("float b = a; a = b;"), "// A comment.\n" + line("float c = a; a = c;"),
         was_glsl, was_glsl, false},
        {"nothing", "w.cu", "w.comp", was, was, was_glsl, was_glsl, false},
        {"new locals by two names", "x.cu", "x.comp", was, line("float b = a + 1.0f; a = b * n;"), was_glsl,
         line_glsl("float q = a + 1.0; a = q * n;"), false},
    };
}

class OneJudgement : public TemporaryRepository {
protected:
    void SetUp() override {
        TemporaryRepository::SetUp();
        if (IsSkipped()) return;
        std::string map = "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n";
        for (const Row& row : rows()) {
            write(source(row), row.source_before);
            write(target(row), row.target_before);
            map += "[[pair]]\nsource = \"" + source(row) + ":N\"\ntarget = \"" + target(row) + ":N\"\n";
        }
        ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
        write("portmap.toml", map);
        ASSERT_EQ(porttool({"accept", "--all", "--force"}).exit_code, 0);
        commit("In step", 1);
    }
    static std::string source(const Row& row) { return std::string("src/") + row.source_file; }
    static std::string target(const Row& row) { return std::string("port/") + row.target_file; }

    /// The pairs that `check` has findings of, at warning or error.
    std::set<std::string> found(const std::string& folder = "") {
        std::set<std::string> out;
        const nlohmann::json report = nlohmann::json::parse(porttool({"check", "--format", "json"}, folder).out);
        for (const nlohmann::json& finding : report["findings"])
            if (finding["level"] != "note") out.insert(finding["source"]["id"].get<std::string>());
        return out;
    }
    std::set<std::string> open(const std::string& folder = "") {
        std::set<std::string> out;
        const nlohmann::json history = json({"history"}, folder);
        for (const nlohmann::json& pair : history["open"]) out.insert(pair["source"].get<std::string>());
        return out;
    }
};

TEST_F(OneJudgement, HistoryHasDebtWhereCheckHasFindings) {
    EXPECT_EQ(found(), std::set<std::string>());
    EXPECT_EQ(open(), std::set<std::string>());
    for (const Row& row : rows()) {
        write(source(row), row.source_now);
        write(target(row), row.target_now);
    }
    commit("Edited", 2);
    const std::set<std::string> findings = found(), debt = open();
    for (const Row& row : rows()) {
        EXPECT_EQ(findings.contains(source(row) + ":N"), row.drifted) << "check: " << row.says;
        EXPECT_EQ(debt.contains(source(row) + ":N"), row.drifted) << "history: " << row.says;
    }
}

TEST_F(OneJudgement, ATextThatCannotBeTrustedIsInStepToNeither) {
    const Row row{"", "l.cu", "l.comp", "", unit("    a = a * 3.0f;\n"), "", unit("    a = a * 3.0;\n"), true};
    for (const auto& file : std::filesystem::directory_iterator(root / "portmap.base"))
        if (read_text(file.path().string()).find(" 6") != std::string::npos) std::ofstream(file.path()) << "a = 7f ;\n";
    write(source(row), row.source_now);
    write(target(row), row.target_now);
    commit("Edited, and the record, too", 2);
    git("clone -q --depth 1 'file://" + root.string() + "' shallow");  // or history knows the text from a commit
    const std::string shallow = (root / "shallow").string();
    EXPECT_EQ(found(shallow), std::set<std::string>{"src/l.cu:N"});
    EXPECT_EQ(open(shallow), std::set<std::string>{"src/l.cu:N"});
}

TEST_F(OneJudgement, WhatIsTooLongToCompareIsOpenToBoth) {
    std::string body;
    for (int i = 0; i < 160'000; ++i) body += "a;";
    const Row row{"", "l.cu", "l.comp", "", unit(body), "", unit(body), true};
    write(source(row), row.source_now);
    write(target(row), row.target_now);
    commit("Long", 2);
    EXPECT_EQ(found(), std::set<std::string>{"src/l.cu:N"});
    EXPECT_EQ(open(), std::set<std::string>{"src/l.cu:N"});
    EXPECT_EQ(open(), std::set<std::string>{"src/l.cu:N"}) << "from the cache";
}

}  // namespace
}  // namespace porttool::testing::one_judgement_test
