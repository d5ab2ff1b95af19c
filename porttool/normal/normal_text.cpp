// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/normal_text.h"

#include <algorithm>

namespace porttool {
namespace {

constexpr char kLineEnd = '\x01', kBlank = '\x02';

}  // namespace

Words NormalText::words() const {
    Words out;
    out.reserve(size());
    for (size_t i = 0; i < size(); ++i) out.push_back((*this)[i]);
    return out;
}

std::string NormalText::recorded() const {
    std::string out;
    out.reserve(bytes_.size() + size());
    int64_t parens = 0;
    for (size_t i = 0; i < size(); ++i) {
        const std::string_view word = (*this)[i];
        for (const char c : word) out += c == '\n' ? kLineEnd : c == ' ' ? kBlank : c;
        if (word == "(") ++parens;
        if (word == ")") --parens;
        const bool ends_line = word == "{" || word == "}" || (word == ";" && parens <= 0) || i + 1 == size();
        out += ends_line ? '\n' : ' ';
    }
    return out;
}

NormalText NormalText::read(std::string_view recorded) {
    NormalText out;
    for (size_t at = 0; at < recorded.size();) {
        const size_t end = std::min(recorded.find_first_of(" \n", at), recorded.size());
        if (end > at) out.add(recorded.substr(at, end - at));
        at = end + 1;
    }
    out.as_recorded();
    return out;
}

void NormalText::as_recorded() {
    for (size_t at = bytes_.find(kLineEnd); at != std::string::npos; at = bytes_.find(kLineEnd, at)) bytes_[at] = '\n';
    for (size_t at = bytes_.find(kBlank); at != std::string::npos; at = bytes_.find(kBlank, at)) bytes_[at] = ' ';
}

void NormalText::shrink() {
    bytes_.shrink_to_fit();
    ends_.shrink_to_fit();
}

}  // namespace porttool
