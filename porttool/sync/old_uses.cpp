// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/old_uses.h"

#include <algorithm>
#include <map>

#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/operands.h"

namespace porttool {
namespace {

class OldUses : EditReading {
public:
    OldUses(const EditReading& reading, Transplant& out) : EditReading(reading), out_(out) {}

    void leave() {
        for (const auto& [names, times] : replaced_names()) {
            const auto& [was, is] = names;
            const size_t declared = declaration_now(is);
            constexpr size_t kFewest = 2;
            if (times < kFewest || declared == kNothing || !is_said_only_in(declared, was)) continue;
            for (size_t i = head_end(); i < texts_.target.words.size(); ++i)
                if (is_plain(texts_.target.words, i, was) && stays(i))
                    out_.left.push_back({"the source says `" + is + "` for `" + was +
                                             "` throughout; the port has it in a statement of its own",
                                         declared, i});
        }
    }

    /// What is pointed to came to be of another type, and a statement of the port's own still sizes it by the old one.
    void leave_sizes() {
        const std::vector<std::string>& words = texts_.target.words;
        for (const WordsReplaced& one : out_.replaced) {
            const std::string name = pointer_retyped(one);
            if (name.empty()) continue;
            const std::string& type = words[one.first];
            for (size_t c = 1; c < texts_.target.clauses.size(); ++c) {
                if (stands_for_something(c) || !names_plainly(target(c), name)) continue;
                for (size_t i = target(c).first + 1; i + 1 < target(c).end; ++i)
                    if (words[i] == type && stays(i) && is_one_of(words[i - 1], {"(", "<"}) &&
                        is_one_of(words[i + 1], {")", ">"}))
                        return out_.left.push_back({"the source has `" + one.words.front().text + "` for `" + type +
                                                        "` where it declares `" + name +
                                                        "`; the port still sizes it by that in a statement of its own",
                                                    one.source_first, i});
            }
        }
    }

private:
    using Names = std::pair<std::string, std::string>;

    /// The name of a pointer whose type is replaced by another one; "" for anything else.
    std::string pointer_retyped(const WordsReplaced& one) const {
        const std::vector<std::string>& words = texts_.target.words;
        const bool is_type = one.end == one.first + 1 && one.words.size() == 1 && one.end + 1 < words.size() &&
                             is_type_word(words[one.first]) && one.words.front().text != words[one.first];
        return is_type && words[one.end] == "*" && is_name(words[one.end + 1]) ? words[one.end + 1] : std::string();
    }

    bool names_plainly(const Clause& clause, const std::string& name) const {
        for (size_t i = clause.first; i < clause.end; ++i)
            if (is_plain(texts_.target.words, i, name)) return true;
        return false;
    }

    static bool is_plain(const std::vector<std::string>& words, size_t i, const std::string& name) {
        return words[i] == name && (i == 0 || (!is_accessor(words[i - 1]) && words[i - 1] != "::"));
    }
    size_t head_end() const { return texts_.target.clauses.empty() ? 0 : target(0).end; }

    /// Single names of the port that become others of the same names as on the source, and how often.
    std::map<Names, size_t> replaced_names() const {
        std::map<Names, size_t> out;
        for (const WordsReplaced& one : out_.replaced) {
            if (one.end - one.first != one.words.size()) continue;
            for (size_t k = 0; k < one.words.size(); ++k) {
                const std::string &was = texts_.target.words[one.first + k], &is = one.words[k].text;
                const auto& before = texts_.before.words;
                if (was != is && is_name(was) && is_name(is) &&
                    std::find(before.begin(), before.end(), was) != before.end())
                    ++out[{was, is}];
            }
        }
        return out;
    }

    /// The one clause of the source's new text that declares a name which the old one had not; kNothing for none.
    size_t declaration_now(const std::string& name) const {
        const auto& before = texts_.before.words;
        const auto& is = texts_.now.words;
        if (std::find(before.begin(), before.end(), name) != before.end()) return kNothing;
        const auto first = std::find(is.begin(), is.end(), name);
        const auto at = static_cast<size_t>(first - is.begin());
        return at > 0 && at + 1 < is.size() && is_word_token(is[at - 1]) && is[at + 1] == "=" ? at : kNothing;
    }

    /// True if the source's new text has a name in the clause around `word` and nowhere else behind its head.
    bool is_said_only_in(size_t word, const std::string& name) const {
        const auto& clauses = texts_.now.clauses;
        const auto around = std::find_if(clauses.begin(), clauses.end(),
                                         [&](const Clause& c) { return c.first <= word && word < c.end; });
        if (around == clauses.end()) return false;
        bool within = false;
        for (size_t i = clauses.front().end; i < texts_.now.words.size(); ++i) {
            if (!is_plain(texts_.now.words, i, name)) continue;
            if (i < around->first || i >= around->end) return false;
            within = true;
        }
        return within;
    }

    bool stays(size_t word) const {
        const bool is_replaced = std::any_of(out_.replaced.begin(), out_.replaced.end(), [&](const WordsReplaced& one) {
            return one.first <= word && word < one.end;
        });
        const bool goes = std::any_of(out_.removed.begin(), out_.removed.end(),
                                      [&](size_t c) { return target(c).first <= word && word < target(c).end; });
        const bool declares =
            word > 0 && is_word_token(texts_.target.words[word - 1]) && texts_.target.words[word - 1] != "return";
        return !is_replaced && !goes && !declares;
    }

    Transplant& out_;
};

}  // namespace

void leave_old_uses(const EditReading& reading, Transplant& out) {
    OldUses uses(reading, out);
    uses.leave();
    uses.leave_sizes();
}

}  // namespace porttool
