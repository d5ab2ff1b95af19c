// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/own_words.h"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/compare/grouping.h"
#include "porttool/compare/item_ends.h"
#include "porttool/compare/side_by_side.h"
#include "porttool/compare/side_edit.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"
#include "porttool/text/is_one_of.h"
#include "porttool/value_graph/pure_calls.h"

namespace porttool {
namespace {

constexpr size_t kMostBeside = 24'000;  // of all texts
constexpr size_t kTwins = 10;           // texts of which less than one word in so many differs are held to every word

using Text = std::vector<std::string>;
using Counts = std::map<std::string_view, size_t>;

/// What stands alone, by common word.
std::map<std::string, size_t> in_common(const Counts& alone, const Dialect& dialect) {
    std::map<std::string, size_t> out;
    for (const auto& [word, times] : alone) {
        std::string common = common_word(word, dialect);
        out[common.empty() ? std::string(word) : common] += times;
    }
    return out;
}

/// The two texts of a pair beside each other, before and now.
struct Distance {
    size_t unlike;                                       ///< names, numbers and operators of both
    BySide<std::map<std::string, size_t>> alone;         ///< numbers and operators that have no like in the other text
    std::set<size_t> covered;                            ///< the target's words that have their like in the source
    BySide<std::vector<size_t>> misplaced;               ///< what stands where another word should
    std::vector<size_t> crossed;                         ///< the source's names that stand for another one elsewhere
    std::vector<std::pair<size_t, size_t>> other_names;  ///< of both, that stand where the other has another

    Distance(const std::vector<std::string>& source, const std::vector<std::string>& target, const Dialect& dialect) {
        WordKeys keys(dialect);
        const AlignedText a = keys.text(source, false), b = keys.text(target, false);
        read(SideBySide(source, target, a, b), dialect);
    }

    Distance(const SideBySide& laid, const Dialect& dialect) { read(laid, dialect); }

private:
    void read(const SideBySide& laid, const Dialect& dialect) {
        unlike = laid.unlike();
        covered = laid.covered();
        misplaced = laid.misplaced();
        crossed = laid.crossed();
        other_names = laid.other_names();
        alone = {in_common(laid.alone(), dialect), in_common(laid.alone_there(), dialect)};
    }
};

/// Two moments of a pair.
struct Way {
    const Distance &then, &today;

    /// True if such a number or operator stands without its like more often than before.
    bool is_lonelier(const std::string& word, Side side) const {
        return times_in(today.alone[side], word) > times_in(then.alone[side], word);
    }
};

size_t words_of(const std::map<std::string, size_t>& counts) {
    size_t out = 0;
    for (const auto& [word, times] : counts) out += times;
    return out;
}

/// True if each number and operator that one side has more often, or less often, than before is one that the other
/// side's edit brought or took as well, or that stands there as often anyway; or that has its like there.
bool signs_follow(const SideEdit& here, const SideEdit& there, Side side, const Way& way) {
    const auto followed = [&](const std::string& word) {
        if (is_word_token(word)) return true;
        const size_t was = times_in(here.had, word), is = times_in(here.has, word), other = times_in(there.has, word);
        if (is > was) return there.gained.contains(word) || other >= is || !way.is_lonelier(word, side);
        return is == was || there.lost.contains(word) || other <= is || !way.is_lonelier(word, porttool::other(side));
    };
    return std::all_of(here.gained.begin(), here.gained.end(), followed) &&
           std::all_of(here.lost.begin(), here.lost.end(), followed);
}

/// The same of an edit of one side alone, which brings nothing that the other has not.
bool signs_arrive(const SideEdit& here, const SideEdit& there, const Way& way) {
    const auto arrived = [&](const std::string& word) {
        if (is_word_token(word)) return true;
        const size_t was = times_in(here.had, word), is = times_in(here.has, word), other = times_in(there.has, word);
        if (is < was) return other <= is || !way.is_lonelier(word, Side::Target);
        return !way.is_lonelier(word, Side::Source);
    };
    return std::all_of(here.gained.begin(), here.gained.end(), arrived) &&
           std::all_of(here.lost.begin(), here.lost.end(), arrived);
}

/// True if nearly all names that are new on one side have their like among those of the other.
bool names_follow(const SideEdit& here, const SideEdit& there) {
    size_t lone = 0;
    for (const auto& [name, spelling] : here.new_names) {
        const auto like = [&, &spelling = spelling](const auto& other) { return are_like(spelling, other.second); };
        if (!there.has.contains(name) && std::none_of(there.new_names.begin(), there.new_names.end(), like)) ++lone;
    }
    return 4 * lone <= here.new_names.size();
}

/// How many names that stood there before came more often than the other side has them, and how many went although it
/// has them as often.
size_t names_astray(const SideEdit& edit, const SideEdit& other) {
    size_t out = 0;
    const auto add = [&](const std::string& word) {
        if (!is_word_token(word)) return;
        const size_t was = times_in(edit.had, word), is = times_in(edit.has, word), there = times_in(other.has, word);
        if (was > 0 && is > std::max(was, there)) out += is - std::max(was, there);
        if (is < std::min(was, there)) out += std::min(was, there) - is;
    };
    std::set<std::string> words = edit.gained;
    words.insert(edit.lost.begin(), edit.lost.end());
    for (const std::string& word : words) add(word);
    return out;
}

/// True if nearly all new names have their like on the other side.
bool names_arrive(const SideEdit& edit, const SideEdit& other) {
    size_t lone = 0;
    for (const auto& [name, spelling] : edit.new_names) {
        const auto like = [&, &spelling = spelling](const std::string& word) {
            return is_word_token(word) && are_like(spelling, word);
        };
        if (!other.has.contains(name) && std::none_of(other.now.begin(), other.now.end(), like)) ++lone;
    }
    return 4 * lone <= edit.new_names.size();
}

/// The words that an edit brought, by their places in the text now.
std::vector<bool> places_gained(const SideEdit& edit) {
    std::vector<bool> out(edit.now.size());
    for (const DiffStep& step : diff(edit.before, edit.now))
        if (step.kind == DiffStep::Add) out[step.now] = true;
    return out;
}

/// True if an edit brought a number, an operator or a name of both sides to a place where the other side has another:
/// so a wrong port looks.
bool brings_wrong_word(const SideEdit& edit, const std::vector<size_t>& misplaced) {
    if (misplaced.empty()) return false;
    const std::vector<bool> gained = places_gained(edit);
    return std::any_of(misplaced.begin(), misplaced.end(), [&](size_t i) { return gained[i]; });
}

/// True if one of two functions may do with another argument, or with others beside it, what the other does.
bool may_stand_for(std::string_view a, std::string_view b) {
    if (is_one_of(b, {"clamp", "saturate"})) std::swap(a, b);
    if (is_one_of(a, {"clamp", "saturate"})) return is_one_of(b, {"clamp", "saturate", "min", "max"});
    const auto both_in = [&](std::initializer_list<std::string_view> list) {
        return is_one_of(a, list) && is_one_of(b, list);
    };
    return both_in({"sqrt", "inversesqrt", "length", "distance", "normalize", "dot", "hypot"}) ||
           both_in({"exp", "exp2", "exp10", "expm1", "pow", "cbrt", "sqrt"}) ||
           both_in({"log", "log2", "log10", "log1p"}) || both_in({"round", "rint", "floor"}) ||
           both_in({"fabs", "abs"}) || both_in({"mod", "fmod"});
}

/// True of two that do so only where the argument differs: `round ( x )` for `floor ( x + 0.5 )`, `dot ( v , v )` for
/// `length ( v )`.
bool needs_another_argument(std::string_view a, std::string_view b) {
    const auto is_limit = [](std::string_view name) { return is_one_of(name, {"clamp", "saturate", "min", "max"}); };
    const auto is_size = [](std::string_view name) { return is_one_of(name, {"fabs", "abs", "mod", "fmod"}); };
    return !is_limit(a) && !is_limit(b) && !is_size(a) && !is_size(b);
}

/// How two calls of functions of mathematics may differ in what they give.
enum class OtherCall : uint8_t { No, Perhaps, Yes };

/// Whether two calls of functions of mathematics give something else: `floor ( x )` beside `ceil ( x )`.
OtherCall call_other_mathematics(const Text& here, size_t i, const Text& there, size_t k, const Dialect& dialect) {
    const auto is_called = [](const Text& text, size_t at) {
        return at + 1 < text.size() && text[at + 1] == "(" &&
               (at == 0 || !is_one_of(text[at - 1], {".", "->"}));  // a method is of its class
    };
    if (!is_called(here, i) || !is_called(there, k)) return OtherCall::No;
    const PureCall a = pure_call(here[i], dialect), b = pure_call(there[k], dialect);
    if (!a.is_pure || !b.is_pure || a.name == b.name) return OtherCall::No;
    if (!may_stand_for(a.name, b.name)) return OtherCall::Yes;
    return needs_another_argument(a.name, b.name) ? OtherCall::Perhaps : OtherCall::No;
}

bool is_member(const Text& text, size_t i) {
    return i > 1 && is_one_of(text[i - 1], {".", "->"}) && (i + 1 == text.size() || text[i + 1] != "(");
}

/// The members of a name that a text has.
std::set<std::string_view> members_of(const Text& text, std::string_view name) {
    std::set<std::string_view> out;
    for (size_t i = 2; i < text.size(); ++i)
        if (text[i - 2] == name && is_member(text, i)) out.insert(text[i]);
    return out;
}

/// True if an edit brought a member where the other text has another, unlike one of the same name's, of which both
/// texts have a member in common; or a function that does the same of another argument only.
bool brings_other_member(const SideEdit& source, const SideEdit& target, const Distance& today,
                         const Dialect& dialect) {
    if (today.other_names.empty()) return false;
    const std::vector<bool> here = places_gained(source), there = places_gained(target);
    return std::any_of(today.other_names.begin(), today.other_names.end(), [&](const auto& each) {
        const auto [i, k] = each;
        if (!here[i] && !there[k]) return false;
        if (call_other_mathematics(source.now, i, target.now, k, dialect) == OtherCall::Perhaps) return true;
        if (!is_member(source.now, i) || !is_member(target.now, k)) return false;
        if (source.now[i - 2] != target.now[k - 2] || are_like(source.now[i], target.now[k])) return false;
        const auto a = members_of(source.now, source.now[i - 2]), b = members_of(target.now, target.now[k - 2]);
        return std::any_of(a.begin(), a.end(), [&](std::string_view member) { return b.contains(member); });
    });
}

/// True if an edit brought another function of mathematics than the other text calls there, or a member where the other
/// text has one that both had before. Such a name is wrong although the other text does not have it at all.
bool brings_wrong_name(const SideEdit& source, const SideEdit& target, const Distance& today, const Dialect& dialect) {
    if (today.other_names.empty()) return false;
    const std::vector<bool> here = places_gained(source), there = places_gained(target);
    const auto agreed = [&](const std::string& name) {
        return times_in(source.had, name) > 0 && times_in(target.had, name) > 0;
    };
    return std::any_of(today.other_names.begin(), today.other_names.end(), [&](const auto& each) {
        const auto [i, k] = each;
        if (!here[i] && !there[k]) return false;
        if (call_other_mathematics(source.now, i, target.now, k, dialect) == OtherCall::Yes) return true;
        return is_member(source.now, i) && is_member(target.now, k) && (agreed(source.now[i]) || agreed(target.now[k]));
    });
}

/// True if a statement that words came into has one, new or not, where the other side has another.
bool rewrites_in_another_order(const SideEdit& edit, const Distance& today) {
    const std::vector<bool> gained = places_gained(edit);
    std::vector<bool> is_wrong(edit.now.size());
    for (const auto* places : {&today.misplaced.source, &today.crossed})
        for (const size_t i : *places) is_wrong[i] = edit.now[i] != "=";  // a call may write in its place
    bool any_gained = false, any_wrong = false;
    for (size_t i = 0; i < edit.now.size(); ++i) {
        any_gained = any_gained || gained[i];
        any_wrong = any_wrong || is_wrong[i];
        if (any_gained && any_wrong) return true;
        if (edit.now[i] == ";" || edit.now[i] == "{" || edit.now[i] == "}") any_gained = any_wrong = false;
    }
    return false;
}

/// Asked first, since laying texts side by side is dear: false if a number or an operator came more often than the
/// other side has it.
bool may_arrive(const SideEdit& edit, const SideEdit& other) {
    return std::all_of(edit.gained.begin(), edit.gained.end(), [&](const std::string& word) {
        const size_t is = times_in(edit.has, word);
        return is_word_token(word) || is <= times_in(edit.had, word) + times_in(other.has, word);
    });
}

}  // namespace

bool edits_in_own_words(const PairTexts& texts, const Dialect& dialect) {
    const size_t words =
        texts.source_before.size() + texts.source_now.size() + texts.target_before.size() + texts.target_now.size();
    if (words > kMostBeside || !jump_alike(texts)) return false;
    const SideEdit source(texts.source_before, texts.source_now, dialect),
        target(texts.target_before, texts.target_now, dialect);
    constexpr size_t kLeast = 6;  // words of each edit
    if (source.size < kLeast || target.size < kLeast || source.guarded != target.guarded) return false;
    if (!names_follow(source, target) || !names_follow(target, source)) return false;
    const Distance then(source.before, target.before, dialect), today(source.now, target.now, dialect);
    if (kTwins * then.unlike < words_of(source.had) + words_of(target.had)) return false;
    constexpr size_t kFree = 2, kShare = 8;  // words that may differ now, and one in so many of both edits
    if (today.unlike > then.unlike + kFree + (source.size + target.size) / kShare) return false;
    if (brings_wrong_word(source, today.misplaced.source) || brings_wrong_word(target, today.misplaced.target))
        return false;
    if (brings_wrong_name(source, target, today, dialect)) return false;
    const Way way{then, today};
    if (grouping_of_edits(texts, dialect) == Grouping::OtherBrackets) return false;
    return signs_follow(source, target, Side::Source, way) && signs_follow(target, source, Side::Target, way);
}

bool bring_other_members(const PairTexts& texts, const Dialect& dialect) {
    const SideEdit source(texts.source_before, texts.source_now, dialect),
        target(texts.target_before, texts.target_now, dialect);
    return brings_other_member(source, target, Distance(source.now, target.now, dialect), dialect);
}

bool one_takes_a_name(const PairTexts& texts, const Dialect& dialect) {
    const SideEdit source(texts.source_before, texts.source_now, dialect),
        target(texts.target_before, texts.target_now, dialect);
    const auto takes = [](const SideEdit& here, const SideEdit& there) {
        return std::any_of(here.lost.begin(), here.lost.end(), [&](const std::string& word) {
            return is_word_token(word) && times_in(here.has, word) < times_in(here.had, word) &&
                   times_in(there.had, word) > 0 && times_in(there.has, word) >= times_in(there.had, word);
        });
    };
    return takes(source, target) || takes(target, source);
}

bool are_twins(const Words& a, const Words& b, const Dialect& dialect) {
    if (a.size() + b.size() > kMostBeside) return true;
    const SideEdit here(a, a, dialect), there(b, b, dialect);
    return kTwins * Distance(here.now, there.now, dialect).unlike < words_of(here.has) + words_of(there.has);
}

Nearing draws_nearer(LaidEdit& laid) {
    if (!laid.can_be_laid()) return Nearing::No;
    const Dialect& dialect = laid.dialect();
    constexpr size_t kLeast = 4, kLeastTaken = 10;  // words of an edit, and of one that hardly brings any
    constexpr size_t kBrief = 2;                    // words that are no slip, if all that was edited has its like now
    const SideEdit& edit = laid.edit();
    const bool takes = edit.gained_words < kLeast;
    const bool is_brief = takes && edit.size < kLeastTaken && edit.gained_words >= kBrief;
    if ((edit.size < (takes ? kLeastTaken : kLeast) && !is_brief) || !edit.guarded.empty()) return Nearing::No;
    const SideEdit& other = laid.other();
    if (!may_arrive(edit, other) || !jumps_arrive(laid.texts())) return Nearing::No;
    const size_t astray = names_astray(edit, other);
    if (takes && astray > 0) return Nearing::No;
    const Distance then(laid.before(), dialect), today(edit.now, other.now, dialect);
    if (brings_wrong_name(edit, other, today, dialect)) return Nearing::No;
    const size_t nearer = then.unlike - std::min(then.unlike, today.unlike);
    const size_t thirds = is_brief ? 3 : astray == 0 && names_arrive(edit, other) ? 1 : 2;  // of what was edited
    if (3 * nearer < thirds * edit.size) return Nearing::No;
    const bool keeps_what_was_alike =
        std::includes(today.covered.begin(), today.covered.end(), then.covered.begin(), then.covered.end());
    if ((!keeps_what_was_alike && astray > 0) || !signs_arrive(edit, other, {then, today})) return Nearing::No;
    if (brings_other_member(edit, other, today, dialect)) return Nearing::WithOtherMembers;
    if (brings_part_of(other, edit)) return Nearing::InPart;
    const bool in_order =
        !rewrites_in_another_order(edit, today) && grouping_of_edit(laid.texts(), dialect) == Grouping::Alike;
    return in_order ? Nearing::Yes : Nearing::InAnotherOrder;
}

}  // namespace porttool
