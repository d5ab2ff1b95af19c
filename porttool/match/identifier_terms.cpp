// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/identifier_terms.h"

#include "porttool/language/words.h"
#include "porttool/match/words.h"
#include "porttool/normal/normal_form.h"

namespace porttool {

IdentifierTerms& IdentifierTable::entry(std::string_view text) {
    const uint32_t number = texts_.number(text);
    if (number == entries_.size()) entries_.push_back(read(text));
    return entries_[number];
}

IdentifierTerms IdentifierTable::read(std::string_view text) {
    IdentifierTerms out;
    out.common = dialect_.find(text);
    if (out.common != nullptr) {
        out.kind = out.common->empty() ? IdentifierTerms::Kind::Silent : IdentifierTerms::Kind::Common;
        out.shape = hash_text(*out.common);
        if (!out.common->empty()) out.words.push_back(terms_.id(kBody, *out.common));
    } else if (word_is(text, kShapeWord)) {
        out.kind = IdentifierTerms::Kind::Syntax;
        out.shape = hash_text(text);
    }
    if (out.common == nullptr)
        for (const std::string& word : split_words(text)) out.words.push_back(terms_.id(kBody, word));
    return out;
}

const std::vector<uint32_t>& IdentifierTable::called_words(std::string_view text) {
    IdentifierTerms& known = entry(text);
    if (known.called.empty())
        for (const std::string& word : split_words(text)) known.called.push_back(terms_.id(kCalls, word));
    return known.called;
}

uint32_t IdentifierTable::called_as(std::string_view text) {
    IdentifierTerms& known = entry(text);
    if (known.called_as == TextNumbers::kNone) known.called_as = terms_.id(kCalls, fold(text));
    return known.called_as;
}

}  // namespace porttool
