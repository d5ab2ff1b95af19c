// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/substance.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

/// What the words of one place of a change are: some matter to the other side, some it has no name for.
struct Matter {
    float known = 0, unknown = 0;
    float slight = 0;  ///< known names of a letter or two that took another's place: another index, mostly

    float degree() const {
        constexpr float kBesideNewNames = 0.2f;
        const float all = known + (unknown > 0 ? kBesideNewNames : 1.0f) * slight;
        return all <= 0 ? 0 : std::min(1.0f, all) * all / (all + unknown);
    }

    /// A number that got a name, or a name whose number is written out: most often the same value.
    void add_named_number(const std::vector<const std::string*>& words, const KnownThere& there) {
        constexpr float kOtherValue = 0.3f;
        for (const std::string* word : words)
            if (is_word_token(*word) && !is_type_word(*word)) {
                known += kOtherValue * there.degree(*word);
                unknown += 1 - there.degree(*word);
            }
    }

    /// `replaces`: it stands in the place of other words, which a name that is new there would only rename.
    void add(const std::string& word, const KnownThere& there, bool replaces) {
        constexpr std::string_view kBrackets = "()[]{},;.:#@=";
        if (is_number_token(word)) {
            known += 1;
        } else if (!is_word_token(word)) {
            const bool bracket = word.size() == 1 && kBrackets.find(word[0]) != std::string_view::npos;
            if (!bracket && word != "->" && word != "::") known += 1;
        } else if (!is_type_word(word) && word != "return" && !there.is_type(word)) {
            const bool only_here =
                !there.side->contains(word) || (there.own->contains(word) && !there.unit->contains(word));
            const float degree = replaces && only_here ? 0.0f : there.degree(word);
            (replaces && word.size() < 3 ? slight : known) += degree;
            unknown += 1 - degree;
        }
    }
};

/// True for `. data ( )`, as a container gives its memory.
bool gives_memory(const std::vector<const std::string*>& words) {
    return words.size() == 4 && *words[0] == "." && *words[2] == "(" && *words[3] == ")" &&
           is_one_of(folded(*words[1]), {"data", "getdata", "getconstdata", "constdata", "get", "ptr"});
}

/// True if nothing but the way to a value changed: an object before a member, the first element of an array.
bool is_way_to_value(const std::vector<const std::string*>& words) {
    if (gives_memory(words)) return true;
    bool leads = false;
    for (const std::string* word : words) {
        const bool mark = *word == "." || *word == "[" || *word == "]" || *word == "::";
        leads = leads || mark;
        if (!mark && !is_word_token(*word) && *word != "0") return false;
    }
    return leads;
}

/// True for the `y` of `v . y`, as `v [ 1 ]` is said, too: which one it is matters like a number.
bool is_component(const std::string* word, const Text& of) {
    constexpr std::string_view kComponents = "xyzw";
    return word > of.data() && *(word - 1) == "." && word->size() == 1 &&
           kComponents.find(word->front()) != std::string_view::npos;
}

/// One place of a change: the words that went and those that came there.
struct ChangedPlace {
    std::vector<const std::string*> lost, gained;

    /// Those that came, or, where none did, those that went.
    const std::vector<const std::string*>& left() const { return gained.empty() ? lost : gained; }
    bool is_way() const {
        return (lost.empty() && is_way_to_value(gained)) || (gained.empty() && is_way_to_value(lost));
    }
    bool drops_argument() const {
        return gained.empty() && lost.size() == 2 && *lost[0] == "," &&
               (is_word_token(*lost[1]) || is_number_token(*lost[1]));
    }
    /// True if all names that came are of locals that are new.
    bool is_by_new_local(const std::set<std::string>& new_locals) const {
        const auto is_new = [&](const std::string* one) { return new_locals.contains(*one); };
        return std::any_of(gained.begin(), gained.end(), is_new) &&
               std::none_of(gained.begin(), gained.end(),
                            [&](const std::string* one) { return is_word_token(*one) && !is_new(one); });
    }
    /// True if a number got a name, or a name's number is written out.
    bool names_number() const {
        const auto is_number = [](const auto& words) { return words.size() == 1 && is_number_token(*words[0]); };
        const auto has_name = [](const auto& words) {
            return std::any_of(words.begin(), words.end(), [](const std::string* one) { return is_word_token(*one); });
        };
        return (is_number(lost) && has_name(gained)) || (is_number(gained) && has_name(lost));
    }
    const std::vector<const std::string*>& name_of_number() const {
        const bool was_number = lost.size() == 1 && is_number_token(*lost[0]);
        return gained.size() > lost.size() || was_number ? gained : lost;
    }
};

/// Adds what one place is worth. `text`: the statement in which its words stand.
void add_place(const ChangedPlace& place, const Text& text, const KnownThere& there, Matter& matter) {
    if (place.drops_argument()) {
        matter.add(*place.lost[1], there, true);
        matter.unknown += 1;
    } else if (place.is_by_new_local(*there.new_locals)) {
        // `a` became `a * scale`, or only got another name
        const bool joins =
            place.lost.empty() && place.gained.size() > 1 && is_one_of(*place.gained.front(), {"*", "/", "+", "-"});
        (joins ? matter.known : matter.unknown) += 1;
    } else if (place.names_number()) {
        matter.add_named_number(place.name_of_number(), there);
    } else if (!place.is_way()) {
        const bool replaces = !place.lost.empty() && !place.gained.empty();
        for (const std::string* word : place.left()) {
            if (is_component(word, text))
                matter.known += 1;
            else
                matter.add(*word, there, replaces);
        }
    }
}

/// What a statement sets, as `light` and `light . r`: the words before its `=`; none for other statements.
Text name_that_is_set(const Text& words) {
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "=") return out;
        if (i % 2 == 0 ? !is_word_token(words[i]) : words[i] != ".") return {};
        out.push_back(words[i]);
    }
    return {};
}

Text value_behind_name(const Text& words) {
    return {words.begin() + static_cast<ptrdiff_t>(name_that_is_set(words).size() + 1), words.end()};
}

/// True where one of two statements sets a component of what the other sets: `light = x`, `light.r = x`.
bool sets_component_of(const Text& before, const Text& now) {
    const Text from = name_that_is_set(before), to = name_that_is_set(now);
    const Text& shorter = from.size() < to.size() ? from : to;
    const Text& longer = from.size() < to.size() ? to : from;
    return !shorter.empty() && longer.size() == shorter.size() + 2 &&
           std::equal(shorter.begin(), shorter.end(), longer.begin());
}

}  // namespace

Text value_of(const Text& words) {
    if (!words.empty() && words[0] == "return") return {words.begin() + 1, words.end()};
    const bool plain = words.size() > 2 && is_word_token(words[0]) && words[1] == "=";
    return plain ? Text(words.begin() + 2, words.end()) : words;
}

float substance_of(const Text& before, const Text& now, const KnownThere& there) {
    Text old_value = value_of(before), new_value = value_of(now);
    if (sets_component_of(before, now)) {
        old_value = value_behind_name(before);
        new_value = value_behind_name(now);
    }
    ChangedPlace place;
    Matter matter;
    const auto finish = [&] {
        add_place(place, place.gained.empty() ? old_value : new_value, there, matter);
        place = {};
    };
    for (const DiffStep& step : diff(old_value, new_value)) {
        if (step.kind == DiffStep::Remove) place.lost.push_back(&old_value[step.before]);
        if (step.kind == DiffStep::Add) place.gained.push_back(&new_value[step.now]);
        if (step.kind == DiffStep::Keep) finish();
    }
    finish();
    return matter.degree();
}

bool is_turned_round(const Text& before, const Text& now) {
    if (before.empty() || now.empty() || before[0] != now[0] || (now[0] != "if" && now[0] != "return")) return false;
    constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kOpposites = {
        {{"<", ">="}, {">", "<="}, {"==", "!="}}};
    const std::vector<DiffStep> steps = diff(before, now);
    std::vector<std::string> lost, gained;
    for (const DiffStep& step : steps) {
        if (step.kind == DiffStep::Remove) lost.push_back(before[step.before]);
        if (step.kind == DiffStep::Add) gained.push_back(now[step.now]);
    }
    for (const Text* one : {&lost, &gained})
        if (one->size() > 1) return false;
    if (lost.empty() || gained.empty()) return (lost.empty() ? gained : lost) == Text{"!"};
    return std::any_of(kOpposites.begin(), kOpposites.end(), [&](const auto& two) {
        return (lost[0] == two.first && gained[0] == two.second) || (lost[0] == two.second && gained[0] == two.first);
    });
}

}  // namespace porttool
