// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/flow_places.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/compare/statement_edit.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_form.h"

namespace porttool {
namespace {

bool names_it(const std::vector<std::string_view>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr size_t kMostWordsOfFlow = 24'000;  // of all texts
constexpr size_t kMostPlaced = 8;            // statements of an edit
constexpr size_t kMostNamesPlaced = 16;      // names of a statement that are asked about

using FlowWords = std::vector<std::string>;

bool assigns(std::string_view word) {
    return is_one_of(word, {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>=", "++", "--"});
}

bool reaches(std::string_view word) { return is_one_of(word, {".", "->", "["}); }

bool is_flow_name(const FlowWords& words, size_t i) {
    if (!is_word_token(words[i]) || word_is(words[i], kKeyword) || word_is(words[i], kControls)) return false;
    if (i > 0 && is_one_of(words[i - 1], {".", "->", "::"})) return false;
    return i + 1 == words.size() || !is_one_of(words[i + 1], {"(", "::"});
}

bool heads_loop_in_flow(const FlowWords& words) { return !words.empty() && word_is(words[0], kLoop); }

/// True for a loop over the parts of a vector, which the other side may not have.
bool goes_over_parts(const FlowWords& words) {
    for (size_t i = 0; i + 1 < words.size(); ++i)
        if (is_one_of(words[i], {"<", "<=", "!="}) && is_one_of(words[i + 1], {"2", "3", "4", "2u", "3u", "4u"}))
            return true;
    return false;
}

/// A statement that reads or writes a local.
struct FlowUse {
    size_t at;
    bool reads, writes;
    bool in_head;  ///< written where a loop starts
};

struct LocalOfFlow {
    size_t declared = 0;      ///< the statement
    size_t named_at = 0;      ///< ... and the word of it
    bool is_handle = false;   ///< a pointer or a reference
    bool is_pointer = false;  ///< whose value is not what it leads to
    bool is_several = false;  ///< declared in more than one place
};

/// How a local is used around a place.
struct FlowTally {
    size_t reads_before = 0, reads_behind = 0, writes_before = 0, writes_behind = 0;
    size_t loops_entered = 0, loops_left = 0;  ///< from where it was written last
    bool counts_items = false;                 ///< a loop is headed by it

    bool as_often_as(const FlowTally& other) const {
        return reads_before + reads_behind == other.reads_before + other.reads_behind &&
               writes_before + writes_behind == other.writes_before + other.writes_behind;
    }
};

/// What is written around a place that ends something early.
struct FlowSkips {
    size_t before = 0, behind = 0;
};

/// One text, and the statements of it that are asked about.
class FlowOfText {
public:
    FlowOfText(const std::vector<Statement>& statements, const std::vector<size_t>& edited)
        : statements_(statements),
          edited_(edited),
          closing_(statements.size(), statements.size()),
          declares_(statements.size()) {
        for (size_t i = 0; i < statements.size(); ++i) {
            const Statement& statement = statements[i];
            if (statement.is_brace() && statement.head != Statement::kNoHead) closing_[statement.head] = i;
            if (!is_edited(i) && is_in_body(i)) note_locals(i);
        }
    }

    std::vector<size_t> placed() const {
        std::vector<size_t> out;
        for (const size_t i : edited_)
            if (is_in_body(i)) out.push_back(i);
        return out;
    }

    const FlowWords& words(size_t i) const { return statements_[i].common; }
    const std::string& shown(size_t i) const { return statements_[i].shown; }

    /// The first names of a statement in their order, each once.
    std::vector<std::string_view> names_of(size_t i) const {
        std::vector<std::string_view> out;
        for (size_t k = 0; k < words(i).size() && out.size() < kMostNamesPlaced; ++k)
            if (is_flow_name(words(i), k) && std::find(out.begin(), out.end(), words(i)[k]) == out.end())
                out.emplace_back(words(i)[k]);
        return out;
    }

    bool writes(size_t i, std::string_view name) const {
        for (size_t k = 0; k < words(i).size(); ++k)
            if (words(i)[k] == name && is_written(words(i), k)) return true;
        return false;
    }

    bool is_local(std::string_view name) const { return locals_.contains(name); }

    /// The local that a statement writes first; "" if it writes none.
    std::string_view written_first(size_t i) const {
        for (const std::string_view name : names_of(i))
            if (is_local(name) && writes(i, name)) return name;
        return {};
    }

    /// Nothing if it is no local of a single value.
    std::optional<FlowTally> tally(std::string_view name, size_t place) const {
        const auto local = locals_.find(name);
        if (local == locals_.end() || local->second.is_pointer || local->second.is_several) return std::nullopt;
        const std::optional<std::vector<FlowUse>> uses = uses_of(name);
        if (!uses) return std::nullopt;
        FlowTally out;
        size_t last = Statement::kNoHead;
        for (const FlowUse& use : *uses) {
            const bool before = use.at < place;
            (before ? out.reads_before : out.reads_behind) += use.reads ? 1 : 0;
            (before ? out.writes_before : out.writes_behind) += use.writes ? 1 : 0;
            if (before && use.writes) last = use.at;
            out.counts_items = out.counts_items || use.in_head;
        }
        if (last == Statement::kNoHead) return out;
        const std::vector<size_t> here = loops_around(place), there = loops_around(last);
        const auto entered = [](const std::vector<size_t>& from, const std::vector<size_t>& to) {
            return static_cast<size_t>(std::count_if(to.begin(), to.end(), [&](size_t loop) {
                return std::find(from.begin(), from.end(), loop) == from.end();
            }));
        };
        out.loops_entered = entered(there, here);
        out.loops_left = entered(here, there);
        return out;
    }

    /// What is written between the last value that the condition of a jump reads and the jump, and behind it, as far as
    /// the jump leads; nothing if it is no jump, or leaves a switch.
    std::optional<FlowSkips> skips(size_t jump) const {
        const FlowWords& said = words(jump);
        if (said.empty() || !is_one_of(said[0], {"return", "continue", "break", "discard"})) return std::nullopt;
        size_t region = 0, end = statements_.size();
        if (said[0] == "continue" || said[0] == "break") {
            region = statements_[jump].head;
            while (region != Statement::kNoHead && !heads_loop_in_flow(words(region))) {
                if (words(region).empty() || words(region)[0] == "switch") return std::nullopt;
                region = statements_[region].head;
            }
            if (region == Statement::kNoHead) return std::nullopt;
            end = closing_[region];
        }
        FlowSkips out;
        const size_t first = std::max(region + 1, known_since(jump));
        for (size_t i = first; i < end; ++i)
            if (has_effect(i, region)) ++(i < jump ? out.before : out.behind);
        return out;
    }

private:
    bool is_edited(size_t i) const { return std::binary_search(edited_.begin(), edited_.end(), i); }
    bool is_in_body(size_t i) const {
        return statements_[i].head != Statement::kNoHead && !statements_[i].is_brace() && !words(i).empty();
    }

    /// What the caller does not see, as far as the function's head tells.
    bool is_parameter_by_value(std::string_view name) const {
        const FlowWords& head = words(0);
        size_t from = 0;  // where the parameter begins
        for (size_t k = 1; k + 1 < head.size(); ++k) {
            if (is_one_of(head[k], {"(", ","})) from = k;
            if (head[k] == name && is_one_of(head[k + 1], {",", ")"}))
                return from > 0 && std::none_of(head.begin() + static_cast<std::ptrdiff_t>(from),
                                                head.begin() + static_cast<std::ptrdiff_t>(k), [](const auto& word) {
                                                    return is_one_of(word, {"*", "&", "&&", "out", "inout"});
                                                });
        }
        return false;
    }

    /// `T a = 1 , * b ( 2 ) ;` and what a loop declares in its head.
    void note_locals(size_t i) {
        const FlowWords& said = words(i);
        size_t k = heads_loop_in_flow(said) ? 2 : 0;
        size_t types = 0;
        bool is_handle = false, is_pointer = false;
        int depth = 0;
        for (; k < said.size(); ++k) {
            const std::string& word = said[k];
            const std::string_view next = k + 1 < said.size() ? std::string_view(said[k + 1]) : std::string_view(";");
            if (word_is(word, kControls) || is_one_of(word, {"return", "else", "case", "goto", "delete", "#"})) return;
            const bool is_name = is_word_token(word) && types > 0 && depth == 0;
            if (is_name && is_one_of(next, {"=", ";", ",", "[", "{", "(", ":", ")"})) {
                const auto [local, is_first] = locals_.insert({word, {i, k, is_handle, is_pointer, false}});
                if (is_first)
                    declares_[i] = true;
                else
                    local->second.is_several = true;
                while (k + 1 < said.size() && !(depth == 0 && is_one_of(said[k + 1], {",", ";"}))) {
                    ++k;
                    depth += is_one_of(said[k], {"(", "[", "{"}) ? 1 : is_one_of(said[k], {")", "]", "}"}) ? -1 : 0;
                }
                if (k + 1 >= said.size() || said[k + 1] == ";") return;
                ++k;
                is_handle = is_pointer = false;
                continue;
            }
            depth += word == "<" ? 1 : word == ">" ? -1 : word == ">>" ? -2 : 0;
            is_pointer = is_pointer || word == "*";
            is_handle = is_handle || word == "*" || word == "&";
            types += is_word_token(word) ? 1 : 0;
            if (!is_word_token(word) && !is_number_token(word) &&
                !is_one_of(word, {"<", ">", ">>", "::", "*", "&", ","}))
                return;
        }
    }

    static bool is_written(const FlowWords& said, size_t k) {
        if (!is_flow_name(said, k)) return false;
        if (k > 0 && (is_one_of(said[k - 1], {"++", "--"}) ||
                      (said[k - 1] == "&" && (k < 2 || is_one_of(said[k - 2], {"(", ","})))))
            return true;
        size_t end = k + 1;
        while (end < said.size() && reaches(said[end])) {
            if (said[end] != "[") {
                end += 2;
                continue;
            }
            int depth = 0;
            do {
                depth += said[end] == "[" ? 1 : said[end] == "]" ? -1 : 0;
                ++end;
            } while (end < said.size() && depth > 0);
        }
        return end < said.size() && assigns(said[end]);
    }

    /// True where a statement declares a local and gives it its first value in brackets.
    bool is_given_first_value(const FlowWords& said, size_t k, size_t i) const {
        const auto local = locals_.find(said[k]);
        return local != locals_.end() && local->second.declared == i && local->second.named_at == k &&
               k + 1 < said.size() && is_one_of(said[k + 1], {"(", "{"});
    }

    /// The uses of a local in their order; nothing if it has parts. The step in a loop's head is taken at its end.
    std::optional<std::vector<FlowUse>> uses_of(std::string_view name) const {
        std::vector<FlowUse> out;
        for (size_t i = 0; i < statements_.size(); ++i) {
            if (!is_in_body(i) || is_edited(i)) continue;
            const FlowWords& said = words(i);
            const bool is_for = is_one_of(said[0], {"for", "cfor"});
            size_t clause = 0;
            FlowUse here{i, false, false, false}, step{closing_[i], false, false, false};
            for (size_t k = 0; k < said.size(); ++k) {
                if (said[k] == ";") ++clause;
                const bool begins = said[k] == name && is_given_first_value(said, k, i);
                if (begins) here.writes = true;  // `T a ( 1 ) ;`
                if (begins || said[k] != name || !is_flow_name(said, k)) continue;
                if (k + 1 < said.size() && reaches(said[k + 1])) return std::nullopt;
                const std::string_view next =
                    k + 1 < said.size() ? std::string_view(said[k + 1]) : std::string_view(";");
                const bool writes = is_written(said, k);
                const auto local = locals_.find(name);
                const bool declares = local->second.declared == i && is_one_of(next, {";", ","});
                if (declares && !writes) continue;
                FlowUse& use = is_for && clause == 2 ? step : here;
                use.reads = use.reads || !writes || next != "=";
                use.writes = use.writes || writes;
                here.in_head = here.in_head || (is_for && clause == 0);
            }
            if (here.reads || here.writes) out.push_back(here);
            if (step.reads || step.writes) out.push_back(step);
        }
        std::stable_sort(out.begin(), out.end(), [](const FlowUse& a, const FlowUse& b) { return a.at < b.at; });
        return out;
    }

    /// The loops that a statement stands in, but for those over the parts of a vector.
    std::vector<size_t> loops_around(size_t i) const {
        std::vector<size_t> out;
        for (size_t head = statements_[i].head; head != Statement::kNoHead; head = statements_[head].head)
            if (heads_loop_in_flow(words(head)) && !goes_over_parts(words(head))) out.push_back(head);
        return out;
    }

    /// Behind the last statement before the jump that writes what its condition reads.
    size_t known_since(size_t jump) const {
        const size_t condition = statements_[jump].head;
        if (condition == Statement::kNoHead || !is_edited(condition)) return 0;
        const std::vector<std::string_view> names = names_of(condition);
        for (size_t i = condition; i-- > 0;) {
            if (!is_in_body(i) || is_edited(i)) continue;
            if (std::any_of(names.begin(), names.end(), [&](auto name) { return writes(i, name); })) return i + 1;
        }
        return 0;
    }

    /// True for what can be seen where the region has been left.
    bool has_effect(size_t i, size_t region) const {
        if (!is_in_body(i) || is_edited(i)) return false;
        const FlowWords& said = words(i);
        if (said[0] == "return") return said.size() > 1 && said[1] != ";";
        if (word_is(said[0], kControls) || heads_loop_in_flow(said) || said[0] == "#") return false;
        for (size_t k = 0; k < said.size(); ++k)
            if (is_written(said, k)) return is_seen(said, k, region);
        if (declares_[i]) return false;
        const auto call = std::find(said.begin(), said.end(), "(");
        if (call == said.end() || !is_word_token(said[0])) return false;
        return std::none_of(said.begin(), call, [](const std::string& word) {
            return word.find("sync") != std::string::npos || word.find("arrier") != std::string::npos;
        });
    }

    bool is_seen(const FlowWords& said, size_t k, size_t region) const {
        const FlowWords& head = words(region);
        const bool reaches_on = k + 1 < said.size() && reaches(said[k + 1]);
        if (region == 0 && !reaches_on && is_parameter_by_value(said[k])) return false;
        const bool counts = heads_loop_in_flow(head) && std::find(head.begin(), head.end(), said[k]) != head.end();
        if (counts && !reaches_on) return false;
        const auto local = locals_.find(said[k]);
        if (local == locals_.end() || local->second.declared < region) return true;
        return local->second.is_handle && (reaches_on || (k > 0 && said[k - 1] == "*"));
    }

    const std::vector<Statement>& statements_;
    const std::vector<size_t>& edited_;
    std::vector<size_t> closing_;  ///< of each head its brace
    std::vector<bool> declares_;   ///< of each statement
    std::map<std::string, LocalOfFlow, std::less<>> locals_;
};

bool are_empty_alike(size_t a, size_t b) { return (a == 0) == (b == 0); }

/// Whether two places are one to a local of each side. Where both are used as often, the same uses stand before.
bool is_same_place(const FlowTally& a, const FlowTally& b, bool is_written) {
    if (a.counts_items != b.counts_items)
        return are_empty_alike(a.writes_before, b.writes_before) && (a.counts_items ? a : b).loops_left == 0;
    if (a.as_often_as(b)) {
        if (a.writes_before != b.writes_before || (is_written && a.reads_before != b.reads_before)) return false;
        return a.loops_entered == b.loops_entered && a.loops_left == b.loops_left;
    }
    if (!are_empty_alike(a.writes_before, b.writes_before)) return false;
    return !is_written ||
           (are_empty_alike(a.reads_before, b.reads_before) && are_empty_alike(a.reads_behind, b.reads_behind));
}

bool skips_the_same(const FlowSkips& a, const FlowSkips& b) {
    if (a.before + a.behind == b.before + b.behind) return a.before == b.before;
    return are_empty_alike(a.before, b.before) && are_empty_alike(a.behind, b.behind);
}

/// What a statement is, apart from names: how it begins, and how it assigns.
std::string kind_in_flow(const FlowWords& words) {
    if (is_one_of(words[0], {"return", "continue"})) return "end of an item";
    if (word_is(words[0], kControls) || is_one_of(words[0], {"break", "discard", "else", "case"})) return words[0];
    for (const std::string& word : words)
        if (assigns(word)) return word;
    return {};
}

/// The first of the statements that two texts are asked about which stands elsewhere.
std::string first_elsewhere(const FlowOfText& source, const FlowOfText& target, const char* verb) {
    const std::vector<size_t> here = source.placed(), there = target.placed();
    if (here.empty() || here.size() != there.size() || here.size() > kMostPlaced) return {};
    for (size_t i = 0; i < here.size(); ++i)
        if (kind_in_flow(source.words(here[i])) != kind_in_flow(target.words(there[i]))) return {};
    for (size_t i = 0; i < here.size(); ++i) {
        const std::string what = std::string("both sides ") + verb + " `" + target.shown(there[i]) + "`, but ";
        const auto skips = source.skips(here[i]), skips_there = target.skips(there[i]);
        if (skips && skips_there && !skips_the_same(*skips, *skips_there))
            return what + "at different places: what is written before it, or left out, is not the same";
        const std::vector<std::string_view> names = source.names_of(here[i]), others = target.names_of(there[i]);
        for (size_t k = 0; names.size() == others.size() && k < names.size(); ++k) {
            // A name that the other statement has as well is not matched with another one by its rank.
            if (names[k] != others[k] && (names_it(names, others[k]) || names_it(others, names[k]))) continue;
            const auto one = source.tally(names[k], here[i]), other = target.tally(others[k], there[i]);
            const bool writes = source.writes(here[i], names[k]);
            if (one && other && writes == target.writes(there[i], others[k]) && !is_same_place(*one, *other, writes))
                return what + "at different places among the uses of `" + std::string(names[k]) +
                       "` in the source and of `" + std::string(others[k]) + "` in the port";
        }
    }
    return {};
}

/// The edits of both sides of a pair, as written.
BySide<StatementEdit> edits_in_flow(const PairTexts& texts) {
    // A local that was `const` and is written now stays where it is.
    const auto as_written = [](const Words& statement, bool) {
        FlowWords out(statement.begin(), statement.end());
        std::erase(out, "const");
        return out;
    };
    return {statement_edit(texts.source_before, texts.source_now, as_written),
            statement_edit(texts.target_before, texts.target_now, as_written)};
}

bool are_short_for_flow(const PairTexts& texts) {
    return texts.source_before.size() + texts.source_now.size() + texts.target_before.size() +
               texts.target_now.size() <=
           kMostWordsOfFlow;
}

}  // namespace

std::string other_place_in_flow(const PairTexts& texts) {
    if (!are_short_for_flow(texts)) return {};
    const auto [source, target] = edits_in_flow(texts);
    std::string out = first_elsewhere({source.now, source.gained}, {target.now, target.gained}, "gained");
    return out.empty() ? first_elsewhere({source.before, source.lost}, {target.before, target.lost}, "lost") : out;
}

std::string other_local_in_flow(const PairTexts& texts, const Words& source_in_words_of_target) {
    if (!are_short_for_flow(texts) || source_in_words_of_target.size() != texts.source_before.size()) return {};
    const auto [source, target] = edits_in_flow(texts);
    const FlowOfText here(source.before, source.lost), there(target.before, target.lost);
    const std::vector<size_t> lost = here.placed(), lost_there = there.placed();
    if (lost.size() != lost_there.size() || lost.size() > kMostPlaced) return {};
    std::map<std::string_view, std::string_view> said;
    for (size_t i = 0; i < texts.source_before.size(); ++i)
        said.emplace(texts.source_before[i], source_in_words_of_target[i]);
    for (size_t i = 0; i < lost.size(); ++i) {
        if (kind_in_flow(here.words(lost[i])) != kind_in_flow(there.words(lost_there[i]))) return {};
        const std::string_view one = here.written_first(lost[i]), other = there.written_first(lost_there[i]);
        const auto known = said.find(one);
        if (one.empty() || other.empty() || known == said.end() || known->second == other) continue;
        if (there.is_local(known->second))
            return "both sides lost a statement that writes a local, and `" + std::string(one) +
                   "` of the source is `" + std::string(known->second) + "` in the port, not `" + std::string(other) +
                   "`";
    }
    return {};
}

}  // namespace porttool
