// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/declare.h"

#include <CLI/CLI.hpp>

namespace porttool {

DeclaredOption& DeclaredOption::required() {
    option_.required();
    return *this;
}

DeclaredOption& DeclaredOption::exactly(int values) {
    option_.expected(values);
    return *this;
}

DeclaredOption& DeclaredOption::or_alone(bool& given) {
    option_.expected(0, 1)->each([&given](const std::string&) { given = true; });
    return *this;
}

DeclaredOption& DeclaredOption::one_at_a_time() {
    option_.allow_extra_args(false);
    return *this;
}

DeclaredOption& DeclaredOption::some_revision() {
    option_.check([](const std::string& text) { return text.empty() ? "expected a revision" : ""; });
    return *this;
}

void Declare::flag(const char* names, bool& value, const char* help) { command_.add_flag(names, value, help); }

DeclaredOption Declare::text(const char* names, std::string& value, const char* type, const char* help) {
    return DeclaredOption(*command_.add_option(names, value, help)->type_name(type));
}

void Declare::choice(const char* names, std::string& value, const std::vector<std::string>& known, const char* help) {
    command_.add_option(names, value, help)->check(CLI::IsMember(known));
}

DeclaredOption Declare::texts(const char* names, std::vector<std::string>& values, const char* type, const char* help) {
    return DeclaredOption(*command_.add_option(names, values, help)->type_name(type));
}

}  // namespace porttool
