// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "porttool/sync/block_braces.h"
#include "porttool/sync/transplant.h"

namespace porttool {

/// Words as code, where nothing tells how they are spaced.
bool stand_apart(std::string_view word, std::string_view next);

/// Where a text's lines begin and end around a place.
std::string_view blanks_before(const LexedText& text, size_t offset);
bool starts_line(const LexedText& text, size_t offset);
size_t line_end(const LexedText& text, size_t offset);

/// A unit of the target in its file, and how words that are carried into it are written there: with the white space of
/// the source, but for what the target's file does otherwise.
class PortText {
public:
    /// Source and target must outlive it. `indent`: indent_unit() of the target's file.
    PortText(const PlacedUnit& source, const PlacedUnit& target, std::string indent, BlockBraces braces)
        : source_(source),
          target_(target),
          unit_(std::move(indent)),
          braces_(std::move(braces)),
          brace_layout_(brace_layout()) {}

    static constexpr size_t kNone = Clause::kNone;

    const LexedText& text() const { return target_.file.lexed; }
    const Token& token(size_t word) const { return text().tokens[target_.words.tokens[word]]; }
    size_t start_of(size_t word) const { return token(word).offset; }
    size_t end_of(size_t word) const { return token(word).offset + token(word).length; }
    bool is_added(size_t word) const { return target_.words.is_added(word); }
    /// The nearest word with a place before `word`; kNone if none.
    size_t placed_before(size_t word) const;
    size_t placed_from(size_t word) const;
    /// What stands between two neighbouring words of the source's new text.
    std::string source_gap(size_t word) const;
    /// The white space before a carried word: "", a blank, or a line end.
    std::string gap(const std::vector<CarriedWord>& words, size_t i) const;
    /// Just within a bracket, or before a comma, where each project has a manner of its own: `f(x)` or `f( x )`.
    static bool is_bracketed(const std::string& before, const std::string& next);
    /// As the target writes the two words side by side, or words as these.
    bool stands_apart_there(const std::string& a, const std::string& b) const;
    static bool must_part(const std::string& a, const std::string& b);
    std::string said(const CarriedWord& word) const;
    std::string written(const std::vector<CarriedWord>& words, const std::string& indent) const;
    /// How much deeper than its first line the source writes the line that begins with words[i].
    std::string continuation(const std::vector<CarriedWord>& words, size_t i) const;
    /// True for the brace at the end of a head.
    bool opens_block(const CarriedWord& word) const;
    bool is_unwritten_brace(const CarriedWord& word) const;
    std::string indent_of_line(size_t word) const;
    /// 1 if most blocks within the unit have their brace on a line of its own, -1 if few, 0 if nothing tells.
    int brace_layout() const;

protected:
    const PlacedUnit &source_, &target_;
    std::string unit_;
    BlockBraces braces_;
    int brace_layout_;
};

}  // namespace porttool
