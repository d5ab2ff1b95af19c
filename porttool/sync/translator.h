// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/sync/device_wait.h"
#include "porttool/sync/examples.h"
#include "porttool/sync/known_words.h"

namespace porttool {

/// A word as the target is to have it.
struct CarriedWord {
    static constexpr size_t kNoSource = static_cast<size_t>(-1);
    std::string text;
    size_t from = kNoSource;  ///< the word of the source's new text that it stands for
};

/// Words in the target's manner, and those that it could not say there.
struct CarriedWords {
    std::vector<CarriedWord> words;
    std::vector<std::string> unknown;
};

/// What other pairs say, learned when it is asked for: those of the same files, those of the same two folders.
struct LearnedBeside {
    std::function<const Examples&()> file, folder;
};

/// What the target calls the units of the source, by the last part of their names.
struct UnitNames {
    std::map<std::string, std::set<std::string>, std::less<>> names;
    std::set<std::string, std::less<>> other_parameters;  ///< those that take another number of arguments there
};

/// What is known of the unit that changes, beside its text.
struct UnitSurroundings {
    bool on_host = false;                              ///< nothing of it runs on a device
    bool is_method = false;                            ///< the port is one
    bool is_of_one_class = false;                      ///< both sides' units are methods of classes of one name
    DeviceWait wait = {};                              ///< of the port
    std::vector<std::string> scope = {};               ///< that the port calls every built-in in: `sycl ::`
    std::set<std::string, std::less<>> fresh = {};     ///< words that its file did not have before the edit
    std::set<std::string, std::less<>> reals = {};     ///< types of real numbers that it had before the edit
    std::set<std::string, std::less<>> gone = {};      ///< units that its file had before the edit
    std::set<std::string, std::less<>> pointers = {};  ///< variables that the port declares so
    std::map<std::string, std::string> numbers = {};   ///< of the port, by their normal form, as it writes them
};

/// A number of the normal form as code has it: `1f` is `1.0f`.
std::string written_number(const std::string& word);

/// Says in the target's manner what the source says: as the pair does elsewhere, else as other pairs of its files do
/// and, of types and functions, those of its folders, else in the words of the dialect that the target's files use,
/// else with the same words where the target knows them.
class EditTranslator {
public:
    /// All must outlive it. `lone`: names of units that have no counterpart yet; `brought`: names that the edit itself
    /// brings in.
    EditTranslator(const Examples& pair, const LearnedBeside& beside, const UnitNames& units,
                   const std::set<std::string, std::less<>>& lone, const KnownWords& known,
                   const std::set<std::string, std::less<>>& brought, const UnitSurroundings& around)
        : pair_(pair), beside_(beside), units_(units), lone_(lone), known_(known), brought_(brought), around_(around) {}

    /// words[first, end) of the source. `written`: how the source writes each of its words.
    CarriedWords carry(const std::vector<std::string>& words, size_t first, size_t end,
                       const std::function<std::string(size_t)>& written) const;

    /// A word of the port in its normal form, as the port writes it.
    std::string written_there(const std::string& word) const {
        const auto known = around_.numbers.find(word);
        return known == around_.numbers.end() ? written_number(word) : known->second;
    }

    /// What words mean whatever the side: without scopes, and without what has no counterpart elsewhere.
    std::vector<std::string> meaning(const std::vector<std::string>& words, size_t first, size_t end) const;

    /// True for qualifiers alone that the target's file has as well, or its language.
    bool are_qualifiers(const std::vector<std::string>& words, size_t first, size_t end) const;

    /// True if a function of either name is declared on neither side, and is none of a language's run time.
    bool is_from_elsewhere(std::string_view name, std::string_view other) const {
        return !units_.names.contains(name) && !units_.names.contains(other) && !lone_.contains(other) &&
               known_.is_from_elsewhere(name) && known_.is_from_elsewhere(other);
    }
    /// True if what both sides call `was`, and have from elsewhere, may be called `is` on both.
    bool may_be_renamed(std::string_view was, std::string_view is) const {
        const auto is_theirs = [&](std::string_view name) {
            return !units_.names.contains(name) && !lone_.contains(name) && known_.is_declared_nowhere(name);
        };
        return is_theirs(was) && is_theirs(is) && (known_.are_of_one_language() || known_.is_from_elsewhere(is));
    }
    bool is_on_host() const { return around_.on_host; }
    /// True for a word that the target's file has, or may have from where the source's has it.
    bool knows_there(const std::string& word) const {
        return known_.in_file(word) || (!lone_.contains(word) && known_.anywhere(word));
    }
    /// True for a word that the target's file has.
    bool has_file_there(const std::string& word) const { return known_.in_file(word); }
    /// How the port says that it waits for its device.
    const DeviceWait& wait_there() const { return around_.wait; }
    bool lacks_references() const { return known_.lacks_casts(); }
    /// True where the target declares `name`, and nobody `other`, not even the edit.
    bool declares_alone(std::string_view name, std::string_view other) const {
        return is_word_token(other) && known_.is_declared_there(name) && !is_type_word(name) &&
               !around_.gone.contains(name) && is_from_elsewhere(other, other) && !brought_.contains(other);
    }

    /// True for a text that speaks of what is one side's alone.
    bool names_one_side(std::string_view literal) const { return known_.names_one_side(literal); }
    /// True for what a file of either side declares, outside of functions or as a field.
    bool is_declared(std::string_view name) const {
        return known_.is_of_source(name) || known_.is_declared_there(name);
    }

    bool drops_std(const std::vector<std::string>& words, size_t i, const Examples::Phrase& phrase) const;

    /// True if one of words[first, end) calls what takes another number of arguments on the target's side.
    bool calls_otherwise(const std::vector<std::string>& words, size_t first, size_t end) const;

    /// True for a name that the edit itself brings in.
    bool brings(std::string_view name) const { return brought_.contains(name); }
    /// True for what the target's side has for all its functions, other than fields.
    bool stands_bare(std::string_view name) const { return known_.stands_bare(name); }
    bool is_in_file(std::string_view name) const { return known_.in_file(name); }
    /// True for what the target's side has only within functions, or as fields.
    bool is_only_local(std::string_view name) const { return known_.is_only_local(name); }
    /// True for what tells a thread which one it is.
    bool is_of_thread(std::string_view word) const {
        return is_one_of(known_.meaning(std::string(word)),
                         {"local_id", "group_id", "group_size", "group_count", "global_id"});
    }

private:
    /// What a word is for where it stands.
    enum class Use : uint8_t { Value, Type, Call };
    /// How the target says the word alone; "" if that is not known.
    std::string word(std::string_view text, Use use) const;
    std::string from_elsewhere(std::string_view text, Use use) const;
    /// What the pair, else its files, tell of a name with a part that the target calls otherwise; nothing where it has
    /// no such part.
    std::optional<std::string> in_other_part(std::string_view text) const;
    std::string type_named(const std::string& name) const;
    std::string said_in_folder(std::string_view text, Use use) const;
    std::string number(const std::string& written) const;
    void put_phrase(const Examples::Phrase& phrase, const std::vector<std::string>& words, size_t at,
                    const std::function<std::string(size_t)>& written, CarriedWords& out) const;
    bool carry_pattern(const std::vector<std::string>& words, size_t first, size_t end, CarriedWords& out) const;
    /// Carries a statement that starts a kernel in the form that the target's file has for all its own.
    bool carry_launch(const std::vector<std::string>& words, size_t first, size_t end,
                      const std::function<std::string(size_t)>& written, CarriedWords& out) const;
    /// Carries a value of several parts in the target's form, and moves `i` behind it; false if none stands there.
    bool carry_literal(const std::vector<std::string>& words, size_t& i, size_t end,
                       const std::function<std::string(size_t)>& written, CarriedWords& out) const;
    /// Carries a cast in C's manner in that of a constructor, for a language that has no other; as above.
    bool carry_cast(const std::vector<std::string>& words, size_t& i, size_t end,
                    const std::function<std::string(size_t)>& written, CarriedWords& out) const;
    CarriedWords carry_words(const std::vector<std::string>& words, size_t first, size_t end,
                             const std::function<std::string(size_t)>& written) const;
    std::string member(std::string_view text) const;

    const Examples& pair_;
    const LearnedBeside& beside_;
    const UnitNames& units_;
    const std::set<std::string, std::less<>>& lone_;
    const KnownWords& known_;
    const std::set<std::string, std::less<>>& brought_;
    const UnitSurroundings& around_;
};

}  // namespace porttool
