// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/runtime_calls.h"

#include <algorithm>
#include <map>

#include "porttool/compare/brackets.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

bool is_context_type(std::string_view word) {
    return is_one_of(word, {"nd_item", "queue", "queue_ptr", "handler", "cudaStream_t", "hipStream_t"});
}

/// The place of the name that is declared where a context's type stands at `i`; the end of the text if none is.
size_t declared_at(const Words& text, size_t i) {
    ++i;
    if (i < text.size() && text[i] == "<")
        while (i < text.size() && text[i] != ">") ++i;
    while (i < text.size() && is_one_of(text[i], {">", "&", "*", "const"})) ++i;
    return i < text.size() && is_word_token(text[i]) ? i : text.size();
}

/// Where the parameter or argument begins that ends before `end`.
size_t item_begin(const Words& words, size_t end) {
    int depth = 0;
    while (end > 0) {
        const std::string_view word = words[end - 1];
        if (is_one_of(word, {")", "]", "}"})) ++depth;
        if (is_one_of(word, {"(", "[", "{"}) && depth-- == 0) break;
        if (word == "," && depth == 0) break;
        --end;
    }
    return end;
}

bool is_context_item(const Words& words, size_t first, size_t end) {
    if (end == first + 1) return true;
    return std::any_of(words.begin() + static_cast<std::ptrdiff_t>(first),
                       words.begin() + static_cast<std::ptrdiff_t>(end), is_context_type);
}

bool ends_with_wait(const std::vector<std::string>& words) {
    const size_t n = words.size();
    return n > 4 && words[n - 1] == ")" && words[n - 2] == "(" && words[n - 3] == "wait" && words[n - 4] == ".";
}

/// Where each argument of the call whose bracket is at `open` ends; none if the call is not the rest of the words.
std::vector<size_t> argument_ends(const std::vector<std::string>& words, size_t open) {
    std::vector<size_t> out;
    int depth = 0;
    for (size_t i = open; i < words.size(); ++i) {
        if (words[i] == "(" || words[i] == "[" || words[i] == "{") ++depth;
        if (words[i] == ")" || words[i] == "]" || words[i] == "}") --depth;
        if ((depth == 1 && words[i] == ",") || depth == 0) out.push_back(i);
        if (depth == 0) return i + 1 == words.size() ? out : std::vector<size_t>();
    }
    return {};
}

}  // namespace

bool says_that_it_checks(std::string_view name) {
    for (const std::string_view part : {"check", "chk", "safecall"})
        if (holds_in_any_case(name, part)) return true;
    return false;
}

bool is_runtime_call(std::string_view name) {
    const auto is_upper = [](char c) { return c >= 'A' && c <= 'Z'; };
    for (const std::string_view prefix : {"cuda", "hip", "cublas", "hipblas", "cufft", "hipfft", "curand", "hiprand",
                                          "cusparse", "hipsparse", "cusolver", "nccl", "rccl"})
        if (name.starts_with(prefix) && name.size() > prefix.size()) return true;
    for (const std::string_view prefix : {"cl", "cu", "vk"})
        if (name.starts_with(prefix) && name.size() > prefix.size() && is_upper(name[prefix.size()])) return true;
    return false;
}

bool opens_launch(const Words& text, size_t i) {
    return i + 2 < text.size() && text[i] == "<" && text[i + 1] == "<" && text[i + 2] == "<";
}

bool drives_device(const Words& text) {
    for (size_t i = 0; i + 2 < text.size(); ++i) {
        if (text[i + 1] == "(" && is_runtime_call(text[i])) return true;
        if (opens_launch(text, i)) return true;
        const bool is_member = text[i] == "." || text[i] == "->";
        if (is_member && (text[i + 1] == "submit" || text[i + 1] == "parallel_for")) return true;
        if (text[i] == "pragma" && text[i + 1] == "omp" && text[i + 2] == "target") return true;
    }
    return false;
}

void note_contexts(const Words& text, ContextNames& names) {
    for (size_t i = 0; i < text.size(); ++i) {
        if (!is_context_type(text[i])) continue;
        const size_t name = declared_at(text, i);
        if (name < text.size()) names.insert(text[name]);
    }
}

void drop_contexts(Words& statement, const ContextNames& names) {
    for (size_t i = statement.size(); i-- > 1;) {
        if (!names.contains(statement[i]) || i + 1 == statement.size()) continue;
        const std::string_view after = statement[i + 1];
        if (after != "," && after != ")") continue;
        const size_t first = item_begin(statement, i + 1);
        if (first == 0 || !is_context_item(statement, first, i + 1)) continue;
        const bool leads = statement[first - 1] == ",";
        if (!leads && statement[first - 1] != "(") continue;
        const size_t from = leads ? first - 1 : first, to = !leads && after == "," ? i + 2 : i + 1;
        statement.erase(statement.begin() + static_cast<std::ptrdiff_t>(from),
                        statement.begin() + static_cast<std::ptrdiff_t>(to));
        i = std::min(i, from + 1);
    }
}

bool changes_direction(const Words& before, const Words& now) {
    std::map<std::string_view, int> change;
    const auto count = [&](const Words& text, int step) {
        for (const std::string_view word : text)
            if ((word.starts_with("cudaMemcpy") || word.starts_with("hipMemcpy")) && word.find("To") != word.npos)
                change[word] += step;
    };
    count(before, -1);
    count(now, 1);
    const auto any = [&](auto&& fits) {
        return std::any_of(change.begin(), change.end(), [&](const auto& each) { return fits(each.second); });
    };
    return any([](int times) { return times > 0; }) && any([](int times) { return times < 0; });
}

void write_plain_transfer(std::vector<std::string>& words, const TransferRules& rules) {
    if (words.size() < 3) return;
    if (rules.of_queue && words[1] == ".") {
        const bool waits = ends_with_wait(words);
        if (words.size() == 5 && words[2] == "wait") {
            words = {"device_wait", "(", ")"};
        } else if (words[2] == "memset" || words[2] == "memcpy") {
            if (waits) words.resize(words.size() - 4);
            const bool counts = waits || (words[2] == "memset" && rules.in_order);
            words.erase(words.begin(), words.begin() + 2);
            words[0] = "device_" + words[0] + (counts ? "" : "_async");
        }
        return;
    }
    if (words[0] == "cudamemset" && words[1] == "(") words[0] = "device_memset";
    if (words[0] == "cudadevicesynchronize" && words.size() == 3) words = {"device_wait", "(", ")"};
    const bool copies = words[0] == "cudamemcpy", later = words[0] == "cudamemcpyasync";
    if (rules.directed || (!copies && !later)) return;
    const std::vector<size_t> ends = argument_ends(words, 1);
    if (ends.size() < 4) return;
    words.resize(ends[2]);
    words.emplace_back(")");
    words[0] = copies ? "device_memcpy" : "device_memcpy_async";
}

}  // namespace porttool
