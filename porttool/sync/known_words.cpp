// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/known_words.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/normal/statements.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// How a word begins that belongs to one language's run time; "" for others.
std::string_view runtime_of(std::string_view word) {
    constexpr std::array<std::string_view, 12> kBegin = {"cuda", "CUDA", "cub", "cu", "hip",  "HIP",
                                                         "sycl", "CL_",  "cl_", "rt", "omp_", "__"};
    for (const std::string_view begin : kBegin)
        if (word.starts_with(begin)) return begin;
    return {};
}

/// What every C and C++ has without a word of the project: the headers of their standard libraries.
bool is_standard(std::string_view word) {
    static constexpr std::string_view kWords =
        " std chrono size_t ptrdiff_t int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t uintptr_t NULL "
        "nullptr printf fprintf snprintf sprintf stderr stdout malloc calloc realloc free exit abort assert memcpy "
        "memset memmove memcmp strcmp strncmp strlen atoi atof strtol rand srand abs fabs fabsf sqrt sqrtf pow powf "
        "exp "
        "expf log logf log2 log2f log10 log10f sin sinf cos cosf tan tanf asin asinf acos acosf atan atanf atan2 "
        "atan2f "
        "sinh sinhf cosh coshf tanh tanhf floor floorf ceil ceilf round roundf trunc truncf fmod fmodf fmin fminf fmax "
        "fmaxf hypot hypotf cbrt cbrtf isnan isinf FLT_MAX FLT_MIN FLT_EPSILON DBL_MAX DBL_EPSILON INT_MAX INT_MIN "
        "UINT_MAX M_PI true false bool steady_clock high_resolution_clock duration duration_cast nanoseconds "
        "microseconds milliseconds now count vector array string move max min swap cout cerr endl begin end data size ";
    return kWords.find(" " + std::string(word) + " ") != std::string_view::npos;
}

bool is_capital(std::string_view word) {
    return std::none_of(word.begin(), word.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

/// What words that mean the same share: the dialect's name, or the name without its manner.
std::string meaning_of(std::string_view word, const Dialect& dialect) {
    const std::string* known = dialect.meaning(word);
    return known != nullptr ? "=" + *known : folded(word);
}

}  // namespace

KnownWords::KnownWords(const FilesOfSide& from, const FilesOfSide& to, const Dialect& dialect)
    : from_(from), to_(to), dialect_(dialect) {
    add_known(to.edited, file_words_);
    const LexedText& lexed = to.edited.lexed;
    for (uint32_t i = 0; i + 1 < lexed.tokens.size(); ++i)
        if (lexed.view(i + 1) == "(") called_.insert(lexed.view(i));
    note(to.edited, by_meaning_);
}

void KnownWords::add_known(const ScannedFile& file, std::unordered_set<std::string_view>& words) {
    const LexedText& lexed = file.lexed;
    uint32_t at = 0;
    const auto add_until = [&](uint32_t end, const std::set<std::string, std::less<>>& locals) {
        for (; at < end; ++at) {
            const Token& token = lexed.tokens[at];
            const bool live = token.kind == TokenKind::Identifier && (token.flags & kDead) == 0;
            if (live && !locals.contains(lexed.view(token))) words.insert(lexed.view(token));
        }
    };
    for (const Unit& unit : file.units) {
        if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) continue;
        add_until(std::max(at, unit.tokens.first), {});
        const std::vector<std::string> names = local_names(file, unit);
        add_until(std::max(at, unit.tokens.end), {names.begin(), names.end()});
    }
    add_until(static_cast<uint32_t>(lexed.tokens.size()), {});
}

void KnownWords::note(const ScannedFile& file, std::map<std::string, Uses, std::less<>>& by_meaning) const {
    std::map<std::string_view, size_t> uses;
    for (const Token& token : file.lexed.tokens)
        if (token.kind == TokenKind::Identifier) ++uses[file.lexed.view(token)];
    for (const auto& [word, times] : uses) by_meaning[meaning_of(word, dialect_)][word] += times;
}

std::string KnownWords::usual(const Uses* words) {
    if (words == nullptr) return {};
    size_t all = 0;
    for (const auto& [text, times] : *words) all += times;
    for (const auto& [text, times] : *words)
        if (4 * times >= 3 * all) return std::string(text);
    return {};
}

std::string KnownWords::in_dialect(std::string_view word, bool called) const {
    const std::string* meaning = dialect_.meaning(word);
    if (meaning == nullptr || meaning->empty() || !runtime_of(word).empty()) return {};
    const auto here = by_meaning_.find("=" + *meaning);
    std::string said = usual(here == by_meaning_.end() ? nullptr : &here->second);
    return called_.contains(said) == called ? said : std::string();
}

std::string KnownWords::in_other_manner(std::string_view word) const {
    if (dialect_.meaning(word) != nullptr && from_.edited.language == to_.edited.language) return {};
    const std::string name = folded(word);
    read_all();
    for (const std::map<std::string, Uses, std::less<>>* words : {&by_meaning_, &std::as_const(all_by_meaning_)})
        if (const auto found = words->find(name); found != words->end()) {
            std::string said = usual(&found->second);
            // A macro is no variable of its name.
            return is_capital(said) == is_capital(word) ? said : std::string();
        }
    return {};
}

void KnownWords::read_all() const {
    if (all_read_) return;
    all_read_ = true;
    for (const ScannedFile& file : to_.all) {
        add_known(file, all_words_);
        note(file, all_by_meaning_);
    }
}

/// What the source's side declares: units, macros, variables of files, fields, locals of the edited file.
void KnownWords::read_own() const {
    if (own_read_) return;
    own_read_ = true;
    const auto add_words = [&](const LexedText& lexed, TokenRange range) {
        for (uint32_t i = range.first; i < range.end; ++i)
            if (lexed.tokens[i].kind == TokenKind::Identifier) own_words_.insert(lexed.view(i));
    };
    for (const ScannedFile& file : from_.all) {
        const LexedText& lexed = file.lexed;
        for (const Unit& unit : file.units) {
            if (unit.name_token < lexed.tokens.size()) own_words_.insert(lexed.view(unit.name_token));
            if (unit.kind == UnitKind::Struct) add_words(lexed, unit.tokens);
        }
        for (const FileVariable& variable : file.variables) own_words_.insert(lexed.view(variable.name_token));
        for (const Directive& directive : lexed.directives)
            if (directive.kind == DirectiveKind::Define && directive.first_token + 2 < directive.end_token)
                own_words_.insert(lexed.view(directive.first_token + 2));
    }
    for (const Unit& unit : from_.edited.units) add_words(from_.edited.lexed, unit.parameters);
}

bool KnownWords::is_of_source(std::string_view word) const {
    read_own();
    return own_words_.contains(word);
}

/// True if the target's file has words of that run time.
bool KnownWords::speaks(std::string_view runtime) const {
    return std::any_of(file_words_.begin(), file_words_.end(),
                       [&](std::string_view word) { return runtime_of(word) == runtime; });
}

/// True if the target's file calls the built-ins of the dialect in a scope alone, as `sycl::max`.
bool KnownWords::scopes_builtins() const {
    const LexedText& lexed = to_.edited.lexed;
    size_t scoped = 0;
    for (uint32_t i = 1; i + 1 < lexed.tokens.size(); ++i) {
        if (lexed.tokens[i].kind != TokenKind::Identifier || lexed.view(i + 1) != "(" || is_type_word(lexed.view(i)) ||
            dialect_.meaning(lexed.view(i)) == nullptr || roles_of(lexed.view(i)) != 0)
            continue;
        if (lexed.view(i - 1) != "::") return false;
        ++scoped;
    }
    return scoped > 0;
}

bool KnownWords::anywhere(std::string_view word) const {
    read_all();
    if (all_words_.contains(word)) return true;
    if (is_of_source(word)) return false;
    const Language here = from_.edited.language, there = to_.edited.language;
    if (dialect_.meaning(word) != nullptr && scopes_builtins()) return false;
    if (const std::string_view runtime = runtime_of(word); !runtime.empty() && !speaks(runtime)) return false;
    if (here == there) return true;
    const bool both_c = traits_of(here).literals == Literals::C && traits_of(there).literals == Literals::C;
    return both_c && there != Language::OpenCl && is_standard(word);
}

}  // namespace porttool
