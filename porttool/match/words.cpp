// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/words.h"

#include <algorithm>
#include <array>
#include <unordered_set>

#include "porttool/language/words.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_alphanumeric(char c) { return is_capital_letter(c) || is_small_letter(c) || is_digit(c); }

/// The sign of `V::operator+`; of other names nothing. What an operator is named after is its sign.
std::string_view operator_sign(std::string_view name) {
    constexpr std::string_view kOperator = "operator";
    const size_t found = name.rfind(kOperator);
    if (found == std::string_view::npos) return {};
    const std::string_view sign = name.substr(found + kOperator.size());
    return sign.empty() || is_alphanumeric(sign[0]) || sign[0] == '_' ? std::string_view() : sign;
}

/// Cuts common endings, keeping at least four letters.
void stem(std::string& word) {
    constexpr std::array<std::string_view, 9> kEndings = {"izing", "ized", "ize", "ing", "tion", "ed", "es", "s", "e"};
    constexpr size_t kShortest = 4;
    for (const auto ending : kEndings) {
        if (word.size() < ending.size() + kShortest || !word.ends_with(ending)) continue;
        word.resize(word.size() - ending.size());
        return;
    }
}

/// `yuv2rgb` is `yuv to rgb`: the place of a 2 that stands alone between words.
size_t joint_in(std::string_view word) {
    constexpr size_t kBefore = 3, kAfter = 2;
    const auto letters = [&](size_t first, size_t end) {
        return std::all_of(word.begin() + static_cast<std::ptrdiff_t>(first),
                           word.begin() + static_cast<std::ptrdiff_t>(end), is_small_letter);
    };
    const size_t at = word.find('2');
    if (at == std::string_view::npos || at < kBefore || at + 1 + kAfter > word.size()) return std::string_view::npos;
    return letters(at - kBefore, at) && letters(at + 1, word.size()) ? at : std::string_view::npos;
}

/// `conv2d` is `conv 2d`: the place of the digit before a `d` at the end.
size_t dimension_in(std::string_view word) {
    constexpr size_t kBefore = 3;
    if (word.size() < kBefore + 2 || word.back() != 'd' || !is_digit(word[word.size() - 2])) return word.npos;
    const bool letters = is_small_letter(word[word.size() - 3]) && is_small_letter(word[word.size() - 4]);
    return letters ? word.size() - 2 : word.npos;
}

bool ends_with_joint(std::string_view word) {
    return word.size() > 3 && word.back() == '2' && is_small_letter(word[word.size() - 2]) &&
           is_small_letter(word[word.size() - 3]);
}

void add_piece(std::string word, std::vector<std::string>& pieces) {
    if (const size_t joint = joint_in(word); joint != std::string_view::npos) {
        add_piece(word.substr(0, joint), pieces);
        word.erase(0, joint + 1);
    }
    if (const size_t dimension = dimension_in(word); dimension != std::string_view::npos) {
        add_piece(word.substr(0, dimension), pieces);
        word.erase(0, dimension);
    }
    pieces.push_back(std::move(word));
}

/// What joins two words tells nothing: `rgb_to_lab`, `rgb_2_lab` and `rgb2lab` are one.
void drop_joints(std::vector<std::string>& words) {
    if (words.size() < 3) return;
    const auto joint = [](const std::string& word) { return word == "to" || word == "2"; };
    words.erase(std::remove_if(words.begin() + 1, words.end() - 1, joint), words.end() - 1);
}

/// True if a name cannot end there: `copy_to` of `copy_to_gpu`.
bool leads_on(std::string_view name) {
    constexpr std::array<std::string_view, 8> kJoints = {"to", "from", "on", "for", "in", "is", "2", "has"};
    const std::vector<std::string> pieces = split_pieces(name);
    return pieces.empty() || std::find(kJoints.begin(), kJoints.end(), pieces.back()) != kJoints.end();
}

/// Words that tell how, beside types and vectors.
constexpr std::array kHow = {
    "kernel", "kern",       "krnl",    "gpu",       "cuda",    "cl",         "ocl",      "opencl",
    "sycl",   "hip",        "rocm",    "metal",     "vulkan",  "vk",         "glsl",     "hlsl",
    "ispc",   "omp",        "openmp",  "cpu",       "host",    "device",     "dev",      "native",
    "simd",   "simt",       "sse",     "sse2",      "sse3",    "ssse3",      "sse4",     "sse41",
    "sse42",  "avx",        "avx2",    "avx512",    "neon",    "sve",        "sve2",     "rvv",
    "vsx",    "altivec",    "lsx",     "lasx",      "msa",     "wasm",       "dsp",      "scalar",
    "vec",    "vectorized", "generic", "plain",     "naive",   "basic",      "opt",      "optimized",
    "fast",   "slow",       "impl",    "func",      "fn",      "function",   "op",       "ops",
    "helper", "inner",      "body",    "do",        "run",     "process",    "apply",    "compute",
    "calc",   "calculate",  "perform", "execute",   "exec",    "shared",     "local",    "global",
    "tiled",  "lds",        "smem",    "img",       "buf",     "contiguous", "cont",     "noncontiguous",
    "nc",     "strided",    "aligned", "unaligned", "inplace", "internal",   "private",  "method",
    "fp16",   "fp32",       "fp64",    "bf16",      "task",    "parallel",   "threaded",
};

/// `f32`, `u8`, `i64`
bool is_short_type(std::string_view word) {
    if (word.size() < 2 || word.size() > 3 || (word[0] != 'f' && word[0] != 'i' && word[0] != 'u' && word[0] != 's'))
        return false;
    const std::string_view bits = word.substr(1);
    return bits == "8" || bits == "16" || bits == "32" || bits == "64";
}

}  // namespace

bool tells_how(std::string_view word) {
    static const std::unordered_set<std::string> kWords = [] {
        std::unordered_set<std::string> words;
        for (const char* each : kHow) {
            std::string one = each;
            stem(one);
            words.insert(one);
        }
        return words;
    }();
    return is_short_type(word) || is_type_word(word) || kWords.contains(std::string(word));
}

std::string_view type_of_word(std::string_view word) {
    struct Row {
        std::string_view word, type;
    };
    constexpr std::array<Row, 13> kRows = {{{"float", "f32"},
                                            {"fp32", "f32"},
                                            {"double", "f64"},
                                            {"fp64", "f64"},
                                            {"half", "f16"},
                                            {"fp16", "f16"},
                                            {"bf16", "bf16"},
                                            {"int", "i32"},
                                            {"uint", "u32"},
                                            {"char", "i8"},
                                            {"uchar", "u8"},
                                            {"short", "i16"},
                                            {"ushort", "u16"}}};
    if (is_short_type(word)) return word;
    const auto letters = std::find_if(word.begin(), word.end(), is_digit);
    const bool vector = word.end() - letters <= 2 && !word.starts_with('f') ? true : word.starts_with("float");
    const std::string_view stem_of = vector ? word.substr(0, static_cast<size_t>(letters - word.begin())) : word;
    for (const Row& row : kRows)
        if (row.word == word || row.word == stem_of) return row.type;
    return {};
}

bool converts(std::string_view name) {
    for (size_t i = 1; i + 1 < name.size(); ++i) {
        if (name[i] == '2' && !is_digit(name[i - 1]) && !is_digit(name[i + 1])) return true;
        const bool to = small_letter(name[i]) == 't' && small_letter(name[i + 1]) == 'o' && i + 2 < name.size();
        if (!to) continue;
        const bool snake = name[i - 1] == '_' && name[i + 2] == '_';
        const bool camel = name[i] == 'T' && name[i + 1] == 'o' && is_capital_letter(name[i + 2]);
        if (snake || camel) return true;
    }
    return false;
}

bool names_instruction_set(std::string_view word) {
    constexpr std::array<std::string_view, 24> kSets = {
        "sse",  "sse2", "sse3", "ssse3",   "sse4", "sse41", "sse42", "avx", "avx2",   "avx512", "neon",    "sve",
        "sve2", "rvv",  "vsx",  "altivec", "lsx",  "lasx",  "msa",   "mmx", "scalar", "c",      "generic", "simd"};
    return std::find(kSets.begin(), kSets.end(), word) != kSets.end();
}

bool marks_reference(std::string_view word) {
    constexpr std::array<std::string_view, 12> kWords = {"cpu",  "host",   "h",      "ref", "referenc", "reference",
                                                         "gold", "golden", "serial", "seq", "verify",   "check"};
    return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

bool numbers_a_version(std::string_view word) {
    if (word.size() > 1 && word[0] == 'v') word.remove_prefix(1);
    return std::all_of(word.begin(), word.end(), is_digit);
}

bool marks_preparation(std::string_view word) {
    constexpr std::array<std::string_view, 21> kWords = {
        "load", "save",  "init", "initial", "setup", "creat",  "destroy", "param",  "parameter", "config", "configur",
        "pars", "alloc", "free", "releas",  "type",  "regist", "usag",    "option", "print",     "dump"};
    return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

std::vector<std::string> split_pieces(std::string_view name) {
    std::vector<std::string> pieces;
    std::string word;
    auto finish = [&] {
        if (!word.empty()) add_piece(word, pieces);
        word.clear();
    };
    for (size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        if (!is_alphanumeric(c)) {
            finish();
            continue;
        }
        const char before = i > 0 ? name[i - 1] : '\0';
        const char after = i + 1 < name.size() ? name[i + 1] : '\0';
        // camelCase, and the last capital of BSDFValue, but Conv2D
        const bool dimension = c == 'D' && is_digit(before) && !is_small_letter(after);
        if (is_capital_letter(c) && !dimension &&
            (is_small_letter(before) || is_digit(before) || (is_capital_letter(before) && is_small_letter(after)))) {
            if (is_small_letter(after) && ends_with_joint(word)) word.pop_back();  // RGB2Lab
            finish();
        }
        word += small_letter(c);
    }
    finish();
    return pieces;
}

std::vector<std::string> words_of(std::vector<std::string> pieces, std::string_view name) {
    for (std::string& piece : pieces) stem(piece);
    drop_joints(pieces);
    if (const auto sign = operator_sign(name); !sign.empty()) pieces.emplace_back(sign);
    return pieces;
}

std::vector<std::string> split_words(std::string_view name) { return words_of(split_pieces(name), name); }

std::string_view without_platform(std::string_view name) {
    constexpr std::array<std::string_view, 12> kPlatforms = {"opencl", "openmp", "vulkan", "metal", "cuda", "sycl",
                                                             "ispc",   "gpu",    "cpu",    "ocl",   "hip",  "omp"};
    for (const std::string_view platform : kPlatforms) {
        const size_t size = platform.size();
        if (name.size() < size + 2) continue;
        const auto same = [](char a, char b) { return small_letter(a) == b; };
        const size_t at = name.size() - size;
        const bool camel = is_capital_letter(name[at]) && is_small_letter(name[at - 1]);
        if (std::equal(name.begin() + static_cast<std::ptrdiff_t>(at), name.end(), platform.begin(), same) &&
            (name[at - 1] == '_' || camel)) {
            const std::string_view rest = name.substr(0, name[at - 1] == '_' ? at - 1 : at);
            if (!leads_on(rest)) return without_platform(rest);
        }
        if (name[size] == '_' && std::equal(platform.begin(), platform.end(), name.begin(),
                                            [](char a, char b) { return a == small_letter(b); }))
            return without_platform(name.substr(size + 1));
    }
    return name;
}

std::string fold(std::string_view name) {
    if (name.size() > 2 && name[0] == 'k' && is_capital_letter(name[1])) name.remove_prefix(1);
    std::string folded;
    for (const char c : name)
        if (is_alphanumeric(c)) folded += small_letter(c);
    folded += operator_sign(name);
    return folded;
}

std::string_view file_stem(std::string_view path) {
    std::string_view file = path.substr(path.find_last_of('/') + 1);
    while (file.starts_with('.')) file.remove_prefix(1);
    return file.substr(0, file.find('.'));
}

uint32_t number_in(std::string_view stem) {
    constexpr size_t kLeast = 3, kMost = 9;
    uint32_t out = 0;
    for (size_t i = 0; i < stem.size();) {
        uint32_t number = 0;
        const size_t first = i;
        for (; i < stem.size() && stem[i] >= '0' && stem[i] <= '9'; ++i)
            if (i - first < kMost) number = 10 * number + static_cast<uint32_t>(stem[i] - '0');
        if (i - first < kLeast || i - first > kMost) {
            i += i == first ? 1 : 0;
            continue;
        }
        if (out != 0) return 0;
        out = number;
    }
    return out;
}

std::string_view folder_of(std::string_view path) {
    const size_t slash = path.find_last_of('/');
    return slash == std::string_view::npos ? std::string_view() : path.substr(0, slash);
}

}  // namespace porttool
