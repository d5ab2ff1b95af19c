// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/check_page.h"

#include <fmt/format.h>

#include <set>

#include "porttool/report/check_report.h"
#include "porttool/report/packed.h"
#include "porttool/report/page.h"
#include "porttool/text/sink/html.h"

namespace porttool {
namespace {

std::string place_row(const char* name, const std::optional<Place>& place) {
    if (!place) return "";
    return fmt::format("<p><span class=\"fine\">{}</span> {}:{}</p>\n", name, html_text(place->file), place->line);
}

/// A picture of the evidence, whose file may be a stranger's: nothing but a PNG beneath its folder is read.
std::string picture_html(const FindingEvidence& evidence, const std::string& picture, const Disk& disk) {
    constexpr uint64_t kLargestPicture = 32ull << 20;
    const std::string name = html_text(picture);
    const FileText file =
        disk.read(TreePath{evidence.folder.empty() ? "." : evidence.folder, picture}, kLargestPicture);
    if (!file.error.empty()) return fmt::format("<p class=\"fine\">{} {}</p>\n", name, html_text(file.error));
    if (!file.bytes.starts_with("\x89PNG\r\n\x1a\n")) return fmt::format("<p class=\"fine\">{} is no PNG</p>\n", name);
    return fmt::format("<p class=\"fine\">{0}</p>\n<img alt=\"{0}\" src=\"data:image/png;base64,{1}\">\n", name,
                       base64(file.bytes));
}

}  // namespace

std::string check_html(const Judgement& judgement, const Disk& disk) {
    const Summary& s = judgement.summary;
    std::string body = fmt::format(
        "<p class=\"fine\">{}: {} pairs, {} in step, {} drifted, {} to review, {} deferred, {} ignored; {}</p>\n",
        gate_result_name(judgement.result()), s.pairs, s.in_step, s.drifted, s.review, s.deferred, s.ignored,
        html_text(unwatched_text(s, judgement.reference) + verified_text(s)));
    std::set<std::string> shown;  // pictures, each once
    for (const Finding& f : judgement.findings) {
        if (f.level == Level::Off || f.verdict) continue;
        body += fmt::format("<section>\n<h2>{} {}</h2>\n<p><code>{}</code></p>\n", level_name(f.level),
                            rule_name(f.rule), html_text(f.message));
        body += place_row("source", f.source) + place_row("port", f.target);
        for (const std::string& detail : f.details) body += "<p><code>" + html_text(detail) + "</code></p>\n";
        body += "<p><span class=\"fine\">to settle it</span> " + html_text(f.remedy) + "</p>\n";
        if (f.evidence && f.evidence->kernel)
            for (const std::string& picture : f.evidence->kernel->pictures)
                if (shown.insert(picture_path(*f.evidence, picture)).second)
                    body += picture_html(*f.evidence, picture, disk);
        body += "</section>\n";
    }
    return filled_page("sections.html",
                       {{"@STYLE@", page_file("history.css")}, {"@TITLE@", "Findings"}, {"@BODY@", body}});
}

}  // namespace porttool
