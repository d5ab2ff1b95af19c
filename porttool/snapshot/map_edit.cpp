// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/map_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "porttool/text/sink/terminal.h"
#include "porttool/text/toml_string.h"

namespace porttool {
namespace {

constexpr std::string_view kPairHead = "[[pair]]";

using PairKey = std::pair<std::string, std::string>;

/// The places of a map's text where a pair can be written.
class PairPlaces {
public:
    PairPlaces(const std::string& text, const MapFile& map) : text_(text) {
        for (size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) starts_.push_back(at);
        starts_.push_back(text.size());
        for (const MapPair& pair : map.pairs) {
            const auto line = static_cast<size_t>(pair.line - 1);
            usual_ &= line + 1 < starts_.size() && text.compare(starts_[line], kPairHead.size(), kPairHead) == 0;
            lines_.emplace(PairKey{pair.source, pair.targets.front()}, line);
        }
    }

    /// Behind the pair before it, or, where there is none, before the first one and what is said of that above it.
    size_t place_of(const PairKey& pair) const {
        if (!usual_ || lines_.empty()) return text_.size();
        const auto next = lines_.lower_bound(pair);
        if (next == lines_.begin()) return end_of_code(0, next->second);
        const size_t first = std::prev(next)->second;
        size_t end = first + 1;
        while (end + 1 < starts_.size() && line(end).find_first_not_of(" \t") != line(end).find('[')) ++end;
        return end_of_code(first, end);
    }

private:
    std::string_view line(size_t i) const {
        return std::string_view(text_).substr(starts_[i], starts_[i + 1] - starts_[i]);
    }
    /// Behind the last of the lines [first, end) that is neither empty nor a comment.
    size_t end_of_code(size_t first, size_t end) const {
        while (end > first) {
            const size_t begin = line(end - 1).find_first_not_of(" \t\r\n");
            if (begin != std::string_view::npos && line(end - 1)[begin] != '#') break;
            --end;
        }
        return starts_[end];
    }

    const std::string& text_;
    std::vector<size_t> starts_;  ///< of lines, and the end
    std::map<PairKey, size_t> lines_;
    bool usual_ = true;
};

/// True for a text whose lines end as those of Windows do, by the first of them.
bool has_carriage_returns(const std::string& text) {
    const size_t end = text.find('\n');
    return end != std::string::npos && end > 0 && text[end - 1] == '\r';
}

std::string with_line_end(std::string text) {
    if (!text.empty() && text.back() != '\n') text += has_carriage_returns(text) ? "\r\n" : "\n";
    return text;
}

/// A pair as a map has it whose lines end as those of `text`.
std::string pair_text_in(const std::string& text, const NewPair& pair) {
    std::string out;
    for (const char letter : pair_text(pair)) {
        if (letter == '\n' && has_carriage_returns(text)) out += '\r';
        out += letter;
    }
    return out;
}

}  // namespace

std::string map_with_pairs(const std::string& text, const MapFile& map, const std::vector<NewPair>& pairs) {
    const std::string whole = with_line_end(text);
    const PairPlaces places(whole, map);
    std::map<std::pair<size_t, PairKey>, const NewPair*> added;
    for (const NewPair& pair : pairs) {
        const PairKey key{pair.source, pair.target};
        added.emplace(std::pair{places.place_of(key), key}, &pair);
    }
    std::string out;
    size_t at = 0;
    for (const auto& [place, pair] : added) {
        out.append(whole, at, place.first - at);
        at = place.first;
        out += pair_text_in(whole, *pair);
    }
    return out.append(whole, at);
}

std::string pair_text(const NewPair& pair) {
    constexpr double kPercent = 100;
    return fmt::format("\n[[pair]]{}\nsource = {}\ntarget = {}\n",
                       pair.score < 0 ? "" : fmt::format("  # {:.0f} % sure", kPercent * pair.score),
                       toml_string(pair.source), toml_string(pair.target));
}

std::string add_pairs(Project& project, const std::vector<NewPair>& pairs) {
    std::string text = map_with_pairs(project.map_text, project.map, pairs);
    ReadMap read = read_map(project.map_name, text);
    if (!read.error.empty() || read.map.pairs.size() != project.map.pairs.size() + pairs.size()) {
        text = with_line_end(project.map_text);
        for (const NewPair& pair : pairs) text += pair_text_in(project.map_text, pair);
        read = read_map(project.map_name, text);
    }
    if (!read.error.empty())
        throw CannotDo(terminal_text(project.map_name) + ": a [[pair]] cannot be added to it; write it there by hand:" +
                       pair_text(pairs.front()) + read.error);
    use_map(project, project.map_name, text);
    return text;
}

std::string remove_pair(Project& project, const NewPair& pair) {
    const auto is_it = [&](const MapPair& one) {
        return one.source == pair.source && one.targets == std::vector<std::string>{pair.target};
    };
    const std::vector<MapPair> before = project.map.pairs;
    const auto found = std::find_if(before.begin(), before.end(), is_it);
    const std::string& text = project.map_text;
    size_t first = 0;
    for (int line = 1; found != before.end() && line < found->line; ++line) first = text.find('\n', first) + 1;
    const bool stands_alone = found != before.end() && text.compare(first, kPairHead.size(), kPairHead) == 0;
    size_t end = std::min(text.find("\n[", first), text.size() - 1) + 1;
    for (const std::string_view blank : {"\n\n", "\n\r\n"})  // the empty line before it
        if (first >= blank.size() && text.compare(first - blank.size(), blank.size(), blank) == 0)
            first -= blank.size() - 1;
    const std::string left = stands_alone ? text.substr(0, first) + text.substr(end) : text;
    const ReadMap read = read_map(project.map_name, left);
    if (!stands_alone || !read.error.empty() || read.map.pairs.size() + 1 != before.size())
        throw CannotDo(terminal_text(project.map_name) + ": the pair " + terminal_text(pair.source) + " = " +
                       terminal_text(pair.target) + " stands in no [[pair]] of its own; take it out by hand");
    use_map(project, project.map_name, left);
    return left;
}

}  // namespace porttool
