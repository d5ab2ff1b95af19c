// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/lsp/code_actions.h"

#include <fmt/format.h>

#include <algorithm>

#include "porttool/judge/settle.h"
#include "porttool/normal/diff.h"
#include "porttool/read/source_files.h"
#include "porttool/sync/apply.h"
#include "porttool/sync/unified_diff.h"

namespace porttool::lsp {
namespace {

/// True where a range touches a place: on the lines of its unit.
bool touches(const Range& range, const std::optional<Place>& place, const std::string& root, const std::string& path) {
    return place && place->line <= range.end.line + 1 && range.start.line < std::max(place->end_line, place->line) &&
           absolute_path(join_path(root, place->file)) == path;
}

/// What one request is answered with.
class ActionList {
public:
    ActionList(const CheckedProject& project, Proposals& proposals, const Documents& documents, const UriOf& uri_of,
               const ActionSupport& support)
        : project_(project), proposals_(proposals), documents_(documents), uri_of_(uri_of), support_(support) {}

    void add(const Finding& finding, const Json& diagnostic) {
        const auto pair = std::find_if(project_.judgement.pairs.begin(), project_.judgement.pairs.end(),
                                       [&](const JudgedPair& one) { return is_of(finding, one); });
        const bool is_pair = pair != project_.judgement.pairs.end();
        const bool both_there = is_pair && pair->unit.source != nullptr && pair->unit.target != nullptr;
        if (both_there && pair->changed && !pair->equivalent)
            add_port(static_cast<size_t>(pair - project_.judgement.pairs.begin()), diagnostic);
        if (both_there) add_accept(finding, pair->id.source + " = " + pair->id.target, diagnostic);
        if (!is_pair && finding.rule == Rule::Unpaired && finding.source && finding.target)
            add_accept(finding, finding.source->id + " = " + finding.target->id, diagnostic);
    }

    Json take() { return std::move(actions_); }

private:
    void add_port(size_t pair, const Json& diagnostic) {
        const SyncResult& result = proposals_.of(pair);
        const Proposal& proposal = result.proposals.front();
        if (proposal.state == ProposalState::Already) return;
        const bool whole = proposal.state == ProposalState::Proposed;
        const std::vector<WrittenFile> files =
            written_files(whole ? result.files : result.files_with_partial, project_.project);
        const std::string why = proposal.left.empty() ? "" : proposal.left.front().message;
        Json action = {{"title", "Port this edit"}, {"kind", "quickfix"}, {"diagnostics", {diagnostic}}};
        const bool creates = std::any_of(files.begin(), files.end(), [&](const WrittenFile& f) { return is_new(f); });
        if (files.empty() || proposal.state == ProposalState::Refused)
            action["disabled"] = {{"reason", why.empty() ? "nothing came of it" : why}};
        else if (creates && !(support_.creates_files && support_.document_changes))
            action["disabled"] = {{"reason", "the editor cannot create files; run: porttool sync --apply"}};
        else if (!std::all_of(files.begin(), files.end(), [&](const WrittenFile& f) { return is_known(f); }))
            action["disabled"] = {
                {"reason", "the editor has another text open than was judged; save it, and open it again"}};
        if (action.contains("disabled")) {
            if (support_.disabled) actions_.push_back(std::move(action));
            return;
        }
        action["title"] =
            whole ? fmt::format("Port this edit to {}", files_text(files))
                  : fmt::format("Port what is certain of this edit to {}; left for you: {}", files_text(files), why);
        action["isPreferred"] = whole;
        action["edit"] = workspace_edit(files);
        actions_.push_back(std::move(action));
    }

    void add_accept(const Finding& finding, const std::string& pair, const Json& diagnostic) {
        const std::string title = "Accept as in step: " + pair;
        actions_.push_back(
            {{"title", title},
             {"kind", "quickfix"},
             {"diagnostics", {diagnostic}},
             {"command",
              {{"title", title}, {"command", kAcceptCommand}, {"arguments", Json::array({finding.fingerprint})}}}});
    }

    static bool is_new(const WrittenFile& file) { return file.before.empty(); }

    static std::string files_text(const std::vector<WrittenFile>& files) {
        return files.front().place.path +
               (files.size() > 1 ? fmt::format(" and {} more", files.size() - 1) : std::string());
    }

    /// Whether an edit of the file fits what the editor shows: not where that is not known.
    bool is_known(const WrittenFile& file) const {
        const auto open = documents_.find(absolute_path(join_path(file.place.root, file.place.path)));
        return open == documents_.end() || open->second.is_followed;
    }

    Json workspace_edit(const std::vector<WrittenFile>& files) const {
        Json changes = Json::array(), by_uri = Json::object();
        for (const WrittenFile& file : files) {
            const std::string path = absolute_path(join_path(file.place.root, file.place.path));
            const std::string uri = uri_of_(path);
            const auto open = documents_.find(path);
            Json edits = text_edits(file.before, file.now);
            by_uri[uri] = edits;
            if (is_new(file) && open == documents_.end())
                changes.push_back({{"kind", "create"}, {"uri", uri}, {"options", {{"ignoreIfExists", true}}}});
            const Json version = open == documents_.end() ? Json(nullptr) : Json(open->second.version);
            changes.push_back({{"textDocument", {{"uri", uri}, {"version", version}}}, {"edits", std::move(edits)}});
        }
        if (support_.document_changes) return {{"documentChanges", std::move(changes)}};
        return {{"changes", std::move(by_uri)}};
    }

    const CheckedProject& project_;
    Proposals& proposals_;
    const Documents& documents_;
    const UriOf& uri_of_;
    const ActionSupport& support_;
    Json actions_ = Json::array();
};

}  // namespace

const SyncResult& Proposals::of(size_t pair) {
    const auto known = known_.find(pair);
    if (known != known_.end()) return known->second;
    return known_.emplace(pair, propose(project_, {pair}, WriteSide::Other, disk_)).first->second;
}

Json text_edits(const std::string& before, const std::string& now) {
    const Words old_lines = lines_with_ends(before), new_lines = lines_with_ends(now);
    const TextPlaces places(before);
    std::vector<size_t> starts = {0};
    for (const std::string_view line : old_lines) starts.push_back(starts.back() + line.size());
    const std::vector<DiffStep> steps = diff(old_lines, new_lines);
    Json out = Json::array();
    for (size_t i = 0; i < steps.size();) {
        if (steps[i].kind == DiffStep::Keep) {
            ++i;
            continue;
        }
        const size_t first = steps[i].before;
        size_t removed = 0;
        std::string text;
        for (; i < steps.size() && steps[i].kind != DiffStep::Keep; ++i) {
            if (steps[i].kind == DiffStep::Remove) ++removed;
            if (steps[i].kind == DiffStep::Add) text += new_lines[steps[i].now];
        }
        out.push_back(
            {{"range", range_json({places.position_of(starts[first]), places.position_of(starts[first + removed])})},
             {"newText", text}});
    }
    return out;
}

Json code_actions(const CheckedProject& project, const ProjectPlaces& places, Proposals& proposals,
                  const std::string& path, const Range& range, const Documents& documents, const UriOf& uri_of,
                  const ActionSupport& support) {
    ActionList actions(project, proposals, documents, uri_of, support);
    const std::map<std::string, Json> all = diagnostics_of(project, places, uri_of);
    const auto here = all.find(path);
    if (here == all.end()) return Json::array();
    for (const Json& diagnostic : here->second) {
        const std::string fingerprint = string_at(diagnostic, {"data", "fingerprint"});
        const auto finding = std::find_if(project.judgement.findings.begin(), project.judgement.findings.end(),
                                          [&](const Finding& one) { return one.fingerprint == fingerprint; });
        const std::string& root = project.project.root;
        if (touches(range, finding->source, root, path) || touches(range, finding->target, root, path))
            actions.add(*finding, diagnostic);
    }
    return actions.take();
}

}  // namespace porttool::lsp
