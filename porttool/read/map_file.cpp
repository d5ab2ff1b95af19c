// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/map_file.h"

#include <toml++/toml.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "porttool/command/suggest.h"

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
        only(root, {"version", "sides", "pair", "ignore", "block", "rules", "dialect"}, "portmap.toml");
        const auto version = root["version"].value<int64_t>();
        if (!version || *version != 1)
            fail(root.get("version") != nullptr ? root.get("version")->source() : root.source(),
                 "version: expected 1; this porttool reads maps of version 1");
        if (const toml::table* sides = section(root, "sides")) read_sides(*sides);
        for (const toml::table* pair : tables(root, "pair")) read_pair(*pair);
        for (const toml::table* ignore : tables(root, "ignore")) read_ignore(*ignore);
        for (const toml::table* block : tables(root, "block")) {
            only(*block, {"name", "source", "target"}, "[[block]]");
            map_.blocks.push_back({text(*block, "name"), list(*block, "source", false), list(*block, "target", false)});
        }
        if (const toml::table* rules = section(root, "rules")) read_rules(*rules);
        if (const toml::table* dialect = section(root, "dialect"))
            for (const auto& [key, node] : *dialect) map_.dialect.emplace_back(key.str(), text(*dialect, key.str()));
        return std::move(map_);
    }

private:
    toml::table parse() {
        try {
            return toml::parse(text_, path_);
        } catch (const toml::parse_error& error) {
            fail(error.source(), std::string(error.description()));
        }
    }

    [[noreturn]] void fail(const toml::source_region& where, const std::string& what) const {
        std::ostringstream message;
        message << path_ << ":" << where.begin.line << ":" << where.begin.column << ": " << what << "\n";
        std::istringstream lines(text_);
        std::string line;
        for (uint32_t i = 0; i < where.begin.line; ++i) std::getline(lines, line);
        constexpr size_t kLongest = 160;
        if (where.begin.line > 0 && line.size() < kLongest && where.begin.column > 0)
            message << line << "\n" << std::string(where.begin.column - 1, ' ') << "^";
        throw Misread(message.str());
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

    void read_sides(const toml::table& sides) {
        only(sides, {"source", "target", "reference", "target_root"}, "[sides]");
        map_.source = list(sides, "source", true);
        map_.target = list(sides, "target", true);
        if (sides.get("reference") != nullptr) {
            map_.reference = text(sides, "reference");
            if (map_.reference != "source" && map_.reference != "target")
                fail(sides.get("reference")->source(), "reference: expected \"source\" or \"target\"");
        }
        if (sides.get("target_root") != nullptr) map_.target_root = text(sides, "target_root");
    }

    void read_pair(const toml::table& pair) {
        only(pair, {"source", "target"}, "[[pair]]");
        map_.pairs.push_back(
            {text(pair, "source"), list(pair, "target", true), static_cast<int>(pair.source().begin.line)});
    }

    void read_ignore(const toml::table& ignore) {
        only(ignore, {"id", "reason"}, "[[ignore]]");
        map_.ignores.push_back(
            {text(ignore, "id"), text(ignore, "reason"), static_cast<int>(ignore.source().begin.line)});
    }

    void read_rules(const toml::table& rules) {
        only(rules, rule_names(), "[rules]");
        const std::vector<std::string> levels = {"error", "warning", "note", "off"};
        for (const auto& [key, node] : rules) {
            const std::string level = text(rules, key.str());
            if (std::find(levels.begin(), levels.end(), level) == levels.end())
                fail(node.source(), "level '" + level + "': expected error, warning, note or off");
            map_.rules[std::string(key.str())] = level;
        }
    }

    std::string path_;
    const std::string& text_;
    MapFile map_;
};

}  // namespace

ReadMap read_map(const std::string& path, const std::string& text) {
    try {
        return {MapReader(path, text).read(), ""};
    } catch (const Misread& error) {
        return {{}, error.what()};
    }
}

const std::vector<std::string>& rule_names() {
    static const std::vector<std::string> names = {
        "source-changed",   "port-differs",   "target-changed",   "unported",           "orphaned",   "dead-link",
        "constant-differs", "layout-differs", "deferral-expired", "unused-suppression", "unreadable", "dialect-hazard"};
    return names;
}

}  // namespace porttool
