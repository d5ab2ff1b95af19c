// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What must hold of every comparison, whatever the texts: each figure lies in its range, exchanging the sides exchanges
// the figures, and a text is wholly like itself.
#include <random>

#include "porttool/measure/measure.h"
#include "porttool/scan/scan.h"
#include "tests/porttool/fixtures.h"

namespace porttool::testing::compare_fuzz_test {
namespace {

/// Takes out, repeats, moves or garbles a few stretches.
std::string mutated(std::string text, const std::string& other, std::mt19937& random) {
    auto pick = [&](size_t n) { return random() % (n + 1); };
    for (size_t edits = 1 + pick(8); edits > 0; --edits) {
        const size_t at = pick(text.size()), length = pick(200);
        switch (pick(4)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(at, text.substr(pick(text.size()), length));
                break;
            case 2:
                text.insert(at, other.substr(pick(other.size()), length));
                break;
            case 3:
                text.insert(at, 1, "{}()[];,\"'#/*\\\n x1"[pick(17)]);
                break;
            default:
                std::swap(text[at % std::max<size_t>(1, text.size())], text[pick(text.size()) % text.size()]);
        }
        if (text.empty()) text = " ";
    }
    return text;
}

void expect_within(const std::optional<double>& figure, double most) {
    if (!figure) return;
    EXPECT_GE(*figure, 0);
    EXPECT_LE(*figure, most);
}

void expect_in_range(const SideMeasure& side, const std::vector<std::vector<CodeLine>>& lines) {
    for (const auto& percent : {side.moss_percent, side.moss_percent_blind, side.moss_percent_raw})
        expect_within(percent, 100);
    uint32_t shared = 0, count = 0;
    for (const auto& excerpt : lines)
        for (const CodeLine& line : excerpt) ++count, shared += line.shared ? 1 : 0;
    EXPECT_EQ(side.lines, count);
    EXPECT_EQ(side.shared_lines, shared);
}

void expect_same(const SideMeasure& x, const SideMeasure& y) {
    EXPECT_EQ(x.lines, y.lines);
    EXPECT_EQ(x.tokens, y.tokens);
    EXPECT_EQ(x.shared_lines, y.shared_lines);
    EXPECT_EQ(x.moss_percent, y.moss_percent);
    EXPECT_EQ(x.moss_percent_blind, y.moss_percent_blind);
    EXPECT_EQ(x.moss_percent_raw, y.moss_percent_raw);
}

void expect_sound(const ScannedFile& left, const ScannedFile& right) {
    const Similarity there = measure({{&left, nullptr}}, {{&right, nullptr}}, Dialect());
    const Similarity back = measure({{&right, nullptr}}, {{&left, nullptr}}, Dialect());
    expect_in_range(there.a, there.a_lines);
    expect_in_range(there.b, there.b_lines);
    for (const auto& figure : {there.tiling, there.token_edit, there.tree_distance, there.line_divergence})
        expect_within(figure, 1);
    expect_same(there.a, back.b);
    expect_same(there.b, back.a);
    EXPECT_EQ(there.token_edit, back.token_edit);
    EXPECT_EQ(there.tree_distance, back.tree_distance);
    EXPECT_EQ(there.line_divergence, back.line_divergence);
}

void expect_like_itself(const ScannedFile& file) {
    const Similarity self = measure({{&file, nullptr}}, {{&file, nullptr}}, Dialect());
    for (const auto& percent : {self.a.moss_percent, self.a.moss_percent_blind, self.a.moss_percent_raw})
        EXPECT_EQ(percent.value_or(100), 100);
    EXPECT_EQ(self.tiling.value_or(1), 1);
    EXPECT_EQ(self.token_edit.value_or(1), 1);
    EXPECT_EQ(self.tree_distance.value_or(0), 0);
    EXPECT_EQ(self.line_divergence.value_or(0), 0);
}

TEST(CompareFuzz, FiguresAreInRangeAndSymmetricOnMutatedKernels) {
    const std::filesystem::path folder = std::filesystem::path(REPOSITORY);
    std::vector<std::string> texts;
    for (const char* path :
         {"source_core/kernels/bsdf.glsl", "source_core/kernels/shade.comp", "source_core/kernels/random.glsl",
          "target_core/kernels/bsdf.h", "target_core/kernels/lights.h", "target_core/kernels/random.h"})
        texts.push_back(read_text(folder / path));
    constexpr size_t kLongest = 1500;  // bytes; the edit distances grow with the square
    std::mt19937 random(20261121);
    for (int round = 0; round < 600; ++round) {
        const std::string& whole = texts[random() % texts.size()];
        const std::string base = whole.substr(random() % whole.size(), kLongest);
        const ScannedFile left = scan_text("a.comp", mutated(base, texts[random() % texts.size()], random));
        const ScannedFile right = scan_text("b.cpp", mutated(base, texts[random() % texts.size()], random));
        SCOPED_TRACE("round " + std::to_string(round) + ":\n" + left.lexed.text + "\n-----\n" + right.lexed.text);
        expect_sound(left, right);
        expect_like_itself(left);
        if (HasFailure()) return;
    }
}

}  // namespace
}  // namespace porttool::testing::compare_fuzz_test
