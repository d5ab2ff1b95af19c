// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/certainty.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "porttool/audit/edit_class.h"
#include "porttool/audit/message.h"
#include "porttool/language/language.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

std::string shown_statement(const WrittenStatement& statement) {
    const std::vector<std::string> words = words_of_statement(statement);
    const auto as_is = [](const Words& one, bool) { return std::vector<std::string>(one.begin(), one.end()); };
    std::string out;
    for (const Statement& part : split_statements(Words(words.begin(), words.end()), as_is))
        (out.empty() ? out : out += "; ") += part.shown;
    return out;
}

/// The words that a place lost and gained. Numbers say nothing without the commit that they belong to.
std::string core_of(const MissingPlace& place, const std::string& commit) {
    const std::vector<std::string> before = words_of_statement(place.before), now = words_of_statement(place.now);
    std::string out;
    bool names = false;
    for (const DiffStep& step : diff(before, now)) {
        if (step.kind == DiffStep::Keep) continue;
        const std::string& word = step.kind == DiffStep::Add ? now[step.now] : before[step.before];
        names = names || is_word_token(word);
        out += (step.kind == DiffStep::Add ? " +" : " -") + word;
    }
    return names ? out : commit + out;
}

/// The words that source and target have of their own in a place where both say something; "" for others.
std::string habit_of(const MissingPlace& place, Side now_is) {
    if (place.now.empty() || place.there.empty()) return {};
    const std::vector<std::string> now = words_of_statement(place.now), there = words_of_statement(place.there);
    const bool source = now_is == Side::Source;
    const auto& ours = source ? now : there;
    const auto& theirs = source ? there : now;
    std::string out;
    for (const DiffStep& step : diff(ours, theirs))
        if (step.kind != DiffStep::Keep)
            out += step.kind == DiffStep::Add ? " +" + theirs[step.now] : " -" + ours[step.before];
    return out;
}

const MissingPlace& strongest(const MissingEdit& edit) {
    return *std::max_element(edit.places.begin(), edit.places.end(),
                             [](const MissingPlace& a, const MissingPlace& b) { return a.strength < b.strength; });
}

/// Of a switch: there is but one way to say it.
bool is_label(const MissingPlace& place) { return place.before.empty() && place.now.starts_with("case"); }

float strength_of(const MissingEdit& edit) {
    float rest = -strongest(edit).strength;
    for (const MissingPlace& place : edit.places) rest += place.strength;
    return std::min(1.0f, strongest(edit).strength + 0.05f * std::min(2.0f, rest));
}

/// True for code that runs on a device, as far as a unit's own text and language tell.
bool is_device_code(const UnitState& unit) {
    const Language language = language_of_path(unit.file);
    if (unit.kind == UnitKind::Kernel || traits_of(language).literals == Literals::Shading ||
        language == Language::OpenCl || language == Language::Ispc)
        return true;
    for (size_t i = 0; i < unit.text.size() && unit.text[i] != "{"; ++i)
        if (unit.text[i] == "__device__" || unit.text[i] == "__global__") return true;
    return false;
}

/// Of each pair whether one of its units is paired with several functions of the other's file: then each is a part.
std::vector<bool> shared_pairs(const TodaysPairs& today) {
    std::map<std::pair<std::string, std::string>, std::set<std::string_view>> partners;  // by unit and partner's file
    const auto key = [&](const TodaysPair& pair, Side side) {
        return std::pair(pair.id[side], today.unit(pair, other(side)).file);
    };
    for (const TodaysPair& pair : today.pairs)
        for (const Side side : kBothSides)
            if (!pair.stray) partners[key(pair, side)].insert(leaf_of(today.unit(pair, other(side)).name));
    std::vector<bool> out;
    for (const TodaysPair& pair : today.pairs)
        out.push_back(!pair.stray && (partners.at(key(pair, Side::Source)).size() > 1 ||
                                      partners.at(key(pair, Side::Target)).size() > 1));
    return out;
}

/// Pairs whose target lies in another folder than that which goes by the name of the source's folder and has pairs
/// with it: `sort-gpu/check.h` with `scan-cpu/check.h` where there is a `sort-cpu`. They are copies of a third.
std::set<size_t> pairs_astray(const TodaysPairs& today) {
    constexpr size_t kTelling = 3;                          // letters
    std::map<std::string, std::set<std::string>> partners;  // of the source's folders
    std::vector<std::pair<std::string, std::string>> folders;
    const auto folder = [](const std::string& file) { return file.substr(0, std::min(file.rfind('/'), file.size())); };
    for (const TodaysPair& pair : today.pairs) {
        folders.emplace_back(folder(today.unit(pair, Side::Source).file), folder(today.unit(pair, Side::Target).file));
        if (!pair.stray) partners[folders.back().first].insert(folders.back().second);
    }
    const auto common = [](const std::string& a, const std::string& b) {
        const size_t from_a = a.rfind('/') + 1, from_b = b.rfind('/') + 1;
        size_t out = 0;
        while (from_a + out < a.size() && from_b + out < b.size() && a[from_a + out] == b[from_b + out]) ++out;
        return out;
    };
    std::set<size_t> out;
    for (size_t i = 0; i < folders.size(); ++i) {
        const auto& [source, target] = folders[i];
        const size_t least = std::max(kTelling, common(source, target) + 1);
        const std::set<std::string>& all = partners[source];
        const auto is_namesake = [&, &from = source](const std::string& one) { return common(from, one) >= least; };
        if (std::any_of(all.begin(), all.end(), is_namesake)) out.insert(i);
    }
    return out;
}

/// The name of a file without folders and what stands behind its first dot.
std::string stem_of(const std::string& file) {
    const std::string name = file.substr(file.rfind('/') + 1);
    return folded(name.substr(0, name.find('.')));
}

/// Pairs of two names whose target's file has less of the name of the source's than another file has, or the other
/// way round: `TableForceGPU.cu` with `HarmonicForce.cc`, where there is a `TableForce.cc`. By their places.
std::set<size_t> pairs_in_odd_files(const TodaysPairs& today) {
    constexpr size_t kTelling = 4;  // letters that it has more
    BySide<std::set<std::string>> stems;
    for (const ScannedFile& file : today.snapshot.project.source) stems.source.insert(stem_of(file.path));
    for (const ScannedFile& file : today.snapshot.project.target) stems.target.insert(stem_of(file.path));
    const auto common = [](const std::string& a, const std::string& b) {
        return static_cast<size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
    };
    const auto longest = [&](const std::string& stem, const std::set<std::string>& among) {
        size_t out = 0;  // the nearest in order has most in common
        const auto at = among.lower_bound(stem);
        if (at != among.end()) out = common(stem, *at);
        if (at != among.begin()) out = std::max(out, common(stem, *std::prev(at)));
        return out;
    };
    std::set<size_t> out;
    for (size_t i = 0; i < today.pairs.size(); ++i) {
        const TodaysPair& pair = today.pairs[i];
        const UnitState &source = today.unit(pair, Side::Source), &target = today.unit(pair, Side::Target);
        const std::string a = folded(leaf_of(source.name)), b = folded(leaf_of(target.name));
        if (pair.confirmed || a.find(b) != std::string::npos || b.find(a) != std::string::npos) continue;
        const std::string from = stem_of(source.file), to = stem_of(target.file);
        const size_t least = common(from, to) + kTelling;
        if (longest(from, stems.target) >= least || longest(to, stems.source) >= least) out.insert(i);
    }
    return out;
}

/// True for a function that reads the command line: what it takes is its program's own.
bool reads_arguments(const UnitState& unit) {
    const Words words = unit.text.words();
    return unit.name == "main" || std::find(words.begin(), words.end(), "argv") != words.end();
}

/// True for a statement that does: `if ( argc != 5 )`.
bool reads_command_line(const WrittenStatement& statement) {
    const std::vector<std::string> words = words_of_statement(statement);
    return std::any_of(words.begin(), words.end(), [](const auto& word) { return is_one_of(word, {"argc", "argv"}); });
}

/// True for a function that says what it has to say in one statement: most often what a runtime calls by another name.
bool is_wrapper(const UnitState& unit) {
    return unit.kind == UnitKind::Function && written_statements(unit.text.words()).size() <= 2;  // with its head
}

/// Pairs of two names of which one unit is paired with its namesake, too: `forward_half` with `forward`, where both
/// sides have a `forward`. By their places.
std::set<size_t> pairs_beside_namesakes(const TodaysPairs& today) {
    const auto leaf = [&](size_t pair, Side side) { return folded(leaf_of(today.unit(today.pairs[pair], side).name)); };
    BySide<std::set<std::string>> with_namesake;  // ids
    for (size_t i = 0; i < today.pairs.size(); ++i)
        if (leaf(i, Side::Source) == leaf(i, Side::Target))
            for (const Side side : kBothSides) with_namesake[side].insert(today.pairs[i].id[side]);
    std::set<size_t> out;
    for (size_t i = 0; i < today.pairs.size(); ++i)
        if (!today.pairs[i].confirmed && leaf(i, Side::Source) != leaf(i, Side::Target))
            for (const Side side : kBothSides)
                if (with_namesake[side].contains(today.pairs[i].id[side])) out.insert(i);
    return out;
}

/// The functions of a side, by the last part of their names.
std::set<std::string> functions_by_leaf(const States& states, Side side) {
    std::set<std::string> out;
    for (const auto& [id, unit] : states[side])
        if (unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel)
            out.insert(std::string(leaf_of(unit.name)));
    return out;
}

/// Edits by commits of which each side of a pair lacks something: then each has it in its own manner. By their places.
std::set<size_t> done_in_two_manners(const std::vector<FoundEdit>& found) {
    std::map<std::pair<size_t, uint32_t>, BySide<bool>> seen;  // by pair and commit
    for (const FoundEdit& one : found) seen[{one.pair, one.edit.commit}][one.edit.side] = true;
    std::set<size_t> out;
    for (size_t i = 0; i < found.size(); ++i) {
        const BySide<bool>& sides = seen.at({found[i].pair, found[i].edit.commit});
        if (sides.source && sides.target) out.insert(i);
    }
    return out;
}

/// What is known of an edit beyond itself.
struct Surroundings {
    bool elsewhere = false;    ///< another port of the same unit has it
    bool two_manners = false;  ///< the other side lacks it, and this side what the commit did there
};

struct Judged {
    double certainty = 0;
    std::vector<std::string> why;
};

/// Sums up what speaks for an edit and against it, as a logistic regression does.
class Judge {
public:
    Judge(const WalkedPast& walked, const TodaysPairs& today, const Habits& habits)
        : walked_(walked),
          today_(today),
          habits_(habits),
          shared_(shared_pairs(today)),
          beside_namesakes_(pairs_beside_namesakes(today)),
          odd_files_(pairs_in_odd_files(today)),
          functions_{functions_by_leaf(today.snapshot.states, Side::Source),
                     functions_by_leaf(today.snapshot.states, Side::Target)} {
        for (const auto* files : {&today.snapshot.project.source, &today.snapshot.project.target})
            for (const ScannedFile& file : *files) add_macros_of_host(file, host_macros_);
    }

    Judged of(const FoundEdit& found, const Surroundings& around) {
        out_ = {};
        z_ = -3.0 + 5.0 * static_cast<double>(strength_of(found.edit));
        weigh_message(walked_.steps[found.edit.commit].message, found);
        weigh_places(found.edit.places);
        weigh_commit(walked_.units[found.edit.commit]);
        weigh_size(found);
        if (found.edit.both) {
            z_ -= strongest(found.edit).kind == MissingPlace::Kind::Replaced ? 0.6 : 1.2;
            out_.why.emplace_back("the commit edited both sides, and this did not come along");
        } else if (found.both_files && !is_label(strongest(found.edit))) {
            z_ -= 0.8;
            out_.why.emplace_back("the commit edited the other side's file, too");
        }
        if (strongest(found.edit).kind == MissingPlace::Kind::Removed)
            z_ -= 2.2;  // it may be of no use there, and do no harm
        if (reads_command_line(strongest(found.edit).now)) z_ -= 2;
        if (found.edit.past && strongest(found.edit).kind != MissingPlace::Kind::Replaced) {
            z_ -= is_label(strongest(found.edit)) ? 2.4 : 1.2;  // a switch is written with all of its labels
            out_.why.emplace_back("the other side was written after the edit");
        } else if (found.edit.since && strongest(found.edit).kind == MissingPlace::Kind::Added &&
                   !is_label(strongest(found.edit))) {
            z_ -= 0.4;
            out_.why.emplace_back("the other side was edited since");
        }
        if (around.two_manners) {
            z_ -= 1;
            out_.why.emplace_back("the commit did something there that this side lacks: each may have its manner");
        }
        weigh_class(found);
        if (around.elsewhere && !beside_namesakes_.contains(found.pair)) {
            z_ += 1;
            out_.why.emplace_back("another port of the same function has it");
        }
        weigh_pair(found);
        if (habits_.contains(habit_of(strongest(found.edit), found.edit.side))) {
            z_ -= 3;
            out_.why.emplace_back("many pairs differ in the same words: it may be a manner of the two sides");
        }
        weigh_surroundings(strongest(found.edit));
        constexpr double kMost = 0.95;  // words alone make nobody surer
        out_.certainty = kMost / (1 + std::exp(-z_));
        return std::move(out_);
    }

private:
    void weigh_message(const std::string& message, const FoundEdit& found) {
        const MessageSays says = read_message(message);
        if (says.fix && says.manner) {
            z_ += 0.2;
        } else if (says.fix) {
            z_ += says.in_text ? 0.5 : 1.3;
            out_.why.emplace_back("the commit message speaks of a fix");
        } else if (says.manner) {
            z_ -= 1.2;
            out_.why.emplace_back("the commit message speaks of looks or structure");
        } else if (says.speed) {
            z_ -= 1.3;
            out_.why.emplace_back("the commit message speaks of speed");
        }
        if (says.platform) {
            z_ -= 2;
            out_.why.emplace_back("the commit message speaks of one platform");
        }
        if (says.threads && !is_device_code(today_.unit(today_.pairs[found.pair], other(found.edit.side)))) {
            z_ -= 1.5;
            out_.why.emplace_back("the commit message speaks of threads");
        }
    }

    /// What the other side seldom needs.
    void weigh_class(const FoundEdit& found) {
        const MissingPlace& place = strongest(found.edit);
        const UnitState& unit = today_.unit(today_.pairs[found.pair], found.edit.side);
        const UnitState& there = today_.unit(today_.pairs[found.pair], other(found.edit.side));
        const auto weigh = [&](bool is, double more, const char* why) {
            if (!is) return;
            z_ -= more;
            out_.why.emplace_back(why);
        };
        weigh(only_hands_on(place, functions_[found.edit.side]), 1.5, "only what a function takes became other");
        weigh(is_option(place, unit), 3, "an option of a program");
        weigh(place.kind == MissingPlace::Kind::Added && guards_pointer(place, unit), 2, "a test for null");
        weigh(names_type(place), 4, "the name of a type");
        weigh(keeps_address(place), 2, "only where something lies");
        weigh(numbers_label(place, there), 2.5, "the other side's labels are names");
        weigh(guards_launch(place), 1.5, "a guard against a launch of no threads");
        weigh(takes_other_local(place, unit), 1.2, "a local gave way to another");
        weigh(sets_tolerance(place), 6, "a bound within which results are taken for equal");
        weigh(goes_on_from_itself(place, unit), 3, "one variable holds what two did");
        weigh(exchanges_in_group(place), 3, "how the threads of a group work together");
        weigh(is_taken_by_runtime(place), 2.5, "what a runtime's function takes");
        weigh(asks_for_type(place), 2, "a branch by type");
        weigh(lies_behind_lambda(place), 3.5, "what a call takes behind a lambda");
        weigh(asks_for_memory(place), 3, "a test for memory");
        weigh(takes_macro_of_host(place, host_macros_), 3, "a macro that the host gives");
        weigh(names_expression(place, there), 1.2, "an expression got a name");
        weigh(place.kind == MissingPlace::Kind::Added && is_wrapper(unit), 3, "a function of one statement");
    }

    /// Where each side says everything around the place in its own words, that it says the edit, too, is nothing that
    /// a comparison of words can rule out. Last: it takes what the rest came to, and makes odds of it that hold.
    void weigh_surroundings(const MissingPlace& place) {
        constexpr double kWorth = 2, kEven = 0.85, kSlope = 1.3;  // counted on the items of ten pairs of folders
        constexpr float kSame = 0.8f, kOther = 0.25f;
        z_ = kSlope * (z_ + kWorth * static_cast<double>(place.around) - kEven);
        if (place.around >= kSame) out_.why.emplace_back("what stands around it stands on the other side, too");
        if (place.around <= kOther) out_.why.emplace_back("what stands around it is said otherwise on the other side");
    }

    void weigh_places(const std::vector<MissingPlace>& places) {
        const auto any = [&](auto test) { return std::any_of(places.begin(), places.end(), test); };
        if (any([](const MissingPlace& place) { return place.kind == MissingPlace::Kind::Replaced; }))
            out_.why.emplace_back("the text from before the edit still stands on the other side");
        if (any([](const MissingPlace& place) { return place.constants_only; })) {
            z_ += 0.4;
            out_.why.emplace_back("constants differ");
        }
        constexpr double kSmall = 4;  // places
        const auto count = static_cast<double>(places.size());
        if (count > kSmall) z_ -= std::min(1.5, 0.15 * (count - kSmall));
    }

    /// Who writes a unit anew says the same in other words, too.
    void weigh_size(const FoundEdit& found) {
        constexpr double kSmall = 6, kPart = 0.15;  // places, and the share of the unit
        const UnitState& unit = today_.unit(today_.pairs[found.pair], found.edit.side);
        const auto all = static_cast<double>(written_statements(unit.text.words()).size());
        const auto size = static_cast<double>(found.edit.size);
        if (size <= kSmall || size <= kPart * all) return;
        z_ -= std::min(3.0, 0.6 * std::log2(size / std::max(kSmall, kPart * all)));
        out_.why.push_back("the commit edited " + std::to_string(found.edit.size) + " places of the unit");
    }

    void weigh_commit(uint32_t units) {
        constexpr uint32_t kFew = 8;
        if (units <= kFew) return;
        z_ -= std::min(2.5, 0.7 * std::log2(static_cast<double>(units) / kFew));
        out_.why.push_back("the commit edited " + std::to_string(units) + " units");
    }

    void weigh_pair(const FoundEdit& found) {
        const TodaysPair& pair = today_.pairs[found.pair];
        if (!is_device_code(today_.unit(pair, Side::Source)) && !is_device_code(today_.unit(pair, Side::Target)))
            z_ -= reads_arguments(today_.unit(pair, found.edit.side)) ? 1.5 : 0.4;
        z_ += 2.0 * (static_cast<double>(found.alike) - 0.4);
        if (!pair.confirmed) z_ += 3 * (pair.score - 0.9);
        if (shared_[found.pair]) z_ -= 1;
        if (beside_namesakes_.contains(found.pair)) {
            z_ -= 2;
            out_.why.emplace_back("each of the two has, or may have, a port of its own name");
        }
        if (odd_files_.contains(found.pair)) {
            z_ -= 2;
            out_.why.emplace_back("another file goes by the name of this one");
        }
        const auto is_program = [&](Side side) { return today_.unit(pair, side).name == "main"; };
        if (is_program(Side::Source) != is_program(Side::Target)) z_ -= 1.6;  // a kernel, and all that is around it
    }

    const WalkedPast& walked_;
    const TodaysPairs& today_;
    const Habits& habits_;
    Judged out_;
    std::vector<bool> shared_;
    std::set<size_t> beside_namesakes_, odd_files_;
    BySide<std::set<std::string>> functions_;
    std::set<std::string> host_macros_;
    double z_ = 0;
};

/// A long statement cut down to the part in which it differs from another one.
WrittenStatement telling_part(const WrittenStatement& statement, const WrittenStatement& than) {
    constexpr size_t kLong = 48, kAround = 10, kMost = 60;  // words
    const std::vector<std::string> words = words_of_statement(statement), others = words_of_statement(than);
    if (words.size() <= kLong) return statement;
    size_t first = 0, last = words.size();
    while (first < last && first < others.size() && words[first] == others[first]) ++first;
    for (size_t end = others.size(); last > first && end > first && words[last - 1] == others[end - 1]; --end) --last;
    first -= std::min(first, kAround);
    last = std::min({words.size(), last + kAround, first + kMost});
    WrittenStatement out = first > 0 ? "..." : "";
    for (size_t i = first; i < last; ++i) (out.empty() ? out : out += '\x1f') += words[i];
    return last < words.size() ? out + "\x1f..." : out;
}

/// The first words of a long statement.
WrittenStatement short_part(const WrittenStatement& statement) {
    constexpr size_t kLong = 24;  // words
    const std::vector<std::string> words = words_of_statement(statement);
    if (words.size() <= kLong) return statement;
    WrittenStatement out = words[0];
    for (size_t i = 1; i < kLong; ++i) out += '\x1f' + words[i];
    return out + "\x1f...";
}

std::string summary_of(const MissingEdit& edit) {
    const MissingPlace& place = strongest(edit);
    const std::string other = edit.side == Side::Source ? "the target" : "the source";
    const auto quoted_one = [](const WrittenStatement& statement) { return "`" + shown_statement(statement) + "`"; };
    switch (place.kind) {
        case MissingPlace::Kind::Replaced: {
            const std::string there = quoted_one(telling_part(place.there, place.now)),
                              before = quoted_one(telling_part(place.before, place.now));
            return other + " still has " + there + (before == there ? ", which" : " where " + before) + " became " +
                   quoted_one(telling_part(place.now, place.before));
        }
        case MissingPlace::Kind::Added:
            return other + " lacks " + quoted_one(place.now) +
                   (place.behind.empty() ? ""
                                         : ", which stands behind " + quoted_one(short_part(place.behind)) + " here");
        case MissingPlace::Kind::Removed:
            return other + " still has " + quoted_one(place.there) + ", which this side took away";
    }
    return "";
}

double certainty_of_today(const DifferingPair& one, const TodaysPair& pair) {
    constexpr double kMost = 0.3;  // nothing tells which side is right, or whether they were ever to be the same
    if (one.is_slip) return static_cast<double>(one.places.front().strength) * pair.score;
    return kMost * static_cast<double>(one.alike) * pair.score / static_cast<double>(one.places.size());
}

std::vector<DifferingPair> surest_first(std::vector<DifferingPair> differing, const TodaysPairs& today) {
    std::stable_sort(differing.begin(), differing.end(), [&](const DifferingPair& a, const DifferingPair& b) {
        return certainty_of_today(a, today.pairs[a.pair]) > certainty_of_today(b, today.pairs[b.pair]);
    });
    return differing;
}

std::string summary_of_today(const MissingPlace& place) {
    const auto quoted = [](const WrittenStatement& statement) { return "`" + shown_statement(statement) + "`"; };
    if (place.there.empty()) return "the source has " + quoted(place.now) + ", and the target nothing like it";
    if (place.now.empty()) return "the target has " + quoted(place.there) + ", and the source nothing like it";
    return "the source has " + quoted(place.now) + ", the target " + quoted(place.there);
}

std::string remedy_for_pair(const TodaysPair& pair, const TodaysPairs& today) {
    return std::string(today.snapshot.project.has_map ? "" : "porttool init, then ") + "porttool ignore '" +
           pair.id.source + "=" + pair.id.target + "' --reason TEXT";
}

AuditItem item_of(FoundEdit found, Judged judgement, const WalkedPast& walked, const TodaysPairs& today) {
    const TodaysPair& pair = today.pairs[found.pair];
    AuditItem item;
    item.id = pair.id;
    for (const Side side : kBothSides) item.line[side] = today.unit(pair, side).start_line;
    item.edited = found.edit.side;
    item.commit = walked.steps[found.edit.commit].commit;
    item.summary = summary_of(found.edit);
    item.certainty = judgement.certainty;
    item.why = std::move(judgement.why);
    item.places = std::move(found.edit.places);
    item.remedy = remedy_for_pair(pair, today);
    return item;
}

/// Which edits some other port of the same unit has, by their places in `found`.
std::set<size_t> known_to_other_ports(const std::vector<FoundEdit>& found, const TodaysPairs& today,
                                      const std::vector<float>& alike) {
    constexpr float kPort = 0.5f;  // from that on a pair says enough alike for its silence to tell something
    std::map<std::string, std::set<size_t>> pairs_of;  // by the unit's id
    for (size_t i = 0; i < today.pairs.size(); ++i)
        if (alike[i] >= kPort)
            for (const Side side : kBothSides) pairs_of[today.pairs[i].id[side]].insert(i);
    std::map<std::pair<std::string, uint32_t>, std::set<size_t>> lack;  // by unit and commit: the pairs
    const auto unit_of = [&](const FoundEdit& one) { return today.pairs[one.pair].id[one.edit.side]; };
    for (const FoundEdit& one : found) lack[{unit_of(one), one.edit.commit}].insert(one.pair);
    std::set<size_t> out;
    for (size_t i = 0; i < found.size(); ++i) {
        const std::set<size_t>& missing = lack[{unit_of(found[i]), found[i].edit.commit}];
        const std::set<size_t>& ports = pairs_of[unit_of(found[i])];
        if (std::any_of(ports.begin(), ports.end(), [&](size_t pair) { return !missing.contains(pair); }))
            out.insert(i);
    }
    return out;
}

}  // namespace

Habits habits_of(const std::vector<FoundEdit>& found, const std::vector<DifferingPair>& differing, size_t pairs) {
    std::map<std::string, std::set<size_t>> seen;  // in which pairs
    for (const FoundEdit& one : found)
        for (const MissingPlace& place : one.edit.places) seen[habit_of(place, one.edit.side)].insert(one.pair);
    for (const DifferingPair& one : differing)
        for (const MissingPlace& place : one.places) seen[habit_of(place, Side::Source)].insert(one.pair);
    seen.erase("");
    constexpr size_t kFewest = 8, kShare = 25;  // of the pairs, as one in so many
    Habits out;
    for (const auto& [words, where] : seen)
        if (where.size() >= std::max(kFewest, pairs / kShare)) out.insert(words);
    return out;
}

void take_witness(const DifftestPair& ran, AuditItem& item) {
    constexpr double kSeen = 3, kNotSeen = -2;  // what it adds, as logarithm of the odds
    const auto weigh = [&](double more) {
        const double odds = item.certainty / (1 - item.certainty) * std::exp(more);
        item.certainty = odds / (1 + odds);
    };
    if (ran.state == DifftestState::NotRun) {
        item.why.push_back("not run: " + ran.reason);
    } else if (ran.counterexample) {
        item.witness = ran.counterexample;
        weigh(kSeen);
    } else {
        item.why.push_back("both sides gave the same for " + std::to_string(ran.inputs) + " inputs");
        weigh(kNotSeen);
    }
}

std::vector<AuditItem> items_of_today(const std::vector<DifferingPair>& differing, const TodaysPairs& today,
                                      const Habits& habits) {
    std::map<std::string, size_t> folded;  // by the words that differ: an item
    const std::set<size_t> astray = pairs_astray(today), beside = pairs_beside_namesakes(today),
                           odd_files = pairs_in_odd_files(today);
    std::vector<AuditItem> out;
    for (const DifferingPair& one : surest_first(differing, today)) {
        const TodaysPair& pair = today.pairs[one.pair];
        MissingPlace place = one.places.front();
        const bool is_doubtful =  // as a pair, which a likely partner is not in any case
            !pair.stray && (astray.contains(one.pair) || beside.contains(one.pair) || odd_files.contains(one.pair));
        if (habits.contains(habit_of(place, Side::Source)) || is_doubtful ||
            (only_waits(place.now) && only_waits(place.there)))
            continue;
        place.before = place.there;
        if (sets_tolerance(place)) continue;
        const std::string files =  // of them numbers say enough
            today.unit(pair, Side::Source).file + ' ' + today.unit(pair, Side::Target).file;
        const auto [known, is_new] = folded.try_emplace(core_of(place, files), out.size());
        if (!is_new) {
            AuditItem& first = out[known->second];
            if (first.id.source != pair.id.source || first.id.target != pair.id.target)
                first.same.emplace_back(pair.id.source, pair.id.target);
            continue;
        }
        AuditItem item;
        item.id = pair.id;
        for (const Side side : kBothSides) item.line[side] = today.unit(pair, side).start_line;
        item.summary = summary_of_today(one.places.front());
        item.certainty = certainty_of_today(one, pair);
        item.remedy = remedy_for_pair(pair, today);
        item.places = one.places;
        out.push_back(std::move(item));
    }
    return out;
}

std::vector<AuditItem> ranked(std::vector<FoundEdit> found, const WalkedPast& walked, const TodaysPairs& today,
                              const Habits& habits, const std::vector<float>& alike) {
    Judge judge(walked, today, habits);
    std::vector<Judged> judgements;
    std::vector<size_t> order;
    const std::set<size_t> elsewhere = known_to_other_ports(found, today, alike),
                           two_manners = done_in_two_manners(found);
    for (size_t i = 0; i < found.size(); ++i) {
        order.push_back(i);
        judgements.push_back(judge.of(found[i], {elsewhere.contains(i), two_manners.contains(i)}));
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return judgements[a].certainty > judgements[b].certainty; });
    std::map<std::pair<Side, std::string>, size_t> folded;  // by side and what was done: an item
    std::vector<AuditItem> out;
    for (const size_t i : order) {
        const MissingEdit& edit = found[i].edit;
        const std::string core = core_of(strongest(edit), walked.steps[edit.commit].commit.id);
        const auto [known, is_new] = folded.try_emplace({edit.side, core}, out.size());
        if (is_new) {
            out.push_back(item_of(std::move(found[i]), std::move(judgements[i]), walked, today));
        } else {
            const BySide<std::string>& id = today.pairs[found[i].pair].id;
            out[known->second].same.emplace_back(id.source, id.target);
        }
    }
    return out;
}

}  // namespace porttool
