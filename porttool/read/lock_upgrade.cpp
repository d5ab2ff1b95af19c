// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/lock_upgrade.h"

#include <algorithm>

#include "porttool/normal/prelude.h"
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

class Upgrade {
public:
    Upgrade(int from, const std::function<std::string(Print)>& text_of,
            const std::vector<const std::map<std::string, UnitState>*>& today)
        : from_(from), text_of_(text_of) {
        for (const auto* side : today)
            for (const auto& [id, state] : *side)
                now_.emplace(print_of(from, without_prelude(state.text.words())), &state);
    }

    UpgradedLock run(LockFile lock) {
        for (LockedPair& pair : lock.pairs) {
            renew(pair.source_prints, pair.source);
            renew(pair.target_prints, pair.target);
        }
        for (LockedUnit& unit : lock.baseline) unit.prints = find(unit.prints.written);
        for (LedgerEntry& entry : lock.ledger) {
            entry.source_print = find(entry.source_print).written;
            entry.target_print = find(entry.target_print).written;
        }
        lock.normal_form = kNormalForm;
        out_.lock = std::move(lock);
        return std::move(out_);
    }

private:
    void renew(Fingerprints& prints, const std::string& id) {
        const Print old = prints.written;
        prints = find(old);
        if (prints.written.is_known() || !out_.error.empty()) return;
        out_.error = "portmap.lock is of an older porttool, and the text of '" + terminal_text(id) +
                     "' that it was in step with is not in portmap.base/ (" + old.text() +
                     ")\nRestore portmap.base/ from git, or record the present state with: porttool init --force";
    }

    /// Today's prints of the text behind an old one; none if that is nowhere.
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
    std::map<Print, const UnitState*> now_;
    std::map<Print, Fingerprints> found_;
    UpgradedLock out_;
};

}  // namespace

bool is_outdated(const LockFile& lock) { return lock.normal_form < kNormalForm; }

UpgradedLock upgraded(LockFile lock, const std::function<std::string(Print)>& text_of,
                      const std::vector<const std::map<std::string, UnitState>*>& today) {
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
