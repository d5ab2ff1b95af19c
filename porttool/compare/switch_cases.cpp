// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/switch_cases.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace porttool {
namespace {

int depth_change(std::string_view word) {
    if (word == "(" || word == "[" || word == "{") return 1;
    return word == ")" || word == "]" || word == "}" ? -1 : 0;
}

/// The place of the bracket that closes the one at `open`, or the end.
size_t closing(const Words& tokens, size_t open) {
    int depth = 0;
    for (size_t i = open; i < tokens.size(); ++i)
        if ((depth += depth_change(tokens[i])) == 0) return i;
    return tokens.size();
}

/// Labels that share what follows them, and what that is: one arm, or several of which each falls into the next.
struct Arm {
    std::vector<Words> labels;
    Words body;

    /// True if the next arm is not reached from this one.
    bool is_left() const {
        size_t end = body.size();
        while (end > 0 && body[end - 1] == "}") --end;
        if (end == 0 || body[end - 1] != ";") return false;
        size_t first = end - 1;
        int depth = 0;
        while (first > 0 &&
               (depth != 0 || (body[first - 1] != ";" && body[first - 1] != "{" && body[first - 1] != "}")))
            depth -= depth_change(body[--first]);
        const bool in_block = body.front() == "{" && closing(body, 0) + 1 == body.size();
        if (body.size() - end > (in_block ? 1 : 0)) return false;  // the block of an `if` may be passed
        const std::string_view word = body[first];
        return word == "break" || word == "return" || word == "continue" || word == "goto";
    }

    /// Writes how it is left in one way: `break ;` at the end, outside of a block that is all there is.
    void write_plain_end() {
        const auto ends_with_break = [](const Words& words) {
            return words.size() > 1 && words[words.size() - 2] == "break" && words.back() == ";";
        };
        if (ends_with_break(body)) body.resize(body.size() - 2);
        if (!body.empty() && body.front() == "{" && closing(body, 0) + 1 == body.size())
            body = Words(body.begin() + 1, body.end() - 1);
        if (ends_with_break(body)) body.resize(body.size() - 2);
        body.insert(body.end(), {"break", ";"});
    }
};

class SwitchSorter {
public:
    explicit SwitchSorter(const Words& tokens) : tokens_(tokens) {}

    /// Each level of nesting copies what it holds: deeper ones stay as they are written.
    Words run(size_t first, size_t end, int deep = 0) {
        constexpr int kMostNested = 8;
        if (deep == kMostNested) return Words(at(first), at(end));
        Words out;
        for (size_t i = first; i < end; ++i) {
            out.push_back(tokens_[i]);
            if (tokens_[i] != "switch" || i + 1 >= end || tokens_[i + 1] != "(") continue;
            const size_t head = closing(tokens_, i + 1);
            if (head + 1 >= end || tokens_[head + 1] != "{") continue;
            const size_t last = closing(tokens_, head + 1);
            if (last >= end) continue;
            out.insert(out.end(), at(i + 1), at(head + 2));
            add_arms(head + 2, last, deep, out);
            out.push_back(tokens_[last]);
            i = last;
        }
        return out;
    }

private:
    Words::const_iterator at(size_t i) const { return tokens_.begin() + static_cast<std::ptrdiff_t>(i); }

    bool is_label(size_t i) const { return tokens_[i] == "case" || tokens_[i] == "default"; }

    /// The end of the label that starts at `i`, behind its colon.
    size_t end_of_label(size_t i, size_t end) const {
        int depth = 0;
        for (; i < end; ++i) {
            depth += depth_change(tokens_[i]);
            if (depth == 0 && tokens_[i] == ":") return i + 1;
        }
        return end;
    }

    void add_arms(size_t first, size_t end, int deep, Words& out) {
        if (std::find(at(first), at(end), "#") != at(end)) return as_written(first, end, out);
        std::vector<Arm> arms;
        bool open = false;
        for (size_t i = first; i < end;) {
            if (!is_label(i)) return as_written(first, end, out);
            Arm arm;
            while (i < end && is_label(i)) {
                const size_t behind = end_of_label(i, end);
                arm.labels.emplace_back(at(i), at(behind));
                i = behind;
            }
            const size_t body = i;
            for (int depth = 0; i < end && (depth > 0 || !is_label(i)); ++i) depth += depth_change(tokens_[i]);
            arm.body = run(body, i, deep + 1);
            const bool left = arm.is_left() || i >= end;
            if (left) arm.write_plain_end();
            if (open)
                append(std::move(arm), arms.back());
            else
                arms.push_back(std::move(arm));
            open = !left;
        }
        write_sorted(arms, out);
    }

    void as_written(size_t first, size_t end, Words& out) const { out.insert(out.end(), at(first), at(end)); }

    static void append(Arm next, Arm& arm) {
        std::sort(next.labels.begin(), next.labels.end());
        for (const Words& label : next.labels) arm.body.insert(arm.body.end(), label.begin(), label.end());
        arm.body.insert(arm.body.end(), next.body.begin(), next.body.end());
    }

    static void write_sorted(std::vector<Arm>& arms, Words& out) {
        std::vector<std::pair<Words, const Words*>> single;
        for (Arm& arm : arms) {
            constexpr size_t kMost = 2'000;  // words of an arm and its copies
            std::sort(arm.labels.begin(), arm.labels.end());
            if (arm.labels.size() * arm.body.size() <= kMost) {
                for (const Words& label : arm.labels) single.emplace_back(label, &arm.body);
                continue;
            }
            Words labels;
            for (const Words& label : arm.labels) labels.insert(labels.end(), label.begin(), label.end());
            single.emplace_back(std::move(labels), &arm.body);
        }
        std::stable_sort(single.begin(), single.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& [label, body] : single) {
            out.insert(out.end(), label.begin(), label.end());
            out.insert(out.end(), body->begin(), body->end());
        }
    }

    const Words& tokens_;
};

/// The arms of all switches of a text: for each label where its arm begins, told by how many words stand before it that
/// belong to no label. One that stands in several arms has none.
class LabelReader {
public:
    explicit LabelReader(const Words& tokens) {
        for (size_t i = 0; i < tokens.size();) {
            const size_t end = tokens[i] == "case" ? end_of(tokens, i) : i;
            if (end == i) {
                rest_.push_back(tokens[i++]);
                continue;
            }
            std::string label;
            for (size_t k = i; k < end; ++k) label.append(tokens[k]) += ' ';
            if (const auto known = arm_of_.emplace(label, rest_.size()); !known.second) known.first->second = 0;
            written_.push_back(std::move(label));
            i = end;
        }
    }

    /// What stands beside the labels.
    const Words& rest() const { return rest_; }
    size_t count() const { return written_.size(); }
    const std::map<std::string, size_t>& arms() const { return arm_of_; }

    bool share_arm(const std::string& a, const std::string& b) const {
        const auto one = arm_of_.find(a), two = arm_of_.find(b);
        return one != arm_of_.end() && two != arm_of_.end() && one->second != 0 && one->second == two->second;
    }

    /// True if the two have arms of which each says something else.
    bool say_others(const std::string& a, const std::string& b) const {
        const auto one = arm_of_.find(a), two = arm_of_.find(b);
        return one != arm_of_.end() && two != arm_of_.end() && one->second != 0 && two->second != 0 &&
               says(one->second) != says(two->second);
    }

private:
    /// What stands from the beginning of an arm to the next one, or to the end of its block.
    Words says(size_t first) const {
        std::set<size_t> begins;
        for (const auto& [label, arm] : arm_of_) begins.insert(arm);
        Words out;
        int depth = 0;
        for (size_t i = first; i < rest_.size(); ++i) {
            depth += depth_change(rest_[i]);
            if (depth < 0 || (depth == 0 && ((i > first && begins.contains(i)) || rest_[i] == "default"))) break;
            out.push_back(rest_[i]);
        }
        return out;
    }

    static size_t end_of(const Words& tokens, size_t i) {
        constexpr size_t kLongest = 16;
        for (size_t k = i; k < tokens.size() && k < i + kLongest; ++k)
            if (tokens[k] == ":") return k + 1;
        return i;
    }

    Words rest_;
    std::vector<std::string> written_;
    std::map<std::string, size_t> arm_of_;
};

}  // namespace

bool only_adds_labels_of_other(const Words& before, const Words& now, const Words& other) {
    const LabelReader then(before), today(now);
    if (today.count() <= then.count() || today.rest() != then.rest()) return false;
    const LabelReader there(other);
    size_t added = 0;
    for (const auto& [label, arm] : today.arms()) {
        if (then.arms().contains(label)) continue;
        const bool has_neighbour = std::any_of(then.arms().begin(), then.arms().end(), [&](const auto& known) {
            return today.share_arm(label, known.first) && there.share_arm(label, known.first);
        });
        if (!has_neighbour) return false;
        ++added;
    }
    const bool stayed = std::all_of(then.arms().begin(), then.arms().end(), [&](const auto& one) {
        const auto found = today.arms().find(one.first);
        return found != today.arms().end() && found->second == one.second;
    });
    return stayed && added == today.count() - then.count();
}

bool adds_labels_to_other_arms(const Words& before, const Words& now, const Words& other) {
    const LabelReader then(before), today(now);
    if (today.count() <= then.count() || today.rest() != then.rest()) return false;
    const LabelReader there(other);
    return std::any_of(today.arms().begin(), today.arms().end(), [&](const auto& added) {
        if (then.arms().contains(added.first)) return false;
        return std::any_of(then.arms().begin(), then.arms().end(), [&](const auto& known) {
            return today.share_arm(added.first, known.first) && there.say_others(added.first, known.first);
        });
    });
}

Words with_sorted_cases(const Words& tokens) {
    if (std::find(tokens.begin(), tokens.end(), "case") == tokens.end()) return tokens;
    return SwitchSorter(tokens).run(0, tokens.size());
}

}  // namespace porttool
