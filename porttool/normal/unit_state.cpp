// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/unit_state.h"

#include <algorithm>
#include <unordered_set>

#include "porttool/normal/locals.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

bool is_number(std::string_view text) {
    return !text.empty() && ((text[0] >= '0' && text[0] <= '9') || text[0] == '.') && text != "." && text != "...";
}

/// Puts a unit's text together: one statement a line, tokens apart by blanks.
class TextWriter {
public:
    void add(std::string_view word) {
        const size_t start = text_.size();
        text_ += word;
        std::replace(text_.begin() + static_cast<std::ptrdiff_t>(start), text_.end(), '\n', '\x01');  // raw strings
        std::replace(text_.begin() + static_cast<std::ptrdiff_t>(start), text_.end(), ' ', '\x02');
        if (word == "(") ++parens_;
        if (word == ")") --parens_;
        const bool ends = word == "{" || word == "}" || (word == ";" && parens_ <= 0);
        text_ += ends ? '\n' : ' ';
    }
    std::string take() {
        if (!text_.empty() && text_.back() == ' ') text_.back() = '\n';
        text_.shrink_to_fit();
        return std::move(text_);
    }

private:
    std::string text_;
    int64_t parens_ = 0;
};

/// The three prints of a unit, word by word.
class UnitPrinter {
public:
    /// `numbered` stands for the word where it names a local, else it is the word.
    void add(std::string_view word, std::string_view numbered) {
        written_.add(word);
        renamed_.add(numbered);
        blanked_.add(is_number(numbered) ? "#" : numbered);
    }
    Fingerprints take() const { return {written_.digits(), renamed_.digits(), blanked_.digits()}; }

private:
    Fingerprinter written_, renamed_, blanked_;
};

}  // namespace

std::vector<std::string> local_names(const ScannedFile& file, const Unit& unit) {
    if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) return {};
    std::vector<std::string> names;
    std::unordered_set<std::string_view> seen;
    for (const uint32_t place : declaring_tokens(file.lexed, unit.parameters, unit.body))
        if (seen.insert(file.lexed.view(place)).second) names.emplace_back(file.lexed.view(place));
    return names;
}

UnitState unit_state(const ScannedFile& file, const Unit& unit) {
    UnitState state;
    state.id = unit_id(file, unit);
    state.file = file.path;
    state.name = unit.name;
    state.kind = unit.kind;
    state.start_line = unit.start_line;
    state.end_line = unit.end_line;
    const bool code = unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel;
    LocalNumbers numbers(code ? declaring_tokens(file.lexed, unit.parameters, unit.body) : std::vector<uint32_t>());
    UnitPrinter prints;
    TextWriter text;
    write_normal_form(file, unit, [&](std::string_view word, uint32_t token) {
        ++state.tokens;
        text.add(word);
        prints.add(word, numbers.next(word, token));
    });
    state.text = text.take();
    state.prints = prints.take();
    return state;
}

Fingerprints prints_of_text(const std::string& text) {
    const std::vector<std::string> words = read_state_text(text);
    const std::vector<size_t> locals = local_numbers(words);
    UnitPrinter prints;
    for (size_t i = 0; i < words.size(); ++i)
        prints.add(words[i], locals.empty() || locals[i] == 0 ? words[i] : "%" + std::to_string(locals[i]));
    return prints.take();
}

std::vector<std::string> read_state_text(const std::string& text) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : text) {
        if (c == ' ' || c == '\n') {
            if (!word.empty()) words.push_back(word);
            word.clear();
        } else {
            word += c == '\x01' ? '\n' : c == '\x02' ? ' ' : c;
        }
    }
    if (!word.empty()) words.push_back(word);
    return words;
}

}  // namespace porttool
