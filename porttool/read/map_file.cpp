// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/map_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "porttool/read/disk.h"
#include "porttool/read/dotted_keys.h"
#include "porttool/text/enum_names.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/suggest.h"

namespace porttool {
namespace {

struct Misread : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class MapReader {
public:
    MapReader(std::string path, const std::string& text) : path_(std::move(path)), text_(text) {}

    MapFile read() {
        const toml::table root = parse();
        only(root,
             {"version", "sides", "pair", "ignore", "block", "rules", "dialect", "spirv", "cost", "reuse", "effort",
              "sync", "difftest"},
             "portmap.toml");
        const auto version = root["version"].value<int64_t>();
        if (!version || *version != 1)
            fail(root.get("version") != nullptr ? root.get("version")->source() : root.source(),
                 root.get("version") == nullptr ? "'version = 1' is missing"
                                                : "version: expected 1; this porttool reads maps of version 1");
        note_values(root);
        if (const toml::table* sides = section(root, "sides")) read_sides(*sides);
        for (const toml::table* pair : tables(root, "pair")) read_pair(*pair);
        for (const toml::table* ignore : tables(root, "ignore")) read_ignore(*ignore);
        for (const toml::table* block : tables(root, "block")) {
            only(*block, {"name", "source", "target"}, "[[block]]");
            if (const std::string name = text(*block, "name"); name.empty() || name == "All lines" || name == "*")
                fail(block->get("name")->source(),
                     name.empty() ? "'name' is empty; give the block a name"
                                  : "'" + name + "' stands for both sides as a whole; give the block another name");
            map_.blocks.push_back({text(*block, "name"), list(*block, "source", false), list(*block, "target", false)});
        }
        if (const toml::table* rules = section(root, "rules")) read_rules(*rules);
        if (const toml::table* cost = section(root, "cost")) read_weights(*cost);
        if (const toml::table* reuse = section(root, "reuse")) read_reuse(*reuse);
        for (const toml::table* effort : tables(root, "effort")) read_effort(*effort);
        if (const toml::table* spirv = section(root, "spirv")) {
            only(*spirv, {"include", "preamble"}, "[spirv]");
            map_.shaders = {list(*spirv, "include", false), list(*spirv, "preamble", false)};
        }
        if (const toml::table* difftest = section(root, "difftest")) {
            only(*difftest, {"defines"}, "[difftest]");
            map_.defines = list(*difftest, "defines", false);
        }
        if (const toml::table* sync = section(root, "sync")) {
            only(*sync, {"verify"}, "[sync]");
            if (sync->get("verify") != nullptr) map_.verify = text(*sync, "verify");
        }
        if (const toml::table* dialect = section(root, "dialect"))
            for (const auto& [key, node] : *dialect) map_.dialect.emplace_back(key.str(), text(*dialect, key.str()));
        return std::move(map_);
    }

private:
    toml::table parse() {
        constexpr size_t kMebibyte = 1024 * 1024, kMost = 16;  // its table takes thirty times as much
        if (text_.size() > kMost * kMebibyte)
            throw Misread(fmt::format("{} is {} MiB, more than the {} MiB that are read of a map", terminal_text(path_),
                                      text_.size() / kMebibyte, kMost));
        if (const auto line = line_of_deep_key(text_))
            throw Misread(path_ + ":" + std::to_string(*line) +
                          ": a key of more than 16 dots; no table of a map lies that deep");
        try {
            return toml::parse(text_, path_);
        } catch (const toml::parse_error& error) {
            std::string reason(error.description());  // toml++ quotes what it found, a line break as well
            for (char& letter : reason)
                if (letter == '\n' || letter == '\r') letter = ' ';
            fail(error.source(), "no TOML: " + reason + "; correct that line");
        }
    }

    [[noreturn]] void fail(const toml::source_region& where, const std::string& what) const {
        throw Misread(fmt::format("{}:{}:{}: {}", terminal_text(path_), where.begin.line, where.begin.column,
                                  terminal_text(what)));
    }

    void only(const toml::table& table, const std::vector<std::string>& known, const char* where) const {
        for (const auto& [key, node] : table) {
            const std::string name(key.str());
            if (std::find(known.begin(), known.end(), name) != known.end()) continue;
            const std::string near = nearest(name, known);
            fail(key.source(), "unknown key '" + name + "' in " + where +
                                   (near.empty() ? std::string() : "; did you mean '" + near + "'?"));
        }
    }

    const toml::table* section(const toml::table& root, const char* name) const {
        const toml::node* node = root.get(name);
        if (node == nullptr) return nullptr;
        if (!node->is_table()) fail(node->source(), std::string(name) + ": expected a table, [" + name + "]");
        return node->as_table();
    }

    std::vector<const toml::table*> tables(const toml::table& root, const char* name) const {
        std::vector<const toml::table*> out;
        const toml::node* node = root.get(name);
        if (node == nullptr) return out;
        const toml::array* array = node->as_array();
        if (array == nullptr) fail(node->source(), std::string(name) + ": expected tables, [[" + name + "]]");
        for (const toml::node& element : *array) {
            if (!element.is_table()) fail(element.source(), std::string(name) + ": expected tables, [[" + name + "]]");
            out.push_back(element.as_table());
        }
        return out;
    }

    std::string text(const toml::table& table, std::string_view key) const {
        const toml::node* node = table.get(key);
        if (node == nullptr) fail(table.source(), "'" + std::string(key) + "' is missing");
        const auto value = node->value<std::string>();
        if (!value) fail(node->source(), "'" + std::string(key) + "': expected a string");
        return *value;
    }

    /// A string or a list of strings.
    std::vector<std::string> list(const toml::table& table, const char* key, bool required) const {
        const toml::node* node = table.get(key);
        if (node == nullptr && !required) return {};
        if (node != nullptr && node->is_array()) {
            std::vector<std::string> out;
            for (const toml::node& element : *node->as_array()) {
                const auto value = element.value<std::string>();
                if (!value) fail(element.source(), std::string("'") + key + "': expected strings");
                out.push_back(*value);
            }
            return out;
        }
        return {text(table, key)};
    }

    /// Takes down what stands in the map, for who compares two of them: new keys are there by themselves.
    void note_values(const toml::table& root) {
        for (const auto& [key, node] : root) {
            const std::string name(key.str());
            if (name == "version" || name == "pair" || name == "ignore") continue;
            if (const toml::table* table = node.as_table())
                note_keys(name, *table);
            else if (const toml::array* array = node.as_array())
                for (const toml::node& one : *array) note_entry(name, one);
        }
    }
    void note_keys(const std::string& path, const toml::table& table) {
        for (const auto& [key, node] : table) {
            const std::string name = path + "." + std::string(key.str());
            if (const toml::table* inner = node.as_table())
                note_keys(name, *inner);
            else
                map_.values[name] = {value_text(node), static_cast<int>(key.source().begin.line)};
        }
    }
    /// One of several tables of a name, as a whole, by what it calls itself.
    void note_entry(const std::string& path, const toml::node& node) {
        const toml::table* table = node.as_table();
        if (table == nullptr) return;
        const toml::node* name = table->get(table->contains("name") ? "name" : "what");
        const std::string key = path + "." + (name == nullptr ? std::string() : value_text(*name));
        std::string text;
        for (const auto& [inner, value] : *table)
            if (&value != name)
                text += (text.empty() ? "" : ", ") + std::string(inner.str()) + " = " + value_text(value);
        const auto [found, fresh] = map_.values.try_emplace(key, MapValue{text, 0});
        if (!fresh) found->second.text += "; " + text;
        found->second.line = static_cast<int>(node.source().begin.line);
    }
    static std::string value_text(const toml::node& node) {
        if (const auto text = node.value_exact<std::string>()) return *text;
        if (const auto number = node.value<double>(); number && node.is_number()) return fmt::format("{}", *number);
        std::string out;
        if (const toml::array* array = node.as_array()) {
            for (const toml::node& one : *array) out += (out.empty() ? "" : ", ") + value_text(one);
        } else if (const toml::table* table = node.as_table()) {
            for (const auto& [key, value] : *table)
                out += (out.empty() ? "" : ", ") + std::string(key.str()) + " = " + value_text(value);
            out = "{" + out + "}";
        }
        return out;
    }

    void read_sides(const toml::table& sides) {
        only(sides, {"source", "target", "targets", "reference", "target_root"}, "[sides]");
        map_.source = list(sides, "source", true);
        if (sides.get("targets") != nullptr)
            read_targets(sides);
        else
            map_.target = list(sides, "target", true);
        if (sides.get("reference") != nullptr) {
            const auto reference = value_named<Reference>(kReferenceNames, text(sides, "reference"));
            if (!reference)
                fail(sides.get("reference")->source(), "reference: expected \"source\", \"target\" or \"both\"");
            map_.reference = *reference;
        }
        if (sides.get("target_root") != nullptr) map_.target_root = text(sides, "target_root");
    }

    void read_targets(const toml::table& sides) {
        if (sides.get("target") != nullptr)
            fail(sides.get("target")->source(), "'target' and [sides.targets] exclude each other: keep one");
        const toml::table* targets = section(sides, "targets");
        if (targets->empty()) fail(targets->source(), "[sides.targets]: expected NAME = [\"glob\", ...]");
        for (const auto& [key, node] : *targets) {
            const std::string name(key.str());
            if (!is_set_name(name)) fail(key.source(), "'" + name + "': expected letters, digits, '_' and '-'");
            map_.target_sets.push_back({name, list(*targets, name.c_str(), true)});
        }
        std::sort(map_.target_sets.begin(), map_.target_sets.end(),
                  [](const TargetSet& a, const TargetSet& b) { return a.name < b.name; });
        for (const TargetSet& set : map_.target_sets)
            map_.target.insert(map_.target.end(), set.globs.begin(), set.globs.end());
    }

    void read_pair(const toml::table& pair) {
        only(pair, {"source", "target"}, "[[pair]]");
        const int line = static_cast<int>(pair.source().begin.line);
        const std::string source = text(pair, "source");
        const std::vector<std::string> targets = list(pair, "target", true);
        if (source.empty()) fail(pair.get("source")->source(), "'source' names no unit");
        if (targets.empty()) fail(pair.get("target")->source(), "'target' names no unit");
        for (const std::string& target : targets) {
            if (target.empty()) fail(pair.get("target")->source(), "'target' names no unit");
            const auto [first, fresh] = pair_lines_.try_emplace({source, target}, line);
            if (!fresh)
                fail(pair.get("target")->source(),
                     "this pair stands here twice, first in line " + std::to_string(first->second) + "; remove one");
        }
        map_.pairs.push_back({source, targets, line});
    }

    void read_ignore(const toml::table& ignore) {
        only(ignore, {"id", "reason"}, "[[ignore]]");
        map_.ignores.push_back(
            {text(ignore, "id"), text(ignore, "reason"), static_cast<int>(ignore.source().begin.line)});
    }

    void read_rules(const toml::table& rules) {
        only(rules, {kRuleNames.begin(), kRuleNames.end()}, "[rules]");
        for (const auto& [key, node] : rules) {
            const std::string name = text(rules, key.str());
            const std::optional<Level> level = level_named(name);
            if (!level) fail(node.source(), "level '" + name + "': expected error, warning, note or off");
            map_.rules[*rule_named(key.str())] = *level;
        }
    }

    /// A number within bounds, or nothing where the key is not there.
    std::optional<double> number(const toml::table& table, std::string_view key, double most) const {
        const toml::node* node = table.get(key);
        if (node == nullptr) return std::nullopt;
        const auto value = node->value<double>();
        if (!value || !(*value >= 0 && *value <= most))
            fail(node->source(),
                 most < kMostAmount ? fmt::format("'{}': expected a number from 0 to {:g}", key, most)
                                    : fmt::format("'{}': expected a number of at least 0 and at most {:g}", key, most));
        return value;
    }
    bool flag(const toml::table& table, std::string_view key) const {
        const toml::node* node = table.get(key);
        if (node != nullptr && !node->is_boolean())
            fail(node->source(), fmt::format("'{}': expected true or false", key));
        return node != nullptr && node->value_or(false);
    }
    double amount(const toml::table& table, std::string_view key, double otherwise = 0) const {
        return number(table, key, kMostAmount).value_or(otherwise);
    }

    /// `impediments = { p = .., H = .., E = .. }`: alpha of program, hardware and environment.
    metrics::Impediments impediments(const toml::table& table) {
        const toml::table* found = section(table, "impediments");
        if (found == nullptr) return {};
        only(*found, {"p", "H", "E"}, "impediments");
        return {amount(*found, "p"), amount(*found, "H"), amount(*found, "E")};
    }

    void read_weights(const toml::table& cost) {
        only(cost, {"design", "coding", "testing", "documentation", "retest", "impediments"}, "[cost]");
        map_.impediments = impediments(cost);
        map_.weights = {amount(cost, "design"), amount(cost, "coding", 1), amount(cost, "testing"),
                        amount(cost, "documentation"), number(cost, "retest", 1).value_or(0)};
        if (redevelopment_from_lines(1, map_.weights).total() <= 0)
            fail(cost.source(), "[cost]: every weight is 0; at least one must be more");
    }

    void read_reuse(const toml::table& reuse) {
        only(reuse, {"design_modified", "integration", "assessment", "understanding", "unfamiliarity", "translated"},
             "[reuse]");
        constexpr double kPercent = 100, kHighestAssessment = 8, kLowestClarity = 50;
        map_.reuse = {number(reuse, "design_modified", kPercent),
                      number(reuse, "integration", kPercent),
                      number(reuse, "assessment", kHighestAssessment),
                      number(reuse, "understanding", kLowestClarity),
                      number(reuse, "unfamiliarity", 1),
                      number(reuse, "translated", kPercent)};
    }

    /// A block that an entry names must be there, where there are any.
    void require_block(const toml::table& effort, const std::string& name) {
        if (block_names_.empty())
            for (const MapBlock& block : map_.blocks) block_names_.insert(block.name);
        if (name.empty() || block_names_.empty() || block_names_.contains(name)) return;
        const std::string near = nearest(name, {block_names_.begin(), block_names_.end()});
        fail(effort.get("block")->source(), "there is no [[block]] of the name '" + name + "'" +
                                                (near.empty() ? "" : "; did you mean '" + near + "'?"));
    }

    void read_effort(const toml::table& effort) {
        only(effort,
             {"what", "block", "from", "to", "lines", "novel", "port", "redevelopment", "uncertainty", "impediments",
              "mined"},
             "[[effort]]");
        MapEffort entry;
        entry.line = static_cast<int>(effort.source().begin.line);
        entry.what = text(effort, "what");
        for (const auto& [key, field] : {std::pair{"block", &entry.block}, {"from", &entry.from}, {"to", &entry.to}})
            if (effort.get(key) != nullptr) *field = text(effort, key);
        entry.lines = number(effort, "lines", kMostAmount);
        entry.novel = number(effort, "novel", kMostAmount);
        if (entry.novel && (!entry.lines || *entry.novel > *entry.lines))
            fail(effort.get("novel")->source(), "'novel': expected at most 'lines', which counts them too");
        entry.uncertainty = number(effort, "uncertainty", kMostUncertain).value_or(0);
        entry.impediments = impediments(effort);
        entry.mined = flag(effort, "mined");
        if (const toml::table* port = section(effort, "port")) {
            only(*port, {"coding", "testing", "documentation"}, "port of [[effort]]");
            entry.port = {amount(*port, "coding"), amount(*port, "testing"), amount(*port, "documentation")};
        }
        if (const toml::table* anew = section(effort, "redevelopment")) {
            only(*anew, {"design", "coding", "testing", "documentation"}, "redevelopment of [[effort]]");
            entry.redevelopment = {amount(*anew, "design"), amount(*anew, "coding"), amount(*anew, "testing"),
                                   amount(*anew, "documentation")};
            if (entry.redevelopment->total() <= 0)
                fail(anew->source(), "redevelopment: no hours in design, coding, testing or documentation");
        }
        require_block(effort, entry.block);
        map_.efforts.push_back(std::move(entry));
    }

    static constexpr double kMostUncertain = 0.9;
    static constexpr double kMostAmount = 1e9;  // of lines, hours or weights: what is added up stays a number

    std::string path_;
    const std::string& text_;
    MapFile map_;
    std::map<std::pair<std::string, std::string>, int> pair_lines_;
    std::set<std::string> block_names_;
};

}  // namespace

bool is_set_name(std::string_view name) {
    return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
}

ReadMap read_map(const std::string& path, const std::string& text) {
    try {
        return {MapReader(path, text).read(), ""};
    } catch (const Misread& error) {
        return {{}, error.what()};
    }
}

std::string target_path(const MapFile& map, const std::string& path) {
    return map.target_root.empty() ? path : clean_path(join_path(map.target_root, path));
}

}  // namespace porttool
