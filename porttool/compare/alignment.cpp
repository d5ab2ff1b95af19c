// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/alignment.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "porttool/language/words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/normal_text.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

constexpr size_t kMostClausePairs = 1'500'000;  // about 50 ms
constexpr size_t kMostWordPairs = 1'000'000;

using Aliases =
    std::unordered_map<uint32_t, uint32_t>;  ///< a word of the first text, and what it is called in the other

/// What the words of a clause weigh: names and numbers tell clauses apart, brackets hardly do.
double weight_of(std::string_view word) {
    if (is_word_token(word)) return word_is(word, kKeyword) ? 0.6 : 1;
    if (is_number_token(word)) return 0.7;
    return word == "(" || word == ")" || word == ";" || word == "," || word == "{" ? 0.05 : 0.25;
}

/// How a clause begins.
struct Opening {
    uint32_t word;
    bool returns, controls;
};

std::vector<Opening> openings_of(const AlignedText& text) {
    std::vector<Opening> out;
    for (const Clause& clause : text.clauses) {
        const std::string& word = text.words[clause.first];
        out.push_back({text.exact[clause.first], word == "return", word_is(word, kControls)});
    }
    return out;
}

/// The words of each clause as a bag, by their common numbers.
struct Bag {
    std::vector<std::pair<uint32_t, double>> words;  ///< sorted
    double weight = 0;
};

std::vector<Bag> bags_of(const AlignedText& text, const Aliases* aliases) {
    std::vector<Bag> out(text.clauses.size());
    for (size_t c = 0; c < out.size(); ++c) {
        for (size_t i = text.clauses[c].first; i < text.clauses[c].end; ++i) {
            uint32_t key = text.common[i];
            if (aliases != nullptr)
                if (const auto alias = aliases->find(key); alias != aliases->end()) key = alias->second;
            const double weight = weight_of(text.words[i]);
            out[c].words.emplace_back(key, weight);
            out[c].weight += weight;
        }
        std::sort(out[c].words.begin(), out[c].words.end());
    }
    return out;
}

double likeness_of(const Bag& a, const Bag& b) {
    double shared = 0;
    for (size_t i = 0, k = 0; i < a.words.size() && k < b.words.size();) {
        if (a.words[i].first == b.words[k].first)
            shared += std::min(a.words[i++].second, b.words[k++].second);
        else if (a.words[i].first < b.words[k].first)
            ++i;
        else
            ++k;
    }
    return a.weight + b.weight > 0 ? 2 * shared / (a.weight + b.weight) : 0;
}

class TextAligner {
public:
    TextAligner(const AlignedText& first, const AlignedText& second, const AlignmentRule& rule)
        : a_(first), b_(second), rule_(rule), opens_a_(openings_of(first)), opens_b_(openings_of(second)) {}

    Alignment run() {
        lay();
        if (rule_.learns_names && learn()) lay();
        return std::move(out_);
    }

private:
    void lay() {
        out_.clause_of.assign(a_.clauses.size(), Alignment::kNone);
        out_.word_of.assign(a_.words.size(), Alignment::kNone);
        out_.likeness.assign(a_.clauses.size(), 0);
        lay_clauses();
        close_blocks();
        for (size_t c = 0; c < a_.clauses.size(); ++c)
            if (out_.clause_of[c] != Alignment::kNone) lay_words(a_.clauses[c], b_.clauses[out_.clause_of[c]]);
    }

    static std::vector<size_t> open_ends(const AlignedText& text) {
        std::vector<size_t> out;
        for (size_t c = 0; c < text.clauses.size(); ++c)
            if (!text.clauses[c].closes) out.push_back(c);
        return out;
    }

    double score(size_t i, size_t k, double likeness) const {
        if (likeness < rule_.least) return -1;
        const size_t size = std::min(a_.clauses[i].size(), b_.clauses[k].size());
        // A clause that is the same outweighs two that only resemble each other.
        return likeness * likeness * std::sqrt(static_cast<double>(size)) + (likeness > 0.999 ? 0.5 : 0);
    }

    double likeness(const std::vector<Bag>& a, const std::vector<Bag>& b, size_t i, size_t k) const {
        const Opening &x = opens_a_[i], &y = opens_b_[k];
        if (x.returns != y.returns) return 0;
        const bool opens = a_.clauses[i].opens, controls = x.controls || y.controls;
        if (opens != b_.clauses[k].opens) return controls ? 0 : likeness_of(a[i], b[k]) * 0.8;
        if (opens && controls && x.word != y.word) return 0;
        return likeness_of(a[i], b[k]);
    }

    void lay_clauses() {
        const std::vector<size_t> rows = open_ends(a_), columns = open_ends(b_);
        if (rows.empty() || columns.empty() || rows.size() * columns.size() > kMostClausePairs) return;
        const std::vector<Bag> a = bags_of(a_, &aliases_), b = bags_of(b_, nullptr);
        const size_t width = columns.size() + 1;
        std::vector<double> best((rows.size() + 1) * width, 0);
        std::vector<double> alike(rows.size() * columns.size());
        for (size_t i = rows.size(); i-- > 0;)
            for (size_t k = columns.size(); k-- > 0;) {
                const bool heads = (i == 0) != (k == 0) && a_.clauses[rows[i]].opens && b_.clauses[columns[k]].opens;
                const double like = heads ? 0 : likeness(a, b, rows[i], columns[k]);
                alike[i * columns.size() + k] = like;
                const double with = score(rows[i], columns[k], like);
                best[i * width + k] = std::max({best[(i + 1) * width + k], best[i * width + k + 1],
                                                with > 0 ? with + best[(i + 1) * width + k + 1] : 0.0});
            }
        for (size_t i = 0, k = 0; i < rows.size() && k < columns.size();) {
            const double like = alike[i * columns.size() + k];
            const double with = score(rows[i], columns[k], like);
            if (with > 0 && best[i * width + k] == with + best[(i + 1) * width + k + 1]) {
                out_.clause_of[rows[i]] = columns[k];
                out_.likeness[rows[i]] = like;
                ++i, ++k;
            } else if (best[i * width + k] == best[(i + 1) * width + k]) {
                ++i;
            } else {
                ++k;
            }
        }
        // The heads of functions stand for each other whatever they say.
        if (out_.clause_of[rows[0]] == Alignment::kNone && a_.clauses[rows[0]].opens && b_.clauses[columns[0]].opens)
            out_.clause_of[rows[0]] = columns[0];
    }

    /// The braces of blocks whose heads stand for each other do, too, as far as the order allows.
    void close_blocks() {
        for (size_t c = 0; c < a_.clauses.size(); ++c) {
            const Clause& clause = a_.clauses[c];
            if (!clause.closes || clause.partner == Clause::kNone) continue;
            const size_t head = out_.clause_of[clause.partner];
            if (head == Alignment::kNone || b_.clauses[head].partner == Clause::kNone) continue;
            out_.clause_of[c] = b_.clauses[head].partner;
            out_.likeness[c] = 1;
        }
        size_t last = 0;
        bool any = false;
        for (size_t c = 0; c < a_.clauses.size(); ++c) {
            if (out_.clause_of[c] == Alignment::kNone) continue;
            if (any && out_.clause_of[c] <= last) {
                if (a_.clauses[c].closes) out_.clause_of[c] = Alignment::kNone;
                continue;
            }
            // A brace that stands after clauses which come later here is no use.
            if (a_.clauses[c].closes && overtakes(c)) {
                out_.clause_of[c] = Alignment::kNone;
                continue;
            }
            last = out_.clause_of[c];
            any = true;
        }
    }

    bool overtakes(size_t closing) const {
        for (size_t c = closing + 1; c < a_.clauses.size(); ++c)
            if (out_.clause_of[c] != Alignment::kNone && !a_.clauses[c].closes)
                return out_.clause_of[c] < out_.clause_of[closing];
        return false;
    }

    double word_score(size_t i, size_t k) const {
        const std::string &x = a_.words[i], &y = b_.words[k];
        const bool word = is_word_token(x), number = is_number_token(x);
        if (a_.exact[i] == b_.exact[k]) return word ? 4 : number ? 3.5 : x == "(" || x == ")" || x == "," ? 1.2 : 2;
        const auto alias = aliases_.find(a_.common[i]);
        if (a_.common[i] == b_.common[k] || (alias != aliases_.end() && alias->second == b_.common[k]))
            return word || number ? 3 : 1.5;
        if (word && is_word_token(y)) return word_is(x, kGoesOn) != word_is(y, kGoesOn) ? -1 : 0.6;
        if (number && is_number_token(y)) return 0.6;
        if ((x == "->" || x == "." || x == "::") && (y == "->" || y == "." || y == "::")) return 1.5;
        if ((number && is_word_token(y)) || (word && is_number_token(y))) return 0.2;
        return -1;
    }

    void lay_words(const Clause& first, const Clause& second) {
        const size_t rows = first.size(), columns = second.size(), width = columns + 1;
        if (rows * columns > kMostWordPairs) return;
        constexpr double kGap = 0.25;
        std::vector<double> best((rows + 1) * width, 0);
        for (size_t i = rows; i-- > 0;) best[i * width + columns] = best[(i + 1) * width + columns] - kGap;
        for (size_t k = columns; k-- > 0;) best[rows * width + k] = best[rows * width + k + 1] - kGap;
        const auto step = [&](size_t i, size_t k) {
            const double pair = word_score(first.first + i, second.first + k);
            return pair > 0 ? pair + best[(i + 1) * width + k + 1] : -1e30;
        };
        for (size_t i = rows; i-- > 0;)
            for (size_t k = columns; k-- > 0;)
                best[i * width + k] =
                    std::max({step(i, k), best[(i + 1) * width + k] - kGap, best[i * width + k + 1] - kGap});
        for (size_t i = 0, k = 0; i < rows && k < columns;) {
            if (best[i * width + k] == step(i, k)) {
                out_.word_of[first.first + i++] = second.first + k++;
            } else if (best[i * width + k] == best[(i + 1) * width + k] - kGap) {
                ++i;
            } else {
                ++k;
            }
        }
    }

    /// Names that stand for each other more often than for anything else. True if there are any.
    bool learn() {
        std::map<std::pair<uint32_t, uint32_t>, size_t> together;
        std::map<uint32_t, size_t> here, there;
        for (size_t i = 0; i < a_.words.size(); ++i) {
            const size_t k = out_.word_of[i];
            if (k == Alignment::kNone || !is_word_token(a_.words[i]) || !is_word_token(b_.words[k])) continue;
            ++together[{a_.common[i], b_.common[k]}];
            ++here[a_.common[i]];
            ++there[b_.common[k]];
        }
        for (const auto& [pair, count] : together)
            if (pair.first != pair.second && count >= 2 && 2 * count > here[pair.first] &&
                2 * count > there[pair.second])
                aliases_[pair.first] = pair.second;
        return !aliases_.empty();
    }

    const AlignedText &a_, &b_;
    const AlignmentRule& rule_;
    std::vector<Opening> opens_a_, opens_b_;
    Aliases aliases_;
    Alignment out_;
};

}  // namespace

uint32_t WordKeys::number(std::string_view word) {
    return numbers_.try_emplace(std::string(word), static_cast<uint32_t>(numbers_.size())).first->second;
}

AlignedText WordKeys::text(const std::vector<std::string>& words, bool is_record) {
    AlignedText out{words, clauses_of(words, is_record), {}, {}};
    out.exact.reserve(words.size());
    out.common.reserve(words.size());
    for (const std::string& word : words) {
        const uint32_t exact = number(word);
        const auto known = common_.find(exact);
        if (known == common_.end()) {
            const std::string common = common_word(word, dialect_);
            // Apart from spellings: a word whose common name is another word's spelling is not that word.
            common_[exact] = common.empty() ? exact : number("\x01" + common);
        }
        out.exact.push_back(exact);
        out.common.push_back(common_.at(exact));
    }
    return out;
}

Alignment align(const AlignedText& first, const AlignedText& second, const AlignmentRule& rule) {
    return TextAligner(first, second, rule).run();
}

}  // namespace porttool
