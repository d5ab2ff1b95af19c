// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "porttool/report/figures.h"
#include "porttool/text/row_room.h"
#include "porttool/text/shortened.h"
#include "porttool/text/sink/json_rows.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

using nlohmann::ordered_json;

const char* color_of(Level level) {
    return level == Level::Error ? "\x1b[31m" : level == Level::Warning ? "\x1b[33m" : "\x1b[36m";
}

/// For a reviewer: what settles findings and came with the change itself.
std::string brought_in_table(const std::vector<BroughtIn>& brought_in) {
    constexpr size_t kShown = 20;
    std::string out = "What this change does to the gate itself:\n";
    for (size_t i = 0; i < std::min(brought_in.size(), kShown); ++i) {
        const BroughtIn& one = brought_in[i];
        out += fmt::format("    {}:{}: {}: {}\n", terminal_line(one.file), one.line, gate_part_name(one.kind),
                           terminal_text(shortened(one.text, kLongestBroughtIn)));
    }
    const std::string more = more_brought_in(brought_in, kShown);
    return more.empty() ? out : out + "    " + more + "\n";
}

}  // namespace

std::string more_brought_in(const std::vector<BroughtIn>& brought_in, size_t shown) {
    if (brought_in.size() <= shown) return {};
    std::map<std::string_view, size_t> kinds;  // so that many rows of one kind hide none of another
    for (size_t i = shown; i < brought_in.size(); ++i) ++kinds[gate_part_name(brought_in[i].kind)];
    std::string counts;
    for (const auto& [kind, count] : kinds) counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, kind);
    return fmt::format("and {} more ({}); --format json lists all", brought_in.size() - shown, counts);
}

std::string unwatched_text(const Summary& summary, Reference reference) {
    const std::string side = reference == Reference::Both ? "" : std::string(reference_name(reference)) + " ";
    const std::string changed = fmt::format(", {} of them changed here", summary.unpaired_changed);
    return fmt::format("{} of {} {}units are not watched", summary.unpaired, summary.units, side) +
           (summary.unpaired_changed > 0 ? changed : "");
}

std::string verified_text(const Summary& summary) {
    return summary.recorded > 0 && summary.verified == 0 ? "; recorded, not verified" : "";
}

/// True for a path that stays in the folder that it starts in, wherever it is read.
bool is_beneath(const std::string& path) {
    if (path.empty() || path[0] == '/' || path.find('\\') != std::string::npos || path.find(':') != std::string::npos)
        return false;
    for (size_t at = 0; at <= path.size();) {
        const size_t end = std::min(path.find('/', at), path.size());
        if (path.compare(at, end - at, "..") == 0) return false;
        at = end + 1;
    }
    return true;
}

ordered_json evidence_json(const Finding& finding) {
    if (!finding.evidence) return nullptr;
    const FindingEvidence& seen = *finding.evidence;
    ordered_json out;
    for (const char* name : {"kernel", "field", "segment", "paths", "share", "materials", "pixel", "ssim"})
        out[name] = nullptr;
    out["counterexample"] = seen.example_json.empty() ? ordered_json() : ordered_json::parse(seen.example_json);
    out["pictures"] = ordered_json::array();
    if (!seen.kernel) return out;
    out["kernel"] = seen.kernel->name;
    if (!seen.kernel->field.empty()) out["field"] = seen.kernel->field;
    if (seen.kernel->segment > 0) out["segment"] = seen.kernel->segment;
    out["paths"] = seen.kernel->paths;
    out["share"] = seen.kernel->share;
    out["materials"] = seen.kernel->materials;
    if (seen.kernel->pixel) out["pixel"] = *seen.kernel->pixel;
    if (seen.kernel->ssim) out["ssim"] = *seen.kernel->ssim;
    for (const std::string& picture : seen.kernel->pictures)
        if (is_beneath(picture)) out["pictures"].push_back(picture_path(seen, picture));
    return out;
}

std::string picture_path(const FindingEvidence& evidence, const std::string& picture) {
    return evidence.folder.empty() ? picture : evidence.folder + "/" + picture;
}

ordered_json finding_json(const Finding& f) {
    ordered_json out = {{"rule", rule_name(f.rule)},
                        {"level", level_name(f.level)},
                        {"change", f.change ? ordered_json(change_name(*f.change)) : ordered_json(nullptr)},
                        {"source", place_json(f.source)},
                        {"target", place_json(f.target)},
                        {"message", f.message},
                        {"remedy", f.remedy},
                        {"fingerprint", f.fingerprint},
                        {"target_set", f.target_set.empty() ? ordered_json(nullptr) : ordered_json(f.target_set)},
                        {"evidence", evidence_json(f)}};
    if (!f.source && !f.target) out["map_line"] = f.map_line;  // in portmap.toml
    if (!f.details.empty()) out["details"] = f.details;
    return out;
}

std::string check_json(const Judgement& judgement) {
    ordered_json brought_in = ordered_json::array();
    for (const BroughtIn& one : judgement.brought_in)
        brought_in.push_back(
            {{"kind", gate_part_name(one.kind)}, {"file", one.file}, {"line", one.line}, {"text", one.text}});
    const ordered_json out = {{"verdict", gate_result_name(judgement.result())},
                              {"summary", summary_json(judgement.summary)},
                              {"brought_in", std::move(brought_in)},
                              {"findings", ordered_json::array()}};
    return json_with_rows(out, judgement.findings.size(),
                          [&](size_t i) {
                              const Finding& f = judgement.findings[i];
                              return is_open(f) ? finding_json(f) : ordered_json(nullptr);
                          }) +
           "\n";
}

std::string finding_text(const Finding& f, bool color) {
    const Place place = f.source ? *f.source : f.target.value_or(Place{"", "portmap.toml", f.map_line, f.map_line});
    const std::string level =
        color ? fmt::format("{}{}\x1b[0m", color_of(f.level), level_name(f.level)) : std::string(level_name(f.level));
    std::string out = fmt::format("{}:{}: {}: {} [{}]\n", terminal_line(place.file), place.line, level,
                                  terminal_text(f.message), rule_name(f.rule));
    if (f.source && f.target) out += fmt::format("    port: {}:{}\n", terminal_text(f.target->file), f.target->line);
    if (f.details.size() > 1)
        for (const std::string& detail : f.details)
            out += "    " + terminal_line(shortened(detail, kLongestStatement)) + "\n";
    return out + "    " + terminal_line(f.remedy) + "\n";
}

std::string summary_text(const Judgement& judgement) {
    const Summary& s = judgement.summary;
    return fmt::format("{}: {} pairs, {} in step, {} drifted, {} to review, {} deferred, {} ignored; {}\n",
                       gate_result_name(judgement.result()), s.pairs, s.in_step, s.drifted, s.review, s.deferred,
                       s.ignored, unwatched_text(s, judgement.reference) + verified_text(s));
}

std::string check_table(const Judgement& judgement, bool color) {
    std::string out;
    size_t added = 0;
    for (const Finding& f : judgement.findings) {
        if (!is_open(f)) continue;
        out += finding_text(f, color);
        make_room_for_rows(out, ++added, judgement.findings.size());
    }
    if (!judgement.brought_in.empty()) out += brought_in_table(judgement.brought_in);
    out += summary_text(judgement);
    return out;
}

}  // namespace porttool
