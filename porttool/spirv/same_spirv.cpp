// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/spirv/same_spirv.h"

#include <algorithm>

#include "porttool/normal/prelude.h"

namespace porttool {
namespace {

/// A token in normal form as GLSL reads it: `1f` stands for 1.0f there.
std::string as_glsl(const std::string& token, const std::string& name) {
    if (token == "@") return name;
    const size_t digits = std::min(token.find_first_not_of("0123456789"), token.size());
    const std::string rest = token.substr(digits);
    return digits > 0 && (rest == "f" || rest == "lf") ? token.substr(0, digits) + ".0" + rest : token;
}

/// Other files with one file's text replaced.
ShaderFiles with_text(const ShaderFiles& files, const std::string& path, const std::string& text) {
    return [&files, path, &text](const std::string& asked) { return asked == path ? &text : files(asked); };
}

std::string_view own_name(const ScannedFile& file, const Unit& unit) {
    return file.lexed.view(file.lexed.tokens[unit.name_token]);
}

/// A function with `#if` inside is several texts, of which a compile sees one.
bool has_branches(const ScannedFile& file, const Unit& unit) {
    return std::any_of(file.lexed.directives.begin(), file.lexed.directives.end(), [&](const Directive& d) {
        return d.first_token >= unit.tokens.first && d.first_token < unit.tokens.end;
    });
}

}  // namespace

SpirvComparer::SpirvComparer(ShaderSide side) : side_(std::move(side)) {
    if (side_.settings.preamble.empty()) side_.settings.preamble = {""};
    for (const std::string& entry : side_.entries)
        included_[entry] = files_included(side_.now, entry, side_.settings.include);
}

SpirvAnswer SpirvComparer::compare_unit(const ScannedFile& file, const Unit& unit, const NormalText& before) {
    std::string text;
    for (const std::string_view token : without_prelude(before.words()))
        text += as_glsl(std::string(token), std::string(own_name(file, unit))) + ' ';
    const Token &first = file.lexed.tokens[unit.tokens.first], &last = file.lexed.tokens[unit.tokens.end - 1];
    const std::string whole = file.lexed.text.substr(0, first.offset) + "\n" + text + "\n" +
                              file.lexed.text.substr(last.offset + last.length);
    return compare({file, unit}, with_text(side_.now, file.path, whole));
}

SpirvAnswer SpirvComparer::compare_files(const ScannedFile& file, const Unit& unit, const ShaderFiles& before) {
    return compare({file, unit}, before);
}

SpirvAnswer SpirvComparer::compare(const Subject& subject, const ShaderFiles& before) {
    SpirvAnswer answer;
    if (has_branches(subject.file, subject.unit)) {
        answer.obstacle = "it holds preprocessor lines, and a compile sees one branch only";
        return answer;
    }
    bool reached = false;
    for (const auto& [entry, included] : included_) {
        if (!included.contains(subject.file.path)) continue;
        answer.entries.push_back(entry);
        for (const std::string& preamble : side_.settings.preamble) {
            const SpirvModule& now = today(entry, preamble);
            const SpirvModule then = compile_to_spirv(before, entry, side_.settings.include, preamble);
            if (!now.error.empty() || !then.error.empty()) {
                answer.obstacle = entry + (now.error.empty() ? " with the earlier text" : "") +
                                  " does not compile: " + (now.error.empty() ? then.error : now.error);
                return answer;
            }
            if (now.stripped != then.stripped && now.reduced != then.reduced) return answer;
            reached = reached || reaches(subject, entry, preamble);
        }
    }
    if (answer.entries.empty())
        answer.obstacle = "no entry point (.comp, .vert, .rgen, ...) includes " + subject.file.path;
    else if (!reached)
        answer.obstacle = "no entry point calls it, or it lies in a branch of #if that is left out";
    answer.same = reached;
    return answer;
}

const SpirvModule& SpirvComparer::today(const std::string& entry, const std::string& preamble) {
    const auto [at, fresh] = today_.try_emplace({entry, preamble});
    if (fresh) at->second = compile_to_spirv(side_.now, entry, side_.settings.include, preamble);
    return at->second;
}

/// True if a statement put into the function's body shows in the compiled code.
bool SpirvComparer::reaches(const Subject& subject, const std::string& entry, const std::string& preamble) {
    const auto& [file, unit] = subject;
    const uint32_t at = file.lexed.tokens[unit.body.first].offset;
    const std::string probe = " int porttool_probe = 0; ++porttool_probe; ";
    const std::string text = file.lexed.text.substr(0, at) + probe + file.lexed.text.substr(at);
    const SpirvModule probed =
        compile_to_spirv(with_text(side_.now, file.path, text), entry, side_.settings.include, preamble);
    return probed.error.empty() && probed.stripped != today(entry, preamble).stripped;
}

}  // namespace porttool
