// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/word_macros.h"

#include <algorithm>
#include <cstring>
#include <unordered_set>

#include "porttool/language/words.h"
#include "porttool/normal/declared_lines.h"
#include "porttool/scan/macros.h"
#include "porttool/text/fingerprint.h"

namespace porttool {
namespace {

constexpr size_t kMostWords = 64;
/// Of one word in one file, kept apart: files that say the same may take each other's place.
constexpr size_t kMostTexts = 4;
/// What an `#include` may mean, and the files that one sees: beyond it a file counts as seeing all, so that nothing is
/// hidden in there.
constexpr size_t kMostAlike = 64, kMostSeen = 2048;
constexpr size_t kMostKept = size_t{1} << 24;  ///< numbers of seen files in memory: 64 MiB

std::string from_the_end(std::string_view path) { return {path.rbegin(), path.rend()}; }

template <class Texts>
std::string hash_of(const Texts& texts) {
    Fingerprinter print;
    for (const std::string_view text : texts) print.add(text);
    return print.digits();
}

/// What stands between the quotes or angles of an `#include`; "" for a macro in their place.
std::string included_name(const LexedText& lexed, const Directive& directive) {
    std::string out;
    for (uint32_t at = directive.first_token + 2; at < directive.end_token; ++at) out += lexed.view(at);
    const bool is_name = out.size() > 2 && (out.front() == '"' || out.front() == '<');
    return is_name ? out.substr(1, out.size() - 2) : std::string();
}

/// A path without `.` and `..`.
std::string plain_path(std::string_view path) {
    std::vector<std::string_view> parts;
    for (size_t at = 0; at <= path.size();) {
        const size_t end = std::min(path.find('/', at), path.size());
        const std::string_view part = path.substr(at, end - at);
        if (part == ".." && !parts.empty())
            parts.pop_back();
        else if (!part.empty() && part != "." && part != "..")
            parts.push_back(part);
        at = end + 1;
    }
    std::string out;
    for (const std::string_view part : parts) out += (out.empty() ? "" : "/") + std::string(part);
    return out;
}

/// True for a replacement that says how a function is called or linked, or where it runs, and nothing else.
bool only_promises(const LexedText& lexed, uint32_t first, uint32_t end) {
    if (first >= end) return false;
    for (uint32_t at = first; at < end; ++at)
        if (!word_is(lexed.view(at), kPromise | kHeadPromise | kDropped)) return false;
    return true;
}

void add(std::string& words, std::string_view word, std::string_view hash) {
    words += (words.empty() ? "" : " ") + std::string(word) + ":" + std::string(hash);
}

std::string text_of(const LexedText& lexed, const Directive& directive, bool is_unit) {
    std::string out = "#" + std::string(lexed.view(directive.first_token + 1));
    const uint32_t end = is_unit ? directive.first_token + 3 : directive.end_token;
    for (uint32_t at = directive.first_token + 2; at < end; ++at) out.append(" ").append(lexed.view(at));
    return out + (is_unit ? " ..." : "");
}

}  // namespace

FileMacros file_macros(const ScannedFile& file) {
    FileMacros out{file.path, {}, {}};
    const LexedText& lexed = file.lexed;
    auto unit = file.units.begin();
    for (const Directive& directive : lexed.directives) {
        if (directive.kind == DirectiveKind::Include)
            if (std::string name = included_name(lexed, directive); !name.empty())
                out.includes.push_back(std::move(name));
        const uint32_t name = directive.first_token + 2;
        const bool defines = directive.kind == DirectiveKind::Define;
        if (name >= directive.end_token || (lexed.tokens[name].flags & kDead) != 0) continue;
        if (!defines && (directive.kind != DirectiveKind::Other || lexed.view(name - 1) != "undef")) continue;
        if (only_promises(lexed, name + 1, directive.end_token)) continue;
        while (unit != file.units.end() && unit->tokens.first < directive.first_token) ++unit;
        const bool is_unit = unit != file.units.end() && unit->tokens.first == directive.first_token;
        out.lines.push_back({std::string(lexed.view(name)), text_of(lexed, directive, is_unit), directive.line});
    }
    for (MacroLine& line : declared_lines(file)) out.lines.push_back(std::move(line));
    return out;
}

std::vector<FileMacros> file_macros(const std::vector<ScannedFile>& files) {
    std::vector<FileMacros> out;
    out.reserve(files.size());
    for (const ScannedFile& file : files) out.push_back(file_macros(file));
    return out;
}

WordMacros::WordMacros(std::vector<FileMacros> files) : files_(std::move(files)) {
    for (uint32_t i = 0; i < files_.size(); ++i)
        for (const MacroLine& line : files_[i].lines) {
            const bool declares = line.word.starts_with('=');
            const std::string_view word = std::string_view(line.word).substr(declares ? 1 : 0);
            (declares ? declared_ : by_word_)[word].definitions.push_back({i, &line});
            sieve_.add(word);
        }
}

size_t WordMacros::Sieve::place(std::string_view word) {
    uint64_t head = 0, tail = 0;
    const size_t taken = std::min(word.size(), sizeof(head));
    std::memcpy(&head, word.data(), taken);
    std::memcpy(&tail, word.data() + word.size() - taken, taken);
    const uint64_t mixed = (head * 0x9E3779B97F4A7C15ull) ^ (tail * 0xD6E8FEB86659FD93ull + word.size());
    return (mixed * 0xC2B2AE3D27D4EB4Full) >> (64 - kBits);
}

std::string WordMacros::of(const std::string& path, const UnitText& text) {
    if (by_word_.empty() && declared_.empty()) return "+";
    std::map<std::string_view, std::string_view> macros, declared;
    std::unordered_map<std::string_view, std::string>* hashes = nullptr;  // of the path
    std::vector<Word*> open;  // declared words whose own words are to be looked up
    const auto look_up = [&](std::unordered_map<std::string_view, Word>& words, std::string_view word, bool declares,
                             std::map<std::string_view, std::string_view>& found) {
        const auto defined = words.find(word);
        if (defined == words.end() || found.contains(defined->first)) return;
        if (hashes == nullptr) hashes = &hashes_[path];
        const std::string_view key = declares ? defined->second.definitions[0].line->word : defined->first;
        const auto [known, is_new] = hashes->try_emplace(key);
        if (is_new) known->second = hash_seen(path, defined->second);
        if (known->second.empty()) return;
        found.emplace(defined->first, known->second);
        if (declares) open.push_back(&defined->second);
    };
    text.each_name([&](std::string_view word) {
        if (!sieve_.may_have(word)) return;
        look_up(by_word_, word, false, macros);
        look_up(declared_, word, true, declared);
    });
    while (!open.empty() && declared.size() <= kMostWords) {
        Word& next = *open.back();
        open.pop_back();
        for (const std::string_view word : used_by(next)) look_up(declared_, word, true, declared);
    }
    std::string names, keywords, said;
    size_t count = 0;
    for (const auto& [word, hash] : macros) {
        const bool is_keyword = redefines_word(word);
        add(is_keyword ? keywords : names, word, hash);
        count += is_keyword ? 0 : 1;
    }
    for (const auto& [word, hash] : declared) add(said, "=" + std::string(word), hash);
    if (count > kMostWords) names = "*:" + hash_of(std::set{names});
    if (declared.size() > kMostWords) said = "=*:" + hash_of(std::set{said});
    std::string out = "+";
    for (const std::string* part : {&names, &keywords, &said}) out += (part->empty() ? "" : " ") + *part;
    return out;
}

const std::vector<std::string_view>& WordMacros::used_by(Word& declared) {
    if (declared.used) return *declared.used;
    std::vector<std::string_view>& out = declared.used.emplace();
    for (const Definition& one : declared.definitions) {
        const std::string_view text = one.line->text;
        for (size_t at = 0; at < text.size();) {
            const size_t end = std::min(text.find(' ', at), text.size());
            const std::string_view word = text.substr(at, end - at);
            if (const auto found = declared_.find(word); found != declared_.end() && &found->second != &declared)
                out.push_back(found->first);
            at = end + 1;
        }
    }
    return out;
}

bool WordMacros::leads_to(std::string_view word, std::string_view other) {
    std::unordered_set<std::string_view> seen = {word};
    std::vector<std::string_view> open = {word};
    while (!open.empty()) {
        const auto found = declared_.find(open.back());
        open.pop_back();
        if (found == declared_.end()) continue;
        for (const std::string_view next : used_by(found->second)) {
            if (next == other) return true;
            if (seen.insert(next).second) open.push_back(next);
        }
    }
    return false;
}

void WordMacros::sort_by_file(Word& defined) {
    for (size_t i = 0; i < defined.definitions.size(); ++i) {  // in the order of the files
        const Definition& one = defined.definitions[i];
        if (defined.by_file.empty() || defined.by_file.back().file != one.file)
            defined.by_file.push_back({one.file, i, {}});
        defined.by_file.back().hashes.insert(hash_of(std::set<std::string_view>{one.line->text}));
    }
    std::set<std::string> all;
    for (InFile& one : defined.by_file) {
        const bool in_order = one.hashes.size() > 1 && defined.definitions[one.first].line->word.starts_with('=');
        if (in_order) one.hashes = {hash_in_order(defined, one)};  // values may change places among namespaces
        if (one.hashes.size() > kMostTexts) one.hashes = {hash_of(one.hashes)};
        all.insert(one.hashes.begin(), one.hashes.end());
    }
    defined.hash_of_all = hash_of(all);
}

std::string WordMacros::hash_in_order(const Word& defined, const InFile& in) {
    std::vector<std::string_view> texts;
    for (size_t i = in.first; i < defined.definitions.size() && defined.definitions[i].file == in.file; ++i)
        texts.push_back(defined.definitions[i].line->text);
    return hash_of(texts);
}

/// The files in which a word is defined for `path`, in order.
std::vector<const WordMacros::InFile*> WordMacros::seen_in(const std::string& path, Word& defined) {
    if (defined.by_file.empty()) sort_by_file(defined);
    std::vector<const InFile*> out;
    for (const uint32_t file : seen_files(path).numbers) {
        const auto one = std::lower_bound(defined.by_file.begin(), defined.by_file.end(), file,
                                          [](const InFile& in, uint32_t number) { return in.file < number; });
        if (one != defined.by_file.end() && one->file == file) out.push_back(&*one);
    }
    return out;
}

/// "" where no macro of that name is seen.
std::string WordMacros::hash_seen(const std::string& path, Word& defined) {
    const std::vector<const InFile*> seen = seen_in(path, defined);
    if (seen_files(path).all) return defined.hash_of_all;
    std::vector<std::string_view> hashes;
    for (const InFile* one : seen) hashes.insert(hashes.end(), one->hashes.begin(), one->hashes.end());
    std::sort(hashes.begin(), hashes.end());
    hashes.erase(std::unique(hashes.begin(), hashes.end()), hashes.end());
    return hashes.empty() ? std::string() : hash_of(hashes);
}

std::optional<WordMacro> WordMacros::first_seen(const std::string& path, std::string_view word) {
    const bool declares = word.starts_with('=');
    auto& words = declares ? declared_ : by_word_;
    const auto defined = words.find(word.substr(declares ? 1 : 0));
    if (defined == words.end()) return std::nullopt;
    const std::vector<const InFile*> seen = seen_in(path, defined->second);
    const bool all = seen_files(path).all;
    if (seen.empty() && !all) return std::nullopt;
    const Definition& one = defined->second.definitions[all ? 0 : seen.front()->first];
    return WordMacro{one.line->text, files_[one.file].path, one.line->line};
}

bool WordMacros::sees(const std::string& path, const std::string& included) {
    const Files& seen = seen_files(path);
    const auto file = by_path_.find(included);
    return seen.all ||
           (file != by_path_.end() && std::binary_search(seen.numbers.begin(), seen.numbers.end(), file->second));
}

void WordMacros::index_paths() {
    for (uint32_t i = 0; i < files_.size(); ++i) {
        by_path_.emplace(files_[i].path, i);
        by_path_end_.emplace_back(from_the_end("/" + files_[i].path), i);
    }
    std::sort(by_path_end_.begin(), by_path_end_.end());
}

const WordMacros::Files& WordMacros::seen_files(const std::string& path) {
    if (by_path_.empty()) index_paths();
    if (const auto known = seen_.find(path); known != seen_.end()) return known->second;
    if (seen_numbers_ > kMostKept) seen_.clear(), seen_numbers_ = 0;
    Files& seen = seen_[path];
    std::vector<uint32_t> open;
    if (const auto start = by_path_.find(path); start != by_path_.end()) open.push_back(start->second);
    std::unordered_set<uint32_t> found(open.begin(), open.end());
    while (!open.empty() && !seen.all) {
        const Files& next = included_by(open.back());
        open.pop_back();
        seen.all = next.all;
        for (const uint32_t file : next.numbers)
            if (found.insert(file).second) open.push_back(file);
        seen.all = seen.all || found.size() > kMostSeen;
    }
    if (!seen.all) seen.numbers.assign(found.begin(), found.end());
    std::sort(seen.numbers.begin(), seen.numbers.end());
    seen_numbers_ += seen.numbers.size();
    return seen;
}

/// The files that one includes: the one beside it, else all whose paths end so; where the compiler looks is not known.
const WordMacros::Files& WordMacros::included_by(uint32_t file) {
    const auto [list, is_new] = includes_.try_emplace(file);
    Files& out = list->second;
    if (!is_new) return out;
    const std::string& path = files_[file].path;
    for (const std::string& name : files_[file].includes) {
        const std::string beside = plain_path(path.substr(0, path.rfind('/') + 1) + name);
        if (const auto found = by_path_.find(beside); found != by_path_.end()) {
            out.numbers.push_back(found->second);
            continue;
        }
        const std::string end = from_the_end("/" + plain_path(name));
        auto one = std::lower_bound(by_path_end_.begin(), by_path_end_.end(), std::make_pair(end, uint32_t{0}));
        for (size_t alike = 0; one != by_path_end_.end() && one->first.starts_with(end); ++one) {
            out.numbers.push_back(one->second);
            out.all = out.all || ++alike > kMostAlike;
            if (out.all) return out;
        }
    }
    std::sort(out.numbers.begin(), out.numbers.end());
    out.numbers.erase(std::unique(out.numbers.begin(), out.numbers.end()), out.numbers.end());
    return out;
}

std::string without_keywords(std::string_view words) {
    std::string out;
    for (const auto& [word, hash] : words_with_macros(words))
        if (!redefines_word(word) && !word.starts_with('=')) add(out, word, hash);
    return out.empty() ? "-" : out;
}

std::string without_declared(std::string_view words) { return std::string(words.substr(0, words.find(" ="))); }

std::map<std::string_view, std::string_view> words_with_macros(std::string_view words) {
    std::map<std::string_view, std::string_view> out;
    for (size_t at = 0; at < words.size();) {
        const size_t end = std::min(words.find(' ', at), words.size());
        const std::string_view part = words.substr(at, end - at);
        if (const size_t colon = part.find(':'); colon != std::string_view::npos)
            out.emplace(part.substr(0, colon), part.substr(colon + 1));
        at = end + 1;
    }
    return out;
}

}  // namespace porttool
