// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "metrics/portability/degree.h"
#include "metrics/portability/impediments.h"
#include "metrics/portability/reuse.h"
#include "porttool/read/rule.h"
#include "porttool/scan/side.h"

namespace porttool {

/// The side whose behaviour is the contract.
enum class Reference : uint8_t { Source, Target, Both };
inline constexpr std::array<std::string_view, 3> kReferenceNames = {"source", "target", "both"};
constexpr std::string_view reference_name(Reference reference) {
    return kReferenceNames.at(static_cast<size_t>(reference));
}
/// True for a side that is the contract, or that is it as much as the other.
constexpr bool is_contract(Reference reference, Side side) {
    return reference == Reference::Both || (reference == Reference::Source) == (side == Side::Source);
}

struct MapPair {
    std::string source;
    std::vector<std::string> targets;
    int line = 0;
};

struct MapIgnore {
    std::string id;
    std::string reason;
    int line = 0;
};

struct MapBlock {
    std::string name;
    std::vector<std::string> source, target;
};

/// What shaders are compiled with for `check --spirv`.
struct MapShaders {
    std::vector<std::string> include;   ///< folders, relative to the root
    std::vector<std::string> preamble;  ///< what the host puts before the text; one compile for each
};

/// A port that somebody recorded: lines as `porttool effort` counts them, hours by hand.
struct MapEffort {
    std::string what;
    std::string block;     ///< the functional block that was ported, if it was one
    std::string from, to;  ///< the commits, if known
    std::optional<double> lines, novel;
    std::optional<metrics::PortCost> port;  ///< hours
    std::optional<metrics::RedevelopmentCost> redevelopment;
    double uncertainty = 0;
    metrics::Impediments impediments;
    bool mined = false;  ///< from another project's public history
    int line = 0;
};

/// One of several ports, by name.
struct TargetSet {
    std::string name;
    std::vector<std::string> globs;
};

/// True for what may name a set of targets: letters, digits, `_` and `-`.
bool is_set_name(std::string_view name);

/// A value as it stands in the text of a map, whatever it means.
struct MapValue {
    std::string text;
    int line = 0;
};

/// What portmap.toml says.
struct MapFile {
    std::vector<std::string> source, target;  ///< globs
    std::vector<TargetSet> target_sets;       ///< [sides.targets], by name; `target` then has the globs of all
    Reference reference = Reference::Source;
    std::string target_root;  ///< where the target side lies, if in another checkout
    std::vector<MapPair> pairs;
    std::vector<MapIgnore> ignores;
    std::vector<MapBlock> blocks;
    std::map<Rule, Level> rules;
    std::vector<std::pair<std::string, std::string>> dialect;
    MapShaders shaders;
    std::vector<std::string> defines;        ///< [difftest]: NAME or NAME=VALUE, what the build defines
    metrics::LineWeights weights;            ///< [cost]
    metrics::Impediments impediments;        ///< [cost]: of the ports that are to be foretold
    metrics::ReuseSettings reuse;            ///< [reuse]
    std::vector<MapEffort> efforts;          ///< [[effort]]
    std::string verify;                      ///< [sync]: the command that `sync --verify` runs; "" for none
    std::map<std::string, MapValue> values;  ///< all that stands there but pairs and ignores: "rules.orphaned"
};

/// A map, or the error as it is shown, in one line: file:line:column, what is wrong.
struct ReadMap {
    MapFile map;
    std::string error;
};

/// Reads the text of a portmap.toml. Unknown keys are errors with the nearest known one.
ReadMap read_map(const std::string& path, const std::string& text);

/// The path of a file of the target side as seen from the root.
std::string target_path(const MapFile& map, const std::string& path);

}  // namespace porttool
