// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "porttool/measure/target_matrix.h"

namespace porttool {

/// `{"targets": [name], "units": [{"source", "cells": [{"state", "target", "edits"}]}]}`, or null for one port.
nlohmann::ordered_json matrix_json(const TargetMatrix& matrix);

/// Units by port, one line each; "" for one port.
std::string matrix_table(const TargetMatrix& matrix);
std::string matrix_markdown(const TargetMatrix& matrix);

}  // namespace porttool
