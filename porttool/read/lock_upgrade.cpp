// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/lock_upgrade.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <unordered_map>

#include "porttool/normal/prelude.h"
#include "porttool/text/is_one_of.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

Print print_of(int normal_form, const Words& words) {
    return normal_form == 1 ? fingerprint_of_version_1(words) : fingerprint(words);
}

/// The words of a text whose own control characters are not those that stand for blanks and line ends in it.
Words plain_words(std::string_view text) {
    Words words;
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find_first_of(" \n", at), text.size());
        if (end > at) words.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return words;
}

/// True for what normal form 3 did not have in a prelude: attributes of a function's further declarations, and layouts
/// that stand alone but for those of its groups' sizes.
bool is_new_in_form_4(std::span<const std::string_view> item) {
    const bool of_function = item.back() == "@" && item.front() != "default" && item.front() != "template";
    const bool layout_alone = item.front() == "layout" && (item[item.size() - 2] == ")") &&
                              is_one_of(item.back(), {"out", "uniform", "buffer"});
    return of_function || layout_alone;
}

/// A text of today as normal form 3 had it: with less in its prelude, and no strings in the pragmas there.
Words in_form_3(const Words& text) {
    const Words prelude = prelude_of(text);
    Words out;
    for (size_t first = 2, end = first; first + 1 < prelude.size(); first = end + 1) {
        for (end = first; prelude[end] != ";";) ++end;
        const std::span item(prelude.data() + first, end - first);
        if (item.empty() || (item.size() > 1 && is_new_in_form_4(item))) continue;
        const bool is_pragma = item.front() == "#";
        std::copy_if(item.begin(), item.end(), std::back_inserter(out),
                     [&](std::string_view word) { return !is_pragma || (word[0] != '"' && word[0] != '\''); });
        out.emplace_back(";");
    }
    if (!out.empty()) {
        out.insert(out.begin(), 2, ";");
        out.emplace_back(";");
    }
    const Words rest = without_prelude(text);
    out.insert(out.end(), rest.begin(), rest.end());
    return out;
}

/// A text of today as an older normal form had it: before 3 without a prelude.
Words in_form(int normal_form, const Words& text) { return normal_form < 3 ? without_prelude(text) : in_form_3(text); }

class Upgrade {
public:
    Upgrade(int from, const std::function<std::string(Print)>& text_of, const std::vector<const UnitsById*>& today)
        : from_(from), text_of_(text_of), today_(today) {
        for (const auto* side : today)
            for (const auto& [id, state] : *side) {
                const Print then = print_of(from, in_form(from, state.text.words()));
                then_.emplace(&state, then);
                now_.emplace(then, &state);
            }
        if (from < kFirstAlike) return;
        for (const auto* side : today)  // after all texts as they were then, which go first
            for (const auto& [id, state] : *side) now_.emplace(state.prints.written, &state);
    }

    UpgradedLock run(LockFile lock) {
        for (LockedPair& pair : lock.pairs) {
            renew(pair.source_prints, pair.source, Side::Source);
            renew(pair.target_prints, pair.target, Side::Target);
        }
        for (LockedUnit& unit : lock.baseline) renew_line(unit);
        for (LedgerEntry& entry : lock.ledger) {
            entry.source_print = find(entry.source_print, entry.source, Side::Source).written;
            entry.target_print = find(entry.target_print, entry.target, Side::Target).written;
        }
        lock.normal_form = kNormalForm;
        out_.lock = std::move(lock);
        return std::move(out_);
    }

private:
    /// From this form on prints are made alike: one of a text that says nothing which a later form added is as good
    /// today, and builds in between counted their locks as form 3 while they wrote what form 4 is.
    static constexpr int kFirstAlike = 3;

    static Side side_named(const std::string& word) {
        return word == side_word(Side::Source) ? Side::Source : Side::Target;
    }

    /// A line of the baseline, of which no text is kept.
    void renew_line(LockedUnit& unit) {
        const Fingerprints found = find(unit.prints.written, unit.id, side_named(unit.side));
        if (found.written.is_known() || from_ < kFirstAlike) unit.prints = found;
    }

    void renew(Fingerprints& prints, const std::string& id, Side side) {
        const Print old = prints.written;
        prints = find(old, id, side);
        if (prints.written.is_known() || !out_.error.empty()) return;
        out_.error = "portmap.lock is of an older porttool, and the text of '" + terminal_text(id) +
                     "' that it was in step with is not in portmap.base/ (" + old.text() +
                     ")\nRestore portmap.base/ from git, or record the present state with: porttool init --force";
    }

    /// Today's prints of the text behind an old one; none if that is nowhere. Units that an older form did not tell
    /// apart may be two today: that of the id goes first.
    Fingerprints find(Print old, const std::string& id, Side side) {
        if (today_.empty() || !old.is_known()) return find(old);
        const UnitsById& units = *today_.at(side == Side::Source ? 0 : 1);
        const auto own = units.find(id);
        if (own == units.end()) return find(old);
        const bool is_own =
            then_.at(&own->second) == old || (from_ >= kFirstAlike && own->second.prints.written == old);
        if (!is_own) return find(old);
        out_.texts.emplace(own->second.prints.written, own->second.text);
        return own->second.prints;
    }

    const Fingerprints& find(Print old) {
        const auto [known, fresh] = found_.try_emplace(old, Fingerprints{});
        if (!fresh || !old.is_known()) return known->second;
        NormalText text;
        if (const auto unit = now_.find(old); unit != now_.end()) {
            known->second = unit->second->prints;
            text = unit->second->text;
        } else if (text = text_of_print(old, text_of_(old), from_); !text.empty()) {
            known->second = prints_of_text(text);
        } else {
            return known->second;
        }
        out_.texts.emplace(known->second.written, std::move(text));
        return known->second;
    }

    int from_;
    const std::function<std::string(Print)>& text_of_;
    const std::vector<const UnitsById*>& today_;  ///< the source's and the target's, or none
    std::unordered_map<const UnitState*, Print> then_;
    std::map<Print, const UnitState*> now_;
    std::map<Print, Fingerprints> found_;
    UpgradedLock out_;
};

}  // namespace

bool is_outdated(const LockFile& lock) { return lock.normal_form < kNormalForm; }

UpgradedLock upgraded(LockFile lock, const std::function<std::string(Print)>& text_of,
                      const std::vector<const UnitsById*>& today) {
    const int from = lock.normal_form;
    return Upgrade(from, text_of, today).run(std::move(lock));
}

NormalText text_of_print(Print print, const std::string& recorded, int normal_form) {
    NormalText text = NormalText::read(recorded);
    const bool same =
        print_of(normal_form, text.words()) == print || print_of(normal_form, plain_words(recorded)) == print;
    return same ? std::move(text) : NormalText();
}

bool is_text_of_print(Print print, const std::string& recorded) {
    Fingerprinter plain;
    const char* const end = recorded.data() + recorded.size();
    for (const char* at = recorded.data(); at < end; ++at) {
        const char* word = at;
        while (at < end && *at != ' ' && *at != '\n') ++at;
        if (at > word) plain.add({word, static_cast<size_t>(at - word)});
    }
    return !recorded.empty() && (Print(plain) == print || !text_of_print(print, recorded, kNormalForm).empty());
}

}  // namespace porttool
