// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
//   porttool-lock	2
//   normal-form	2
//   # Written by porttool: ...
//   000                                                       a mark
//   ...
//   7f3
//   7f3a90c1                                                  the key of the facts below
//   7f3a90c1	pair	gpu/a.cl:f	cpu/a.cpp:f	(six prints)	state=recorded
//   7f4
//   ...
#include "porttool/read/lock_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "porttool/text/date.h"

namespace porttool {
namespace {

constexpr std::string_view kLockHeader = "porttool-lock\t", kNormalFormLine = "normal-form\t";
constexpr size_t kMarkDigits = 3, kLineKeyDigits = 8, kMarks = 4096;
constexpr const char* kRestore = "\nRestore it from git, or renew it with: porttool init --force";

/// Views of one line.
using Fields = std::vector<std::string_view>;

Fields split(std::string_view line) {
    Fields fields;
    fields.reserve(14);
    size_t first = 0;
    while (true) {
        const size_t tab = std::min(line.find('\t', first), line.size());
        fields.push_back(line.substr(first, tab - first));
        if (tab == line.size()) return fields;
        first = tab + 1;
    }
}

/// The begin of what a message quotes.
std::string beginning(std::string_view text) {
    constexpr size_t kMost = 60;
    return std::string(text.substr(0, kMost));
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

/// The number of a mark, and the mark of a number.
size_t mark_of(std::string_view digits) {
    size_t mark = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), mark, 16);
    return mark;
}

std::array<char, kMarkDigits> digits_of(size_t mark) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    return {kDigits[mark / 256], kDigits[mark / 16 % 16], kDigits[mark % 16]};
}

/// Undoes `encoded`. Any other percent sign stands for itself.
std::string decoded(std::string_view field) {
    if (field.find('%') == std::string_view::npos) return std::string(field);
    std::string out;
    for (size_t i = 0; i < field.size(); ++i) {
        const auto code = std::find_if(kCodes.begin(), kCodes.end(),
                                       [&](const auto& known) { return field.compare(i, 3, known.second) == 0; });
        out += code == kCodes.end() ? field[i] : code->first;
        if (code != kCodes.end()) i += 2;
    }
    return out;
}

/// What is wrong with one line's fields, thrown while they are read.
struct MisreadField {
    std::string what;
};

Print print_of(std::string_view field, bool may_be_unknown) {
    const Print print = Print::read(field);
    if (print.is_known() || (may_be_unknown && field == "-")) return print;
    throw MisreadField{"'" + beginning(field) +
                       "' is no fingerprint, which has 16 hexadecimal digits, not all of them 0"};
}

Fingerprints prints_of(const Fields& f, size_t at, bool may_be_unknown = false) {
    return {print_of(f[at], may_be_unknown), print_of(f[at + 1], may_be_unknown), print_of(f[at + 2], may_be_unknown)};
}

/// The fields `name=value` from a place on.
MoreFields more_of(const Fields& f, size_t at) {
    MoreFields out;
    for (size_t i = at; i < f.size(); ++i) {
        const size_t equal = f[i].find('=');
        if (equal == std::string::npos || equal == 0) throw MisreadField{"'" + beginning(f[i]) + "' is no name=value"};
        out[std::string(f[i].substr(0, equal))] = decoded(f[i].substr(equal + 1));
    }
    return out;
}

std::string taken(MoreFields& more, const std::string& name, const std::string& otherwise = {}) {
    std::string value = more.take(name);
    return value.empty() ? otherwise : value;
}

LedgerEntry ledger_entry(Verdict verdict, const Fields& f) {
    LedgerEntry entry{verdict,
                      decoded(f[1]),
                      decoded(f[2]),
                      print_of(f[3], true),
                      print_of(f[4], true),
                      std::string(f[5]),
                      std::string(f[6]),
                      std::string(f[7]),
                      {}};
    if (!(has_form_of_date(entry.until) || (entry.until.empty() && entry.verdict != Verdict::Defer)))
        throw MisreadField{"'" + entry.until.substr(0, 60) + "' is no date as YYYY-MM-DD"};
    return entry;
}

/// Reads a line of version 1; false if it has not the form of any.
bool read_line_1(LockFile& lock, const Fields& f) {
    if (f[0] == "pair" && f.size() == 9) {
        lock.pairs.push_back({decoded(f[1]), decoded(f[2]), prints_of(f, 3), prints_of(f, 6)});
    } else if (f[0] == "baseline" && (f.size() == 3 || f.size() == 4)) {
        lock.baseline.push_back(
            {decoded(f[1]), {print_of(f[2], false), {}, {}}, std::string(f.size() == 4 ? f[3] : "")});
    } else if (const auto verdict = verdict_named(f[0]); verdict && f.size() == 8) {
        lock.ledger.push_back(ledger_entry(*verdict, f));
    } else {
        return false;
    }
    return true;
}

/// Reads a line of version 2 without its key; false if it has not the form of any.
bool read_line_2(LockFile& lock, const Fields& f) {
    if (f[0] == "pair" && f.size() >= 9) {
        LockedPair pair{decoded(f[1]), decoded(f[2]), prints_of(f, 3), prints_of(f, 6)};
        pair.more = more_of(f, 9);
        pair.state = taken(pair.more, "state", pair.state);
        pair.by = taken(pair.more, "by");
        pair.macros = {taken(pair.more, "source-macros"), taken(pair.more, "target-macros")};
        lock.pairs.push_back(std::move(pair));
    } else if (f[0] == "unit" && f.size() >= 7) {
        lock.baseline.push_back(
            {decoded(f[2]), prints_of(f, 3, true), std::string(f[6]), std::string(f[1]), more_of(f, 7)});
    } else if (const auto verdict = verdict_named(f[0]); verdict && f.size() >= 8) {
        lock.ledger.push_back(ledger_entry(*verdict, f));
        lock.ledger.back().more = more_of(f, 8);
    } else {
        return false;
    }
    return true;
}

class LockReader {
public:
    explicit LockReader(const std::string& text) : text_(text) {}

    ReadLock read() {
        if (text_.empty()) return {{}, std::string("portmap.lock is empty") + kRestore};
        make_room();
        size_t first = 0;
        while (first < text_.size()) {
            const size_t end = std::min(text_.find('\n', first), text_.size());
            std::string_view line = text_.substr(first, end - first);
            first = end + 1;
            ++number_;
            if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
            if (const std::string wrong = take(line); !wrong.empty())
                return {{}, "portmap.lock:" + std::to_string(number_) + ": " + wrong};
        }
        if (lock_.version > 1 && std::count(marks_.begin(), marks_.end(), true) != static_cast<long>(kMarks))
            return {{},
                    "portmap.lock has lost lines: its marks 000 to fff are not all there, as after a copy that was cut "
                    "short" +
                        std::string(kRestore)};
        return {std::move(lock_), ""};
    }

private:
    struct Seen {
        std::string_view fact;  ///< the line without its key
        int number = 0;
    };

    /// Of half a million lines a table that doubles its room has three times their size on the way.
    void make_room() {
        lock_.pairs.reserve(lines_of("\tpair\t"));
        lock_.baseline.reserve(lines_of("\tunit\t"));
    }

    /// How many lines have that word behind their key.
    size_t lines_of(std::string_view word) const {
        size_t count = 0;
        for (size_t at = text_.find(word); at != std::string_view::npos; at = text_.find(word, at + word.size()))
            if (at > kLineKeyDigits && text_[at - kLineKeyDigits - 1] == '\n') ++count;
        return count;
    }

    /// Takes in a line; what is wrong with it, or "".
    std::string take(std::string_view line) {
        // Most lines of most locks, so before all else and without a word of memory.
        if (lock_.version > 1 && number_ > 1 && is_hexadecimal(line, kMarkDigits)) {
            marks_[mark_of(line)] = true;
            return {};
        }
        if (line.starts_with("<<<<<<<") || line.starts_with("=======") || line.starts_with(">>>>>>>"))
            return "a merge conflict is not resolved\nKeep one line for each pair, or take one side whole and run: "
                   "porttool accept --all";
        if (number_ == 1) return take_header(line);
        if (line.empty() || line[0] == '#') return {};
        if (line.starts_with(kNormalFormLine)) return take_normal_form(line);
        Fields fields = split(line);
        if (lock_.version > 1) {
            if (is_hexadecimal(line, kLineKeyDigits)) return {};
            if (is_hexadecimal(fields[0], kLineKeyDigits)) fields.erase(fields.begin());  // one by hand may lack it
            if (fields.empty()) return unreadable(line);
        }
        const std::string_view fact = line.substr(static_cast<size_t>(fields[0].data() - line.data()));
        if (const std::string twice = stands_twice(fields, fact); !twice.empty()) return twice;
        try {
            const bool known = lock_.version == 1 ? read_line_1(lock_, fields) : read_line_2(lock_, fields);
            if (!known) return unreadable(line);
            (fields[0] == "pair"        ? lock_.pairs.back().line
             : verdict_named(fields[0]) ? lock_.ledger.back().line
                                        : lock_.baseline.back().line) = number_;
            return {};
        } catch (const MisreadField& wrong) {
            return wrong.what + "\nRestore the line from git, or renew the lock with: porttool init --force";
        }
    }

    std::string take_header(std::string_view line) {
        if (!line.starts_with(kLockHeader)) return std::string("this is no lock of porttool") + kRestore;
        const std::string_view version = line.substr(kLockHeader.size());
        if (version != "1" && version != "2")
            return "'" + beginning(line) +
                   "' is of another version; this porttool reads versions 1 and 2\nUse the porttool that wrote it, or "
                   "renew it with: porttool init --force";
        lock_.version = version == "1" ? 1 : 2;
        lock_.normal_form = 1;  // unless it says otherwise
        return {};
    }

    std::string take_normal_form(std::string_view line) {
        int form = 0;
        const char* end = line.data() + line.size();
        const auto read = std::from_chars(line.data() + kNormalFormLine.size(), end, form);
        if (read.ec != std::errc() || read.ptr != end || form < 1) return unreadable(line);
        if (form > kNormalForm)
            return "its fingerprints are of normal form " + std::to_string(form) + "; this porttool knows " +
                   std::to_string(kNormalForm) + "\nUse the porttool that wrote it, or a newer one";
        lock_.normal_form = form;
        return {};
    }

    /// What is wrong if an earlier line says something else of the same pair: a merge kept both.
    std::string stands_twice(const Fields& fields, std::string_view fact) {
        if ((fields[0] != "pair" && fields[0] != "unit") || fields.size() < 3) return {};
        const std::string_view ids(fields[1].data(), fields[1].size() + 1 + fields[2].size());  // with the tab between
        const auto [first, fresh] = seen_.try_emplace(ids, Seen{fact, number_});
        if (fresh || first->second.fact == fact) return {};
        return "a second line for '" + std::string(fields[1]) + "=" + std::string(fields[2]) + "'; line " +
               std::to_string(first->second.number) +
               " says something else, as after a merge\nRemove one of the two, then run: porttool check";
    }

    static std::string unreadable(std::string_view line) {
        return "cannot be read: '" + beginning(line) +
               "'\nRestore the line from git, or renew the lock with: porttool init --force";
    }

    std::string_view text_;
    LockFile lock_;
    int number_ = 0;
    std::vector<bool> marks_ = std::vector<bool>(kMarks);  ///< those that were seen
    std::unordered_map<std::string_view, Seen> seen_;      ///< by both ids
};

std::string plain(std::string text) {
    for (char& c : text)
        if (c == '\t' || c == '\n' || c == '\r') c = ' ';
    return text;
}

std::string key_of(const std::string& source, const std::string& target) {
    return fmt::format("{:016x}", hash_text(source + "\t" + target)).substr(0, kLineKeyDigits);
}

std::string text_of(const Fingerprints& prints) {
    return prints.written.text() + "\t" + prints.renamed.text() + "\t" + prints.blanked.text();
}

std::string text_of(MoreFields more, std::initializer_list<std::pair<const char*, std::string>> own) {
    for (const auto& [name, value] : own)
        if (!value.empty()) more[name] = value;
    std::string out;
    for (const auto& [name, value] : more) out += "\t" + name + "=" + encoded(value);
    return out;
}

/// The lines of all facts, each under its key.
class LockLines {
public:
    void add(const std::string& source, const std::string& target, const std::string& fact) {
        const std::string key = key_of(source, target);
        lines_.insert(key);
        lines_.insert(key + "\t" + fact);
    }
    /// They and the marks, sorted.
    std::string joined() const {
        std::string out;
        auto line = lines_.begin();
        for (size_t mark = 0; mark < kMarks; ++mark) {
            const auto digits = digits_of(mark);
            const std::string_view text(digits.data(), digits.size());
            for (; line != lines_.end() && *line < text; ++line) out += *line + "\n";
            out += text;
            out += '\n';
        }
        for (; line != lines_.end(); ++line) out += *line + "\n";
        return out;
    }

private:
    std::set<std::string> lines_;
};

}  // namespace

const std::array<std::string, 3> CommonText::kCommon = {"", "source", "target"};

ReadLock read_lock(const std::string& text) { return LockReader(text).read(); }

std::string lock_text(const LockFile& lock) {
    LockLines lines;
    for (const LockedPair& pair : lock.pairs)
        lines.add(pair.source, pair.target,
                  "pair\t" + encoded(pair.source) + "\t" + encoded(pair.target) + "\t" + text_of(pair.source_prints) +
                      "\t" + text_of(pair.target_prints) +
                      text_of(pair.more, {{"state", pair.state},
                                          {"by", pair.by},
                                          {"source-macros", pair.macros.source},
                                          {"target-macros", pair.macros.target}}));
    for (const LockedUnit& unit : lock.baseline)
        lines.add(unit.id, "",
                  "unit\t" + plain(unit.side) + "\t" + encoded(unit.id) + "\t" + text_of(unit.prints) + "\t" +
                      plain(unit.reason) + text_of(unit.more, {}));
    for (const LedgerEntry& entry : lock.ledger)
        lines.add(entry.source, entry.target,
                  std::string(verdict_name(entry.verdict)) + "\t" + encoded(entry.source) + "\t" +
                      encoded(entry.target) + "\t" + entry.source_print.text() + "\t" + entry.target_print.text() +
                      "\t" + plain(entry.owner) + "\t" + plain(entry.until) + "\t" + plain(entry.reason) +
                      text_of(entry.more, {}));
    return fmt::format(
               "{}2\n{}{}\n# Written by porttool: what was in step, and what had no port. Edit with porttool accept, "
               "defer, ignore.\n# git merges it by itself: leave the lines that hold a number alone.\n",
               kLockHeader, kNormalFormLine, kNormalForm) +
           lines.joined();
}

}  // namespace porttool
