// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <string>
#include <string_view>

#include "render_system/status.h"

namespace source_core {

using render_system::Result;
using render_system::Status;
using render_system::StatusCode;

/// The name of a VkResult as the specification spells it, or its number.
std::string result_name(VkResult result);

/// What a failed call means for the user of the core: "failed to `action` (VK_ERROR_...)".
Status vulkan_error(std::string_view action, VkResult result);

}  // namespace source_core
