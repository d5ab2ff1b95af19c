// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>
#include <vector>

namespace porttool::testing {

/// What mutations are made of: texts to cut stretches from, and short pieces that mean something to the reader.
struct MutationStock {
    std::vector<std::string> texts;
    std::vector<std::string> pieces;
};

/// A text after one to six random edits: stretches taken out, repeated or brought in, pieces put in, bytes and lines
/// changed, the end cut off. Depends on nothing but the arguments.
std::string mutate(std::string text, const MutationStock& stock, std::mt19937_64& random);

}  // namespace porttool::testing
