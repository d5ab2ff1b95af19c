// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/translator.h"

#include <algorithm>

#include "porttool/language/sister_runtime.h"
#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/operands.h"

namespace porttool {
namespace {

/// True for several components of a vector by their letters: `xy`, `rgba`.
bool is_swizzle(std::string_view word) {
    if (word.size() < 2 || word.size() > 4) return false;
    for (const std::string_view letters : {"xyzw", "rgba", "stpq"})
        if (word.find_first_not_of(letters) == std::string_view::npos) return true;
    return false;
}

/// True for OpenCL's `( T ) ( a , b )` at `i`: of several parts, so that it is no cast.
bool is_vector_literal(const std::vector<std::string>& words, size_t i, size_t end) {
    if (i + 4 >= end || words[i] != "(" || !is_word_token(words[i + 1]) || words[i + 2] != ")" || words[i + 3] != "(")
        return false;
    if (i > 0 && is_word_token(words[i - 1]) && words[i - 1] != "return") return false;
    int depth = 0;
    for (size_t k = i + 3; k < end; ++k) {
        depth += words[k] == "(" ? 1 : words[k] == ")" ? -1 : 0;
        if (depth == 0) return false;
        if (depth == 1 && words[k] == ",") return true;
    }
    return false;
}

/// True for the name that `# ifdef NAME`, `# ifndef NAME` or `defined ( NAME )` asks for.
bool asks_for_macro(const std::vector<std::string>& words, size_t i) {
    if (i > 1 && words[i - 2] == "#" && (words[i - 1] == "ifdef" || words[i - 1] == "ifndef")) return true;
    return i > 0 && (words[i - 1] == "defined" || (i > 1 && words[i - 1] == "(" && words[i - 2] == "defined"));
}

/// Where the bracket that opens at `open` closes, if there is a comma directly within; else `end`.
size_t end_of_parts(const std::vector<std::string>& words, size_t open, size_t end) {
    int depth = 0;
    bool parts = false;
    for (size_t k = open; k < end; ++k) {
        const std::string& word = words[k];
        depth += word == "(" || word == "[" || word == "{" ? 1 : word == ")" || word == "]" || word == "}" ? -1 : 0;
        parts |= depth == 1 && word == ",";
        if (depth == 0) return parts ? k : end;
    }
    return end;
}

/// True for what is taken of the standard library there.
bool has_std_scope(const std::vector<std::string>& words, size_t i) {
    return words[i] == "std" || (i > 1 && words[i - 1] == "::" && words[i - 2] == "std");
}

/// True for a member of a class of the standard library that has arguments: `max` of `std :: numeric_limits < T > ::
/// max`.
bool is_of_std_template(const std::vector<std::string>& words, size_t i) {
    if (i < 6 || words[i - 1] != "::" || words[i - 2] != ">") return false;
    int depth = 0;
    for (size_t k = i - 1; k-- > 2;) {
        depth += words[k] == ">" ? 1 : words[k] == "<" ? -1 : 0;
        if (is_one_of(words[k], {";", "{", "}"})) return false;
        if (depth == 0) return words[k - 2] == "::" && has_std_scope(words, k - 1);
    }
    return false;
}

/// True for `< T > (` behind a name.
bool has_template_arguments(const std::vector<std::string>& words, size_t open) {
    constexpr size_t kLongest = 6;
    if (words[open] != "<" || !is_word_token(words[open - 1])) return false;
    for (size_t i = open + 1; i + 1 < std::min(words.size(), open + kLongest); ++i)
        if (words[i] == ">") return i > open + 1 && words[i + 1] == "(";
    return false;
}

/// A phrase that begins with the scope that was just written goes on from there.
void drop_prefix_there(const std::vector<CarriedWord>& written, std::vector<std::string>& phrase) {
    const size_t size = written.size();
    if (size < 2 || phrase.size() < 3 || phrase[1] != "::" || written[size - 1].text != "::" ||
        written[size - 2].text != phrase[0])
        return;
    phrase.erase(phrase.begin(), phrase.begin() + 2);
}

}  // namespace

std::string written_number(const std::string& word) {
    const bool marked = word.size() > 1 && word.back() == 'f' && is_number_token(word) && word[1] != 'x';
    if (!marked || word.find_first_of(".e") != std::string::npos) return word;
    return word.substr(0, word.size() - 1) + ".0f";
}

/// `CVector4 ( a , b )` of C++ is `( REAL4 ) { a , b }` in C, and the other way round, by what the target's file does.
bool EditTranslator::carry_literal(const std::vector<std::string>& words, size_t& i, size_t end,
                                   const std::function<std::string(size_t)>& written, CarriedWords& out) const {
    const bool after_name = i > 0 && ((is_word_token(words[i - 1]) && words[i - 1] != "return") ||
                                      words[i - 1] == "." || words[i - 1] == "->" || words[i - 1] == "::");
    const bool enclosed = words[i] == "(" && i + 3 < end && is_word_token(words[i + 1]) && words[i + 2] == ")";
    const size_t name = enclosed ? i + 1 : i, open = enclosed ? i + 3 : i + 1;
    if (after_name || enclosed == known_.has_literals() || !is_word_token(words[name]) || open >= end) return false;
    if (words[open] != "{" && (words[open] != "(" || units_.names.contains(words[name]))) return false;
    const size_t close = end_of_parts(words, open, end);
    const std::string type = close == end ? std::string() : type_named(words[name]);
    const std::string bracket = type.empty() ? type : known_.opens_literal(type);
    if (bracket.empty()) return false;
    const auto put = [&](std::string text, size_t from) { out.words.push_back({std::move(text), from}); };
    if (!enclosed) put("(", CarriedWord::kNoSource);
    put(type, name);
    if (!enclosed) put(")", CarriedWord::kNoSource);
    put(bracket, open);
    CarriedWords within = carry(words, open + 1, close, written);
    out.words.insert(out.words.end(), within.words.begin(), within.words.end());
    out.unknown.insert(out.unknown.end(), within.unknown.begin(), within.unknown.end());
    put(bracket == "{" ? "}" : ")", close);
    i = close + 1;
    return true;
}

bool EditTranslator::carry_cast(const std::vector<std::string>& words, size_t& i, size_t end,
                                const std::function<std::string(size_t)>& written, CarriedWords& out) const {
    const bool after_name = i > 0 && is_word_token(words[i - 1]) && words[i - 1] != "return";
    if (!known_.lacks_casts() || after_name || words[i] != "(" || i + 3 >= end || !is_type_word(words[i + 1]) ||
        words[i + 2] != ")" || words[i + 3] == "-")
        return false;
    // What the cast takes: one operand, to where nothing goes on with it.
    size_t last = i + 3;
    int depth = 0;
    for (; last < end; ++last) {
        depth += is_one_of(words[last], {"(", "["}) ? 1 : is_one_of(words[last], {")", "]"}) ? -1 : 0;
        const bool goes_on = last + 1 < end && (is_accessor(words[last]) || is_accessor(words[last + 1]) ||
                                                is_one_of(words[last + 1], {"(", "["}));
        if (depth < 0 || (depth == 0 && !goes_on)) break;
    }
    const std::string type = type_named(words[i + 1]);
    if (last >= end || depth != 0 || type.empty() || !is_operand(words, i + 3, last + 1)) return false;
    const bool is_grouped = words[i + 3] == "(" && closing_bracket(words, i + 3, end) == last;
    CarriedWords within = carry(words, i + 3, last + 1, written);
    out.words.push_back({type, i + 1});
    if (!is_grouped) out.words.push_back({"(", i + 2});
    out.words.insert(out.words.end(), within.words.begin(), within.words.end());
    if (!is_grouped) out.words.push_back({")", last + 1});
    out.unknown.insert(out.unknown.end(), within.unknown.begin(), within.unknown.end());
    i = last + 1;
    return true;
}

bool EditTranslator::carry_launch(const std::vector<std::string>& words, size_t first, size_t end,
                                  const std::function<std::string(size_t)>& written, CarriedWords& out) const {
    using Form = LaunchManner::Form;
    const std::optional<LaunchParts> launch = parts_of_launch(words, first, end);
    const LaunchManner& manner = known_.launches();
    if (!launch || manner.form == Form::Unknown || manner.form == launch->form) return false;
    // What the source has no word for stands for the one behind it.
    const auto put = [&](std::initializer_list<const char*> texts, size_t from) {
        for (const char* text : texts) out.words.push_back({text, from});
    };
    const auto put_run = [&](LaunchParts::Run run) {
        CarriedWords part = carry(words, run.first, run.end, written);
        out.words.insert(out.words.end(), part.words.begin(), part.words.end());
        out.unknown.insert(out.unknown.end(), part.unknown.begin(), part.unknown.end());
    };
    const auto is_wrapped = [&](LaunchParts::Run run) {
        return words[run.first] == "dim3" && run.end > run.first + 1 && words[run.first + 1] == "(";
    };
    const auto is_zero = [&](LaunchParts::Run run) { return run.end == run.first + 1 && words[run.first] == "0"; };
    constexpr size_t kNone = CarriedWord::kNoSource;
    size_t behind = launch->kernel.end;
    if (manner.form == Form::Function) {
        const bool has_arguments = launch->kernel.end > launch->kernel.first + 1;
        put({"hipLaunchKernelGGL", "("}, kNone);
        if (has_arguments) put({"HIP_KERNEL_NAME", "("}, kNone);
        put_run(launch->kernel);
        if (has_arguments) put({")"}, behind);
        for (size_t i = 0; i < LaunchParts::kMostExtents; ++i) {
            const bool is_said = i < launch->extents.size();
            const bool wraps = is_said && i < 2 && manner.wraps_extents && !is_wrapped(launch->extents[i]);
            put({","}, behind);
            if (wraps) put({"dim3", "("}, behind);
            if (is_said) {
                put_run(launch->extents[i]);
                behind = launch->extents[i].end;
            } else {
                put({"0"}, behind);
            }
            if (wraps) put({")"}, behind);
        }
        if (launch->arguments.end > launch->arguments.first) put({","}, behind);
    } else {
        size_t count = launch->extents.size();
        while (count > 2 && is_zero(launch->extents[count - 1])) --count;
        put_run(launch->kernel);
        put({"<", "<", "<"}, behind);
        for (size_t i = 0; i < count; ++i) {
            if (i > 0) put({","}, behind);
            put_run(launch->extents[i]);
            behind = launch->extents[i].end;
        }
        put({">", ">", ">", "("}, behind);
    }
    put_run(launch->arguments);
    put({")"}, end - 2);
    put({";"}, end - 1);
    return true;
}

/// A statement that differs from others of the pair by the name of a unit.
bool EditTranslator::carry_pattern(const std::vector<std::string>& words, size_t first, size_t end,
                                   CarriedWords& out) const {
    const StatementPatterns::Said pattern = pair_.patterns().said(words, first, end);
    if (pattern.target.empty()) return false;
    const auto unit = units_.names.find(words[pattern.name]);  // whose name means the same wherever it stands
    if (unit == units_.names.end() || unit->second.size() != 1) return false;
    const std::string& name = *unit->second.begin();
    for (const std::string& said : pattern.target)
        out.words.push_back({said.empty() ? name : written_there(said), CarriedWord::kNoSource});
    return true;
}

CarriedWords EditTranslator::carry(const std::vector<std::string>& words, size_t first, size_t end,
                                   const std::function<std::string(size_t)>& written) const {
    CarriedWords out = carry_words(words, first, end, written);
    // A member of what the port has a pointer to.
    for (size_t i = 1; i < out.words.size(); ++i)
        if (out.words[i].text == "." && around_.pointers.contains(out.words[i - 1].text) &&
            (i == 1 || !is_accessor(out.words[i - 2].text)))
            out.words[i].text = "->";
    return out;
}

CarriedWords EditTranslator::carry_words(const std::vector<std::string>& words, size_t first, size_t end,
                                         const std::function<std::string(size_t)>& written) const {
    CarriedWords out;
    if (carry_pattern(words, first, end, out) || carry_launch(words, first, end, written, out)) return out;
    if (around_.wait && waits_for_device(words, first, end) && pair_.longest(words, first, end).length == 0) {
        for (const std::string& word : *around_.wait) out.words.push_back({word, CarriedWord::kNoSource});
        return out;
    }
    const auto head_end = static_cast<size_t>(std::find(words.begin(), words.end(), "{") - words.begin());
    for (size_t i = first; i < end;) {
        if (is_number_token(words[i])) {
            out.words.push_back({number(written(i)), i});
            ++i;
            continue;
        }
        if (carry_literal(words, i, end, written, out)) continue;
        if (carry_cast(words, i, end, written, out)) continue;
        if (known_.lacks_casts() && words[i] == "(" && i + 2 < words.size() && is_type_word(words[i + 1]) &&
            words[i + 2] == ")" && (i == 0 || !is_word_token(words[i - 1]) || words[i - 1] == "return"))
            out.unknown.push_back("(" + words[i + 1] + ")");
        // A literal of a whole struct, which C++ writes otherwise.
        const bool after_head = i > 0 && is_word_token(words[i - 1]) && words[i - 1] != "return";
        if (!known_.has_literals() && !after_head && words[i] == "(" && i + 3 < words.size() &&
            is_word_token(words[i + 1]) && words[i + 2] == ")" && words[i + 3] == "{")
            out.unknown.push_back("(" + words[i + 1] + "){");
        if (units_.other_parameters.contains(words[i]) && i + 1 < end && words[i + 1] == "(")
            out.unknown.push_back(words[i] + "()");
        if (known_.constructs_vectors() && is_vector_literal(words, i, end)) {
            const std::string type = word(words[i + 1], Use::Type);
            if (type.empty()) out.unknown.push_back(words[i + 1]);
            out.words.push_back({type.empty() ? words[i + 1] : type, i + 1});
            i += 3;
            continue;
        }
        if (known_.has_std() && is_of_std_template(words, i)) {
            out.words.push_back({words[i], i});
            ++i;
            continue;
        }
        if (lone_.contains(words[i])) {
            out.unknown.push_back(words[i]);
            out.words.push_back({words[i], i});
            ++i;
            continue;
        }
        size_t stop = i;  // no phrase goes over what is not known
        while (stop < std::min(end, i + Examples::kLongest) && !lone_.contains(words[stop])) ++stop;
        Examples::Phrase phrase = pair_.longest(words, i, stop, i < head_end);
        if (phrase.length == 0 && is_word_token(words[i]) && !brought_.contains(words[i]))
            phrase = beside_.file().longest(words, i, stop, i < head_end);
        if (drops_std(words, i, phrase)) phrase = {};
        if (phrase.length > phrase.target.size() && i + phrase.length < words.size() &&
            has_template_arguments(words, i + phrase.length) && has_std_scope(words, i))
            out.unknown.push_back(words[i + phrase.length - 1] + "<>");
        if (phrase.length > 0) {
            drop_prefix_there(out.words, phrase.target);
            put_phrase(phrase, words, i, written, out);
            i += phrase.length;
            continue;
        }
        if (words[i].starts_with('"') && known_.names_one_side(words[i])) out.unknown.push_back(words[i]);
        if (!is_word_token(words[i])) {
            out.words.push_back({written(i), i});
            ++i;
            continue;
        }
        const bool member = i > 0 && (words[i - 1] == "." || words[i - 1] == "->");
        const bool method = member && i + 1 < words.size() && words[i + 1] == "(" && !known_.has_methods();
        const bool called = i + 1 < words.size() && words[i + 1] == "(", scoped = i > 0 && words[i - 1] == "::";
        const bool declares = i + 1 < words.size() && (is_word_token(words[i + 1]) || words[i + 1] == "*");
        const Use use = called && !scoped ? Use::Call : declares ? Use::Type : Use::Value;
        const bool is_std = i > 1 && words[i - 1] == "::" && words[i - 2] == "std" && known_.has_std();
        std::string said = method                                                                ? std::string()
                           : is_std || (member && called && known_.is_standard_method(words[i])) ? words[i]
                           : member ? this->member(words[i])
                                    : word(words[i], use);
        if (said.empty() && asks_for_macro(words, i) && known_.is_macro_of_build(words[i])) said = words[i];
        if (said.empty()) out.unknown.push_back(words[i]);
        if (use == Use::Call && !member && !units_.names.contains(words[i]) && known_.is_builtin(said))
            for (const std::string& word : around_.scope) out.words.push_back({word, CarriedWord::kNoSource});
        out.words.push_back({said.empty() ? words[i] : said, i});
        ++i;
    }
    return out;
}

/// Adds a phrase; where the target says it in the same words, each keeps its source.
void EditTranslator::put_phrase(const Examples::Phrase& phrase, const std::vector<std::string>& words, size_t at,
                                const std::function<std::string(size_t)>& written, CarriedWords& out) const {
    const bool same = phrase.target.size() == phrase.length;
    for (size_t k = 0; k < phrase.target.size(); ++k) {
        const bool kept = same && phrase.target[k] == words[at + k];
        out.words.push_back(
            {kept ? written(at + k) : written_there(phrase.target[k]), same ? at + k : CarriedWord::kNoSource});
    }
    if (!same && !phrase.target.empty()) out.words[out.words.size() - phrase.target.size()].from = at;
}

/// True for a phrase that says `std ::` without it, before a name that the port's file never has so: what it does for
/// `std :: max` is no example of `std :: chrono`.
bool EditTranslator::drops_std(const std::vector<std::string>& words, size_t i, const Examples::Phrase& phrase) const {
    const size_t next = i + phrase.length;
    return phrase.length >= 2 && words[next - 2] == "std" && words[next - 1] == "::" && next < words.size() &&
           (phrase.target.empty() || phrase.target.back() != "::") && !known_.is_there_without_scope(words[next]);
}

std::vector<std::string> EditTranslator::meaning(const std::vector<std::string>& words, size_t first,
                                                 size_t end) const {
    std::vector<std::string> out;
    for (size_t i = first; i < end; ++i) {
        if (i + 1 < end && words[i + 1] == "::") {
            ++i;
            continue;
        }
        if (words[i] == "::") continue;
        std::string word = known_.meaning(words[i]);
        if (!word.empty()) out.push_back(std::move(word));
    }
    return out;
}

bool EditTranslator::calls_otherwise(const std::vector<std::string>& words, size_t first, size_t end) const {
    for (size_t i = first; i + 1 < end; ++i)
        if (units_.other_parameters.contains(words[i]) && (words[i + 1] == "(" || has_template_arguments(words, i + 1)))
            return true;
    return false;
}

bool EditTranslator::are_qualifiers(const std::vector<std::string>& words, size_t first, size_t end) const {
    for (size_t i = first; i < end; ++i)
        if (!word_is(words[i], kQualifier) || (!known_.in_file(words[i]) && !known_.is_qualifier_of_both(words[i])))
            return false;
    return true;
}

/// As the pair writes numbers, else as its files do; a float of a shading language is one of C's.
std::string EditTranslator::number(const std::string& written) const {
    if (pair_.knows_mark_of(written)) return pair_.number(written);
    if (beside_.file().knows_mark_of(written)) return beside_.file().number(written);
    return known_.needs_float_marks() || known_.marks_reals() ? Examples::marked(written) : written;
}

/// A field that the source does not declare is of a type that both sides have from elsewhere.
std::string EditTranslator::member(std::string_view text) const {
    if (is_swizzle(text) && !known_.in_file(text)) return {};
    if (known_.is_of_source(text)) return word(text, Use::Value);
    const std::optional<std::string> said = known_.is_known_there(text) ? std::nullopt : in_other_part(text);
    return said ? *said : std::string(text);
}

/// A type or a function, which mean the same in all files; a variable may be another one in each.
std::string EditTranslator::said_in_folder(std::string_view text, Use use) const {
    if (use == Use::Value) return {};
    const Examples::Phrase phrase = beside_.folder().longest({std::string(text)}, 0, 1);
    return phrase.length == 1 && phrase.target.size() == 1 && is_word_token(phrase.target[0]) ? phrase.target[0] : "";
}

std::string EditTranslator::type_named(const std::string& name) const {
    for (const Examples* examples : {&pair_, &beside_.file()})
        if (const Examples::Phrase said = examples->longest({name}, 0, 1);
            said.length == 1 && said.target.size() == 1 && is_word_token(said.target[0]))
            return said.target[0];
    return word(name, Use::Type);
}

std::string EditTranslator::word(std::string_view text, Use use) const {
    if (const auto unit = units_.names.find(text); unit != units_.names.end() && unit->second.size() == 1)
        return *unit->second.begin();
    if (text == "this" && around_.is_method && known_.are_both_cpp()) return std::string(text);
    // What the source's files count in, and the port's in none of its own, has another name there.
    const bool is_other_real =
        !known_.in_file(text) && (around_.reals.contains(text) || known_.may_lack(text)) && !brought_.contains(text);
    const bool is_of_language = word_is(text, kKeyword | kTypePart | kConstant) && !is_other_real;
    if (brought_.contains(text) || is_of_language || known_.in_file(text) || known_.is_qualifier_of_both(text))
        return std::string(text);
    if (std::string said = known_.in_dialect(text, use == Use::Call); !said.empty()) return said;
    if (sister_name(text) != nullptr) return known_.in_sister_runtime(text);
    if (std::string said = pair_.renamed(text); !said.empty()) return said;
    if (std::string said = beside_.file().renamed(text); !said.empty()) return said;
    if (std::string said = said_in_folder(text, use); !said.empty()) return said;
    if (std::string said = known_.in_sister_runtime(text); !said.empty()) return said;
    if (is_other_real) return known_.is_known_there(text) ? std::string(text) : std::string();
    if (!known_.is_known_there(text))
        if (const std::optional<std::string> said = in_other_part(text)) return *said;
    if (known_.anywhere(text)) return known_.is_known_there(text) ? std::string(text) : pair_.with_prefix_there(text);
    if (std::string said = known_.in_other_manner(text); !said.empty()) return said;
    if (use != Use::Call && known_.is_of_shared_family(text)) return std::string(text);
    return from_elsewhere(text, use);
}

std::optional<std::string> EditTranslator::in_other_part(std::string_view text) const {
    for (const Examples* examples : {&pair_, &beside_.file()})
        if (examples->has_other_part(text)) return examples->with_other_part(text);
    return std::nullopt;
}

/// A name that no file of either side declares comes from a header of both: what host code calls, what is as new to the
/// source's file there, and what the methods of one class have.
std::string EditTranslator::from_elsewhere(std::string_view text, Use use) const {
    if (!known_.share_headers() || !is_from_elsewhere(text, text)) return {};
    if (use == Use::Call)
        for (const Examples* examples : {&pair_, &beside_.file()})
            if (std::optional<std::string> said = examples->with_part_gained(text)) return *said;
    const bool both_have = (use == Use::Call && around_.on_host && known_.are_both_cpp()) || around_.is_of_one_class ||
                           (around_.on_host && around_.fresh.contains(text));
    return both_have ? pair_.with_prefix_there(text) : std::string();
}

}  // namespace porttool
