// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/added_clauses.h"

#include <algorithm>
#include <map>
#include <optional>

#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/bare_declaration.h"
#include "porttool/sync/device_wait.h"
#include "porttool/sync/operands.h"
#include "porttool/sync/port_manner.h"

namespace porttool {
namespace {

class ClauseAdder : EditReading {
public:
    ClauseAdder(const EditReading& reading, const InsertedUses& uses, Transplant& out)
        : EditReading(reading), uses_(uses), manner_(reading), out_(out) {}

    AddedSources run() {
        for (size_t c = 0; c < origin_.size();) {
            size_t end = c;
            while (end < origin_.size() && origin_[end] == kNothing) ++end;
            if (end > c) add_run(c, end);
            c = std::max(end, c + 1);
        }
        return std::move(sources_);
    }

private:
    /// Which neighbour new clauses go with, where the port has statements of its own between the two.
    enum class Beside : uint8_t { Either, Left, Right };
    struct NewClauses {
        size_t first, end;             ///< of the source's new text
        size_t was_before, was_after;  ///< their neighbours in its old one
        Beside beside = Beside::Either;
    };

    void add_run(size_t first, size_t end) {
        const size_t was_before = first == 0 ? kNothing : origin_[first - 1];
        const size_t was_after = end == origin_.size() ? kNothing : origin_[end];
        const size_t cut = end_of_paragraph(first, end);
        if (cut == end || !has_own_between(was_before, was_after)) return add({first, end, was_before, was_after});
        add({first, cut, was_before, was_after, Beside::Left});
        add({cut, end, was_before, was_after, Beside::Right});
    }

    /// Where the last empty line among new clauses parts them, if none stands around them; `end` for none.
    size_t end_of_paragraph(size_t first, size_t end) const {
        if (starts_paragraph(first) || starts_paragraph(end)) return end;
        for (size_t c = end - 1; c > first; --c)
            if (starts_paragraph(c) && now(c).inside == now(first).inside && !now(c).closes) return c;
        return end;
    }

    bool has_own_between(size_t was_before, size_t was_after) const {
        if (was_before == kNothing || was_after == kNothing) return false;
        const size_t left = counterpart(was_before), right = counterpart(was_after);
        if (left == kNothing || right == kNothing || right <= left) return false;
        for (size_t c = left + 1; c < right; ++c)
            if (!stands_for_something(c)) return true;
        return false;
    }

    void add(const NewClauses& run) {
        const auto [first, end, was_before, was_after, beside] = run;
        size_t left = was_before == kNothing ? kNothing : target_before(was_before);
        size_t right = was_after == kNothing ? kNothing : target_after(was_after);
        if (left != kNothing && right != kNothing && right <= left) {
            // A launch has its place, whatever else stands in another order.
            if (launch_ending(was_before) != nullptr)
                right = kNothing;
            else if (launch_beginning(was_after) != nullptr)
                left = kNothing;
        }
        const std::string what = shown(texts_.now.words, now(first).first, now(end - 1).end);
        auto [close, is_alike] =
            now(first).opens ? place_around(was_before, was_after) : place_beside(was_before, was_after);
        const auto give_up = [&](const std::string& why) {
            for (size_t c = was_before == kNothing ? 0 : was_before + 1; c < before_end(was_after); ++c)
                sources_.held.insert(c);
            out_.left.push_back({"the source gained `" + what + "`; " + why, now(first).first, close, 1, is_alike});
        };
        const size_t block = was_before == kNothing     ? Clause::kNone
                             : before(was_before).opens ? was_before
                                                        : before(was_before).inside;
        if (is_doubtful(block) || (was_before != kNothing && is_doubtful_directive(was_before)))
            return give_up("the port's condition there is another one");
        if (left == kNothing && right == kNothing) {
            is_alike = false;
            return give_up("the port has nothing that stands for its neighbours");
        }
        if (left != kNothing && right != kNothing && right <= left)
            return give_up("its neighbours stand in another order in the port");
        if (stands_by_directive_alone(was_before, was_after))
            return give_up("the port has something else behind that directive");
        std::vector<ClauseAdded> clauses = carried_clauses(first, end);
        drop_regrouped(clauses);
        if (clauses.empty()) return;
        if (was_before != kNothing && was_after != kNothing && depends_on_merged(first, end, was_before, was_after))
            return give_up("the port has one of its neighbours within another statement");
        // What the port has of its own between the two neighbours.
        std::vector<size_t> own;
        size_t from = left == kNothing ? own_start(right) : left + 1;
        const size_t to = right == kNothing ? own_end(left) : right;
        const bool beside_left =
            left != kNothing && (counterpart(was_before) == left || launch_ending(was_before) != nullptr);
        if (left != kNothing && take_wait(from, to, clauses)) {
            left = from++;
            if (clauses.empty()) return;
        }
        for (size_t c = from; c < to; ++c)
            if (!stands_for_something(c)) own.push_back(c);
        if (!own.empty() && drop_those_there(own, clauses)) {
            if (clauses.empty()) return;
            return give_up("the port has a part of it already");
        }
        std::optional<size_t> place = place_among(left, right, own, clauses, beside_left, run);
        if (!place) {
            if (const auto named = last_that_names(own, clauses)) close = *named, is_alike = true;
            return give_up("the port has statements of its own there, and which comes first matters");
        }
        if (!is_in_counterpart(block, *place)) return give_up("the block around it has no counterpart in the port");
        const bool is_before_launch = was_after != kNothing && launch_beginning(was_after) != nullptr &&
                                      right != kNothing && target(right).first == *place;
        const bool is_at_neighbour =
            ((beside_left && target(left).end == *place) || is_before_launch) && !names_data_around(*place, clauses);
        if (parts_neighbours(left, right, *place) &&
            !is_set_apart_for_data(*place, was_before, was_after, is_at_neighbour))
            return give_up(
                "the port has one of its neighbours in a block of its own, and whether it belongs there is not "
                "told");
        if (follows_own_directive(*place, was_before))
            return give_up("the port has a directive there, which would govern it");
        if (is_on_device(*place, was_before, was_after)) {
            if (is_of_host(clauses.front())) close = beside_launch_around(*place, left);
            return give_up("the port has one of its neighbours in what it hands to the device");
        }
        if (parts_from_last(first, *place))
            return give_up("what the source does between this and what it gained before has no counterpart there");
        if (clock_may_run_ahead(clauses, *place, was_before) && !wait_before_clock(clauses))
            return give_up("the port does not wait there for what it started");
        if (leaves_loop(first, end, *place))
            return give_up("the port has a loop of its own around it, which it would leave");
        std::vector<std::string> unknown;
        for (size_t c = first; c < end; ++c) {
            if (moved_from(c)) continue;
            CarriedWords carried = carry_new(now(c).first, now(c).end);
            if (!type_beside(c).empty()) std::erase(carried.unknown, texts_.now.words[now(c).first]);
            unknown.insert(unknown.end(), carried.unknown.begin(), carried.unknown.end());
        }
        for (const ClauseAdded& clause : clauses)
            if (const std::string name = indexed_otherwise(clause.words); !name.empty())
                return give_up("the port has `" + name + "` with other indices");
        if (!unknown.empty()) return give_up("nothing tells how the port says " + listed(unknown));
        for (const ClauseAdded& clause : clauses) {
            if (moved_from(clause.source)) continue;
            if (std::string why = uses_.doubt_before(clause.words, now(clause.source).end, *place); !why.empty())
                return give_up(why);
            if (std::string why = manner_.doubt(clause.words, clause.source); !why.empty()) return give_up(why);
        }
        for (size_t c = first; c < end; ++c)
            if (const auto source = moved_from(c)) sources_.moved.insert(*source);
        out_.added.push_back({*place, std::move(clauses)});
    }

    /// True where of both neighbours only a directive has its like in the port, which may ask for it of other things.
    bool stands_by_directive_alone(size_t was_before, size_t was_after) const {
        return was_before != kNothing && counterpart(was_before) != kNothing &&
               texts_.before.words[before(was_before).first] == "#" && was_after != kNothing &&
               counterpart(was_after) == kNothing;
    }

    /// A word of the target near where what comes between two clauses of the source's old text would stand.
    Nearby place_beside(size_t was_before, size_t was_after) const {
        if (was_before == kNothing) return {};
        if (const LaunchPair* launch = launch_ending(was_before)) return {target(launch->there.last).end - 1};
        if (counterpart(was_before) != kNothing) return {target(counterpart(was_before)).end - 1};
        if (was_after != kNothing && counterpart(was_after) != kNothing) return {target(counterpart(was_after)).first};
        return near(was_before);
    }

    /// The same of a block that comes around what follows it.
    Nearby place_around(size_t was_before, size_t was_after) const {
        const bool stands = was_after != kNothing && counterpart(was_after) != kNothing && !before(was_after).closes;
        return stands ? Nearby{target(counterpart(was_after)).first} : place_beside(was_before, was_after);
    }

    /// The last of the port's own clauses that shares a name with new ones: these come beside it, one way or the other.
    std::optional<size_t> last_that_names(const std::vector<size_t>& own,
                                          const std::vector<ClauseAdded>& clauses) const {
        const std::set<std::string> names = names_of(clauses);
        const bool ends_time = is_of_host(clauses.front());
        for (size_t k = own.size(); k-- > 0;)
            for (size_t i = target(own[k]).first; i < target(own[k]).end; ++i)
                if (names.contains(texts_.target.words[i]))
                    return target(ends_time ? behind_own_blocks(own, own[k]) : own[k]).first;
        return std::nullopt;
    }

    /// The end of the port's own blocks that a clause stands in, as a kernel with its launch: a wait, or a clock that
    /// is asked, comes behind these and not into them.
    size_t behind_own_blocks(const std::vector<size_t>& own, size_t c) const {
        for (size_t head = target(c).inside; std::binary_search(own.begin(), own.end(), head); head = target(c).inside)
            if (target(head).partner == Clause::kNone)
                return c;
            else
                c = target(head).partner;
        return c;
    }

    /// True for a wait for the device, and a clock that is asked: no device does these.
    bool is_of_host(const ClauseAdded& clause) const { return waits(clause.source) || asks_clock(clause); }

    /// Beside what is handed to the device around a place of the target: behind it what comes behind a launch.
    size_t beside_launch_around(size_t place, size_t left) const {
        for (const Launch& one : launches_in(texts_.target))
            if (target(one.first).end <= place && place <= target(one.last).first) {
                const bool is_behind = left != kNothing && one.first <= left && left <= one.last;
                return is_behind ? target(one.last).first : target(one.first).first;
            }
        return place;
    }

    std::set<std::string> names_of(const std::vector<ClauseAdded>& clauses) const {
        std::set<std::string> names;
        for (const ClauseAdded& clause : clauses)
            for (size_t i = 0; i < clause.words.size(); ++i)
                if (is_name(clause.words[i].text) && !is_scoped(clause.words, i)) names.insert(clause.words[i].text);
        return names;
    }

    /// The same but for those of a wait for the device: among what starts nothing there that may stand anywhere.
    std::set<std::string> names_beside(const std::vector<size_t>& own, std::vector<ClauseAdded> clauses) const {
        const std::vector<Launch> launches = launches_in(texts_.target);
        const bool starts_any = std::any_of(own.begin(), own.end(), [&](size_t c) {
            return std::any_of(launches.begin(), launches.end(), [&](const Launch& one) { return one.first == c; });
        });
        if (!starts_any) std::erase_if(clauses, [&](const ClauseAdded& clause) { return waits(clause.source); });
        return names_of(clauses);
    }

    /// The counterpart of the nearest clause at or before c that has one, within the block that c stands in.
    size_t target_before(size_t c) const {
        for (;;) {
            if (const LaunchPair* launch = launch_ending(c)) return launch->there.last;
            if (counterpart(c) != kNothing) return counterpart(c);
            if (before(c).opens || c == 0) return kNothing;
            const size_t from = before(c).closes && before(c).partner != Clause::kNone ? before(c).partner : c;
            if (from == 0) return kNothing;
            c = from - 1;
        }
    }

    size_t target_after(size_t c) const {
        for (;;) {
            if (const LaunchPair* launch = launch_beginning(c)) return launch->there.first;
            if (counterpart(c) != kNothing) return counterpart(c);
            if (before(c).closes) return kNothing;
            const size_t from = before(c).opens && before(c).partner != Clause::kNone ? before(c).partner : c;
            if (from + 1 >= texts_.before.clauses.size()) return kNothing;
            c = from + 1;
        }
    }

    /// A launch that the port writes otherwise, and that ends, or begins, with a clause of the source's old text.
    const LaunchPair* launch_ending(size_t c) const {
        return launch_where([c](const LaunchPair& launch) { return launch.here.last == c; });
    }
    const LaunchPair* launch_beginning(size_t c) const {
        return launch_where([c](const LaunchPair& launch) { return launch.here.first == c; });
    }
    template <class Holds>
    const LaunchPair* launch_where(const Holds& holds) const {
        const auto found = std::find_if(texts_.launches.begin(), texts_.launches.end(), holds);
        return found == texts_.launches.end() ? nullptr : &*found;
    }

    /// True if the nearest block around a place that stands for one of the source's stands for `block`.
    bool is_in_counterpart(size_t block, size_t place) const {
        while (block != Clause::kNone && counterpart(block) == kNothing &&
               only_holds_data(texts_.before, before(block)))
            block = before(block).inside;
        size_t there = block_at(place);
        while (there != Clause::kNone && !stands_for_something(there)) there = target(there).inside;
        // Blocks of the source that came with the edit, or that the port never had, are passed over as well.
        return block == Clause::kNone ? there == Clause::kNone : counterpart(block) == there && there != Clause::kNone;
    }

    /// True for a place in a block that the port alone has, as a lambda around a kernel, where one of the two
    /// statements that the new ones stand between is outside of it.
    bool parts_neighbours(size_t left, size_t right, size_t place) const {
        const auto is_outside = [&](size_t c, size_t head) {
            const bool is_statement = c != kNothing && !target(c).opens && !target(c).closes;
            return is_statement && (c < head || target(head).partner == Clause::kNone || c > target(head).partner);
        };
        for (size_t c = block_at(place); c != Clause::kNone && !stands_for_something(c); c = target(c).inside)
            if (is_outside(left, c) || is_outside(right, c)) return true;
        return false;
    }

    /// True for a place right behind a `#pragma` of the port that stands for no directive of the source, and governs
    /// what follows.
    bool follows_own_directive(size_t place, size_t was_before) const {
        for (size_t c = 0; c < texts_.target.clauses.size() && target(c).first < place; ++c)
            if (target(c).end == place && target(c).size() > 1 && texts_.target.words[target(c).first] == "#" &&
                texts_.target.words[target(c).first + 1] == "pragma" && !stands_alone(texts_.target, target(c)))
                return was_before == kNothing || texts_.before.words[before(was_before).first] != "#";
        return false;
    }

    /// True for a directive of OpenMP that is a statement of its own, as `# pragma omp target update to ( a )`.
    static bool stands_alone(const AlignedText& text, const Clause& directive) {
        const auto word = [&](size_t i) {
            return directive.first + i < directive.end ? std::string_view(text.words[directive.first + i])
                                                       : std::string_view();
        };
        if (word(2) != "omp") return false;
        return is_one_of(word(3), {"barrier", "taskwait", "taskyield", "flush"}) ||
               (word(3) == "target" && is_one_of(word(4), {"update", "enter", "exit"}));
    }

    /// True for a place beside the counterpart of a direct neighbour, in a block of the port's own that only says where
    /// data is: `{`, or `# pragma omp target data {`. `is_at_neighbour`: beside what stands for one in another way.
    bool is_set_apart_for_data(size_t place, size_t was_before, size_t was_after, bool is_at_neighbour) const {
        const size_t before_it = was_before == kNothing ? kNothing : counterpart(was_before);
        const size_t after_it = was_after == kNothing ? kNothing : counterpart(was_after);
        const bool is_beside = is_at_neighbour || (before_it != kNothing && target(before_it).end == place) ||
                               (after_it != kNothing && target(after_it).first == place);
        if (!is_beside) return false;
        for (size_t c = block_at(place); c != Clause::kNone && !stands_for_something(c); c = target(c).inside)
            if (!only_holds_data(texts_.target, target(c))) return false;
        return true;
    }

    /// True if new clauses name what a block of the port's own around a place hands over or copies, so that it may not
    /// be there before that block ends: `sycl :: buffer < float > b ( a , n ) ;`, `map ( from : a [ 0 : n ] )`.
    bool names_data_around(size_t place, std::vector<ClauseAdded> clauses) const {
        std::erase_if(clauses, [&](const ClauseAdded& clause) { return waits(clause.source); });
        const std::set<std::string> names = names_of(clauses);
        for (size_t head = block_at(place); head != Clause::kNone && !stands_for_something(head);
             head = target(head).inside)
            for (size_t c = head; c < texts_.target.clauses.size() && target(c).first < place; ++c) {
                const bool is_own = !stands_for_something(c) && !target(c).opens && !target(c).closes;
                if (c != head && (!is_own || target(c).inside != head)) continue;
                for (size_t i = target(c).first; i < target(c).end; ++i)
                    if (names.contains(texts_.target.words[i])) return true;
            }
        return false;
    }

    static bool only_holds_data(const AlignedText& text, const Clause& head) {
        const auto word = [&](size_t i) {
            return head.first + i < head.end ? std::string_view(text.words[head.first + i]) : std::string_view();
        };
        const bool holds_data = word(0) == "#" && word(2) == "omp" && word(3) == "target" && word(4) == "data";
        return word(0) == "{" || holds_data;
    }

    /// The head of the block of the target that a place is in.
    size_t block_at(size_t place) const {
        size_t c = 0;
        while (c < texts_.target.clauses.size() && target(c).first < place) ++c;
        if (c == texts_.target.clauses.size()) return Clause::kNone;
        return target(c).closes ? target(c).partner : target(c).inside;
    }

    /// True for a place in what the port hands to a device, where the source's is in nothing of that kind.
    bool is_on_device(size_t place, size_t was_before, size_t was_after) const {
        const std::vector<Launch> there = launches_in(texts_.target), here = launches_in(texts_.before);
        const bool is_in = std::any_of(there.begin(), there.end(), [&](const Launch& one) {
            return target(one.first).end <= place && place <= target(one.last).first && one.first != one.last;
        });
        const bool was_in = std::any_of(here.begin(), here.end(), [&](const Launch& one) {
            return (was_before != kNothing && one.first <= was_before && was_before < one.last) ||
                   (was_after != kNothing && one.first < was_after && was_after <= one.last);
        });
        return is_in && !was_in;
    }

    /// True if what came last goes to the same place, and the source calls something between the two for which the port
    /// has nothing: it may do that elsewhere, before one of them or after.
    bool parts_from_last(size_t first, size_t place) const {
        if (out_.added.empty() || out_.added.back().before != place || out_.added.back().clauses.empty()) return false;
        for (size_t c = out_.added.back().clauses.back().source + 1; c < first; ++c) {
            if (origin_[c] == kNothing || now(c).opens || now(c).closes || counterpart(origin_[c]) != kNothing)
                continue;
            for (size_t i = now(c).first; i + 1 < now(c).end; ++i)
                if (is_name(texts_.now.words[i]) && is_one_of(texts_.now.words[i + 1], {"(", "<"})) return true;
        }
        return false;
    }

    /// True for new clauses that ask a clock right behind a launch of the port which goes on before its work is done,
    /// where the source has no such launch.
    bool clock_may_run_ahead(const std::vector<ClauseAdded>& clauses, size_t place, size_t was_before) const {
        const bool waits_first = waits(clauses.front().source);
        if (waits_first || !goes_on_behind_launch(texts_.target, clause_ending(place))) return false;
        if (was_before != kNothing && goes_on_behind_launch(texts_.before, was_before)) return false;
        return std::any_of(clauses.begin(), clauses.end(),
                           [](const ClauseAdded& clause) { return asks_clock(clause); });
    }

    /// Has the port wait before new clauses ask a clock, in its own words; false where nothing tells these, or where
    /// what comes first may take time of its own.
    bool wait_before_clock(std::vector<ClauseAdded>& clauses) const {
        const DeviceWait& wait = translator_.wait_there();
        if (!wait || wait->empty() || !asks_clock(clauses.front())) return false;
        ClauseAdded one{{}, clauses.front().source, true};
        for (const std::string& word : *wait) one.words.push_back({word, CarriedWord::kNoSource});
        clauses.insert(clauses.begin(), std::move(one));
        return true;
    }

    size_t clause_ending(size_t place) const {
        for (size_t c = 0; c < texts_.target.clauses.size(); ++c)
            if (target(c).end == place) return c;
        return kNothing;
    }

    /// True if a clause ends a launch that nobody waits for, or a block that ends with one.
    static bool goes_on_behind_launch(const AlignedText& text, size_t clause) {
        if (clause == kNothing) return false;
        const std::vector<Launch> launches = launches_in(text);
        const auto ends = [&](size_t c) {
            return std::any_of(launches.begin(), launches.end(),
                               [&](const Launch& one) { return one.last == c && !one.waits; });
        };
        while (!ends(clause) && clause > 0 && text.clauses[clause].closes) --clause;
        return ends(clause);
    }

    static bool asks_clock(std::string_view function) {
        return is_one_of(function, {"now", "clock", "time", "clock_gettime", "gettimeofday", "get_time",
                                    "omp_get_wtime", "getTime"});
    }

    /// True if new clauses end what is around them, and that is a loop which the port alone has.
    bool leaves_loop(size_t first, size_t end, size_t place) const {
        bool leaves_unit = false, leaves_nearest = false;
        for (size_t i = now(first).first; i < now(end - 1).end; ++i) {
            leaves_unit |= texts_.now.words[i] == "return";
            leaves_nearest |= texts_.now.words[i] == "break" || texts_.now.words[i] == "continue";
        }
        if (!leaves_unit && !leaves_nearest) return false;
        bool is_nearest = true;
        for (size_t c = block_at(place); c != Clause::kNone; c = target(c).inside) {
            const std::string& head = texts_.target.words[target(c).first];
            if (!word_is(head, kLoopHead) && head != "do" && (head != "switch" || !is_nearest)) continue;
            if (!stands_for_something(c)) {
                if (is_nearest || leaves_unit || !holds_all_beside(c, first)) return true;
            }
            is_nearest = false;
        }
        return false;
    }

    /// True if a loop that the port alone has holds what the source has beside its own loop around the new clause
    /// `is`, as one over all threads does; a tile's does not.
    bool holds_all_beside(size_t loop, size_t is) const {
        size_t own = now(is).inside;
        while (own != Clause::kNone && !word_is(texts_.now.words[now(own).first], kLoopHead)) own = now(own).inside;
        if (own == Clause::kNone) return false;
        bool any = false;
        for (size_t c = 0; c < origin_.size(); ++c) {
            if (c == own || now(c).inside != now(own).inside || now(c).closes || origin_[c] == kNothing) continue;
            const size_t there = counterpart(origin_[c]);
            if (there == kNothing || there == 0) continue;
            size_t around = target(there).inside;
            while (around != Clause::kNone && around != loop) around = target(around).inside;
            if (around != loop) return false;
            any = true;
        }
        return any;
    }

    /// True if a neighbour without a counterpart, which the port may have within another statement, shares names that
    /// one of the two may write.
    bool depends_on_merged(size_t first, size_t end, size_t was_before, size_t was_after) const {
        std::map<std::string, bool> names;  // and whether the new clauses may write it
        for (size_t i = now(first).first; i < now(end - 1).end; ++i) {
            const std::string& word = texts_.now.words[i];
            const bool is_of_library = !uses_.is_local(i) && !translator_.is_declared(word);  // as `stderr`
            if (is_name(word) && !is_of_library) names[word] |= uses_.may_write_now(i);
        }
        const auto shares = [&](size_t c) {
            const Clause& clause = before(c);
            if (launch_ending(c) != nullptr || launch_beginning(c) != nullptr) return false;
            if (counterpart(c) != kNothing || clause.closes || clause.opens || texts_.edit.clause_of[c] == kNothing)
                return false;
            // What the source gives back the port may hand back through a reference.
            if (texts_.before.words[clause.first] == "return" && !only_result(texts_.target)) return false;
            for (size_t i = clause.first; i < clause.end; ++i) {
                const auto name = names.find(texts_.before.words[i]);
                if (name != names.end() && (name->second || uses_.may_write_before(i))) return true;
            }
            return false;
        };
        return shares(was_before) || shares(was_after);
    }

    size_t before_end(size_t was_after) const {
        return was_after == kNothing ? texts_.before.clauses.size() : was_after;
    }

    size_t own_start(size_t right) const {
        size_t c = right;
        while (c > 0 && !target(c - 1).opens && !stands_for_something(c - 1)) --c;
        return c;
    }

    size_t own_end(size_t left) const {
        size_t c = left + 1;
        while (c < texts_.target.clauses.size() && !target(c).closes && !stands_for_something(c)) ++c;
        return c;
    }

    /// A clause that went elsewhere with the same words: the target's words for it are known.
    std::optional<size_t> moved_from(size_t is) const {
        for (size_t c = 0; c < texts_.before.clauses.size(); ++c) {
            if (texts_.edit.clause_of[c] != kNothing || counterpart(c) == kNothing || before(c).closes) continue;
            if (before(c).size() != now(is).size() || before(c).size() < 4) continue;
            bool same = true;
            for (size_t k = 0; k < now(is).size() && same; ++k)
                same = texts_.before.exact[before(c).first + k] == texts_.now.exact[now(is).first + k];
            if (same) return c;
        }
        return std::nullopt;
    }

    std::vector<ClauseAdded> carried_clauses(size_t first, size_t end) const {
        std::vector<ClauseAdded> out;
        for (size_t c = first; c < end; ++c) {
            ClauseAdded one{{}, c};
            if (const auto from = moved_from(c)) {
                const Clause& there = target(counterpart(*from));
                const bool same = there.size() == now(c).size();
                for (size_t i = there.first; i < there.end; ++i) {
                    const size_t here = same ? now(c).first + (i - there.first) : CarriedWord::kNoSource;
                    const std::string& word = texts_.target.words[i];
                    const bool is_same_number = same && is_number_token(word) && word == texts_.now.words[here];
                    one.words.push_back({is_same_number ? written_(here) : translator_.written_there(word), here});
                }
            } else {
                one.words = carry_new(now(c).first, now(c).end).words;
                if (const std::string type = type_beside(c); !type.empty()) one.words.front().text = type;
            }
            out.push_back(std::move(one));
        }
        return out;
    }

    /// Drops what declares names together, or apart, that the source declared otherwise before, and to which the port
    /// gives a value where it declares them.
    void drop_regrouped(std::vector<ClauseAdded>& clauses) {
        const std::vector<std::string>& there = texts_.target.words;
        const auto is_declared_bare = [&](const std::string& name) {
            return std::any_of(texts_.target.clauses.begin(), texts_.target.clauses.end(), [&](const Clause& clause) {
                const auto one = bare_declaration(texts_.target, clause);
                return one && one->names.contains(name);
            });
        };
        const auto is_regrouped = [&](const ClauseAdded& clause) {
            const auto fresh = bare_declaration(texts_.now, now(clause.source));
            return fresh && declares_all(texts_.before, *fresh) &&
                   std::all_of(fresh->names.begin(), fresh->names.end(), [&](const std::string& name) {
                       return std::find(there.begin(), there.end(), name) != there.end() && !is_declared_bare(name);
                   });
        };
        if (std::erase_if(clauses, is_regrouped) > 0) ++out_.already;
    }

    /// The type of a new field `T n ;` where the port says the types of both its neighbours, which are `T` as well, in
    /// one way; "" for none.
    std::string type_beside(size_t is) const {
        const auto declares = [](const AlignedText& text, const Clause& clause) {
            return clause.size() == 3 && is_word_token(text.words[clause.first]) &&
                   is_name(text.words[clause.first + 1]) && text.words[clause.end - 1] == ";";
        };
        const auto is_like = [&](size_t c) {
            return declares(texts_.now, now(c)) && texts_.now.words[now(c).first] == texts_.now.words[now(is).first];
        };
        if (!is_like(is)) return {};
        size_t left = is, right = is;
        while (origin_[left] == kNothing && left > 0 && is_like(left)) --left;
        while (origin_[right] == kNothing && right + 1 < origin_.size() && is_like(right)) ++right;
        std::string out;
        for (const size_t c : {left, right}) {
            if (origin_[c] == kNothing || !is_like(c) || counterpart(origin_[c]) == kNothing) return {};
            const Clause& there = target(counterpart(origin_[c]));
            const bool is_said_so = declares(texts_.target, there) &&
                                    texts_.target.words[there.first + 1] == texts_.now.words[now(c).first + 1];
            if (!is_said_so || (!out.empty() && out != texts_.target.words[there.first])) return {};
            out = texts_.target.words[there.first];
        }
        return out;
    }

    /// Drops the wait for a device that new clauses begin with, where the port waits there itself; true if it does.
    bool take_wait(size_t from, size_t to, std::vector<ClauseAdded>& clauses) {
        if (from >= to || !waits(clauses.front().source) ||
            !says(target(from).first, target(from).end, clauses.front().words))
            return false;
        clauses.erase(clauses.begin());
        ++out_.already;
        return true;
    }

    bool waits(size_t is) const { return waits_for_device(texts_.now.words, now(is).first, now(is).end); }

    /// Drops clauses that stand among the target's own; true if any does.
    bool drop_those_there(const std::vector<size_t>& own, std::vector<ClauseAdded>& clauses) {
        const size_t all = clauses.size();
        size_t at = 0;
        std::erase_if(clauses, [&](const ClauseAdded& clause) {
            const std::string& head = texts_.now.words[now(clause.source).first];
            if (now(clause.source).closes || head == "break" || head == "continue") return false;
            for (size_t i = at; i < own.size(); ++i)
                if (says(target(own[i]).first, target(own[i]).end, clause.words)) {
                    at = i + 1;
                    return true;
                }
            return false;
        });
        if (clauses.size() < all &&
            std::all_of(clauses.begin(), clauses.end(), [&](const ClauseAdded& c) { return now(c.source).closes; }))
            clauses.clear();
        if (clauses.empty()) ++out_.already;
        return clauses.size() < all;
    }

    /// True for a statement of the port that waits for the device, and stands for none of the source's.
    bool is_own_wait(size_t there) const {
        const DeviceWait& wait = translator_.wait_there();
        const auto first = texts_.target.words.begin() + static_cast<std::ptrdiff_t>(target(there).first);
        return wait && wait->size() == target(there).size() && std::equal(wait->begin(), wait->end(), first);
    }

    /// True for a new statement that asks a clock.
    static bool asks_clock(const ClauseAdded& clause) {
        for (size_t i = 0; i + 1 < clause.words.size(); ++i)
            if (clause.words[i + 1].text == "(" && asks_clock(clause.words[i].text)) return true;
        return false;
    }

    /// True where the source asked a clock as often to begin with as to end before: what is asked twice is a time.
    bool is_asked_first(size_t is) const {
        size_t times = 0;
        for (size_t i = 0; i + 1 < now(is).first; ++i)
            times += texts_.now.words[i + 1] == "(" && asks_clock(texts_.now.words[i]) ? 1 : 0;
        return times % 2 == 0;
    }

    /// True if what a new clause declares is used in the block that a clause of the port begins in, as far as its uses
    /// have a place.
    bool is_used_within(const ClauseAdded& clause, size_t right) const {
        const size_t head = target(right).inside;
        if (head == Clause::kNone || stands_for_something(head)) return true;
        const auto equals = std::find_if(clause.words.begin(), clause.words.end(),
                                         [](const CarriedWord& word) { return word.text == "="; });
        if (equals == clause.words.begin() || equals == clause.words.end()) return false;
        const std::string& name = std::prev(equals)->text;
        size_t there = kNothing;  // what stands for the clause before a use
        for (size_t is = clause.source + 1; is < origin_.size(); ++is) {
            if (origin_[is] != kNothing)
                if (const size_t last = target_before(origin_[is]); last != kNothing) there = last;
            const bool uses = std::find(texts_.now.words.begin() + static_cast<std::ptrdiff_t>(now(is).first),
                                        texts_.now.words.begin() + static_cast<std::ptrdiff_t>(now(is).end),
                                        name) != texts_.now.words.begin() + static_cast<std::ptrdiff_t>(now(is).end);
            if (uses && (there == kNothing || there <= head || there >= target(head).partner)) return false;
        }
        return true;
    }

    bool starts_paragraph(size_t is) const {
        return is < texts_.now.clauses.size() && texts_.paragraphs.contains(now(is).first);
    }

    /// True for a part of `std :: chrono :: seconds`: two statements that have it need not touch the same things.
    static bool is_scoped(const std::vector<CarriedWord>& words, size_t i) {
        return (i > 0 && words[i - 1].text == "::") || (i + 1 < words.size() && words[i + 1].text == "::");
    }

    /// Before which word of the target new clauses go, between the counterparts of their neighbours; none if the order
    /// among the port's own clauses there matters.
    std::optional<size_t> place_among(size_t left, size_t right, const std::vector<size_t>& own,
                                      const std::vector<ClauseAdded>& clauses, bool beside_left,
                                      const NewClauses& run) const {
        const size_t was_before = run.was_before, was_after = run.was_after;
        if (own.empty()) return left != kNothing ? target(left).end : target(right).first;
        // What the port waits for right behind the left neighbour, that ends.
        const size_t first = clauses.front().source;
        if (beside_left && own[0] == left + 1 && !now(first).closes && !waits(first) && is_own_wait(own[0])) ++left;
        const bool behind_launch = was_before != kNothing && launch_ending(was_before) != nullptr;
        const bool before_launch = was_after != kNothing && launch_beginning(was_after) != nullptr;
        const bool beside_right = right != kNothing && (counterpart(was_after) == right || before_launch);
        if (!beside_left && !beside_right) return std::nullopt;
        // Behind a `return` of the port's own nothing would run.
        if (beside_left && own[0] == left + 1 && texts_.target.words[target(own[0]).first] == "return")
            return target(own[0]).first;
        const std::set<std::string> names = names_beside(own, clauses);
        for (const size_t c : own)
            for (size_t i = target(c).first; i < target(c).end; ++i)
                if (names.contains(texts_.target.words[i])) return std::nullopt;
        // An empty line before them sets them apart from their left neighbour: they go with the right one, as does what
        // a new block goes around: that begins with its right neighbour, and not with what the port has before that.
        const bool goes_around =
            now(clauses.back().source).opens &&
            std::none_of(own.begin(), own.end(), [&](size_t c) { return target(c).opens || target(c).closes; });
        const bool begins_paragraph =
            starts_paragraph(clauses.front().source) && !starts_paragraph(clauses.back().source + 1);
        // A clock that is asked first is asked right before what takes its time.
        const bool only_clock = std::all_of(clauses.begin(), clauses.end(), [&](const ClauseAdded& clause) {
            return asks_clock(clause) || waits(clause.source);
        });
        const bool starts_clock =
            was_before != kNothing && asks_clock(clauses.back()) &&
            (before(was_before).opens || (only_clock && beside_right && is_asked_first(clauses.back().source) &&
                                          is_used_within(clauses.back(), right)));
        // What the port prepares a launch by comes before what the source does right before it.
        const bool goes_right = run.beside == Beside::Right ||
                                (run.beside != Beside::Left && (goes_around || begins_paragraph ||
                                                                (before_launch && !behind_launch) || starts_clock));
        return beside_left && !(goes_right && beside_right) ? target(left).end : target(right).first;
    }

    const InsertedUses& uses_;
    PortManner manner_;
    Transplant& out_;
    AddedSources sources_;
};

}  // namespace

AddedSources carry_added_clauses(const EditReading& reading, const InsertedUses& uses, Transplant& out) {
    return ClauseAdder(reading, uses, out).run();
}

}  // namespace porttool
