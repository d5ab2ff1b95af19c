// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/pair_reading.h"

#include <algorithm>
#include <map>
#include <optional>

#include "porttool/audit/essence.h"
#include "porttool/audit/likeness.h"
#include "porttool/compare/meaning.h"
#include "porttool/language/language.h"
#include "porttool/language/words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/locals.h"
#include "porttool/normal/prelude.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

/// Today's statements of one side, in the vocabulary of both.
struct ReadSide {
    std::vector<WrittenStatement> written;
    std::vector<std::vector<std::string>> words;
    std::vector<WeighedWords> weighed;
};

constexpr float kFaint = 0.1f;  ///< of a place: below, it says nothing

struct Nearest {
    size_t index = 0;
    float distance = 0;
    bool any = false;
};

class PairReader {
public:
    PairReader(const BySide<SideOfPair>& pair, const Dialect& dialect) : pair_(pair), dialect_(dialect) {
        for (const Side side : kBothSides) languages_[side] = language_of_path(pair[side].unit->file);
    }

    PairReading run() {
        PairReading out;
        constexpr size_t kMostStatements = 300;  // of each side where nothing is known of the past
        const bool has_any_past = has_past(Side::Source) || has_past(Side::Target);
        for (const Side side : kBothSides)
            if (!has_any_past && pair_[side].lineage->today().size() > kMostStatements) return out;
        read_meaning();
        for (const Side side : kBothSides) {
            own_names_[side] = locals_of(side);
            read_side(side);
        }
        learn_parameters();
        learn_names();
        for (const Side side : kBothSides) {
            for (const auto& words : sides_[side].words) unit_words_[side].insert(words.begin(), words.end());
            read_past(side);
        }
        for (const Side side : kBothSides) find_new_locals(side);
        for (const Side side : kBothSides) find_held_values(side);
        out.alike = alike();
        if (has_any_past)
            for (const Side side : kBothSides) judge_side(side, out.missing);
        if (out.missing.empty()) out.differs = differences(out.alike);
        drop_what_the_other_undid(out.missing);
        return out;
    }

private:
    bool has_past(Side side) const {
        const UnitLineage& lineage = *pair_[side].lineage;
        return !lineage.removed().empty() ||
               std::any_of(lineage.statements().begin(), lineage.statements().end(), [](const StatementLineage& line) {
                   return std::any_of(line.steps.begin(), line.steps.end(),
                                      [](const LineageStep& step) { return step.counts; });
               });
    }

    /// The words of the past have a say in what names mean, too.
    void read_meaning() {
        for (const Side side : kBothSides) {
            const UnitLineage& lineage = *pair_[side].lineage;
            const auto add = [&](const WrittenStatement& statement) {
                for (std::string& word : words_of_statement(statement)) past_words_[side].push_back(std::move(word));
            };
            for (const StatementLineage& line : lineage.statements())
                for (const LineageStep& step : line.steps) add(step.before);
            for (const RemovedStatement& one : lineage.removed()) add(one.text);
            past_[side] = Words(past_words_[side].begin(), past_words_[side].end());
            now_[side] = without_prelude(pair_[side].unit->text.words());
        }
        meaning_.emplace(PairTexts{past_.source, now_.source, past_.target, now_.target}, dialect_, languages_);
    }

    std::vector<std::string> translated(const WrittenStatement& statement, Side side, bool in_body) const {
        const std::vector<std::string> owned = words_of_statement(statement);
        std::vector<std::string> out =
            essence_of(meaning_->translate(Words(owned.begin(), owned.end()), side, in_body), dialect_);
        for (std::string& word : out)
            if (const auto known = names_[side].find(word); known != names_[side].end()) word = known->second;
        return out;
    }

    void read_side(Side side) {
        ReadSide& out = sides_[side];
        out.written = pair_[side].lineage->today();
        for (size_t i = 0; i < out.written.size(); ++i) {
            out.words.push_back(translated(out.written[i], side, i > 0));
            out.weighed.push_back(weigher_.weighed(out.words.back()));
        }
    }

    void read_past(Side side) {
        const UnitLineage& lineage = *pair_[side].lineage;
        for (const StatementLineage& line : lineage.statements())
            for (const LineageStep& step : line.steps)
                if (!step.before.empty()) had_[side].insert(translated(step.before, side, true));
        for (const RemovedStatement& one : lineage.removed()) had_[side].insert(translated(one.text, side, true));
    }

    /// True if the other side once had what stands here today: then that side has gone on from it.
    bool other_had(Side side, size_t index) const { return had_[other(side)].contains(sides_[side].words[index]); }

    /// The names in the parentheses of a unit's head, as translated() has them.
    std::vector<std::string> parameters_of(Side side) const {
        const Words& words = now_[side];
        const std::vector<size_t> numbers = local_numbers(words);
        std::vector<std::string> out;
        for (size_t i = 0; i < numbers.size() && words[i] != "{"; ++i)
            if (numbers[i] != 0) out.push_back(folded(words[i]));
        return out;
    }

    void find_new_locals(Side side) {
        const std::vector<std::string> parameters = parameters_of(side);
        for (const std::string& name : own_names_[side])
            if (std::find(parameters.begin(), parameters.end(), name) == parameters.end() &&
                !unit_words_[other(side)].contains(name))
                new_locals_[side].insert(name);
    }

    /// What the locals hold that are set once, where they are declared, and the statements with those written out.
    void find_held_values(Side side) {
        const ReadSide& read = sides_[side];
        std::map<std::string, size_t> times;
        for (const auto& words : read.words)
            if (words.size() > 2 && words[1] == "=") ++times[words[0]];
        for (size_t i = 1; i < read.words.size(); ++i) {
            const auto& words = read.words[i];
            if (words.size() < 3 || words[1] != "=" || times[words[0]] != 1) continue;
            const bool declares = folded(words_of_statement(read.written[i]).front()) != words[0];
            if (declares) held_[side].emplace(words[0], std::vector<std::string>(words.begin() + 2, words.end()));
        }
        for (const auto& words : read.words) said_[side].insert(written_out(words, side));
    }

    /// A statement with the values of such locals in their place, without round brackets.
    std::vector<std::string> written_out(const std::vector<std::string>& words, Side side) const {
        constexpr size_t kMostWords = 256;
        constexpr int kDeep = 3;  // locals that hold what other locals hold
        std::vector<std::string> out = words;
        for (int turn = 0; turn < kDeep && !held_[side].empty(); ++turn) {
            std::vector<std::string> next;
            for (size_t i = 0; i < out.size(); ++i) {
                const bool set = i + 1 < out.size() && (out[i + 1] == "=" || out[i + 1] == "(");
                const bool member = i > 0 && out[i - 1] == ".";
                const auto known = set || member ? held_[side].end() : held_[side].find(out[i]);
                if (known == held_[side].end())
                    next.push_back(out[i]);
                else
                    next.insert(next.end(), known->second.begin(), known->second.end());
            }
            if (next == out || next.size() > kMostWords) break;
            out = std::move(next);
        }
        std::erase_if(out, [](const std::string& word) { return word == "(" || word == ")"; });
        return out;
    }

    /// Parameters stand for each other by their places where the sides are more alike so: `u0, u1` for `u1, u2`.
    void learn_parameters() {
        constexpr float kClearly = 0.1f;
        const std::vector<std::string> here = parameters_of(Side::Source), there = parameters_of(Side::Target);
        if (here.size() != there.size() || here == there) return;
        const float before = alike();
        for (size_t i = 0; i < here.size(); ++i) names_.target[there[i]] = here[i];
        sides_.target = {};
        read_side(Side::Target);
        if (alike() >= before + kClearly) return;
        names_.target.clear();
        sides_.target = {};
        read_side(Side::Target);
    }

    /// Names that one side has and the other does not, where they stand in statements that are otherwise one: the
    /// target's word becomes the source's.
    void learn_names() {
        constexpr size_t kMostPairs = 400'000;
        constexpr float kSameStatement = 0.7f;
        constexpr size_t kSure = 3;  // votes; one is enough for what both sides declare for themselves
        const ReadSide &source = sides_.source, &target = sides_.target;
        if (source.words.size() * target.words.size() > kMostPairs) return;
        std::set<std::string_view> in_source, in_target;
        for (const auto& words : source.words) in_source.insert(words.begin(), words.end());
        for (const auto& words : target.words) in_target.insert(words.begin(), words.end());
        const std::set<std::string>&own_source = own_names_.source, &own_target = own_names_.target;
        std::map<std::string, std::map<std::string, size_t>> votes;
        for (size_t i = 0; i < target.words.size(); ++i) {
            const Nearest near = nearest(target.weighed[i], source.weighed);
            if (!near.any) continue;
            const std::vector<std::string> left = value_of(source.words[near.index]), right = value_of(target.words[i]);
            if (left.size() != right.size()) continue;
            const float all = target.weighed[i].sum + source.weighed[near.index].sum;
            if (1 - near.distance / all < kSameStatement) continue;
            for (size_t k = 0; k < right.size(); ++k) {
                const std::string &there = right[k], &here = left[k];
                if (here != there && is_word_token(here) && is_word_token(there) && !in_source.contains(there) &&
                    !in_target.contains(here))
                    votes[there][here] += own_target.contains(there) && own_source.contains(here) ? kSure : 1;
            }
        }
        std::map<std::string, std::string> taken;
        for (const auto& [there, all] : votes) {
            const auto best = std::max_element(all.begin(), all.end(),
                                               [](const auto& a, const auto& b) { return a.second < b.second; });
            if (best->second >= kSure && taken.emplace(best->first, there).second) names_.target[there] = best->first;
        }
        if (names_.target.empty()) return;
        sides_.target = {};
        read_side(Side::Target);
    }

    /// The names of parameters and locals of a side's unit, as translated() has them.
    std::set<std::string> locals_of(Side side) const {
        const Words& words = now_[side];
        const std::vector<size_t> numbers = local_numbers(words);
        std::set<std::string> out;
        for (size_t i = 0; i < numbers.size(); ++i)
            if (numbers[i] != 0) out.insert(folded(words[i]));
        return out;
    }

    static Nearest nearest(const WeighedWords& one, const std::vector<WeighedWords>& among) {
        Nearest out;
        for (size_t i = 0; i < among.size(); ++i) {
            const float least = std::abs(one.sum - among[i].sum);
            if (out.any && least >= out.distance) continue;
            const float far = distance(one, among[i]);
            if (!out.any || far < out.distance) out = {i, far, true};
        }
        return out;
    }

    float alike() const {
        std::map<std::vector<uint32_t>, size_t> there;
        float all = 0, common = 0;
        for (const WeighedWords& one : sides_.target.weighed) ++there[one.words], all += one.sum;
        for (const WeighedWords& one : sides_.source.weighed) {
            all += one.sum;
            if (const auto found = there.find(one.words); found != there.end() && found->second > 0) {
                --found->second;
                common += 2 * one.sum;
            }
        }
        return all > 0 ? common / all : 0;
    }

    /// The statements that are not the same today, where they are few and the rest is.
    std::vector<MissingPlace> differences(float alike_now) const {
        constexpr float kNearTwins = 0.8f, kSameStatement = 0.7f;
        constexpr size_t kFew = 3;
        std::vector<MissingPlace> out;
        const ReadSide &source = sides_.source, &target = sides_.target;
        if (alike_now < kNearTwins && source.words.size() > 1) return out;
        for (size_t i = source.words.size() > 1 ? 1 : 0; i < source.words.size(); ++i) {
            const Nearest near = nearest(source.weighed[i], target.weighed);
            if (!near.any || near.distance <= 0 || says_nothing(source.written[i])) continue;
            if (1 - near.distance / (source.weighed[i].sum + target.weighed[near.index].sum) < kSameStatement) continue;
            const float substance = substance_of(target.words[near.index], source.words[i], known_there(Side::Source));
            if (substance < kSameStatement) continue;
            MissingPlace place;
            place.now = source.written[i];
            place.there = target.written[near.index];
            if (renames_what_it_declares(words_of_statement(place.there), words_of_statement(place.now))) continue;
            place.strength = substance;
            out.push_back(std::move(place));
        }
        if (out.size() > kFew) out.clear();
        return out;
    }

    void judge_side(Side side, std::vector<MissingEdit>& out) {
        std::map<uint32_t, MissingEdit> by_commit;
        const auto note = [&](uint32_t commit, MissingPlace place) {
            MissingEdit& edit = by_commit
                                    .try_emplace(commit, MissingEdit{side,
                                                                     commit,
                                                                     {},
                                                                     pair_[other(side)].lineage->edited_in(commit),
                                                                     pair_[other(side)].lineage->edited_since(commit),
                                                                     pair_[side].lineage->places_edited(commit)})
                                    .first->second;
            edit.places.push_back(std::move(place));
        };
        for (const StatementLineage& line : pair_[side].lineage->statements()) judge_line(side, line, note);
        for (const RemovedStatement& one : pair_[side].lineage->removed()) judge_removed(side, one, note);
        for (auto& [commit, edit] : by_commit) out.push_back(std::move(edit));
    }

    WeighedWords past_weighed(const WrittenStatement& statement, Side side, bool in_body) {
        return weigher_.weighed(translated(statement, side, in_body));
    }

    /// True if the statements of the own side say what that of the other says as often as the other side does: then it
    /// is the counterpart of one of those.
    bool is_explained(Side side, const WeighedWords& old_text, size_t there, float far, size_t own) const {
        const auto& others = sides_[other(side)].weighed;
        const auto& here = sides_[side].weighed;
        size_t there_count = 0, here_count = 0;
        for (const WeighedWords& one : others)
            if (std::abs(one.sum - old_text.sum) <= far && distance(old_text, one) <= far) ++there_count;
        for (size_t i = 0; i < here.size(); ++i)
            if (i != own && std::abs(here[i].sum - others[there].sum) <= far && distance(here[i], others[there]) <= far)
                ++here_count;
        return here_count >= there_count;
    }

    template <class Note>
    void judge_line(Side side, const StatementLineage& line, const Note& note) {
        if (line.steps.empty() || line.index == 0 || says_nothing(sides_[side].written[line.index])) return;
        const auto& others = sides_[other(side)].weighed;
        const WeighedWords& now = sides_[side].weighed[line.index];
        const Nearest of_now = nearest(now, others);
        if (!of_now.any || of_now.distance <= 0 || other_had(side, line.index)) return;
        const std::vector<std::string> whole = written_out(sides_[side].words[line.index], side);
        if (said_[other(side)].contains(whole)) return;
        size_t best = line.steps.size();
        Nearest found;
        WeighedWords old_text;
        for (size_t k = 0; k < line.steps.size(); ++k) {
            if (line.steps[k].before.empty()) continue;
            WeighedWords past = past_weighed(line.steps[k].before, side, line.index > 0);
            const Nearest near = nearest(past, others);
            if (near.any && near.distance < of_now.distance &&
                (best == line.steps.size() || near.distance < found.distance)) {
                best = k;
                found = near;
                old_text = std::move(past);
            }
        }
        if (best == line.steps.size()) {
            judge_added(side, line, of_now, note);
            return;
        }
        size_t told = best;  // the step that counts
        while (!line.steps[told].counts && told > 0) --told;
        if (!line.steps[told].counts) return;
        const float changed = distance(old_text, now);
        const WeighedWords& there = others[found.index];
        if (changed <= 0) return;
        const float leaning = (of_now.distance - found.distance) / changed;
        const float near = 1 - found.distance / (old_text.sum + there.sum);
        if (leaning < 0.5f || near < 0.55f || has_elsewhere(side, line.index)) return;
        if (is_explained(side, old_text, found.index, found.distance, line.index)) return;
        MissingPlace place;
        place.kind = MissingPlace::Kind::Replaced;
        place.before = line.steps[best].before;
        place.now = sides_[side].written[line.index];
        place.there = sides_[other(side)].written[found.index];
        const std::vector<std::string> was = translated(place.before, side, true);
        if (written_out(was, side) == whole) return;  // a value got a name
        constexpr float kWrittenOut = 0.5f;           // what a new local holds may stand there in other words
        float substance = substance_of(was, sides_[side].words[line.index], known_there(side));
        if (uses_new_local(side, sides_[side].words[line.index]))
            substance =
                std::max(substance, kWrittenOut * substance_of(written_out(was, side), whole, known_there(side)));
        place.strength = std::min(1.0f, (leaning - 0.3f) / 0.7f) * std::min(1.0f, (near - 0.3f) / 0.7f) *
                         told_by(old_text.sum) * substance * still_itself(likeness(old_text, now)) *
                         (same_head(side, place) ? 1.0f : 0.4f) * (brings_call(side, place) ? 0.5f : 1.0f) *
                         (counts_threads_otherwise(place) ? 0.2f : 1.0f) *
                         (turns_round(side, place, line.steps[told].commit) ? 0.1f : 1.0f) *
                         (says_what_is_gained(side, was, sides_[side].words[line.index]) ? 0.3f : 1.0f);
        if (place.strength < kFaint) return;
        place.strength *= anchored(was, sides_[side].words[line.index], sides_[other(side)].words[found.index]);
        if (place.strength < kFaint) return;
        place.constants_only = numbers_alone(place.before, place.now);
        note(line.steps[told].commit, std::move(place));
    }

    static bool says_nothing(const WrittenStatement& statement) {
        const std::vector<std::string> words = words_of_statement(statement);
        return is_aside(words) || is_bare_declaration(words) || is_head(words);
    }

    /// True for the head of the unit, whose name is `@` there, be it behind lines of attributes.
    static bool is_head(const std::vector<std::string>& words) {
        for (size_t i = 0; i + 1 < words.size() && words[i] != "="; ++i)
            if (words[i] == "@" && words[i + 1] == "(") return i > 0 && is_word_token(words[i - 1]);
        return false;
    }

    bool uses_new_local(Side side, const std::vector<std::string>& words) const {
        return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
            return held_[side].contains(word) && !unit_words_[other(side)].contains(word);
        });
    }

    /// Names that tell what a statement is about: no types, no words of a letter or two, nothing of the side's own.
    bool tells(Side side, const std::string& word) const {
        constexpr size_t kLeast = 4;
        return is_word_token(word) && word.size() >= kLeast && !is_type_word(word) && !word_is(word, kKeyword) &&
               !own_names_[side].contains(word);
    }

    /// True if the names that an edit brought are in use on the other side's unit, and on this side in such edits
    /// alone: then the other side has it in another statement.
    bool says_what_is_gained(Side side, const std::vector<std::string>& before,
                             const std::vector<std::string>& now) const {
        bool any = false;
        for (const std::string& word : now) {
            if (!tells(side, word) || std::find(before.begin(), before.end(), word) != before.end()) continue;
            any = true;
            if (!unit_words_[other(side)].contains(word)) return false;
            for (const auto& words : sides_[side].words)
                if (&words != &now && words != now && std::find(words.begin(), words.end(), word) != words.end())
                    return false;
        }
        return any;
    }

    /// How well the places of a change are known in the other side's statement: what went, and the words beside it,
    /// have to stand there. 1 for all, 0.3 for none.
    static float anchored(const std::vector<std::string>& before, const std::vector<std::string>& now,
                          const std::vector<std::string>& there) {
        std::vector<bool> stands(before.size(), false);
        for (const DiffStep& step : diff(before, there))
            if (step.kind == DiffStep::Keep) stands[step.before] = true;
        size_t asked = 0, known = 0;
        const auto ask = [&](size_t i) {
            ++asked;
            known += stands[i] ? 1 : 0;
        };
        const auto is_telling = [&](size_t i) { return is_word_token(before[i]) || is_number_token(before[i]); };
        const std::vector<DiffStep> steps = diff(before, now);
        for (size_t k = 0; k < steps.size(); ++k) {
            if (steps[k].kind == DiffStep::Keep) continue;
            if (steps[k].kind == DiffStep::Remove) ask(steps[k].before);
            const bool first = k == 0 || steps[k - 1].kind == DiffStep::Keep;
            const bool last = k + 1 == steps.size() || steps[k + 1].kind == DiffStep::Keep;
            const size_t at = steps[k].before + (steps[k].kind == DiffStep::Remove ? 1 : 0);
            size_t left = std::min(steps[k].before, before.size()), right = std::min(at, before.size());
            while (left > 0 && !is_telling(left - 1)) --left;
            while (right < before.size() && !is_telling(right)) ++right;
            if (first && left > 0) ask(left - 1);
            if (last && right < before.size()) ask(right);
        }
        return asked == 0 ? 1 : 0.3f + 0.7f * static_cast<float>(known) / static_cast<float>(asked);
    }

    /// What became something else altogether was not edited, but written anew: what stands elsewhere may say the same.
    static float still_itself(float alike) { return std::clamp((alike - 0.2f) / 0.4f, 0.2f, 1.0f); }

    /// What a statement begins with, without its declaration: the variable that it sets, the word that rules it.
    static std::string head_of(const std::vector<std::string>& words) { return words.empty() ? "" : words[0]; }

    bool same_head(Side side, const MissingPlace& place) const {
        return head_of(translated(place.before, side, true)) == head_of(translated(place.now, side, true));
    }

    /// True where a condition became its opposite among other edits: then the branches changed places.
    bool turns_round(Side side, const MissingPlace& place, uint32_t commit) const {
        return pair_[side].lineage->places_edited(commit) > 1 &&
               is_turned_round(words_of_statement(place.before), words_of_statement(place.now));
    }

    /// True where one side says how many groups of threads run, and the other how many threads.
    static bool counts_threads_otherwise(const MissingPlace& place) {
        const auto has = [](const WrittenStatement& statement, std::string_view name) {
            const std::vector<std::string> words = words_of_statement(statement);
            return std::find(words.begin(), words.end(), name) != words.end();
        };
        return has(place.now, "dim3") != has(place.there, "dim3") &&
               has(place.now, "range") != has(place.there, "range");
    }

    /// True where the edit calls a function of which the other side has never heard.
    bool brings_call(Side side, const MissingPlace& place) const {
        const std::vector<std::string> before = translated(place.before, side, true),
                                       now = translated(place.now, side, true);
        for (size_t i = 0; i + 1 < now.size(); ++i)
            if (now[i + 1] == "(" && is_word_token(now[i]) && !is_type_word(now[i]) &&
                !pair_[other(side)].uses->contains(now[i]) &&
                std::find(before.begin(), before.end(), now[i]) == before.end())
                return true;
        return false;
    }

    /// A statement of few words stands anywhere by chance.
    static float told_by(float weight) { return std::min(1.0f, weight / 5.0f); }

    static bool numbers_alone(const WrittenStatement& before, const WrittenStatement& now) {
        const std::vector<std::string> a = words_of_statement(before), b = words_of_statement(now);
        if (a.size() != b.size()) return false;
        for (size_t i = 0; i < a.size(); ++i)
            if (a[i] != b[i] && !(is_number_token(a[i]) && is_number_token(b[i]))) return false;
        return true;
    }

    KnownThere known_there(Side side) const {
        const SideOfPair& there = pair_[other(side)];
        return {&unit_words_[other(side)], there.file_words,  there.uses,
                pair_[side].uses,          &own_names_[side], &new_locals_[side]};
    }

    bool stands_in_file_of(Side side, const WrittenStatement& statement) const {
        const std::set<std::string>* there = pair_[side].elsewhere;
        return there != nullptr && there->contains(statement_key(statement, dialect_));
    }

    bool has_elsewhere(Side side, size_t index) const {
        return sides_[side].weighed[index].sum >= 3 && stands_in_file_of(other(side), sides_[side].written[index]);
    }

    /// A statement that a commit brought in, where the other side has none like it.
    template <class Note>
    void judge_added(Side side, const StatementLineage& line, const Nearest& of_now, const Note& note) {
        const LineageStep& born = line.steps.back();
        if (!born.before.empty() || is_bare_return(words_of_statement(sides_[side].written[line.index]))) return;
        const auto step =
            std::find_if(line.steps.rbegin(), line.steps.rend(), [](const auto& one) { return one.counts; });
        if (step == line.steps.rend()) return;
        const WeighedWords& now = sides_[side].weighed[line.index];
        const float there = 1 - of_now.distance / (now.sum + sides_[other(side)].weighed[of_now.index].sum);
        if (there > 0.6f || has_elsewhere(side, line.index) || has_in_shape(side, line.index) ||
            stands_alike_in_file(side, line.index))
            return;
        MissingPlace place;
        place.kind = MissingPlace::Kind::Added;
        place.now = sides_[side].written[line.index];
        if (only_brings(side, line.index) || only_guards(side, line.index)) return;
        place.strength = said_in_one(side, line.index) * 0.8f * std::min(1.0f, (1 - there) / 0.6f) *
                         known_names(side, line.index) * (0.35f + 0.65f * neighbours(side, line.index)) *
                         (is_label(side, line.index) ? 1.0f : told_by(now.sum)) * lacks_words(side, line.index) *
                         in_common_calls(side, line.index) * sets_new(side, line.index) *
                         (names_value(side, line.index) ? 0.5f : 1.0f);
        if (place.strength < kFaint) return;
        note(born.commit, std::move(place));
    }

    /// True for the declaration of a local that the other side does not have: what matters is where it is used, and
    /// there its value is written out.
    bool names_value(Side side, size_t index) const {
        const std::vector<std::string>& words = sides_[side].words[index];
        return words.size() > 2 && words[1] == "=" && held_[side].contains(words[0]) &&
               !unit_words_[other(side)].contains(words[0]);
    }

    /// A statement with all names alike, and what leads to a member left out: `if ( lid != best [ bid ] )` and
    /// `if ( threadIdx . x != best [ blockIdx . x ] )` have one shape.
    static std::string shape_of(const std::vector<std::string>& words) {
        std::string out;
        for (size_t i = 0; i < words.size(); ++i) {
            if (words[i] == ".") {
                ++i;
                continue;
            }
            const bool name = is_word_token(words[i]) && !word_is(words[i], kKeyword) && !is_type_word(words[i]);
            out += name ? "a" : words[i];
            out += ' ';
        }
        return out;
    }

    /// True if the other side has a statement of the same shape that says some of the same names and has no better
    /// counterpart on this side.
    bool has_in_shape(Side side, size_t index) const {
        const std::vector<std::string>& own = sides_[side].words[index];
        if (is_label(side, index) || own.size() < 6) return false;
        const std::string shape = shape_of(own);
        const ReadSide &here = sides_[side], &there = sides_[other(side)];
        for (size_t i = 1; i < there.words.size(); ++i) {
            const auto& words = there.words[i];
            if (words[0] != own[0] && !(is_word_token(words[0]) && is_word_token(own[0]))) continue;
            if (shape_of(words) != shape) continue;
            const bool shares = std::any_of(own.begin(), own.end(), [&](const std::string& word) {
                return word.size() >= 3 && is_word_token(word) && !word_is(word, kKeyword) && !is_type_word(word) &&
                       std::find(words.begin(), words.end(), word) != words.end();
            });
            if (!shares) continue;
            const float far = distance(there.weighed[i], here.weighed[index]);
            bool nearest_one = true;
            for (size_t k = 0; k < here.words.size() && nearest_one; ++k)
                nearest_one = here.words[k] == own || distance(there.weighed[i], here.weighed[k]) >= far ||
                              shape_of(here.words[k]) != shape;
            if (nearest_one) return true;
        }
        return false;
    }

    /// True if some other function of the other side's file says nearly the same: a port may be spread over several.
    bool stands_alike_in_file(Side side, size_t index) const {
        constexpr float kAlike = 0.85f;
        const auto* there = pair_[other(side)].file_statements;
        const std::vector<std::string>& own = sides_[side].words[index];
        if (there == nullptr || is_label(side, index) || sides_[side].weighed[index].sum < 3) return false;
        return std::any_of(there->begin(), there->end(), [&](const std::vector<std::string>& words) {
            if (words.empty() || words[0] != own[0] || words.size() > 2 * own.size() || own.size() > 2 * words.size())
                return false;
            return likeness_by_endings(own, words) >= kAlike;
        });
    }

    /// True for `if ( p )` with nothing but a local of the unit: whether it may be null is the side's own affair.
    bool only_guards(Side side, size_t index) const {
        const std::vector<std::string>& words = sides_[side].words[index];
        if (words.size() < 4 || words[0] != "if") return false;
        return std::all_of(words.begin() + 1, words.end(), [&](const std::string& word) {
            return word == "(" || word == ")" || word == "!" || own_names_[side].contains(word);
        });
    }

    /// Less than 1 where the other side sets the same variable as often: then it does so in another way.
    float sets_new(Side side, size_t index) const {
        constexpr float kSetThere = 0.3f;
        const auto is_set = [](const std::vector<std::string>& words) {
            return words.size() > 2 && is_word_token(words[0]) && words[1] == "=";
        };
        const std::vector<std::string>& own = sides_[side].words[index];
        if (!is_set(own)) return 1;
        const auto times = [&](Side where) {
            return std::count_if(sides_[where].words.begin(), sides_[where].words.end(),
                                 [&](const auto& words) { return is_set(words) && words[0] == own[0]; });
        };
        return times(other(side)) >= times(side) ? kSetThere : 1;
    }

    /// True for a label of a switch: few words, which say all.
    bool is_label(Side side, size_t index) const {
        const std::vector<std::string>& words = sides_[side].words[index];
        return words.size() > 2 && words[0] == "case";
    }

    /// Less than 1 for a statement that calls what its side uses throughout and the other nowhere: what such a call
    /// does, the other side says in its own way, or has not at all.
    float in_common_calls(Side side, size_t index) const {
        constexpr float kOwnManner = 0.5f;
        const KnownThere there = known_there(side);
        const std::vector<std::string>& words = sides_[side].words[index];
        for (size_t i = 0; i + 1 < words.size(); ++i)
            if (words[i + 1] == "(" && is_word_token(words[i]) && there.degree(words[i]) <= 0) return kOwnManner;
        return 1;
    }

    /// How well the other side's unit knows a statement's names.
    float known_names(Side side, size_t index) const {
        const KnownThere there = known_there(side);
        float names = 0, known = 0;
        for (const std::string& word : sides_[side].words[index]) {
            if (!is_word_token(word)) continue;
            ++names;
            known += there.degree(word);
        }
        return names == 0 ? 0.5f : known / names;
    }

    /// True for a statement that only names a value, be it in its side's own manner: `n = LOAD ( p . n [ i + 1 ] )`.
    bool only_brings(Side side, size_t index) const {
        const KnownThere there = known_there(side);
        size_t calls = 0;
        const std::vector<std::string> value = value_of(sides_[side].words[index]);
        int depth = 0;  // of brackets: what stands there says which one
        for (size_t i = 0; i < value.size(); ++i) {
            depth += value[i] == "[" ? 1 : value[i] == "]" ? -1 : 0;
            if (depth > 0) continue;
            const bool called = i + 1 < value.size() && value[i + 1] == "(";
            if (called && (!is_word_token(value[i]) || there.degree(value[i]) > 0)) return false;
            calls += called ? 1 : 0;
            const bool slight =
                value[i].size() == 1 && std::string_view("()[].,").find(value[i][0]) != std::string_view::npos;
            if (!slight && !is_word_token(value[i]) && !is_number_token(value[i])) return false;
        }
        return calls <= 1 && value.size() < sides_[side].words[index].size();
    }

    /// Less than 1 where a single statement of the other side has all names that tell what this one is about.
    float said_in_one(Side side, size_t index) const {
        constexpr float kSaid = 0.35f;
        constexpr size_t kShort = 3;
        const KnownThere there = known_there(side);
        std::vector<std::string> names;
        for (const std::string& word : sides_[side].words[index])
            if (is_word_token(word) && word.size() > kShort && !is_type_word(word) &&
                !own_names_[side].contains(word) && there.degree(word) > 0)
                names.push_back(word);
        if (names.size() < 2) return 1;  // one alone stands anywhere
        for (const auto& words : sides_[other(side)].words)
            if (std::all_of(names.begin(), names.end(), [&](const std::string& name) {
                    return std::find(words.begin(), words.end(), name) != words.end();
                }))
                return kSaid;
        return 1;
    }

    /// 1 where the other side's unit uses some word of a statement less often than this one; less where it uses each as
    /// often: then it may say the same in another way.
    float lacks_words(Side side, size_t index) const {
        constexpr float kSaidOtherwise = 0.4f, kNoWords = 0.7f;
        constexpr size_t kLeast = 3;
        constexpr size_t kTelling = 4;  // letters of a name that another ends with: `clamp`, `spectrumclamp`
        const auto is_in = [](const std::string& one, const std::string& word) {
            return one == word || (word.size() >= kTelling && one.ends_with(word)) ||
                   (one.size() >= kTelling && word.ends_with(one));
        };
        const auto count = [&](Side where, const std::string& word) {
            ptrdiff_t out = 0;
            for (const auto& words : sides_[where].words)
                out += std::count_if(words.begin(), words.end(), [&](const auto& one) { return is_in(one, word); });
            return out;
        };
        const KnownThere there = known_there(side);
        bool any = false;
        for (const std::string& word : sides_[side].words[index]) {
            const bool tells = is_number_token(word) || (is_word_token(word) && word.size() >= kLeast &&
                                                         !own_names_[side].contains(word) && there.degree(word) > 0);
            if (!tells || is_type_word(word)) continue;
            any = true;
            if (count(other(side), word) < count(side, word)) return 1;
        }
        return any ? kSaidOtherwise : kNoWords;
    }

    /// How well the statements around one are known to the other side, 0 to 1.
    float neighbours(Side side, size_t index) const {
        const auto& here = sides_[side].weighed;
        const auto& others = sides_[other(side)].weighed;
        float sum = 0;
        int count = 0;
        for (const int step : {-2, -1, 1, 2}) {
            const auto at = static_cast<ptrdiff_t>(index) + step;
            if (at < 0 || at >= static_cast<ptrdiff_t>(here.size())) continue;
            const WeighedWords& one = here[static_cast<size_t>(at)];
            const Nearest near = nearest(one, others);
            ++count;
            if (near.any) sum += std::max(0.0f, 1 - near.distance / (one.sum + others[near.index].sum));
        }
        return count == 0 ? 0 : sum / static_cast<float>(count);
    }

    /// A statement that a commit took away, and that the other side still has.
    template <class Note>
    void judge_removed(Side side, const RemovedStatement& one, const Note& note) {
        const auto& others = sides_[other(side)].weighed;
        if (says_nothing(one.text) || is_bare_return(words_of_statement(one.text))) return;
        const WeighedWords old_text = past_weighed(one.text, side, true);
        const Nearest near = nearest(old_text, others), own = nearest(old_text, sides_[side].weighed);
        if (!near.any || near.index == 0) return;
        if (own.any && likeness(old_text, sides_[side].weighed[own.index]) > 0.6f) return;  // it became that
        if (stands_in_file_of(side, one.text)) return;                                      // it moved there
        const float there = 1 - near.distance / (old_text.sum + others[near.index].sum);
        if (there < 0.85f || is_explained(side, old_text, near.index, near.distance, sides_[side].written.size()))
            return;
        MissingPlace place;
        place.kind = MissingPlace::Kind::Removed;
        place.before = one.text;
        place.there = sides_[other(side)].written[near.index];
        place.strength = 0.75f * there * told_by(old_text.sum) * (0.2f + 0.8f * neighbours(other(side), near.index));
        if (place.strength < kFaint) return;
        note(one.commit, std::move(place));
    }

    /// Where both sides were edited apart in one place, only the newer edit is the one to follow.
    static void drop_what_the_other_undid(std::vector<MissingEdit>& edits) {
        std::map<std::pair<std::string, std::string>, uint32_t> newest;  // by the statements of source and target
        const auto key = [](const MissingEdit& edit, const MissingPlace& place) {
            const bool source = edit.side == Side::Source;
            return std::pair(source ? place.now : place.there, source ? place.there : place.now);
        };
        for (const MissingEdit& edit : edits)
            for (const MissingPlace& place : edit.places) {
                if (place.now.empty() || place.there.empty()) continue;
                const auto known = newest.emplace(key(edit, place), edit.commit).first;
                known->second = std::min(known->second, edit.commit);  // the walk begins with the newest
            }
        for (MissingEdit& edit : edits)
            std::erase_if(edit.places, [&](const MissingPlace& place) {
                const auto known = newest.find(key(edit, place));
                return known != newest.end() && known->second < edit.commit;
            });
        std::erase_if(edits, [](const MissingEdit& edit) { return edit.places.empty(); });
    }

    const BySide<SideOfPair>& pair_;
    const Dialect& dialect_;
    BySide<Language> languages_ = {};
    BySide<std::vector<std::string>> past_words_;
    BySide<Words> past_, now_;
    std::optional<Meaning> meaning_;
    BySide<std::map<std::string, std::string>> names_;
    Weigher weigher_;
    BySide<ReadSide> sides_;
    BySide<std::set<std::string>> own_names_;   ///< parameters and locals
    BySide<std::set<std::string>> new_locals_;  ///< no parameters, and nothing that the other unit names, too
    BySide<std::map<std::string, std::vector<std::string>>> held_;  ///< what locals hold that are set once
    BySide<std::set<std::vector<std::string>>> said_;               ///< today's statements, as written_out() has them
    BySide<WordsOfSide> unit_words_;
    BySide<std::set<std::vector<std::string>>> had_;  ///< statements that a side had and has no more
};

}  // namespace

std::string statement_key(const WrittenStatement& statement, const Dialect& dialect) {
    std::string out;
    for (const std::string& word : words_of_statement(statement)) {
        const std::string common = common_word(word, dialect);
        if (!common.empty()) (out.empty() ? out : out += ' ') += common;
    }
    return out;
}

PairReading read_pair(const BySide<SideOfPair>& pair, const Dialect& dialect) {
    return PairReader(pair, dialect).run();
}

}  // namespace porttool
