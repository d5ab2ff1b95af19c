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

DeclaredOption& DeclaredOption::one_at_a_time() {
    option_.allow_extra_args(false);
    return *this;
}

DeclaredOption& DeclaredOption::not_empty(const char* what) {
    option_.check([what](const std::string& text) { return text.empty() ? std::string("expected ") + what : ""; });
    return *this;
}

void Declare::flag(const char* names, bool& value, const char* help) { command_.add_flag(names, value, help); }

DeclaredOption Declare::text(const char* names, std::string& value, const char* type, const char* help) {
    return DeclaredOption(*command_.add_option(names, value, help)->type_name(type));
}

void Declare::choice(const char* names, std::string& value, const std::vector<std::string>& known, const char* help) {
    command_.add_option(names, value, help)->check(CLI::IsMember(known));
}

void Declare::text_or_alone(const char* name, std::string& value, bool& given, const char* type, const char* help) {
    const CLI::Option* option = command_.add_option(name, value, help)->type_name(type)->expected(0, 1);
    command_.parse_complete_callback([option, &given] { given = option->count() > 0; });
}

DeclaredOption Declare::texts(const char* names, std::vector<std::string>& values, const char* type, const char* help) {
    return DeclaredOption(*command_.add_option(names, values, help)->type_name(type));
}

}  // namespace porttool
