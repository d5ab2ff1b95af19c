// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "application/locate/located.h"
#include "porttool/text/fingerprint.h"

namespace evidence_test {
namespace {

std::string porttool_fingerprint(const std::string& text) {
    porttool::Fingerprinter print;
    print.add(text);
    return print.digits();
}

TEST(Evidence, HasThePrintsOfPorttool) {
    std::string text;
    for (int size = 0; size < 600; ++size) {
        ASSERT_EQ(application::text_fingerprint(text), porttool_fingerprint(text)) << size << " bytes";
        text.push_back(static_cast<char>('!' + size * 7 % 90 + (size % 5 == 0 ? 128 : 0)));
    }
}

TEST(Evidence, DoesNotSeeHowACheckoutEndsItsLines) {
    EXPECT_EQ(application::text_fingerprint("\xEF\xBB\xBF"
                                            "a\r\nb\\\r\nc\rd"),
              porttool_fingerprint("a\nbc\nd"));
    EXPECT_EQ(application::text_fingerprint("#define F(x) \\\n    x\n"), porttool_fingerprint("#define F(x)     x\n"));
    EXPECT_NE(application::text_fingerprint("a b"), application::text_fingerprint("ab"));
}

}  // namespace
}  // namespace evidence_test
