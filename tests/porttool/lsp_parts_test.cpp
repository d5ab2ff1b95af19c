// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The parts of the language server that need no client: framing, positions, URIs, edits.
#include <gtest/gtest.h>

#include <random>

#include "porttool/lsp/code_actions.h"
#include "porttool/lsp/documents.h"
#include "porttool/lsp/file_uri.h"
#include "porttool/lsp/message_reader.h"

namespace porttool::testing {
namespace lsp_parts_test {
namespace {

using namespace porttool::lsp;

// U+00E9 is one unit of UTF-16, U+1F600 two (Unicode 15, 3.9, table 3-5), whatever their bytes in UTF-8.
const std::string kMixed = "a\xC3\xA9\xF0\x9F\x98\x80z\r\nsecond\rthird\n";

TEST(LspPositions, CountUtf16UnitsAndKnowEachLineEnd) {
    EXPECT_EQ(utf16_length("a\xC3\xA9\xF0\x9F\x98\x80z"), 5u);
    EXPECT_EQ(utf16_length("\xFFz"), 2u);
    const TextPlaces places(kMixed);
    EXPECT_EQ(places.offset_of({0, 4}), 7u);   // behind the pair of surrogates
    EXPECT_EQ(places.offset_of({0, 3}), 3u);   // within it: its beginning
    EXPECT_EQ(places.offset_of({0, 99}), 8u);  // before \r\n
    EXPECT_EQ(places.offset_of({1, 2}), 12u);
    EXPECT_EQ(places.offset_of({2, 0}), 17u);
    EXPECT_EQ(places.offset_of({3, 0}), kMixed.size());
    EXPECT_EQ(places.offset_of({2147483647, 2147483647}), kMixed.size());
    EXPECT_EQ(places.position_of(7), (Position{0, 4}));
    EXPECT_EQ(places.position_of(12), (Position{1, 2}));
    EXPECT_EQ(places.position_of(kMixed.size()), (Position{3, 0}));
}

TEST(LspPositions, AreCountedAlikeWithinLongLines) {
    std::mt19937 random(20);
    const std::string characters[] = {"a", " ", "\n", "\xC3\xA9", "\xF0\x9F\x98\x80", "\xFF"};
    std::string text;
    std::vector<size_t> beginnings;
    while (text.size() < 40000) {
        beginnings.push_back(text.size());
        text += characters[random() % std::size(characters)];
    }
    const Utf16Counts counts(text);
    for (int i = 0; i < 300; ++i) {
        size_t first = beginnings[random() % beginnings.size()], end = beginnings[random() % beginnings.size()];
        if (first > end) std::swap(first, end);
        EXPECT_EQ(counts.between(first, end), utf16_length(text.substr(first, end - first))) << first << " " << end;
    }
    EXPECT_EQ(counts.between(0, text.size()), utf16_length(text));
    EXPECT_EQ(Utf16Counts("").between(0, 0), 0U);
}

TEST(LspPositions, ChangesOfADocumentGoWhereTheyPoint) {
    std::string text = kMixed;
    apply_change(text, {Range{{0, 1}, {0, 4}}, "-"});
    EXPECT_EQ(text, "a-z\r\nsecond\rthird\n");
    apply_change(text, {Range{{2, 5}, {1, 0}}, ""});  // the wrong way round
    EXPECT_EQ(text, "a-z\r\n\n");
    apply_change(text, {std::nullopt, "new"});
    EXPECT_EQ(text, "new");
}

TEST(LspPositions, WhatWouldTakeLongOrGrowBeyondASourceIsNoLongerFollowed) {
    const std::string large(2 << 20, 'x');
    const Range start = {{0, 0}, {0, 0}};
    Document document = {"file:///a", 1, large};
    EXPECT_EQ(apply_changes(document, {{start, "1"}, {start, "2"}}), "");
    EXPECT_EQ(document.text, "21" + large);
    const std::vector<DocumentChange> many(1000, {start, "3"});  // each goes through 2 MiB
    EXPECT_NE(apply_changes(document, many), "");
    EXPECT_FALSE(document.is_followed);
    EXPECT_EQ(document.text, "");
    EXPECT_EQ(apply_changes(document, {{start, "4"}}), "") << "told once";
    EXPECT_EQ(document.text, "") << "where it would go is not known";
    EXPECT_EQ(apply_changes(document, {{start, "5"}, {std::nullopt, "whole"}, {start, "6"}}), "");
    EXPECT_EQ(document.text, "6whole");
    EXPECT_TRUE(document.is_followed);
    EXPECT_NE(apply_changes(document, std::vector<DocumentChange>(9, {start, large})), "");  // 18 MiB
    EXPECT_FALSE(document.is_followed);
}

TEST(LspMessages, AreCutWhereverTheStreamIsAndFoundAgainAfterABadHead) {
    const std::string stream = framed("{\"a\":1}") + "Content-Type: x\r\ncontent-length:  2 \r\n\r\n[]" +
                               "Content-Length: two\r\n\r\n{\"lost\":0}" + framed("{}") + "no head\r\n\r\n" +
                               framed("\xC3\xA9") + "Content-Length: -1\r\n\r\n" + framed("3");
    for (const size_t step : {size_t{1}, size_t{7}, stream.size()}) {
        MessageReader reader;
        std::vector<std::string> bodies;
        size_t problems = 0;
        for (size_t at = 0; at < stream.size(); at += step) {
            reader.add(std::string_view(stream).substr(at, step));
            while (const auto message = reader.next())
                message->problem.empty() ? bodies.push_back(message->body) : void(++problems);
        }
        EXPECT_EQ(bodies, (std::vector<std::string>{"{\"a\":1}", "[]", "{}", "\xC3\xA9", "3"})) << step;
        EXPECT_EQ(problems, 3u) << step;
    }
    MessageReader endless;  // what never ends is bounded
    endless.add(std::string(100000, 'x'));
    const auto problem = endless.next();
    ASSERT_TRUE(problem);
    EXPECT_NE(problem->problem, "");
    EXPECT_FALSE(endless.next());
    endless.add("\n" + framed("{}"));
    EXPECT_EQ(endless.next()->body, "{}");

    MessageReader heads;  // nor are heads kept that never come to an end
    size_t problems = 0;
    for (int i = 0; i < 10'000; ++i) {
        heads.add("Content-Length: 2\r\n");
        while (const auto message = heads.next()) problems += message->problem.empty() ? 100 : 1;
    }
    EXPECT_EQ(problems, 1u);
    heads.add("\r\n{}");
    EXPECT_EQ(heads.next()->body, "{}");
}

TEST(LspUris, NameFilesOfThisMachineAlone) {
    const std::string odd = "/a b/%41#?\xC3\xA9.comp";
    EXPECT_EQ(file_uri(odd), "file:///a%20b/%2541%23%3F%C3%A9.comp");
    EXPECT_EQ(path_of_uri(file_uri(odd)), odd);
    EXPECT_EQ(path_of_uri("file://localhost/a/../b"), "/b");
    EXPECT_EQ(path_of_uri("file:///a%3ab"), "/a:b");
    for (const char* bad :
         {"untitled:1", "file://host/a", "file:///a%0", "file:///a%00b", "file:///%zz", "file://", ""})
        EXPECT_FALSE(path_of_uri(bad)) << bad;
}

/// Applies the edits of the protocol, which all speak of the text before, from the last to the first.
std::string applied(std::string text, const Json& edits) {
    for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit)
        apply_change(text, {range_at(*edit, {"range"}), string_at(*edit, {"newText"})});
    return text;
}

TEST(LspEdits, MakeTheOtherTextOfAnyText) {
    std::mt19937 random(7);
    const std::vector<std::string> lines = {"a\n", "b\r\n", "\xF0\x9F\x98\x80\n", "\n", "d"};
    for (int round = 0; round < 300; ++round) {
        std::string texts[2];
        for (std::string& text : texts)
            for (unsigned count = random() % 7; count > 0; --count) text += lines[random() % lines.size()];
        const Json edits = text_edits(texts[0], texts[1]);
        EXPECT_EQ(applied(texts[0], edits), texts[1]);
        EXPECT_EQ(edits.empty(), texts[0] == texts[1]);
    }
}

}  // namespace
}  // namespace lsp_parts_test
}  // namespace porttool::testing
