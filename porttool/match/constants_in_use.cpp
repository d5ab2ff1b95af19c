// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/constants_in_use.h"

#include <algorithm>
#include <bitset>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "porttool/scan/scan.h"
#include "porttool/scan/side.h"

namespace porttool {
namespace {

/// What a constant is, without what languages put around it: `{0.5}`, `(0.5)` and `0.5` are one. "" without a number.
std::string plain_value(std::string value) {
    while (!value.empty() && (value.back() == ';' || value.back() == '}' || value.back() == ')')) value.pop_back();
    value.erase(0, value.find_first_not_of("({"));
    const bool number = std::any_of(value.begin(), value.end(), [](char c) { return c >= '0' && c <= '9'; });
    return number ? value : std::string();
}

/// A value that two constants hardly have by chance: three digits that count, or a list.
bool is_rare(std::string_view value) {
    constexpr std::ptrdiff_t kDigits = 3;
    const size_t first = value.find_first_of("123456789");
    if (first == std::string_view::npos) return false;
    std::string_view rest = value.substr(first);
    rest = rest.substr(0, rest.find_last_of("123456789") + 1);
    return std::count_if(rest.begin(), rest.end(), [](char c) { return c >= '0' && c <= '9'; }) >= kDigits;
}

/// Where a function uses a constant: the words around, names blanked.
struct ConstantUse {
    uint32_t constant = 0;
    std::string around;
};

/// The constants of a side by their names, and their uses in a function.
class ConstantNames {
public:
    ConstantNames(const std::vector<ScannedFile>& files, const std::vector<UnitFeatures>& units)
        : files_(files), units_(units), values_(units.size()) {
        for (uint32_t u = 0; u < units.size(); ++u) {
            if (units[u].group != Group::Constant) continue;
            values_[u] = plain_value(units[u].value);
            if (values_[u].empty()) continue;
            const std::string_view name = leaf_of(plain_name(unit_of(u)));
            named_[name].push_back(u);
            seen_.set(mark_of(name));
        }
    }

    bool empty() const { return named_.empty(); }
    const std::string& value(uint32_t constant) const { return values_[constant]; }

    std::vector<ConstantUse> uses_in(uint32_t function) const {
        const UnitFeatures& features = units_[function];
        const ScannedFile& file = files_[features.file];
        const Unit& unit = unit_of(function);
        std::vector<ConstantUse> uses;
        std::unordered_set<uint32_t> hidden;
        const auto look = [&](const TokenRange& range, bool declares) {
            size_t hole = 0;
            for (uint32_t i = range.first; i < range.end; ++i) {
                while (hole < unit.holes.size() && unit.holes[hole].end <= i) ++hole;
                if (hole < unit.holes.size() && unit.holes[hole].first <= i) continue;
                const uint32_t constant = constant_at(file, features.file, i);
                if (constant == kNone) continue;
                if (declares || is_declared(file, i))
                    hidden.insert(constant);
                else
                    uses.push_back({constant, around(file, i, range)});
            }
        };
        look(unit.parameters, true);
        look(unit.body, false);
        std::erase_if(uses, [&](const ConstantUse& use) { return hidden.contains(use.constant); });
        return uses;
    }

private:
    static constexpr uint32_t kNone = 0xFFFFFFFFu;

    const Unit& unit_of(uint32_t number) const { return files_[units_[number].file].units[units_[number].unit]; }

    static size_t mark_of(std::string_view name) {
        return (name.size() * 31 + static_cast<unsigned char>(name.front()) * 64 +
                static_cast<unsigned char>(name.back())) %
               kMarks;
    }

    /// The constant that a name means: that of its file, or the only one.
    uint32_t constant_at(const ScannedFile& file, uint32_t file_number, uint32_t i) const {
        const Token& token = file.lexed.tokens[i];
        if (token.kind != TokenKind::Identifier || (token.flags & kDead) != 0) return kNone;
        const std::string_view name = file.lexed.view(token);
        if (!seen_.test(mark_of(name))) return kNone;
        const auto found = named_.find(name);
        if (found == named_.end() || is_member(file, i)) return kNone;
        const std::vector<uint32_t>& all = found->second;  // file by file, as units are
        const auto here = std::partition_point(all.begin(), all.end(),
                                               [&](uint32_t constant) { return units_[constant].file < file_number; });
        if (here == all.end() || units_[*here].file != file_number) return all.size() == 1 ? all.front() : kNone;
        const bool is_one_of_several = here + 1 != all.end() && units_[*(here + 1)].file == file_number;
        return is_one_of_several ? kNone : *here;
    }

    static bool is_member(const ScannedFile& file, uint32_t i) {
        const std::string_view before = i > 0 ? file.lexed.view(i - 1) : std::string_view();
        return before == "." || before == "->";
    }

    /// `float gain = 2;`: a local of that name.
    static bool is_declared(const ScannedFile& file, uint32_t i) {
        if (i == 0 || i + 1 >= file.lexed.tokens.size()) return false;
        const std::string_view before = file.lexed.view(i - 1), after = file.lexed.view(i + 1);
        const bool type = file.lexed.tokens[i - 1].kind == TokenKind::Identifier && before != "return" &&
                          before != "case" && before != "else";
        return type && (after == "=" || after == ";" || after == "," || after == "[" || after == "{");
    }

    static std::string around(const ScannedFile& file, uint32_t i, const TokenRange& range) {
        std::string out;
        const auto add = [&](uint32_t at) {
            const bool name = file.lexed.tokens[at].kind == TokenKind::Identifier;
            out += name ? std::string_view("a") : file.lexed.view(at);
            out += ' ';
        };
        if (i >= range.first + 2) add(i - 2);
        if (i > range.first) add(i - 1);
        if (i + 1 < range.end) add(i + 1);
        return out;
    }

    static constexpr size_t kMarks = 1 << 14;
    const std::vector<ScannedFile>& files_;
    const std::vector<UnitFeatures>& units_;
    std::vector<std::string> values_;
    std::unordered_map<std::string_view, std::vector<uint32_t>> named_;
    std::bitset<kMarks> seen_;  ///< most words are no constant's name, and are told from one without a search
};

using Used = std::map<uint32_t, std::vector<std::string>>;  ///< the places where each constant is used

Used by_constant(const std::vector<ConstantUse>& uses) {
    Used out;
    for (const ConstantUse& use : uses) out[use.constant].push_back(use.around);
    for (auto& [constant, places] : out) std::sort(places.begin(), places.end());
    return out;
}

bool share_a_place(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    return std::any_of(a.begin(), a.end(),
                       [&](const std::string& place) { return std::binary_search(b.begin(), b.end(), place); });
}

class ConstantFinder {
public:
    ConstantFinder(const std::vector<ScannedFile>& source_files, const std::vector<ScannedFile>& target_files,
                   const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target)
        : source_(source), target_(target), sources_(source_files, source), targets_(target_files, target) {}

    std::vector<UnitPair> run(const std::vector<UnitPair>& pairs) {
        if (sources_.empty() || targets_.empty()) return {};
        for (const UnitPair& pair : pairs)
            if (source_[pair.source].group == Group::Constant) {
                ports_.emplace(pair.source, pair.target);
                origins_.emplace(pair.target, pair.source);
            }
        for (const UnitPair& pair : pairs)
            if (source_[pair.source].group == Group::Code) vote(pair);
        using InFile = std::pair<uint32_t, uint32_t>;  // a constant, and a file of the other side, which has one port
        std::map<InFile, int> here, there;
        for (const auto& [constants, confidence] : votes_) {
            ++here[{constants.first, target_[constants.second].file}];
            ++there[{constants.second, source_[constants.first].file}];
        }
        std::vector<UnitPair> out;
        for (const auto& [constants, confidence] : votes_)
            if (here.at({constants.first, target_[constants.second].file}) == 1 &&
                there.at({constants.second, source_[constants.first].file}) == 1)
                out.push_back({constants.first, constants.second, confidence});
        return out;
    }

private:
    using Constants = std::pair<uint32_t, uint32_t>;

    /// Two constants that are not yet one pair, or each another's within the same file.
    bool is_open(uint32_t s, uint32_t t) const {
        const auto taken = [](const std::multimap<uint32_t, uint32_t>& pairs, uint32_t of, uint32_t other,
                              const std::vector<UnitFeatures>& units) {
            const auto [first, last] = pairs.equal_range(of);
            return std::any_of(first, last,
                               [&](const auto& pair) { return units[pair.second].file == units[other].file; });
        };
        return !taken(ports_, s, t, target_) && !taken(origins_, t, s, source_) &&
               !(ports_.contains(s) && origins_.contains(t));
    }

    void vote(const UnitPair& pair) {
        const Used here = by_constant(sources_.uses_in(pair.source));
        if (here.empty()) return;
        const Used there = by_constant(targets_.uses_in(pair.target));
        std::vector<Constants> found;
        std::unordered_map<uint32_t, size_t> of_source, of_target;  // in `found`
        for (const ByValue& same : with_one_value(here, there))
            for (const auto& [s, places] : same.source)
                for (const auto& [t, places_there] : same.target) {
                    if (!is_open(s, t)) continue;
                    if (!is_rare(sources_.value(s)) && !share_a_place(*places, *places_there)) continue;
                    found.emplace_back(s, t);
                    ++of_source[s];
                    ++of_target[t];
                }
        for (const Constants& constants : found) {
            if (of_source[constants.first] > 1 || of_target[constants.second] > 1) continue;
            constexpr float kMost = 0.85f;
            float& confidence = votes_[constants];
            confidence = std::max(confidence, std::min(kMost, pair.confidence));
        }
    }

    using Places = std::pair<uint32_t, const std::vector<std::string>*>;  ///< of a constant
    using ByValue = BySide<std::vector<Places>>;

    /// The constants that two functions use, those of one value together. Values that very many share tell nothing.
    std::vector<ByValue> with_one_value(const Used& here, const Used& there) const {
        constexpr size_t kMost = 64;  // constants of a side
        std::unordered_map<std::string_view, ByValue> by_value;
        for (const auto& [s, places] : here) by_value[sources_.value(s)].source.emplace_back(s, &places);
        for (const auto& [t, places] : there)
            if (const auto same = by_value.find(targets_.value(t)); same != by_value.end())
                same->second.target.emplace_back(t, &places);
        std::vector<ByValue> out;
        for (auto& [value, same] : by_value)
            if (same.source.size() <= kMost && same.target.size() <= kMost) out.push_back(std::move(same));
        return out;
    }

    const std::vector<UnitFeatures>&source_, &target_;
    ConstantNames sources_, targets_;
    std::multimap<uint32_t, uint32_t> ports_, origins_;
    std::map<Constants, float> votes_;
};

}  // namespace

std::vector<UnitPair> find_constants_in_use(const std::vector<ScannedFile>& source_files,
                                            const std::vector<ScannedFile>& target_files,
                                            const std::vector<UnitFeatures>& source,
                                            const std::vector<UnitFeatures>& target,
                                            const std::vector<UnitPair>& pairs) {
    return ConstantFinder(source_files, target_files, source, target).run(pairs);
}

}  // namespace porttool
