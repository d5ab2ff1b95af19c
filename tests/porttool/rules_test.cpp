// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The page docs/porttool.md tells of each rule with its level, and of no other.
#include "porttool/judge/rules.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>

namespace rules_test {
namespace {

using namespace porttool;

using Levels = std::map<std::string, std::string>;

Levels levels_on_the_page() {
    Levels out;
    std::ifstream page(std::string(REPOSITORY) + "/docs/porttool.md");
    const std::regex row(R"(^\| (`[a-z`, -]+`) \| (error|warning|note|off) \|.*)"), name("`([a-z-]+)`");
    for (std::string line; std::getline(page, line);) {
        std::smatch found;
        if (!std::regex_match(line, found, row)) continue;
        const std::string names = found[1], level = found[2];
        for (std::sregex_iterator at(names.begin(), names.end(), name), end; at != end; ++at) out[(*at)[1]] = level;
    }
    return out;
}

TEST(Rules, ThePageTellsOfEach) {
    Levels known;
    for (size_t i = 0; i < kRuleNames.size(); ++i) {
        const RuleRow& row = rule_row(static_cast<Rule>(i));
        known[std::string(kRuleNames[i])] = level_name(row.level);
        EXPECT_EQ(rule_named(kRuleNames[i]), row.rule);
        EXPECT_EQ(row.meaning.find('\n'), std::string_view::npos) << kRuleNames[i] << ": one line each";
        EXPECT_EQ(row.remedy.find('\n'), std::string_view::npos) << kRuleNames[i];
    }
    EXPECT_EQ(levels_on_the_page(), known);
}

}  // namespace
}  // namespace rules_test
