// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/inserted_uses.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/operands.h"

namespace porttool {
namespace {

size_t find_words(const std::vector<std::string>& in, size_t first, size_t end, const std::vector<std::string>& what) {
    const auto begin = in.begin() + static_cast<std::ptrdiff_t>(first);
    const auto stop = in.begin() + static_cast<std::ptrdiff_t>(end);
    const auto found = std::search(begin, stop, what.begin(), what.end());
    return found == stop ? Alignment::kNone : static_cast<size_t>(found - in.begin());
}

}  // namespace

InsertedUses::InsertedUses(const EditReading& reading, bool is_method)
    : EditReading(reading),
      is_method_(is_method),
      before_(texts_.before, texts_.hands_back),
      now_(texts_.now, texts_.hands_back),
      there_(texts_.target, texts_.target_hands_back),
      values_(reading, before_, there_),
      was_(texts_.now.words.size(), kNothing) {
    for (size_t i = 0; i < texts_.before.words.size(); ++i)
        if (const size_t now = texts_.edit.word_of[i];
            now != kNothing && texts_.before.exact[i] == texts_.now.exact[now])
            was_[now] = i;
    for (size_t c = 0; c < texts_.before.clauses.size(); ++c)
        if (texts_.edit.clause_of[c] == kNothing && counterpart(c) != kNothing) going_.insert(counterpart(c));
    run_threads_apart();
}

/// What one side does in threads the other does in loops of its own.
void InsertedUses::run_threads_apart() {
    const auto asks_thread = [&](const AlignedText& text) {
        return std::any_of(text.words.begin(), text.words.end(),
                           [&](const std::string& word) { return translator_.is_of_thread(word); });
    };
    if (asks_thread(texts_.before))
        for (size_t c = 0; c < texts_.target.clauses.size(); ++c)
            if (there_.is_loop(c) && !stands_for_something(c)) there_.run_apart(c);
    if (!asks_thread(texts_.target)) return;
    for (size_t c = 0; c < texts_.before.clauses.size(); ++c)
        if (before_.is_loop(c) && counterpart(c) == kNothing) before_.run_apart(c);
    for (size_t c = 0; c < texts_.now.clauses.size(); ++c)
        if (now_.is_loop(c) && origin_[c] != kNothing && counterpart(origin_[c]) == kNothing) now_.run_apart(c);
}

bool InsertedUses::may_write(const LocalWrites& writes, const AlignedText& text, size_t word) {
    if (writes.local(word) == 0) return true;  // a function may do anything, as may what has a member
    const size_t clause = writes.clause_at(word);
    if (!writes.writes(clause, text.words[word], {}).empty()) return true;
    const std::string last = word > 0 ? text.words[word - 1] : std::string(),
                      next = word + 1 < text.words.size() ? text.words[word + 1] : std::string();
    const bool is_argument = is_one_of(last, {"(", ",", "&"}) && is_one_of(next, {")", ","});
    return is_argument || is_accessor(next) || next == "[";
}

std::string InsertedUses::doubt_within(const std::vector<CarriedWord>& words, size_t source_end,
                                       size_t target_word) const {
    return doubt({words, target_word, there_.place_of(target_word)}, source_end);
}

std::string InsertedUses::doubt_before(const std::vector<CarriedWord>& words, size_t source_end,
                                       size_t target_word) const {
    return doubt({words, target_word, there_.place_before(target_word)}, source_end);
}

std::string InsertedUses::doubt_of_step(size_t was) const {
    if (!before_.is_known() || !there_.is_known()) return {};
    const auto beginning = [](const LocalWrites& writes, const AlignedText& text, size_t word) {
        std::set<std::string> out;
        for (const size_t clause : writes.reaching(word))
            for (const VariableWrite& write : writes.writes(clause, text.words[word], writes.part(word).part))
                if (write.op == "=" && write.end == write.first + 1 && is_number_token(text.words[write.first]))
                    out.insert(number_value(text.words[write.first]));
        return out;
    };
    for (size_t i = before(was).first; i < before(was).end; ++i) {
        const size_t other = word_of(i);
        if (before_.local(i) == 0 || other == kNothing || there_.local(other) == 0) continue;
        const auto writes = before_.writes(was, texts_.before.words[i], before_.part(i).part);
        const bool steps = std::any_of(writes.begin(), writes.end(), [](const VariableWrite& write) {
            return write.op.size() > 1 && write.op.back() == '=';
        });
        const auto here = beginning(before_, texts_.before, i),
                   beginning_there = beginning(there_, texts_.target, other);
        if (steps && !here.empty() && !beginning_there.empty() && here != beginning_there)
            return "the port's `" + texts_.target.words[other] + "` begins with `" + *beginning_there.begin() +
                   "`, not `" + *here.begin() + "`";
    }
    return {};
}

std::string InsertedUses::doubt(const Insertion& in, size_t source_end) const {
    if (!before_.is_known() || !now_.is_known() || !there_.is_known()) return {};
    for (size_t i = 0; i < in.words.size();) {
        Saying saying{in.words[i].from, 0, i, i + 1};
        while (saying.said_end < in.words.size() && in.words[saying.said_end].from == CarriedWord::kNoSource)
            ++saying.said_end;
        i = saying.said_end;
        if (saying.first == CarriedWord::kNoSource) continue;
        saying.end = i < in.words.size() ? in.words[i].from : source_end;
        if (std::string why = doubt_of(saying, in); !why.empty()) return why;
    }
    return {};
}

std::string InsertedUses::doubt_of(const Saying& saying, const Insertion& in) const {
    if (stands_already(saying, in)) return {};
    std::vector<size_t> here, there;  // locals: words of the source's new text, carried words
    bool is_known_here = true;        // by the edit
    for (size_t i = saying.first; i < saying.end; ++i)
        if (now_.local(i) != 0) {
            here.push_back(i);
            is_known_here &= is_new(i);
        }
    for (size_t i = saying.said_first; i < saying.said_end; ++i) {
        if (!is_plain_name(in, i) || declares_itself(in, i)) continue;
        const size_t local = there_.local_at(in.target_word, in.words[i].text);
        if (local == 0) {
            if (is_known_here && !here.empty()) continue;
            if (std::string why = unknown_name(in, i, !here.empty()); !why.empty()) return why;
        } else {
            if (writes_constant(in, i, local)) return "the port declares `" + in.words[i].text + "` const";
            there.push_back(i);
        }
    }
    if (is_known_here && (!here.empty() || there.empty())) return {};
    if (here.size() == 1 && there.size() == 1 && saying.end == saying.first + 1 &&
        saying.said_end == saying.said_first + 1)
        return is_used_alike(in, here[0], there[0]) ? std::string() : other_value(in, here[0], there[0]);
    if (is_said_elsewhere(saying, in)) return {};
    std::vector<std::string> said;
    for (size_t i = saying.said_first; i < saying.said_end; ++i) said.push_back(in.words[i].text);
    return "nothing tells that `" + shown(said, 0, said.size()) + "` is `" +
           shown(texts_.now.words, saying.first, saying.end) + "` there";
}

bool InsertedUses::declares_itself(const Insertion& in, size_t i) const {
    const size_t from = in.words[i].from;
    if (from == CarriedWord::kNoSource || now_.local(from) == 0 || !is_new(from)) return false;
    const size_t declared = now_.declaration(now_.local(from));
    return std::any_of(in.words.begin(), in.words.end(),
                       [&](const CarriedWord& word) { return word.from == declared && word.text == in.words[i].text; });
}

bool InsertedUses::is_plain_name(const Insertion& in, size_t i) const {
    const std::string& word = in.words[i].text;
    if (!is_name(word) || word_is(word, kQualifier | kTypePart | kType)) return false;
    const bool is_first = i == 0 && in.place.is_within && in.target_word > 0;
    const std::string& last = i > 0 ? in.words[i - 1].text : is_first ? texts_.target.words[in.target_word - 1] : word;
    return !is_accessor(last) && (i + 1 >= in.words.size() || in.words[i + 1].text != "::");
}

std::string InsertedUses::unknown_name(const Insertion& in, size_t i, bool is_local_here) const {
    const std::string& name = in.words[i].text;
    if (translator_.brings(name) || translator_.stands_bare(name)) return {};
    if (is_method_ && translator_.is_in_file(name)) return {};
    for (size_t k = 0; k < texts_.target.words.size(); ++k)
        if (texts_.target.words[k] == name && there_.local(k) == 0 &&
            (k == 0 || !is_accessor(texts_.target.words[k - 1])))
            return {};
    if (!is_local_here && !translator_.is_only_local(name)) return {};
    return "the port has no `" + name + "` there";
}

bool InsertedUses::writes_constant(const Insertion& in, size_t i, size_t local) const {
    const auto word = [&](size_t at) { return at < in.words.size() ? in.words[at].text : std::string(); };
    size_t next = i + 1;
    while (word(next) == "[" || word(next) == "." || word(next) == "->") {
        if (word(next) != "[") {
            next += 2;
            continue;
        }
        for (int depth = 0; next < in.words.size(); ++next) {
            depth += word(next) == "[" ? 1 : word(next) == "]" ? -1 : 0;
            if (depth == 0) break;
        }
        ++next;
    }
    const bool steps = is_one_of(word(next), {"++", "--"}) || (i > 0 && is_one_of(word(i - 1), {"++", "--"}));
    const bool assigns = is_one_of(word(next), {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="});
    return (steps || assigns) && there_.is_constant(local, next > i + 1);
}

bool InsertedUses::stands_already(const Saying& saying, const Insertion& in) const {
    if (!in.place.is_within || in.place.clause >= texts_.target.clauses.size()) return false;
    for (size_t i = saying.first; i < saying.end; ++i)
        if (was_[i] == kNothing || (i > saying.first && was_[i] != was_[i - 1] + 1)) return false;
    if (saying.first == saying.end || counterpart(before_.clause_at(was_[saying.first])) != in.place.clause)
        return false;
    std::vector<std::string> said;
    for (size_t i = saying.said_first; i < saying.said_end; ++i) said.push_back(in.words[i].text);
    const Clause& clause = target(in.place.clause);
    return find_words(texts_.target.words, clause.first, clause.end, said) != kNothing;
}

bool InsertedUses::is_said_elsewhere(const Saying& saying, const Insertion& in) const {
    const auto words = texts_.now.words.begin();
    const std::vector<std::string> here(words + static_cast<std::ptrdiff_t>(saying.first),
                                        words + static_cast<std::ptrdiff_t>(saying.end));
    std::vector<std::string> said;
    for (size_t i = saying.said_first; i < saying.said_end; ++i) said.push_back(in.words[i].text);
    for (size_t c = 0; c < texts_.before.clauses.size(); ++c) {
        if (counterpart(c) == kNothing) continue;
        const Clause &was = before(c), &other = target(counterpart(c));
        const size_t first = find_words(texts_.before.words, was.first, was.end, here);
        const size_t there = find_words(texts_.target.words, other.first, other.end, said);
        if (first != kNothing && there != kNothing && reads_the_same(saying, in, first, there)) return true;
    }
    return false;
}

bool InsertedUses::is_used_alike(const Insertion& in, size_t here, size_t there) const {
    const std::string& name = texts_.now.words[here];
    if (in.words[there].text != name || is_overwritten(here)) return false;
    const LocalPart read = old_part(here), other = part_there(in, there, read.part);
    const Clauses reaching = reaching_now(here), reaching_there = there_.reaching(other, in.place);
    for (size_t i = before(0).end; i < texts_.before.words.size(); ++i) {
        if (texts_.before.words[i] != name || before_.local(i) != read.local) continue;
        const size_t c = before_.clause_at(i);
        if (c >= texts_.before.clauses.size() || !before_.writes(c, name, {}).empty() || !is_said_word_for_word(c))
            continue;
        const size_t k = target(counterpart(c)).first + (i - before(c).first);
        if (there_.local(k) == other.local && staying(before_.reaching(i)) == reaching &&
            there_.reaching(k) == reaching_there)
            return true;
    }
    return false;
}

bool InsertedUses::is_said_word_for_word(size_t c) const {
    constexpr size_t kShortest = 5;
    const auto [known, is_new] = said_.try_emplace(c, false);
    if (!is_new || counterpart(c) == kNothing || before(c).opens || before(c).size() < kShortest) return known->second;
    const Clause& said = target(counterpart(c));
    known->second = says(said.first, said.end, carry_old(before(c).first, before(c).end).words, true);
    return known->second;
}

bool InsertedUses::reads_the_same(const Saying& saying, const Insertion& in, size_t here, size_t there) const {
    for (size_t i = saying.first; i < saying.end; ++i) {
        const size_t old = here + (i - saying.first);
        if ((now_.local(i) == 0) != (before_.local(old) == 0)) return false;
        if (now_.local(i) != 0 && reaching_now(i) != staying(before_.reaching(old))) return false;
    }
    for (size_t i = saying.said_first; i < saying.said_end; ++i) {
        if (!is_plain_name(in, i)) continue;
        const size_t local = there_.local_at(in.target_word, in.words[i].text);
        const size_t place = there + (i - saying.said_first);
        if (local != there_.local(place)) return false;
        if (local != 0 && there_.reaching(part_there(in, i, {}), in.place) != there_.reaching(place)) return false;
    }
    return true;
}

bool InsertedUses::is_new(size_t now_word) const { return was_[now_.declaration(now_.local(now_word))] == kNothing; }

/// As the texts stand without the edit: new blocks and writes come to both sides. What the edit has the source read
/// besides, as where it puts an old write under a condition, has to be alike as well.
std::string InsertedUses::other_value(const Insertion& in, size_t here, size_t there) const {
    const LocalPart read = old_part(here), other = part_there(in, there, read.part);
    const SameValues::Names names{texts_.now.words[here], in.words[there].text, read.part, other.part};
    if (is_overwritten(here))
        return values_.difference_of_writes(names, staying(before_.writing(read)),
                                            staying_there(there_.writing(other)));
    const Clauses old = staying(before_.reaching(read, old_place(here)));
    const Clauses there_now = staying_there(there_.reaching(other, in.place));
    if (std::string why = values_.difference(names, old, there_now); !why.empty()) return why;
    for (const size_t clause : reaching_now(here))
        if (!old.contains(clause))
            if (std::string why = values_.difference_of(names, clause); !why.empty()) return why;
    return {};
}

/// True for a name that gets another value there, whatever it had.
bool InsertedUses::is_overwritten(size_t now_word) const {
    const size_t next = now_word + (now_.part(now_word).part.empty() ? 1 : 3);
    return next < texts_.now.words.size() && texts_.now.words[next] == "=";
}

LocalPart InsertedUses::old_part(size_t now_word) const {
    const size_t declared = was_[now_.declaration(now_.local(now_word))];
    return {declared == kNothing ? 0 : before_.local(declared), now_.part(now_word).part};
}

UsePlace InsertedUses::old_place(size_t now_word) const {
    const size_t clause = now_.clause_at(now_word);
    if (origin_[clause] != kNothing) return before_.place_of(before(origin_[clause]).first);
    for (size_t c = clause; c-- > 0;)
        if (origin_[c] != kNothing) return before_.place_behind(origin_[c]);
    return before_.place_behind(Clause::kNone);
}

InsertedUses::Clauses InsertedUses::reaching_now(size_t now_word) const {
    Clauses out;
    for (const size_t clause : now_.reaching(now_word))
        if (origin_[clause] != kNothing) out.insert(origin_[clause]);
    return out;
}

InsertedUses::Clauses InsertedUses::staying(Clauses before) const {
    std::erase_if(before, [&](size_t clause) { return texts_.edit.clause_of[clause] == kNothing; });
    return before;
}

InsertedUses::Clauses InsertedUses::staying_there(Clauses there) const {
    std::erase_if(there, [&](size_t clause) { return going_.contains(clause); });
    return there;
}

LocalPart InsertedUses::part_there(const Insertion& in, size_t i, const std::string& part) const {
    const size_t local = there_.local_at(in.target_word, in.words[i].text);
    if (i + 1 == in.words.size()) return {local, part};
    const bool picks = in.words[i + 1].text == "." || in.words[i + 1].text == "->";
    return {local, !picks ? std::string() : i + 2 < in.words.size() ? in.words[i + 2].text : part};
}

}  // namespace porttool
