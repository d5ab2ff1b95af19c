// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/named_parts.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "porttool/compare/lone_edit.h"
#include "porttool/language/words.h"
#include "porttool/value_graph/pure_calls.h"

namespace porttool {
namespace {

constexpr size_t kMostTokens = 20'000, kLongestPart = 64, kMostWritten = 100'000;

bool is_assignment(std::string_view sign) {
    return sign == "=" || (sign.size() > 1 && sign.back() == '=' && sign != "==" && sign != "!=");
}

/// True for what a value may need parentheses for, where it stands in the place of its name.
bool is_operation(std::string_view word) {
    return !is_word_token(word) && !is_number_token(word) && word != "." && word != "->" && word != "::" &&
           word != "(" && word != ")" && word != ",";
}

/// A local that is given its value where it is declared: `const int at = threadIdx . x ;`.
struct NamedPart {
    size_t first = 0, end = 0;  ///< of the declaration
    size_t value = 0;           ///< where its value begins
    std::string_view name;
};

class PartReader {
public:
    PartReader(const Words& text, const Dialect& dialect) : text_(text), dialect_(dialect) {
        for (const std::string_view word : text) ++times_[word];
        for (size_t i = 0; i < text.size(); ++i) note_changed(i);
        note_assigned();
        const auto body = static_cast<size_t>(std::find(text.begin(), text.end(), "{") - text.begin());
        for (size_t i = 1; i < text.size(); ++i) note_own(i);
        note_calls(body);
        for (size_t i = 1; i < text.size(); ++i)
            if (text[i - 1] == ";" || text[i - 1] == "{" || text[i - 1] == "}") note_declaration(i);
    }

    /// The parts that have a name which the other text does not have, which stands somewhere, and that are the same
    /// wherever it does.
    std::vector<NamedPart> parts_beside(const PartReader& other) const {
        std::vector<NamedPart> out;
        for (const NamedPart& each : named_)
            if (!other.times_.contains(each.name) && times_.at(each.name) > 1 && is_fixed(each)) out.push_back(each);
        return out;
    }

    /// The text with these in the place of their names; nothing where that takes too many words.
    Words written_out(const std::vector<NamedPart>& parts) const {
        std::unordered_map<std::string_view, const NamedPart*> by_name;
        std::unordered_map<size_t, size_t> declarations;
        for (const NamedPart& each : parts) {
            by_name.emplace(each.name, &each);
            declarations.emplace(each.first, each.end);
        }
        Words out;
        for (size_t i = 0; i < text_.size() && out.size() < kMostWritten;) {
            const auto declaration = declarations.find(i);
            if (declaration == declarations.end())
                write(i++, by_name, out, 0);
            else
                i = declaration->second;
        }
        return out.size() < kMostWritten ? out : Words();
    }

private:
    using ByName = std::unordered_map<std::string_view, const NamedPart*>;

    std::string_view word(size_t i) const { return i < text_.size() ? text_[i] : std::string_view(); }

    /// What a pointer or a step changes.
    void note_changed(size_t i) {
        const bool takes_address = text_[i] == "&" && is_word_token(word(i + 1)) && i > 0 &&
                                   !is_word_token(text_[i - 1]) && text_[i - 1] != ")" && text_[i - 1] != "]";
        if (takes_address || text_[i] == "++" || text_[i] == "--")
            for (size_t k = i + 1; is_word_token(word(k)) || word(k) == "." || word(k) == "->"; ++k)
                times_written_[text_[k]] += 2;
    }

    /// What stands before an assignment, in its statement and its brackets: of `a [ i ] . b = ...` it is `a` and `b`,
    /// to be sure. From the end, once for all assignments: those further on are open, the innermost last.
    void note_assigned() {
        struct Open {
            int depth, in_index;
            size_t alike;  ///< how many of the last ones, with this, are in the same index
        };
        std::vector<Open> open;
        int depth = 0, in_index = 0;
        for (size_t k = text_.size(); k-- > 0;) {
            const std::string_view here = text_[k];
            in_index += here == "]" ? 1 : here == "[" ? -1 : 0;
            depth += here == ")" ? 1 : here == "(" ? -1 : 0;
            if (here == ";" || here == "{" || here == "}") open.clear();
            while (!open.empty() && (depth < open.back().depth || in_index < open.back().in_index)) open.pop_back();
            if (!open.empty()) {
                stores_elsewhere_ = stores_elsewhere_ || here == "[" || here == "->" || here == "*";
                if (is_word_token(here) && open.back().in_index == in_index) times_written_[here] += open.back().alike;
            }
            if (!is_assignment(here) && here != "++" && here != "--") continue;
            const bool is_alike = !open.empty() && open.back().in_index == in_index;
            open.push_back({depth, in_index, is_alike ? open.back().alike + 1 : 1});
        }
    }

    /// Parameters and locals: `float x`. Of a pointer or a reference it is not known what else leads there.
    void note_own(size_t i) {
        if (is_word_token(text_[i]) && is_word_token(text_[i - 1]) && !word_is(text_[i - 1], kNoType))
            own_.insert(text_[i]);
    }

    bool is_unknown_call(size_t i) const {
        return is_word_token(text_[i]) && word(i + 1) == "(" && !word_is(text_[i], kNoFunctionName) &&
               !is_type_word(text_[i]) && !pure_call(text_[i], dialect_).is_pure;
    }

    /// A call of what is not known may change what it is given, its object, and all that is not the function's own.
    void note_calls(size_t body) {
        std::vector<bool> brackets;  ///< those that are open, and whether they are of such a call
        size_t given_to = 0;         ///< such calls
        bool called = false;
        for (size_t i = body; i < text_.size(); ++i) {
            if (is_word_token(text_[i]) && given_to > 0) times_written_[text_[i]] += 2 * given_to;
            if (text_[i] == ")" && !brackets.empty()) {
                given_to -= brackets.back();
                brackets.pop_back();
            }
            if (text_[i] == "(") {
                brackets.push_back(called);
                given_to += called;
            }
            called = is_unknown_call(i);
            if (!called) continue;
            calls_ = true;
            for (size_t k = i; k >= 2 && (text_[k - 1] == "." || text_[k - 1] == "->"); k -= 2)
                times_written_[text_[k - 2]] += 2;
        }
    }

    void note_declaration(size_t first) {
        size_t i = first;
        while (is_word_token(word(i)) && (is_word_token(word(i + 1)) || word(i + 1) == "::"))
            i += word(i + 1) == "::" ? 2 : 1;
        if (i == first || !is_word_token(word(i)) || word(i + 1) != "=") return;
        if (word(first) == "static" || word(first) == "volatile") return;
        size_t end = i + 2;
        while (end < text_.size() && end < i + kLongestPart && text_[end] != ";") ++end;
        if (word(end) != ";" || end == i + 2) return;
        named_.push_back({first, end + 1, i + 2, text_[i]});
        declared_.insert(text_[i]);
    }

    static bool ends_operand(std::string_view word) {
        return is_word_token(word) || is_number_token(word) || word == ")" || word == "]";
    }

    /// True for a name that no call changes which is not given it; members are what their object is.
    bool is_steady(size_t i) const {
        return text_[i - 1] == "." || own_.contains(text_[i]) || word(i + 1) == "(" || is_type_word(text_[i]) ||
               is_fixed_name(text_[i], dialect_);
    }

    bool is_written(std::string_view name, size_t times) const {
        const auto found = times_written_.find(name);
        return found != times_written_.end() && found->second > times;
    }

    bool is_fixed(const NamedPart& one) const {
        if (is_written(one.name, 1)) return false;
        int depth = 0;
        for (size_t i = one.value; i + 1 < one.end; ++i) {
            const std::string_view sign = text_[i];
            depth += sign == "(" ? 1 : sign == ")" ? -1 : 0;
            if (sign == "[" || sign == "{" || sign == "?" || (sign == "," && depth == 0)) return false;
            const bool leads_elsewhere = sign == "->" || (sign == "*" && !ends_operand(word(i - 1)));
            if (leads_elsewhere && (calls_ || stores_elsewhere_)) return false;
            if (!is_word_token(sign)) continue;
            if (calls_ && !is_steady(i)) return false;
            if (word(i + 1) == "(" ? !pure_call(sign, dialect_).is_pure
                                   : is_written(sign, declared_.contains(sign) ? 1 : 0))
                return false;
        }
        return true;
    }

    void write(size_t i, const ByName& by_name, Words& out, int depth) const {
        constexpr int kMostNames = 4;
        const auto found = by_name.find(text_[i]);
        const bool is_member = i > 0 && (text_[i - 1] == "." || text_[i - 1] == "->" || text_[i - 1] == "::");
        if (found == by_name.end() || is_member || depth == kMostNames) return out.push_back(text_[i]);
        const NamedPart& one = *found->second;
        const auto at = [&](size_t place) { return text_.begin() + static_cast<std::ptrdiff_t>(place); };
        const bool in_parentheses = std::any_of(at(one.value), at(one.end - 1), is_operation);
        if (in_parentheses) out.emplace_back("(");
        for (size_t k = one.value; k + 1 < one.end; ++k) write(k, by_name, out, depth + 1);
        if (in_parentheses) out.emplace_back(")");
    }

    const Words& text_;
    const Dialect& dialect_;
    std::unordered_map<std::string_view, size_t> times_, times_written_;
    std::vector<NamedPart> named_;
    std::unordered_set<std::string_view> declared_, own_;
    bool calls_ = false;             ///< functions of which nothing is known
    bool stores_elsewhere_ = false;  ///< through a pointer, or into an array
};

}  // namespace

bool only_names_parts(const Words& before, const Words& now, UnitKind kind, Language language, const Dialect& dialect) {
    if (before.size() + now.size() > kMostTokens) return false;
    const PartReader then(before, dialect), today(now, dialect);
    const auto gone = then.parts_beside(today), came = today.parts_beside(then);
    if (gone.empty() && came.empty()) return false;
    const Words old_text = then.written_out(gone), new_text = today.written_out(came);
    return !old_text.empty() && !new_text.empty() &&
           lone_edit(old_text, new_text, kind, language, dialect, true).means_nothing;
}

}  // namespace porttool
