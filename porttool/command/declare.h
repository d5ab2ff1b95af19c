// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace porttool {

/// An option that takes a value, and what is asked of it.
class DeclaredOption {
public:
    explicit DeclaredOption(CLI::Option& option) : option_(option) {}
    DeclaredOption& required();
    DeclaredOption& exactly(int values);
    /// One value each time that the option is given.
    DeclaredOption& one_at_a_time();
    /// May not be empty, as an unset variable of CI would make it. `what`: that is expected, "a revision"; it outlives.
    DeclaredOption& not_empty(const char* what);

private:
    CLI::Option& option_;
};

/// Takes the options of a command. Apart from the parser, which is slow to compile, so that a command does not need it.
class Declare {
public:
    explicit Declare(CLI::App& command) : command_(command) {}
    void flag(const char* names, bool& value, const char* help);
    /// Without dashes in `names` they are arguments by their place. `type` stands for a value in the help.
    DeclaredOption text(const char* names, std::string& value, const char* type, const char* help);
    void choice(const char* names, std::string& value, const std::vector<std::string>& known, const char* help);
    /// An option whose one value may be left out; `given` says whether it was there at all.
    void text_or_alone(const char* name, std::string& value, bool& given, const char* type, const char* help);
    DeclaredOption texts(const char* names, std::vector<std::string>& values, const char* type, const char* help);

private:
    CLI::App& command_;
};

}  // namespace porttool
