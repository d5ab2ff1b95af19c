// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/audit_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "porttool/text/date.h"
#include "porttool/text/sink/json.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

using nlohmann::ordered_json;

ordered_json patch_or_none(const std::string& text) {
    return text.empty() ? ordered_json(nullptr) : ordered_json(text);
}

std::string file_and_line(const AuditItem& item, Side side) {
    const std::string& id = item.id[side];
    return fmt::format("{}:{} {}", terminal_text(id.substr(0, id.find(':'))), item.line[side],
                       terminal_text(id.substr(id.find(':') + 1)));
}

}  // namespace

std::string audit_json(const Audit& audit) {
    ordered_json items = ordered_json::array();
    for (const AuditItem& item : audit.items) {
        ordered_json same = ordered_json::array();
        for (const auto& [source, target] : item.same) same.push_back({{"source", source}, {"target", target}});
        items.push_back({{"source", item.id.source},
                         {"target", item.id.target},
                         {"commit", item.commit ? ordered_json(item.commit->id) : ordered_json(nullptr)},
                         {"date", item.commit ? ordered_json(day_of(item.commit->time)) : ordered_json(nullptr)},
                         {"summary", item.summary},
                         {"certainty", std::round(item.certainty * 1000) / 1000},
                         {"patch", patch_or_none(item.patch)},
                         {"witness", nullptr},
                         {"remedy", item.remedy},
                         {"subject", item.commit ? ordered_json(item.commit->subject) : ordered_json(nullptr)},
                         {"edited", item.edited == Side::Source ? "source" : "target"},
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
        out += fmt::format("{}. {:.0f} %  {}\n", i + 1, 100 * item.certainty, terminal_text(item.summary));
        if (item.commit)
            out += fmt::format("    {} {} {}\n", item.commit->id.substr(0, 10), day_of(item.commit->time),
                               terminal_text(item.commit->subject));
        const Side edited = item.edited;
        out += fmt::format("    edited {}\n    other  {}\n", file_and_line(item, edited),
                           file_and_line(item, other(edited)));
        if (!item.same.empty()) out += fmt::format("    and {} more pairs alike\n", item.same.size());
        for (const std::string& why : item.why) out += "    " + terminal_text(why) + "\n";
        out += "    settle: " + terminal_text(item.remedy) + "\n";
    }
    return out + fmt::format("{} of {} findings; {} pairs, {} commits read\n", audit.items.size(), audit.found,
                             audit.pairs, audit.commits);
}

}  // namespace porttool
