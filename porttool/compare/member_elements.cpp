// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/member_elements.h"

#include <set>

namespace porttool {
namespace {

using NamedParts = std::map<std::string_view, std::vector<std::string_view>>;

/// The members that a text names of each name, in order; of what is reached in other ways as well none.
NamedParts members_in(const Words& text) {
    NamedParts out;
    std::set<std::string_view> others;
    for (size_t i = 0; i + 1 < text.size(); ++i) {
        const bool reaches = i + 2 < text.size() && (text[i + 1] == "." || text[i + 1] == "->");
        if (reaches && is_word_token(text[i]) && is_word_token(text[i + 2]) && !(i > 0 && text[i - 1] == "."))
            out[text[i]].push_back(text[i + 2]);
        else if (text[i + 1] == "[")
            others.insert(text[i]);
    }
    for (const std::string_view name : others) out.erase(name);
    return out;
}

bool is_element(const Words& text, size_t i) {
    return i + 3 < text.size() && is_word_token(text[i]) && text[i + 1] == "[" && is_number_token(text[i + 2]) &&
           text[i + 3] == "]" && !(i > 0 && (text[i - 1] == "." || text[i - 1] == "->"));
}

/// The same of elements that are picked by a number.
NamedParts elements_in(const Words& text) {
    NamedParts out;
    std::set<std::string_view> others;
    for (size_t i = 0; i + 1 < text.size(); ++i) {
        if (is_element(text, i))
            out[text[i]].push_back(text[i + 2]);
        else if (text[i + 1] == "[" || text[i + 1] == "." || text[i + 1] == "->")
            others.insert(text[i]);
    }
    for (const std::string_view name : others) out.erase(name);
    return out;
}

/// The member for each element, if it is always the same.
std::map<std::string_view, std::string_view> held(const std::vector<std::string_view>& members,
                                                  const std::vector<std::string_view>& elements) {
    std::map<std::string_view, std::string_view> by_element, by_member;
    if (members.size() != elements.size()) return {};
    for (size_t i = 0; i < members.size(); ++i) {
        if (by_element.emplace(elements[i], members[i]).first->second != members[i]) return {};
        if (by_member.emplace(members[i], elements[i]).first->second != elements[i]) return {};
    }
    return by_element.size() > 1 ? by_element : std::map<std::string_view, std::string_view>();
}

}  // namespace

MemberElements::MemberElements(const PairTexts& texts) {
    const auto note = [&](const Words& with_members, const Words& with_elements) {
        const NamedParts elements = elements_in(with_elements);
        if (elements.empty()) return;
        const NamedParts members = members_in(with_members);
        for (const auto& [name, numbers] : elements)
            if (const auto there = members.find(name); there != members.end())
                for (const auto& [number, member] : held(there->second, numbers))
                    members_.emplace(std::pair(name, number), member);
    };
    note(texts.source_before, texts.target_before);
    note(texts.target_before, texts.source_before);
}

std::vector<std::string> MemberElements::written(const Words& text) const {
    std::vector<std::string> out;
    out.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        const auto member = is_element(text, i) ? members_.find({text[i], text[i + 2]}) : members_.end();
        out.emplace_back(text[i]);
        if (member == members_.end()) continue;
        out.emplace_back(".");
        out.emplace_back(member->second);
        i += 3;
    }
    return out;
}

}  // namespace porttool
