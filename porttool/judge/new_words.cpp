// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/new_words.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace porttool {
namespace {

using Kind = DeclaredWord::Kind;

class WordDifference {
public:
    WordDifference(const FilesOfSide& now, const FilesOfSide& then) : now_(now), then_(then) {
        for (size_t i = 0; i < then.size(); ++i) then_by_path_.emplace(then.path(i), i);
        for (size_t i = 0; i < now.size(); ++i) {
            const auto before = then_by_path_.find(now.path(i));
            if (before == then_by_path_.end() || !is_same(i, before->second)) changed_.push_back(i);
        }
    }

    NewWords run() {
        NewWords out;
        if (changed_.empty()) return out;
        for (size_t i = 0; i < now_.size(); ++i) note_opened(now_.text(i), out.opened);
        if (!says_something()) return out;
        for (size_t i = 0; i < then_.size(); ++i)
            for (const SaidThen& one : said_then(i)) {
                if (one.kind == Kind::Brought || one.kind == Kind::Opened)
                    out.brought_before.emplace(then_.path(i), one.word);
                ++said_[one.print];
                if (one.kind != Kind::Opened && one.kind != Kind::Macro) known_.insert(one.word);
            }
        for (size_t i = 0; i < now_.size(); ++i)
            now_.visit_scanned(i, [&](const ScannedFile& file) {
                for (const DeclaredWord& one : declared_words(file)) {
                    if (one.kind == Kind::Opened) out.opened.emplace(word_of(file, one));
                    --said_[one.print];
                }
            });
        for (const size_t i : changed_) add_new(i, out);
        return out;
    }

private:
    struct SaidThen {
        Kind kind;
        Print print;
        std::string word;
    };

    /// What a file said at the merge base, for which it is scanned once.
    const std::vector<SaidThen>& said_then(size_t i) {
        const auto [known, is_new] = said_then_.try_emplace(i);
        if (is_new)
            then_.visit_scanned(i, [&said = known->second](const ScannedFile& file) {
                for (const DeclaredWord& one : declared_words(file))
                    said.push_back({one.kind, one.print, std::string(word_of(file, one))});
            });
        return known->second;
    }

    bool is_same(size_t now, size_t then) const { return now_.text(now) == then_.text(then); }

    /// True if a file that changed says anything of a word but by a macro, which is told of its own unit's name alone.
    bool says_something() {
        const auto says_other = [&](size_t i) {
            std::unordered_map<Print, int64_t> more;  // than then
            now_.visit_scanned(i, [&](const ScannedFile& file) {
                for (const DeclaredWord& one : declared_words(file)) ++more[one.print];
            });
            if (const auto before = then_by_path_.find(now_.path(i)); before != then_by_path_.end())
                for (const SaidThen& one : said_then(before->second)) --more[one.print];
            return std::any_of(more.begin(), more.end(), [](const auto& one) { return one.second != 0; });
        };
        return std::any_of(changed_.begin(), changed_.end(), says_other);
    }

    /// The last names behind `using namespace` and `inline namespace`, wherever these stand.
    static void note_opened(std::string_view text, std::set<std::string>& out) {
        constexpr std::string_view kNamespace = "namespace", kBlanks = " \t\r\n";
        for (size_t at = text.find(kNamespace); at != std::string_view::npos; at = text.find(kNamespace, at + 1)) {
            const size_t last = text.substr(0, at).find_last_not_of(kBlanks);
            if (last == std::string_view::npos) continue;
            const std::string_view before = text.substr(0, last + 1);
            if (!before.ends_with("using") && !before.ends_with("inline")) continue;
            constexpr size_t kLongest = 1024;
            std::string_view path = text.substr(at + kNamespace.size(), kLongest);
            path = path.substr(0, path.find_first_of(";{"));
            const size_t tail = path.find_last_not_of(kBlanks);
            if (tail == std::string_view::npos) continue;
            path = path.substr(0, tail + 1);
            out.emplace(path.substr(path.find_last_of(": \t\r\n") + 1));
        }
    }

    void add_new(size_t i, NewWords& out) {
        const ScannedFile& file = now_.scanned(i);
        std::unordered_set<Print> here;  // what the file said already
        if (const auto before = then_by_path_.find(file.path); before != then_by_path_.end())
            for (const SaidThen& one : said_then(before->second)) here.insert(one.print);
        for (DeclaredWord& one : declared_words(file)) {
            if (said_[one.print] >= 0 || here.contains(one.print)) continue;
            const bool is_known = known_.contains(std::string(word_of(file, one)));
            out.words.push_back({&file, std::move(one), is_known});
        }
    }

    const FilesOfSide &now_, &then_;
    std::unordered_map<std::string_view, size_t> then_by_path_;
    std::vector<size_t> changed_;
    std::unordered_map<size_t, std::vector<SaidThen>> said_then_;  ///< by file
    std::unordered_map<Print, int64_t> said_;                      ///< how often then, less how often now
    std::unordered_set<std::string> known_;
};

}  // namespace

NewWords new_words(const FilesOfSide& now, const FilesOfSide& then) { return WordDifference(now, then).run(); }

bool is_header(std::string_view path) {
    static const std::set<std::string_view> kCompiled = {
        ".c",    ".cc",   ".cpp",  ".cxx",  ".c++",  ".cu",   ".hip",  ".ispc",  ".m",     ".mm",    ".metal", ".comp",
        ".vert", ".frag", ".geom", ".tesc", ".tese", ".rgen", ".rint", ".rahit", ".rchit", ".rmiss", ".rcall"};
    return !kCompiled.contains(path.substr(std::min(path.rfind('.'), path.size())));
}

}  // namespace porttool
