// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/word_macros.h"

#include <algorithm>
#include <set>

#include "porttool/language/words.h"
#include "porttool/scan/macros.h"
#include "porttool/text/fingerprint.h"

namespace porttool {
namespace {

constexpr size_t kMostWords = 64, kHashDigits = 8;

std::string_view last_part(std::string_view path) { return path.substr(path.rfind('/') + 1); }

std::string short_hash(const std::set<std::string>& texts) {
    Fingerprinter print;
    for (const std::string& text : texts) print.add(text);
    return print.digits().substr(0, kHashDigits);
}

/// What stands between the quotes or angles of an `#include`; "" for a macro in their place.
std::string included_name(const LexedText& lexed, const Directive& directive) {
    std::string out;
    for (uint32_t at = directive.first_token + 2; at < directive.end_token; ++at) out += lexed.view(at);
    const bool is_name = out.size() > 2 && (out.front() == '"' || out.front() == '<');
    return is_name ? out.substr(1, out.size() - 2) : std::string();
}

/// A path without `.` and `..`.
std::string plain_path(std::string_view path) {
    std::vector<std::string_view> parts;
    for (size_t at = 0; at <= path.size();) {
        const size_t end = std::min(path.find('/', at), path.size());
        const std::string_view part = path.substr(at, end - at);
        if (part == ".." && !parts.empty())
            parts.pop_back();
        else if (!part.empty() && part != "." && part != "..")
            parts.push_back(part);
        at = end + 1;
    }
    std::string out;
    for (const std::string_view part : parts) out += (out.empty() ? "" : "/") + std::string(part);
    return out;
}

/// True for a replacement that says how a function is called or linked, or where it runs, and nothing else.
bool only_promises(const LexedText& lexed, uint32_t first, uint32_t end) {
    if (first >= end) return false;
    for (uint32_t at = first; at < end; ++at)
        if (!word_is(lexed.view(at), kPromise | kHeadPromise | kDropped)) return false;
    return true;
}

}  // namespace

WordMacros::WordMacros(const std::vector<ScannedFile>& files) : files_(files) {
    for (const ScannedFile& file : files) read(file);
}

void WordMacros::read(const ScannedFile& file) {
    const LexedText& lexed = file.lexed;
    auto unit = file.units.begin();
    for (const Directive& directive : lexed.directives) {
        const uint32_t name = directive.first_token + 2;
        const bool defines = directive.kind == DirectiveKind::Define;
        if (name >= directive.end_token || (lexed.tokens[name].flags & kDead) != 0) continue;
        if (!defines && (directive.kind != DirectiveKind::Other || lexed.view(name - 1) != "undef")) continue;
        if (redefines_word(lexed.view(name)) || only_promises(lexed, name + 1, directive.end_token)) continue;
        while (unit != file.units.end() && unit->tokens.first < directive.first_token) ++unit;
        const bool is_unit = unit != file.units.end() && unit->tokens.first == directive.first_token;
        by_word_[lexed.view(name)].push_back({&file, &directive, is_unit});
    }
}

std::string WordMacros::text_of(const Definition& definition) {
    const LexedText& lexed = definition.file->lexed;
    const Directive& directive = *definition.directive;
    std::string out = "#" + std::string(lexed.view(directive.first_token + 1));
    const uint32_t end = definition.is_unit ? directive.first_token + 3 : directive.end_token;
    for (uint32_t at = directive.first_token + 2; at < end; ++at) out += " " + std::string(lexed.view(at));
    return out + (definition.is_unit ? " ..." : "");
}

std::string WordMacros::of(const std::string& path, const NormalText& text) {
    std::map<std::string_view, std::string> found;
    for (size_t i = 0; !by_word_.empty() && i < text.size(); ++i) {
        const std::string_view word = text[i];
        if (!is_word_token(word)) continue;
        const auto defined = by_word_.find(word);
        if (defined == by_word_.end() || found.contains(word)) continue;
        std::set<std::string> texts;
        for (const Definition& one : defined->second)
            if (sees(path, one.file)) texts.insert(text_of(one));
        if (!texts.empty()) found.emplace(word, short_hash(texts));
    }
    std::string out;
    for (const auto& [word, hash] : found) out += (out.empty() ? "" : " ") + std::string(word) + ":" + hash;
    if (found.size() > kMostWords) return "*:" + short_hash({out});
    return out.empty() ? "-" : out;
}

std::vector<WordMacro> WordMacros::seen_from(const std::string& path, std::string_view word) {
    std::vector<WordMacro> out;
    const auto defined = by_word_.find(word);
    if (defined == by_word_.end()) return out;
    for (const Definition& one : defined->second)
        if (sees(path, one.file)) out.push_back({text_of(one), one.file->path, one.directive->line});
    return out;
}

bool WordMacros::sees(const std::string& path, const ScannedFile* file) {
    return file->path == path || seen_files(path)[static_cast<size_t>(file - files_.data())];
}

const WordMacros::Files& WordMacros::seen_files(const std::string& path) {
    const auto [known, fresh] = seen_.try_emplace(path);
    if (!fresh) return known->second;
    if (by_path_.empty())
        for (const ScannedFile& file : files_) {
            by_path_.emplace(file.path, &file);
            by_name_[last_part(file.path)].push_back(&file);
        }
    known->second.resize(files_.size());
    const auto start = by_path_.find(path);
    std::vector<const ScannedFile*> open;
    if (start != by_path_.end()) open.push_back(start->second);
    while (!open.empty()) {
        const ScannedFile* file = open.back();
        open.pop_back();
        const auto number = static_cast<size_t>(file - files_.data());
        if (known->second[number]) continue;
        known->second[number] = true;
        const auto [list, is_new] = includes_.try_emplace(file);
        if (is_new) list->second = included_by(*file);
        open.insert(open.end(), list->second.begin(), list->second.end());
    }
    return known->second;
}

/// The files that one includes: the one beside it, else all whose paths end so; where the compiler looks is not known.
std::vector<const ScannedFile*> WordMacros::included_by(const ScannedFile& file) {
    std::vector<const ScannedFile*> out;
    for (const Directive& directive : file.lexed.directives) {
        if (directive.kind != DirectiveKind::Include) continue;
        const std::string name = included_name(file.lexed, directive);
        if (name.empty()) continue;
        const std::string beside = plain_path(file.path.substr(0, file.path.rfind('/') + 1) + name);
        if (const auto found = by_path_.find(beside); found != by_path_.end()) {
            out.push_back(found->second);
            continue;
        }
        const std::string below = "/" + plain_path(name);
        const auto named = by_name_.find(last_part(below));
        if (named == by_name_.end()) continue;
        for (const ScannedFile* each : named->second)
            if (("/" + each->path).ends_with(below)) out.push_back(each);
    }
    return out;
}

std::map<std::string_view, std::string_view> words_with_macros(std::string_view words) {
    std::map<std::string_view, std::string_view> out;
    for (size_t at = 0; at < words.size();) {
        const size_t end = std::min(words.find(' ', at), words.size());
        const std::string_view part = words.substr(at, end - at);
        if (const size_t colon = part.find(':'); colon != std::string_view::npos)
            out.emplace(part.substr(0, colon), part.substr(colon + 1));
        at = end + 1;
    }
    return out;
}

}  // namespace porttool
