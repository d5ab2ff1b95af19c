// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/porttool/mutate.h"

namespace porttool::testing {
namespace {

/// The n-th line of a text with its newline, counted by its start: [first, end).
std::pair<size_t, size_t> line_around(const std::string& text, size_t at) {
    const size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
    const size_t first = before == std::string::npos ? 0 : before + 1;
    const size_t after = text.find('\n', first);
    return {first, after == std::string::npos ? text.size() : after + 1};
}

}  // namespace

std::string mutate(std::string text, const MutationStock& stock, std::mt19937_64& random) {
    auto pick = [&](size_t most) { return static_cast<size_t>(random() % (most + 1)); };
    auto one_of = [&](const std::vector<std::string>& list) -> const std::string& {
        return list[pick(list.size() - 1)];
    };
    for (size_t edits = 1 + pick(5); edits > 0; --edits) {
        const size_t at = pick(text.size());
        switch (pick(8)) {
            case 0:
                text.insert(at, one_of(stock.pieces));
                break;
            case 1:
                text.erase(at, 1 + pick(40));
                break;
            case 2:
                if (pick(3) == 0) text.resize(at);
                break;
            case 3:
                text.insert(at, text.substr(pick(text.size()), pick(200)));
                break;
            case 4: {
                const std::string& other = one_of(stock.texts);
                text.insert(at, other.substr(pick(other.size()), pick(300)));
                break;
            }
            case 5:  // another byte, often a neighbour of what stood there
                if (at < text.size())
                    text[at] = static_cast<char>(pick(1) == 0 ? pick(255) : static_cast<size_t>(text[at] ^ 1));
                break;
            case 6: {  // a line twice, or not at all
                const auto [first, end] = line_around(text, at);
                if (pick(1) == 0)
                    text.erase(first, end - first);
                else
                    text.insert(first, text.substr(first, end - first));
                break;
            }
            case 7: {  // a piece in the place of a stretch
                text.erase(at, pick(20));
                text.insert(at, one_of(stock.pieces));
                break;
            }
            default: {  // a line moved
                const auto [first, end] = line_around(text, at);
                const std::string line = text.substr(first, end - first);
                text.erase(first, end - first);
                text.insert(line_around(text, pick(text.size())).first, line);
            }
        }
    }
    return text;
}

}  // namespace porttool::testing
