// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/known_words.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "porttool/language/sister_runtime.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/normal/statements.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/call_sites.h"
#include "porttool/sync/examples.h"
#include "porttool/sync/text_literals.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

/// True for a name of one of the libraries that CUDA comes with.
bool is_of_library(std::string_view word) {
    constexpr std::array<std::string_view, 9> kLibraries = {"cublas", "cufft",    "curand",  "cusparse", "cusolver",
                                                            "cudnn",  "cutensor", "cutlass", "curtc"};
    return std::any_of(kLibraries.begin(), kLibraries.end(),
                       [&](std::string_view library) { return word.starts_with(library); });
}

/// How a word begins that belongs to one language's run time; "" for others. Of what begins with few letters, the rest
/// has to look like it: `cuInit` and `cublasCreate`, and not `current` and `cubic`.
std::string_view runtime_of(std::string_view word) {
    constexpr std::array<std::string_view, 9> kBegin = {"cuda", "CUDA", "hip",  "HIP", "sycl",
                                                        "CL_",  "cl_",  "omp_", "__"};
    for (const std::string_view begin : kBegin)
        if (word.starts_with(begin)) return begin;
    if (is_of_library(folded(word))) return "cu";
    if (word == "cub") return "cub";
    for (const std::string_view begin : {"cu", "rt"})
        if (word.starts_with(begin) && word.size() > begin.size() && is_capital_letter(word[begin.size()]))
            return begin;
    return {};
}

/// What every C and C++ has without a word of the project: the headers of their standard libraries, and of POSIX.
bool is_standard(std::string_view word) {
    static constexpr std::string_view kWords =
        " std chrono size_t ssize_t ptrdiff_t int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t "
        "intptr_t uintptr_t NULL nullptr nullptr_t static_cast reinterpret_cast const_cast decltype printf "
        "fprintf snprintf sprintf sscanf puts putchar fputs fputc fopen fclose fread fwrite fgets fseek ftell "
        "fflush perror FILE stderr stdout stdin EOF malloc calloc realloc free exit abort assert getenv "
        "EXIT_SUCCESS EXIT_FAILURE errno memcpy memset memmove memcmp strcmp strncmp strlen strcpy strncpy "
        "strcat strchr strrchr strstr strtok strdup strerror atoi atol atoll atof strtol strtoul strtod strtof "
        "isdigit isspace isalpha isalnum toupper tolower offsetof rand srand RAND_MAX abs labs fabs fabsf sqrt "
        "sqrtf pow powf exp expf exp2 exp2f expm1 log1p log logf log2 log2f log10 log10f sin sinf cos cosf tan "
        "tanf asin asinf acos acosf atan atanf atan2 atan2f sinh sinhf cosh coshf tanh tanhf floor floorf ceil "
        "ceilf round roundf lround rint trunc truncf fmod fmodf fmin fminf fmax fmaxf hypot hypotf cbrt cbrtf "
        "erf erff erfc erfcf tgamma lgamma copysign copysignf isnan isinf isfinite NAN INFINITY HUGE_VAL "
        "FLT_MAX FLT_MIN FLT_EPSILON DBL_MAX DBL_MIN DBL_EPSILON CHAR_BIT INT_MAX INT_MIN UINT_MAX LONG_MAX "
        "LLONG_MAX ULLONG_MAX SIZE_MAX INT32_MAX INT64_MAX UINT8_MAX UINT32_MAX UINT64_MAX M_PI M_E M_SQRT2 "
        "true false bool va_list va_start va_end time time_t clock clock_t CLOCKS_PER_SEC timeval timespec "
        "gettimeofday clock_gettime CLOCK_MONOTONIC tv_sec tv_usec tv_nsec steady_clock system_clock "
        "high_resolution_clock time_point duration duration_cast milliseconds microseconds nanoseconds now "
        "time_since_epoch count vector array string pair tuple make_pair make_tuple unique_ptr shared_ptr "
        "make_unique make_shared numeric_limits initializer_list move forward max min swap accumulate to_string "
        "cout cerr endl setw setprecision ifstream ofstream stringstream getline begin end data size push_back "
        "emplace_back c_str ";
    return kWords.find(" " + std::string(word) + " ") != std::string_view::npos;
}

/// The types that C has of itself, under one name in all that grew from it.
bool is_built_in_type(std::string_view word) {
    static constexpr std::string_view kTypes = " void bool char short int long float double signed unsigned ";
    return kTypes.find(" " + std::string(word) + " ") != std::string_view::npos;
}

/// What shading languages and OpenCL have for numbers and vectors alike, under one name in all of them.
bool is_shader_function(std::string_view word, Language language) {
    static constexpr std::string_view kFunctions =
        " sign floor ceil trunc fma min max clamp mix step smoothstep length distance dot cross normalize pow exp exp2 "
        "log log2 sqrt sin cos tan asin acos radians degrees round sinh cosh tanh ";
    // OpenCL has C's under C's names.
    static constexpr std::string_view kMathOfC =
        " fabs fmod rint atan atan2 asinh acosh atanh fmin fmax hypot cbrt exp10 expm1 log10 log1p erf erfc tgamma "
        "lgamma "
        "copysign ldexp remainder isnan isinf isfinite ";
    if (word == "atan2") return language == Language::OpenCl || language == Language::Metal;
    if (language != Language::OpenCl && language != Language::Glsl && language != Language::Metal) return false;
    const std::string name = " " + std::string(word) + " ";
    return kFunctions.find(name) != std::string_view::npos ||
           (language == Language::OpenCl && kMathOfC.find(name) != std::string_view::npos);
}

/// What a kernel asks its language about the threads that run it: a language has its own, and no header.
bool is_of_threads(std::string_view word) {
    return is_one_of(word, {"warpSize", "threadIdx", "blockIdx", "blockDim", "gridDim", "clock64"}) ||
           word.starts_with("gl_") || word.starts_with("get_global_") || word.starts_with("get_local_") ||
           word.starts_with("get_group_") || word.starts_with("get_num_") || word.starts_with("get_sub_group");
}

/// What CUDA has of the threads of a warp, by their mask; HIP has most of it in no release or in late ones.
bool is_of_warps(std::string_view word) {
    return word == "__syncwarp" || word == "__activemask" || (word.starts_with("__") && word.ends_with("_sync"));
}

bool is_capital(std::string_view word) {
    return std::none_of(word.begin(), word.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

/// What words that mean the same share: the dialect's name, or the name without its manner.
std::string meaning_of(std::string_view word, const Dialect& dialect) {
    const std::string* known = dialect.meaning(word);
    return known != nullptr ? "=" + *known : folded(word);
}

void add_identifiers(const LexedText& lexed, TokenRange range, SideWords::Words& words) {
    for (uint32_t i = range.first; i < range.end; ++i)
        if (lexed.tokens[i].kind == TokenKind::Identifier) words.insert(lexed.view(i));
}

/// True for `std`, `chrono` and `seconds` of `std :: chrono :: seconds`, which is used there and not declared.
bool is_in_scope(const LexedText& lexed, uint32_t i) {
    return (i > 0 && lexed.view(i - 1) == "::") || (i + 1 < lexed.tokens.size() && lexed.view(i + 1) == "::");
}

/// The words of a struct, but for what is defined within it.
void add_members(const LexedText& lexed, const Unit& record, SideWords::Words& words) {
    uint32_t at = record.tokens.first;
    const auto add_until = [&](uint32_t end) {
        for (; at < end; ++at)
            if (lexed.tokens[at].kind == TokenKind::Identifier && !is_in_scope(lexed, at)) words.insert(lexed.view(at));
    };
    for (const TokenRange& hole : record.holes) {
        add_until(hole.first);
        at = hole.end;
    }
    add_until(record.tokens.end);
}

}  // namespace

void SideWords::add_known(const ScannedFile& file, Words& words) {
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

void SideWords::add_bare(const ScannedFile& file, Words& words) {
    const LexedText& lexed = file.lexed;
    Words fields;
    std::vector<bool> within(lexed.tokens.size(), false);  // structs, without what is defined in them
    for (const Unit& unit : file.units) {
        if (unit.name_token < lexed.tokens.size()) words.insert(lexed.view(unit.name_token));
        if (unit.kind != UnitKind::Struct || unit.tokens.empty()) continue;
        bool lists = false;  // an `enum` does
        for (uint32_t i = unit.tokens.first; i < unit.name_token && i < unit.tokens.end; ++i)
            lists |= lexed.view(i) == "enum";
        if (lists) continue;
        add_identifiers(lexed, unit.body, fields);
        std::fill(within.begin() + unit.tokens.first, within.begin() + unit.tokens.end, true);
    }
    uint32_t at = 0;
    const auto add_until = [&](uint32_t end, const std::set<std::string, std::less<>>& locals, bool in_function) {
        for (; at < end; ++at) {
            const Token& token = lexed.tokens[at];
            if (token.kind != TokenKind::Identifier || (token.flags & kDead) != 0) continue;
            const std::string_view word = lexed.view(token);
            const bool picked = at > 0 && (lexed.view(at - 1) == "." || lexed.view(at - 1) == "->");
            if (in_function ? !picked && !locals.contains(word) && !fields.contains(word) : !within[at])
                words.insert(word);
        }
    };
    for (const Unit& unit : file.units) {
        if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) continue;
        add_until(std::max(at, unit.tokens.first), {}, false);
        const std::vector<std::string> names = local_names(file, unit);
        add_until(std::max(at, unit.tokens.end), {names.begin(), names.end()}, true);
    }
    add_until(static_cast<uint32_t>(lexed.tokens.size()), {}, false);
}

const SideWords::Words& SideWords::bare() const {
    if (bare_read_) return bare_;
    bare_read_ = true;
    for (const ScannedFile& file : files_) add_bare(file, bare_);
    return bare_;
}

void SideWords::note(const ScannedFile& file, const Dialect& dialect, ByMeaning& by_meaning) {
    std::map<std::string_view, size_t> uses;
    for (const Token& token : file.lexed.tokens)
        if (token.kind == TokenKind::Identifier) ++uses[file.lexed.view(token)];
    for (const auto& [word, times] : uses) by_meaning[meaning_of(word, dialect)][word] += times;
}

void SideWords::read() const {
    if (read_) return;
    read_ = true;
    for (const ScannedFile& file : files_) {
        add_known(file, known_);
        note(file, dialect_, by_meaning_);
    }
}

const SideWords::Words& SideWords::known() const {
    read();
    return known_;
}

const SideWords::ByMeaning& SideWords::by_meaning() const {
    read();
    return by_meaning_;
}

const SideWords::Words& SideWords::declared() const {
    if (declared_read_) return declared_;
    declared_read_ = true;
    for (const ScannedFile& file : files_) {
        const LexedText& lexed = file.lexed;
        for (const Unit& unit : file.units) {
            if (unit.name_token < lexed.tokens.size()) declared_.insert(lexed.view(unit.name_token));
            if (unit.kind == UnitKind::Struct) add_members(lexed, unit, declared_);
        }
        for (const FileVariable& variable : file.variables) declared_.insert(lexed.view(variable.name_token));
        for (const Directive& directive : lexed.directives)
            if (directive.kind == DirectiveKind::Define && directive.first_token + 2 < directive.end_token)
                declared_.insert(lexed.view(directive.first_token + 2));
    }
    return declared_;
}

KnownWords::KnownWords(const WordsOfSide& from, const WordsOfSide& to, const Dialect& dialect)
    : from_(from), to_(to), dialect_(dialect), launches_(launch_manner(to.edited)) {
    SideWords::add_known(to.edited, file_words_);
    const LexedText& lexed = to.edited.lexed;
    for (uint32_t i = 0; i + 1 < lexed.tokens.size(); ++i)
        if (lexed.view(i + 1) == "(") called_.insert(lexed.view(i));
    SideWords::note(to.edited, dialect, by_meaning_);
    for (const Unit& unit : from.edited.units)
        for (const TokenRange& parameter : parameters_of_head(from.edited, unit)) add_name(parameter);
}

/// What a parameter is called: its last name. Its type may be from elsewhere.
void KnownWords::add_name(TokenRange parameter) {
    const LexedText& lexed = from_.edited.lexed;
    for (uint32_t i = parameter.end; i-- > parameter.first;)
        if (lexed.tokens[i].kind == TokenKind::Identifier) {
            parameters_.insert(lexed.view(i));
            return;
        }
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
    // GLSL alone says `atan` of two numbers.
    if (word == "atan2" && to_.edited.language != Language::Glsl) return {};
    const auto here = by_meaning_.find("=" + *meaning);
    std::string said = usual(here == by_meaning_.end() ? nullptr : &here->second);
    return called_.contains(said) == called ? said : std::string();
}

std::string KnownWords::in_other_manner(std::string_view word) const {
    if (dialect_.meaning(word) != nullptr && from_.edited.language == to_.edited.language) return {};
    const std::string name = folded(word);
    for (const SideWords::ByMeaning* words : {&by_meaning_, &to_.all.by_meaning()})
        if (const auto found = words->find(name); found != words->end()) {
            std::string said = usual(&found->second);
            // A macro is no variable of its name, and where the source has both they are two things.
            const bool is_another = said != word && is_in_source_file(said);
            return is_capital(said) == is_capital(word) && !is_another ? said : std::string();
        }
    return {};
}

bool KnownWords::is_in_source_file(std::string_view word) const {
    const LexedText& lexed = from_.edited.lexed;
    return std::any_of(lexed.tokens.begin(), lexed.tokens.end(), [&](const Token& token) {
        return token.kind == TokenKind::Identifier && lexed.view(token) == word;
    });
}

bool KnownWords::is_only_local(std::string_view word) const {
    if (stands_bare(word)) return false;
    const auto found = to_.all.by_meaning().find(meaning_of(word, dialect_));
    return found != to_.all.by_meaning().end() && found->second.contains(word);
}

bool KnownWords::is_of_source(std::string_view word) const {
    return !is_type_word(word) && (parameters_.contains(word) || from_.all.declared().contains(word));
}

bool KnownWords::is_standard_method(std::string_view word) const {
    return are_both_cpp() && has_std() && is_standard(word) && !from_.all.declared().contains(word);
}

bool KnownWords::is_qualifier_of_both(std::string_view word) const {
    if (!are_both_cpp()) return false;
    if (to_.edited.language != Language::C && is_one_of(word, {"constexpr", "typename"})) return true;
    return is_one_of(word, {"const", "static", "inline", "volatile", "__restrict", "__restrict__"});
}

bool KnownWords::is_declared_nowhere(std::string_view word) const {
    return !is_of_source(word) && !is_declared_there(word) && dialect_.meaning(word) == nullptr && !is_standard(word);
}

bool KnownWords::is_from_elsewhere(std::string_view word) const {
    constexpr std::array<std::string_view, 8> kOfOneRuntime = {"cuda",   "hip",  "sycl", "gpu",
                                                               "opencl", "dpct", "nv",   "stream"};
    if (is_of_threads(word)) return false;
    const std::string name = folded(word);
    for (const std::string_view part : kOfOneRuntime)
        if (name.find(part) != std::string::npos) return false;
    if (is_of_library(name)) return false;
    return is_declared_nowhere(word) && runtime_of(word).empty();
}

bool KnownWords::marks_reals() const {
    if (!there().is_of_devices) return false;
    size_t marked = 0;
    for (const Token& token : to_.edited.lexed.tokens) {
        if (token.kind != TokenKind::Number) continue;
        const std::string number(to_.edited.lexed.view(token));
        if (Examples::marked(number) != number) return false;
        marked += number.ends_with('f') && !number.starts_with("0x");
    }
    constexpr size_t kFewest = 3;
    return marked >= kFewest;
}

bool KnownWords::names_one_side(std::string_view literal) const {
    static constexpr std::string_view kPlatforms =
        " cuda hip rocm sycl dpcpp opencl openmp openacc kokkos metal vulkan ispc optix ";
    const std::vector<std::string> here = small_words_of(from_.edited.path), there = small_words_of(to_.edited.path);
    const auto has = [](const std::vector<std::string>& words, const std::string& word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    constexpr size_t kShortest = 3;
    for (const std::string& word : small_words_of(literal)) {
        const bool is_function = word.starts_with("cuda") && !has(there, "cuda");  // `cudaHostAlloc`
        const bool is_platform =
            kPlatforms.find(" " + word + " ") != std::string_view::npos || is_of_library(word) || is_function;
        if (word.size() >= kShortest && !has(there, word) && (is_platform || has(here, word))) return true;
    }
    return false;
}

/// Any file may ask for a macro that no file of either side defines: it comes from the build, or the compiler.
bool KnownWords::is_macro_of_build(std::string_view word) const { return is_from_elsewhere(word) && is_capital(word); }

/// `cudaFree` is `hipFree`: HIP has CUDA's run time under names of its own.
std::string KnownWords::in_sister_runtime(std::string_view word) const {
    const auto is_of = [](std::string_view name, std::string_view begin) {
        return name.size() > begin.size() && name.starts_with(begin) && name[begin.size()] >= 'A' &&
               name[begin.size()] <= 'Z';
    };
    const std::string_view here = is_of(word, "cuda") ? "cuda" : is_of(word, "hip") ? "hip" : "";
    const std::string_view there = here == "cuda" ? "hip" : "cuda";
    if (here.empty()) return {};
    const auto has = [&](std::string_view begin) {
        return std::any_of(file_words_.begin(), file_words_.end(),
                           [&](std::string_view name) { return is_of(name, begin); });
    };
    if (!has(there) || has(here)) return {};
    if (const SisterName* row = sister_name(word); row != nullptr)
        return here == "cuda" ? std::string(row->hip) : row->is_only_one ? std::string(row->cuda) : std::string();
    return std::string(there) + std::string(word.substr(here.size()));
}

std::vector<std::string> KnownWords::scope_of_builtins(const std::vector<std::string>& words) const {
    std::optional<std::vector<std::string>> scope;
    for (size_t i = 1; i + 1 < words.size(); ++i) {
        if (words[i + 1] != "(" || !is_word_token(words[i]) || is_one_of(words[i - 1], {".", "->"}) ||
            !is_builtin(words[i]))
            continue;
        size_t first = i;
        while (first > 1 && words[first - 1] == "::" && is_word_token(words[first - 2])) first -= 2;
        std::vector<std::string> one(words.begin() + static_cast<std::ptrdiff_t>(first),
                                     words.begin() + static_cast<std::ptrdiff_t>(i));
        if (one.empty() || (scope && *scope != one)) return {};
        scope = std::move(one);
    }
    return scope.value_or(std::vector<std::string>());
}

bool KnownWords::is_builtin(const std::string& word) const {
    const std::string* meaning = dialect_.meaning(word);
    return meaning != nullptr && !meaning->empty() && !is_type_word(word) && roles_of(word) == 0 &&
           !is_declared_there(word);
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
        // What C has without a scope C++ has in `std` as well.
        scoped += i < 2 || lexed.view(i - 2) != "std" ? 1 : 0;
    }
    return scoped > 0;
}

/// How often the target's file has `( T ) {`, or where its language constructs values `T {`.
size_t KnownWords::times_literal_opens(std::string_view type, std::string_view bracket) const {
    const LexedText& lexed = to_.edited.lexed;
    const uint32_t ahead = has_literals() ? 2 : 1;
    size_t times = 0;
    for (uint32_t i = 2; i + ahead < lexed.tokens.size(); ++i) {
        if (lexed.view(i) != type || lexed.view(i + ahead) != bracket) continue;
        const bool enclosed = lexed.view(i - 1) == "(" && lexed.view(i + 1) == ")";
        const Token& before = lexed.tokens[has_literals() ? i - 2 : i - 1];
        const bool named = before.kind == TokenKind::Identifier && lexed.view(before) != "return";
        times += (!has_literals() || enclosed) && !named ? 1 : 0;
    }
    return times;
}

std::string KnownWords::opens_literal(std::string_view type) const {
    const size_t braces = times_literal_opens(type, "{"), parentheses = times_literal_opens(type, "(");
    if (braces + parentheses > 0) return braces > parentheses ? "{" : "(";
    const LexedText& lexed = to_.edited.lexed;
    bool is_type = false;
    for (uint32_t i = 0; i + 2 < lexed.tokens.size() && !is_type; ++i)
        is_type = lexed.view(i) == type && lexed.tokens[i + 1].kind == TokenKind::Identifier &&
                  (lexed.view(i + 2) == "=" || lexed.view(i + 2) == ";");
    if (!is_type) return {};
    return to_.edited.language == Language::OpenCl || to_.edited.language == Language::Glsl ? "("
           : to_.edited.language == Language::C                                             ? "{"
                                                                                            : "";
}

/// True if the target's file says `using namespace std`, or calls `min` or `max` without a scope.
bool KnownWords::uses_std() const {
    const LexedText& lexed = to_.edited.lexed;
    for (uint32_t i = 2; i + 1 < lexed.tokens.size(); ++i) {
        const std::string_view word = lexed.view(i), last = lexed.view(i - 1);
        if (word == "std" && last == "namespace" && lexed.view(i - 2) == "using") return true;
        if ((word == "min" || word == "max") && lexed.view(i + 1) == "(" && last != "::" && last != ".") return true;
    }
    return false;
}

bool KnownWords::is_there_without_scope(std::string_view word) const {
    const LexedText& lexed = to_.edited.lexed;
    for (uint32_t i = 2; i < lexed.tokens.size(); ++i) {
        const std::string_view last = lexed.view(i - 1);
        if (lexed.view(i) == "std" && last == "namespace" && lexed.view(i - 2) == "using") return true;
        if (lexed.view(i) == word && last != "::" && last != "." && last != "->") return true;
    }
    return false;
}

bool KnownWords::is_of_shared_family(std::string_view word) const {
    if (!is_shouted(word) || !is_from_elsewhere(word)) return false;
    if (!shouted_read_) {
        shouted_read_ = true;
        SideWords::Words here;
        for (const Token& token : from_.edited.lexed.tokens)
            if (token.kind == TokenKind::Identifier) here.insert(from_.edited.lexed.view(token));
        for (const Token& token : to_.edited.lexed.tokens) {
            if (token.kind != TokenKind::Identifier) continue;
            const std::string_view name = to_.edited.lexed.view(token);
            if (is_shouted(name) && here.contains(name) && is_from_elsewhere(name)) shouted_.insert(name);
        }
    }
    for (size_t cut = word.rfind('_'); cut != std::string_view::npos && cut > 0; cut = word.rfind('_', cut - 1)) {
        const std::string_view family = word.substr(0, cut + 1);
        size_t others = 0;
        for (auto name = shouted_.lower_bound(family); name != shouted_.end() && name->starts_with(family); ++name)
            others += *name != word;
        const bool is_first_part = word.find('_') == cut;
        if (others >= (is_first_part ? 3u : 2u)) return true;
    }
    return false;
}

bool KnownWords::anywhere(std::string_view word) const {
    if (to_.all.known().contains(word)) return true;
    if (is_of_source(word)) return false;
    const Language here = from_.edited.language, there = to_.edited.language;
    if (dialect_.meaning(word) != nullptr && !is_type_word(word) && scopes_builtins()) return false;
    if (const std::string_view runtime = runtime_of(word); !runtime.empty() && !speaks(runtime)) return false;
    if (is_of_warps(word) && speaks("hip") && !speaks("cuda")) return false;
    if (here == there || is_shader_function(word, there)) return true;
    // What CUDA has besides its run time HIP has under the same name.
    const auto is_cuda_like = [](Language language) { return language == Language::Cuda || language == Language::Hip; };
    const bool from_cuda_like =
        is_cuda_like(here) || is_in_source_file("__device__") || is_in_source_file("__global__");
    if (from_cuda_like && (is_cuda_like(there) || in_file("__device__") || in_file("__global__"))) return true;
    if (are_both_cpp() && is_built_in_type(word)) return true;
    // C++ has them in `std` alone, where CUDA and HIP have them without it.
    const bool only_in_std = word == "min" || word == "max" || word == "swap";
    if (only_in_std && there == Language::Cpp && !uses_std()) return false;
    const bool both_c = traits_of(here).literals == Literals::C && traits_of(there).literals == Literals::C;
    return both_c && there != Language::OpenCl && is_standard(word);
}

}  // namespace porttool
