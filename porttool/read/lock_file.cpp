// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/lock_file.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

namespace porttool {
namespace {

constexpr const char* kHeader = "porttool-lock\t1";

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields;
    size_t first = 0;
    while (true) {
        const size_t tab = std::min(line.find('\t', first), line.size());
        fields.push_back(line.substr(first, tab - first));
        if (tab == line.size()) return fields;
        first = tab + 1;
    }
}

/// An id as one field: what would end the field or the line, and the sign of an escape itself, as percent codes.
constexpr std::array<std::pair<char, std::string_view>, 4> kCodes = {
    {{'%', "%25"}, {'\t', "%09"}, {'\n', "%0A"}, {'\r', "%0D"}}};

std::string encoded(const std::string& id) {
    std::string out;
    for (const char c : id) {
        const auto code =
            std::find_if(kCodes.begin(), kCodes.end(), [&](const auto& known) { return known.first == c; });
        out += code == kCodes.end() ? std::string(1, c) : std::string(code->second);
    }
    return out;
}

/// Undoes `encoded`. Any other percent sign stands for itself.
std::string decoded(const std::string& field) {
    std::string out;
    for (size_t i = 0; i < field.size(); ++i) {
        const auto code = std::find_if(kCodes.begin(), kCodes.end(),
                                       [&](const auto& known) { return field.compare(i, 3, known.second) == 0; });
        out += code == kCodes.end() ? field[i] : code->first;
        if (code != kCodes.end()) i += 2;
    }
    return out;
}

/// Reads one line; false if it has not the form of any.
bool read_line(LockFile& lock, const std::vector<std::string>& f) {
    if (f[0] == "pair" && f.size() == 9) {
        lock.pairs.push_back({decoded(f[1]), decoded(f[2]), {f[3], f[4], f[5]}, {f[6], f[7], f[8]}});
    } else if (f[0] == "baseline" && (f.size() == 3 || f.size() == 4)) {
        lock.baseline.push_back({decoded(f[1]), f[2], f.size() == 4 ? f[3] : std::string()});
    } else if ((f[0] == "accept" || f[0] == "defer" || f[0] == "ignore") && f.size() == 8) {
        lock.ledger.push_back({f[0], decoded(f[1]), decoded(f[2]), f[3], f[4], f[5], f[6], f[7]});
    } else {
        return false;
    }
    return true;
}

struct SeenLine {
    std::string text;
    int number = 0;
};

/// What is wrong if an earlier line says something else of the same pair: a merge kept both.
std::string stands_twice(const std::string& line, std::map<std::string, SeenLine>& seen, int number) {
    const std::vector<std::string> fields = split(line);
    if (fields[0] != "pair" || fields.size() < 3) return {};
    const auto [first, fresh] = seen.try_emplace(fields[1] + "\t" + fields[2], SeenLine{line, number});
    if (fresh || first->second.text == line) return {};
    return "a second line for '" + fields[1] + "=" + fields[2] + "'; line " + std::to_string(first->second.number) +
           " says something else, as after a merge\nRemove one of the two, then run: porttool check";
}

std::string plain(std::string text) {
    for (char& c : text)
        if (c == '\t' || c == '\n' || c == '\r') c = ' ';
    return text;
}

}  // namespace

ReadLock read_lock(const std::string& text) {
    ReadLock out;
    std::map<std::string, SeenLine> seen;
    size_t first = 0;
    for (int number = 1; first < text.size(); ++number) {
        const size_t end = std::min(text.find('\n', first), text.size());
        std::string line = text.substr(first, end - first);
        first = end + 1;
        if (!line.empty() && line.back() == '\r') line.pop_back();
        const std::string where = "portmap.lock:" + std::to_string(number) + ": ";
        if (line.starts_with("<<<<<<<") || line.starts_with("=======") || line.starts_with(">>>>>>>"))
            return {{},
                    where +
                        "a merge conflict is not resolved\nKeep one line for each pair, or take one side whole and "
                        "run: porttool accept --all"};
        if (number == 1) {
            if (line == kHeader) continue;
            if (line.starts_with("porttool-lock"))
                return {{},
                        where + "'" + line +
                            "' is of another version; this porttool reads version 1\nUse the porttool that wrote it, "
                            "or renew it with: porttool init --force"};
            return {
                {},
                where + "this is no lock of porttool\nRestore it from git, or renew it with: porttool init --force"};
        }
        if (line.empty() || line[0] == '#') continue;
        if (const std::string twice = stands_twice(line, seen, number); !twice.empty()) return {{}, where + twice};
        if (!read_line(out.lock, split(line)))
            return {{},
                    where + "cannot be read: '" + line.substr(0, 60) +
                        "'\nRestore the line from git, or renew the lock with: porttool init --force"};
    }
    if (text.empty())
        return {{}, "portmap.lock is empty\nRestore it from git, or renew it with: porttool init --force"};
    return out;
}

std::string lock_text(const LockFile& lock) {
    std::vector<std::string> lines;
    for (const LockedPair& pair : lock.pairs) {
        const Fingerprints &s = pair.source_prints, &t = pair.target_prints;
        lines.push_back("pair\t" + encoded(pair.source) + "\t" + encoded(pair.target) + "\t" + s.written + "\t" +
                        s.renamed + "\t" + s.blanked + "\t" + t.written + "\t" + t.renamed + "\t" + t.blanked);
    }
    for (const LockedUnit& unit : lock.baseline)
        lines.push_back("baseline\t" + encoded(unit.id) + "\t" + unit.print +
                        (unit.reason.empty() ? std::string() : "\t" + plain(unit.reason)));
    for (const LedgerEntry& entry : lock.ledger)
        lines.push_back(entry.verdict + "\t" + encoded(entry.source) + "\t" + encoded(entry.target) + "\t" +
                        entry.source_print + "\t" + entry.target_print + "\t" + plain(entry.owner) + "\t" +
                        plain(entry.until) + "\t" + plain(entry.reason));
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    std::string out =
        std::string(kHeader) +
        "\n# Written by porttool: what was in step, and what had no port. Edit with porttool accept, defer, ignore.\n";
    for (const std::string& line : lines) out += line + "\n";
    return out;
}

}  // namespace porttool
