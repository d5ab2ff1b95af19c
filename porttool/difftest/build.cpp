// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/build.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

#include "porttool/difftest/bounded_process.h"
#include "porttool/difftest/prelude.h"
#include "porttool/language/dialect.h"
#include "porttool/read/cannot_do.h"

namespace porttool {
namespace {

constexpr size_t kPartsOfProgram = 48;
constexpr std::chrono::milliseconds kCompileTime{60000};
constexpr uint64_t kCompileMemory = 4ull << 30;

void write_text(const std::string& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    if (!(file << text)) throw CannotDo("cannot write " + path + ": is the disk full?");
}

/// What a part uses without saying where it comes from: a compiler of kernels, or a header that is not here, brings it.
std::set<std::string> unsaid_headers(std::string_view text) {
    std::set<std::string> out;
    constexpr std::array<std::pair<std::string_view, const char*>, 3> kBringers = {
        {{"std::vector", "<vector>"}, {"std::string", "<string>"}, {"std::to_string", "<string>"}}};
    for (const auto& [word, header] : kBringers)
        if (text.find(word) != std::string_view::npos) out.insert(header);
    return out;
}

std::string program_text(const std::vector<const ProgramPart*>& parts) {
    std::set<std::string> headers;
    for (const ProgramPart* part : parts) {
        headers.insert(part->headers.begin(), part->headers.end());
        headers.merge(unsaid_headers(part->text));
    }
    // First what is porttool's: a header may make a macro of any word, as <complex.h> does of I.
    std::string out = "#include \"vectors.h\"\n#include \"harness.h\"\n";
    for (const std::string& header : headers) out += "#include " + header + "\n";
    for (const ProgramPart* part : parts) {
        // <complex.h> makes a macro of I, which is a name to whoever calculates with real numbers.
        const bool is_real = part->text.find("omplex") == std::string::npos;
        if (is_real) out += "#pragma push_macro(\"I\")\n#undef I\n";
        out += part->text;
        if (is_real) out += "#pragma pop_macro(\"I\")\n";
    }
    out += "#line 1 \"main\"\nconst porttool_harness::Subject porttool_subjects[] = {\n";
    for (const ProgramPart* part : parts)
        out += fmt::format("{{{0}, subject_{0}::porttool_list, subject_{0}::porttool_run}},\n", part->number);
    out += fmt::format(
        "}};\nint main(int argc, char** argv) {{ return porttool_harness::start(argc, argv, "
        "porttool_subjects, {}); }}\n",
        parts.size());
    return out;
}

/// The N of the first `subject_N` in a text.
std::optional<int> subject_in(std::string_view text) {
    constexpr std::string_view kName = "subject_";
    const size_t at = text.find(kName);
    if (at == std::string_view::npos) return std::nullopt;
    int number = 0;
    const auto [rest, error] = std::from_chars(text.data() + at + kName.size(), text.data() + text.size(), number);
    return error == std::errc() ? std::optional(number) : std::nullopt;
}

/// Whose errors they are: for each part with one its first message.
std::map<int, std::string> errors_of(std::string_view output) {
    std::map<int, std::string> out;
    std::optional<int> context;
    for (size_t at = 0; at < output.size();) {
        const size_t end = std::min(output.find('\n', at), output.size());
        const std::string_view line = output.substr(at, end - at);
        at = end + 1;
        const std::optional<int> here = subject_in(line);
        if (here) context = here;
        size_t message = line.find("error: ");
        const size_t link = line.find("undefined reference to ");
        if (message == std::string_view::npos && link == std::string_view::npos) continue;
        message = message == std::string_view::npos ? link : message + 7;
        // Of a template's error the line that named the subject came before.
        if (context) out.try_emplace(*context, line.substr(message));
    }
    return out;
}

/// True for what tells a kernel which of its threads runs.
bool is_of_launch(const std::string& name) {
    static const Dialect dialect;
    const std::string* const meaning = dialect.meaning(name);
    return meaning != nullptr && (*meaning == "local_id" || *meaning == "group_id" || *meaning == "group_size" ||
                                  *meaning == "group_count" || *meaning == "global_id" || *meaning == "barrier" ||
                                  meaning->starts_with("atomic") || meaning->starts_with("shuffle"));
}

/// A compiler's message in plain words: the helper that is not known, or the message itself.
std::string refusal_of(std::string message) {
    for (const std::string_view quote : {"\xe2\x80\x98", "\xe2\x80\x99"})
        for (size_t at = message.find(quote); at != std::string::npos; at = message.find(quote))
            message.replace(at, quote.size(), "'");
    const size_t open = message.find('\'');
    const size_t close = open == std::string::npos ? open : message.find('\'', open + 1);
    const bool unknown = message.find("was not declared") != std::string::npos ||
                         message.find("undeclared identifier") != std::string::npos ||
                         message.find("has not been declared") != std::string::npos ||
                         message.find("does not name a type") != std::string::npos ||
                         message.find("unknown type name") != std::string::npos ||
                         message.find("there are no arguments to") != std::string::npos;
    if (unknown && close != std::string::npos) {
        const std::string name = message.substr(open + 1, close - open - 1);
        if (name == "porttool_subject") return "the preprocessor leaves it out";
        return (is_of_launch(name) ? "binding " : "unknown helper ") + name;
    }
    return "does not compile as C++: " + message;
}

class Builder {
public:
    Builder(const Workshop& workshop, const std::string& stem) : workshop_(workshop), stem_(stem) {}

    BuiltParts out;

    void build(std::vector<const ProgramPart*> parts) {
        while (!parts.empty()) {
            const std::string path = fmt::format("{}/{}{}", workshop_.folder, stem_, programs_++);
            write_text(path + ".cpp", program_text(parts));
            const ProcessEnd end = compile(path);
            if (end.exit_code == 0) {
                for (const ProgramPart* part : parts) out.programs[part->number] = path;
                return;
            }
            const std::map<int, std::string> errors = errors_of(end.output);
            std::vector<const ProgramPart*> left;
            for (const ProgramPart* part : parts) {
                const auto error = errors.find(part->number);
                if (error == errors.end())
                    left.push_back(part);
                else
                    out.refused[part->number] = refusal_of(error->second);
            }
            if (left.size() == parts.size()) return halve(parts, end);
            parts = std::move(left);
        }
    }

private:
    ProcessEnd compile(const std::string& path) const {
        const bool gnu = workshop_.compiler.find("clang") == std::string::npos;
        std::vector<std::string> command = {workshop_.compiler,
                                            "-std=gnu++20",
                                            "-Og",
                                            "-w",
                                            "-ffp-contract=off",
                                            "-fwrapv",
                                            "-fno-strict-aliasing",
                                            "-fnon-call-exceptions",
                                            "-fno-delete-null-pointer-checks",
                                            "-fdiagnostics-color=never",
                                            "-fno-caret-diagnostics",
                                            "-Wl,--wrap=exit",
                                            "-o",
                                            path,
                                            path + ".cpp"};
        if (gnu) {
            command[10] = "-fno-diagnostics-show-caret";
            // What a function leaves unset of what it gives back is 0 on both sides: for that it must be a variable,
            // and not the caller's memory.
            for (const char* option :
                 {"-fpermissive", "-ftrivial-auto-var-init=zero", "-fno-elide-constructors", "-fmax-errors=300",
                  // What stands behind the end of a table is no answer: it differs from program to program.
                  "-fsanitize=bounds", "-fsanitize-undefined-trap-on-error"})
                command.insert(command.begin() + 1, option);
        }
        ProcessLimits limits;
        limits.time = kCompileTime;
        limits.memory = kCompileMemory;
        return run_process(command, workshop_.folder, limits);
    }

    /// Nobody can be blamed for the errors: each half by itself.
    void halve(const std::vector<const ProgramPart*>& parts, const ProcessEnd& end) {
        if (parts.size() == 1) {
            const size_t error = end.output.find("error: ");
            const std::string message = error == std::string::npos
                                            ? "the compiler ended with " + std::to_string(end.exit_code)
                                            : end.output.substr(error + 7, end.output.find('\n', error) - error - 7);
            out.refused[parts[0]->number] = end.timed_out ? "does not compile within 60 s" : refusal_of(message);
            return;
        }
        const auto middle = parts.begin() + static_cast<std::ptrdiff_t>(parts.size() / 2);
        build({parts.begin(), middle});
        build({middle, parts.end()});
    }

    const Workshop& workshop_;
    const std::string& stem_;
    int programs_ = 0;
};

}  // namespace

BuiltParts build_parts(const std::vector<ProgramPart>& parts, const Workshop& workshop, const std::string& stem) {
    Builder builder(workshop, stem);
    for (size_t first = 0; first < parts.size(); first += kPartsOfProgram) {
        std::vector<const ProgramPart*> some;
        for (size_t i = first; i < std::min(parts.size(), first + kPartsOfProgram); ++i) some.push_back(&parts[i]);
        builder.build(std::move(some));
    }
    return std::move(builder.out);
}

std::string find_compiler() {
    for (const char* name : {"g++", "clang++", "c++"})
        if (std::string path = program_path(name); !path.empty()) return path;
    return {};
}

void write_prelude(const Workshop& workshop) {
    for (const char* name : {"vectors.h", "harness.h"})
        write_text(workshop.folder + "/" + name, std::string(prelude_file(name)));
}

}  // namespace porttool
