// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/finding_ages.h"

#include <algorithm>
#include <vector>

#include "porttool/compare/edits.h"
#include "porttool/judge/settle.h"
#include "porttool/read/git_repository.h"
#include "porttool/read/lock_lines.h"
#include "porttool/scan/scan.h"
#include "porttool/text/date.h"

namespace porttool {
namespace {

/// A finding whose beginning is looked for: does it hold in a version of its file?
struct Question {
    std::string fingerprint, file, name;
    Fingerprints recorded;  ///< empty: it holds wherever the unit is there
    int64_t since = 0;      ///< 0: not committed yet
    bool answered = false;
};

bool holds(const Question& question, const ScannedFile& file) {
    for (const Unit& unit : file.units)
        if (unit.name == question.name)
            return !question.recorded.written.is_known() ||
                   classify(question.recorded, unit_state(file, unit).prints) > Change::Cosmetic;
    return false;
}

std::vector<Question> questions(const CheckedProject& checked) {
    std::vector<Question> out;
    const LinesByPair lines(checked.lock);
    for (const Finding& finding : checked.judgement.findings) {
        const bool unported = is_of_new_unit(finding);
        const LockedPair* pair = lines.find(finding.map_source, finding.map_target);
        if (!unported &&
            (pair == nullptr || finding.change == ChangeKind::Rename || finding.change == ChangeKind::Moved))
            continue;
        const bool of_target = unported ? finding.side == Side::Target : finding.rule == Rule::TargetChanged;
        const auto& place = of_target ? finding.target : finding.source;
        if (!place || place->id.size() <= place->file.size() || (of_target && !unported && !finding.source)) continue;
        Question question{finding.fingerprint, place->file, place->id.substr(place->file.size() + 1), {}};
        if (!unported) question.recorded = of_target ? pair->target_prints : pair->source_prints;
        out.push_back(std::move(question));
    }
    return out;
}

/// Takes one version of a file into account, going back in time; a question is answered where its finding does not
/// hold.
void look_at(std::vector<Question>& open, const GitChange& version, int64_t time, const GitRepository& repository) {
    std::optional<ScannedFile> scanned;
    for (Question& question : open) {
        if (question.answered || question.file != version.path) continue;
        if (!scanned) scanned = scan_text(version.path, version.blob.empty() ? "" : repository.blob(version.blob));
        if (holds(question, *scanned))
            question.since = time;
        else
            question.answered = true;
    }
}

}  // namespace

std::map<std::string, Age> finding_ages(const CheckedProject& checked, const std::string& today) {
    constexpr size_t kMostCommits = 5'000;
    std::vector<Question> open = questions(checked);
    std::map<std::string, Age> ages;
    if (open.empty() || !checked.project.map.target_root.empty()) return ages;
    const GitRepository repository(checked.project.root);
    if (!repository.error().empty()) return ages;
    const std::optional<GitCommit> head = repository.commit("HEAD");
    if (!head) return ages;
    const GitChain chain = repository.first_parents(head->id);
    const auto wants = [&](const std::string& path) {
        return std::any_of(open.begin(), open.end(),
                           [&](const Question& one) { return !one.answered && one.file == path; });
    };
    const size_t begin = chain.commits.size() > kMostCommits ? chain.commits.size() - kMostCommits : 0;
    for (size_t i = chain.commits.size(); i-- > begin;) {
        const std::string older = i > 0 ? chain.commits[i - 1].id : std::string();
        for (const GitChange& change : repository.changes(older, chain.commits[i].id, wants))
            look_at(open, change, chain.commits[i].time, repository);
    }
    for (const Question& question : open) {
        Age age{0, !question.answered && (begin > 0 || chain.cut)};
        if (question.since != 0) age.days = std::max(0, days_between(day_of(question.since), today).value_or(0));
        ages.emplace(question.fingerprint, age);
    }
    return ages;
}

}  // namespace porttool
