// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/past.h"

#include <filesystem>

#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// What to say of a revision that names nothing.
std::string remedy_for(const Past& past) {
    if (past.git->is_shallow()) return "This is a shallow clone; fetch the history: git fetch --unshallow";
    const auto head = past.git->commit("HEAD");
    if (!head) return "There is no commit yet; commit once";
    const size_t count = past.git->first_parents(head->id).commits.size();
    if (count == 1) return "This history has a single commit; there is nothing before it to compare with";
    return "See what is there with: git log --oneline";
}

}  // namespace

Past open_past(const ProjectChoice& choice, Workplace& place) {
    Past past;
    Project project;
    find_map(project, choice, place.disk);
    past.root = project.root;
    past.map_is_given = !choice.config.empty();
    past.map_name = past.map_is_given ? choice.config : "portmap.toml";
    load_map(project, choice, place);
    past.has_map_today = project.has_map;
    past.map_today = std::move(project.map);
    past.git = std::make_unique<GitRepository>(past.root);
    if (!past.git->error().empty()) throw CannotDo(past.git->error());
    return past;
}

GitCommit find_commit(const Past& past, const std::string& option, const std::string& revision) {
    if (const auto commit = past.git->commit(revision)) return *commit;
    throw CannotDo(option + " " + terminal_text(revision) + ": no such revision here\n" + remedy_for(past));
}

std::string read_blob(const Past& past, const std::string& path, const std::string& blob) {
    if (auto text = past.git->find_blob(blob)) return std::move(*text);
    throw CannotDo(
        terminal_text(path) + ": git knows version " + blob +
        " of it, but its text is not here, as in a partial clone\nFetch it: git fetch --refetch --no-filter");
}

void require_sides(const MapFile& map, const std::string& where) {
    if (map.source.empty() || map.target.empty())
        throw CannotDo(terminal_text(where) + ": no sides named; put [sides] source and target into it");
    if (!map.target_root.empty())
        throw CannotDo(terminal_text(where) +
                       ": the target side lies in another checkout (target_root); this command reads the "
                       "history of one repository\nRun it where both sides lie in one");
}

}  // namespace porttool
