// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <tuple>
#include <vector>

#include "render_system/core_data.h"

namespace render_system {

/// Cells a side of a slice of LobeEnergy.
constexpr uint32_t kEnergyCells = 23;

/// Steps of strength and of the view's turn between the slices of an anisotropic lobe.
constexpr uint32_t kEnergyStrengths = 12, kEnergyTurns = 5;

/// The index of refraction by which a material bends light: at 1 itself the half vector of a refraction vanishes, so
/// that the nearest index taken is 1.001 (or 0.999), which bends by less than a thousandth of a radian.
float bending_ior(const CoreMaterial& material);

/// What one scattering off rough microfacets (GGX, Smith) returns of a white surface's light; the rest is scattered
/// again in truth, and a core gives it back by that factor: Turquin 2019, "Practical multiple scattering compensation
/// for microfacet models", after Kulla and Conty 2017. Tabulated by the cosine of the view (its root) and the
/// roughness, in slices of kEnergyCells^2 rows; a row is one cell, its corners' values in x and y at the lower
/// roughness, in z and w at the higher. A value is two numbers in 16 bits: what returns of all light (low), and what is
/// reflected times Schlick's weight (high), by which a Fresnel term of any strength is summed up. The numbers are the
/// same for all cores.
class LobeEnergy {
public:
    /// Row of the slices for that material: the first for light that comes from its front, the second from behind;
    /// after these, where its lobe is stretched, those of stretched_row() for the front, then from behind. 0 for what
    /// does not refract: the slice of reflection alone, which is all that lets itself be mirrored.
    uint32_t row_of(const CoreMaterial& material);

    /// First row of sheen's two slices, made when they are first asked for: of KHR_materials_sheen's lobe at colour 1,
    /// in the low bits what it returns, in the high ones by what it is scaled to return no more than there is
    /// (Charlie's fit gives 2.9 times the light at grazing angles and low roughness). The second is of cosines up to a
    /// sixteenth.
    uint32_t sheen_row();

    /// First row of anisotropic reflection (KHR_materials_anisotropy), made when it is first asked for:
    /// (kEnergyStrengths
    /// + 1) times (kEnergyTurns + 1) slices, the view's turn fastest. A turn is told by the root of the lobe's
    /// roughness in the plane of the view, from that across (0) to that along (1). Off by 0.1 % on average and by up
    /// to 1.3 % at grazing angles.
    uint32_t stretched_row();

    const std::vector<glm::vec4>& rows() const { return rows_; }

private:
    std::vector<glm::vec4> rows_;
    uint32_t sheen_row_ = NONE;
    uint32_t stretched_row_ = NONE;
    std::map<std::tuple<float, float, float, bool>, uint32_t> known_;  // by index, F0, F90, and whether stretched
};

}  // namespace render_system
