// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/features.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "porttool/language/words.h"
#include "porttool/match/body_traits.h"
#include "porttool/match/entry_names.h"
#include "porttool/match/identifier_terms.h"
#include "porttool/match/words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

Group group_of(UnitKind kind) {
    if (kind == UnitKind::Struct) return Group::Struct;
    return kind == UnitKind::Constant ? Group::Constant : Group::Code;
}

/// A language whose kernels are marked as such in their heads.
bool marks_kernels(Language language) {
    return language != Language::C && language != Language::Cpp && language != Language::Sycl &&
           language != Language::Unknown;
}

/// What the suffix of a ray-tracing shader says is part of a function's name elsewhere: `__closesthit__radiance`.
std::string_view stage_word(std::string_view path) {
    if (path.ends_with(".rgen")) return "raygen";
    if (path.ends_with(".rchit")) return "closesthit";
    if (path.ends_with(".rahit")) return "anyhit";
    if (path.ends_with(".rmiss")) return "miss";
    if (path.ends_with(".rint")) return "intersection";
    if (path.ends_with(".rcall")) return "callable";
    return {};
}

/// How often the unit being read has each term.
class Counts {
public:
    void add(Family family, uint32_t id, float amount) {
        if (id >= amounts_.size()) amounts_.resize(std::max<size_t>(id + 1, 2 * amounts_.size()));
        if (amounts_[id] == 0) ids_[family].push_back(id);
        amounts_[id] += amount;
    }

    const std::vector<uint32_t>& ids(Family family) const { return ids_[family]; }

    /// Hands a family's counts out and forgets them.
    Bag take(size_t family) {
        std::vector<uint32_t>& ids = ids_[family];
        std::sort(ids.begin(), ids.end());
        terms_.clear();
        for (const uint32_t id : ids) terms_.push_back({id, std::exchange(amounts_[id], 0.0f)});
        ids.clear();
        return terms_;
    }

private:
    std::vector<float> amounts_;  ///< by term id; all zero between units
    std::array<std::vector<uint32_t>, kFamilies> ids_;
    std::vector<Term> terms_;  ///< of the family that is handed out
};

/// The words of one parameter: the first is its type, unless it is all there is or stands for any type, as `T` does.
class Parameter {
public:
    void add(std::string_view word) {
        if (words_++ == 0) first_ = word;
    }

    uint32_t type(TermNumbers& terms) const {
        constexpr size_t kLongestAny = 2;
        const bool any = words_ == 0 || (first_.size() <= kLongestAny && first_[0] >= 'A' && first_[0] <= 'Z');
        return any ? kAnyType : terms.id(kBody, first_);
    }

private:
    std::string_view first_;
    int words_ = 0;
};

class FeatureReader {
public:
    FeatureReader(const ScannedFile& file, const EntryNames& entries, const Compounds& compounds,
                  const Dialect& dialect, TermNumbers& terms, IdentifierTable& identifiers, Counts& counts)
        : file_(file),
          entries_(entries),
          compounds_(compounds),
          dialect_(dialect),
          terms_(terms),
          identifiers_(identifiers),
          counts_(counts) {
        std::vector<uint32_t> words = name_ids({file_.path.substr(0, file_.path.rfind('.')), stage_word(file_.path)});
        std::sort(words.begin(), words.end());
        path_words_ = std::make_shared<const std::vector<uint32_t>>(std::move(words));
        stem_ = terms_.id(kPlace, fold(file_stem(file_.path)));
        folder_ = terms_.id(kPlace, std::string(folder_of(file_.path)) + '/');  // no word has a slash
        file_number_ = number_in(file_stem(file_.path));
    }

    UnitFeatures read(const Unit& unit) {
        UnitFeatures features;
        features.group = group_of(unit.kind);
        features.kernel = unit.kind == UnitKind::Kernel;
        features.says_kernels = marks_kernels(file_.language);
        if (features.group == Group::Code) read_traits(unit, features);
        read_names(unit, features);
        read_place();
        read_parameters(unit, features);
        read_body(unit, features);
        for (size_t family = 0; family < kFamilies; ++family) features.bags[family] = counts_.take(family);
        return features;
    }

private:
    void count(Family family, std::string_view text, float amount = 1) {
        counts_.add(family, terms_.id(family, text), amount);
    }

    void count_words(Family family, std::string_view name, float amount) {
        for (const std::string& word : split_words(name)) count(family, word, amount);
    }

    void count_ids(Family family, const std::vector<uint32_t>& ids) {
        for (const uint32_t id : ids) counts_.add(family, id, 1);
    }

    /// Names speak a dialect, too: `__uchar4_to_float4` and `uintToVec4`.
    void count_name_words(Family family, std::string_view name, float amount) {
        for (const std::string& word : compounds_.split(name)) count(family, common_word(word), amount);
    }

    std::string_view common_word(std::string_view word) const {
        const std::string* common = dialect_.find(word);
        return common != nullptr && !common->empty() ? std::string_view(*common) : word;
    }

    std::vector<uint32_t> name_ids(std::initializer_list<std::string_view> names) {
        std::vector<uint32_t> ids;
        for (const std::string_view name : names)
            for (const std::string& word : compounds_.split(name)) ids.push_back(terms_.id(kName, common_word(word)));
        return ids;
    }

    void read_traits(const Unit& unit, UnitFeatures& features) {
        const BodyTraits traits = read_body_traits(file_, unit);
        features.launches = traits.launches;
        features.sets_arguments = traits.sets_arguments;
        features.launcher = traits.launches && !traits.stores && !features.kernel;
        features.holds_kernel = traits.holds_kernel && !features.kernel;
        features.computes = traits.computes;
        features.acts = traits.acts;
        features.works = traits.works || features.kernel;
    }

    void read_names(const Unit& unit, UnitFeatures& features) {
        const std::string_view name = plain_name(unit);
        const std::string_view leaf = leaf_of(name);
        const std::string_view stem = file_stem(file_.path);
        features.whole_file_main = unit.kind == UnitKind::File || (features.kernel && leaf == "main");
        features.lifecycle = lifecycle_of(name, leaf);
        const bool entry = !features.whole_file_main && features.group == Group::Code && entries_.contains(name);
        const std::string subject = entry ? entries_.subject(file_.path) : std::string();
        const std::string_view shown = features.whole_file_main ? stem : entry ? std::string_view(subject) : name;
        features.entry = entry;
        features.converts = converts(shown);
        features.called_as = terms_.id(kCalls, fold(leaf));
        const std::string_view scope = shown.substr(0, shown.size() - leaf_of(shown).size());
        const std::string_view plain_leaf = without_platform(leaf_of(shown));
        features.names_platform = plain_leaf.size() < leaf_of(shown).size();
        features.folded_leaf = fold(plain_leaf);
        features.folded_name = fold(scope) + features.folded_leaf;
        constexpr float kScopeWeight = 0.7f;
        count_name_words(kName, leaf_of(shown), 1);
        count_name_words(kName, scope, kScopeWeight);
        const std::string_view stage = features.whole_file_main ? stage_word(file_.path) : std::string_view();
        if (!stage.empty()) {
            count_words(kName, stage, 1);
            count_words(kPlace, stage, 1);
            features.name_words = std::vector{terms_.id(kName, split_words(stage).front())};
        } else {
            features.name_words = counts_.ids(kName);
            std::sort(features.name_words.begin(), features.name_words.end());
        }
        features.all_words = features.ordered_words = name_ids({shown, stage});
        std::sort(features.all_words.begin(), features.all_words.end());
        features.path_words = path_words_;
        features.stem = stem_;
        features.folder = folder_;
        features.file_number = file_number_;
        // The place also carries the name: a class here is a file there.
        count_name_words(kPlace, shown, 1);
    }

    /// `Ray::Ray`, `Ray::~Ray`
    static Lifecycle lifecycle_of(std::string_view name, std::string_view leaf) {
        if (leaf.starts_with('~')) return Lifecycle::Ends;
        if (leaf.size() == name.size()) return Lifecycle::Neither;
        const bool as_its_class = leaf_of(name.substr(0, name.size() - leaf.size() - 2)) == leaf;
        return as_its_class ? Lifecycle::Begins : Lifecycle::Neither;
    }

    void read_place() {
        constexpr float kFolderWeight = 0.35f;
        count_name_words(kPlace, file_stem(file_.path), 1);
        count_name_words(kPlace, folder_of(file_.path), kFolderWeight);
    }

    void read_parameters(const Unit& unit, UnitFeatures& features) {
        if (unit.parameters.empty()) return;
        std::vector<uint32_t> operands, types;
        features.parameters = 1;
        Parameter parameter;
        int depth = 0;
        for (uint32_t i = unit.parameters.first; i < unit.parameters.end; ++i) {
            const Token& token = file_.lexed.tokens[i];
            if (token.flags & (kInDirective | kDead)) continue;
            const std::string_view text = file_.lexed.view(token);
            if (text == "(" || text == "<") ++depth;
            if (text == ")" || text == ">") --depth;
            if (text == "," && depth == 0) {
                ++features.parameters;
                operands.push_back(parameter.type(terms_));
                parameter = {};
            }
            if (token.kind != TokenKind::Identifier) continue;
            const IdentifierTerms& known = identifiers_.find(text);
            if (known.kind == IdentifierTerms::Kind::Silent) continue;
            if (known.common == nullptr)
                count_ids(kBody, known.words);
            else
                types.push_back(known.words.front());
            if (!word_is(text, kRecord)) parameter.add(known.common != nullptr ? *known.common : text);
        }
        operands.push_back(parameter.type(terms_));
        std::sort(types.begin(), types.end());
        features.operands = operands;
        features.parameter_types = types;
    }

    void read_body(const Unit& unit, UnitFeatures& features) {
        shape_.clear();
        callees_.clear();
        size_t hole = 0;
        for (uint32_t i = unit.body.first; i < unit.body.end; ++i) {
            while (hole < unit.holes.size() && unit.holes[hole].end <= i) ++hole;
            if (hole < unit.holes.size() && unit.holes[hole].first <= i) {
                i = unit.holes[hole].end - 1;
                continue;
            }
            const Token& token = file_.lexed.tokens[i];
            if ((token.flags & kDead) == 0) read_token(i, token);
        }
        std::sort(callees_.begin(), callees_.end());
        callees_.erase(std::unique(callees_.begin(), callees_.end()), callees_.end());
        features.callees = callees_;
        features.size = static_cast<uint32_t>(shape_.size());
        read_shape();
        if (features.group == Group::Constant) features.value = constant_value(unit);
    }

    void read_token(uint32_t i, const Token& token) {
        const std::string_view text = file_.lexed.view(token);
        if (token.kind == TokenKind::Identifier) return read_identifier(i, text);
        if (token.kind == TokenKind::Number) {
            const std::string value = number_value(text);
            if (value.size() > 1) count(kLiterals, value);
            shape_.push_back(hash_text(value));
            return;
        }
        if (token.kind == TokenKind::String) {
            if (text.size() > 4) count(kLiterals, text);
            if (is_name(text)) callees_.push_back(terms_.id(kCalls, fold(text)));  // clCreateKernel(program, "shade")
            shape_.push_back(1);
            return;
        }
        if (text == "::") return;  // scopes come and go between languages
        const std::string* common = dialect_.find(text);
        shape_.push_back(hash_text(common != nullptr ? *common : std::string(text)));
    }

    void read_identifier(uint32_t i, std::string_view text) {
        const IdentifierTerms& known = identifiers_.find(text);
        const bool name = known.kind == IdentifierTerms::Kind::Name;
        if (known.kind == IdentifierTerms::Kind::Common) count_ids(kBody, known.words);
        if (known.kind == IdentifierTerms::Kind::Silent) return;
        const bool call = name && i + 1 < file_.lexed.tokens.size() && file_.lexed.view(i + 1) == "(";
        shape_.push_back(!name ? known.shape : call ? 3 : 2);
        if (!name) return;
        count_ids(kBody, known.words);
        if (call) count_ids(kCalls, identifiers_.called_words(text));
        if (call || is_launched(i)) callees_.push_back(identifiers_.called_as(text));
    }

    /// A string with quotes that holds a name.
    static bool is_name(std::string_view text) {
        return text.size() > 3 && std::all_of(text.begin() + 1, text.end() - 1, [](char c) {
                   return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
               });
    }

    /// `kernel<<<grid, block>>>(...)`, also with template arguments before.
    bool is_launched(uint32_t i) const {
        constexpr uint32_t kFarthest = 12;
        const auto& tokens = file_.lexed.tokens;
        if (i + 3 >= tokens.size() || file_.lexed.view(i + 1) != "<") return false;
        for (uint32_t at = i + 1; at + 2 < tokens.size() && at < i + kFarthest; ++at) {
            const std::string_view text = file_.lexed.view(at);
            if (text == "(" || text == ";" || text == "{") return false;
            if (text == "<" && file_.lexed.view(at + 1) == "<" && file_.lexed.view(at + 2) == "<") return true;
        }
        return false;
    }

    void read_shape() {
        constexpr size_t kLength = 5;
        for (size_t i = 0; i + kLength <= shape_.size(); ++i) {
            uint64_t hash = 0;
            for (size_t k = 0; k < kLength; ++k) hash = hash * 0x9E3779B97F4A7C15ull + shape_[i + k];
            counts_.add(kShape, terms_.shape_id(hash), 1);
        }
    }

    std::string constant_value(const Unit& unit) const {
        std::string value;
        bool seen = file_.lexed.tokens[unit.tokens.first].flags & kInDirective;
        const uint32_t first = seen ? unit.body.first : unit.tokens.first;
        for (uint32_t i = first; i < unit.tokens.end && value.size() < 400; ++i) {
            const Token& token = file_.lexed.tokens[i];
            const std::string_view text = file_.lexed.view(token);
            if (seen) value += token.kind == TokenKind::Number ? number_value(text) : std::string(text);
            seen = seen || text == "=" || text == "{";
        }
        return value;
    }

    const ScannedFile& file_;
    const EntryNames& entries_;
    const Compounds& compounds_;
    const Dialect& dialect_;
    TermNumbers& terms_;
    IdentifierTable& identifiers_;
    Counts& counts_;
    std::shared_ptr<const std::vector<uint32_t>> path_words_;
    uint32_t stem_ = 0, folder_ = 0, file_number_ = 0;
    std::vector<uint64_t> shape_;
    std::vector<uint32_t> callees_;
};

/// True if two units of a file take the same, word by word.
bool take_the_same(const ScannedFile& file, const Unit& a, const Unit& b) {
    const uint32_t count = a.parameters.end - a.parameters.first;
    if (count != b.parameters.end - b.parameters.first) return false;
    for (uint32_t i = 0; i < count; ++i)
        if (file.lexed.view(a.parameters.first + i) != file.lexed.view(b.parameters.first + i)) return false;
    return true;
}

/// Marks the units of a file, the last of all, that have a name in common and take different types. Those that take the
/// same stand in branches of an `#if`.
void mark_overloads(const ScannedFile& file, std::vector<UnitFeatures>& all) {
    const bool any = std::any_of(file.units.begin(), file.units.end(),
                                 [](const Unit& unit) { return unit.name.find('#') != std::string::npos; });
    if (!any) return;
    const size_t first = all.size() - file.units.size();
    std::unordered_map<std::string_view, std::pair<const Unit*, uint32_t>> firsts;
    std::unordered_set<std::string_view> overloaded;
    for (size_t u = 0; u < file.units.size(); ++u) {
        auto& [unit, count] = firsts.try_emplace(plain_name(file.units[u]), &file.units[u], 0).first->second;
        all[first + u].branch = count++;
        if (!take_the_same(file, *unit, file.units[u])) overloaded.insert(plain_name(file.units[u]));
    }
    for (size_t u = 0; u < file.units.size(); ++u)
        all[first + u].overloaded = overloaded.contains(plain_name(file.units[u]));
}

}  // namespace

uint32_t TermNumbers::id(Family family, std::string_view text) {
    Words& words = words_[static_cast<size_t>(family)];
    const uint32_t place = words.texts.number(text);
    if (place == words.ids.size()) {
        words.ids.push_back(static_cast<uint32_t>(texts_.size()));
        texts_.push_back(words.texts.text(place));
    }
    return words.ids[place];
}

uint32_t TermNumbers::shape_id(uint64_t hash) {
    const uint32_t id = shapes_.number(hash, static_cast<uint32_t>(texts_.size()));
    if (id == texts_.size()) texts_.emplace_back();
    return id;
}

std::vector<UnitFeatures> read_features(const std::vector<ScannedFile>& files, const Compounds& compounds,
                                        const Dialect& dialect, TermNumbers& terms) {
    std::vector<UnitFeatures> all;
    all.reserve(std::accumulate(files.begin(), files.end(), size_t{0},
                                [](size_t count, const ScannedFile& file) { return count + file.units.size(); }));
    Counts counts;
    IdentifierTable identifiers(dialect, terms);
    const EntryNames entries(files);
    for (size_t f = 0; f < files.size(); ++f) {
        FeatureReader reader(files[f], entries, compounds, dialect, terms, identifiers, counts);
        for (size_t u = 0; u < files[f].units.size(); ++u) {
            all.push_back(reader.read(files[f].units[u]));
            all.back().file = static_cast<uint32_t>(f);
            all.back().unit = static_cast<uint32_t>(u);
        }
        mark_overloads(files[f], all);
    }
    const bool kernels = std::any_of(all.begin(), all.end(), [](const UnitFeatures& unit) { return unit.kernel; });
    const bool lambdas = std::any_of(all.begin(), all.end(), [&](const UnitFeatures& unit) {
        return unit.launches && files[unit.file].language == Language::Sycl;
    });
    for (UnitFeatures& unit : all) {
        unit.beside_kernels = kernels;
        unit.on_device = kernels || lambdas;
    }
    return all;
}

void weigh(std::vector<UnitFeatures>& source, std::vector<UnitFeatures>& target, size_t terms) {
    std::vector<float> frequency(terms, 0);
    for (const auto* side : {&source, &target})
        for (const UnitFeatures& unit : *side)
            for (const Bag& bag : unit.bags)
                for (const Term& term : bag) frequency[term.id] += 1;
    const auto total = static_cast<float>(source.size() + target.size());
    for (auto* side : {&source, &target}) {
        for (UnitFeatures& unit : *side) {
            for (Bag& bag : unit.bags) {
                float square = 0;
                for (Term& term : bag) {
                    const float idf = std::log((total + 1) / (frequency[term.id] + 0.5f));
                    term.weight = (term.weight > 1 ? 1 + std::log(term.weight) : term.weight) * std::max(0.05f, idf);
                    square += term.weight * term.weight;
                }
                const float scale = square > 0 ? 1 / std::sqrt(square) : 0;
                for (Term& term : bag) term.weight *= scale;
            }
        }
    }
}

}  // namespace porttool
