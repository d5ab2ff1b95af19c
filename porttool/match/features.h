// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/match/compounds.h"
#include "porttool/scan/unit.h"
#include "porttool/text/key_numbers.h"
#include "porttool/text/short_list.h"
#include "porttool/text/text_numbers.h"

namespace porttool {

/// The kinds of evidence that are weighed as bags of terms.
enum Family : size_t { kName, kPlace, kBody, kShape, kCalls, kLiterals, kFamilies };

struct Term {
    uint32_t id;
    float weight;
};

/// Terms sorted by id; after weighing, a unit vector.
using Bag = ShortList<Term>;

/// Ids of terms.
using TermIds = ShortList<uint32_t>;

/// A parameter that takes any type, as of a template.
inline constexpr uint32_t kAnyType = 0xFFFFFFFFu;

/// Units are only paired within one group.
enum class Group : uint8_t { Code, Struct, Constant };

/// Whether a function is a constructor or a destructor.
enum class Lifecycle : uint8_t { Neither, Begins, Ends };

/// What one unit shows to the matcher. A file can have half a million units, so each of them is small.
struct UnitFeatures {
    uint32_t file = 0;         ///< index into the side's files
    uint32_t unit = 0;         ///< index into the file's units
    uint32_t stem = 0;         ///< the term id (of places) of the file's name without its suffixes
    uint32_t folder = 0;       ///< the term id (of places) of the file's folder as a whole
    uint32_t file_number = 0;  ///< the number that its file's name has, as `m25600.cl` and `module_25600.c`; 0: none
    Group group = Group::Code;
    Lifecycle lifecycle = Lifecycle::Neither;
    bool kernel = false;
    bool says_kernels = false;     ///< its language marks kernels
    bool launches = false;         ///< sets arguments of kernels, or enqueues them
    bool sets_arguments = false;   ///< sets arguments of kernels
    bool launcher = false;         ///< sets arguments and enqueues a kernel, without computing by itself
    bool computes = false;         ///< has a loop, arithmetic or a store at an index
    bool acts = false;             ///< has a loop or a store at an index
    bool works = false;            ///< the same, and more of it than a wrapper has
    bool holds_kernel = false;     ///< enqueues a lambda that works, as a kernel does
    bool beside_kernels = false;   ///< its side has kernels
    bool on_device = false;        ///< its side has kernels, or hands lambdas on as such
    bool whole_file_main = false;  ///< a shader's main: the file's name is its name
    bool names_platform = false;   ///< its name says for which platform it is
    bool converts = false;         ///< its name says from what to what
    bool overloaded = false;       ///< its file has another unit of this name that takes other types
    uint32_t branch = 0;           ///< how many units of its name its file has before it
    std::string folded_name;       ///< qualified, letters and digits only, without the platform
    std::string folded_leaf;
    std::array<Bag, kFamilies> bags;
    TermIds name_words;                   ///< sorted term ids, without words that stand in most names of the side
    TermIds all_words;                    ///< sorted term ids, a word as often as the qualified name has it
    TermIds ordered_words;                ///< term ids of the qualified name's words, as they follow each other
    std::string core;                     ///< what the name is about, in one word, see name_cores.h
    TermIds core_words;                   ///< sorted term ids
    std::vector<std::string> name_types;  ///< the types that the name speaks of, in common spelling
    std::shared_ptr<const std::vector<uint32_t>> path_words;  ///< sorted term ids (of names) of folders and file
    TermIds parameter_types;                                  ///< sorted term ids
    TermIds operands;                                         ///< term ids of the parameters' types, in order
    bool entry = false;      ///< named after its file, as a family of files has functions of its name
    TermIds callees;         ///< sorted term ids (of calls) of the whole names that it calls
    uint32_t called_as = 0;  ///< the term id under which others call it
    uint32_t parameters = 0;
    uint32_t size = 0;  ///< tokens of the body
    std::string value;  ///< of a constant, normalised
};

/// Numbers terms; both sides share one.
class TermNumbers {
public:
    uint32_t id(Family family, std::string_view text);
    /// A run of tokens, by its hash.
    uint32_t shape_id(uint64_t hash);
    size_t size() const { return texts_.size(); }
    /// Empty for the id of a shape.
    std::string_view text(uint32_t id) const { return texts_[id]; }

private:
    struct Words {
        TextNumbers texts;
        std::vector<uint32_t> ids;  ///< of each of texts
    };
    std::array<Words, kFamilies> words_;
    KeyNumbers shapes_;
    std::vector<std::string_view> texts_;  ///< by id
};

/// Reads the features of all units of one side. Weights are raw counts; weigh() makes them comparable.
std::vector<UnitFeatures> read_features(const std::vector<ScannedFile>& files, const Compounds& compounds,
                                        const Dialect& dialect, TermNumbers& terms);

/// Turns counts into tf-idf unit vectors, with document frequencies over both sides.
void weigh(std::vector<UnitFeatures>& source, std::vector<UnitFeatures>& target, size_t terms);

}  // namespace porttool
