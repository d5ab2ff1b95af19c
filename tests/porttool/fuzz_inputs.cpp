// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/porttool/fuzz_inputs.h"

#include <algorithm>
#include <exception>
#include <sstream>

#include "porttool/command/run.h"
#include "porttool/compare/edits.h"
#include "porttool/match/match.h"
#include "porttool/measure/measure.h"
#include "porttool/normal/unit_state.h"
#include "porttool/read/lock_file.h"
#include "porttool/read/map_file.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/mutate.h"

namespace porttool::testing {
namespace {

const char* kMap = R"(version = 1
[sides]
source = ["src/*.cu", "src/{a,b}/**"]
target = ["port/*"]
reference = "source"
[spirv]
include = ["port/include"]
preamble = ["""
#define GROUP_SIZE 64
""", "#define GROUP_SIZE 32"]
[dialect]
__expf = "exp"
rsqrtf = "inversesqrt"
[rules]
unported = "warning"
orphaned = "off"
[[pair]]
source = "src/k.cu:shade"
target = ["port/k.comp:shade", "port/k.comp:kScale"]
[[ignore]]
id = "port/k.comp:{one,two}"
reason = "there is none"
[[block]]
name = "Shading"
source = "src/k.cu"
target = ["port/k.comp:*"]
[cost]
testing = 1
retest = 0.5
[reuse]
integration = 20
unfamiliarity = 0.4
[[effort]]
what = "Sheen"
block = "Shading"
from = "1a2b3c4"
lines = 110
novel = 28
port = { coding = 3, testing = 2 }
redevelopment = { design = 4, coding = 6 }
uncertainty = 0.2
)";

const char* kHeader = "#ifdef FAST\n#define exp __expf\n#endif\n#undef fma\n#define scaled(x) ((x) * kScale)\n";
const char* kSource =
    "#include \"k.h\"\n#define SIZE 8\nconst float kScale = 0.5f;\nstruct Hit { float t; int id; };\n"
    "__device__ float shade(float a, float b) {\n  float c = a * b;\n  if (c > 1.0f) c = 1.0f;\n  return c * "
    "kScale;\n}\n"
    "__device__ float trace(float t) {\n  for (int i = 0; i < SIZE; ++i) t += 0.25f * exp(i);\n  return t;\n}\n";
const char* kTarget =
    "#define SIZE 8\nconst float kScale = 0.5;\nstruct Hit { float t; int id; };\n"
    "float shade(float a, float b) {\n  float c = a * b;\n  if (c > 1.0) c = 1.0;\n  return c * kScale;\n}\n"
    "float trace(float t) {\n  for (int i = 0; i < SIZE; ++i) t += 0.25 * exp(i);\n  return t;\n}\n";

struct CommandResult {
    int exit_code;
    std::string out, err;
};

/// The arguments are parsed once: to parse them takes as long as to check a small repository.
CommandResult run_command(MemoryDisk& disk, std::vector<const char*> arguments) {
    static std::map<std::vector<std::string>, ParsedOptions> parsed;
    arguments.insert(arguments.begin(), {"porttool", "-C", "/r"});
    const auto [known, is_new] = parsed.try_emplace({arguments.begin(), arguments.end()});
    if (is_new) known->second = parse_options(static_cast<int>(arguments.size()), arguments.data());
    std::ostringstream out, err;
    const int code = run_porttool(known->second, disk, out, err);
    return {code, out.str(), err.str()};
}

/// A repository with a map, a lock with all kinds of lines, and one pair that drifted since.
FuzzInput make_repository() {
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", kSource}, {"/r/src/k.h", kHeader}, {"/r/port/k.comp", kTarget}};
    run_command(disk, {"init", "--source", "src/*", "--target", "port/*"});
    auto edit = [&](const char* path, const std::string& from, const std::string& to) {
        std::string& text = disk.files[path];
        text.replace(text.find(from), from.size(), to);
    };
    edit("/r/src/k.cu", "0.25f", "0.75f");
    run_command(disk, {"accept", "src/k.cu:trace", "--reason", "the port is right"});
    edit("/r/src/k.cu", "a * b", "a + b");
    run_command(disk, {"ignore", "src/k.cu:shade", "--reason", "until the next release"});
    edit("/r/src/k.cu", "a + b", "a - b");
    edit("/r/src/k.cu", "float t; int id", "float t; uint id");
    run_command(disk, {"defer", "src/k.cu:Hit", "--owner", "me", "--until", "2099-01-01", "--reason", "later"});
    return disk.files;
}

const FuzzInput& repository() {
    static const FuzzInput made = make_repository();
    return made;
}

const std::vector<std::string>& fixture_texts() {
    static const std::vector<std::string> texts = [] {
        std::vector<std::string> read = {kSource, kTarget};
        for (const auto& path : fixture_files()) read.push_back(read_text(path));
        return read;
    }();
    return texts;
}

const MutationStock& source_stock() {
    static const MutationStock stock = {fixture_texts(),
                                        {"{",
                                         "}",
                                         "(",
                                         ")",
                                         "[",
                                         "]",
                                         "<",
                                         ">",
                                         ";",
                                         ":",
                                         "=",
                                         ",",
                                         "\"",
                                         "'",
                                         "\\",
                                         "\n",
                                         "#",
                                         "#if 0\n",
                                         "#else\n",
                                         "#endif\n",
                                         "/*",
                                         "*/",
                                         "//",
                                         "R\"(",
                                         ")\"",
                                         "\r",
                                         "operator",
                                         "struct ",
                                         "enum ",
                                         "namespace a::",
                                         "##",
                                         "~",
                                         "::",
                                         "?",
                                         "[[",
                                         "]]",
                                         "(int)",
                                         "else if(",
                                         "return ",
                                         "template <",
                                         "\xFF",
                                         "1e999f",
                                         "0x",
                                         "1'000",
                                         "__global__ ",
                                         "#define A(x) ",
                                         "const float x = ",
                                         "\\\n",
                                         "#pragma omp ",
                                         "#include \"k.h\"\n",
                                         "#include <../src/",
                                         "#undef SIZE\n",
                                         "#define shade trace\n",
                                         "#define exp(x) ",
                                         "// porttool: ignore(unported) ",
                                         "if constexpr(",
                                         std::string(1, '\0'),
                                         "\xEF\xBB\xBF",
                                         "99999999999999999999"}};
    return stock;
}

const MutationStock& map_stock() {
    static const MutationStock stock = {{kMap, repository().at("/r/portmap.toml")},
                                        {"[[pair]]\n",
                                         "[[ignore]]\n",
                                         "[[block]]\n",
                                         "[[effort]]\n",
                                         "[sides]\n",
                                         "[rules]\n",
                                         "[dialect]\n",
                                         "[",
                                         "]",
                                         "[[",
                                         "\"",
                                         "\"\"\"",
                                         "'",
                                         "'''",
                                         "=",
                                         ",",
                                         "{",
                                         "}",
                                         "#",
                                         "\n",
                                         "\r",
                                         "\t",
                                         "\\",
                                         "\\u0000",
                                         "\\uD800",
                                         "\xFF",
                                         "nan",
                                         "-inf",
                                         "1e308",
                                         "-1",
                                         "99999999999999999999",
                                         "0x",
                                         "true",
                                         "1979-05-27",
                                         "..",
                                         "../**",
                                         "/etc/passwd",
                                         "**",
                                         "{a,b,{c,d}}",
                                         "[!a-z]",
                                         "*",
                                         "?",
                                         "version = 2\n",
                                         "target_root = \"../x\"\n",
                                         "reference = \"target\"\n",
                                         "reference = \"both\"\n",
                                         "[sides.targets]\n",
                                         "a = [\"port/**\"]\nb = [\"port/**\"]\n",
                                         "target = [\"port/k.comp:shade\", \"port/k.comp:main\"]\n",
                                         "qualifiers = \"warning\"\n",
                                         "[sync]\nverify = \"true\"\n",
                                         "source = ",
                                         "target = ",
                                         "\x1b[31m",
                                         "\xE2\x80\xAE",
                                         std::string(1, '\0'),
                                         "src/k.cu:shade",
                                         "port/k.comp:*",
                                         ":",
                                         "#2",
                                         ":@file",
                                         std::string(300, '[')}};
    return stock;
}

const MutationStock& lock_stock() {
    static const MutationStock stock = {{repository().at("/r/portmap.lock")},
                                        {"\t",
                                         "\n",
                                         "\r\n",
                                         "\t\t",
                                         "pair\t",
                                         "baseline\t",
                                         "accept\t",
                                         "defer\t",
                                         "ignore\t",
                                         "porttool-lock\t1\n",
                                         "porttool-lock\t2\n",
                                         "porttool-lock\t99\n",
                                         "normal-form\t1\n",
                                         "normal-form\t2\n",
                                         "normal-form\t3\n",
                                         "unit\tsource\t",
                                         "\tstate=verified\tby=",
                                         "\tlater=%",
                                         "\tsource-macros=-",
                                         "\tsource-macros=+",
                                         "\ttarget-macros=+ exp:0a1b2c3d4e5f6071 float:0a1b2c3d4e5f6071",
                                         "\ttarget-macros=*:0a1b2c3d4e5f6071",
                                         "\tsource-macros=SIZE: exp:",
                                         "7f3\n",
                                         "7f3a90c1\n",
                                         "7f3a90c1\t",
                                         "-\t-\t-",
                                         "../.git/config",
                                         "/etc/passwd",
                                         "0123456789abcdef",
                                         "0123456789ABCDEF",
                                         "0123456789abcde",
                                         "\\",
                                         "\\t",
                                         "\\n",
                                         "%09",
                                         "2026-02-30",
                                         "9999-99-99",
                                         "src/k.cu:shade",
                                         "port/k.comp:shade",
                                         "<<<<<<< HEAD\n",
                                         "=======\n",
                                         ">>>>>>> b\n",
                                         "\xFF",
                                         std::string(1, '\0'),
                                         "\x1b[31m",
                                         "#",
                                         " ",
                                         "-",
                                         "*"}};
    return stock;
}

/// The commands that read what was recorded; those that write as well.
const std::vector<std::vector<const char*>>& base_commands() {
    static const std::vector<std::vector<const char*>> commands = {{"check", "--format", "json"},
                                                                   {"check"},
                                                                   {"check", "--format", "sarif"},
                                                                   {"check", "--format", "junit"},
                                                                   {"check", "--format", "github"},
                                                                   {"check", "--format", "gitlab"},
                                                                   {"check", "--format", "html"},
                                                                   {"check", "--format", "markdown"},
                                                                   {"check", "--strict"},
                                                                   {"accept", "--all"},
                                                                   {"accept", "--all", "--force"},
                                                                   {"explain", "src/k.cu:shade"},
                                                                   {"explain", "src/k.cu:Hit"},
                                                                   {"ignore", "src/k.cu:shade", "--reason", "because"},
                                                                   {"report", "--format", "json"},
                                                                   {"review", "--format", "json"},
                                                                   {"map", "--format", "json"},
                                                                   {"map", "--write", "0.1"},
                                                                   {"init", "--assess", "--format", "json"},
                                                                   {"accept", "src/k.cu:shade=port/k.comp:shade"},
                                                                   {"sync", "--all", "--format", "json"},
                                                                   {"sync", "--all", "--to", "source"},
                                                                   {"sync", "--all", "--apply", "--partial", "--force"},
                                                                   {"init", "--force"}};
    return commands;
}

/// What must hold of every run of a command, whatever it read.
std::string command_fault(const FuzzInput& files, std::vector<const char*> arguments) {
    MemoryDisk disk;
    disk.files = files;
    const std::string name = std::string(arguments[0]) + " " + arguments[arguments.size() - 1];
    const CommandResult got = run_command(disk, std::move(arguments));
    if (got.exit_code < 0 || got.exit_code > 2) return name + ": exit code " + std::to_string(got.exit_code);
    if (got.exit_code != 2) return "";
    if (!got.out.empty()) return name + ": exit code 2 and something on stdout";
    const auto lines = std::count(got.err.begin(), got.err.end(), '\n');
    if (lines < 1 || lines > 2) return name + ": exit code 2 and " + std::to_string(lines) + " lines: " + got.err;
    return disk.files == files ? "" : name + ": exit code 2 and something written";
}

std::string source_fault(const FuzzInput& input) {
    static const Dialect dialect;  // making it would be a third of a run
    std::vector<ScannedFile> files;
    for (const auto& [path, text] : input) files.push_back(scan_text(path, text));
    for (const ScannedFile& file : files)
        if (std::string fault = scan_fault(file); !fault.empty()) return fault;
    const Matching matching = match_units({files[0]}, {files[1]}, {}, dialect);
    for (const MatchedPair& pair : matching.pairs)
        if (!(pair.score >= 0 && pair.score <= 1)) return "a score outside 0 to 1 for " + pair.source;
    const Similarity alike = measure({{&files[0], nullptr}}, {{&files[1], nullptr}}, dialect);
    for (const auto& figure : {alike.tiling, alike.token_edit, alike.tree_distance, alike.line_divergence})
        if (figure && !(*figure >= 0 && *figure <= 1)) return "a figure outside 0 to 1";
    for (size_t i = 0; i < std::min(files[0].units.size(), files[1].units.size()); ++i) {
        const NormalText old_text = unit_state(files[0], files[0].units[i]).text;
        const NormalText new_text = unit_state(files[1], files[1].units[i]).text;
        const Words before = old_text.words(), now = new_text.words();
        if (!compare_edits({before, now, before, now}, dialect, {Language::Cuda, Language::Glsl}).equivalent)
            return "the same edit on both sides, unit " + std::to_string(i) + ", is not equivalent";
    }
    return "";
}

std::string map_fault(const FuzzInput& input) {
    const std::string& text = input.at("/r/portmap.toml");
    const ReadMap got = read_map("portmap.toml", text);
    if (std::count(got.error.begin(), got.error.end(), '\n') > 2) return "an error of many lines: " + got.error;
    FuzzInput files = repository();
    files["/r/portmap.toml"] = text;
    return command_fault(files, {"check"});
}

std::string lock_fault(const FuzzInput& input) {
    const std::string& text = input.at("/r/portmap.lock");
    const ReadLock got = read_lock(text);
    if (got.error.empty()) {
        const std::string written = lock_text(got.lock);
        const ReadLock again = read_lock(written);
        if (!again.error.empty()) return "what was read and written cannot be read: " + again.error;
        if (lock_text(again.lock) != written) return "what was read and written changes when it is read again";
    }
    FuzzInput files = repository();
    files["/r/portmap.lock"] = text;
    return command_fault(files, {"check"});
}

FuzzInput source_input(std::mt19937_64& random) {
    static const std::vector<std::string> suffixes = {"cu",   "cl",    "comp",  "cpp",  "c",
                                                      "hlsl", "metal", "slang", "ispc", "osl"};
    const MutationStock& stock = source_stock();
    const std::string text = stock.texts[random() % stock.texts.size()];
    const std::string once = mutate(text, stock, random);
    return {{"a." + suffixes[random() % suffixes.size()], once},
            {"b." + suffixes[random() % suffixes.size()], mutate(random() % 2 == 0 ? once : text, stock, random)}};
}

/// A repository in which up to three files are mutated.
FuzzInput base_input(std::mt19937_64& random) {
    FuzzInput files = repository();
    for (uint64_t edits = 1 + random() % 3; edits > 0; --edits) {
        auto file = std::next(files.begin(), static_cast<std::ptrdiff_t>(random() % files.size()));
        const std::string& path = file->first;
        const MutationStock& stock = path.ends_with(".toml")   ? map_stock()
                                     : path.ends_with(".lock") ? lock_stock()
                                                               : source_stock();
        if (random() % 20 == 0 && files.size() > 1)
            files.erase(file);
        else
            file->second = mutate(std::move(file->second), stock, random);
    }
    return files;
}

}  // namespace

std::string scan_fault(const ScannedFile& file) {
    const auto tokens = static_cast<uint32_t>(file.lexed.tokens.size());
    for (const Unit& unit : file.units) {
        if (unit.tokens.first >= unit.tokens.end || unit.tokens.end > tokens) return "a unit outside its file";
        if (unit.start_line < 1 || unit.start_line > unit.end_line) return "a unit with impossible lines";
        if (unit.name.empty()) return "a unit without a name";
        const UnitState state = unit_state(file, unit);
        const NormalText own = normal_form(file, unit);
        if (state.text.size() < own.size()) return unit.name + ": another number of tokens";
        Words words = state.text.words();
        words.resize(state.text.size() - own.size());  // its prelude
        for (const std::string_view word : own.words()) words.push_back(word);
        if (state.prints.written != fingerprint(words)) return unit.name + ": the print is of another text";
    }
    for (const LineClass line : file.lines)
        if (line == LineClass::Unclassified) return "a line without a class";
    return "";
}

std::optional<FuzzKind> fuzz_kind(std::string_view name) {
    if (name == "source") return FuzzKind::Source;
    if (name == "map") return FuzzKind::Map;
    if (name == "lock") return FuzzKind::Lock;
    if (name == "base") return FuzzKind::Base;
    return std::nullopt;
}

std::string fuzz_seed_fault() {
    const ReadMap map = read_map("portmap.toml", kMap);
    if (!map.error.empty()) return map.error;
    const std::string& lock = repository().at("/r/portmap.lock");
    if (const ReadLock read = read_lock(lock); !read.error.empty()) return read.error;
    if (lock.find(" exp:") == std::string::npos) return "no macro of the header is noted in the lock";
    MemoryDisk disk;
    disk.files = repository();
    const CommandResult got = run_command(disk, {"check"});
    for (const char* word : {"source-changed", " 1 deferred"})
        if (got.exit_code != 1 || got.out.find(word) == std::string::npos)
            return word + (" is not in: " + got.out) + got.err;
    return "";
}

FuzzInput fuzz_input(FuzzKind kind, uint64_t seed) {
    std::mt19937_64 random(seed * 4 + static_cast<uint64_t>(kind));
    switch (kind) {
        case FuzzKind::Source:
            return source_input(random);
        case FuzzKind::Map: {
            const MutationStock& stock = map_stock();
            return {{"/r/portmap.toml", mutate(stock.texts[random() % stock.texts.size()], stock, random)}};
        }
        case FuzzKind::Lock:
            return {{"/r/portmap.lock", mutate(lock_stock().texts[0], lock_stock(), random)}};
        case FuzzKind::Base:
            break;
    }
    return base_input(random);
}

std::string fuzz_fault(FuzzKind kind, const FuzzInput& input, uint64_t seed) {
    try {
        switch (kind) {
            case FuzzKind::Source:
                return source_fault(input);
            case FuzzKind::Map:
                return map_fault(input);
            case FuzzKind::Lock:
                return lock_fault(input);
            case FuzzKind::Base:
                break;
        }
        return command_fault(input, base_commands()[seed % base_commands().size()]);
    } catch (const std::exception& uncaught) {
        return std::string("an exception got out: ") + uncaught.what();
    }
}

}  // namespace porttool::testing
