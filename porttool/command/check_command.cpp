// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/check_command.h"

#include <chrono>
#include <cstdlib>
#include <ctime>

#include "porttool/command/base_lock.h"
#include "porttool/report/check_report.h"

namespace porttool {

std::string today() {
    std::time_t now = std::time(nullptr);
    if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH"))
        now = static_cast<std::time_t>(std::strtoll(epoch, nullptr, 10));
    std::tm date{};
    gmtime_r(&now, &date);
    std::array<char, 16> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d", &date);
    return text.data();
}

CheckedProject check_project(const Options& options, Workplace& place) {
    CheckedProject checked;
    checked.project = open_project(options, place, true);
    if (options.staged)
        read_staged_sides(checked.project, place);
    else
        read_sides(checked.project, place);
    checked.states = read_states(checked.project);
    std::map<std::string, std::string> texts;
    if (options.base.empty()) {
        checked.lock = load_lock(checked.project, place.disk);
    } else {
        const bool there = place.disk.exists(lock_path(checked.project));
        BaseLock base = base_lock(checked.project, options.base,
                                  there ? load_lock(checked.project, place.disk) : LockFile(), checked.states);
        checked.lock = std::move(base.lock);
        texts = std::move(base.texts);
    }
    const auto text_of = [&](const std::string& print) {
        if (options.base.empty()) return base_text(checked.project, place.disk, print);
        const auto found = texts.find(print);
        return found == texts.end() ? std::string() : found->second;
    };
    const Case facts{checked.project.map,
                     checked.lock,
                     checked.states.source,
                     checked.states.target,
                     checked.project.skipped,
                     text_of,
                     today()};
    checked.judgement = judge(facts);
    return checked;
}

Outcome check_command(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json"});
    const CheckedProject checked = check_project(options, place);
    const std::string verdict = checked.judgement.verdict();
    const bool fails = verdict == "drift" || (verdict == "review" && options.strict);
    const bool color = options.color == "always";
    return {options.format == "json" ? check_json(checked.judgement) : check_table(checked.judgement, color),
            fails ? 1 : 0};
}

}  // namespace porttool
