// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/definitions.h"

#include <algorithm>
#include <cctype>

#include "porttool/difftest/prelude.h"
#include "porttool/read/source_files.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/includes.h"

namespace porttool {
namespace {

constexpr size_t kMostHeaders = 2000;  ///< read for one side, beyond those that its globs name

std::string folder_of(std::string_view path) {
    const size_t slash = path.find_last_of('/');
    return slash == std::string_view::npos ? std::string() : std::string(path.substr(0, slash + 1));
}

/// Without `.` and `..`; "" for a path that leads out.
std::string plain_path(const std::string& path) {
    std::vector<std::string> parts;
    size_t at = 0;
    while (at <= path.size()) {
        const size_t end = std::min(path.find('/', at), path.size());
        const std::string part = path.substr(at, end - at);
        at = end + 1;
        if (part.empty() || part == ".") continue;
        if (part != "..") {
            parts.push_back(part);
        } else {
            if (parts.empty()) return {};
            parts.pop_back();
        }
    }
    std::string out;
    for (const std::string& part : parts) out += (out.empty() ? "" : "/") + part;
    return out;
}

/// A file that a line includes by a macro, `#include QUOTED(FOLDER/name.h)`, and behind which byte: what the folder is
/// only the build knows.
std::vector<std::pair<size_t, std::string>> included_by_macro(const ScannedFile& file) {
    const LexedText& lexed = file.lexed;
    std::vector<std::pair<size_t, std::string>> out;
    for (const Directive& directive : lexed.directives) {
        if (directive.kind != DirectiveKind::Include || directive.line != directive.end_line) continue;
        const size_t first = lexed.line_starts[directive.line - 1];
        const size_t end = std::min(lexed.text.find('\n', first), lexed.text.size());
        const std::string_view line = std::string_view(lexed.text).substr(first, end - first);
        const size_t close = line.rfind(')');
        if (line.find_first_of("<\"") != std::string_view::npos || close == std::string_view::npos) continue;
        const size_t slash = line.find_last_of("/(, ", close - 1);
        const std::string_view name = line.substr(slash + 1, close - slash - 1);
        if (name.find('.') != std::string_view::npos) out.emplace_back(end, name);
    }
    return out;
}

/// True where one of these functions takes the same parameters, as copies of a helper in several files do.
bool is_known(const std::vector<const Definition*>& found, const Definition& one) {
    if (one.kind != Definition::Kind::Function || one.unit == nullptr || !one.conditions.empty()) return false;
    return std::any_of(found.begin(), found.end(), [&](const Definition* other) {
        if (other->kind != one.kind || other->file == one.file || other->owner != one.owner) return false;
        const TokenRange a = one.unit->parameters, b = other->unit->parameters;
        if (a.end - a.first != b.end - b.first) return false;
        for (uint32_t i = 0; i < a.end - a.first; ++i)
            if (one.file->lexed.view(a.first + i) != other->file->lexed.view(b.first + i)) return false;
        return true;
    });
}

/// True for languages one of which may use what the other defines: a header of C++ and a source of CUDA.
bool are_related(Language a, Language b) { return a == b || (!has_vector_types(a) && !has_vector_types(b)); }

bool is_header(const ScannedFile& file) { return file.path.ends_with(".h") || file.path.ends_with(".hpp"); }

/// True for a header that is read by files of another language, whichever includes it: what a host hands to its
/// kernels need not be included by any.
bool is_shared_header(const ScannedFile& file) {
    const bool shared =
        file.language == Language::C || file.language == Language::Cpp || file.language == Language::Unknown;
    return shared && is_header(file);
}

/// True where what was found may stand beside others: overloads, or macros of a condition that may not hold.
bool goes_on(const std::vector<const Definition*>& found) {
    return std::all_of(found.begin(), found.end(), [](const Definition* one) {
        return one->kind == Definition::Kind::Function ||
               (one->kind == Definition::Kind::Macro && !one->conditions.empty());
    });
}

}  // namespace

std::vector<const Definition*> Definitions::all_of(Definition::Kind kind) const {
    std::vector<const Definition*> out;
    for (const Definition& one : all_)
        if (one.kind == kind) out.push_back(&one);
    return out;
}

void Definitions::add_file(const ScannedFile& file) {
    for (Definition& piece : pieces_of(file)) {
        all_.push_back(std::move(piece));
        const Definition* const one = &all_.back();
        std::vector<std::string> names = further_names(*one);
        names.push_back(one->name);
        for (const std::string& name : names) {
            by_file_[&file][name].push_back(one);
            everywhere_[name].push_back(one);
        }
    }
    for (const Unit& unit : file.units) add_namespaces(unit);
}

void Definitions::add_namespaces(const Unit& unit) {
    const std::string_view spaces = std::string_view(unit.name).substr(0, unit.namespace_length);
    for (size_t at = 0; at < spaces.size();) {
        const size_t end = std::min(spaces.find("::", at), spaces.size());
        if (end > at) namespaces_.insert(std::string(spaces.substr(at, end - at)));
        at = end + 2;
    }
}

Definitions::Definitions(const std::vector<ScannedFile>& files, const std::string& root, const Disk& disk,
                         const std::vector<std::string>& preamble, const BuildDefines& build)
    : root_(root), disk_(disk), build_(build) {
    for (const ScannedFile& file : files) paths_.emplace(file.path, &file);
    for (const ScannedFile& file : files) add_file(file);
    if (!preamble.empty()) {
        read_.push_back(scan_text("preamble.glsl", preamble.front()));
        preamble_ = &read_.back();
        add_file(*preamble_);
    }
    for (const ScannedFile& file : files) (void)reached(file);
    for (const auto& [from, others] : includes_)
        for (const auto& [behind, file] : others) included_.insert(file);
    namespaces_.erase("std");
}

const ScannedFile* Definitions::included(const ScannedFile& from, std::string_view what) const {
    const std::string here = folder_of(from.path);
    std::vector<std::string> tried = {plain_path(here + std::string(what))};
    for (std::string above = here;; above = folder_of(above.substr(0, above.size() - 1))) {
        for (const char* folder : {"", "include/", "src/"})
            tried.push_back(plain_path(above + folder + std::string(what)));
        if (above.empty()) break;
    }
    for (const std::string& path : tried) {
        if (path.empty()) continue;
        if (const auto known = paths_.find(path); known != paths_.end()) return known->second;
    }
    for (const std::string& path : tried) {
        if (path.empty()) continue;
        const auto [at, is_new] = headers_.try_emplace(path, nullptr);
        if (at->second != nullptr) return at->second;
        if (!is_new || headers_.size() > kMostHeaders) continue;
        const FileText text = disk_.read(TreePath{root_, path}, kLargestSource);
        if (!text.error.empty() || !unreadable_reason(text.bytes).empty()) continue;
        read_.push_back(scan_text(path, text.bytes));
        at->second = &read_.back();
        const_cast<Definitions*>(this)->add_file(read_.back());
        return at->second;
    }
    return nullptr;
}

const Definitions::Includes& Definitions::includes(const ScannedFile& file) const {
    const auto [at, is_new] = includes_.try_emplace(&file);
    if (!is_new) return at->second;
    Includes out;
    for (const IncludeLine& line : include_lines(file)) {
        if (line.what.size() < 3) continue;
        const ScannedFile* const other = included(file, std::string_view(line.what).substr(1, line.what.size() - 2));
        if (other != nullptr) out.emplace_back(line.next, other);
    }
    for (const auto& [behind, what] : included_by_macro(file))
        if (const ScannedFile* const other = included(file, what); other != nullptr) out.emplace_back(behind, other);
    std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    return includes_[&file] = std::move(out);
}

const std::vector<const ScannedFile*>& Definitions::reached(const ScannedFile& from) const {
    const auto [at, is_new] = reached_.try_emplace(&from);
    if (!is_new) return at->second;
    std::vector<const ScannedFile*> out = {&from};
    std::set<const ScannedFile*> seen = {&from};
    for (size_t i = 0; i < out.size(); ++i)
        for (const auto& [behind, file] : includes(*out[i]))
            if (seen.insert(file).second) out.push_back(file);
    return reached_[&from] = std::move(out);
}

std::pair<size_t, size_t> ReadingOrder::place(const ScannedFile& file, size_t offset) const {
    const auto parts = parts_.find(&file);
    if (parts == parts_.end()) return {0, offset};
    const auto after = std::upper_bound(parts->second.begin(), parts->second.end(), offset,
                                        [](size_t at, const auto& part) { return at < part.first; });
    return {after == parts->second.begin() ? 0 : std::prev(after)->second, offset};
}

ReadingOrder Definitions::reading_order(const std::vector<const ScannedFile*>& files) const {
    ReadingOrder out;
    std::set<const ScannedFile*> entered;
    std::vector<std::pair<const ScannedFile*, size_t>> open;
    const auto enter = [&](const ScannedFile* file) {
        // What the build defines stands before all.
        if (of_build_.contains(file) || !entered.insert(file).second) return;
        out.add(*file, 0);
        open.emplace_back(file, 0);
    };
    for (const ScannedFile* from : files) {
        enter(from);
        while (!open.empty()) {
            const auto [file, next] = open.back();
            const Includes& others = includes(*file);
            if (next > 0) out.add(*file, others[next - 1].first);
            if (next == others.size()) {
                open.pop_back();
                continue;
            }
            ++open.back().second;
            enter(others[next].second);
        }
    }
    return out;
}

const ScannedFile* Definitions::build_text(const ScannedFile& from) const {
    const std::string& text = build_.text_for(from.path);
    if (text.empty()) return nullptr;
    const auto [at, is_new] = build_texts_.try_emplace(text, nullptr);
    if (is_new) {
        read_.push_back(scan_text("build_flags.h", text));
        at->second = &read_.back();
        of_build_.insert(at->second);
        const_cast<Definitions*>(this)->add_file(read_.back());
    }
    return at->second;
}

std::vector<const ScannedFile*> Definitions::all_reached(const ScannedFile& from) const {
    std::vector<const ScannedFile*> out = reached(from);
    if (preamble_ != nullptr) out.push_back(preamble_);
    if (const ScannedFile* const build = build_text(from); build != nullptr) out.push_back(build);
    return out;
}

bool Definitions::is_macro_as_tag(const Definition& one, std::string_view name) const {
    if (one.kind != Definition::Kind::Struct || one.name == name) return false;
    const auto all = everywhere_.find(name);
    return all != everywhere_.end() && std::any_of(all->second.begin(), all->second.end(), [](const Definition* other) {
               return other->kind == Definition::Kind::Macro;
           });
}

const std::vector<const Definition*>& Definitions::find(const ScannedFile& from, std::string_view name) const {
    const auto [at, is_new] = found_.try_emplace({&from, std::string(name)});
    if (!is_new) return at->second;
    for (const ScannedFile* file : all_reached(from)) {
        const auto names = by_file_.find(file);
        if (names == by_file_.end()) continue;
        if (const auto found = names->second.find(name); found != names->second.end()) {
            // Overloads of one name stand in several files as well: math.h and color.h.
            if (at->second.empty() || goes_on(at->second))
                for (const Definition* one : found->second)
                    if (!is_known(at->second, *one) && !is_macro_as_tag(*one, name)) at->second.push_back(one);
            if (!goes_on(at->second)) break;
        }
    }
    const bool only_conditional =
        !at->second.empty() && at->second.back()->kind == Definition::Kind::Macro && goes_on(at->second);
    if ((!at->second.empty() && !only_conditional) || is_prelude_word(name)) return at->second;
    const auto other = everywhere_.find(name);
    if (other == everywhere_.end()) return at->second;
    const std::string folder = folder_of(from.path);
    const ScannedFile *best = nullptr, *header = nullptr;
    for (const Definition* one : other->second) {
        if (of_build_.contains(one->file)) continue;  // that of another folder
        if (one->kind == Definition::Kind::Variable || is_macro_as_tag(*one, name)) continue;
        if (only_conditional && one->kind == Definition::Kind::Macro) continue;
        if (is_of_other_system(*one)) continue;
        const bool related = are_related(one->file->language, from.language);
        if (!related && !is_shared_header(*one->file)) continue;
        const ScannedFile*& nearest = related ? best : header;
        if (nearest == nullptr || (folder_of(one->file->path) == folder && folder_of(nearest->path) != folder))
            nearest = one->file;
    }
    if (best == nullptr) best = header;
    for (const Definition* one : other->second)
        if (one->file == best && !(only_conditional && one->kind == Definition::Kind::Macro)) at->second.push_back(one);
    return at->second;
}

bool Definitions::is_of_other_system(const Definition& one) const {
    return one.kind == Definition::Kind::Macro && takes_arguments(one) && is_header(*one.file) &&
           !included_.contains(one.file) &&
           std::none_of(one.name.begin(), one.name.end(), [](unsigned char c) { return std::isupper(c) != 0; });
}

std::vector<const Definition*> Definitions::find_macro(const ScannedFile& from, std::string_view name) const {
    for (const ScannedFile* file : all_reached(from)) {
        const auto names = by_file_.find(file);
        if (names == by_file_.end()) continue;
        if (const auto found = names->second.find(name); found != names->second.end()) return found->second;
    }
    return {};
}

std::vector<const Definition*> Definitions::operators(const ScannedFile& from, std::string_view type) const {
    std::vector<const Definition*> out;
    for (const ScannedFile* file : reached(from)) {
        const auto names = by_file_.find(file);
        if (names == by_file_.end()) continue;
        for (auto at = names->second.lower_bound("operator");
             at != names->second.end() && at->first.starts_with("operator"); ++at)
            for (const Definition* one : at->second) {
                if (one->unit == nullptr || !one->owner.empty()) continue;
                const TokenRange parameters = one->unit->parameters;
                bool about = false;
                for (uint32_t i = parameters.first; i < parameters.end && !about; ++i)
                    about = file->lexed.view(i) == type;
                if (about) out.push_back(one);
            }
    }
    return out;
}

std::vector<const Definition*> Definitions::members(std::string_view owner) const {
    std::vector<const Definition*> out;
    for (const Definition& one : all_)
        if (one.kind == Definition::Kind::Function && one.owner == owner) out.push_back(&one);
    return out;
}

const Definition* Definitions::of_unit(const ScannedFile& file, const Unit& unit) const {
    const auto names = by_file_.find(&file);
    if (names == by_file_.end()) return nullptr;
    const auto found = names->second.find(bare_leaf_of(unit.name));
    if (found == names->second.end()) return nullptr;
    for (const Definition* one : found->second)
        if (one->unit == &unit) return one;
    return nullptr;
}

std::set<std::string> Definitions::standard_headers(const ScannedFile& from) const {
    std::set<std::string> out;
    for (const ScannedFile* file : reached(from))
        for (const IncludeLine& line : include_lines(*file))
            if (const std::string known = standard_include(line.what, Language::Cpp); !known.empty()) out.insert(known);
    return out;
}

}  // namespace porttool
