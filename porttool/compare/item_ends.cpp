// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/item_ends.h"

#include <algorithm>

#include "porttool/normal/declaration_words.h"
#include "porttool/scan/side.h"

namespace porttool {
namespace {

constexpr std::string_view kLeavesLoop = "return from the loop";

bool heads_loop(std::string_view word) {
    return is_one_of(word, {"for", "while", "do", "cfor", "cwhile", "cdo", "foreach", "foreach_tiled", "foreach_unique",
                            "foreach_active"});
}

bool heads_block(std::string_view word) { return is_one_of(word, {"if", "cif", "else", "switch", "try", "catch"}); }

/// Walks over a text, and knows how many loops of the same function the word at hand stands in.
class LoopWalk {
public:
    explicit LoopWalk(const Words& text) : text_(text) {}

    /// Calls `visit` with each word's index and depth.
    template <typename Visit>
    void run(Visit visit) {
        size_t brackets = 0;
        for (size_t i = 0; i < text_.size(); ++i) {
            const std::string_view word = text_[i];
            visit(i, depth_);
            if (word == "(" || word == "[") ++brackets;
            if ((word == ")" || word == "]") && brackets > 0) --brackets;
            if (heads_loop(word) && brackets == 0 && !ends_do(i)) head_ = Head::Loop;
            if (heads_block(word) && brackets == 0) head_ = Head::Block;
            if (word == "{") {
                open(i, brackets);
                brackets = 0;
            } else if (word == "}") {
                close(brackets);
            } else if (word == ";" && brackets == 0) {
                head_ = Head::None;
            }
        }
    }

private:
    enum class Head : uint8_t { None, Loop, Block };
    struct Open {
        size_t depth, brackets;
        bool is_do;
    };

    bool ends_do(size_t at) const { return text_[at] == "while" && at > 0 && text_[at - 1] == "}" && closed_do_; }

    void open(size_t at, size_t brackets) {
        open_.push_back({depth_, brackets, head_ == Head::Loop && at > 0 && text_[at - 1] == "do"});
        const bool is_plain = at > 0 && is_one_of(text_[at - 1], {";", "{", "}", ":"});
        if (head_ == Head::Loop && brackets == 0)
            ++depth_;
        else if (brackets > 0 || (head_ != Head::Block && !is_plain))
            depth_ = 0;  // the body of a lambda, or the values of a list
        head_ = Head::None;
    }

    void close(size_t& brackets) {
        if (open_.empty()) return;
        depth_ = open_.back().depth;
        brackets = open_.back().brackets;
        closed_do_ = open_.back().is_do;
        open_.pop_back();
    }

    const Words& text_;
    std::vector<Open> open_;
    size_t depth_ = 0;
    Head head_ = Head::None;
    bool closed_do_ = false;
};

bool ends_all(const Words& text, size_t i) { return text[i] == "return" && i + 1 < text.size() && text[i + 1] == ";"; }

/// How often a text leaves a loop by a `return` without a value.
size_t times_returning_from_loops(const Words& text) {
    size_t out = 0;
    LoopWalk(text).run([&](size_t i, size_t depth) { out += depth > 0 && ends_all(text, i) ? 1 : 0; });
    return out;
}

}  // namespace

std::vector<std::string> with_returns_for_items(const Words& text) {
    std::vector<std::string> out;
    out.reserve(text.size());
    LoopWalk(text).run([&](size_t i, size_t depth) {
        if (depth > 0 && ends_all(text, i))
            out.emplace_back(kLeavesLoop);
        else
            out.emplace_back(depth == 1 && text[i] == "continue" ? "return" : text[i]);
    });
    return out;
}

size_t loops_of(const Words& text) { return static_cast<size_t>(std::count_if(text.begin(), text.end(), heads_loop)); }

std::string other_ends_of_items(const PairTexts& texts) {
    const auto more = [](const Words& before, const Words& now) {
        return static_cast<int64_t>(times_returning_from_loops(now)) -
               static_cast<int64_t>(times_returning_from_loops(before));
    };
    const int64_t source = more(texts.source_before, texts.source_now),
                  target = more(texts.target_before, texts.target_now);
    if (source == target) return {};
    const bool is_port = target > source;
    return std::string(is_port ? "the port" : "the source") + " came to leave a loop by `return`, and " +
           (is_port ? "the source" : "the port") + " did not; what ends one item alone is `continue`";
}

}  // namespace porttool
