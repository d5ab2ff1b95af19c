// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/compounds.h"

#include <algorithm>

#include "porttool/match/entry_names.h"
#include "porttool/match/words.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

constexpr size_t kShortestCompound = 4;
constexpr size_t kMostParts = 3;

/// Calls take(name) for the names of all functions and structs, and of their files.
template <class Take>
void for_each_name(const std::vector<ScannedFile>& files, const Take& take) {
    for (const ScannedFile& file : files) {
        take(file_stem(file.path));
        for (const Unit& unit : file.units)
            if (unit.kind != UnitKind::Constant) take(plain_name(unit));
    }
}

bool has_letters_alone(std::string_view piece) { return std::all_of(piece.begin(), piece.end(), is_small_letter); }

/// Calls take(text, first, count) for parts that may be one word, the longest at each place first, until it says so.
template <class Take>
bool join_at(const std::vector<std::string>& pieces, size_t first, const Take& take) {
    const size_t most = std::min(kMostParts, pieces.size() - first);
    for (size_t count = most; count >= 2; --count) {
        std::string text;
        bool letters = true;
        for (size_t i = first; i < first + count; ++i) {
            letters = letters && has_letters_alone(pieces[i]);
            text += pieces[i];
        }
        if (letters && text.size() >= kShortestCompound && take(text, count)) return true;
    }
    return false;
}

}  // namespace

Compounds::Compounds(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target) {
    TextNumbers words;
    std::vector<std::vector<std::string>> apart;
    const auto read = [&](std::string_view name) {
        std::vector<std::string> pieces = split_pieces(name);
        for (const std::string& piece : pieces)
            if (piece.size() >= kShortestCompound) words.number(piece);
        if (pieces.size() > 1) apart.push_back(std::move(pieces));
    };
    for_each_name(source, read);
    for_each_name(target, read);
    for (const std::vector<std::string>& pieces : apart)
        for (size_t i = 0; i + 1 < pieces.size(); ++i)
            join_at(pieces, i, [&](const std::string& text, size_t) {
                if (words.contains(text)) together_.number(text);
                return false;
            });
}

std::vector<std::string> Compounds::split(std::string_view name) const {
    std::vector<std::string> pieces = split_pieces(name);
    if (together_.size() == 0 || pieces.size() < 2) return words_of(std::move(pieces), name);
    std::vector<std::string> joined;
    for (size_t i = 0; i < pieces.size();) {
        size_t used = 1;
        const bool found = join_at(pieces, i, [&](const std::string& text, size_t count) {
            if (!together_.contains(text)) return false;
            joined.push_back(text);
            used = count;
            return true;
        });
        if (!found) joined.push_back(std::move(pieces[i]));
        i += used;
    }
    return words_of(std::move(joined), name);
}

}  // namespace porttool
