// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/added_branches.h"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "porttool/language/words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/directive_end.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

/// `A` of `# ifdef A`, `# if A` and `# if defined ( A )`, which begin at `at`; "" for any other condition.
std::string_view macro_asked_for(const Words& words, size_t at, size_t end) {
    size_t i = at + 2;
    if (i + 4 == end && words[i] == "defined" && words[i + 1] == "(")
        i += 2;
    else if (i + 1 != end)
        return {};
    return is_word_token(words[i]) && roles_of(words[i]) == 0 ? words[i] : std::string_view();
}

/// A text as a compiler reads it to which the macros of some branches mean nothing; or for which all are set.
class BranchReader {
public:
    BranchReader(const Words& words, const std::set<std::string_view>& known, bool are_set = false)
        : words_(words), known_(known), are_set_(are_set) {}

    /// The words that are left, or nothing where a branch cannot be told.
    std::optional<std::vector<std::string_view>> run() {
        for (size_t i = 0; i < words_.size();) {
            const size_t behind = read_line(i);
            if (failed_) return std::nullopt;
            if (behind == i && is_read()) out_.push_back(words_[i]);
            i = std::max(i + 1, behind);
        }
        if (!open_.empty()) return std::nullopt;
        return std::move(out_);
    }

    const std::set<std::string_view>& macros() const { return macros_; }

private:
    /// A branch that began; `is_own`: by a macro that is not known.
    struct Branch {
        bool is_own = false, is_read = true, has_else = false;
    };

    bool is_read() const {
        return std::all_of(open_.begin(), open_.end(), [](const Branch& branch) { return branch.is_read; });
    }

    /// Behind the preprocessor's words at `at` if they go with a macro of ours; else `at`.
    size_t read_line(size_t at) {
        if (words_[at] != "#" || at + 1 >= words_.size()) return at;
        const std::string_view kind = words_[at + 1];
        if (kind == "if" || kind == "ifdef" || kind == "ifndef") return read_opening(at);
        if (open_.empty()) return at;
        if (kind == "endif") {
            const Branch ended = open_.back();
            open_.pop_back();
            failed_ = ended.is_own && !ended.has_else;
            return ended.is_own ? at + 2 : at;
        }
        if (!kind.starts_with("el") || !open_.back().is_own) return at;
        failed_ = kind != "else";
        open_.back().is_read = !open_.back().is_read;
        open_.back().has_else = true;
        return at + 2;
    }

    size_t read_opening(size_t at) {
        const size_t end = opening_end(at);
        const std::string_view macro = end > at ? macro_asked_for(words_, at, end) : std::string_view();
        const bool is_own = !macro.empty() && !known_.contains(macro);
        open_.push_back({is_own, !is_own || (words_[at + 1] == "ifndef") != are_set_});
        if (!is_own) return at;
        macros_.insert(macro);
        failed_ = failed_ || is_macro_of_compilers(macro);
        return end;
    }

    /// Of `if A` no word tells the end but one that cannot go on with a condition.
    size_t opening_end(size_t at) const {
        if (const size_t end = directive_end(words_, at); end != 0 || at + 3 >= words_.size()) return end;
        const std::string_view next = words_[at + 3];
        return words_[at + 1] == "if" && (is_word_token(next) || is_one_of(next, {"#", "{", "}"})) ? at + 3 : 0;
    }

    const Words& words_;
    const std::set<std::string_view>& known_;
    bool are_set_;
    std::vector<Branch> open_;
    std::vector<std::string_view> out_;
    std::set<std::string_view> macros_;
    bool failed_ = false;
};

}  // namespace

bool is_macro_of_compilers(std::string_view name) {
    constexpr std::string_view kBegins[] = {"_",   "GL_",   "CL_",  "cl_",    "CUDA",  "HIP",  "SYCL", "ISPC",
                                            "MSL", "HLSL",  "SPIR", "VULKAN", "WIN",   "FP_",  "GLSL", "METAL",
                                            "OSL", "linux", "unix", "NDEBUG", "DEBUG", "SLANG"};
    // Of the standard library, which every compiler brings: `M_PI`, `FLT_MAX`, `DBL_EPSILON`.
    constexpr std::string_view kEnds[] = {"_MAX", "_MIN", "_EPSILON", "_DIG"};
    return name.starts_with("M_") ||
           std::any_of(std::begin(kBegins), std::end(kBegins),
                       [&](std::string_view begin) { return name.starts_with(begin); }) ||
           std::any_of(std::begin(kEnds), std::end(kEnds), [&](std::string_view end) { return name.ends_with(end); });
}

std::set<std::string_view> macros_of_added_branches(const Words& before, const Words& now) {
    if (std::count(now.begin(), now.end(), "#") <= std::count(before.begin(), before.end(), "#")) return {};
    // A macro that the text asked for before is one of the edit's where it asks for it more, or less, often now.
    std::map<std::string_view, int> times;
    for (const std::string_view word : now) ++times[word];
    for (const std::string_view word : before) --times[word];
    std::set<std::string_view> known;
    for (const std::string_view word : before)
        if (times[word] == 0) known.insert(word);
    BranchReader reader(now, known), old(before, known), with(now, known, true), old_with(before, known, true);
    const auto left = reader.run(), was = old.run(), set = with.run(), was_set = old_with.run();
    if (!left || !was || !set || !was_set || *left != *was) return {};
    const std::vector<DiffStep> steps = diff(*was_set, *set);
    if (std::none_of(steps.begin(), steps.end(), [](const DiffStep& step) { return step.kind == DiffStep::Remove; }))
        return {};
    std::set<std::string_view> macros = reader.macros();
    macros.insert(old.macros().begin(), old.macros().end());
    return macros;
}

std::string without_macros(const LexedText& file, const std::set<std::string_view>& macros) {
    std::string out;
    size_t copied = 0;
    for (const Directive& directive : file.directives) {
        if (directive.kind != DirectiveKind::If) continue;
        Words words;
        for (uint32_t i = directive.first_token; i < directive.end_token; ++i) words.push_back(file.view(i));
        const std::string_view macro = macro_asked_for(words, 0, words.size());
        if (!macros.contains(macro)) continue;
        const Token& last = file.tokens[directive.end_token - 1];
        out.append(file.text, copied, file.tokens[directive.first_token].offset - copied);
        out += words[1] == "ifndef" ? "#if 1" : "#if 0";
        copied = last.offset + last.length;
    }
    return out.append(file.text, copied);
}

}  // namespace porttool
