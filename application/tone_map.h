// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace application {

/// Curves that bring radiance into the range of a display.
enum class ToneMap {
    none,     ///< what is past 1 is cut off
    neutral,  ///< Khronos PBR Neutral: colours below 0.8 stay, what is brighter is compressed and fades to white
    aces,     ///< the ACES reference rendering and output transforms for sRGB, as Stephen Hill fitted them
    agx,      ///< AgX in its base look (Troy Sobotka), as Benjamin Wrensch fitted it
};

/// Linear RGB (primaries of sRGB) before and after, the latter still linear; not below 0, NaN is 0. `exposure` is the
/// factor on the radiance.
glm::vec3 tone_mapped(const glm::vec3& radiance, float exposure, ToneMap curve);

}  // namespace application
