// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/meaning.h"

#include "porttool/compare/casts.h"
#include "porttool/language/words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

/// Qualifiers that are keywords or reserved names wherever they occur. The others (`in`, `buffer`, `local`) are
/// variables elsewhere, and qualifiers only before another word.
bool is_reserved(std::string_view word) { return word.starts_with("__") || word_is(word, kReserved); }

bool is_qualifier(const Words& tokens, size_t i) {
    if (is_reserved(tokens[i])) return true;
    const bool before_word = i + 1 < tokens.size() && is_word_token(tokens[i + 1]);
    const bool layout = tokens[i] == "layout" && i + 1 < tokens.size() && tokens[i + 1] == "(";
    const bool after_head = tokens[i] == "final" && i > 0 && tokens[i - 1] == ")";
    return before_word || layout || after_head || tokens[i] == "maybe_unused";
}

/// What `static` and the like say about a variable: where it lives. "" if the statement declares none with storage of
/// its own: a pointer's address space has no counterpart elsewhere, and a static constant is a constant.
std::string storage_of(const Words& tokens) {
    std::string storage;
    for (size_t i = 0; i + 1 < tokens.size() && is_word_token(tokens[i]); ++i) {
        if (word_is(tokens[i], kConstantStorage)) return "";
        if (word_is(tokens[i], kSharedStorage) && is_word_token(tokens[i + 1])) storage = "shared";
        if (tokens[i] == "static" && storage.empty()) storage = "static";
    }
    for (const std::string_view token : tokens) {
        if (token == "*" || token == "&") return "";
        if (token == "=" || token == "[" || token == "(") break;
    }
    return storage;
}

/// The chain of scopes that starts at `i`: where it ends, and the innermost scope that counts.
struct Chain {
    size_t last;
    std::string_view scope;
};

Chain chain_at(const Words& tokens, size_t i, const Dialect& dialect) {
    Chain chain{i, ""};
    while (chain.last + 2 < tokens.size() && tokens[chain.last + 1] == "::" && is_word_token(tokens[chain.last + 2])) {
        const std::string* known = dialect.meaning(tokens[chain.last]);
        chain.scope = known != nullptr && known->empty() ? std::string_view() : tokens[chain.last];
        chain.last += 2;
    }
    return chain;
}

std::map<std::string_view, std::set<std::string_view>> scopes_in(const Words& tokens, const Dialect& dialect) {
    std::map<std::string_view, std::set<std::string_view>> out;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (!is_word_token(tokens[i])) continue;
        const Chain chain = chain_at(tokens, i, dialect);
        if (!chain.scope.empty()) out[tokens[chain.last]].insert(chain.scope);
        i = chain.last;
    }
    return out;
}

}  // namespace

Meaning::Meaning(const PairTexts& texts, const Dialect& dialect, Literals literals)
    : dialect_(dialect), literals_(literals) {
    note_names(texts.source_before, Side::Source);
    note_names(texts.source_now, Side::Source);
    note_names(texts.target_before, Side::Target);
    note_names(texts.target_now, Side::Target);
    note_scopes(texts.source_before, texts.target_before);
}

void Meaning::note_names(const Words& tokens, Side side) {
    for (const std::string_view token : tokens)
        if (is_word_token(token) && dialect_.meaning(token) == nullptr) spellings_[side][folded(token)].insert(token);
    for (auto& [name, scopes] : scopes_in(tokens, dialect_)) scopes_[side][name].insert(scopes.begin(), scopes.end());
}

/// A scope that the port calls otherwise throughout is the same scope.
void Meaning::note_scopes(const Words& source, const Words& target) {
    const auto here = scopes_in(source, dialect_), there = scopes_in(target, dialect_);
    std::set<std::string_view> ambiguous;
    for (const auto& [name, scopes] : there) {
        const auto found = here.find(name);
        if (found == here.end() || found->second.size() != 1 || scopes.size() != 1) continue;
        const auto known = renamed_.emplace(*scopes.begin(), *found->second.begin());
        if (known.first->second != *found->second.begin()) ambiguous.insert(*scopes.begin());
    }
    for (const std::string_view scope : ambiguous) renamed_.erase(scope);
}

std::string Meaning::number(std::string_view token) const {
    std::string text = normal_number(token);
    const bool hexadecimal = token.starts_with("0x") || token.starts_with("0X");
    std::string suffix;
    while (!text.empty() && std::string_view("fulh").find(text.back()) != std::string_view::npos) {
        suffix += text.back();
        text.pop_back();
    }
    const bool real = text.find_first_of(".en") != std::string::npos ||
                      (!hexadecimal && suffix.find_first_of("fh") != std::string::npos);
    if (!real) return text;  // an integer's suffix is a matter of the dialect
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return literals_ == Literals::C ? text + suffix : text;
}

std::string Meaning::word(std::string_view token) const {
    if (is_number_token(token)) return number(token);
    if (const std::string* known = dialect_.meaning(token)) {
        if (literals_ == Literals::Shading && *known == "fabs") return "abs";
        return known->empty() ? std::string(token) : *known;
    }
    if (!is_word_token(token)) return std::string(token);
    // A name may be spelled after the manner of each side, as long as that leaves no two names alike.
    const std::string name = folded(token);
    for (const Side side : kBothSides)
        if (const auto found = spellings_[side].find(name); found != spellings_[side].end() && found->second.size() > 1)
            return std::string(token);
    return name;
}

std::string Meaning::scoped(std::string_view scope, std::string_view name, Side side) const {
    const auto here = scopes_[side].find(name), there = scopes_[other(side)].find(name);
    const bool counts = (here != scopes_[side].end() && here->second.size() > 1) || there != scopes_[other(side)].end();
    if (scope.empty() || !counts) return word(name);
    const auto renamed = renamed_.find(scope);
    return word(side == Side::Target && renamed != renamed_.end() ? renamed->second : scope) + "::" + word(name);
}

std::vector<std::string> Meaning::translate(const Words& statement, Side side, bool in_body) const {
    const Words tokens = with_one_word_types(statement);
    std::vector<std::string> out;
    if (in_body)
        if (const std::string storage = storage_of(tokens); !storage.empty()) out.push_back(storage);
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i] == "::" || (in_body && tokens[i] == "groupshared")) continue;
        if (!is_word_token(tokens[i])) {
            out.push_back(word(tokens[i]));
            continue;
        }
        const Chain chain = chain_at(tokens, i, dialect_);
        i = chain.last;
        const std::string* known = dialect_.meaning(tokens[i]);
        if (known != nullptr && known->empty() && chain.scope.empty() && is_qualifier(tokens, i)) continue;
        out.push_back(scoped(chain.scope, tokens[i], side));
    }
    return with_functional_casts(out, dialect_);
}

}  // namespace porttool
