// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/difftest.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

#include "porttool/difftest/assumed_macros.h"
#include "porttool/difftest/bounded_process.h"
#include "porttool/difftest/build.h"
#include "porttool/difftest/interrupt.h"
#include "porttool/difftest/lift.h"
#include "porttool/difftest/pair_outcome.h"
#include "porttool/difftest/side_text.h"
#include "porttool/difftest/stand_ins.h"
#include "porttool/difftest/subject.h"
#include "porttool/difftest/subject_text.h"
#include "porttool/difftest/temporary_folder.h"
#include "porttool/difftest/trial.h"
#include "porttool/scan/scan.h"
#include "porttool/text/fingerprint.h"
#include "porttool/text/parallel.h"

namespace porttool {
namespace {

/// How the reasons begin that say of a function that it does not live by its arguments alone.
constexpr std::array<std::string_view, 5> kImpure = {"a kernel", "a member function", "the start of a program",
                                                     "binding", "input and output"};

/// The units of one side by id.
class SideUnits {
public:
    SideUnits(const std::vector<ScannedFile>& files, const Definitions& definitions) {
        for (const ScannedFile& file : files)
            for (const Unit& unit : file.units)
                if (const Definition* one = definitions.of_unit(file, unit); one != nullptr)
                    by_id_.emplace(unit_id(file, unit), one);
    }
    const Definition* find(const std::string& id) const {
        const auto found = by_id_.find(id);
        return found == by_id_.end() ? nullptr : found->second;
    }

private:
    std::map<std::string, const Definition*> by_id_;
};

bool is_function(const Definition* one) {
    return one != nullptr && one->kind == Definition::Kind::Function && one->unit != nullptr;
}

/// What tells that a function is not pure counts for more than what a run lacks: a reader learns which pairs no tool
/// could run, whichever side says so.
const std::string& weightier_reason(const std::string& source, const std::string& target) {
    const auto says_impure = [](const std::string& reason) {
        return std::any_of(kImpure.begin(), kImpure.end(),
                           [&](std::string_view start) { return reason.starts_with(start); });
    };
    if (source.empty() || (says_impure(target) && !says_impure(source))) return target;
    return source;
}

void add_constants(const ScannedFile& file, TokenRange range, std::vector<double>& out) {
    for (uint32_t i = range.first; i < range.end; ++i) {
        if (file.lexed.tokens[i].kind != TokenKind::Number) continue;
        const double value = std::strtod(std::string(file.lexed.view(i)).c_str(), nullptr);
        if (std::find(out.begin(), out.end(), value) == out.end()) out.push_back(value);
    }
}

/// The numbers that stand in both functions and in what they call.
std::vector<double> constants_in(const Subject& source, const Subject& target) {
    std::vector<double> out;
    for (const Subject* side : {&source, &target}) add_constants(*side->function->file, side->function->tokens, out);
    for (const Subject* side : {&source, &target})
        for (const Piece& piece : side->closure.pieces)
            if (piece.definition->kind != Definition::Kind::Struct)
                add_constants(*piece.definition->file, piece.definition->tokens, out);
    return out;
}

/// Both sides of one pair on their way.
struct PairWork {
    BySide<const Definition*> unit{nullptr, nullptr};
    BySide<Subject> subject;
    BySide<BuiltSide> built;
    BySide<BuiltSide> wide;  ///< with doubles for floats, where that was needed
};

class Difftest {
public:
    Difftest(const Project& project, const std::vector<PairIds>& asked, const DifftestSettings& settings,
             const Disk& disk)
        : map_(project.map),
          settings_(settings),
          folder_(settings.keep),
          interrupt_([this] {
              end_processes();
              folder_.remove();
          }),
          target_root_(target_root(project)),
          build_{BuildDefines(project.root, disk, settings.defines),
                 BuildDefines(target_root_, disk, settings.defines)},
          source_(project.source, project.root, disk, project.map.shaders.preamble, build_.source),
          target_(project.target, target_root_, disk, {}, build_.target),
          units_{SideUnits(project.source, source_), SideUnits(project.target, target_)} {
        for (const auto* files : {&project.source, &project.target})
            for (const ScannedFile& file : *files) own_files_.insert(&file);
        workshop_.compiler = find_compiler();
        workshop_.folder = folder_.path();
        if (workshop_.compiler.empty())
            throw CannotDo("difftest builds functions and finds no compiler: install g++ or clang++");
        write_prelude(workshop_);
        for (const auto& [source, target] : asked) {
            DifftestPair pair;
            pair.source = source;
            pair.target = target;
            PairWork one;
            one.unit = {units_.source.find(source), units_.target.find(target)};
            pairs.push_back(std::move(pair));
            work_.push_back(std::move(one));
        }
    }

    std::vector<DifftestPair> pairs;

    /// Finds what stands in for what a run does not have, by all pairs of the map.
    void stand_in(const std::vector<PairIds>& all) {
        std::vector<BySide<const Definition*>> functions;
        for (const auto& [source, target] : all) {
            const Definition *ours = units_.source.find(source), *theirs = units_.target.find(target);
            if (is_function(ours) && is_function(theirs)) functions.push_back({ours, theirs});
        }
        stand_ins_ = stand_ins_of(functions, source_, target_);
    }

    void run() {
        for (size_t i = 0; i < pairs.size(); ++i) look_at(i);
        build();
        in_parallel_with<TrialMemory>(pairs.size(), true, [&](size_t i, TrialMemory& memory) {
            if (pairs[i].reason.empty()) compare(i, memory);
        });
        if (settings_.ulps > 0) compare_with_wide();
    }

    /// The files that the pairs which ran were made from.
    std::map<std::string, std::string> texts() const {
        std::map<std::string, std::string> out;
        const auto add = [&](const ScannedFile& file, Side side) {
            // What no glob names, as a header elsewhere or flags of a build, no one can hold against the tree.
            if (!own_files_.contains(&file)) return;
            const std::string path = side == Side::Source ? file.path : target_path(map_, file.path);
            if (out.contains(path)) return;
            Fingerprinter print;
            print.add(file.lexed.text);
            out.emplace(path, print.digits());
        };
        for (size_t i = 0; i < pairs.size(); ++i) {
            if (pairs[i].state == DifftestState::NotRun) continue;
            for (const Side side : kBothSides) {
                add(*work_[i].unit[side]->file, side);
                for (const Piece& piece : work_[i].subject[side].closure.pieces) add(*piece.definition->file, side);
            }
        }
        return out;
    }

    /// The files of a build that were refused, of both sides.
    std::vector<std::string> unread() const {
        std::set<std::string> out(build_.source.unread().begin(), build_.source.unread().end());
        out.insert(build_.target.unread().begin(), build_.target.unread().end());
        return {out.begin(), out.end()};
    }

private:
    const Definitions& definitions(Side side) const { return side == Side::Source ? source_ : target_; }

    void look_at(size_t i) {
        PairWork& work = work_[i];
        for (const Side side : kBothSides)
            if (!is_function(work.unit[side])) {
                pairs[i].reason = side == Side::Source ? "the source is no function" : "the target is no function";
                return;
            }
        for (const Side side : kBothSides)
            work.subject[side] =
                subject_of(*work.unit[side], definitions(side), stand_ins_[side], *work.unit[other(side)]);
        pairs[i].reason = weightier_reason(work.subject.source.reason, work.subject.target.reason);
        if (!pairs[i].reason.empty()) return;
        guess_alike(work);
        give_variables(work.subject);
        if (work.subject.source.stood_in != work.subject.target.stood_in)
            pairs[i].reason = "the sides read bindings by different helpers";
    }

    /// Where one side does not tell how long an array is, the other's is as long; what the other takes by reference is
    /// one value.
    static void guess_alike(PairWork& work) {
        auto &ours = work.subject.source.parameters, &theirs = work.subject.target.parameters;
        for (size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
            for (const auto& [one, other] : {std::pair(&ours[i], &theirs[i]), std::pair(&theirs[i], &ours[i])})
                if (one->is_pointer && one->is_guess && !other->is_pointer && other->is_reference) {
                    one->is_guess = false;
                    one->elements = 1;
                }
            if (!ours[i].is_pointer || !theirs[i].is_pointer) continue;
            if (!ours[i].is_guess && !theirs[i].is_guess) {
                // As far as the side looks that looks further.
                if (ours[i].bound.empty() && theirs[i].bound.empty())
                    ours[i].elements = theirs[i].elements = std::max(ours[i].elements, theirs[i].elements);
                continue;
            }
            for (SubjectParameter* one : {&ours[i], &theirs[i]}) {
                one->is_guess = true;
                one->elements = kGuessedElements;
            }
        }
    }

    /// What either side may write to of the variables that both have is compared afterwards.
    static void give_variables(BySide<Subject>& subject) {
        for (const Definition* ours : subject.source.variables)
            for (const Definition* theirs : subject.target.variables)
                if (ours->name == theirs->name && (may_write_to_variable(subject.source, ours->name) ||
                                                   may_write_to_variable(subject.target, ours->name)))
                    for (const Side side : kBothSides) subject[side].given.insert(ours->name);
    }

    /// The array whose length is a guess; "" for none.
    static std::string guessed(const PairWork& work) {
        for (const Side side : kBothSides)
            for (const SubjectParameter& parameter : work.subject[side].parameters)
                if (parameter.is_guess) return parameter.name;
        for (const Side side : kBothSides)
            if (!work.built[side].leaves.guess.empty()) return work.built[side].leaves.guess;
        return {};
    }

    ProgramPart part_of(size_t i, Side side, bool widens) const {
        const Subject& subject = work_[i].subject[side];
        return {number_of(i, side),
                subject_text(subject, number_of(i, side), definitions(side), stand_ins_[side],
                             words_of_side(work_[i].subject[other(side)].closure), widens),
                definitions(side).standard_headers(*work_[i].unit[side]->file, subject.closure.pieces)};
    }

    BuiltParts build_side(Side side) {
        std::vector<ProgramPart> parts;
        for (size_t i = 0; i < pairs.size(); ++i)
            if (pairs[i].reason.empty()) parts.push_back(part_of(i, side, false));
        BuiltParts built = build_parts(parts, workshop_, side == Side::Source ? "source" : "target");
        // Once more what misses something that only stands under a macro that nobody defines.
        parts.clear();
        for (size_t i = 0; i < pairs.size(); ++i) {
            const auto refused = built.refused.find(number_of(i, side));
            constexpr std::string_view kUnknown = "unknown helper ";
            if (refused == built.refused.end() || !refused->second.starts_with(kUnknown)) continue;
            Subject& subject = work_[i].subject[side];
            const size_t known = subject.assumed.size();
            subject.assumed.merge(
                assumed_for(refused->second.substr(kUnknown.size()), subject.closure, definitions(side)));
            if (subject.assumed.size() != known) parts.push_back(part_of(i, side, false));
        }
        BuiltParts again = build_parts(parts, workshop_, side == Side::Source ? "source_again" : "target_again");
        for (const auto& [number, program] : again.programs) built.refused.erase(number);
        built.programs.merge(again.programs);
        for (auto& [number, why] : again.refused) built.refused[number] = std::move(why);
        return built;
    }

    void build() {
        BySide<BuiltParts> built;
        in_parallel(2, true, [&](size_t which) {
            const Side side = kBothSides.at(which);
            built[side] = build_side(side);
        });
        std::map<std::string, std::map<int, Leaves>> listed;
        for (size_t i = 0; i < pairs.size(); ++i)
            for (const Side side : kBothSides) {
                if (!pairs[i].reason.empty()) break;
                const int number = number_of(i, side);
                const auto refused = built[side].refused.find(number);
                if (refused != built[side].refused.end()) {
                    pairs[i].reason = std::string(side == Side::Source ? "source: " : "target: ") + refused->second;
                    // What nobody else knows is its object's.
                    if (const std::string& owner = work_[i].unit[side]->owner;
                        !owner.empty() && refused->second.starts_with("unknown helper"))
                        pairs[i].reason = "a member function of " + owner;
                    break;
                }
                const std::string& program = built[side].programs[number];
                if (!listed.contains(program)) listed[program] = list(program);
                if (!listed[program].contains(number)) {
                    pairs[i].reason = "what it takes cannot be listed";
                    break;
                }
                work_[i].built[side] = {program, number, listed[program][number]};
                pairs[i].reason = work_[i].built[side].leaves.reason;
            }
    }

    /// Runs what differs once more beside both with doubles for floats, which tells rounding from a difference.
    void compare_with_wide() {
        std::vector<size_t> again;
        for (size_t i = 0; i < pairs.size(); ++i)
            if (pairs[i].state == DifftestState::Differs) again.push_back(i);
        if (again.empty()) return;
        in_parallel(2, true, [&](size_t which) { build_wide(kBothSides.at(which), again); });
        in_parallel_with<TrialMemory>(again.size(), true, [&](size_t at, TrialMemory& memory) {
            DifftestPair& pair = pairs[again[at]];
            const DifftestPair before = std::exchange(pair, DifftestPair());
            pair.source = before.source;
            pair.target = before.target;
            compare(again[at], memory);
            if (pair.state == DifftestState::NotRun) pair = before;
        });
    }

    void build_wide(Side side, const std::vector<size_t>& which) {
        std::vector<ProgramPart> parts;
        for (const size_t i : which) parts.push_back(part_of(i, side, true));
        const BuiltParts built = build_parts(parts, workshop_, side == Side::Source ? "wide_source" : "wide_target");
        std::map<std::string, std::map<int, Leaves>> listed;
        for (const size_t i : which) {
            const auto program = built.programs.find(number_of(i, side));
            if (program == built.programs.end()) continue;
            if (!listed.contains(program->second)) listed[program->second] = list(program->second);
            BuiltSide& wide = work_[i].wide[side];
            wide = {program->second, program->first, listed[program->second][program->first]};
            const Leaves& narrow = work_[i].built[side].leaves;
            if (!work_[i].built[side].calls.empty()) wide = lifted(wide, narrow).value_or(BuiltSide());
            if (wide.leaves.in.size() != narrow.in.size() || wide.leaves.out.size() != narrow.out.size()) wide = {};
        }
    }

    static int number_of(size_t pair, Side side) { return static_cast<int>(2 * pair) + (side == Side::Source ? 0 : 1); }

    std::map<int, Leaves> list(const std::string& program) const {
        ProcessLimits limits;
        limits.time = std::chrono::seconds(5);
        limits.output = 64 << 20;
        return read_leaves(run_process({program, "list"}, workshop_.folder, limits).output);
    }

    void compare(size_t i, TrialMemory& memory) {
        DifftestPair& pair = pairs[i];
        PairWork& work = work_[i];
        LeafMatch match = match_leaves(work.built.source.leaves, work.built.target.leaves);
        const std::string why_not = match.reason;
        if (!why_not.empty()) {
            LeafMatch used = match_used_leaves(work.built.source.leaves, work.built.target.leaves,
                                               {text_of_side(work.subject.source), text_of_side(work.subject.target)});
            if (used.reason.empty()) match = std::move(used);
        }
        if (!match.reason.empty() && lift(work))
            match = match_leaves(work.built.source.leaves, work.built.target.leaves);
        pair.reason = match.reason;
        if (!pair.reason.empty()) return;
        Trial trial(work.built.source, work.built.target, match, {settings_.ulps}, workshop_.folder, memory,
                    {work.wide.source.program.empty() ? nullptr : &work.wide.source,
                     work.wide.target.program.empty() ? nullptr : &work.wide.target});
        constexpr size_t kMostSlots = 20'000'000;
        const size_t width =
            std::max({size_t{1}, work.built.source.leaves.in.size(), work.built.target.leaves.in.size()});
        const size_t records = std::max<size_t>(1, std::min(settings_.inputs, kMostSlots / width));
        const std::vector<double> constants = constants_in(work.subject.source, work.subject.target);
        const std::string array = guessed(work);
        InputTable& table = memory.table;
        draw_inputs(trial.inputs(), constants, records, settings_.seed, array.empty() ? 0 : kGuessedCount, table);
        pair.reason = trial.run(table);
        if (trial.is_endless()) {
            constexpr int64_t kTame = 64;
            draw_inputs(trial.inputs(), constants, records, settings_.seed, kTame, table);
            pair.reason = trial.run(table);
        }
        if (!pair.reason.empty()) return;
        const size_t differing = tell_outcome(pair, trial, table, settings_.ulps);
        // That what one side alone takes is 0 on the other was a guess.
        if (differing > 0 && !match.lone.empty()) {
            pair = {pair.source, pair.target, DifftestState::NotRun, 0, "", {}, why_not};
            return;
        }
        if (pair.state != DifftestState::NotRun && pair.reason.empty() && !work.subject.source.stood_in.empty())
            pair.reason = "with one answer on both sides for what reads bindings";
        tell_assumed(pair, work.subject);
        tell_guessed_match(pair, match, trial, table);
        if (!array.empty()) tell_guess(pair, array, work.built, records);
        if (work.built.source.calls.empty() && work.built.target.calls.empty()) return;
        // That one does to components what the other does to numbers was a guess.
        if (2 * differing > pair.inputs) pair = {pair.source, pair.target, DifftestState::NotRun, 0, "", {}, why_not};
        if (pair.state != DifftestState::NotRun)
            pair.reason = "component by component" + (pair.reason.empty() ? "" : "; " + pair.reason);
    }

    /// Numbers that were paired by their order, and marks that one side alone keeps: those are drawn as 0, and as 1,
    /// where a difference may be what the mark is there for.
    static void tell_guessed_match(DifftestPair& pair, const LeafMatch& match, Trial& trial, const InputTable& table) {
        if (pair.state == DifftestState::NotRun) return;
        std::string guess;
        if (!match.ordered.empty()) guess = "with " + match.ordered + " paired by its order";
        if (!match.zeroed.empty()) {
            const std::optional<size_t> differing = trial.run_with_marks(table);
            guess += (guess.empty() ? "with " : ", ") + match.zeroed + " at 0";
            if (differing) guess += *differing == 0 ? " and at 1" : "; at 1 they differ";
        }
        if (!guess.empty()) pair.reason = guess + (pair.reason.empty() ? "" : "; " + pair.reason);
    }

    /// Makes a side for numbers one for the other's vectors. True where that is to be tried.
    static bool lift(PairWork& work) {
        for (const Side side : kBothSides) {
            std::optional<BuiltSide> wide = lifted(work.built[side], work.built[other(side)].leaves);
            if (!wide) continue;
            work.built[side] = *std::move(wide);
            return true;
        }
        return false;
    }

    /// Macros that no text defines and that a function stands under.
    static void tell_assumed(DifftestPair& pair, const BySide<Subject>& subject) {
        if (pair.state == DifftestState::NotRun) return;
        std::map<std::string, std::string> all = subject.source.assumed;
        all.insert(subject.target.assumed.begin(), subject.target.assumed.end());
        std::string names;
        for (const auto& [name, value] : all) names += (names.empty() ? "" : ", ") + name;
        if (!names.empty())
            pair.reason = "with " + names + " defined" + (pair.reason.empty() ? "" : "; " + pair.reason);
    }

    /// Where nearly no input stays within the arrays, nothing was tested.
    static void tell_guess(DifftestPair& pair, const std::string& array, const BySide<BuiltSide>& built,
                           size_t records) {
        constexpr size_t kFewest = 50;
        if (pair.inputs * kFewest < records)
            pair = {pair.source, pair.target, DifftestState::NotRun, 0, "", {}, "pointer of unknown length: " + array};
        else if (pair.state != DifftestState::NotRun)
            pair.reason =
                fmt::format("arrays of {}{} elements{}{}",
                            built.source.leaves.guess.empty() && built.target.leaves.guess.empty() ? "" : "at most ",
                            kGuessedElements, pair.reason.empty() ? "" : "; ", pair.reason);
    }

    const MapFile& map_;
    std::set<const ScannedFile*> own_files_;
    DifftestSettings settings_;
    TemporaryFolder folder_;
    CleanOnInterrupt interrupt_;
    Workshop workshop_;
    std::string target_root_;
    BySide<BuildDefines> build_;
    Definitions source_, target_;
    BySide<SideUnits> units_;
    BySide<StandIns> stand_ins_;
    std::vector<PairWork> work_;
};

}  // namespace

DifftestResult difftest(const Project& project, const std::vector<PairIds>& all, const std::vector<PairIds>& asked,
                        const DifftestSettings& settings, const Disk& disk) {
    Difftest run(project, asked, settings, disk);
    run.stand_in(all);
    run.run();
    return {run.pairs, run.texts(), run.unread()};
}

}  // namespace porttool
