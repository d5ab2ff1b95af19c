// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/symbols.h"

#include <algorithm>

#include "metrics/code/winnowing.h"
#include "porttool/language/words.h"
#include "porttool/normal/normal_form.h"

namespace porttool {
namespace {

constexpr uint32_t kAnyName = 0;

}  // namespace

std::vector<PlacedToken> SymbolTable::place(const Passage& passage) {
    std::vector<PlacedToken> out;
    for (uint32_t at = 0; at < passage.size(); ++at) {
        const LexedText& lexed = passage[at].file->lexed;
        bool first = true;
        for (const TokenRange& stretch : code_stretches(passage[at])) {
            for (uint32_t index = stretch.first; index < stretch.end; ++index) {
                const Token& token = lexed.tokens[index];
                out.push_back({at, token.line, word(lexed.view(token), token.kind), first});
                first = false;
            }
        }
    }
    return out;
}

SymbolSequence SymbolTable::sequence(const std::vector<PlacedToken>& tokens, Vocabulary vocabulary,
                                     uint32_t side) const {
    SymbolSequence out;
    const auto excerpts =
        std::count_if(tokens.begin(), tokens.end(), [](const PlacedToken& t) { return t.starts_run; });
    out.symbols.resize(tokens.size() + static_cast<size_t>(excerpts));
    out.tokens.resize(out.symbols.size());
    uint32_t separator = kNothing - 1 - side, run = 0;  // far above metrics::FIRST_SEPARATOR
    size_t count = 0;
    const auto put = [&, symbols = out.symbols.data(), places = out.tokens.data()](uint32_t symbol, uint32_t token) {
        symbols[count] = symbol;
        places[count++] = token;
    };
    const auto add = [&](uint32_t symbol, uint32_t token) {
        put(symbol, token);
        ++out.token_count;
        out.longest_run = std::max(out.longest_run, ++run);
    };
    for (uint32_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].starts_run && count > 0) {
            put(separator, kNoToken);
            separator -= 2;
            run = 0;
        }
        const Word& word = words_[tokens[i].word];
        if (vocabulary == Vocabulary::Raw) {
            add(word.raw, i);
            continue;
        }
        if (word.scope) continue;  // scopes come and go: a::b is b
        const bool is_scope =
            word.name && i + 1 < tokens.size() && !tokens[i + 1].starts_run && words_[tokens[i + 1].word].scope;
        const uint32_t symbol = vocabulary == Vocabulary::Blind ? word.blind : word.dialect;
        if (!is_scope && symbol != kNothing) add(symbol, i);
    }
    out.symbols.resize(count);
    out.tokens.resize(count);
    return out;
}

bool SymbolTable::has_moved_word(const std::vector<PlacedToken>& tokens) const {
    return std::any_of(tokens.begin(), tokens.end(),
                       [this](const PlacedToken& token) { return words_[token.word].moved; });
}

/// `moved` becomes true where the number is not made of the text alone.
uint32_t SymbolTable::number(std::string_view text, bool& moved) {
    const uint32_t place = texts_.number(text);
    if (place < numbers_.size()) {
        moved |= moved_[place];
        return numbers_[place];
    }
    constexpr uint32_t kLargest = metrics::FIRST_SEPARATOR - 1;
    uint32_t number = static_cast<uint32_t>(hash_text(text)) & kLargest;
    moved_.push_back(false);
    for (; number == kAnyName || taken_.number(number, place) != place; number = (number + 1) & kLargest)
        moved_.back() = moved_.back() || number != kAnyName;
    moved |= moved_.back();
    numbers_.push_back(number);
    return number;
}

uint32_t SymbolTable::word(std::string_view text, TokenKind kind) {
    const uint32_t place = known_.number(text);
    if (place < words_.size()) return place;
    Word word;
    word.name = kind == TokenKind::Identifier;
    word.scope = text == "::";
    word.raw = number(text, word.moved);
    const std::string* known = dialect_.find(text);
    if (known != nullptr)
        word.dialect = known->empty() ? kNothing : number(*known, word.moved);
    else
        word.dialect = kind == TokenKind::Number ? number(number_value(text), word.moved) : word.raw;
    const bool folds = word.name && known == nullptr && !word_is(text, kKeyword);
    word.blind = folds ? kAnyName : word.dialect;
    words_.push_back(word);
    return place;
}

}  // namespace porttool
