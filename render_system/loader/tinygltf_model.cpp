// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// The one place that compiles tinygltf's implementation: the packaged library does not leave its file access out.
#include <fstream>  // tinygltf uses it without saying so where file access is left out
#define TINYGLTF_IMPLEMENTATION
#include "render_system/loader/tinygltf_model.h"
