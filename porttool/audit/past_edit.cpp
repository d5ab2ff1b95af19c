// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/past_edit.h"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "porttool/audit/likeness.h"
#include "porttool/compare/plain_statement.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/locals.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/prelude.h"

namespace porttool {
namespace {

constexpr size_t kMostWordsOfUnit = 60'000;  // above, no person wrote it
constexpr char kBetweenWords = '\x1f';
constexpr float kSamePlace = 0.4f;  ///< likeness from which on a statement became the other

WrittenStatement written(const std::vector<std::string>& words) {
    std::string out;
    for (const std::string& word : words) (out.empty() ? out : out += kBetweenWords) += word;
    return out;
}

std::vector<std::string> as_written_words(const Words& statement, bool) { return {statement.begin(), statement.end()}; }

/// Lists of values in parentheses, so that they stay within their statement: `(float4){a, b}` is `(float4)(a, b)`.
Words with_plain_lists(const Words& text) {
    Words out = text;
    std::vector<bool> lists;  // of the braces that are open: whether they hold values
    for (size_t i = 0; i < out.size(); ++i) {
        if (out[i] == "{") {
            const std::string_view last = i == 0 ? std::string_view() : text[i - 1];
            const bool within = !lists.empty() && lists.back();
            const bool cast = last == ")" && i > 3 && text[i - 3] == "(" && is_word_token(text[i - 2]) &&
                              is_one_of(text[i - 4], {"=", ",", "(", "return", "+", "-", "*", "/", "+=", "-=", "*="});
            lists.push_back(within || cast || is_one_of(last, {"=", ",", "(", "return"}));
            if (lists.back()) out[i] = "(";
        } else if (out[i] == "}" && !lists.empty()) {
            if (lists.back()) out[i] = ")";
            lists.pop_back();
        }
    }
    return out;
}

/// Puts a `;` wherever a statement ends for whoever looks for edits: behind labels of a switch, of which one that a
/// commit adds to a long list is a statement that came, behind the head of a loop or branch, with braces or without,
/// between `a = 1 , b = 2` and the lines of a list of macros, `CASES ( 1 ) CASES ( 2 )`, and around lines of the
/// preprocessor whose end can be told.
class LoneStatements {
public:
    explicit LoneStatements(const Words& text) : text_(text) {}

    Words run() {
        for (size_t i = 0; i < text_.size(); ++i) {
            const std::string_view word = text_[i];
            if (word == "#" && depth_ == 0 && is_directive(at(i + 1))) {
                i = take_directive(i);
                continue;
            }
            in_label_ = in_label_ || (word == "case" && depth_ == 0);
            in_head_ =
                in_head_ || (depth_ == 0 && at(i + 1) == "(" && is_one_of(word, {"if", "for", "while", "switch"}));
            if (word == "(" || word == "[") ++depth_;
            if (word == ")" || word == "]") --depth_;
            if (word == "," && depth_ == 0 && sets_value(begin_) && sets_value(i + 1)) {
                end_statement();
                begin_ = i + 1;
                continue;
            }
            out_.push_back(word);
            if (is_one_of(word, {";", "{", "}"})) begin_ = i + 1;
            if (word == ")" && depth_ == 0 && is_macro(i)) {
                end_statement();
                begin_ = i + 1;
            }
            const bool ends_label = in_label_ && word == ":" && depth_ == 0;
            const bool ends_head = in_head_ && word == ")" && depth_ == 0;
            const bool lone_else = word == "else" && at(i + 1) != "if";
            if (ends_label) in_label_ = false;
            if (ends_head) in_head_ = false;
            if (ends_label || ((ends_head || lone_else) && !is_one_of(at(i + 1), {"{", ";"}))) {
                end_statement();
                begin_ = i + 1;
            }
        }
        return std::move(out_);
    }

private:
    static bool is_directive(std::string_view word) {
        return is_one_of(
            word, {"if", "ifdef", "ifndef", "elif", "else", "endif", "define", "undef", "pragma", "include", "error"});
    }
    std::string_view at(size_t i) const { return i < text_.size() ? text_[i] : std::string_view(); }
    void end_statement() { out_.emplace_back(";"); }

    /// True if `a . b [ i ] =` stands there: no declaration, which has two names in a row.
    bool sets_value(size_t i) const {
        if (!is_word_token(at(i))) return false;
        int depth = 0;  // of brackets
        for (++i; i < text_.size(); ++i) {
            const std::string_view word = text_[i];
            depth += word == "[" ? 1 : word == "]" ? -1 : 0;
            if (depth > 0 || word == "]") continue;
            if (is_one_of(word, {"=", "+=", "-=", "*=", "/="})) return true;
            const bool member = is_word_token(word) && is_one_of(text_[i - 1], {".", "->"});
            if (!member && !is_one_of(word, {".", "->"})) return false;
        }
        return false;
    }

    /// True if the `)` there ends a macro that stands as a statement without a `;`: all of it is `NAME ( ... )`, and a
    /// name follows.
    bool is_macro(size_t end) const {
        const std::string_view name = at(begin_);
        if (!is_word_token(name) || at(begin_ + 1) != "(" || !is_word_token(at(end + 1)) || word_is(name, kKeyword) ||
            is_type_word(name) || is_one_of(name, {"if", "for", "while", "switch", "__attribute__", "layout"}))
            return false;
        const bool in_capitals = std::none_of(name.begin(), name.end(), [](char c) { return c >= 'a' && c <= 'z'; });
        int depth = 0;
        for (size_t i = begin_ + 1; i < end; ++i) {
            depth += text_[i] == "(" ? 1 : text_[i] == ")" ? -1 : 0;
            if (depth == 0) return false;  // the list ended before
        }
        return in_capitals;
    }

    size_t take_directive(size_t i) {
        if (!out_.empty() && !is_one_of(out_.back(), {";", "{", "}"})) end_statement();
        const std::string_view name = at(i + 1);
        out_.push_back(text_[i++]);
        out_.push_back(name);
        const bool has_name = is_one_of(name, {"ifdef", "ifndef", "undef"}) && i + 1 < text_.size();
        if (has_name) out_.push_back(text_[++i]);
        const size_t end = is_one_of(name, {"if", "elif"}) ? end_of_condition(i + 1) : i + 1;
        while (i + 1 < end) out_.push_back(text_[++i]);
        if (has_name || is_one_of(name, {"if", "elif", "else", "endif"})) {
            end_statement();
            begin_ = i + 1;
        }
        return i;
    }

    /// Behind what `#if` asks, as far as its words tell: an operand that no operator follows ends it. A `*` is none:
    /// so a statement may begin.
    size_t end_of_condition(size_t i) const {
        const size_t first = i;
        while (i < text_.size()) {
            while (is_one_of(at(i), {"!", "-", "~"})) ++i;
            const bool asks = at(i) == "defined";
            if (asks) ++i;
            if (at(i) == "(") {
                i = behind_brackets(i);
            } else if (is_word_token(at(i)) || is_number_token(at(i))) {
                const bool calls = !asks && is_word_token(at(i)) && at(i + 1) == "(";
                i = calls ? behind_brackets(i + 1) : i + 1;
            } else {
                return first;
            }
            if (!is_one_of(at(i), {"&&", "||", "==", "!=", "<", ">", "<=", ">=", "+", "-", "%", "/", "|", "^", "&"}))
                return i;
            ++i;
        }
        return text_.size();
    }

    size_t behind_brackets(size_t open) const {
        int depth = 0;
        for (size_t i = open; i < text_.size(); ++i) {
            depth += text_[i] == "(" ? 1 : text_[i] == ")" ? -1 : 0;
            if (depth == 0) return i + 1;
        }
        return text_.size();
    }

    const Words& text_;
    Words out_;
    int depth_ = 0;
    size_t begin_ = 0;  ///< of the statement
    bool in_label_ = false, in_head_ = false;
};

/// A unit's text as its statements are told apart here.
Words with_plain_statements(const Words& text) { return LoneStatements(with_plain_lists(without_prelude(text))).run(); }

/// Pairs what was lost in one place with what was gained there, in order, so that as much as possible is alike.
class PlaceAligner {
public:
    PlaceAligner(const std::vector<const Statement*>& lost, const std::vector<const Statement*>& gained)
        : lost_(lost), gained_(gained) {}

    std::vector<EditedPlace> run() {
        constexpr size_t kMostCells = 4000;
        const size_t n = lost_.size(), m = gained_.size();
        std::vector<EditedPlace> out;
        std::vector<std::vector<float>> like, best;
        if (n * m <= kMostCells && n * m > 0) {
            like = table();
            best = filled(like);
        }
        size_t i = 0, k = 0;
        while (!best.empty() && i < n && k < m) {
            if (like[i][k] >= kSamePlace && best[i][k] == best[i + 1][k + 1] + like[i][k]) {
                out.push_back({written(lost_[i++]->common), written(gained_[k++]->common)});
            } else if (best[i][k] == best[i + 1][k]) {
                out.push_back({written(lost_[i++]->common), ""});
            } else {
                out.push_back({"", written(gained_[k++]->common)});
            }
        }
        for (; i < n; ++i) out.push_back({written(lost_[i]->common), ""});
        for (; k < m; ++k) out.push_back({"", written(gained_[k]->common)});
        return out;
    }

private:
    std::vector<std::vector<float>> table() const {
        Weigher weigher;
        std::vector<WeighedWords> left, right;
        for (const Statement* one : lost_) left.push_back(weigher.weighed(one->common));
        for (const Statement* one : gained_) right.push_back(weigher.weighed(one->common));
        std::vector<std::vector<float>> out(left.size(), std::vector<float>(right.size()));
        for (size_t i = 0; i < left.size(); ++i)
            for (size_t k = 0; k < right.size(); ++k) out[i][k] = likeness(left[i], right[k]);
        return out;
    }

    static std::vector<std::vector<float>> filled(const std::vector<std::vector<float>>& like) {
        const size_t n = like.size(), m = like[0].size();
        std::vector<std::vector<float>> best(n + 1, std::vector<float>(m + 1, 0.0f));
        for (size_t i = n; i-- > 0;)
            for (size_t k = m; k-- > 0;) {
                best[i][k] = std::max(best[i + 1][k], best[i][k + 1]);
                if (like[i][k] >= kSamePlace) best[i][k] = std::max(best[i][k], best[i + 1][k + 1] + like[i][k]);
            }
        return best;
    }

    const std::vector<const Statement*>&lost_, &gained_;
};

/// The places of an edit, one run of lost and gained statements after the other.
std::vector<EditedPlace> places_of(const StatementEdit& edit) {
    std::vector<EditedPlace> out;
    const std::vector<size_t> kept = edit.kept();
    std::vector<const Statement*> lost, gained;
    const auto finish = [&] {
        for (EditedPlace& place : PlaceAligner(lost, gained).run()) out.push_back(std::move(place));
        lost.clear();
        gained.clear();
    };
    size_t k = 0;
    const auto gain_until = [&](size_t end) {
        for (; k < end; ++k)
            if (!edit.now[k].is_brace()) gained.push_back(&edit.now[k]);
    };
    for (size_t i = 0; i < edit.before.size(); ++i) {
        if (kept[i] == StatementEdit::kGone) {
            if (!edit.before[i].is_brace()) lost.push_back(&edit.before[i]);
            continue;
        }
        gain_until(kept[i]);
        if (!edit.before[i].is_brace()) finish();
        ++k;
    }
    gain_until(edit.now.size());
    finish();
    return out;
}

/// What went in one place and came in another, as it is, has only moved.
void drop_moved(std::vector<EditedPlace>& places) {
    std::map<std::string, size_t> went;
    for (const EditedPlace& place : places)
        if (place.now.empty()) ++went[place.before];
    std::map<std::string, size_t> moved;
    std::erase_if(places, [&](const EditedPlace& place) {
        if (!place.before.empty()) return false;
        const auto found = went.find(place.now);
        if (found == went.end() || found->second == 0) return false;
        --found->second;
        ++moved[place.now];
        return true;
    });
    std::erase_if(places, [&](const EditedPlace& place) {
        if (!place.now.empty()) return false;
        const auto found = moved.find(place.before);
        if (found == moved.end() || found->second == 0) return false;
        --found->second;
        return true;
    });
}

/// What locals are called now that had another name before: of words that took each other's place, those of which the
/// text now has no old one, the text before no new one.
class Renamed {
public:
    Renamed(const std::vector<EditedPlace>& places, const Words& before, const Words& now) {
        Names all;
        for (const EditedPlace& place : places) {
            const std::vector<std::string> left = words_of_statement(place.before),
                                           right = words_of_statement(place.now);
            for (size_t i = 0; left.size() == right.size() && i < left.size(); ++i)
                if (left[i] != right[i] && is_word_token(left[i]) && is_word_token(right[i])) all[right[i]] = left[i];
        }
        if (all.empty()) return;
        drop_words_of_both(all, before, now);
        if (all.empty()) return;
        const std::vector<size_t> locals = local_numbers(before);
        std::unordered_set<std::string_view> own;
        for (size_t i = 0; i < locals.size(); ++i)
            if (locals[i] != 0) own.insert(before[i]);
        std::erase_if(all, [&](const auto& one) { return !own.contains(one.second); });
        names_ = std::move(all);
    }

    bool is_all_of(const EditedPlace& place) const {
        if (place.before.empty() || place.now.empty()) return false;
        if (renames_what_it_declares(words_of_statement(place.before), words_of_statement(place.now))) return true;
        if (names_.empty()) return false;
        std::vector<std::string> words = words_of_statement(place.now);
        for (std::string& word : words)
            if (const auto found = names_.find(word); found != names_.end()) word = found->second;
        return written(words) == place.before;
    }

private:
    using Names = std::unordered_map<std::string, std::string>;

    static void drop_words_of_both(Names& all, const Words& before, const Words& now) {
        std::unordered_set<std::string_view> old_names, new_names;
        for (const auto& [new_name, old_name] : all) {
            new_names.insert(new_name);
            old_names.insert(old_name);
        }
        const auto found_in = [](const Words& text, const std::unordered_set<std::string_view>& names) {
            std::unordered_set<std::string_view> out;
            for (const std::string_view word : text)
                if (names.contains(word)) out.insert(word);
            return out;
        };
        const auto old_in_now = found_in(now, old_names), new_in_before = found_in(before, new_names);
        std::erase_if(
            all, [&](const auto& one) { return old_in_now.contains(one.second) || new_in_before.contains(one.first); });
    }

    Names names_;  ///< by the new one
};

/// Marks the places where no value changed: another spelling, a qualifier, the names of locals.
void mark_idle(UnitEdit& edit, const Words& before, const Words& now, UnitKind kind, Language language,
               const Dialect& dialect) {
    const PlainStatements plain(kind, language, dialect);
    const Renamed renamed(edit.places, before, now);
    const auto in_plain_words = [&](const WrittenStatement& statement) {
        const std::vector<std::string> words = words_of_statement(statement);
        return plain.translate(Words(words.begin(), words.end()), true);
    };
    for (EditedPlace& place : edit.places)
        place.idle = renamed.is_all_of(place) || in_plain_words(place.before) == in_plain_words(place.now);
}

/// The tokens of a unit one after the other, without what stands in its holes.
class TokensOfUnit {
public:
    TokensOfUnit(const ScannedFile& file, const Unit& unit)
        : file_(file), unit_(unit), hole_(unit.holes.begin()), next_(unit.tokens.first) {}

    /// None behind the last one.
    std::optional<std::string_view> next() {
        for (; next_ < unit_.tokens.end; ++next_) {
            while (hole_ != unit_.holes.end() && hole_->end <= next_) ++hole_;
            if (hole_ == unit_.holes.end() || next_ < hole_->first) return file_.lexed.view(next_++);
        }
        return std::nullopt;
    }

private:
    const ScannedFile& file_;
    const Unit& unit_;
    decltype(unit_.holes.begin()) hole_;
    uint32_t next_;
};

bool have_the_same_tokens(TokensOfUnit a, TokensOfUnit b) {
    for (;;) {
        const auto left = a.next(), right = b.next();
        if (left != right) return false;
        if (!left) return true;
    }
}

using UnitsByName = std::map<std::string_view, const Unit*>;

UnitsByName units_by_name(const ScannedFile* file) {
    UnitsByName out;
    if (file == nullptr) return out;
    for (const Unit& unit : file->units) out.emplace(unit.name, &unit);
    return out;
}

LoneVersion lone_version(const ScannedFile& file, const Unit& unit) {
    LoneVersion out{unit.name, unit.kind, normal_form(file, unit), {}};
    for (const std::string_view word : out.text.words()) out.words.push_back(std::hash<std::string_view>()(word));
    std::sort(out.words.begin(), out.words.end());
    return out;
}

}  // namespace

std::vector<std::string> words_of_statement(const WrittenStatement& statement) {
    std::vector<std::string> out;
    for (size_t at = 0; at < statement.size();) {
        const size_t end = std::min(statement.find(kBetweenWords, at), statement.size());
        out.push_back(statement.substr(at, end - at));
        at = end + 1;
    }
    return out;
}

bool renames_what_it_declares(const std::vector<std::string>& before, const std::vector<std::string>& now) {
    if (before.size() != now.size()) return false;
    const auto [old_word, new_word] = std::mismatch(before.begin(), before.end(), now.begin());
    if (old_word == before.end() || old_word == before.begin()) return false;
    const std::string &from = *old_word, &to = *new_word, &type = *(old_word - 1);
    if (!is_word_token(from) || !is_word_token(to) || !is_word_token(type) ||
        is_one_of(type, {"return", "case", "goto", "else", "new", "delete", "throw"}))
        return false;
    for (size_t i = 0; i < before.size(); ++i) {
        if (before[i] == to || now[i] == from) return false;
        if (before[i] != now[i] && (before[i] != from || now[i] != to)) return false;
    }
    return true;
}

std::vector<WrittenStatement> written_statements(const Words& text) {
    std::vector<WrittenStatement> out;
    for (const Statement& statement : split_statements(with_plain_statements(text), as_written_words))
        if (!statement.is_brace()) out.push_back(written(statement.common));
    return out;
}

UnitEdit unit_edit(const NormalText& before, const NormalText& now, UnitKind kind, Language language,
                   const Dialect& dialect) {
    UnitEdit out;
    if (before.size() + now.size() > kMostWordsOfUnit) return out;
    const Words old_words = before.words(), new_words = now.words();
    const Words old_text = with_plain_statements(old_words), new_text = with_plain_statements(new_words);
    if (old_text == new_text) return out;
    out.places = places_of(statement_edit(old_text, new_text, as_written_words));
    drop_moved(out.places);
    mark_idle(out, old_text, new_text, kind, language, dialect);
    return out;
}

float text_likeness(const LoneVersion& a, const LoneVersion& b) {
    constexpr size_t kLeast = 6;
    const size_t least = std::min(a.words.size(), b.words.size()), most = std::max(a.words.size(), b.words.size());
    if (least < kLeast || most > 3 * least) return 0;
    size_t common = 0;
    for (auto left = a.words.begin(), right = b.words.begin(); left != a.words.end() && right != b.words.end();) {
        if (*left == *right) {
            ++common;
            ++left;
            ++right;
        } else {
            ++(*left < *right ? left : right);
        }
    }
    return 2.0f * static_cast<float>(common) / static_cast<float>(least + most);
}

FileEdit file_edit(const ScannedFile* before, const ScannedFile* now, const Dialect& dialect) {
    FileEdit out;
    const UnitsByName old_units = units_by_name(before), new_units = units_by_name(now);
    for (const auto& [name, unit] : new_units) {
        const auto old_one = old_units.find(name);
        if (old_one == old_units.end()) {
            out.came.push_back(lone_version(*now, *unit));
            continue;
        }
        if (have_the_same_tokens({*before, *old_one->second}, {*now, *unit})) continue;
        UnitEdit edit = unit_edit(normal_form(*before, *old_one->second), normal_form(*now, *unit), unit->kind,
                                  now->language, dialect);
        edit.before_name = edit.now_name = name;
        if (!edit.places.empty()) out.edits.push_back(std::move(edit));
    }
    for (const auto& [name, unit] : old_units)
        if (!new_units.contains(name)) out.went.push_back(lone_version(*before, *unit));
    return out;
}

}  // namespace porttool
