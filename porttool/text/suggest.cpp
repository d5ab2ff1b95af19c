// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/suggest.h"

#include "metrics/text/suggest.h"

namespace porttool {

std::string nearest(const std::string& word, const std::vector<std::string>& names) {
    return metrics::suggest(word, names).value_or("");
}

}  // namespace porttool
