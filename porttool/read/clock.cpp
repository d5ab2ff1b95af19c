// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/clock.h"

#include <charconv>
#include <cstdlib>
#include <ctime>
#include <string_view>

#include "porttool/read/cannot_do.h"
#include "porttool/text/date.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {

std::string today() {
    int64_t now = std::time(nullptr);
    if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
        constexpr int64_t kYear9999 = 253402300799;
        const std::string_view text = epoch;
        int64_t seconds = -1;
        const auto read = std::from_chars(text.data(), text.data() + text.size(), seconds);
        if (read.ec != std::errc() || read.ptr != text.data() + text.size() || seconds < 0 || seconds > kYear9999)
            throw CannotDo("SOURCE_DATE_EPOCH=" + terminal_text(text) +
                           ": expected seconds since 1970 as a whole number; correct it, or unset it");
        now = seconds;
    }
    return day_of(now);
}

}  // namespace porttool
