// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/port_folders.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "porttool/match/entry_names.h"
#include "porttool/match/words.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// How often each name, by its number, is defined.
using Names = std::unordered_map<uint32_t, uint32_t>;

/// What a unit's name is about, without words that tell for which platform: `add_cuda` and `add_omp` are one.
std::string subject_of(const Unit& unit) {
    std::string out;
    for (const std::string& word : split_words(leaf_of(plain_name(unit))))
        if (!tells_how(word)) out += word;
    return out;
}

bool is_counted(const Unit& unit) { return unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel; }

/// The source's names with their counts, and those of them that each file of the target defines.
struct DefinedNames {
    Names source;
    std::vector<std::vector<uint32_t>> target;  ///< of each file, as often as it defines them
};

DefinedNames read_definitions(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target) {
    DefinedNames out;
    std::unordered_map<std::string, uint32_t> numbers;
    for (const ScannedFile& file : source)
        for (const Unit& unit : file.units)
            if (is_counted(unit))
                if (const std::string subject = subject_of(unit); !subject.empty())
                    ++out.source[numbers.emplace(subject, static_cast<uint32_t>(numbers.size())).first->second];
    for (const ScannedFile& file : target) {
        out.target.emplace_back();
        for (const Unit& unit : file.units)
            if (is_counted(unit))
                if (const auto found = numbers.find(subject_of(unit)); found != numbers.end())
                    out.target.back().push_back(found->second);
    }
    return out;
}

/// The parts of paths below the folder that all have in common: folders, and the file's name without its suffixes.
std::vector<std::vector<std::string_view>> parts_of(const std::vector<ScannedFile>& files) {
    std::vector<std::vector<std::string_view>> out;
    for (const ScannedFile& file : files) {
        std::string_view rest = folder_of(file.path);
        out.emplace_back();
        for (size_t slash = 0; !rest.empty(); rest.remove_prefix(std::min(rest.size(), slash + 1))) {
            slash = std::min(rest.find('/'), rest.size());
            if (slash > 0) out.back().push_back(rest.substr(0, slash));
        }
        out.back().push_back(file_stem(file.path));
    }
    size_t common = out.front().size() - 1;
    for (const auto& parts : out)
        for (common = std::min(common, parts.size() - 1); common > 0;) {
            if (std::equal(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(common), out.front().begin()))
                break;
            --common;
        }
    for (auto& parts : out) parts.erase(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(common));
    return out;
}

/// What in a path may tell the ports apart: a part by its depth, or the file's name; as a whole, or a word of it.
struct Mark {
    enum Word { Whole, First, Last };
    size_t depth = 0;
    bool file = false;
    Word word = Whole;

    std::string of(const std::vector<std::string_view>& parts) const {
        if (!file && depth + 1 >= parts.size()) return {};
        const std::string_view part = file ? parts.back() : parts[depth];
        if (word == Whole) return std::string(part);
        const std::vector<std::string> words = split_words(part);
        if (words.size() < 2) return {};
        return word == First ? words.front() : words.back();
    }
};

std::vector<Mark> all_marks() {
    constexpr size_t kMostFolders = 4;
    std::vector<Mark> out;
    for (size_t depth = 0; depth < kMostFolders; ++depth)
        for (const auto word : {Mark::Whole, Mark::Last, Mark::First}) out.push_back({depth, false, word});
    for (const auto word : {Mark::Last, Mark::First}) out.push_back({0, true, word});
    return out;
}

/// The target's files by what stands at one mark.
class Grouping {
public:
    Grouping(const DefinedNames& definitions, const std::vector<std::vector<std::string_view>>& parts, const Mark& mark)
        : definitions_(definitions) {
        for (uint32_t f = 0; f < parts.size(); ++f) {
            const std::string key = mark.of(parts[f]);
            Group& group = groups_[key];
            group.files.push_back(f);
            for (const uint32_t name : definitions.target[f]) {
                ++group.names[name];
                ++all_[name];
            }
        }
        if (const auto found = groups_.find(""); found != groups_.end()) {
            rest_ = found->second.files;
            groups_.erase(found);
        }
        keep_ports();
    }

    /// How many definitions there are beyond those that one port would have; 0 where the groups are no ports: where the
    /// largest has but a part of the source, as one program of a collection, or most lies outside of all.
    size_t surplus() const {
        if (groups_.size() < 2) return 0;
        Names of_ports;
        size_t sum = 0, largest = 0;
        for (const auto& [key, group] : groups_) {
            sum += covered(group.names);
            largest = std::max(largest, covered(group.names));
            for (const auto& [name, count] : group.names) of_ports[name] += count;
        }
        const size_t together = covered(of_ports);
        return 5 * largest >= 2 * together && 2 * together >= covered(all_) ? sum - together : 0;
    }

    std::vector<PortFiles> ports() const {
        std::vector<PortFiles> out;
        for (const auto& [key, group] : groups_) {
            out.push_back({key, group.files});
            out.back().files.insert(out.back().files.end(), rest_.begin(), rest_.end());
            std::sort(out.back().files.begin(), out.back().files.end());
        }
        return out;
    }

private:
    struct Group {
        std::vector<uint32_t> files;
        Names names;
    };

    /// How many of the source's definitions have one of their name among these.
    size_t covered(const Names& names) const {
        size_t sum = 0;
        for (const auto& [name, count] : names) sum += std::min(count, definitions_.source.at(name));
        return sum;
    }

    /// How many of a group's definitions the others have as well, beyond as many as the source has.
    size_t repeated(const Names& names) const {
        size_t sum = 0;
        for (const auto& [name, count] : names) {
            const uint32_t wanted = definitions_.source.at(name);
            const uint32_t here = std::min(count, wanted), others = std::min(in_groups_.at(name) - count, wanted);
            sum += here + others - std::min(here + others, wanted);
        }
        return sum;
    }

    /// Keeps the groups that have again what others have. The rest is what the ports have in common.
    void keep_ports() {
        constexpr size_t kLeast = 3, kShare = 6;
        size_t most = 0;
        for (const auto& [key, group] : groups_) {
            most = std::max(most, covered(group.names));
            for (const auto& [name, count] : group.names) in_groups_[name] += count;
        }
        std::erase_if(groups_, [&](const auto& entry) {
            const size_t share = covered(entry.second.names);
            if (share >= kLeast && share == most) return false;
            if (share >= kLeast && kShare * share >= most && 5 * repeated(entry.second.names) >= 2 * share)
                return false;
            rest_.insert(rest_.end(), entry.second.files.begin(), entry.second.files.end());
            return true;
        });
    }

    const DefinedNames& definitions_;
    std::map<std::string, Group> groups_;
    std::vector<uint32_t> rest_;
    Names all_, in_groups_;  ///< with and without what has no key
};

}  // namespace

std::vector<PortFiles> find_ports(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target) {
    if (source.empty() || target.size() < 2) return {};
    const DefinedNames definitions = read_definitions(source, target);
    const auto parts = parts_of(target);
    std::vector<PortFiles> best;
    size_t most = 0;
    for (const Mark& mark : all_marks()) {
        const Grouping grouping(definitions, parts, mark);
        if (const size_t surplus = grouping.surplus(); surplus > most) {
            most = surplus;
            best = grouping.ports();
        }
    }
    return best;
}

}  // namespace porttool
