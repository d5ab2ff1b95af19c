// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What a check knows of a file without scanning it, and what it does not do twice.
#include <gtest/gtest.h>

#include "porttool/scan/scan.h"
#include "porttool/snapshot/facts_store.h"

namespace porttool::facts_test {
namespace {

SourceText file_of(const std::string& text) {
    SourceText file;
    file.path = "s/a.cu";
    file.text = text;
    return file;
}

/// The normal form of a large function takes longer than all else: what was written for the facts of a new file is what
/// the judgement is given.
TEST(Facts, OfANewFileAreGivenWithTheTextsThatWereWrittenForThem) {
    const std::string text = "int f(int a) { return a + 1; }\nint g(int b) { return b; }\n";
    FactsStore store("facts_test", "", 0);
    const KnownSide side = store.know({file_of(text)}, {});
    ASSERT_EQ(side.size(), 1u);
    ASSERT_EQ(side[0]->facts().units(), 2u);
    const ScannedFile scanned = scan_text("s/a.cu", text);
    for (uint32_t unit = 0; unit < 2; ++unit) {
        EXPECT_TRUE(side[0]->has_text(unit)) << unit;
        EXPECT_EQ(side[0]->text(unit), state_of(scanned, unit).text.get());
    }
    const auto bytes = std::make_shared<const std::string>(FileFacts::pack(scanned, states_of(scanned, false)));
    EXPECT_EQ(side[0]->facts().bytes(), *bytes);
    const KnownFile kept("s/a.cu", text, *FileFacts::read(bytes, *bytes));
    EXPECT_FALSE(kept.has_text(1)) << "of a file that was kept nobody has asked for it yet";
    EXPECT_EQ(kept.text(1), side[0]->text(1));
    EXPECT_TRUE(kept.has_text(1));
    EXPECT_FALSE(kept.has_text(0));
}

}  // namespace
}  // namespace porttool::facts_test
