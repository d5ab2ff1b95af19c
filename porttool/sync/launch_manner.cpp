// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/launch_manner.h"

#include "porttool/compare/brackets.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/operands.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

constexpr std::string_view kLaunch = "hipLaunchKernelGGL";

/// What commas part outside of brackets.
std::vector<LaunchParts::Run> parted_by_commas(const std::vector<std::string>& words, size_t first, size_t end) {
    std::vector<LaunchParts::Run> out{{first, first}};
    for (size_t i = first; i < end; ++i) {
        if (deeper(words[i]) > 0) i = closing_bracket(words, i, end);
        if (i < end && words[i] == ",") {
            out.back().end = i;
            out.push_back({i + 1, i + 1});
        }
    }
    out.back().end = end;
    return out;
}

bool stand_thrice(const std::vector<std::string>& words, size_t i, size_t end, std::string_view word) {
    return i + 2 < end && words[i] == word && words[i + 1] == word && words[i + 2] == word;
}

std::optional<LaunchParts> of_brackets(const std::vector<std::string>& words, size_t first, size_t end) {
    size_t open = first, close = first;
    while (open < end && !stand_thrice(words, open, end, "<")) ++open;
    for (close = open; close < end && !stand_thrice(words, close, end, ">"); ++close) {
    }
    const size_t paren = close + 3;
    if (open == first || paren + 2 >= end || words[paren] != "(" || !is_word_token(words[first])) return std::nullopt;
    // The name may have arguments of its own: `k < T >`.
    for (size_t i = first; i < open; ++i)
        if (!is_word_token(words[i]) && !is_number_token(words[i]) && !is_one_of(words[i], {"<", ">", ",", "::", "*"}))
            return std::nullopt;
    if (closing_bracket(words, paren, end) != end - 2) return std::nullopt;
    LaunchParts out{LaunchManner::Form::Brackets, {first, open}, parted_by_commas(words, open + 3, close), {}};
    out.arguments = {paren + 1, end - 2};
    return out;
}

std::optional<LaunchParts> of_function(const std::vector<std::string>& words, size_t first, size_t end) {
    if (words[first] != kLaunch || words[first + 1] != "(" || closing_bracket(words, first + 1, end) != end - 2)
        return std::nullopt;
    std::vector<LaunchParts::Run> parts = parted_by_commas(words, first + 2, end - 2);
    if (parts.size() < 1 + LaunchParts::kMostExtents) return std::nullopt;
    LaunchParts out{
        LaunchManner::Form::Function, parts[0], {parts.begin() + 1, parts.begin() + 1 + LaunchParts::kMostExtents}, {}};
    const size_t behind = out.extents.back().end;
    out.arguments = {behind + (parts.size() > 1 + LaunchParts::kMostExtents ? 1 : 0), end - 2};
    if (words[parts[0].first] == "HIP_KERNEL_NAME" && parts[0].end > parts[0].first + 2)
        out.kernel = {parts[0].first + 2, parts[0].end - 1};
    return out;
}

}  // namespace

LaunchManner launch_manner(const ScannedFile& file) {
    const LexedText& lexed = file.lexed;
    size_t brackets = 0, functions = 0, wrapped = 0;
    for (uint32_t i = 0; i + 3 < lexed.tokens.size(); ++i) {
        if (lexed.view(i) == "<" && lexed.view(i + 1) == "<" && lexed.view(i + 2) == "<") ++brackets;
        if (lexed.view(i) != kLaunch) continue;
        ++functions;
        for (uint32_t k = i + 2; k < lexed.tokens.size() && lexed.view(k) != ";"; ++k)
            if (lexed.view(k) == "dim3" && lexed.view(k - 1) == ",") {
                ++wrapped;
                break;
            }
    }
    LaunchManner out;
    if ((brackets > 0) == (functions > 0)) return out;
    out.form = brackets > 0 ? LaunchManner::Form::Brackets : LaunchManner::Form::Function;
    out.wraps_extents = 2 * wrapped > functions;
    return out;
}

std::optional<LaunchParts> parts_of_launch(const std::vector<std::string>& words, size_t first, size_t end) {
    constexpr size_t kShortest = 8;
    if (end < first + kShortest || words[end - 1] != ";" || words[end - 2] != ")") return std::nullopt;
    std::optional<LaunchParts> out = of_function(words, first, end);
    if (!out) out = of_brackets(words, first, end);
    if (out && (out->extents.size() < 2 || out->extents.size() > LaunchParts::kMostExtents)) return std::nullopt;
    return out;
}

std::optional<std::vector<std::string>> launch_in_one_form(const std::vector<std::string>& words, size_t first,
                                                           size_t end) {
    const std::optional<LaunchParts> launch = parts_of_launch(words, first, end);
    if (!launch) return std::nullopt;
    std::vector<std::string> out;
    const auto put = [&](LaunchParts::Run run) {
        out.insert(out.end(), words.begin() + static_cast<std::ptrdiff_t>(run.first),
                   words.begin() + static_cast<std::ptrdiff_t>(run.end));
        out.emplace_back(";");
    };
    put(launch->kernel);
    size_t count = launch->extents.size();
    constexpr size_t kFewest = 2;
    const auto is_zero = [&](LaunchParts::Run run) { return run.end == run.first + 1 && words[run.first] == "0"; };
    while (count > kFewest && is_zero(launch->extents[count - 1])) --count;
    for (size_t i = 0; i < count; ++i) {
        LaunchParts::Run extent = launch->extents[i];
        const bool is_wrapped = extent.end > extent.first + 3 && words[extent.first] == "dim3" &&
                                words[extent.first + 1] == "(" &&
                                closing_bracket(words, extent.first + 1, extent.end) == extent.end - 1;
        if (is_wrapped && parted_by_commas(words, extent.first + 2, extent.end - 1).size() == 1)
            extent = {extent.first + 2, extent.end - 1};
        put(extent);
    }
    put(launch->arguments);
    return out;
}

}  // namespace porttool
