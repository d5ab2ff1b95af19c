// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Texts of others never act: every format of every command is made once with hostile and once with harmless names,
// reasons, owners, blocks, code, subjects and arguments, and read back by parsers of others (read_back.py).
#include <sys/wait.h>

#include <functional>
#include <random>

#include "porttool/text/sink/json.h"
#include "porttool/text/sink/json_rows.h"
#include "porttool/text/sink/markdown.h"
#include "porttool/text/sink/shell.h"
#include "porttool/text/toml_string.h"
#include "tests/porttool/hostile_strings.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::hostile_text_test {
namespace {

using nlohmann::json;
using Strings = std::vector<std::string>;

/// As many texts that act nowhere.
Strings harmless(size_t count) {
    Strings out;
    for (size_t i = 0; i < count; ++i) out.push_back("name" + std::to_string(i));
    return out;
}

/// What a string literal and a comment can hold.
std::string in_one_line(std::string text) {
    std::erase_if(text, [](char c) { return c == '\n' || c == '\r' || c == '"' || c == '\\'; });
    return text;
}

std::string replaced_all(std::string text, const std::string& from, const std::string& to) {
    for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

/// A source of three functions, whose names are told by a number.
std::string source_of(size_t number, const std::string& text) {
    const std::string i = std::to_string(number), literal = "log(\"" + in_one_line(text) + "\"); ";
    return "__device__ float f" + i + "(float a) { " + literal + "return a * " + i + ".5f + 1.25f; }\n" +
           "__device__ float g" + i + "(float a) { float b = a - " + i + ".5f; return b * a; }\n" +
           "__device__ float h" + i + "(float a, float b) { " + literal + "return a / b + " + i + ".75f; }\n";
}

/// Names of units that C++ or a careless compiler allows.
const Strings kUnits = {"operator||",
                        "operator<",
                        "operator~",
                        "operator*",
                        "operator&&",
                        "a\u202e"
                        "b",
                        "x\u200by",
                        "__init__",
                        "operator[]"};

std::string units_of_others(const Strings& names) {
    std::string out;
    for (size_t i = 0; i < names.size(); ++i)
        out += "__device__ bool " + names[i] + "(A a, A b) { return a.x * " + std::to_string(i) + ".5f > b.x; }\n";
    return out;
}

/// A repository in memory with a file of each name on either side, recorded; with a [[block]] and an idle [[ignore]]
/// of each name.
MemoryDisk recorded(const Strings& names, const Strings& units) {
    MemoryDisk disk;
    std::string more = "\n[rules]\ntarget-changed = \"error\"\n";
    for (size_t i = 0; i < names.size(); ++i) {
        disk.files["/r/" + names[i] + ".cu"] = source_of(i, names[i]);
        disk.files["/r/" + names[i] + ".comp"] = replaced_all(source_of(i, names[i]), "__device__ ", "");
        more += "\n[[block]]\nname = " + toml_string(names[i]) + "\nsource = \"units.cu\"\ntarget = \"units.comp\"\n";
        more += "\n[[ignore]]\nid = " + toml_string(names[i] + ":gone") + "\nreason = " + toml_string(names[i]) + "\n";
    }
    disk.files["/r/units.cu"] = units_of_others(units);
    disk.files["/r/units.comp"] = replaced_all(units_of_others(units), "__device__ ", "");
    const CommandRun made = run(disk, {"-C", "/r", "init", "--source", "**/*.cu", "--target", "**/*.comp"});
    if (made.exit_code != 0) throw std::runtime_error(made.err);
    disk.files["/r/portmap.toml"] += more;
    return disk;
}

/// The same with both sides edited: of each file one unit that is open, one that a comment settles and one of which
/// both sides changed.
MemoryDisk drifted(const Strings& names, const Strings& units) {
    MemoryDisk disk = recorded(names, units);
    for (const std::string& name : names) {
        std::string& source = disk.files["/r/" + name + ".cu"];
        source = replaced(source, "log(\"" + in_one_line(name) + "\"); ", "");
        source = replaced(source, " * a; }", " / a; }  // porttool: ignore(source-changed) " + in_one_line(name));
        source = replaced(source, "a / b", "b / a");
        std::string& target = disk.files["/r/" + name + ".comp"];
        target = replaced(target, "a / b", "a / b / b");
    }
    std::string all;  // in one: each command judges the whole project
    for (const std::string& name : names) all += name + " ";
    disk.files["/r/bench.json"] =
        json{{"core", all}, {"device", all}, {"mrays_per_s", {{"total", 5.0}}}, {"embree_limit_mrays_per_s", 10.0}}
            .dump();
    for (const Strings& settled :
         {Strings{"defer", "--owner", all, "--until", "2999-01-01", "--reason", all, "--"},
          Strings{"ignore", "--reason", all, "--"}, Strings{"accept", "--reason", all, "--"}}) {
        Strings arguments = {"-C", "/r"};
        arguments.insert(arguments.end(), settled.begin(), settled.end());
        const size_t i = settled[0] == "defer" ? 0 : settled[0] == "ignore" ? 1 : 2;
        arguments.push_back(names[i] + ".cu:f" + std::to_string(i));
        if (const CommandRun got = run(disk, arguments); got.exit_code != 0) throw std::runtime_error(got.err);
    }
    return disk;
}

/// One output, made twice.
struct Case {
    std::string kind, name, hostile, plain;
    Strings shown;  ///< what a reader of the hostile one must find
    json more = json::object();
};

/// Hands all cases to read_back.py; its lines, in order. The script exits 0 whatever it finds.
Strings read_back(const std::vector<Case>& cases) {
    const auto folder = std::filesystem::temp_directory_path() / ("porttool_hostile_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    json list = json::array();
    for (size_t i = 0; i < cases.size(); ++i) {
        const std::string file = std::to_string(i);
        std::ofstream(folder / (file + ".hostile"), std::ios::binary) << cases[i].hostile;
        std::ofstream(folder / (file + ".harmless"), std::ios::binary) << cases[i].plain;
        json one = {{"file", file}, {"kind", cases[i].kind}, {"name", cases[i].name}, {"shown", cases[i].shown}};
        one.update(cases[i].more);
        list.push_back(one);
    }
    std::ofstream(folder / "cases.json") << list.dump();
    const std::string script = (std::filesystem::path(REPOSITORY) / "tests/porttool/read_back.py").string();
    // The packages of Debian belong to its own Python, which need not be the first.
    const std::string python = std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
    const std::string out = (folder / "problems").string();
    const int status =
        std::system((python + " -B '" + script + "' '" + folder.string() + "' > '" + out + "' 2>&1").c_str());
    Strings lines;
    std::istringstream stream(read_text(out));
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    if (status != 0) lines.push_back("read_back.py failed");
    std::filesystem::remove_all(folder);
    return lines;
}

/// Expects no problem; skips, saying so, where a parser is absent.
void expect_read_back(const std::vector<Case>& cases) {
    if (std::system("python3 --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "python3 is not installed";
    std::string absent;
    for (const std::string& line : read_back(cases)) {
        if (line.starts_with("absent: "))
            absent += (absent.empty() ? "" : ", ") + line.substr(8);
        else
            ADD_FAILURE() << line;
    }
    if (!absent.empty()) GTEST_SKIP() << "not read back for want of " << absent << "; ./setup.sh installs it";
}

class HostileText : public ::testing::Test {
protected:
    static MemoryDisk& hostile_disk() {
        static MemoryDisk disk = drifted(hostile_strings(), kUnits);
        return disk;
    }
    static MemoryDisk& harmless_disk() {
        static MemoryDisk disk = drifted(harmless(hostile_strings().size()), units_as_plain());
        return disk;
    }
    static Strings units_as_plain() {
        Strings out;
        for (size_t i = 0; i < kUnits.size(); ++i) out.push_back("unit" + std::to_string(i));
        return out;
    }
    static Strings files() {
        Strings out;
        for (const std::string& name : hostile_strings()) out.push_back(name + ".cu");
        return out;
    }
    /// Runs a command line in both repositories; stdout as a case, stderr as another where something is on it.
    static void add(std::vector<Case>& cases, const std::string& kind, Strings arguments, const Strings& shown,
                    const json& more = json::object()) {
        std::string name;
        for (const std::string& argument : arguments) name += argument + " ";
        arguments.insert(arguments.begin(), {"-C", "/r"});
        MemoryDisk hostile = hostile_disk(), plain = harmless_disk();  // copies: init writes
        const CommandRun a = run(hostile, arguments), b = run(plain, arguments);
        EXPECT_EQ(a.exit_code, b.exit_code) << name << a.err << b.err;
        EXPECT_LT(a.exit_code, 2) << name << a.err;
        cases.push_back({kind, name, a.out, b.out, shown, more});
        if (!a.err.empty() || !b.err.empty()) cases.push_back({"text", name + "(stderr)", a.err, b.err, {}});
    }
};

TEST_F(HostileText, EveryFormatHasTheStructureOfHarmlessText) {
    std::vector<Case> cases;
    add(cases, "text", {"check"}, files());
    add(cases, "json", {"check", "--format", "json"}, files());
    add(cases, "json", {"check", "--format", "sarif"}, files(), {{"sub", "sarif"}});
    add(cases, "xml", {"check", "--format", "junit"}, files());
    add(cases, "github", {"check", "--format", "github"}, files());
    add(cases, "json", {"check", "--format", "gitlab"}, files(), {{"sub", "gitlab"}});
    add(cases, "markdown", {"check", "--format", "markdown"}, files());
    add(cases, "html", {"check", "--format", "html"}, files());
    add(cases, "text", {"report"}, hostile_strings());
    add(cases, "json", {"report", "--format", "json"}, hostile_strings());
    add(cases, "csv", {"report", "--format", "csv"}, hostile_strings());
    add(cases, "markdown", {"report", "--format", "markdown"}, files(), {{"lists_vary", true}});
    add(cases, "html", {"report", "--format", "html"}, files(), {{"script", true}});
    add(cases, "text", {"report", "--bench", "bench.json"}, hostile_strings());
    add(cases, "markdown", {"report", "--bench", "bench.json", "--format", "markdown"}, files(),
        {{"lists_vary", true}});
    add(cases, "text", {"scan", "."}, files());
    add(cases, "json", {"scan", ".", "--format", "json"}, files());
    add(cases, "text", {"map"}, files());
    add(cases, "json", {"map", "--format", "json"}, files());
    add(cases, "text", {"init", "--force"}, {});
    expect_read_back(cases);
}

/// What /bin/sh makes of commands that begin with `porttool`: the arguments of each.
std::vector<Strings> arguments_of(const Strings& commands) {
    const auto folder = std::filesystem::temp_directory_path() / ("porttool_shell_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream script(folder / "script", std::ios::binary);
    script << "porttool() { for word in \"$@\"; do printf '%s\\0' \"$word\"; done; printf '\\1\\0'; }\n";
    for (const std::string& command : commands) script << command << "\n";
    script.close();
    const std::string run = "cd '" + folder.string() + "' && /bin/sh ./script > out 2> err";
    EXPECT_EQ(std::system(run.c_str()), 0);
    EXPECT_EQ(read_text(folder / "err"), "");
    EXPECT_FALSE(std::filesystem::exists(folder / "hostile")) << "a command within an id was run";
    std::vector<Strings> out(1);
    std::istringstream words(read_text(folder / "out"));
    for (std::string word; std::getline(words, word, '\0');) {
        if (word == "\1")
            out.emplace_back();
        else
            out.back().push_back(word);
    }
    out.pop_back();
    std::filesystem::remove_all(folder);
    return out;
}

TEST_F(HostileText, RemediesAreReadBackByTheShell) {
    MemoryDisk disk = hostile_disk();
    const json findings = check(disk)["findings"];
    Strings commands, ids, fingerprints;
    const std::string start = "run: porttool accept ";
    for (const json& finding : findings) {
        const std::string remedy = finding["remedy"];
        const size_t at = remedy.find(start);
        if (at == std::string::npos) continue;
        EXPECT_EQ(remedy.find('\n'), std::string::npos) << remedy;
        commands.push_back(remedy.substr(at + 5));
        ids.push_back(finding["source"]["id"]);
        fingerprints.push_back(finding["fingerprint"]);
    }
    ASSERT_GT(commands.size(), hostile_strings().size());
    const std::vector<Strings> read = arguments_of(commands);
    ASSERT_EQ(read.size(), commands.size());
    Strings accept = {"-C", "/r", "accept"};
    size_t by_fingerprint = 0;
    for (size_t i = 0; i < read.size(); ++i) {
        ASSERT_EQ(read[i].size(), 4u) << commands[i];
        EXPECT_TRUE(read[i][1] == ids[i] || read[i][1] == fingerprints[i]) << commands[i];
        by_fingerprint += read[i][1] == fingerprints[i] ? 1 : 0;
        accept.push_back(read[i][1]);
    }
    EXPECT_GT(by_fingerprint, 30u / static_cast<unsigned>(kLighter));
    EXPECT_LT(by_fingerprint, read.size() / 2);
    const CommandRun accepted = run(disk, accept);
    EXPECT_EQ(accepted.exit_code, 0) << accepted.err;
    const json left = check(disk)["findings"];
    for (const json& finding : left) EXPECT_EQ(finding["rule"], "unused-suppression") << finding;
}

TEST(Shell, ReadsEveryQuotedTextBackExactly) {
    Strings commands, texts = hostile_strings();
    texts.insert(texts.end(), strings_not_utf8().begin(), strings_not_utf8().end());
    for (int byte = 1; byte < 256; ++byte) texts.push_back(std::string("a") + static_cast<char>(byte));
    texts.insert(texts.end(), {"", "''", "'\\''", "a\n", "\n"});
    for (const std::string& text : texts) {
        commands.push_back("porttool " + shell_quoted(text) + " " + shell_word(text));
        EXPECT_FALSE(can_be_pasted(text) && text.find('\n') != std::string::npos);
    }
    const std::vector<Strings> read = arguments_of(commands);
    ASSERT_EQ(read.size(), texts.size());
    for (size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(read[i], (Strings{texts[i], texts[i]})) << commands[i];
    EXPECT_EQ(shell_word("origin/main"), "origin/main");
}

TEST_F(HostileText, WhatCommandsSayOfAnIdIsHarmless) {
    std::vector<Case> cases;
    const auto run_all = [&](const MemoryDisk& drifted_disk, const Strings& names) {
        MemoryDisk disk = drifted_disk;
        Strings ids, others;
        for (size_t i = 0; i < names.size(); ++i) {
            ids.push_back(names[i] + ".cu:f" + std::to_string(i));
            others.push_back(names[i] + ".cu:h" + std::to_string(i));
        }
        std::string out;
        const auto add = [&](Strings arguments, const Strings& more) {
            arguments.insert(arguments.begin(), {"-C", "/r"});
            arguments.push_back("--");
            arguments.insert(arguments.end(), more.begin(), more.end());
            const CommandRun got = run(disk, arguments);
            EXPECT_EQ(got.exit_code, arguments[2] == "accept" && more.empty() ? 1 : 0) << arguments[2] << got.err;
            out += got.out + got.err;
        };
        const auto third = ids.begin() + static_cast<long>(ids.size() / 3);
        const Strings few(ids.begin(), third);
        add({"accept", "--all"}, {});
        add({"defer", "--owner", names[0], "--until", "2999-01-01", "--reason", names[0]}, few);
        add({"ignore", "--reason", names[5]}, Strings(third, ids.end()));
        add({"accept", "--reason", names[1]}, Strings(others.begin(), others.begin() + 9));
        for (size_t i = 3; i < 9; ++i) add({"explain"}, {others[i]});
        for (const char* format : {"text", "json"})
            for (size_t i = 0; i < names.size(); i += 20)
                add({"compare", "--format", format}, {names[i] + ".cu", names[i] + ".comp:f" + std::to_string(i)});
        return out;
    };
    const Strings plain = harmless(hostile_strings().size());
    cases.push_back(
        {"text", "settling", run_all(hostile_disk(), hostile_strings()), run_all(harmless_disk(), plain), files()});
    expect_read_back(cases);
}

/// What a command line with a text in the place of `@` says, on stderr, for each text.
std::string said_of(const Strings& texts, const Strings& arguments, const MemoryDisk& start) {
    MemoryDisk disk = start;
    std::string out;
    for (const std::string& text : texts) {
        Strings filled = {"-C", "/r"};
        for (const std::string& argument : arguments) filled.push_back(replaced_all(argument, "@", text));
        const CommandRun got = run(disk, filled);
        EXPECT_EQ(got.exit_code, 2) << arguments[0] << " " << text << got.out;
        EXPECT_EQ(got.out, "");
        out += got.err;
    }
    return out;
}

TEST_F(HostileText, ArgumentsAreEchoedHarmlessly) {
    const MemoryDisk disk =
        started("__device__ float f(float a) { return a * 2.0f; }\n", "float f(float a) { return a * 2.0; }\n");
    Strings texts = hostile_strings();
    std::erase_if(texts,
                  [](const std::string& text) { return text.find('@') != std::string::npos || text.find("::") == 0; });
    Strings shown = texts;
    std::erase_if(shown,
                  [](const std::string& text) { return text.starts_with('[') && text.ends_with(']'); });  // CLI11
    texts.insert(texts.end(), strings_not_utf8().begin(), strings_not_utf8().end());
    const Strings plain = harmless(texts.size());
    std::vector<Case> cases;
    for (const Strings& arguments : std::vector<Strings>{{"explain", "--", "@"},
                                                         {"accept", "--", "@"},
                                                         {"scan", "--", "@"},
                                                         {"compare", "--", "@", "@"},
                                                         {"check", "--config=@"},
                                                         {"check", "--format=@"},
                                                         {"check", "--color=@"},
                                                         {"check", "--output=@/@"},
                                                         {"map", "--source=@", "--target=**"},
                                                         {"report", "--fail-under=@"},
                                                         {"report", "--fail-under=@=3"},
                                                         {"report", "--bench=@"},
                                                         {"history", "--config=@"},
                                                         {"check", "--@"},
                                                         {"check", "--", "@"},
                                                         {"defer", "--owner=@", "--reason=@", "--until=@", "x"}})
        cases.push_back({"text", arguments[0] + " " + arguments[1], said_of(texts, arguments, disk),
                         said_of(plain, arguments, disk), shown});
    expect_read_back(cases);
}

/// What report says where a file of the project holds each text.
std::string said_of_file(const Strings& texts, const std::string& path,
                         const std::function<std::string(const std::string&)>& made, const MemoryDisk& start) {
    std::string out;
    for (const std::string& text : texts) {
        MemoryDisk disk = start;
        disk.files[path] = made(text);
        out += run(disk, {"-C", "/r", "report"}).err;
    }
    return out;
}

TEST_F(HostileText, FilesOfTheProjectAreEchoedHarmlessly) {
    const MemoryDisk disk =
        started("__device__ float f(float a) { return a * 2.0f; }\n", "float f(float a) { return a * 2.0; }\n");
    const std::string map = disk.files.at("/r/portmap.toml"), lock = disk.files.at("/r/portmap.lock");
    Strings texts = hostile_strings();
    texts.insert(texts.end(), strings_not_utf8().begin(), strings_not_utf8().end());
    const Strings plain = harmless(texts.size());
    using Made = std::function<std::string(const std::string&)>;
    const std::vector<std::pair<std::string, Made>> files = {
        {"/r/portmap.toml", [&](const std::string& text) { return map + text + "\n"; }},
        {"/r/portmap.toml", [&](const std::string& text) { return map + "x = \"" + text; }},
        {"/r/portmap.toml", [&](const std::string& text) { return map + toml_string(text) + " = 1\n"; }},
        {"/r/portmap.toml",
         [&](const std::string& text) { return map + "[rules]\nunported = " + toml_string(text) + "\n"; }},
        {"/r/portmap.toml",
         [&](const std::string& text) {
             return map + "[[block]]\nname = " + toml_string(text) + "\nsource = " + toml_string("no/" + text) + "\n";
         }},
        {"/r/portmap.lock", [&](const std::string& text) { return lock + text + "\n"; }},
        {"/r/portmap.lock", [&](const std::string& text) { return text; }}};
    std::vector<Case> cases;
    for (size_t i = 0; i < files.size(); ++i)
        cases.push_back({"text",
                         files[i].first + " " + std::to_string(i),
                         said_of_file(texts, files[i].first, files[i].second, disk),
                         said_of_file(plain, files[i].first, files[i].second, disk),
                         {},
                         {{"lines_vary", true}}});
    expect_read_back(cases);
}

class HostileHistory : public TemporaryRepository {
protected:
    void put(const std::string& folder, const MemoryDisk& from) const {
        for (const auto& [path, bytes] : from.files) write(folder + path.substr(2), bytes);
    }
};

TEST_F(HostileHistory, CommitsAndRevisionsAreHarmless) {
    Strings names;  // not all, which git would take long for; history takes what precedes a colon for the file
    for (size_t i = 0; i < hostile_strings().size(); i += 4)
        if (hostile_strings()[i].find(':') == std::string::npos) names.push_back(hostile_strings()[i]);
    const Strings plain = harmless(names.size());
    put("hostile", recorded(names, kUnits));
    put("harmless", recorded(plain, kUnits));
    commit("first", 1);
    put("hostile", drifted(names, kUnits));
    put("harmless", drifted(plain, kUnits));
    const std::string subject = "\x1b[31m \u202e \" \\ ##[error]x ]]> `x` @team \xc2\x9b <b> \x07 end";
    write("../" + root.filename().string() + "/subject", subject + "\n\n::error::body\n");
    git("add -A && git reset -q subject && git commit -q --cleanup=verbatim -F subject");
    std::vector<Case> cases;
    const auto add = [&](const std::string& kind, const Strings& arguments, const Strings& shown,
                         const nlohmann::json& more = nlohmann::json::object()) {
        const CommandRun a = porttool(arguments, (root / "hostile").string()),
                         b = porttool(arguments, (root / "harmless").string());
        EXPECT_EQ(a.exit_code, b.exit_code) << a.err;
        cases.push_back({kind, arguments[0] + " " + kind, a.out, b.out, shown, more});
        cases.push_back({"text", arguments[0] + " stderr", a.err, b.err, {}});
    };
    Strings files;
    for (const std::string& name : names) files.push_back(name + ".cu");
    add("text", {"effort", "--from", "HEAD~1"}, files);
    add("json", {"effort", "--from", "HEAD~1", "--format", "json"}, files);
    add("csv", {"effort", "--from", "HEAD~1", "--format", "csv"}, files);
    add("toml", {"effort", "--from", "HEAD~1", "--format", "toml"}, {subject});
    add("text", {"history", "--no-cache"}, files);
    add("json", {"history", "--no-cache", "--format", "json"}, {subject});
    add("csv", {"history", "--no-cache", "--format", "csv"}, names);
    add("html", {"history", "--no-cache", "--format", "html"}, files);
    Strings revisions;
    for (const std::string& text : names)
        if (text.find('@') == std::string::npos && text.size() < 100) revisions.push_back(text);
    for (const char* option : {"check --base=", "effort --from=", "history --since="}) {
        std::array<std::string, 2> said;
        for (size_t i = 0; i < revisions.size(); ++i)
            for (const size_t side : {0, 1}) {
                const std::string line = option;
                const size_t blank = line.find(' ');
                const CommandRun got =
                    porttool({line.substr(0, blank), line.substr(blank + 1) + (side == 0 ? revisions[i] : "name")},
                             (root / "harmless").string());
                said[side] += got.exit_code == 2 ? got.err : "in every repository\n\n";
            }
        cases.push_back({"text", option, said[0], said[1], {}, {{"lines_vary", true}}});
    }
    expect_read_back(cases);
}

/// Texts of signs that mean something somewhere, in any order.
Strings random_texts(size_t count, uint32_t seed) {
    const Strings signs = {"`",   "``", "```", "|", "\\", "*",  "_", "~",  "[",      "]",  "(", ")",   "<",    ">", "&",
                           "lt;", "#",  "1",   "@", "a",  "bc", " ", "  ", "!",      "$",  ":", "://", "www.", ".", "-",
                           "+",   "=",  "{",   "}", "\"", "'",  "/", "é",  "\u202e", "\n", "^", "%",   "GH-"};
    std::mt19937 random(seed);
    Strings out;
    for (size_t i = 0; i < count; ++i) {
        std::string text = "t";
        for (size_t length = 1 + random() % 12; length > 0; --length) text += signs[random() % signs.size()];
        out.push_back(text + "t" + std::to_string(i));  // told apart by its end
    }
    return out;
}

TEST(Terminal, AStatementAsLongAsItsFileIsShownInPart) {
    const std::string name(50'000, 'x'), wide = "float " + name + " = a * 2.0; return " + name + "; }";
    MemoryDisk disk = started("__device__ float f(float a) { return a; }\n", "float f(float a) { return a; }\n");
    disk.files["/r/src/k.cu"] = "__device__ float f(float a) { " + wide + "\n";
    for (const Strings& arguments : std::vector<Strings>{{"check"}, {"explain", "src/k.cu:f"}}) {
        Strings all = {"-C", "/r"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const std::string out = run(disk, all).out;
        EXPECT_NE(out.find("xxx ... xxx"), std::string::npos) << arguments.front();
        if (arguments.front() == "check") {
            EXPECT_LT(out.size(), 20'000u);
        }
    }
    EXPECT_NE(check(disk).dump().find(name + " = a"), std::string::npos);
}

TEST(Json, RowsOneByOneAreTheSameDocument) {
    using nlohmann::ordered_json;
    const ordered_json row = {{"a", "[]\n[ ]"}, {"b", ordered_json::array({1, ordered_json::array()})}};
    for (const size_t count : {0, 1, 3}) {
        const ordered_json rows(std::vector<ordered_json>(count, row));
        const auto with = [&](ordered_json list) {
            return std::vector<ordered_json>{list,
                                             {{"empty", ordered_json::array()}, {"says", "[]"}, {"rows", list}},
                                             {{"runs", ordered_json::array({{{"name", "[]"}, {"results", list}}})}}};
        };
        const auto whole = with(count == 0 ? ordered_json::array() : rows), empty = with(ordered_json::array());
        for (size_t i = 0; i < whole.size(); ++i)
            EXPECT_EQ(
                json_with_rows(empty[i], 2 * count, [&](size_t k) { return k % 2 == 0 ? row : ordered_json(nullptr); }),
                json_text(whole[i], 1));
    }
}

TEST(Markdown, RandomTextsStayText) {
    constexpr size_t kCount = 800;
    const Strings texts = random_texts(kCount, 12), plain = harmless(kCount);
    const auto table = [](const Strings& strings) {
        std::string out = "| text | cell | code | both |\n| --- | --- | --- | --- |\n";
        for (const std::string& text : strings)
            out += "| " + markdown_text(text) + " | " + markdown_cell(text + " of " + text) + " | " +
                   markdown_code(text) + " | " + markdown_code(text) + ": " + markdown_text(text) + " |\n";
        return out;
    };
    const auto list = [](const Strings& strings) {
        std::string out;
        for (const std::string& text : strings)
            out += "- " + markdown_code(text) + " and " + markdown_text(text) + "\n";
        return out;
    };
    const auto issues = [](const Strings& strings) {
        json out = json::array();
        for (const std::string& text : strings) out.push_back({{"description", markdown_sentence(text)}});
        return out.dump();
    };
    expect_read_back({{"markdown", "a table", table(texts), table(plain), texts},
                      {"markdown", "a list", list(texts), list(plain), texts},
                      {"json", "sentences", issues(texts), issues(plain), {}, {{"sub", "gitlab"}}}});
}

/// The reader must not be content with everything.
TEST(ReadBack, RefusesWhatActs) {
    if (std::system("python3 --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "python3 is not installed";
    const std::string head = "| a | b |\n| --- | --- |\n", plain = head + "| x | y |\n";
    std::vector<Case> cases = {
        {"text", "an escape sequence", "a\x1b[2Jb\n", "a\n", {}},
        {"text",
         "C1",
         "a\xc2\x9b"
         "2Jb\n",
         "a\n",
         {}},
        {"text", "a direction", "a\u202e\n", "a\n", {}},
        {"text", "no width", "a\u200b\n", "a\n", {}},
        {"text", "a line more", "a\nb\n", "a\n", {}},
        {"text", "a workflow command", " ::error::x\n", "a\n", {}},
        {"text", "a log command", "a ##[error]x\n", "a\n", {}},
        {"text", "lost", "a\n", "a\n", {"b"}},
        {"markdown", "a cell more", head + "| x | y | z |\n| a | b |\n", head + "| x | y |\n", {}},
        {"markdown", "strikethrough", head + "| ~~x~~ | y |\n", plain, {}},
        {"markdown", "an autolink", head + "| www.x.example | y |\n", plain, {}},
        {"markdown", "a mention", head + "| @team | y |\n", plain, {}},
        {"markdown", "a reference", head + "| #12 | y |\n", plain, {}},
        {"markdown", "emphasis", head + "| *x* | y |\n", plain, {}},
        {"markdown", "HTML", head + "| <b>x | y |\n", plain, {}},
        {"markdown", "an image", head + "| ![x](y) | y |\n", plain, {}},
        {"markdown", "an entity", head + "| &lt; | y |\n", plain, {"&lt;"}},
        {"html", "an element", "<p><b>x</b></p>", "<p>x</p>", {}},
        {"html", "an attribute", "<p a=\"x\" onclick=\"y\">x</p>", "<p a=\"x\">x</p>", {}},
        {"xml", "no XML", "<a b=\"<\"/>", "<a b=\"x\"/>", {}},
        {"xml", "an element of XML", "<a><b/></a>", "<a>x</a>", {}},
        {"csv", "a formula", " =1+1,2\n", "a,2\n", {}},
        {"csv", "a cell", "a;=1+1,2\n", "a,2\n", {}},
        {"csv", "a row", "a\nb,2\n", "a,2\n", {}},
        {"json", "no JSON", "{\"a\": \"\\x\"}", "{\"a\": \"x\"}", {}},
        {"json", "lost in JSON", "{\"a\": \"x\"}", "{\"a\": \"x\"}", {"y"}},
        {"json", "GitLab", "[{\"description\": \"<b>x\"}]", "[{\"description\": \"x\"}]", {}, {{"sub", "gitlab"}}},
        {"github",
         "a command of others",
         "::error file=a,line=1,endLine=1,title=t::x%0Ay\n::error::z\n",
         "::error file=a,line=1,endLine=1,title=t::x%0Ay\n",
         {}},
        {"github",
         "a property",
         "::error file=a,line=1,endLine=1,title=t,file=b::x%0Ay\n",
         "::error file=a,line=1,endLine=1,title=t::x%0Ay\n",
         {}},
        {"toml", "no TOML", "a = \"\"\"\n", "a = 1\n", {}}};
    std::string found;
    bool has_markdown = true;
    for (const std::string& line : read_back(cases)) {
        found += line + "\n";
        if (line == "absent: cmark-gfm") has_markdown = false;
    }
    for (const Case& one : cases) {
        const bool needs_markdown = one.kind == "markdown" || one.name == "GitLab";
        if (!has_markdown && needs_markdown) continue;
        EXPECT_NE(found.find(one.name + " ("), std::string::npos) << one.name << found;
    }
}

}  // namespace
}  // namespace porttool::testing::hostile_text_test
