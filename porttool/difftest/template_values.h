// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>

#include "porttool/difftest/cpp_text.h"
#include "porttool/difftest/definitions.h"

namespace porttool {

/// What a function works on, by the types of its parameters: whole numbers where there are no others.
std::string number_type_of(const Definition& function);

/// `<float, 4>` for `template <class T, int N>`; "?" where a parameter is neither a type nor a number.
std::string template_arguments(const ScannedFile& file, const Unit& unit, const std::string& type);

/// What each parameter of a template stands for, by name.
std::map<std::string, std::string> template_values(const ScannedFile& file, const Unit& unit,
                                                   const std::string& arguments);

/// The head `template <class F>` of a struct and its arguments `<F>`; both "" for others.
std::pair<std::string, std::string> template_head(const Definition& one, const CppManner& manner);

}  // namespace porttool
