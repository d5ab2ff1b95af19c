// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/one_sided_weight.h"

#include <fmt/format.h>

#include <algorithm>

#include "porttool/compare/asides.h"
#include "porttool/compare/common_ground.h"
#include "porttool/compare/computed_values.h"
#include "porttool/compare/lone_edit.h"
#include "porttool/compare/named_parts.h"
#include "porttool/compare/owed_edit.h"
#include "porttool/compare/own_fields.h"
#include "porttool/compare/own_words.h"
#include "porttool/compare/runtime_upkeep.h"
#include "porttool/compare/runtime_versions.h"
#include "porttool/compare/same_anyway.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/compare/switch_arms.h"
#include "porttool/compare/switch_cases.h"
#include "porttool/compare/unread_locals.h"
#include "porttool/judge/same_edit_beside.h"
#include "porttool/judge/weaken.h"
#include "porttool/language/hazards.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/prelude.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// What a person would change by mistake.
bool is_of_few_words(const Words& before, const Words& now) {
    constexpr size_t kFew = 4;
    return words_edited(before, now) < kFew;
}

/// True if an edit only took words away.
bool only_takes(const Words& before, const Words& now) {
    const std::vector<DiffStep> steps = diff(before, now);
    return std::none_of(steps.begin(), steps.end(), [](const DiffStep& step) { return step.kind == DiffStep::Add; });
}

/// True if only quoted texts came and went.
bool only_rewords_texts(const Words& before, const Words& now) {
    const std::vector<DiffStep> steps = diff(before, now);
    return std::all_of(steps.begin(), steps.end(), [&](const DiffStep& step) {
        return step.kind == DiffStep::Keep ||
               (step.kind == DiffStep::Add ? now[step.now] : before[step.before]).starts_with('"');
    });
}

}  // namespace

std::set<std::string_view> OneSidedWeight::macros_of_another_build(const UnitState& unit, Side side,
                                                                   const Words& before) {
    const Words now = unit.text.words();
    std::set<std::string_view> macros = macros_of_added_branches(without_prelude(before), without_prelude(now));
    if (macros.empty() || !std::all_of(macros.begin(), macros.end(), [&](std::string_view macro) {
            return own_names_.is_asked_for_elsewhere(std::string(macro), side);
        }))
        return {};
    if (prelude_of(before) == prelude_of(now)) return macros;
    const FilesOfSide& files = (*facts_.files)[side];
    for (size_t i = 0; i < files.size(); ++i) {
        if (files.path(i) != unit.file) continue;
        const ScannedFile file = scan_text(unit.file, without_macros(files.scanned(i).lexed, macros));
        for (const Unit& built : file.units)
            if (unit_id(file, built) == unit.id) {
                const UnitState state = unit_state(file, built);
                if (prelude_of(state.text.words()) != prelude_of(before)) return {};
                return macros;
            }
    }
    return {};
}

/// True if both names of each call are most likely one function's: of a library, and as exact, or of the side itself,
/// where it bore the name from before. A function under a new name that only looks like the old one is another. A macro
/// is what it looks like where the other side's text says the function that it became.
bool OneSidedWeight::call_the_same(const std::vector<RespelledCall>& calls, Side side, const Words& there) {
    const auto was_called = [&](std::string_view name, const UnitState& unit) {
        return std::any_of(facts_.lock.baseline.begin(), facts_.lock.baseline.end(), [&](const LockedUnit& line) {
            return line.prints.renamed == unit.prints.renamed && bare_leaf_of(split_id(line.id).second) == name;
        });
    };
    const auto is_there = [&](std::string_view name) {
        return std::find(there.begin(), there.end(), name) != there.end();
    };
    return std::all_of(calls.begin(), calls.end(), [&](const RespelledCall& call) {
        if (call.of_macro && (!is_there(call.now) || is_there(call.before))) return false;
        const std::vector<const UnitState*>*was = own_names_.of(side, call.before), *is = own_names_.of(side, call.now);
        if (was != nullptr) return false;
        if (is != nullptr) return was_called(call.before, *is->front());
        const std::string before = std::string(call.before) + "()", now = std::string(call.now) + "()";
        return precision_hazards({before}, {now}).empty();
    });
}

/// Why the values of a function are sure to be what they were, or ""; the message says it.
std::string OneSidedWeight::say_same_anyway(const LoneTexts& texts, const Words& before, const UnitState& now,
                                            Language language) const {
    const auto asks_there = std::any_of(texts.other.begin(), texts.other.end(), tells_a_version);
    if (!asks_there && with_one_version_condition(texts.before) == with_one_version_condition(texts.now))
        return "it only asks for other versions of its compiler or runtime";
    const Words today = now.text.words();
    if (lone_edit(with_values_as_taken(before), with_values_as_taken(today), now.kind, language, dialect_, true)
            .means_nothing)
        return "it only casts to the type that takes the value, or hands a value over as a reference to a constant";
    return {};
}

/// What nothing seems to read is a note; a warning where a macro that no file of the side defines may read it.
void OneSidedWeight::weaken_unread(JudgedPair& pair, Side side, const LoneTexts& texts, Finding& finding,
                                   const std::string& why) {
    std::string macro = own_names_.macro_of_elsewhere(texts.now, side, dialect_);
    if (macro.empty()) macro = own_names_.macro_of_elsewhere(texts.before, side, dialect_);
    if (macro.empty()) return weaken(pair, finding, Level::Note, why);
    weaken(pair, finding, Level::Warning, why + ", unless " + macro + " does, which no file of its side defines");
}

/// An edit that most likely needs no port is a note, one of a word or two a warning.
void OneSidedWeight::weigh(JudgedPair& pair, Side side, const NormalText& before, Finding& finding) {
    const UnitState &now = *pair.unit[side], &there = *pair.unit[other(side)];
    const bool is_code = now.kind == UnitKind::Function || now.kind == UnitKind::Kernel;
    const bool structs = now.kind == UnitKind::Struct && there.kind == UnitKind::Struct;
    if (finding.level <= Level::Note || (!is_code && !structs)) return;
    const LoneTexts texts{without_prelude(before.words()), without_prelude(now.text.words()),
                          without_prelude(there.text.words())};
    LaidEdit laid(texts, dialect_);
    if (const auto names = only_qualified_names(texts.before, texts.now)) {
        if (std::all_of(names->begin(), names->end(),
                        [&](const RescopedName& name) { return own_names_.is_one_thing(name, now, side); }))
            weaken(pair, finding, Level::Note, "it only writes names with their scope, or without it");
        return;  // a name of something else
    }
    if (only_respells_members(texts.before, texts.now))
        return weaken(pair, finding, Level::Note, "it only reaches members through a pointer, or no longer does");
    if (const std::string swept = swept_names_.say(side, texts.before, texts.now); !swept.empty())
        return weaken(pair, finding, Level::Note, swept);
    finding.causes = swept_names_.causes(side, now.file, texts.before, texts.now);
    if (structs) {
        if (const auto base = only_changes_base(texts.before, texts.now); !base.empty() && !own_names_.of(side, base))
            return weaken(pair, finding, Level::Note, "it only derives from what is not of the project, or no longer");
        if (only_changes_fields_of_its_own(texts))
            weaken(pair, finding, Level::Note, "the two structs never had most of their fields in common");
        else
            doubt_unless_owed(pair, laid, "little of what it touches has its like on the other side", finding);
        return;
    }
    if (only_follows_runtime(texts.before, texts.now))
        return weaken(pair, finding, Level::Note, "it only calls a runtime as its later, or earlier, version wants");
    if (const auto calls = only_respelled_calls(texts.before, texts.now);
        calls && call_the_same(*calls, side, texts.other))
        return weaken(pair, finding, Level::Note, "it only calls the same by another spelling");
    if (without_asides(texts.before) == without_asides(texts.now))
        return weaken(pair, finding,
                      is_of_few_words(texts.before, texts.now) && !only_rewords_texts(texts.before, texts.now)
                          ? Level::Warning
                          : Level::Note,
                      "it only changes what is printed, checked or timed");
    const Language language = language_of_path(now.file);
    if (const std::string same = say_same_anyway(texts, before.words(), now, language); !same.empty())
        return weaken(pair, finding, Level::Note, same);
    const bool names_parts = only_names_parts(texts.before, texts.now, now.kind, language, dialect_);
    if ((names_parts || computes_as_before(before.words(), now.text.words(), dialect_, language)) &&
        !are_twins(texts.before, texts.other, dialect_))
        return weaken(pair, finding, Level::Note,
                      names_parts ? "it only names a part, or writes it out"
                                  : "it computes what it computed before, in other statements");
    if (only_concerns_unread_locals(texts.before, texts.now, dialect_) &&
        !own_names_.are_locals_in_macros(texts.before, side) && !own_names_.are_locals_in_macros(texts.now, side))
        return weaken_unread(pair, side, texts, finding, "it only brings or takes names that nothing reads");
    if (now.kind == UnitKind::Function && only_concerns_unread_parameters(texts.before, texts.now) &&
        !own_names_.are_locals_in_macros(texts.before, side) && !own_names_.are_locals_in_macros(texts.now, side) &&
        !are_twins(texts.before, texts.other, dialect_))
        return weaken_unread(pair, side, texts, finding, "it only brings or takes parameters that it never reads");
    // What the port holds before it is given anything is its own matter; the source may have mended a fault of both.
    const bool is_own_matter = !is_contract(facts_.map.reference, side);
    if (is_own_matter && only_gives_first_values(texts.before, texts.now))
        return weaken(pair, finding, Level::Note, "it only gives first values to names that had none");
    const std::string there_is = side == Side::Source ? "the port" : "the source";
    if (is_own_matter && only_waits_more(texts.before, texts.now))
        return weaken(pair, finding, Level::Note, "it only waits more often for its own device");
    if (!is_of_few_words(texts.before, texts.now) && !may_drive_device(texts.other) &&
        only_drives_device(texts.before, texts.now, is_own_matter))
        return weaken(pair, finding, Level::Note,
                      "it only waits, checks or keeps house for a device, which " + there_is + " does not drive");
    if (only_tends_foreign_runtime(texts.before, texts.now, texts.other))
        return weaken(pair, finding, Level::Note,
                      "it only keeps house with a runtime that " + there_is + " does not call");
    if (is_own_matter && only_concerns_own_runtime(laid))
        return weaken(pair, finding, Level::Note,
                      "it only changes how it drives a runtime that the source does not call");
    if (only_adds_labels_of_other(texts.before, texts.now, texts.other))
        return weaken(pair, finding, Level::Note, there_is + " has the label in that arm already");
    if (adds_labels_to_other_arms(texts.before, texts.now, texts.other)) return;
    if (const auto arms = arms_of_other(texts, dialect_); arms != ArmsOfOther::None) {
        if (arms != ArmsOfOther::Others)
            weaken(pair, finding, arms == ArmsOfOther::Same ? Level::Note : Level::Warning,
                   there_is + " has an arm for each of these labels");
        return;
    }
    if (const std::string beside = same_edit_beside(facts_, watched_, pair, side, before, dialect_); !beside.empty())
        return weaken(pair, finding, Level::Note, "the same edit came to " + beside + ", which no pair watches");
    if (const Nearing nearing = draws_nearer(laid); nearing != Nearing::No) {
        const bool in_order = nearing == Nearing::Yes;
        // What is gone draws any two texts nearer that the other says in words of its own.
        const bool is_slip = only_takes(texts.before, texts.now) && (words_edited(texts.before, texts.now) < kNoSlip ||
                                                                     !are_twins(texts.now, texts.other, dialect_));
        const std::string why =
            there_is + (in_order                               ? " has most of it"
                        : nearing == Nearing::WithOtherMembers ? " has most of it, with another member or function"
                        : nearing == Nearing::InPart           ? " has most of it, and says more of what it brings"
                                                               : " has its words, some in other places");
        if (in_order && !is_slip) return weaken(pair, finding, Level::Note, why);
        if (nearing == Nearing::InPart || !doubt_unless_owed(pair, laid, why, finding))
            weaken(pair, finding, Level::Warning, why);
        return;
    }
    weigh_ground(pair, side, laid, finding);
}

/// False, and nothing done, for an edit that the other side most likely owes. One of a few words is never told with
/// another.
bool OneSidedWeight::doubt_unless_owed(const JudgedPair& pair, LaidEdit& laid, const std::string& why,
                                       Finding& finding) {
    const OwedBy by{[&] { return own_names_.are_one(pair.unit); }, [&] { return words_of_ports_.are_their_own(); }};
    if (is_likely_owed(laid, by)) return false;
    if (is_of_few_words(laid.texts().before, laid.texts().now))
        weaken(pair, finding, Level::Warning, why);
    else
        doubt(pair, finding, why);
    return true;
}

/// What an edit has to do with the other side's text, where nothing else tells. What that has nothing like may be a
/// feature that it is owed as well as a matter of this side's own: it is in doubt, and a note only where a runtime is
/// kept house with.
void OneSidedWeight::weigh_ground(JudgedPair& pair, Side side, LaidEdit& laid, Finding& finding) {
    const std::string there = side == Side::Source ? "the port" : "the source";
    const OffGround off = off_common_ground(laid);
    if (off == OffGround::No) {
        doubt_unless_owed(pair, laid, "little of what it touches has its like in " + there, finding);
        return;
    }
    const bool is_upkeep = off >= OffGround::Perhaps && only_tends_runtime(laid.texts().before, laid.texts().now);
    pair.is_of_own_part = is_upkeep || off == OffGround::Surely ||
                          (off == OffGround::Perhaps && !is_contract(facts_.map.reference, side));
    if (is_upkeep)
        weaken(pair, finding, Level::Note,
               "it only keeps house with its runtime, where " + there + " has nothing like it");
    else
        doubt(pair, finding, there + " has nothing like what it changes");
}

}  // namespace porttool
