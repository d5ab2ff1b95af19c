// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/name_words.h"

#include <gtest/gtest.h>

namespace porttool {
namespace {

using Pieces = std::vector<std::string_view>;
using NameText = std::vector<std::string>;

TEST(NameWords, PiecesJoinedAreTheName) {
    EXPECT_EQ(name_pieces("getCuda_FFTPlan"), (Pieces{"get", "Cuda", "_", "FFT", "Plan"}));
    EXPECT_EQ(name_pieces("a/b.cu:f"), (Pieces{"a", "/", "b", ".", "cu", ":", "f"}));
    EXPECT_EQ(name_pieces("__x2y__"), (Pieces{"_", "_", "x2y", "_", "_"}));
    EXPECT_EQ(name_pieces(""), Pieces{});
    for (const std::string_view name : {"ggmlOpAdd", "GGML_OP_ADD", "ABc", "aB", "A", "_", "x1Y2z"}) {
        std::string joined;
        for (const std::string_view piece : name_pieces(name)) joined += piece;
        EXPECT_EQ(joined, name);
    }
}

TEST(NameWords, AreTheSameInEachMannerOfWritingThem) {
    const NameText words = {"ggml", "op", "add"};
    for (const std::string_view name : {"ggmlOpAdd", "GgmlOpAdd", "GGML_OP_ADD", "ggml_op_add", "_ggml_opAdd_"})
        EXPECT_EQ(words_of_name(name), words) << name;
    EXPECT_EQ(words_of_name("BSDFValue"), (NameText{"bsdf", "value"}));
    EXPECT_EQ(words_of_name("___"), NameText{});
}

}  // namespace
}  // namespace porttool
