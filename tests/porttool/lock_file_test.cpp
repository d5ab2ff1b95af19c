// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The lock: its layout, what is refused in it, and that git merges it by itself.
#include "porttool/read/lock_file.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "porttool/normal/unit_state.h"
#include "porttool/scan/scan.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::lock_file_test {
namespace {

const std::string kPrint = "0123456789abcdef", kOther = "fedcba9876543210";

LockFile sample() {
    LockFile lock;
    const Print print = Print::read(kPrint), another = Print::read(kOther);
    const Fingerprints a{print, print, another}, b{another, another, print};
    lock.pairs = {{"s/a.cl:f", "t/a.cpp:f", a, b, "recorded", "", {}},
                  {"s/%09\t.cl:g", "t/\n.cpp:g", b, a, "verified", "accept 2026-11-22", {}}};
    lock.pairs[1].more["later"] = "a\tb=%";
    lock.baseline = {{"s/a.cl:h", {print, {}, {}}, "host only", "source", {}},
                     {"t/a.cpp:k", {print, another, another}, "", "target:cpu", {}}};
    lock.baseline[1].more["seen"] = "1";
    lock.ledger = {{Verdict::Defer, "s/a.cl:f", "t/a.cpp:f", print, {}, "me", "2030-01-01", "later", {}}};
    return lock;
}

TEST(LockFile, ComesBackAsItWasWrittenWithFieldsOfLaterVersions) {
    const std::string text = lock_text(sample());
    const ReadLock read = read_lock(text);
    ASSERT_EQ(read.error, "");
    EXPECT_EQ(lock_text(read.lock), text);
    ASSERT_EQ(read.lock.pairs.size(), 2u);
    const LockedPair& pair = read.lock.pairs[read.lock.pairs[0].state == "verified" ? 0 : 1];
    EXPECT_EQ(pair.source, "s/%09\t.cl:g");
    EXPECT_EQ(pair.target, "t/\n.cpp:g");
    EXPECT_EQ(pair.by, "accept 2026-11-22");
    ASSERT_NE(pair.more.find("later"), pair.more.end());
    EXPECT_EQ(pair.more.find("later")->second, "a\tb=%");
    EXPECT_EQ(read.lock.baseline.size(), 2u);
    EXPECT_EQ(read.lock.ledger[0].owner, "me");
}

TEST(LockFile, AnEmptyStateIsTheUsualOne) {
    const std::string text = replaced(lock_text(sample()), "state=recorded", "state=");
    const ReadLock read = read_lock(text);
    ASSERT_EQ(read.error, "");
    EXPECT_EQ(lock_text(read.lock), lock_text(sample()));
}

TEST(LockFile, HasOneSortedLineForEachFact) {
    std::istringstream lines(lock_text(sample()));
    std::vector<std::string> body;
    size_t facts = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line[0] == '#' || line.starts_with("porttool-lock") || line.starts_with("normal-form")) continue;
        body.push_back(line);
        facts += line.find('\t') != std::string::npos ? 1 : 0;
    }
    EXPECT_EQ(facts, 5u);
    EXPECT_TRUE(std::is_sorted(body.begin(), body.end()));
    for (size_t i = 1; i < body.size(); ++i)
        EXPECT_TRUE(body[i - 1].substr(0, 8) == body[i].substr(0, 8) || body[i].find('\t') == std::string::npos)
            << "between facts of different ids stands a line that no change touches: " << body[i];
}

TEST(LockFile, EveryPrintIsCheckedBeforeItBecomesAPath) {
    for (const std::string bad : {"../.git/config", "/etc/passwd", "..", "0123456789abcdeF", "0123456789abcde",
                                  "0123456789abcdef0", "0123456789abcde/", "", "0123456789abcde\xC3\xA9"}) {
        for (const char* version : {"porttool-lock\t1\n", "porttool-lock\t2\nnormal-form\t2\n01234567\t"}) {
            for (size_t place = 0; place < 6; ++place) {
                std::string line = version + std::string("pair\ta:f\tb:f");
                for (size_t i = 0; i < 6; ++i) line += "\t" + (i == place ? bad : kPrint);
                EXPECT_NE(read_lock(line + "\n").error.find("is no fingerprint"), std::string::npos) << line;
            }
        }
        for (const std::string& line : {"baseline\ta:f\t" + bad, "accept\ta:f\tb:f\t" + bad + "\t-\t\t2026-01-01\tx"})
            EXPECT_NE(read_lock("porttool-lock\t1\n" + line + "\n").error, "") << line;
    }
}

TEST(LockFile, WhatIsNoneIsNamedWithItsLine) {
    const auto error = [](const std::string& lines) { return read_lock("porttool-lock\t2\n" + lines).error; };
    EXPECT_THAT(error("normal-form\t5\n"),
                ::testing::HasSubstr("portmap.lock:2: its fingerprints are of normal form 5"));
    EXPECT_THAT(error("normal-form\tx\n"), ::testing::HasSubstr("portmap.lock:2: cannot be read"));
    EXPECT_THAT(error("00000000\tdefer\ta:f\tb:f\t-\t-\tme\tnever\tx\n"), ::testing::HasSubstr("'never' is no date"));
    EXPECT_THAT(error("000\n0000\n"), ::testing::HasSubstr("portmap.lock:3: cannot be read: '0000'"));
    EXPECT_THAT(error("00000000\tpear\ta\tb\n"), ::testing::HasSubstr("cannot be read"));
    EXPECT_THAT(read_lock("porttool-lock\t3\n").error, ::testing::HasSubstr("another version"));
}

TEST(LockFile, OneThatIsCutShortIsRefused) {
    const std::string text = lock_text(sample());
    for (const size_t size : {text.size() - 5, text.size() / 2, size_t{1000}, size_t{40}}) {
        const size_t line = text.rfind('\n', size) + 1;  // also where no line is cut
        EXPECT_NE(read_lock(text.substr(0, line)).error, "") << line;
        EXPECT_NE(read_lock(text.substr(0, size)).error, "") << size;
    }
}

TEST(Fingerprint, IsReadBackFromItsDigits) {
    EXPECT_EQ(Print::read(kPrint).bits(), 0x0123456789abcdefull);
    for (const std::string& digits : {kPrint, kOther, std::string("0000000000000001")}) {
        EXPECT_TRUE(Print::read(digits).is_known());
        EXPECT_EQ(Print::read(digits).text(), digits);
    }
    EXPECT_LT(Print::read(kPrint), Print::read(kOther));  // as their texts
    for (const char* none : {"", "-", "0123456789abcde", "0123456789abcdef0", "0123456789ABCDEF", "0123456789abcdeg",
                             "0x23456789abcdef", "0000000000000000"}) {
        EXPECT_FALSE(Print::read(none).is_known()) << none;
        EXPECT_EQ(Print::read(none).text(), "-") << none;
    }
}

// The published vector of SipHash-2-4-64 (Aumasson and Bernstein 2012, appendix A): key 00..0f, message 00..0e.
TEST(Fingerprint, IsTheSipHashThatWasPublished) {
    SipHash hash({0x0706050403020100ull, 0x0f0e0d0c0b0a0908ull});
    hash.word(0x0706050403020100ull);
    EXPECT_EQ(hash.finish(0x0f0e0d0c0b0a0908ull), 0xa129ca6149be45e5ull);
}

TEST(Fingerprint, TellsTextsApartByWhereTheyEnd) {
    const auto of = [](const std::vector<std::string>& texts) {
        Fingerprinter print;
        for (const std::string& text : texts) print.add(text);
        return print.digits();
    };
    const std::vector<std::vector<std::string>> all = {{},
                                                       {""},
                                                       {"", ""},
                                                       {"a", "b"},
                                                       {"ab"},
                                                       {"b", "a"},
                                                       {std::string(7, 'a')},
                                                       {std::string(8, 'a')},
                                                       {std::string(15, 'a')},
                                                       {std::string(16, 'a')},
                                                       {std::string(254, 'a')},
                                                       {std::string(255, 'a')},
                                                       {std::string(256, 'a')},
                                                       {std::string(255, 'a'), "a"},
                                                       {std::string("a\0", 2)},
                                                       {"a"}};
    std::set<std::string> seen;
    for (const auto& texts : all) {
        EXPECT_TRUE(is_fingerprint(of(texts)));
        seen.insert(of(texts));
    }
    EXPECT_EQ(seen.size(), all.size());
}

// If this fails, recorded texts look edited after an update of porttool: raise kNormalForm.
TEST(Fingerprint, OfATextStaysTheSameAsLongAsTheNormalFormDoes) {
    const ScannedFile file = scan_text("a.cl", "float f(float x, int n) { if (n > 0x10) x = x * 2.0f; return x; }\n");
    const UnitState unit = unit_state(file, file.units.at(0));
    EXPECT_EQ(unit.text.recorded(), "float @ ( float x , int n ) {\nif ( n > 16 ) {\nx = x * 2f ;\n}\nreturn x ;\n}\n");
    EXPECT_EQ(prints_of_text(unit.text), unit.prints) << "told from the text alone";
}

/// A repository with some pairs, one function a pair, all in one file a side.
class MergedLock : public TemporaryRepository {
protected:
    static std::string side(const std::vector<int>& factors, const char* head) {
        std::string text;
        for (size_t i = 0; i < factors.size(); ++i)
            text += std::string(head) + "float work_" + std::to_string(i) +
                    "(float x, float y) {\n    float sum = x * " + std::to_string(i) + ".5f;\n    sum += y * " +
                    std::to_string(factors[i]) + ".0f;\n    return sum;\n}\n\n\n\n";
        return text;
    }
    void write_sides(const std::vector<int>& factors) {
        write("src/a.cu", side(factors, "__device__ "));
        write("port/a.cpp", side(factors, ""));
    }
    void start(size_t pairs) {
        values.assign(pairs, 1);
        write_sides(values);
        ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
        commit("start");
    }
    std::string id(size_t i) const { return "src/a.cu:work_" + std::to_string(i); }

    std::vector<int> values;
};

TEST_F(MergedLock, TwentyBranchesThatAcceptTwentyPairsMergeInAnyOrder) {
    constexpr size_t kBranches = 20;
    start(kBranches);
    for (size_t i = 0; i < kBranches; ++i) {
        git("checkout -q -b b" + std::to_string(i) + " main");
        std::vector<int> mine = values;
        mine[i] = 100 + static_cast<int>(i);
        write_sides(mine);
        ASSERT_EQ(porttool({"check"}).exit_code, 0);
        const bool reason = i % 3 == 0;  // a verdict of its own beside the pair's line
        ASSERT_EQ(porttool(reason ? std::vector<std::string>{"accept", id(i), "--reason", "it is right"}
                                  : std::vector<std::string>{"accept", id(i)})
                      .exit_code,
                  0);
        commit("branch " + std::to_string(i));
    }
    std::mt19937 random(7);
    for (int round = 0; round < 3; ++round) {
        std::vector<size_t> order(kBranches);
        std::iota(order.begin(), order.end(), size_t{0});
        std::shuffle(order.begin(), order.end(), random);
        git("checkout -q -B merged main");
        for (const size_t i : order) git("merge -q --no-edit b" + std::to_string(i));
        const auto got = json({"check"});
        EXPECT_EQ(got["verdict"], "in_step") << got.dump(1);
        EXPECT_EQ(got["summary"]["in_step"], kBranches);
        write("src/a.cu", replaced(read_text(root / "src/a.cu"), "100.0f", "7.0f"));
        EXPECT_EQ(porttool({"check"}).exit_code, 1) << "the merged lock watches";
        git("checkout -q -- src");
    }
}

TEST_F(MergedLock, TwentyBranchesThatAddTwentyPairsMergeInAnyOrder) {
    constexpr int kBranches = 20;
    const auto add_file = [&](const std::string& name) {
        const std::string text =
            "float " + name + "(float x, float y) {\n    float sum = x * 0.5f;\n    return sum + y;\n}\n";
        write("src/" + name + ".cu", "__device__ " + text);
        write("port/" + name + ".cpp", text);
    };
    const auto name_of = [](int i, const char* more) { return "f" + std::to_string(100 + i) + more; };
    for (int i = 0; i < kBranches; ++i) add_file(name_of(i, ""));
    ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    std::string map = read_text(root / "portmap.toml");
    map.insert(map.rfind("\n[[pair]]", map.find("src/f105.cu")),
               "\n# a remark\n\n[rules]\norphaned = \"error\"\n\n# of this pair");
    write("portmap.toml", map);
    commit("start");
    for (int i = 0; i < kBranches; ++i) {
        const std::string name = name_of(i, i == 0 ? "" : "x"), fresh = i == 0 ? "f099" : name;
        git("checkout -q -b b" + std::to_string(i) + " main");
        add_file(fresh);
        ASSERT_EQ(porttool({"accept", "src/" + fresh + ".cu:" + fresh + "=port/" + fresh + ".cpp:" + fresh}).exit_code,
                  0);
        const std::string block = "\n[[pair]]\nsource = \"src/" + fresh + ".cu:" + fresh + "\"\ntarget = \"port/" +
                                  fresh + ".cpp:" + fresh + "\"\n";
        EXPECT_EQ(replaced(read_text(root / "portmap.toml"), block, ""), map) << "all else stays as it was written";
        commit("branch " + std::to_string(i));
    }
    std::mt19937 random(3);
    for (int round = 0; round < 2; ++round) {
        std::vector<int> order(kBranches);
        std::iota(order.begin(), order.end(), 0);
        std::shuffle(order.begin(), order.end(), random);
        git("checkout -q -B merged main");
        for (const int i : order) git("merge -q --no-edit b" + std::to_string(i));
        const auto got = json({"check", "--strict"});
        EXPECT_EQ(got["summary"]["in_step"], 2 * kBranches) << got.dump(1);
    }
}

TEST_F(MergedLock, NeighboursInTheMapAreMergedByOneCommand) {
    constexpr int kBranches = 20;
    const auto add_file = [&](const std::string& name) {
        const std::string text = "float " + name + "(float x) {\n    return x * 2.0f;\n}\n";
        write("src/" + name + ".cu", "__device__ " + text);
        write("port/" + name + ".cpp", text);
    };
    for (const char* name : {"a", "b", "z"}) add_file(name);
    ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    commit("start");
    const auto name_of = [](int i) { return "n" + std::to_string(100 + i); };
    for (int i = 0; i < kBranches; ++i) {
        git("checkout -q -b b" + std::to_string(i) + " main");
        add_file(name_of(i));
        const std::string pair =
            "src/" + name_of(i) + ".cu:" + name_of(i) + "=port/" + name_of(i) + ".cpp:" + name_of(i);
        ASSERT_EQ(porttool({"accept", pair}).exit_code, 0);
        commit("branch " + std::to_string(i));
    }
    std::mt19937 random(5);
    for (const char* style : {"merge", "diff3", "zdiff3"}) {
        std::vector<int> order(kBranches);
        std::iota(order.begin(), order.end(), 0);
        std::shuffle(order.begin(), order.end(), random);
        git("checkout -q -B merged main && git config merge.conflictStyle " + std::string(style));
        int conflicts = 0;
        for (const int i : order) {
            const std::string merge = "cd '" + root.string() + "' && git merge -q --no-edit b" + std::to_string(i);
            if (std::system((merge + " > /dev/null 2>&1").c_str()) == 0) continue;
            ++conflicts;
            const CommandRun checked = porttool({"check"});
            EXPECT_EQ(checked.exit_code, 2);
            EXPECT_NE(checked.err.find("accept --merge"), std::string::npos) << checked.err;
            const CommandRun merged = porttool({"accept", "--merge"});
            ASSERT_EQ(merged.exit_code, 0) << merged.err;
            EXPECT_NE(merged.out.find(name_of(i)), std::string::npos) << merged.out;
            git("add portmap.toml && git commit -q --no-edit");  // which fails where the lock conflicts, too
        }
        EXPECT_GT(conflicts, 0);
        const auto got = json({"check", "--strict"});
        EXPECT_EQ(got["summary"]["in_step"], 3 + kBranches) << got.dump(1);
    }
}

/// The ids of the source that the pairs of a map name, told from its lines.
std::set<std::string> paired_sources(const std::string& map) {
    std::set<std::string> out;
    std::istringstream lines(map.substr(map.find("[[pair]]")));
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("source = ")) out.insert(line.substr(10, line.find('"', 10) - 10));
    return out;
}

std::string with_carriage_returns(const std::string& text) {
    std::string out;
    for (const char letter : text) out += letter == '\n' ? "\r\n" : std::string(1, letter);
    return out;
}

/// A map that git leaves in conflict: one side takes a pair out beside which the other writes a new one. The removed
/// pair stays out whichever side is ours, the ends of lines stay as they are, and a map behind a link is the file that
/// git is told of.
TEST_F(MergedLock, APairThatOneSideOfAMergeTookOutStaysOut) {
    for (const char* name : {"a", "m", "n", "z"})
        for (const char* file : {"src/%.cu", "port/%.cpp"})
            write(replaced(file, "%", name), "float " + std::string(name) + "(float x) { return x; }\n");
    ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    const std::string all = read_text(root / "portmap.toml");
    const auto pair = [](const std::string& name) {
        return "\n[[pair]]\nsource = \"src/" + name + ".cu:" + name + "\"\ntarget = \"port/" + name + ".cpp:" + name +
               "\"\n";
    };
    const std::string head = all.substr(0, all.find("\n[[pair]]"));
    for (const bool is_windows : {false, true})
        for (const bool is_linked : {false, true})
            for (const bool is_ours : {false, true})
                for (const char* style : {"merge", "diff3"}) {
                    const std::string about = std::string(style) + (is_windows ? " CRLF" : " LF") +
                                              (is_linked ? " linked" : "") + (is_ours ? " ours" : " theirs");
                    const std::string file = is_linked ? "config/map.toml" : "portmap.toml";
                    const auto put = [&](const std::string& text) {
                        write(file, is_windows ? with_carriage_returns(text) : text);
                    };
                    git("checkout -q -B main && rm -rf portmap.toml config && git config merge.conflictStyle " +
                        std::string(style));
                    put(head + pair("a") + pair("m") + pair("z"));
                    if (is_linked) std::filesystem::create_symlink(file, root / "portmap.toml");
                    commit("start " + about);
                    git("checkout -q -B out");
                    put(head + pair("a") + pair("z"));
                    commit("out");
                    git("checkout -q -B in main");
                    put(head + pair("a") + pair("m") + pair("n") + pair("z"));
                    commit("in");
                    git(std::string("checkout -q -B merged ") + (is_ours ? "out" : "in"));
                    const std::string merge = "cd '" + root.string() + "' && git merge -q --no-edit ";
                    ASSERT_NE(std::system((merge + (is_ours ? "in" : "out") + " > /dev/null 2>&1").c_str()), 0)
                        << about;
                    const CommandRun got = porttool({"accept", "--merge"});
                    ASSERT_EQ(got.exit_code, 0) << about << got.err;
                    EXPECT_EQ(paired_sources(read_text(root / file)),
                              (std::set<std::string>{"src/a.cu:a", "src/n.cu:n", "src/z.cu:z"}))
                        << about << "\n"
                        << got.out;
                    const std::string text = read_text(root / file);
                    EXPECT_EQ(std::count(text.begin(), text.end(), '\r'),
                              is_windows ? std::count(text.begin(), text.end(), '\n') : 0)
                        << about << "\n"
                        << text;
                    EXPECT_EQ(std::filesystem::is_symlink(root / "portmap.toml"), is_linked) << about;
                    const size_t command = got.out.find("git add ");
                    ASSERT_NE(command, std::string::npos) << about << got.out;
                    git(got.out.substr(command + 4, got.out.find('\n', command) - command - 4) +
                        " && git commit -q --no-edit");
                }
}

TEST_F(MergedLock, PairsComeIntoAMapWithTheEndsOfItsLines) {
    start(2);
    write("src/b.cu", "float b(float x) { return x; }\n");
    write("port/b.cpp", "float b(float x) { return x; }\n");
    write("portmap.toml", with_carriage_returns(read_text(root / "portmap.toml")));
    const std::string before = read_text(root / "portmap.toml");
    ASSERT_EQ(porttool({"accept", "src/b.cu:b=port/b.cpp:b"}).exit_code, 0);
    const std::string text = read_text(root / "portmap.toml");
    EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), std::count(text.begin(), text.end(), '\n')) << text;
    EXPECT_NE(text, before);
    EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0);
}

/// What is not there cannot be in step.
TEST_F(MergedLock, APairThatIsNotThereIsNotRecorded) {
    start(3);
    struct Row {
        const char* what;
        std::string source, target;  ///< their texts; empty: no such file
        bool is_there;
    };
    const std::string source = read_text(root / "src/a.cu"), target = read_text(root / "port/a.cpp");
    const std::string other = "void other() { return; }\n";
    const std::vector<Row> rows = {{"both", replaced(source, "1.5f", "3.5f"), target, true},
                                   {"no file of the source", "", target, false},
                                   {"no file of the port", source, "", false},
                                   {"neither", "", "", false},
                                   {"no unit of the source", other, target, false},
                                   {"no unit of the port", source, other, false},
                                   {"a source that is no text", source + std::string(1, '\0'), target, false},
                                   {"a port that is no text", source, target + std::string(1, '\0'), false}};
    for (const Row& row : rows) {
        git("checkout -qf . && git clean -qfd");
        for (const char* file : {"src/z.cu", "port/z.cpp"}) write(file, "");  // so that the globs take something
        for (const auto& [file, text] : {std::pair("src/a.cu", row.source), {"port/a.cpp", row.target}})
            if (text.empty())
                std::filesystem::remove(root / file);
            else
                write(file, text);
        const std::string lock = read_text(root / "portmap.lock");
        for (const std::string& id : {id(1), std::string("port/a.cpp:work_1"), id(1) + "=port/a.cpp:work_1"}) {
            const CommandRun got = porttool({"accept", id, "--reason", "seen"});
            EXPECT_EQ(got.exit_code, row.is_there ? 0 : 2) << row.what << " " << id << got.out << got.err;
            EXPECT_EQ(got.err.find("nothing was recorded") == std::string::npos, row.is_there) << row.what << got.err;
            EXPECT_EQ(read_text(root / "portmap.lock") == lock, !row.is_there) << row.what;
        }
    }
    const auto lines_of = [&](const std::string& err) { return std::count(err.begin(), err.end(), '\n'); };
    git("checkout -qf . && git clean -qfd");
    std::filesystem::remove_all(root / "portmap.base");
    write("src/a.cu", other);
    const CommandRun got = porttool({"accept", id(1)});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_LE(lines_of(got.err), 2) << "what could be warned of beside it is left out: " << got.err;
    write("src/a.cu", replaced(source, "2.5f", "7.5f"));
    const CommandRun accepted = porttool({"accept", id(0)});
    EXPECT_EQ(accepted.exit_code, 0);
    EXPECT_EQ(accepted.err.find("missing in portmap.base/") == std::string::npos, false) << accepted.err;
}

TEST_F(MergedLock, AMergeOfMoreThanPairsIsLeftToAPerson) {
    start(3);
    const std::string map = read_text(root / "portmap.toml");
    const auto sides = [](const std::string& ours, const std::string& theirs) {
        return "\n<<<<<<< HEAD\n" + ours + "=======\n" + theirs + ">>>>>>> b\n";
    };
    const std::string pair = "[[pair]]\nsource = \"src/a.cu:x\"\ntarget = \"port/a.cpp:x\"\n";
    for (const std::string& other :
         {std::string("[rules]\norphaned = \"note\"\n"),
          std::string("[[ignore]]\nsource = \"src/*\"\nreason = \"x\"\n"), std::string("no TOML\n")}) {
        write("portmap.toml", map + sides(pair, other));
        const CommandRun got = porttool({"accept", "--merge"});
        EXPECT_EQ(got.exit_code, 2) << other << got.out;
        EXPECT_EQ(read_text(root / "portmap.toml"), map + sides(pair, other));
    }
    for (const std::string& text : {map, map + "\n<<<<<<< HEAD\n" + pair + "=======\n"}) {
        write("portmap.toml", text);
        EXPECT_EQ(porttool({"accept", "--merge"}).exit_code, 2);
    }
    write("portmap.toml", map + sides(pair, replaced(pair, "x\"", "y\"")));
    EXPECT_EQ(porttool({"accept", "--merge"}).exit_code, 0);
    EXPECT_EQ(porttool({"accept", "--merge", "--all"}).exit_code, 2);
}

TEST_F(MergedLock, BranchesWithNewUnitsMergeToo) {
    start(3);
    for (int i = 0; i < 6; ++i) {
        git("checkout -q -b n" + std::to_string(i) + " main");
        const std::string name = "fresh_" + std::to_string(i);
        write("src/" + name + ".cu", "__device__ float " + name + "(float x) { return x; }\n");
        ASSERT_EQ(porttool({"ignore", "src/" + name + ".cu:" + name, "--reason", "host only"}).exit_code, 0);
        commit(name);
    }
    git("checkout -q main");
    for (int i = 0; i < 6; ++i) git("merge -q --no-edit n" + std::to_string(i));
    EXPECT_EQ(json({"check"})["verdict"], "in_step");
}

TEST_F(MergedLock, AcceptancesAtOnceAreAllKept) {
    constexpr size_t kWriters = 8, kRounds = 12;
    start(kWriters);
    for (size_t round = 0; round < kRounds; ++round) {
        for (int& value : values) value += 1;
        write_sides(values);
        std::vector<std::thread> writers;
        std::atomic<int> failed = 0;
        for (size_t i = 0; i < kWriters; ++i)
            writers.emplace_back([&, i] {
                RealDisk own;
                if (run(own, {"-C", root.string(), "accept", id(i), "--reason", "round"}).exit_code != 0) ++failed;
            });
        for (std::thread& writer : writers) writer.join();
        EXPECT_EQ(failed, 0);
        std::string lock = read_text(root / "portmap.lock");
        for (size_t i = 0; i < kWriters; ++i) {
            const UnitState now = unit_state(scan_text("a.cu", read_text(root / "src/a.cu")),
                                             scan_text("a.cu", read_text(root / "src/a.cu")).units.at(i));
            EXPECT_NE(lock.find(id(i) + "\tport/a.cpp:work_" + std::to_string(i) + "\t" + now.prints.written.text()),
                      std::string::npos)
                << "round " << round << " lost " << i;
        }
    }
    EXPECT_FALSE(std::filesystem::exists(root / "portmap.lock.busy"));
}

TEST_F(MergedLock, WhatAKilledWriterLeftIsRemovedByTheNext) {
    start(2);
    write("portmap.lock.busy", "");
    write("portmap.lock.porttool-999999.2", "half");
    write("portmap.toml.porttool-999999.1", "half");
    write("portmap.base/0123456789abcdef.porttool-999999.3", "half");
    write("portmap.base/README", "mine");
    write("portmap.base/.gitattributes", "* -text\n");
    write("portmap.lock.porttool-1", "mine");
    for (const std::vector<std::string>& writer :
         {std::vector<std::string>{"accept", id(0)}, {"ignore", id(1), "--reason", "not needed"}, {"init", "--force"}})
        ASSERT_EQ(porttool(writer).exit_code, 0) << writer[0];
    for (const char* gone : {"portmap.lock.busy", "portmap.lock.porttool-999999.2", "portmap.toml.porttool-999999.1",
                             "portmap.base/0123456789abcdef.porttool-999999.3"})
        EXPECT_FALSE(std::filesystem::exists(root / gone)) << gone;
    for (const char* there : {"portmap.base/README", "portmap.base/.gitattributes", "portmap.lock.porttool-1"})
        EXPECT_TRUE(std::filesystem::exists(root / there)) << there;
}

/// The lock of version 1 for today's sides.
std::string version_1(const std::string& lock, const std::filesystem::path& base) {
    std::map<std::string, std::string> old;
    for (const auto& entry : std::filesystem::directory_iterator(base)) {
        const std::string text = read_text(entry.path());
        const std::string print = fingerprint_of_version_1(NormalText::read(text).words()).text();
        old[entry.path().filename().string()] = print;
        std::filesystem::rename(entry.path(), base / (print + "x"));
    }
    for (const auto& entry : std::filesystem::directory_iterator(base)) {
        const std::string name = entry.path().filename().string();
        std::filesystem::rename(entry.path(), base / name.substr(0, name.size() - 1));
    }
    std::string out = "porttool-lock\t1\n";
    for (const LockedPair& pair : read_lock(lock).lock.pairs) {
        const std::string source = old.at(pair.source_prints.written.text()),
                          target = old.at(pair.target_prints.written.text());
        out += "pair\t" + pair.source + "\t" + pair.target + "\t" + source + "\t" + kPrint + "\t" + kPrint + "\t" +
               target + "\t" + kPrint + "\t" + kPrint + "\n";  // prints of locals as an older form had them
    }
    return out + "pair\tsrc/gone.cu:f\tport/gone.cpp:f" + "\t" + old.begin()->second + "\t" + kPrint + "\t" + kPrint +
           "\t" + old.begin()->second + "\t" + kPrint + "\t" + kPrint + "\n";
}

TEST_F(MergedLock, OfVersionOneIsReadFromItsTextsAndRewritten) {
    start(3);
    write("portmap.lock", version_1(read_text(root / "portmap.lock"), root / "portmap.base"));
    EXPECT_EQ(json({"check"})["verdict"], "in_step");
    std::vector<int> edited = values;
    edited[1] = 9;
    write("src/a.cu", side(edited, "__device__ "));
    const CommandRun drift = porttool({"check"});
    EXPECT_EQ(drift.exit_code, 1);
    EXPECT_NE(drift.out.find("- sum += y * 1f"), std::string::npos) << "the text behind it is found: " << drift.out;
    write("src/a.cu", replaced(side(values, "__device__ "), "float sum = x", "float total = x"));
    std::string renamed = read_text(root / "src/a.cu");
    renamed = replaced(replaced(renamed, "sum += y", "total += y"), "return sum", "return total");
    write("src/a.cu", renamed);
    EXPECT_EQ(json({"check"})["findings"].size(), 0u) << "a renamed local is cosmetic, whatever the old prints were";
    EXPECT_TRUE(read_text(root / "portmap.lock").starts_with("porttool-lock\t1\n")) << "check writes nothing";
    ASSERT_EQ(porttool({"accept", "--all"}).exit_code, 0);
    const std::string lock = read_text(root / "portmap.lock");
    EXPECT_TRUE(lock.starts_with("porttool-lock\t2\n"));
    EXPECT_EQ(lock.find("gone"), std::string::npos) << "lines that hold for nothing go";
    EXPECT_EQ(read_lock(lock).lock.pairs.size(), 3u);
    EXPECT_EQ(json({"check"})["verdict"], "in_step");
}

TEST_F(MergedLock, OfVersionOneWithoutItsTextsIsRefusedWithTheCommandThatHelps) {
    start(2);
    write("portmap.lock", version_1(read_text(root / "portmap.lock"), root / "portmap.base"));
    std::filesystem::remove_all(root / "portmap.base");
    EXPECT_EQ(json({"check"})["verdict"], "in_step") << "the texts are still those of today";
    values[0] = 5;
    write_sides(values);
    const CommandRun got = porttool({"check"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("'src/a.cu:work_0'"), std::string::npos) << got.err;
    EXPECT_NE(got.err.find("porttool init --force"), std::string::npos) << got.err;
    EXPECT_EQ(porttool({"init", "--force"}).exit_code, 0);
    EXPECT_EQ(json({"check"})["verdict"], "in_step");
}

/// A lock of an older normal form is held to what that form saw of a text, until somebody accepts.
TEST_F(MergedLock, OfNormalForm3HoldsWhatThatFormSaw) {
    start(2);
    const std::string lock = read_text(root / "portmap.lock"), source = read_text(root / "src/a.cu");
    const auto check_in_form = [&](const char* form, const std::string& before) {
        write("portmap.lock", replaced(lock, "normal-form\t4\n", std::string("normal-form\t") + form + "\n"));
        write("src/a.cu", before + source);
        return porttool({"check"}).exit_code;
    };
    const std::string weak = "__attribute__((weak)) float work_0(float x, float y);\n";
    struct Row {
        std::string before;
        int in_form_3, in_form_4;
    };
    for (const Row& row :
         {Row{"", 0, 0}, Row{weak, 0, 1}, Row{"float work_0(float x, float y = 2.0f);\n", 1, 1},
          Row{weak + "float work_0(float x, float y = 2.0f);\n", 1, 1}, Row{"#pragma STDC FP_CONTRACT OFF\n", 1, 1}}) {
        EXPECT_EQ(check_in_form("3", row.before), row.in_form_3) << row.before;
        EXPECT_EQ(check_in_form("4", row.before), row.in_form_4) << row.before;
    }
    EXPECT_EQ(check_in_form("3", weak), 0);
    ASSERT_EQ(porttool({"accept", "--all"}).exit_code, 0);
    EXPECT_NE(read_text(root / "portmap.lock").find("\nnormal-form\t4\n"), std::string::npos);
    EXPECT_EQ(porttool({"check"}).exit_code, 0);
    write("src/a.cu", source);
    EXPECT_EQ(porttool({"check"}).exit_code, 1) << "from now on the attribute counts";
}

/// Where both sides are one text in an older form, and are told apart today, each side's line is read as its own.
TEST_F(MergedLock, OfNormalForm3TellsApartWhatThatFormDidNot) {
    start(2);
    const std::string text = "int same_on_both(int a) {\n    int n = a + 1;\n    return n * 7;\n}\n";
    write("src/a.cu", read_text(root / "src/a.cu") + text);
    write("port/a.cpp", read_text(root / "port/a.cpp") + text);
    ASSERT_EQ(porttool({"accept", "src/a.cu:same_on_both=port/a.cpp:same_on_both"}).exit_code, 0);
    const std::string lock = read_text(root / "portmap.lock");
    write("portmap.lock", replaced(lock, "normal-form\t4\n", "normal-form\t3\n"));
    const std::string weak = "__attribute__((weak)) int same_on_both(int a);\n";
    write("src/a.cu", weak + read_text(root / "src/a.cu"));
    EXPECT_EQ(json({"check"})["summary"]["review"], 0) << "the port is what it was";
    EXPECT_EQ(porttool({"check"}).exit_code, 0);
}

/// Builds in between wrote what form 4 is and called it 3.
TEST_F(MergedLock, OfNormalForm3MayHoldPrintsOfForm4) {
    start(1);
    const std::string weak = "__attribute__((weak)) ", lone = "int lone(int a, int b)";
    const std::string body = " {\n    int n = a * b;\n    return n - 7;\n}\n";
    write("src/b.cu", weak + lone + ";\n" + lone + body);
    write("src/a.cu", weak + "float work_0(float x, float y);\n" + read_text(root / "src/a.cu"));
    ASSERT_EQ(porttool({"init", "--force"}).exit_code, 0);
    write("portmap.lock", replaced(read_text(root / "portmap.lock"), "normal-form\t4\n", "normal-form\t3\n"));
    const auto changed = [&] {
        const std::string out = porttool({"check"}).out;
        EXPECT_NE(out.find("in_step"), std::string::npos) << out;
        return out.find("changed here") != std::string::npos;
    };
    EXPECT_FALSE(changed());
    write("src/b.cu", weak + lone + ";\n" + lone + replaced(replaced(body, "int n", "int m"), "return n", "return m"));
    EXPECT_FALSE(changed()) << "a local has another name";
    write("src/b.cu", weak + lone + ";\n" + lone + replaced(body, "a * b", "a + b"));
    EXPECT_TRUE(changed());
    write("src/b.cu", lone + ";\n" + lone + body);
    EXPECT_TRUE(changed()) << "the attribute went";
    write("src/b.cu", weak + lone + ";\n" + lone + body);
    std::filesystem::remove_all(root / "portmap.base");
    EXPECT_FALSE(changed()) << "no text is needed to know that nothing is edited";
}

TEST_F(MergedLock, HistoryReadsLocksOfBothVersions) {
    start(2);
    write("portmap.lock", version_1(read_text(root / "portmap.lock"), root / "portmap.base"));
    commit("as version 1", 2);
    values[1] = 8;
    write("src/a.cu", side(values, "__device__ "));
    commit("drifts", 3);
    write_sides(values);
    ASSERT_EQ(porttool({"accept", "--all"}).exit_code, 0);
    commit("ports", 5);
    const auto got = json({"history", "--no-cache"});
    std::vector<int> open;
    for (const auto& one : got["commits"]) open.push_back(one["drift"]["open_pairs"].get<int>());
    EXPECT_THAT(open, ::testing::ElementsAre(0, 0, 1, 0)) << got.dump(1);
}

}  // namespace
}  // namespace porttool::testing::lock_file_test
