// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/definitions.h"

#include <algorithm>

#include "porttool/difftest/prelude.h"
#include "porttool/read/source_files.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/includes.h"
#include "porttool/sync/unit_extent.h"

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

/// The name of a macro's directive: `# define NAME`.
std::string_view macro_name(const LexedText& lexed, const Directive& directive) {
    return directive.end_token >= directive.first_token + 3 ? lexed.view(directive.first_token + 2)
                                                            : std::string_view();
}

/// True for the `#ifndef NAME` of a header's guard.
bool is_guard(const ScannedFile& file, size_t i) {
    const std::vector<Directive>& all = file.lexed.directives;
    if (i + 1 >= all.size() || all[i + 1].kind != DirectiveKind::Define) return false;
    const Directive& one = all[i];
    return one.kind == DirectiveKind::If && one.end_token == one.first_token + 3 &&
           file.lexed.view(one.first_token + 1) == "ifndef" && all[i + 1].end_token == all[i + 1].first_token + 3 &&
           file.lexed.view(one.first_token + 2) == macro_name(file.lexed, all[i + 1]);
}

/// For each directive, those that decide about what follows it: of every open group the `#if` and what came after.
class Conditions {
public:
    explicit Conditions(const ScannedFile& file) : file_(file) {
        std::vector<std::vector<uint32_t>> open;
        const std::vector<Directive>& all = file.lexed.directives;
        for (uint32_t i = 0; i < all.size(); ++i) {
            if (all[i].kind == DirectiveKind::If) open.push_back({});
            const bool about = all[i].kind == DirectiveKind::If || all[i].kind == DirectiveKind::Elif ||
                               all[i].kind == DirectiveKind::Else;
            if (about && !open.empty() && !is_guard(file, i)) open.back().push_back(i);
            if (all[i].kind == DirectiveKind::Endif && !open.empty()) open.pop_back();
            if (about || all[i].kind == DirectiveKind::Endif) after_.emplace_back(all[i].first_token, open);
        }
    }
    void set(Definition& definition) const {
        const auto after = std::upper_bound(after_.begin(), after_.end(), definition.tokens.first,
                                            [](uint32_t token, const auto& entry) { return token < entry.first; });
        if (after == after_.begin()) return;
        for (const std::vector<uint32_t>& group : std::prev(after)->second) {
            if (group.empty()) continue;
            ++definition.open_conditions;
            definition.conditions.insert(definition.conditions.end(), group.begin(), group.end());
        }
    }

private:
    const ScannedFile& file_;
    std::vector<std::pair<uint32_t, std::vector<std::vector<uint32_t>>>> after_;
};

/// The name that `typedef ... NAME;` or `using NAME = ...;` gives; "" for others.
std::string_view type_name(const LexedText& lexed, TokenRange statement) {
    if (lexed.view(statement.first) == "using")
        return statement.end > statement.first + 3 && lexed.view(statement.first + 2) == "="
                   ? lexed.view(statement.first + 1)
                   : std::string_view();
    for (uint32_t i = statement.end; i-- > statement.first + 1;)
        if (lexed.tokens[i].kind == TokenKind::Identifier) return lexed.view(i);
    return {};
}

Definition::Kind kind_of_unit(const LexedText& lexed, const Unit& unit) {
    if (unit.kind == UnitKind::Struct) return Definition::Kind::Struct;
    if (unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel) return Definition::Kind::Function;
    if (lexed.view(unit.tokens.first) == "#") return Definition::Kind::Macro;
    // What is only initialised before the start can change later.
    for (uint32_t i = unit.tokens.first; i < unit.name_token; ++i)
        if (lexed.view(i) == "thread_local" || lexed.view(i) == "constinit") return Definition::Kind::Variable;
    return Definition::Kind::Constant;
}

/// The last part of a name, without `#2`.
std::string bare_leaf(std::string_view name) {
    const std::string_view leaf = leaf_of(name);
    return std::string(leaf.substr(0, leaf.find('#')));
}

}  // namespace

void Definitions::add(Definition definition) {
    if (definition.name.empty()) return;
    all_.push_back(std::move(definition));
    const Definition* const one = &all_.back();
    by_file_[one->file][one->name].push_back(one);
    everywhere_[one->name].push_back(one);
}

void Definitions::add_file(const ScannedFile& file) {
    const LexedText& lexed = file.lexed;
    const Conditions conditions(file);
    const auto add_with = [&](Definition definition) {
        conditions.set(definition);
        add(std::move(definition));
    };
    std::vector<TokenRange> taken;
    for (const Unit& unit : file.units) {
        if (unit.kind == UnitKind::File) continue;
        Definition one{kind_of_unit(lexed, unit), &file, &unit, unit.tokens, bare_leaf(unit.name), {}, {}, 0};
        if (one.kind == Definition::Kind::Macro) continue;  // all directives are read below
        one.tokens = extent_of(file, unit).tokens;
        taken.push_back(one.tokens);
        const std::string_view spaces = std::string_view(unit.name).substr(0, unit.namespace_length);
        for (size_t at = 0; at < spaces.size();) {
            const size_t end = std::min(spaces.find("::", at), spaces.size());
            if (end > at) namespaces_.insert(std::string(spaces.substr(at, end - at)));
            at = end + 2;
        }
        const std::string_view rest =
            std::string_view(unit.name).substr(std::min<size_t>(unit.namespace_length, unit.name.size()));
        const size_t last = rest.rfind("::");
        if (last != std::string_view::npos) one.owner = bare_leaf(rest.substr(0, last));
        add_with(std::move(one));
    }
    for (const Directive& directive : lexed.directives)
        if (directive.kind == DirectiveKind::Define)
            add_with({Definition::Kind::Macro,
                      &file,
                      nullptr,
                      {directive.first_token, directive.end_token},
                      std::string(macro_name(lexed, directive)),
                      {},
                      {},
                      0});
    std::sort(taken.begin(), taken.end(), [](TokenRange a, TokenRange b) { return a.first < b.first; });
    auto next = taken.begin();
    for (uint32_t i = 0; i < lexed.tokens.size(); ++i) {
        while (next != taken.end() && next->end <= i) ++next;
        if (next != taken.end() && next->first <= i) {
            i = next->end - 1;
            continue;
        }
        const std::string_view word = lexed.view(i);
        if (word != "typedef" && word != "using") continue;
        uint32_t end = i;
        while (end < lexed.tokens.size() && lexed.view(end) != ";") ++end;
        const TokenRange statement{i, std::min<uint32_t>(end + 1, static_cast<uint32_t>(lexed.tokens.size()))};
        add_with(
            {Definition::Kind::Type, &file, nullptr, statement, std::string(type_name(lexed, statement)), {}, {}, 0});
        i = end;
    }
    for (const FileVariable& variable : file.variables) {
        const std::string name(lexed.view(variable.name_token));
        if (variable.about != FileVariable::Declares || by_file_[&file].contains(name)) continue;
        add_with({Definition::Kind::Variable, &file, nullptr, variable.tokens, name, {}, {}, 0});
    }
}

Definitions::Definitions(const std::vector<ScannedFile>& files, const std::string& root, const Disk& disk,
                         const std::vector<std::string>& preamble)
    : root_(root), disk_(disk) {
    for (const ScannedFile& file : files) paths_.emplace(file.path, &file);
    for (const ScannedFile& file : files) add_file(file);
    if (!preamble.empty()) {
        read_.push_back(scan_text("preamble.glsl", preamble.front()));
        preamble_ = &read_.back();
        add_file(*preamble_);
    }
    for (const ScannedFile& file : files) (void)reached(file);
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

const std::vector<const ScannedFile*>& Definitions::reached(const ScannedFile& from) const {
    const auto [at, is_new] = reached_.try_emplace(&from);
    if (!is_new) return at->second;
    std::vector<const ScannedFile*> out = {&from};
    for (size_t i = 0; i < out.size(); ++i)
        for (const IncludeLine& line : include_lines(*out[i])) {
            if (line.what.size() < 3) continue;
            const ScannedFile* const file =
                included(*out[i], std::string_view(line.what).substr(1, line.what.size() - 2));
            if (file != nullptr && std::find(out.begin(), out.end(), file) == out.end()) out.push_back(file);
        }
    return at->second = out;
}

const std::vector<const Definition*>& Definitions::find(const ScannedFile& from, std::string_view name) const {
    const auto [at, is_new] = found_.try_emplace({&from, std::string(name)});
    if (!is_new) return at->second;
    std::vector<const ScannedFile*> order = reached(from);
    if (preamble_ != nullptr) order.push_back(preamble_);
    for (const ScannedFile* file : order) {
        const auto names = by_file_.find(file);
        if (names == by_file_.end()) continue;
        if (const auto found = names->second.find(name); found != names->second.end()) {
            // Overloads of one name stand in several files as well: math.h and color.h.
            if (at->second.empty() || found->second.front()->kind == Definition::Kind::Function)
                at->second.insert(at->second.end(), found->second.begin(), found->second.end());
            if (at->second.front()->kind != Definition::Kind::Function) break;
        }
    }
    if (!at->second.empty() || is_prelude_word(name)) return at->second;
    const auto other = everywhere_.find(name);
    if (other == everywhere_.end()) return at->second;
    const std::string folder = folder_of(from.path);
    const ScannedFile* best = nullptr;
    for (const Definition* one : other->second) {
        if (one->kind == Definition::Kind::Variable || one->file->language != from.language) continue;
        if (best == nullptr || (folder_of(one->file->path) == folder && folder_of(best->path) != folder))
            best = one->file;
    }
    for (const Definition* one : other->second)
        if (one->file == best) at->second.push_back(one);
    return at->second;
}

std::vector<const Definition*> Definitions::find_macro(const ScannedFile& from, std::string_view name) const {
    std::vector<const ScannedFile*> order = reached(from);
    if (preamble_ != nullptr) order.push_back(preamble_);
    for (const ScannedFile* file : order) {
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
    const auto found = names->second.find(bare_leaf(unit.name));
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
