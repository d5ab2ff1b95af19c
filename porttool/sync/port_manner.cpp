// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/port_manner.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/operands.h"

namespace porttool {
namespace {

bool is_called(const std::vector<std::string>& words, size_t i, size_t end) {
    return i + 1 < end && is_name(words[i]) && !word_is(words[i], kKeyword) && words[i + 1] == "(";
}

/// Where `X += value ;` has its operator; `end` for another statement. What `=` means depends on more than its value.
size_t step_in(const std::vector<std::string>& words, size_t first, size_t end) {
    int depth = 0;
    for (size_t i = first; i < end; ++i) {
        depth += is_one_of(words[i], {"(", "["}) ? 1 : is_one_of(words[i], {")", "]"}) ? -1 : 0;
        if (depth == 0 && is_one_of(words[i], {"+=", "-=", "*=", "/=", "&=", "|=", "^="})) return i;
    }
    return end;
}

}  // namespace

PortManner::PortManner(const EditReading& reading) : EditReading(reading) {
    for (size_t c = 1; c < texts_.before.clauses.size(); ++c)
        if (counterpart(c) != kNothing && counterpart(c) != 0) learn_arguments(before(c), target(counterpart(c)));
}

std::vector<PortManner::Call> PortManner::calls_in(const std::vector<std::string>& words, size_t first, size_t end) {
    std::vector<Call> out;
    for (size_t i = first; i < end; ++i) {
        if (!is_called(words, i, end)) continue;
        Call call{i, {{i + 2, i + 2}}};
        int depth = 1;
        size_t k = i + 2;
        for (; k < end && depth > 0; ++k) {
            depth += is_one_of(words[k], {"(", "["}) ? 1 : is_one_of(words[k], {")", "]"}) ? -1 : 0;
            if (depth == 1 && words[k] == ",") {
                call.arguments.back().end = k;
                call.arguments.push_back({k + 1, k + 1});
            }
        }
        call.arguments.back().end = k - 1;
        out.push_back(std::move(call));
    }
    return out;
}

/// What is called last in the value that a variable is declared with; "" where it is declared otherwise, or twice.
std::string PortManner::giver_of(const std::vector<std::string>& words, const std::string& name) {
    std::vector<size_t> declared;
    for (size_t i = 1; i + 1 < words.size(); ++i)
        if (words[i] == name && words[i + 1] == "=" && (is_word_token(words[i - 1]) || words[i - 1] == "*"))
            declared.push_back(i);
    if (declared.size() != 1) return {};
    std::string out;
    for (size_t i = declared[0]; i < words.size() && words[i] != ";"; ++i)
        if (is_called(words, i, words.size())) out = words[i];
    return out;
}

void PortManner::learn_arguments(const Clause& here, const Clause& there) {
    const std::vector<Call> said = calls_in(texts_.target.words, there.first, there.end);
    for (const Call& call : calls_in(texts_.before.words, here.first, here.end))
        for (const Call& other : said) {
            const std::string& name = texts_.target.words[other.name];
            if (name != texts_.before.words[call.name] || call.arguments.size() != other.arguments.size()) continue;
            for (size_t a = 0; a < call.arguments.size(); ++a) {
                const bool points = texts_.before.words[call.arguments[a].first] == "&";
                const bool hands_over = texts_.target.words[other.arguments[a].first] != "&";
                (points && hands_over ? pointed_to_ : pointers_)[name].insert(a);
            }
        }
}

std::string PortManner::doubt(const std::vector<CarriedWord>& words, size_t now_clause) const {
    for (std::string why :
         {foreign_element(words), doubt_of_calls({}, now(now_clause)), other_statement(words, now(now_clause))})
        if (!why.empty()) return why;
    return {};
}

bool PortManner::uses_elements_from(const std::string& giver) const {
    const std::vector<std::string>& words = texts_.target.words;
    for (size_t i = 0; i + 1 < words.size(); ++i)
        if (words[i + 1] == "[" && is_name(words[i]) && giver_of(words, words[i]) == giver) return true;
    return false;
}

/// Host code that asks another function for a pointer than the source does has it for what runs elsewhere, unless it
/// uses elements of one such itself.
std::string PortManner::foreign_element(const std::vector<CarriedWord>& words) const {
    if (!translator_.is_on_host()) return {};
    for (size_t i = 0; i + 1 < words.size(); ++i) {
        if (words[i + 1].text != "[" || words[i].from == CarriedWord::kNoSource || !is_name(words[i].text)) continue;
        const std::string there = giver_of(texts_.target.words, words[i].text),
                          here = giver_of(texts_.now.words, texts_.now.words[words[i].from]);
        if (there.empty() || here.empty() || here == there || uses_elements_from(there)) continue;
        return "the port uses no element of what `" + there + "` gives it";
    }
    return {};
}

std::string PortManner::doubt_of_calls(const Clause& was, const Clause& is) const {
    const std::vector<std::string>& words = texts_.now.words;
    const auto was_called = [&](const std::string& name) {
        for (size_t i = was.first; i < was.end; ++i)
            if (texts_.before.words[i] == name && is_called(texts_.before.words, i, was.end)) return true;
        return false;
    };
    for (const Call& call : calls_in(words, is.first, is.end)) {
        const std::string& name = words[call.name];
        const auto pointed = pointed_to_.find(name), pointers = pointers_.find(name);
        if (pointed == pointed_to_.end() || was_called(name)) continue;
        for (const size_t a : pointed->second) {
            const bool is_either = pointers != pointers_.end() && pointers->second.contains(a);
            if (!is_either && a < call.arguments.size() && words[call.arguments[a].first] != "&")
                return "the port's `" + name + "` takes no pointer there";
        }
    }
    return {};
}

std::string PortManner::other_statement(const std::vector<CarriedWord>& words, const Clause& clause) const {
    const std::vector<std::string>& is = texts_.now.words;
    const size_t at = step_in(is, clause.first, clause.end);
    const std::vector<std::string> said = texts_of(words);
    if (at == clause.end || step_in(said, 0, said.size()) == said.size()) return {};
    std::string called;
    size_t calls = 0;
    for (size_t c = 0; c < texts_.before.clauses.size(); ++c) {
        if (counterpart(c) == kNothing || before(c).opens || before(c).closes) continue;
        const std::vector<std::string>& was = texts_.before.words;
        const size_t step = step_in(was, before(c).first, before(c).end);
        if (step == before(c).end || !std::equal(was.begin() + static_cast<std::ptrdiff_t>(step),
                                                 was.begin() + static_cast<std::ptrdiff_t>(before(c).end),
                                                 is.begin() + static_cast<std::ptrdiff_t>(at),
                                                 is.begin() + static_cast<std::ptrdiff_t>(clause.end)))
            continue;
        const Clause& there = target(counterpart(c));
        if (!is_called(texts_.target.words, there.first, there.end)) return {};
        called = texts_.target.words[there.first];
        ++calls;
    }
    constexpr size_t kFewest = 2;
    return calls < kFewest ? std::string() : "the port calls `" + called + "` where the source does so";
}

}  // namespace porttool
