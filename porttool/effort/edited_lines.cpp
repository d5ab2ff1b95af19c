// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/effort/edited_lines.h"

#include <algorithm>

#include "porttool/normal/diff.h"

namespace porttool {
namespace {

std::vector<uint32_t> texts_of(const LinesOfCode& code) {
    std::vector<uint32_t> texts;
    texts.reserve(code.lines.size());
    for (const TextLine& line : code.lines) texts.push_back(line.text);
    return texts;
}

}  // namespace

LineEdit& LineEdit::operator+=(const LineEdit& more) {
    added += more.added;
    removed += more.removed;
    return *this;
}

LinesOfCode LineReader::read(const Excerpt& excerpt) {
    LinesOfCode out;
    if (excerpt.file == nullptr) return out;
    const LexedText& lexed = excerpt.file->lexed;
    for (const TokenRange& stretch : code_stretches(excerpt))
        for (uint32_t index = stretch.first; index < stretch.end; ++index) {
            const Token& token = lexed.tokens[index];
            if (out.lines.empty() || out.lines.back().line != token.line)
                out.lines.push_back({token.line, 0, out.words.size(), 0});
            out.words.push_back(words.word(lexed.view(token), token.kind));
            out.lines.back().end = out.words.size();
        }
    for (TextLine& line : out.lines) line.text = texts_.number(out.words_of(line));
    return out;
}

bool EditedLines::is_new(uint32_t line) const {
    const auto found = std::lower_bound(added.begin(), added.end(), line,
                                        [&](size_t i, uint32_t wanted) { return now.lines[i].line < wanted; });
    return found != added.end() && now.lines[*found].line == line;
}

EditedLines edited_lines(const LinesOfCode& before, LinesOfCode now) {
    EditedLines out;
    for (const DiffStep& step : diff(texts_of(before), texts_of(now))) {
        if (step.kind == DiffStep::Remove) ++out.edit.removed;
        if (step.kind == DiffStep::Add) out.added.push_back(step.now);
    }
    out.edit.added = out.added.size();
    out.now = std::move(now);
    return out;
}

}  // namespace porttool
