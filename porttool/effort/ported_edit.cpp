// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/effort/ported_edit.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "porttool/effort/common_lines.h"

namespace porttool {
namespace {

/// One side's lines in the common vocabulary, and how often each text stands on old lines and on new ones.
struct Translated {
    struct Count {
        size_t kept = 0, gained = 0;
    };
    std::vector<uint32_t> texts;  ///< of the gained lines, in order; 0 for one that says nothing
    std::unordered_map<uint32_t, Count> counts;

    Translated(const EditedLines& side, const WordNumbers& words, SequenceNumbers& numbers) {
        NumberedWords common;
        for (size_t i = 0, n = 0; i < side.now.lines.size(); ++i) {
            common.clear();
            words.append_common(side.now.words_of(side.now.lines[i]), common);
            const uint32_t text = numbers.number(common);
            const bool is_new = n < side.added.size() && side.added[n] == i;
            ++(is_new ? counts[text].gained : counts[text].kept);
            if (!is_new) continue;
            texts.push_back(text);
            ++n;
        }
    }

    Count count(uint32_t text) const {
        const auto found = counts.find(text);
        return found == counts.end() ? Count() : found->second;
    }
};

/// Which of the gained lines the other side has as well: as a whole line, where each line of the other side answers for
/// one, or else in one run. Of the other side only what it gained counts, unless `old_code`: then also what it had and
/// this side had not. A lone brace goes with the gained line before it.
std::vector<bool> answered(const EditedLines& side, const Translated& here, const Translated& there,
                           const LineSet& in_runs, bool old_code) {
    const auto answers = [&](uint32_t text) {
        const Translated::Count found = there.count(text);
        if (!old_code || found.kept == 0) return found.gained;
        const size_t all = found.gained + found.kept;
        return all - std::min(all, here.count(text).kept);
    };
    std::unordered_map<uint32_t, size_t> used;
    std::vector<bool> out(side.added.size());
    for (size_t n = 0; n < side.added.size(); ++n) {
        const uint32_t text = here.texts[n];
        if (text == 0 && n > 0) {
            out[n] = out[n - 1];
            continue;
        }
        if (size_t& taken = used[text]; taken < answers(text)) {
            ++taken;
            out[n] = true;
            continue;
        }
        const Translated::Count found = there.count(text);
        out[n] = found.gained + found.kept == 0 &&
                 std::binary_search(in_runs.begin(), in_runs.end(), side.added_line(n).line);
    }
    return out;
}

/// The gained lines of a port under the strictest reading that each allows; `usual` tells of the usual one.
CarriedLines carried_lines(const EditedUnit& source, const EditedUnit& target, const std::vector<bool>& usual,
                           const LineSet& half) {
    std::unordered_set<uint32_t> written;
    for (const TextLine& line : source.lines.now.lines) written.insert(line.text);
    CarriedLines out(usual.size(), Carried::No);
    for (size_t n = 0; n < out.size(); ++n) {
        const TextLine& line = target.lines.added_line(n);
        if (usual[n])
            out[n] = written.contains(line.text) ? Carried::Strict : Carried::Usual;
        else if (std::binary_search(half.begin(), half.end(), line.line))
            out[n] = Carried::Loose;
    }
    return out;
}

size_t count_common(const NumberedWords& left, const NumberedWords& right) {
    size_t common = 0;
    for (auto a = left.begin(), b = right.begin(); a != left.end() && b != right.end();) {
        if (*a == *b) ++common;
        const bool step_a = *a <= *b, step_b = *b <= *a;
        if (step_a) ++a;
        if (step_b) ++b;
    }
    return common;
}

}  // namespace

std::optional<double> PortedEdit::similarity() const {
    if (source_tokens == 0 || target_tokens == 0) return std::nullopt;
    return 2.0 * static_cast<double>(common_tokens) / static_cast<double>(source_tokens + target_tokens);
}

std::optional<double> PortedEdit::carried_over() const {
    if (source.added == 0) return std::nullopt;
    return ported / static_cast<double>(source.added);
}

void take_strictest(CarriedLines& lines, const CarriedLines& more) {
    lines.resize(std::max(lines.size(), more.size()), Carried::No);
    for (size_t n = 0; n < more.size(); ++n) lines[n] = std::max(lines[n], more[n]);
}

void count_into(const CarriedLines& lines, metrics::SharedLines& out) {
    for (const Carried line : lines) {
        if (line >= Carried::Loose) ++out.shared_high;
        if (line >= Carried::Usual) ++out.shared;
        if (line == Carried::Strict) ++out.shared_low;
    }
}

NumberedWords added_words(const EditedLines& edit, WordNumbers& words) {
    NumberedWords text;
    for (const size_t i : edit.added) {
        const std::span<const uint32_t> line = edit.now.words_of(edit.now.lines[i]);
        text.insert(text.end(), line.begin(), line.end());
    }
    NumberedWords out;
    words.append_common(text, out);
    std::erase(out, words.closing_brace());
    std::sort(out.begin(), out.end());
    return out;
}

ComparedEdits compare_ported(const EditedUnit& source, const EditedUnit& target, LineReader& reader,
                             const Dialect& dialect) {
    ComparedEdits out;
    PortedEdit& edit = out.edit;
    edit.source = source.lines.edit;
    edit.target = target.lines.edit;
    edit.carried.lines = static_cast<double>(edit.target.added);
    if (source.now.file != nullptr && target.now.file != nullptr) {
        SequenceNumbers numbers;
        const Translated left(source.lines, reader.words, numbers), right(target.lines, reader.words, numbers);
        const CommonLines runs = common_lines(source.now, target.now, target.lines, dialect);
        const std::vector<bool> ported = answered(source.lines, left, right, runs.source, false);
        edit.ported = static_cast<double>(std::count(ported.begin(), ported.end(), true));
        out.carried = carried_lines(source, target, answered(target.lines, right, left, runs.target, true), runs.half);
        count_into(out.carried, edit.carried);
    }
    const NumberedWords left = added_words(source.lines, reader.words), right = added_words(target.lines, reader.words);
    edit.source_tokens = left.size();
    edit.target_tokens = right.size();
    edit.common_tokens = count_common(left, right);
    return out;
}

}  // namespace porttool
