// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace porttool {

/// Words of a text that lives elsewhere.
using Words = std::vector<std::string_view>;

/// True for a name, of any alphabet, or keyword.
inline bool is_word_token(std::string_view token) {
    const char c = token.empty() ? ' ' : token[0];
    return c == '_' || c == '$' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<signed char>(c) < 0;
}

/// True for a number.
inline bool is_number_token(std::string_view token) {
    const auto digit_at = [&](size_t i) { return i < token.size() && token[i] >= '0' && token[i] <= '9'; };
    return digit_at(0) || (token.starts_with('.') && digit_at(1));
}

/// A unit's tokens in normal form, word after word.
///
///     if (a > 0x10) a *= 2.0F;                         the code
///     if ( a > 16 ) { a *= 2f ; }                      its words
///     "if ( a > 16 ) {\na *= 2f ;\n}\n"                recorded
class NormalText {
public:
    void add(std::string_view word) {
        bytes_ += word;
        ends_.push_back(static_cast<uint32_t>(bytes_.size()));
    }

    size_t size() const { return ends_.size(); }
    bool empty() const { return ends_.empty(); }
    std::string_view operator[](size_t i) const {
        const size_t first = i == 0 ? 0 : ends_[i - 1];
        return std::string_view(bytes_).substr(first, ends_[i] - first);
    }
    /// All words; they live as long as this text is neither changed nor moved.
    Words words() const;

    /// The text as portmap.base/ keeps it: one statement a line, words apart by blanks. Blanks and line ends within a
    /// word, as in a raw string, stand as \x02 and \x01.
    std::string recorded() const;
    /// The text that was recorded. A word that had \x02 or \x01 of its own comes back with a blank or a line end.
    static NormalText read(std::string_view recorded);
    /// Makes the words what read() gives of recorded(), so that texts of both kinds can be compared.
    void as_recorded();
    /// Gives back what memory is to spare.
    void shrink();

    bool operator==(const NormalText&) const = default;

private:
    std::string bytes_;
    std::vector<uint32_t> ends_;  ///< of each word in bytes_
};

}  // namespace porttool
