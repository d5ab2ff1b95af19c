// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "porttool/normal/normal_text.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// How a port says that the host waits for all that its device has to do, as words; none where nothing tells. With
/// OpenMP's directives it waits anyway, and the words are none.
///
///     cudaDeviceSynchronize ( ) ;        q . wait ( ) ;        of a SYCL unit with one queue `q`
using DeviceWait = std::optional<std::vector<std::string>>;

/// Of a unit's words in its file.
DeviceWait device_wait(const std::vector<std::string>& unit, const ScannedFile& file);

/// A unit's text without the statements that wait for a device, those of the port, `wait`, among them.
NormalText without_waits(const NormalText& text, const std::vector<std::string>& wait);

/// True for the statement words[first, end) that waits so in CUDA or HIP.
bool waits_for_device(const std::vector<std::string>& words, size_t first, size_t end);

}  // namespace porttool
