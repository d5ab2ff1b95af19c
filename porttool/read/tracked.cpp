// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/tracked.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "porttool/language/language.h"
#include "porttool/read/disk.h"
#include "porttool/read/git_repository.h"
#include "porttool/text/sink/shell.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

namespace fs = std::filesystem;

/// What tells an index from the one that it was: git replaces the file.
using IndexStamp = std::pair<fs::file_time_type, uintmax_t>;

/// The names in the index of a root's repository, asked for once as long as it stays as it is.
class KnownIndexes {
public:
    bool tracks(const std::string& root, const std::string& path) {
        const std::lock_guard lock(mutex_);
        return is_in(index_of(root), root, path);
    }

private:
    struct Index {
        std::string file;
        IndexStamp stamp = {};
        TrackedFiles tracked = {};
        std::string head = {};
    };

    static IndexStamp stamp_of(const std::string& file) {
        std::error_code error;
        return {fs::last_write_time(file, error), fs::file_size(file, error)};
    }

    const Index& index_of(const std::string& root) {
        Index& index = known_[root];
        if (!index.file.empty() && index.stamp == stamp_of(index.file)) return index;
        const GitRepository git(root);
        index = {};
        index.tracked.is_known = git.error().empty();
        if (!git.error().empty()) return index;
        index.file = git.index_file();
        index.stamp = stamp_of(index.file);
        index.tracked = git.tracked_files([](const std::string&) { return true; });
        if (const auto head = git.commit("HEAD")) index.head = head->id;
        return index;
    }

    /// What a submodule holds is in an index of its own. That speaks for it where the work tree has the commit that the
    /// index around it names: any folder that CI lays beside the sources may have been given the name of a submodule.
    bool is_in(const Index& index, const std::string& root, const std::string& path) {
        const TrackedFiles& tracked = index.tracked;
        if (!tracked.is_known || tracked.files.contains(path)) return true;
        for (size_t end = path.find('/'); end != std::string::npos; end = path.find('/', end + 1)) {
            const auto module = tracked.modules.find(path.substr(0, end));
            if (module == tracked.modules.end()) continue;
            const std::string inner = join_path(root, module->first);
            const Index& own = index_of(inner);
            return own.tracked.is_known && own.head == module->second && is_in(own, inner, path.substr(end + 1));
        }
        return false;
    }

    std::mutex mutex_;
    std::map<std::string, Index> known_;
};

}  // namespace

std::string untracked_reason(const std::string& root, const std::string& path) {
    static KnownIndexes indexes;
    if (language_of_path(path) != Language::Unknown || indexes.tracks(root, path)) return {};
    return untracked_text(path);
}

std::string untracked_text(const std::string& path) {
    return "is not tracked by git, and by its name no source, and so not read; if it is one: git add -f " +
           terminal_text(shell_word(path));
}

}  // namespace porttool
