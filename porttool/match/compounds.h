// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "porttool/scan/unit.h"
#include "porttool/text/text_numbers.h"

namespace porttool {

/// Words that some names spell together and others apart: `batchnorm.comp` and `BatchNorm::forward`, `prelu` and
/// `PReLU`, `soft_max` and `softmax`. What is one word somewhere is one word everywhere.
class Compounds {
public:
    Compounds(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target);

    /// The words of a name, as split_words() gives them, with those in one that are one elsewhere.
    std::vector<std::string> split(std::string_view name) const;

private:
    TextNumbers together_;  ///< the compounds that some name spells apart
};

}  // namespace porttool
