// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/meaning.h"

#include <algorithm>
#include <array>

#include "porttool/compare/casts.h"
#include "porttool/compare/phrases.h"
#include "porttool/compare/plain_updates.h"
#include "porttool/language/sister_runtime.h"
#include "porttool/language/spelling.h"
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

/// The component of a vector that is named at `i`: `. y`, OpenCL's `. s1`, `[ 1 ]`; "" if none is. An element of an
/// array is read alike: a name that stands for a vector on one side is none for an array on the other.
std::string_view component_at(const Words& tokens, size_t i, Language language) {
    constexpr std::array<std::string_view, 4> kComponents = {"x", "y", "z", "w"};
    const auto number = [&](std::string_view digit) {
        return digit.size() == 1 && digit[0] >= '0' && digit[0] <= '3' ? kComponents.at(digit[0] - '0')
                                                                       : std::string_view();
    };
    if (tokens[i] == "[" && i > 0 && i + 2 < tokens.size() && tokens[i + 2] == "]") return number(tokens[i + 1]);
    const bool is_member = tokens[i] == "." && i + 1 < tokens.size() && tokens[i + 1].size() == 2;
    return is_member && language == Language::OpenCl && tokens[i + 1][0] == 's' ? number(tokens[i + 1].substr(1))
                                                                                : std::string_view();
}

/// `. x ( )`, as SYCL's vectors have it: the component itself.
bool is_accessor(const Words& tokens, size_t i) {
    return tokens[i] == "." && i + 3 < tokens.size() && tokens[i + 1].size() == 1 && tokens[i + 2] == "(" &&
           tokens[i + 3] == ")" && std::string_view("xyzw").find(tokens[i + 1][0]) != std::string_view::npos;
}

/// The closing brackets of `atomic_inc(p)`, which elsewhere is `atomicAdd(p, 1)`.
std::set<size_t> atomic_steps(const Words& tokens) {
    constexpr size_t kLongest = 64;
    std::set<size_t> out;
    for (size_t i = 0; i + 1 < tokens.size(); ++i) {
        const bool is_step = tokens[i] == "atomic_inc" || tokens[i] == "atomic_dec" || tokens[i] == "AtomicInc";
        if (!is_step || tokens[i + 1] != "(") continue;
        int depth = 0;
        for (size_t k = i + 1; k < tokens.size() && k < i + kLongest; ++k) {
            if (tokens[k] == "(" || tokens[k] == "[" || tokens[k] == "{") ++depth;
            if (tokens[k] == ")" || tokens[k] == "]" || tokens[k] == "}") --depth;
            if (depth == 1 && tokens[k] == ",") break;
            if (depth > 0) continue;
            out.insert(k);
            break;
        }
    }
    return out;
}

/// The words of a unit's texts, by how they are used.
struct MemberUses {
    explicit MemberUses(const std::array<const Words*, 2>& texts) {
        for (const Words* text : texts) {
            bool in_head = true;
            for (size_t i = 0; i < text->size(); ++i) {
                const std::string_view word = (*text)[i];
                in_head = in_head && word != "{";
                if (!is_word_token(word)) continue;
                words.insert(word);
                const std::string_view before = i > 0 ? (*text)[i - 1] : std::string_view();
                const std::string_view after = i + 1 < text->size() ? (*text)[i + 1] : std::string_view();
                if (before == "." || before == "->" || before == "::") continue;
                bare.insert(word);
                if (in_head && (after == "," || after == ")")) parameters.insert(word);
                if ((after == "." || after == "->") && i + 2 < text->size()) members_of[word].insert((*text)[i + 2]);
            }
        }
    }

    std::set<std::string_view> words, bare, parameters;  ///< bare: without an object or a scope before them
    std::map<std::string_view, std::set<std::string_view>> members_of;
};

/// `HIPBLAS_OP_N` is `CUBLAS_OP_N`, `HIP_R_16F` is `CUDA_R_16F`.
std::string shouted_runtime_name(std::string_view token) {
    const std::string_view rest = token.substr(3);
    if (rest.starts_with("_")) return "CUDA" + std::string(rest);
    for (const std::string_view library : {"BLAS", "RAND", "FFT", "SPARSE", "SOLVER"})
        if (rest.starts_with(library)) return "CU" + std::string(rest);
    return std::string(token);
}

/// CUDA's driver as HIP has it, which has one name for both: `CUmodule` is `hipModule_t`, `cuModuleGetFunction` is
/// `hipModuleGetFunction`; as the runtime would have it. "" for all other names.
std::string name_of_driver(std::string_view token) {
    constexpr std::string_view kType = "CU", kCall = "cu";
    if (token.size() <= kType.size() + 1) return {};
    const auto is_small = [](char c) { return c >= 'a' && c <= 'z'; };
    const std::string_view rest = token.substr(kType.size());
    if (token.starts_with(kType) && std::all_of(rest.begin(), rest.end(), is_small)) {
        std::string out = "cuda" + std::string(rest) + "_t";
        out[4] = static_cast<char>(out[4] - 'a' + 'A');
        return out;
    }
    const bool calls = token.starts_with(kCall) && rest[0] >= 'A' && rest[0] <= 'Z' && is_small(rest[1]);
    return calls ? "cuda" + std::string(rest) : std::string();
}

/// HIP's names for what CUDA's runtime and libraries have under the same names: `hipMalloc` is `cudaMalloc`.
std::string runtime_name(std::string_view token) {
    constexpr std::string_view kPrefix = "hip";
    if (token.starts_with("HIP")) return shouted_runtime_name(token);
    if (const SisterName* row = sister_name(token); row != nullptr && token == row->hip) return std::string(row->cuda);
    if (token == "cudaMallocHost") return "cudaHostAlloc";  // HIP has one name for both
    if (const std::string name = name_of_driver(token); !name.empty()) return name;
    if (token.size() <= kPrefix.size() || !token.starts_with(kPrefix)) return std::string(token);
    const std::string_view rest = token.substr(kPrefix.size());
    if (rest[0] >= 'A' && rest[0] <= 'Z') return "cuda" + std::string(rest);
    for (const std::string_view library : {"blas", "rand", "fft", "sparse", "solver"})
        if (rest.starts_with(library)) return "cu" + std::string(rest);
    return std::string(token);
}

}  // namespace

Meaning::Meaning(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages, Updates updates)
    : dialect_(dialect), languages_(languages), literals_(Literals::C), updates_(updates) {
    for (const Side side : kBothSides)
        if (traits_of(languages[side]).literals == Literals::Shading) literals_ = Literals::Shading;
    note_names(texts.source_before, Side::Source);
    note_names(texts.source_now, Side::Source);
    note_names(texts.target_before, Side::Target);
    note_names(texts.target_now, Side::Target);
    note_scopes(texts.source_before, texts.target_before);
    for (const Side side : kBothSides) note_objects(texts, side);
    for (const Side side : kBothSides)
        std::erase_if(contexts_[side], [&](std::string_view name) {
            return spellings_[other(side)].contains(folded(runtime_name(name)));
        });
    directed_ = changes_direction(texts.source_before, texts.source_now) ||
                changes_direction(texts.target_before, texts.target_now);
}

void Meaning::note_names(const Words& tokens, Side side) {
    for (const std::string_view token : tokens)
        if (is_word_token(token) && dialect_.meaning(token) == nullptr)
            spellings_[side][folded(runtime_name(token))].insert(token);
    note_vectors(tokens, languages_[side], vectors_[side]);
    counters_[side].note(tokens);
    note_contexts(tokens, contexts_[side]);
    in_order_ = in_order_ || std::find(tokens.begin(), tokens.end(), "in_order") != tokens.end();
    for (auto& [name, scopes] : scopes_in(tokens, dialect_)) scopes_[side][name].insert(scopes.begin(), scopes.end());
}

/// A scope that the port calls otherwise throughout is the same scope.
void Meaning::note_scopes(const Words& source, const Words& target) {
    const auto here = scopes_in(source, dialect_), there = scopes_in(target, dialect_);
    for (const auto& [name, scopes] : here) old_scopes_.source.insert(scopes.begin(), scopes.end());
    for (const auto& [name, scopes] : there) old_scopes_.target.insert(scopes.begin(), scopes.end());
    std::set<std::string_view> ambiguous;
    for (const auto& [name, scopes] : there) {
        const auto found = here.find(name);
        if (found == here.end() || found->second.size() != 1 || scopes.size() != 1) continue;
        const auto known = renamed_.emplace(*scopes.begin(), *found->second.begin());
        if (known.first->second != *found->second.begin()) ambiguous.insert(*scopes.begin());
    }
    for (const std::string_view scope : ambiguous) renamed_.erase(scope);
}

/// A kernel's `hit->t` is `t` in the member function that it ports, and the other way round: so a parameter that the
/// other side does not name, and whose members stand there without an object, as no other name here does.
void Meaning::note_objects(const PairTexts& texts, Side side) {
    const bool source = side == Side::Source;
    const std::array<const Words*, 2> here = {source ? &texts.source_before : &texts.target_before,
                                              source ? &texts.source_now : &texts.target_now};
    const std::array<const Words*, 2> there = {source ? &texts.target_before : &texts.source_before,
                                               source ? &texts.target_now : &texts.source_now};
    const MemberUses uses(here), others(there);
    for (const auto& [object, members] : uses.members_of) {
        if (!uses.parameters.contains(object) || others.words.contains(object)) continue;
        const bool ambiguous = std::any_of(members.begin(), members.end(), [&](std::string_view member) {
            return uses.bare.contains(member) || (others.words.contains(member) && !others.bare.contains(member));
        });
        const bool known = std::any_of(members.begin(), members.end(),
                                       [&](std::string_view member) { return others.bare.contains(member); });
        if (known && !ambiguous) objects_[side].insert(object);
    }
}

bool Meaning::is_implied_object(const Words& tokens, size_t i, Side side) const {
    if (i + 2 >= tokens.size() || (tokens[i + 1] != "." && tokens[i + 1] != "->")) return false;
    if (i > 0 && (tokens[i - 1] == "." || tokens[i - 1] == "->" || tokens[i - 1] == "::")) return false;
    return tokens[i] == "this" || objects_[side].contains(tokens[i]);
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

std::string Meaning::word(std::string_view token, Side side) const {
    const bool narrow = token == "int8" || token == "uint8" || token == "int16" || token == "uint16";
    if (narrow && languages_[side] == Language::Ispc) return word(std::string(token) + "_t", side);
    if (is_number_token(token)) return number(token);
    if (const std::string* known = dialect_.meaning(token)) {
        if (literals_ == Literals::Shading && *known == "fabs") return "abs";
        return known->empty() ? std::string(token) : *known;
    }
    if (!is_word_token(token)) return std::string(token);
    if (side == Side::Target) {
        if (const std::string* name = dialect_.counterpart(token)) return word(*name, Side::Source);
        if (dialect_.has_counterpart(token)) return "the target's " + std::string(token);
    }
    // A name may be spelled after the manner of each side, as long as that leaves no two names alike.
    const std::string name = folded(runtime_name(token));
    for (const Side each : kBothSides)
        if (const auto found = spellings_[each].find(name); found != spellings_[each].end() && found->second.size() > 1)
            return std::string(token);
    return name;
}

std::string Meaning::scoped(std::string_view scope, std::string_view name, Side side) const {
    const auto here = scopes_[side].find(name), there = scopes_[other(side)].find(name);
    const bool is_less_exact = names_precision(scope) && !old_scopes_[side].contains(scope);
    const bool counts = (here != scopes_[side].end() && here->second.size() > 1) ||
                        there != scopes_[other(side)].end() || is_less_exact;
    if (scope.empty() || !counts) return word(name, side);
    const auto renamed = renamed_.find(scope);
    return word(side == Side::Target && renamed != renamed_.end() ? renamed->second : scope, side) +
           "::" + word(name, side);
}

std::vector<std::string> Meaning::in_one_manner(const std::vector<std::string>& words) const {
    std::vector<std::string> out = with_plain_limits(words, number("0.0f"), number("1.0f"));
    write_plain_update(out);
    return out;
}

std::vector<std::string> Meaning::translate(const Words& statement, Side side, bool in_body, bool* has_updates) const {
    Words tokens = with_one_word_types(statement);
    write_plain_components(tokens, vectors_[side]);
    const bool of_context = !tokens.empty() && contexts_[side].contains(tokens[0]);
    drop_contexts(tokens, contexts_[side]);
    const std::set<size_t> steps = atomic_steps(tokens);
    std::vector<std::string> out;
    if (in_body)
        if (const std::string storage = storage_of(tokens); !storage.empty()) out.push_back(storage);
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i] == "::" || (in_body && tokens[i] == "groupshared")) continue;
        if (!in_body && names_inlining(tokens[i]) && (i + 1 == tokens.size() || tokens[i + 1] != "(")) continue;
        if (const std::string_view component = component_at(tokens, i, languages_[side]); !component.empty()) {
            out.insert(out.end(), {".", std::string(component)});
            i += tokens[i] == "[" ? 2 : 1;
            continue;
        }
        if (is_accessor(tokens, i)) {
            out.insert(out.end(), {".", std::string(tokens[i + 1])});
            i += 3;
            continue;
        }
        if (!is_word_token(tokens[i])) {
            if (steps.contains(i)) out.insert(out.end(), {",", "1"});
            out.push_back(word(tokens[i], side));
            continue;
        }
        if (is_implied_object(tokens, i, side)) {
            ++i;
            continue;
        }
        const Chain chain = chain_at(tokens, i, dialect_);
        i = chain.last;
        const std::string* known = dialect_.meaning(tokens[i]);
        if (known != nullptr && known->empty() && chain.scope.empty() && is_qualifier(tokens, i)) continue;
        out.push_back(scoped(chain.scope, tokens[i], side));
    }
    out = with_functional_casts(with_constructed_literals(out), dialect_);
    out = with_common_phrases(with_plain_launches(without_idle_parentheses(out)));
    drop_status_check(out);
    write_plain_barrier(out);
    drop_cast_to_declared_type(out);
    write_steps_first(out);
    counters_[side].write_plain(out);
    if (updates_ == Updates::InOneManner)
        out = in_one_manner(out);
    else if (has_updates != nullptr && !*has_updates)
        *has_updates = in_one_manner(out) != out;
    write_plain_transfer(out, {of_context, in_order_, directed_});
    return out;
}

}  // namespace porttool
