// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/source_files.h"

#include <algorithm>
#include <map>
#include <set>

#include "porttool/read/ignore_rules.h"
#include "porttool/scan/language.h"
#include "porttool/text/utf8.h"

namespace porttool {
namespace {

/// Walks folders below a root, reading each .gitignore on the way.
class Walker {
public:
    Walker(const Disk& disk, const std::string& root) : disk_(disk), root_(root) {}

    /// Calls `visit(path)` for each file below `folder` that is not ignored.
    template <class Visit>
    void walk(const std::string& folder, const Visit& visit) {
        std::vector<std::string> open = {folder == "." ? "" : folder};
        while (!open.empty()) {
            const std::string at = open.back();
            open.pop_back();
            const auto entries = disk_.list(join_path(root_, at.empty() ? "." : at));
            if (!entries) continue;
            const IgnoreRules& rules = rules_of(at);
            for (const DirectoryEntry& entry : *entries) {
                const std::string path = at.empty() ? entry.name : at + "/" + entry.name;
                if (entry.name == ".git" || rules.ignores(path, entry.is_directory)) continue;
                if (entry.is_directory)
                    open.push_back(path);
                else
                    visit(path);
            }
        }
    }

private:
    /// The rules that hold in a folder: its parent's and its own.
    const IgnoreRules& rules_of(const std::string& folder) {
        if (const auto known = rules_.find(folder); known != rules_.end()) return known->second;
        IgnoreRules rules;
        if (!folder.empty()) {
            const size_t slash = folder.find_last_of('/');
            rules = rules_of(slash == std::string::npos ? "" : folder.substr(0, slash));
        } else {
            const FileText exclude = disk_.read(join_path(root_, ".git/info/exclude"), kLargestFile);
            if (exclude.error.empty()) rules.add("", exclude.bytes);
        }
        const FileText own = disk_.read(join_path(root_, join_path(folder, ".gitignore")), kLargestFile);
        if (own.error.empty()) rules.add(folder, own.bytes);
        return rules_.emplace(folder, std::move(rules)).first->second;
    }

    const Disk& disk_;
    std::string root_;
    std::map<std::string, IgnoreRules> rules_;
};

SourceSet read_all(const Disk& disk, const std::string& root, const std::set<std::string>& paths) {
    SourceSet out;
    for (const std::string& path : paths) {
        FileText file = {"", unreadable_name(path)};
        if (file.error.empty()) file = disk.read(join_path(root, path), kLargestSource);
        if (file.error.empty()) file.error = unreadable_reason(file.bytes);
        if (file.error.empty())
            out.files.push_back({path, std::move(file.bytes)});
        else
            out.skipped.push_back({path, file.error});
    }
    return out;
}

/// `path` as seen from the root; an absolute path elsewhere stays as it is.
std::string below_root(const std::string& root, const std::string& path) {
    const std::string clean = clean_path(path);
    const std::string folder = clean_path(root);
    if (clean == folder) return ".";
    if (clean.starts_with(folder + "/")) return clean.substr(folder.size() + 1);
    return clean;
}

}  // namespace

std::string unreadable_name(const std::string& path) {
    return is_utf8(path) ? "" : "the name is not UTF-8; rename it to have it read";
}

std::string unreadable_reason(const std::string& bytes) {
    constexpr uint64_t kMebibyte = 1024 * 1024;
    if (bytes.size() > kLargestSource)
        return "is more than the " + std::to_string(kLargestSource / kMebibyte) + " MiB that are read of one source";
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
        return "is UTF-16; save it as UTF-8 to have it scanned";
    const size_t nul = bytes.find('\0');
    if (nul != std::string::npos) return "is binary: byte " + std::to_string(nul) + " is NUL";
    return {};
}

SourceSet read_paths(const Disk& disk, const std::string& root, const std::vector<std::string>& paths,
                     std::vector<std::string>& missing) {
    Walker walker(disk, root);
    std::set<std::string> found;
    for (const std::string& given : paths) {
        const std::string path = below_root(root, given);
        const std::string full = join_path(root, path);
        if (disk.is_directory(full)) {
            walker.walk(path, [&](const std::string& file) {
                if (language_of_path(file) != Language::Unknown) found.insert(file);
            });
        } else if (disk.exists(full) || disk.read(full, kLargestFile).error.find("No such file") == std::string::npos) {
            found.insert(path);
        } else {
            missing.push_back(given);
        }
    }
    return read_all(disk, root, found);
}

SourceSet read_globs(const Disk& disk, const std::string& root, const std::vector<std::string>& globs,
                     std::vector<std::string>& unmatched) {
    Walker walker(disk, root);
    std::set<std::string> found;
    std::map<std::string, std::vector<std::string>> listed;  // a root is walked once
    for (const std::string& text : globs) {
        const Glob glob(below_root(root, text.empty() ? "." : text) + (text.ends_with('/') ? "/" : ""));
        size_t count = 0;
        // `src/*.inc` asks for that suffix, `src/*` for what is known to be source.
        const bool names_suffix = text.find('.', text.find_last_of('/') + 1) != std::string::npos;
        auto take = [&](const std::string& file, bool named) {
            if (!glob.matches(file) || (!named && language_of_path(file) == Language::Unknown)) return;
            ++count;
            found.insert(file);
        };
        if (glob.literal() && disk.exists(join_path(root, glob.text())) &&
            !disk.is_directory(join_path(root, glob.text())))
            take(clean_path(glob.text()), true);
        for (const std::string& folder : glob.roots()) {
            auto files = listed.find(folder);
            if (files == listed.end()) {
                files = listed.emplace(folder, std::vector<std::string>()).first;
                walker.walk(folder, [&](const std::string& file) { files->second.push_back(file); });
            }
            for (const std::string& file : files->second) take(file, names_suffix);
        }
        if (count == 0) unmatched.push_back(text);
    }
    return read_all(disk, root, found);
}

}  // namespace porttool
