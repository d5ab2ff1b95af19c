// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/item_ends.h"

#include <algorithm>
#include <map>
#include <set>
#include <type_traits>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/scan/side.h"

namespace porttool {
namespace {

constexpr std::string_view kLeavesLoop = "return from the loop";

/// What a brace opens. A function is also the body of a lambda, a method of a local type, or a list of values.
enum class BlockOf : uint8_t { Statements, Loop, Switch, Type, Function };

bool starts_statement_at(const Words& text, size_t i) {
    return i == 0 || is_one_of(text[i - 1], {";", "{", "}", ":", "else"});
}

/// True for what heads a block that is no loop's.
bool heads_plain_block(std::string_view word) {
    return (word_is(word, kControls) && !word_is(word, kLoop)) || is_one_of(word, {"else", "switch", "try", "catch"});
}

/// Walks over a text, and knows the blocks of the same function that the word at hand stands in.
class BlockWalk {
public:
    struct Block {
        BlockOf of;
        size_t head;  ///< the word that heads it
        size_t open;  ///< its brace
    };

    explicit BlockWalk(const Words& text) : text_(text) {}

    /// Calls `visit` with the index of each word.
    template <typename Visit>
    void run(Visit visit) {
        for (size_t i = 0; i < text_.size(); ++i) {
            const std::string_view word = text_[i];
            visit(i);
            if (brackets_ == 0 && !ends_do(i)) note_head(i);
            if (word == "(" || word == "[") ++brackets_;
            if ((word == ")" || word == "]") && brackets_ > 0) --brackets_;
            if (word == "{") open(i);
            if (word == "}") close();
        }
    }

    /// How many loops of the same function the word at hand stands in, and the outermost of them.
    size_t loops() const { return open_.empty() ? 0 : open_.back().loops; }
    const Block& outermost_loop() const { return open_.back().outermost; }

    /// True if `break` would leave a switch here.
    bool is_in_switch() const { return !open_.empty() && open_.back().left_by_break == BlockOf::Switch; }

    size_t loops_opened() const { return loops_opened_; }

private:
    struct Open {
        Block block, outermost;
        size_t brackets, loops;
        BlockOf left_by_break;
    };

    bool ends_do(size_t at) const { return text_[at] == "while" && at > 0 && text_[at - 1] == "}" && closed_do_; }

    /// A statement may begin with a macro, `FOR_ALL ( i , n ) {`; what controls one may stand behind a pragma.
    void note_head(size_t i) {
        const bool begins = starts_statement_at(text_, i) && (is_word_token(text_[i]) || text_[i] == "#");
        if (begins || word_is(text_[i], kLoop) || heads_plain_block(text_[i])) head_ = i;
    }

    /// The name before the parenthesis that closes before `end`; "" if none does soon, or no name stands there.
    std::string_view called_before(size_t end) const {
        constexpr size_t kLongest = 256;
        int depth = 0;
        for (size_t i = end; i > 1 && end - i < kLongest; --i) {
            depth += text_[i - 1] == ")" ? 1 : text_[i - 1] == "(" ? -1 : 0;
            if (depth == 0)
                return text_[i - 1] == "(" && is_word_token(text_[i - 2]) ? text_[i - 2] : std::string_view();
        }
        return {};
    }

    BlockOf block_at(size_t i) const {
        if (brackets_ > 0 || open_.empty()) return BlockOf::Function;
        const std::string_view head = head_ < i ? text_[head_] : std::string_view();
        if (is_one_of(text_[i - 1], {";", "{", "}", ":"})) return BlockOf::Statements;
        if (word_is(head, kLoop)) return BlockOf::Loop;
        if (head == "switch") return BlockOf::Switch;
        if (heads_plain_block(head)) return BlockOf::Statements;
        if (word_is(head, kOpensType)) return BlockOf::Type;
        const std::string_view called = called_before(i);
        const bool is_call = !called.empty() && (called == head || head == "#");
        return is_call && open_.back().block.of != BlockOf::Type ? BlockOf::Loop : BlockOf::Function;
    }

    void open(size_t i) {
        const Block block = {block_at(i), head_, i};
        Open one = {block, block, brackets_, 0, BlockOf::Statements};
        if (!open_.empty() && block.of != BlockOf::Function) {
            one.outermost = open_.back().outermost;
            one.loops = open_.back().loops;
            one.left_by_break = open_.back().left_by_break;
        }
        if (block.of == BlockOf::Loop) {
            if (one.loops++ == 0) one.outermost = block;
            ++loops_opened_;
        }
        if (block.of == BlockOf::Loop || block.of == BlockOf::Switch) one.left_by_break = block.of;
        open_.push_back(one);
        brackets_ = 0;
    }

    void close() {
        if (open_.empty()) return;
        brackets_ = open_.back().brackets;
        const Block& block = open_.back().block;
        closed_do_ = block.of == BlockOf::Loop && is_one_of(text_[block.head], {"do", "cdo"});
        open_.pop_back();
    }

    const Words& text_;
    std::vector<Open> open_;
    size_t brackets_ = 0, head_ = 0, loops_opened_ = 0;
    bool closed_do_ = false;
};

bool ends_all(const Words& text, size_t i) { return text[i] == "return" && i + 1 < text.size() && text[i + 1] == ";"; }

/// How a loop comes to its next item: in its head, or by the last statement of its body, which `continue` skips.
///
///     for (...; ++i)    for (x : v)    while (i-- > 0)    FOR_ALL(i, n)      in its head
///     while (i < n) { ...; ++i; }                                            `++ i ;`
///     while (true) { ...; ++i; }                                             not known
class ItemSteps {
public:
    struct Step {
        bool in_head = false;
        Words of_body;  ///< the statement; empty if there is none, or it is not clear
    };

    explicit ItemSteps(const Words& text) : text_(text), closing_(text.size(), text.size()) {
        std::vector<size_t> open;
        for (size_t i = 0; i < text.size(); ++i) {
            if (text[i] == "{") open.push_back(i);
            if (text[i] != "}" || open.empty()) continue;
            closing_[open.back()] = i;
            open.pop_back();
        }
    }

    const Step& of(const BlockWalk::Block& loop) {
        const auto known = known_.find(loop.open);
        return known != known_.end() ? known->second : known_.emplace(loop.open, read(loop)).first->second;
    }

private:
    Words::const_iterator at(size_t i) const { return text_.begin() + static_cast<std::ptrdiff_t>(i); }

    Step read(const BlockWalk::Block& loop) const {
        constexpr size_t kLongest = 20'000;  // words of a body
        const std::string_view head = text_[loop.head];
        const size_t end = closing_[loop.open];
        const bool is_for = is_one_of(head, {"for", "cfor"}), is_do = is_one_of(head, {"do", "cdo"});
        if (is_for && text_[loop.open - 1] == ")" && text_[loop.open - 2] != ";") return {true, {}};
        if (!is_for && !is_do && !is_one_of(head, {"while", "cwhile"})) return {true, {}};
        const size_t first = is_do ? std::min(end + 1, text_.size()) : loop.head;
        const Words condition(at(first), is_do ? std::find(at(first), text_.end(), ";") : at(loop.open));
        const bool steps = std::any_of(condition.begin(), condition.end(), [](std::string_view word) {
            return is_one_of(word, {"++", "--", "=", "+=", "-="});
        });
        if (steps && !is_for) return {true, {}};
        if (end - loop.open > kLongest) return {};
        std::set<std::string_view> names;
        for (const std::string_view word : condition)
            if (is_word_token(word) && !word_is(word, kKeyword)) names.insert(word);
        return step_of_body(loop.open, end, names);
    }

    Step step_of_body(size_t open, size_t end, const std::set<std::string_view>& names) const {
        const auto is_written = [&](size_t i) {
            return names.contains(text_[i]) &&
                   (is_one_of(text_[i - 1], {"++", "--", "&"}) ||
                    (i + 1 < end && is_one_of(text_[i + 1], {"++", "--", "=", "+=", "-=", "*=", "/=", ">>=", "<<="})));
        };
        bool writes = false;
        for (size_t i = open + 1; i < end && !writes; ++i) writes = is_written(i);
        if (!writes) return {!names.empty(), {}};
        const size_t last = start_of_statement(open, end), before = start_of_statement(open, last);
        bool is_step = false;
        for (size_t i = last; i < end && !is_step; ++i) is_step = is_written(i);
        const bool is_second = std::any_of(at(before), at(last), [](std::string_view word) {
            return is_one_of(word, {"++", "--", "+=", "-="});
        });
        return {false, is_step && !is_second ? Words(at(last), at(end)) : Words()};
    }

    /// Where the plain statement begins that ends before `end`; `end` if that is none.
    size_t start_of_statement(size_t open, size_t end) const {
        if (end <= open + 1 || end > text_.size() || text_[end - 1] != ";") return end;
        size_t first = end - 1;
        while (first > open + 1 && !is_one_of(text_[first - 1], {";", "{", "}"})) --first;
        return first;
    }

    const Words& text_;
    std::vector<size_t> closing_;   ///< of each opening brace
    std::map<size_t, Step> known_;  ///< by the brace of the loop
};

/// How often a text leaves so many loops by a `return` without a value, and a switch or a loop by `break`.
struct Leaving {
    std::map<size_t, int64_t> loops_left;
    int64_t returns = 0, breaks = 0, breaks_of_switch = 0;

    Leaving(const Words& before, const Words& now) {
        count(now, 1);
        count(before, -1);
        std::erase_if(loops_left, [](const auto& each) { return each.second == 0; });
    }

private:
    void count(const Words& text, int64_t times) {
        BlockWalk walk(text);
        walk.run([&](size_t i) {
            if (text[i] == "break") {
                breaks += times;
                breaks_of_switch += walk.is_in_switch() ? times : 0;
            }
            if (!ends_all(text, i)) return;
            const size_t loops = walk.loops();
            returns += loops > 0 ? times : 0;
            if (loops > 0) loops_left[loops] += times;
        });
    }
};

/// How many more there are of each kind of what ends something early.
template <typename List>
std::map<std::string, int64_t> jumps_of(const List& before, const List& now) {
    std::map<std::string, int64_t> out;
    const auto count = [&](const List& text, int64_t times) {
        for (const auto& word : text)
            if (is_one_of(word, {"return", kLeavesLoop, "break", "continue", "goto", "discard"}))
                out[std::string(word)] += times;
    };
    count(now, 1);
    count(before, -1);
    std::erase_if(out, [](const auto& each) { return each.second == 0; });
    return out;
}

}  // namespace

std::vector<std::string> with_returns_for_items(const Words& text) {
    std::vector<std::string> out;
    out.reserve(text.size());
    ItemSteps steps(text);
    BlockWalk walk(text);
    const auto ends_item = [&] {
        if (walk.loops() != 1) return false;
        const ItemSteps::Step& step = steps.of(walk.outermost_loop());
        const auto size = static_cast<std::ptrdiff_t>(step.of_body.size());
        if (step.in_head) return true;
        if (size == 0 || out.size() < step.of_body.size() ||
            !std::equal(step.of_body.begin(), step.of_body.end(), out.end() - size))
            return false;
        out.erase(out.end() - size, out.end());
        return true;
    };
    walk.run([&](size_t i) {
        if (ends_all(text, i) && walk.loops() > 0)
            out.emplace_back(kLeavesLoop);
        else if (text[i] == "continue" && ends_item())
            out.emplace_back("return");
        else
            out.emplace_back(text[i]);
    });
    return out;
}

size_t loops_of(const Words& text) {
    BlockWalk walk(text);
    walk.run([](size_t) {});
    return walk.loops_opened();
}

std::string other_ends_of_items(const PairTexts& texts) {
    const Leaving source(texts.source_before, texts.source_now), target(texts.target_before, texts.target_now);
    if (source.returns != target.returns) {
        const bool is_port = target.returns > source.returns;
        return std::string(is_port ? "the port" : "the source") + " came to leave a loop by `return`, and " +
               (is_port ? "the source" : "the port") + " did not; what ends one item alone is `continue`";
    }
    if (source.loops_left != target.loops_left)
        return "both sides came to leave loops by `return`, and one of them stands in more loops there: what ends one "
               "item alone is `continue`";
    if (source.breaks == target.breaks && source.breaks_of_switch != target.breaks_of_switch)
        return "`break` leaves a loop on one side, and a switch on the other";
    return {};
}

bool jump_alike(const PairTexts& texts) {
    const auto source = jumps_of(texts.source_before, texts.source_now),
               target = jumps_of(texts.target_before, texts.target_now);
    const auto of_items = [](const Words& before, const Words& now) {
        return jumps_of(with_returns_for_items(before), with_returns_for_items(now));
    };
    return source == target || of_items(texts.source_before, texts.source_now) == target ||
           source == of_items(texts.target_before, texts.target_now);
}

bool jumps_arrive(const LoneTexts& texts) {
    const auto arrive = [](const auto& before, const auto& now, const auto& other) {
        using List = std::decay_t<decltype(now)>;
        const auto came = jumps_of(before, now), has = jumps_of(List{}, now);
        const auto there = jumps_of(std::decay_t<decltype(other)>{}, other);
        return std::all_of(came.begin(), came.end(), [&](const auto& each) {
            const auto like = there.find(each.first);
            return each.second < 0 || (like != there.end() && has.at(each.first) <= like->second);
        });
    };
    return arrive(texts.before, texts.now, texts.other) ||
           arrive(texts.before, texts.now, with_returns_for_items(texts.other)) ||
           arrive(with_returns_for_items(texts.before), with_returns_for_items(texts.now), texts.other);
}

}  // namespace porttool
