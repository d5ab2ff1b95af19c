// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/audit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "porttool/report/difftest_report.h"
#include "porttool/report/page.h"
#include "porttool/scan/scan.h"
#include "porttool/text/date.h"
#include "porttool/text/sink/html.h"
#include "porttool/text/sink/json.h"
#include "porttool/text/sink/markdown.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/utf8.h"

namespace porttool {
namespace {

using nlohmann::ordered_json;
using Sink = std::string (*)(std::string_view);

constexpr size_t kShortId = 10;  // of a commit, for people

ordered_json patch_or_none(const std::string& patch) {
    return patch.empty() || !is_utf8(patch) ? ordered_json(nullptr) : ordered_json(patch);
}

double shown_certainty(const AuditItem& item) {
    constexpr double kThousand = 1000;
    return std::round(item.certainty * kThousand) / kThousand;
}

/// Which of the two places has the edit.
std::string place_of_unit(const AuditItem& item, Side side) {
    if (item.id[side].empty()) return "no counterpart is known";
    const auto [file, name] = split_id(item.id[side]);
    return fmt::format("{}:{}, {}", file, item.line[side], name);
}

std::string commit_of(const AuditItem& item) {
    if (!item.commit) return "no commit of the past tells of it; the two sides differ today";
    return fmt::format("{} of {}: {}", item.commit->id.substr(0, kShortId), day_of(item.commit->time),
                       item.commit->subject);
}

std::string witness_of(const AuditItem& item) {
    return item.witness ? "the two sides differ" + counterexample_text(*item.witness) : "";
}

std::string more_pairs(const AuditItem& item) {
    return item.same.empty() ? "" : fmt::format("the same in {} more pairs", item.same.size());
}

/// True where the items begin of which fewer than half were real where that was counted.
bool begins_doubt(const Audit& audit, size_t i) {
    return audit.items[i].certainty < kLikelyItem && (i == 0 || audit.items[i - 1].certainty >= kLikelyItem);
}

constexpr const char* kDoubt = "below 45 %: of such items fewer than half were real where that was counted";

std::string tail(const Audit& audit) {
    return fmt::format("{} of {} items; {} pairs, {} commits read{}", audit.items.size(), audit.found, audit.pairs,
                       audit.commits,
                       audit.shallow ? "; a shallow clone: what its oldest commits did is not known" : "") +
           (audit.items.size() == audit.found ? ""
            : audit.items.empty()             ? "; all are doubtful: --limit 1000 lists them"
                                              : "; the rest is less certain: --limit 1000 lists it");
}

/// The lines of a patch, each through a sink.
std::string patch_lines(std::string_view patch, std::string_view indent, Sink sink) {
    std::string out;
    for (size_t first = 0; first < patch.size();) {
        const size_t next = std::min(patch.find('\n', first), patch.size());
        std::string_view line = patch.substr(first, next - first);
        if (line.ends_with('\r')) line.remove_suffix(1);
        out += sink != nullptr ? std::string(indent) + sink(line) : terminal_code_line(indent, line);
        out += '\n';
        first = next + 1;
    }
    return out;
}

/// Hands each thing that is told of an item to `line`, with its name.
template <class Line>
void tell(const AuditItem& item, const char* other_side, const Line& line) {
    line("commit", commit_of(item));
    const char* const own = item.edited == Side::Source ? "source" : "target";
    const char* const across = item.edited == Side::Source ? "target" : "source";
    line(item.commit ? "edited" : own, place_of_unit(item, item.edited));
    line(item.commit ? other_side : across, place_of_unit(item, other(item.edited)));
    line("witness", witness_of(item));
    line("also", more_pairs(item));
    for (const std::string& why : item.why) line("why", why);
}

}  // namespace

std::string audit_json(const Audit& audit) {
    ordered_json items = ordered_json::array();
    for (const AuditItem& item : audit.items) {
        ordered_json same = ordered_json::array();
        for (const auto& [source, target] : item.same) same.push_back({{"source", source}, {"target", target}});
        const auto of_commit = [&](auto value) { return item.commit ? ordered_json(value()) : ordered_json(nullptr); };
        const auto id = [&](Side side) {
            return item.id[side].empty() ? ordered_json(nullptr) : ordered_json(item.id[side]);
        };
        items.push_back({{"source", id(Side::Source)},
                         {"target", id(Side::Target)},
                         {"commit", of_commit([&] { return item.commit->id; })},
                         {"date", of_commit([&] { return day_of(item.commit->time); })},
                         {"summary", item.summary},
                         {"certainty", shown_certainty(item)},
                         {"patch", patch_or_none(item.patch)},
                         {"witness", item.witness ? counterexample_json(*item.witness) : ordered_json(nullptr)},
                         {"remedy", item.remedy},
                         {"edited", item.edited == Side::Source ? "source" : "target"},
                         {"subject", of_commit([&] { return item.commit->subject; })},
                         {"why", item.why},
                         {"same", std::move(same)}});
    }
    return json_text({{"items", std::move(items)}, {"commits_read", audit.commits}, {"shallow", audit.shallow}}, 1) +
           "\n";
}

std::string audit_text(const Audit& audit) {
    std::string out;
    for (size_t i = 0; i < audit.items.size(); ++i) {
        const AuditItem& item = audit.items[i];
        if (begins_doubt(audit, i)) out += fmt::format("-- {} --\n", kDoubt);
        out += fmt::format("{}. {:.0f} %  {}\n", i + 1, 100 * item.certainty, terminal_text(item.summary));
        const auto line = [&](const char* name, const std::string& text) {
            if (!text.empty()) out += fmt::format("    {:<8}{}\n", name, terminal_text(text));
        };
        tell(item, "other", line);
        line("settle", item.remedy);
        out += patch_lines(item.patch, "      ", nullptr);
    }
    return out + tail(audit) + "\n";
}

std::string audit_markdown(const Audit& audit) {
    std::string out = "# Audit of a port\n";
    for (size_t i = 0; i < audit.items.size(); ++i) {
        const AuditItem& item = audit.items[i];
        if (begins_doubt(audit, i)) out += fmt::format("\n*{}*\n", kDoubt);
        out += fmt::format("\n{}. **{:.0f} %** {}\n", i + 1, 100 * item.certainty, markdown_cell(item.summary));
        const auto line = [&](const char* name, const std::string& text) {
            if (!text.empty()) out += fmt::format("   - {}: {}\n", name, markdown_text(text));
        };
        tell(item, "other side", line);
        out += "   - to settle it: " + markdown_code(item.remedy) + "\n";
        if (item.patch.empty()) continue;
        const std::string fence = markdown_fence(item.patch);
        out += "\n   " + fence + "diff\n" + patch_lines(item.patch, "   ", nullptr) + "   " + fence + "\n";
    }
    return out + "\n" + markdown_text(tail(audit)) + "\n";
}

std::string audit_html(const Audit& audit) {
    std::string body = "<p class=\"fine\">" + html_text(tail(audit)) + "</p>\n";
    for (size_t i = 0; i < audit.items.size(); ++i) {
        const AuditItem& item = audit.items[i];
        if (begins_doubt(audit, i)) body += fmt::format("<p class=\"fine\">{}</p>\n", kDoubt);
        body += fmt::format("<section>\n<h2>{}. {:.0f}&nbsp;%</h2>\n<p><code>{}</code></p>\n", i + 1,
                            100 * item.certainty, html_text(item.summary));
        const auto line = [&](const char* name, const std::string& text) {
            if (!text.empty()) body += fmt::format("<p><span class=\"fine\">{}</span> {}</p>\n", name, html_text(text));
        };
        tell(item, "other side", line);
        line("to settle it", item.remedy);
        if (!item.patch.empty()) body += "<pre>" + patch_lines(item.patch, "", html_text) + "</pre>\n";
        body += "</section>\n";
    }
    return filled_page("sections.html",
                       {{"@STYLE@", page_file("history.css")}, {"@TITLE@", "Audit of a port"}, {"@BODY@", body}});
}

}  // namespace porttool
