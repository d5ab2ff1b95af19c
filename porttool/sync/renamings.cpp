// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/renamings.h"

#include <algorithm>
#include <set>
#include <string>

#include "porttool/normal/normal_text.h"
#include "porttool/sync/operands.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

bool has_word(const AlignedText& text, const std::string& word) {
    return std::find(text.words.begin(), text.words.end(), word) != text.words.end();
}

/// True for a field or what a scope has: of what, its name alone does not tell.
bool is_picked(const AlignedText& text, size_t i) { return i > 0 && is_accessor(text.words[i - 1]); }

/// The comparisons that a word is held to, as `==` of `a == kNone`; none for what stands otherwise.
std::set<std::string> comparisons_beside(const AlignedText& text, size_t i) {
    std::set<std::string> out;
    for (const size_t beside : {i - 1, i + 1})
        if (beside < text.words.size() && is_one_of(text.words[beside], {"==", "!=", "<", ">", "<=", ">="}))
            out.insert(text.words[beside]);
    return out;
}

/// True where the target asks nothing of a name that the source does not ask, `== kNone` where that has it so: another
/// value asked for in another way is another question.
bool are_asked_alike(const AlignedText& source, const AlignedText& target, const std::string& name) {
    std::set<std::string> asked;
    for (size_t i = 0; i < source.words.size(); ++i)
        if (source.words[i] == name) asked.merge(comparisons_beside(source, i));
    for (size_t i = 0; i < target.words.size(); ++i)
        if (target.words[i] == name)
            for (const std::string& comparison : comparisons_beside(target, i))
                if (!asked.contains(comparison)) return false;
    return true;
}

}  // namespace

void Renamings::note(size_t was, size_t is) {
    const std::string &old = texts_.before.words[was], &name = texts_.now.words[is];
    if (several_.contains(old) || !is_throughout(old, name)) return;
    const auto [known, is_new] = renamed_.try_emplace(old, name);
    if (is_new || known->second == name) return;
    renamed_.erase(known);
    several_.insert(old);
}

bool Renamings::is_throughout(const std::string& was, const std::string& is) const {
    if (!is_name(was) || !is_name(is) || !translator_.may_be_renamed(was, is)) return false;
    if (has_word(texts_.now, was) || has_word(texts_.before, is) || !has_word(texts_.target, was) ||
        has_word(texts_.target, is) || !are_asked_alike(texts_.before, texts_.target, was))
        return false;
    for (size_t i = 0; i < texts_.target.words.size(); ++i)
        if (texts_.target.words[i] == was && (uses_.is_local_there(i) || is_picked(texts_.target, i))) return false;
    for (size_t i = 0; i < texts_.now.words.size(); ++i)
        if (texts_.now.words[i] == is && (uses_.is_local(i) || is_picked(texts_.now, i))) return false;
    return true;
}

bool Renamings::has(size_t was, size_t is) const {
    const auto known = renamed_.find(texts_.before.words[was]);
    return known != renamed_.end() && known->second == texts_.now.words[is];
}

void Renamings::add_to(std::vector<WordsReplaced>& replaced) const {
    std::vector<WordsReplaced> more;
    for (size_t i = 0; i < texts_.target.words.size(); ++i) {
        const auto known = renamed_.find(texts_.target.words[i]);
        if (known == renamed_.end()) continue;
        const bool is_done = std::any_of(replaced.begin(), replaced.end(),
                                         [&](const WordsReplaced& one) { return one.first <= i && i < one.end; });
        if (is_done) continue;
        const auto name = std::find(texts_.now.words.begin(), texts_.now.words.end(), known->second);
        const auto from = static_cast<size_t>(name - texts_.now.words.begin());
        more.push_back({i, i + 1, {{known->second, from}}, from, from + 1});
    }
    replaced.insert(replaced.end(), more.begin(), more.end());
}

}  // namespace porttool
