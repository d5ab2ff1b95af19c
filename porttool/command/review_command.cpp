// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// review: a guided walk over what a person should look at. Each answer is written at once, so that a walk that ends
// early goes on where it stopped.
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <iostream>
#include <nlohmann/json.hpp>

#include "porttool/command/commands.h"
#include "porttool/judge/review.h"
#include "porttool/read/clock.h"
#include "porttool/text/sink/json.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/utf8.h"

namespace porttool {
namespace {

std::string review_json(const std::vector<ReviewItem>& items) {
    using nlohmann::ordered_json;
    const auto id_or_null = [](const std::string& id) { return id.empty() ? ordered_json(nullptr) : ordered_json(id); };
    ordered_json out = ordered_json::array();
    for (const ReviewItem& item : items) {
        ordered_json candidates = ordered_json::array();
        for (const ReviewCandidate& one : item.candidates)
            candidates.push_back({{item.side == Side::Source ? "target" : "source", one.id}, {"score", one.score}});
        out.push_back({{"kind", item.is_pair ? "doubtful" : "unwatched"},
                       {"source", id_or_null(item.source)},
                       {"target", id_or_null(item.target)},
                       {"score", item.score},
                       {"candidates", std::move(candidates)}});
    }
    const ordered_json whole = {{"items", std::move(out)}};
    return json_text(whole, 1) + "\n";
}

/// The lines of a unit, made fit to be shown.
std::vector<std::string> shown_lines(const CheckedProject& checked, Side side, const std::string& id) {
    const auto state = checked.states[side].find(id);
    if (state == checked.states[side].end()) return {};
    std::vector<std::string> out;
    for (const ScannedFile& file : side == Side::Source ? checked.project.source : checked.project.target) {
        if (file.path != state->second.file) continue;
        const auto& starts = file.lexed.line_starts;
        for (uint32_t line = state->second.start_line; line <= state->second.end_line && line <= starts.size();
             ++line) {
            const size_t first = starts[line - 1];
            const size_t end = line < starts.size() ? starts[line] : file.lexed.text.size();
            std::string text = file.lexed.text.substr(first, end - first);
            while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
            std::string flat;
            for (const char c : text) flat += c == '\t' ? std::string("    ") : std::string(1, c);
            out.push_back(terminal_line(flat));
        }
    }
    return out;
}

/// Cut, or filled with blanks, to so many characters.
std::string fitted(const std::string& text, size_t width) {
    size_t count = 0, at = 0;
    for (; at < text.size() && count < width; ++count)
        at += std::max<size_t>(1, utf8_length(std::string_view(text).substr(at)));
    at = std::min(at, text.size());
    return text.substr(0, at) + std::string(width - count, ' ');
}

/// Lines as rows of at most so many characters: what is longer goes on in the next row, after a sign.
std::vector<std::string> wrapped(const std::vector<std::string>& lines, size_t width) {
    const std::string sign = "> ";
    std::vector<std::string> rows;
    for (const std::string& line : lines) {
        std::string rest = line;
        for (bool first = true; first || !rest.empty(); first = false) {
            const size_t room = first ? width : width - sign.size();
            size_t at = 0;
            for (size_t count = 0; at < rest.size() && count < room; ++count)
                at += std::max<size_t>(1, utf8_length(std::string_view(rest).substr(at)));
            at = std::min(at, rest.size());
            rows.push_back((first ? "" : sign) + rest.substr(0, at));
            rest.erase(0, at);
        }
    }
    return rows;
}

size_t terminal_width() {
    constexpr size_t kUsual = 120, kLeast = 40;
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < kLeast) return kUsual;
    return size.ws_col;
}

std::optional<size_t> number_of_answer(const std::string& text) {
    size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

class Walk {
public:
    Walk(const Options& options, Workplace& place, const CheckedProject& checked, std::vector<ReviewItem> items)
        : options_(options), place_(place), checked_(checked), items_(std::move(items)) {}

    std::string run() {
        for (at_ = 0; at_ < items_.size() && !ended_; ++at_) ask(items_[at_]);
        return fmt::format(
            "{} pairs taken, {} rejected, {} units without counterpart, {} skipped; {} left to look at\n", taken_,
            rejected_, alone_, skipped_, items_.size() - at_ + (ended_ ? 1 : 0) + skipped_);
    }

private:
    /// One item until it is answered.
    void ask(const ReviewItem& item) {
        std::string other = item.is_pair ? item.target : item.candidates.empty() ? "" : item.candidates.front().id;
        show(item, other);
        while (!ended_) {
            const std::string can_take = other.empty() ? "" : "y = a pair, ";
            const std::string answer = read(fmt::format("{}n = {}, p = pick another, s = skip, q = quit", can_take,
                                                        item.is_pair ? "no pair" : "has no counterpart"));
            if (ended_ || answer == "q") break;
            if (answer == "s") {
                ++skipped_;
                return;
            }
            if (answer == "p") {
                const std::string picked = pick(item);
                if (picked.empty()) continue;
                other = picked;
                show(item, other);
                continue;
            }
            if ((answer == "y" && !other.empty()) || answer == "n") {
                if (done(item, answer == "y" ? other : "")) return;
                ++skipped_;
                return;
            }
            say("Please answer with one of these letters.");
        }
        ended_ = true;
    }

    /// Writes an answer down; `other` is the counterpart, or "". False, with a word why, where that cannot be.
    bool done(const ReviewItem& item, const std::string& other) {
        try {
            if (other.empty() && !item.is_pair) {
                Options one = with({item.side == Side::Source ? item.source : item.target});
                one.reason = "has no counterpart, as a review of " + today() + " says";
                run_ignore(one, place_);
                ++alone_;
                return true;
            }
            if (item.is_pair && other != item.target) {
                run_reject(with({item.source, item.target}), place_);
                ++rejected_;
            }
            if (other.empty()) return true;
            run_accept(with({item.side == Side::Source ? item.source + "=" + other : other + "=" + item.target}),
                       place_);
            ++taken_;
            return true;
        } catch (const CannotDo& problem) {
            say(std::string("Not done: ") + problem.what());
            return false;
        }
    }

    Options with(std::vector<std::string> ids) const {
        Options one = options_;
        one.paths = std::move(ids);
        one.format = "text";
        return one;
    }

    /// A unit of the other side, by a number or a part of its id; "" for none.
    std::string pick(const ReviewItem& item) {
        constexpr size_t kMost = 20;
        std::vector<std::string> listed;
        for (const ReviewCandidate& one : item.candidates) listed.push_back(one.id);
        while (true) {
            for (size_t i = 0; i < listed.size(); ++i) say(fmt::format("  {}  {}", i + 1, terminal_text(listed[i])));
            const std::string answer = read("a number, a part of an id, or nothing to go back");
            if (ended_ || answer.empty()) return {};
            if (const auto number = number_of_answer(answer); number && *number >= 1 && *number <= listed.size())
                return listed[*number - 1];
            listed.clear();
            const auto& units = checked_.states[other(item.side)];
            if (units.contains(answer)) return answer;
            for (const auto& [id, unit] : units)
                if (id.find(answer) != std::string::npos && listed.size() < kMost) listed.push_back(id);
            if (listed.empty()) say("No id has that in it.");
        }
    }

    void show(const ReviewItem& item, const std::string& counterpart) {
        constexpr size_t kMostLines = 40;
        const BySide<std::string> ids{item.side == Side::Source ? item.source : counterpart,
                                      item.side == Side::Source ? counterpart : item.target};
        say(fmt::format("\n[{}/{}] {}", at_ + 1, items_.size(), headline(item, counterpart)));
        const size_t width = (terminal_width() - 3) / 2;
        const BySide<std::vector<std::string>> lines{wrapped(shown_lines(checked_, Side::Source, ids.source), width),
                                                     wrapped(shown_lines(checked_, Side::Target, ids.target), width)};
        say(fitted(terminal_text(ids.source), width) + " | " + terminal_text(ids.target));
        const size_t most = std::max(lines.source.size(), lines.target.size());
        for (size_t i = 0; i < std::min(most, kMostLines); ++i)
            say(fitted(i < lines.source.size() ? lines.source[i] : "", width) + " | " +
                fitted(i < lines.target.size() ? lines.target[i] : "", width));
        if (most > kMostLines) say(fmt::format("... and {} lines more", most - kMostLines));
    }

    static std::string headline(const ReviewItem& item, const std::string& counterpart) {
        if (item.is_pair) return fmt::format("a pair that nobody has verified ({:.0f} % sure)", 100 * item.score);
        if (counterpart.empty()) return "a unit that no pair watches, and nothing looks like its counterpart";
        return fmt::format("a unit that no pair watches, and what looks like its counterpart ({:.0f} % sure)",
                           100 * item.score);
    }

    std::string read(const std::string& prompt) {
        say(prompt);
        std::string answer;
        if (!std::getline(std::cin, answer)) ended_ = true;
        while (!answer.empty() && (answer.back() == '\r' || answer.back() == ' ')) answer.pop_back();
        return answer;
    }

    void say(const std::string& text) { place_.err << text << "\n" << std::flush; }

    const Options& options_;
    Workplace& place_;
    const CheckedProject& checked_;
    std::vector<ReviewItem> items_;
    size_t at_ = 0, taken_ = 0, rejected_ = 0, alone_ = 0, skipped_ = 0;
    bool ended_ = false;
};

}  // namespace

void declare_review(Declare&, Options&) {}

Outcome run_review(const Options& options, Workplace& place) {
    require_format(options.format, {"text", "json"});
    const CheckedProject checked = check_project(options, place);
    std::vector<ReviewItem> items = review_items(checked);
    if (options.format == "json") return {review_json(items), 0};
    if (items.empty()) return {"nothing to look at: every pair is verified or sure, and nothing is unwatched\n", 0};
    if (isatty(STDIN_FILENO) == 0)
        throw CannotDo(
            "review asks on a terminal, and stdin is none; porttool review --format json lists what it asks");
    return {Walk(options, place, checked, std::move(items)).run(), 0};
}

}  // namespace porttool
