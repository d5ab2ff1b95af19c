// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/bsdf.glsl.
#pragma once

#include "target_core/kernels/material.h"
#include "target_core/kernels/random.h"

namespace target_core::kernels {

// The metallic-roughness model of glTF 2.0 (appendix B) with KHR_materials_transmission, _ior, _specular, _sheen,
// _clearcoat, _iridescence, _anisotropy and, for solids, refraction. Directions are local: z is the shading normal on
// the side of wo, x where an anisotropic lobe is stretched to; wo and wi point away. Radiance is not scaled by the
// squared ratio of indices at an interface: it cancels over a closed solid.

// Below this GGX alpha a surface is a perfect mirror or pane: its lobe is a delta and has no density.
const float SMOOTH_ALPHA = 1.0e-3f;

// Of a coat, whose index is 1.5.
const float COAT_F0 = 0.04f;

// A smoother sheen is one of this roughness; its energies stand in the table's first line.
const float SMOOTHEST_SHEEN = 0.07f;

// Nearer to the horizon than this cosine Charlie's fit would return more and more of the light, without end.
const float GRAZING_SHEEN = 1.0e-4f;

struct Bsdf {
    vec3 wo;
    vec3 side;           // geometric normal on the side of wo
    vec3 diffuse_color;  // of what enters, over the mean of what leaves
    vec3 transmission_color;
    vec3 again_reflected;    // of light that is scattered more than once, the shares that leave on wo's side
    vec3 again_transmitted;  // and behind
    vec3 f0;                 // of the whole reflection
    Float f90;
    Float dielectric_f0;  // of what does not enter the dielectric
    Float dielectric_f90;
    Float alpha;  // along y
    Float along;  // along x: no less than that
    Float eta;    // index behind the surface over the index on wo's side
    Mask refracts;
    Mask is_smooth;
    Float root_o;  // of Smith's masking of wo
    Float pick_diffuse;
    Float pick_glossy;     // by microfacets: reflected or transmitted as the one that is met decides
    Float passing;         // how far its Fresnel term decides; 0: all is reflected
    Float pick_reflected;  // of pick_glossy, what microfacets throw onto each other and leaves on wo's side
    Float pick_transmitted;
    vec3 sheen_color;  // scaled to return no more light than there is
    Float sheen_strength;
    Float sheen_roughness;
    Uint sheen_row;
    Float sheen_shadow;  // Charlie's lambda of wo
    Float under_sheen;   // of wo's light, what gets through to the rest
    Float pick_sheen;
    Float albedo;  // what sampling takes for the share of the light that everything below a coat returns
    Frame coat_frame;
    vec3 coat_wo;  // in that frame
    Float coat;
    Float coat_alpha;
    Float coat_root_o;
    Float under_coat;
    Float pick_coat;
};

struct BsdfValue {
    vec3 value;  // BSDF times cosine, without delta lobes
    Float pdf;   // per solid angle, of sample_bsdf
};

struct BsdfSample {
    vec3 wi;
    vec3 weight;  // BSDF times cosine over pdf
    Float pdf;    // 0: a delta lobe
    Mask valid;
};

inline Float schlick_weight(Float cosine) {
    Float m = 1.0f - saturate(cosine);
    Float m2 = m * m;
    return m2 * m2 * m;
}

// Squared sine behind the interface; at least 1: total reflection. Snell.
inline Float transmitted_sine_squared(Bsdf bsdf, Float cosine) {
    return max(1.0f - cosine * cosine, 0.0f) / (bsdf.eta * bsdf.eta);
}

// Schlick 1994 takes the larger of the two angles at the interface.
inline Float fresnel_weight(Bsdf bsdf, Float cosine) {
    Float larger = cosine;
    if (has_feature(FEATURE_TRANSMISSION)) {
        Float cosine_behind = sqrt(max(1.0f - transmitted_sine_squared(bsdf, cosine), 0.0f));
        larger = select(bsdf.eta < 1.0f, cosine_behind, cosine);
    }
    return schlick_weight(larger);
}

inline vec3 reflectance(Bsdf bsdf, Float weight) { return bsdf.f0 + (vec3(bsdf.f90) - bsdf.f0) * weight; }

inline Float dielectric_reflectance(Bsdf bsdf, Float weight) {
    return bsdf.dielectric_f0 + (bsdf.dielectric_f90 - bsdf.dielectric_f0) * weight;
}

inline Float smith_root(Float cosine, Float alpha) {
    Float a2 = alpha * alpha;
    return sqrt(a2 + (1.0f - a2) * cosine * cosine);
}

// The same of a lobe that is stretched along x (Heitz 2014): the root of Smith's masking, not divided by the cosine.
inline Float stretched_root(vec3 w, Float along, Float across) {
    vec3 scaled = vec3(w.x * along, w.y * across, w.z);
    return sqrt(dot(scaled, scaled));
}

inline Float lobe_root(Bsdf bsdf, vec3 w) {
    Float root = smith_root(abs(w.z), bsdf.alpha);
    if (has_feature(FEATURE_ANISOTROPY)) {
        root = select(bsdf.along > bsdf.alpha, stretched_root(w, bsdf.along, bsdf.alpha), root);
    }
    return root;
}

inline vec2 unpack_energy(Float corner) {
    Uint bits = floatBitsToUint(corner);
    return vec2(Float(bits & ENERGY_MASK), Float(bits >> ENERGY_SHIFT)) * 1.52590219e-5f;
}

// Of a white surface's light, from the table: x comes back after one scattering, y is what Schlick's weight would let
// reflection give back of it.
inline vec2 lobe_energy(Uint first_row, Float cosine, Float roughness) {
    Float x = sqrt(saturate(cosine)) * float(ENERGY_CELLS);
    Float y = saturate(roughness) * float(ENERGY_CELLS);
    Float column = min(floor(x), float(ENERGY_CELLS - 1u));
    Float line = min(floor(y), float(ENERGY_CELLS - 1u));
    vec4 corners = fetch_lobe_energy(first_row + Uint(line) * ENERGY_CELLS + Uint(column));
    vec2 smoother = blend(unpack_energy(corners.x), unpack_energy(corners.y), x - column);
    vec2 rougher = blend(unpack_energy(corners.z), unpack_energy(corners.w), x - column);
    return blend(smoother, rougher, y - line);
}

// The same of reflection that is stretched, by its strength and by how rough it is to wo between x and y.
inline vec2 stretched_energy(Bsdf bsdf, Uint first_row, Float roughness, Float strength) {
    Float cosine_squared = square(bsdf.wo.x) / max(square(bsdf.wo.x) + square(bsdf.wo.y), SMALLEST);
    Float alpha = sqrt(blend(square(bsdf.alpha), square(bsdf.along), cosine_squared));
    Float least = sqrt(max(bsdf.alpha, 0.0f));
    Float turn =
        saturate((sqrt(alpha) - least) / max(sqrt(max(bsdf.along, 0.0f)) - least, 1.0e-6f)) * float(ENERGY_TURNS);
    Float step = saturate(strength) * float(ENERGY_STRENGTHS);
    Float column = min(floor(turn), float(ENERGY_TURNS - 1u));
    Float line = min(floor(step), float(ENERGY_STRENGTHS - 1u));
    Uint weak = first_row + (Uint(line) * (ENERGY_TURNS + 1u) + Uint(column)) * ENERGY_ROWS;
    Uint strong = weak + (ENERGY_TURNS + 1u) * ENERGY_ROWS;
    vec2 weaker = blend(lobe_energy(weak, bsdf.wo.z, roughness), lobe_energy(weak + ENERGY_ROWS, bsdf.wo.z, roughness),
                        turn - column);
    vec2 stronger = blend(lobe_energy(strong, bsdf.wo.z, roughness),
                          lobe_energy(strong + ENERGY_ROWS, bsdf.wo.z, roughness), turn - column);
    return blend(weaker, stronger, step - line);
}

// Fresnel term of an interface, averaged over the hemisphere; the fit of Kulla and Conty 2017.
inline Float mean_fresnel(Float eta) {
    Float from_outside = (eta - 1.0f) / (4.08567f + 1.00071f * eta);
    Float from_inside = 0.997118f + eta * (0.1014f + eta * (-0.965241f - 0.130607f * eta));
    return saturate(select(eta < 1.0f, from_inside, from_outside));
}

// Leaves that share of the samples to what is there already.
inline Bsdf with_picks_scaled(Bsdf below, Float share) {
    Bsdf bsdf = below;
    bsdf.pick_diffuse = bsdf.pick_diffuse * share;
    bsdf.pick_glossy = bsdf.pick_glossy * share;
    bsdf.pick_reflected = bsdf.pick_reflected * share;
    bsdf.pick_transmitted = bsdf.pick_transmitted * share;
    bsdf.pick_sheen = bsdf.pick_sheen * share;
    return bsdf;
}

// Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF": the logarithm of the fitted shadowing.
inline Float sheen_shadow_fit(Float x, Float alpha) {
    Float t = square(1.0f - alpha);
    Float a = blend(Float(21.5473f), Float(25.3245f), t);
    Float b = blend(Float(3.82987f), Float(3.32435f), t);
    Float c = blend(Float(0.19823f), Float(0.16801f), t);
    Float d = blend(Float(-1.97760f), Float(-1.27393f), t);
    Float e = blend(Float(-4.32054f), Float(-4.85967f), t);
    return a / (1.0f + b * power(x, c)) + d * x + e;
}

inline Float sheen_shadow(Float cosine, Float roughness) {
    Float alpha = square(roughness);
    Mask low = cosine < 0.5f;
    Float fitted = sheen_shadow_fit(select(low, cosine, 1.0f - cosine), alpha);
    Float exponent = select(low, fitted, 2.0f * sheen_shadow_fit(Float(0.5f), alpha) - fitted);
    return exp_2(exponent * 1.44269504f);
}

// What white sheen returns of the light from that direction, and what that is scaled by. Both change most where light
// grazes: cosines up to a sixteenth have a slice of their own. Lines are even steps of the root of roughness.
inline vec2 sheen_energy(Bsdf bsdf, Float cosine) {
    Mask grazes = cosine < 0.0625f;
    Uint row = bsdf.sheen_row + select(grazes, Uint(ENERGY_ROWS), Uint(0u));
    Float line = (sqrt(bsdf.sheen_roughness) - 0.26457513f) * 1.3597583f;
    return lobe_energy(row, select(grazes, cosine * 16.0f, cosine), line);
}

// Sets what concerns sheen, which lies above everything else and takes its share of the light (KHR_materials_sheen,
// albedo scaling) and of the samples.
inline Bsdf with_sheen(Bsdf below, Material material) {
    Bsdf bsdf = below;
    bsdf.sheen_strength = max_component(material.sheen_color);
    bsdf.sheen_roughness = max(material.sheen_roughness, SMOOTHEST_SHEEN);
    bsdf.sheen_row = material.sheen_row;
    bsdf.sheen_color = material.sheen_color;
    bsdf.sheen_shadow = 0.0f;
    bsdf.under_sheen = 1.0f;
    bsdf.pick_sheen = 0.0f;
    if (any_lane(bsdf.sheen_strength > 0.0f)) {
        vec2 energy = sheen_energy(bsdf, bsdf.wo.z);
        bsdf.sheen_color = material.sheen_color * energy.y;
        bsdf.sheen_shadow = sheen_shadow(bsdf.wo.z, bsdf.sheen_roughness);
        Float returned = bsdf.sheen_strength * energy.x;
        bsdf.under_sheen = 1.0f - returned;
        bsdf.albedo = returned + bsdf.under_sheen * bsdf.albedo;
        Float share = returned / max(bsdf.albedo, SMALLEST);
        bsdf = with_picks_scaled(bsdf, 1.0f - share);
        bsdf.pick_sheen = share;
    }
    return bsdf;
}

// Adds a coat (KHR_materials_clearcoat): a dielectric of index 1.5 above everything else, by GGX along a normal of its
// own. What one scattering off it does not return goes to the rest. At least this rough it needs no delta lobe.
inline Bsdf with_coat(Bsdf below, Material material, vec3 normal) {
    Bsdf bsdf = below;
    // Light inside a solid does not see its coat.
    bsdf.coat = select(bsdf.eta < 1.0f, Float(0.0f), material.coat);
    bsdf.coat_frame = frame_around(normal);
    vec3 wo = to_local(bsdf.coat_frame, bsdf.wo);
    bsdf.coat_wo = vec3(wo.x, wo.y, max(wo.z, 1.0e-6f));
    bsdf.coat_alpha = max(square(material.coat_roughness), 2.0e-3f);
    bsdf.coat_root_o = smith_root(bsdf.coat_wo.z, bsdf.coat_alpha);
    vec2 energy = lobe_energy(Uint(0u), bsdf.coat_wo.z, material.coat_roughness);
    Float returned = bsdf.coat * (COAT_F0 * (energy.x - energy.y) + energy.y);
    bsdf.under_coat = 1.0f - returned;
    bsdf.albedo = returned + bsdf.under_coat * bsdf.albedo;
    Float share = returned / max(bsdf.albedo, SMALLEST);
    bsdf = with_picks_scaled(bsdf, 1.0f - share);
    bsdf.pick_coat = share;
    return bsdf;
}

// The cosine of so many turns.
inline Float wave(Float turns) { return cos_sin_turns(turns - floor(turns)).x; }

// What a film reflects of red, green and blue by interference, over a path of so many nanometres: the eye's sensitivity
// to wavelengths as Gaussians, Fourier transformed (Belcour and Barla 2017, "A Practical Extension to Microfacet Theory
// for the Modeling of Varying Iridescence", with the constants of KHR_materials_iridescence).
inline vec3 film_waves(Float path) {
    Float squared = path * path;
    Float x = 0.846590002f * wave(1.6810e-3f * path) * exp_2(max(-2.46491222e-7f * squared, -126.0f)) +
              0.153868307f * wave(2.2399e-3f * path) * exp_2(max(-2.57905068e-7f * squared, -126.0f));
    Float y = 1.00022189f * wave(1.7953e-3f * path) * exp_2(max(-5.29946445e-7f * squared, -126.0f));
    Float z = 1.00112249f * wave(2.2084e-3f * path) * exp_2(max(-3.76594253e-7f * squared, -126.0f));
    return vec3(3.2404542f * x - 1.5371385f * y - 0.4985314f * z, 1.8760108f * y - 0.9692660f * x + 0.0415560f * z,
                0.0556434f * x - 0.2040259f * y + 1.0572252f * z);
}

// One channel of what film and base reflect together; `first` and `second` are of the light that crossed the film once
// and twice. The wave turns round where it meets the higher index.
inline Float film_channel(Float f0, Float film_ior, Float outer, Float inner_weight, Float first, Float second) {
    Float root = sqrt(min(f0, 0.9999f));
    Float base_ior = (1.0f + root) / (1.0f - root);
    Float inner = blend(square((base_ior - film_ior) / (base_ior + film_ior)), Float(1.0f), inner_weight);
    Float both = clamp(outer * inner, 1.0e-5f, 0.9999f);
    Float through = 1.0f - outer;
    Float once = through * through * inner / (1.0f - both);
    Float returned = sqrt(both);
    Float turned = select(base_ior < film_ior, first, -first);
    return outer + once + 2.0f * (once - through) * returned * (turned + returned * second);
}

// The reflectance at normal incidence by which Schlick's term gives what the film gives in direction wo.
inline vec3 film_f0(vec3 f0, Material material, Float cosine) {
    Float t = saturate(material.film_thickness * 33.3333333f);
    Float film_ior = blend(Float(1.0f), material.film_ior, t * t * (3.0f - 2.0f * t));
    Float inner_cosine = sqrt(max(1.0f - (1.0f - cosine * cosine) / (film_ior * film_ior), 0.0f));
    Float weight = schlick_weight(cosine);
    Float inner_weight = schlick_weight(inner_cosine);
    Float outer = blend(square((film_ior - 1.0f) / (film_ior + 1.0f)), Float(1.0f), weight);
    Float path = 2.0f * film_ior * material.film_thickness * inner_cosine;
    vec3 first = film_waves(path);
    vec3 second = film_waves(2.0f * path);
    vec3 reflected = vec3(film_channel(f0.x, film_ior, outer, inner_weight, first.x, second.x),
                          film_channel(f0.y, film_ior, outer, inner_weight, first.y, second.y),
                          film_channel(f0.z, film_ior, outer, inner_weight, first.z, second.z));
    Float grazing = min(weight, 0.9999f);
    vec3 normal = (reflected - vec3(grazing)) * (1.0f / (1.0f - grazing));
    return blend(f0, vec3(saturate(normal.x), saturate(normal.y), saturate(normal.z)), material.film);
}

inline Bsdf make_bsdf(Material material, vec3 wo, vec3 side, Mask front) {
    Mask thin = (material.flags & MATERIAL_THIN_WALLED) != 0u;
    Float f0 = square((material.ior - 1.0f) / (material.ior + 1.0f));
    vec3 dielectric_f0 = min(material.specular_color * f0, vec3(1.0f)) * material.specular;
    vec3 metal_f0 = material.base_color;
    if (has_feature(FEATURE_FILM)) {
        metal_f0 = film_f0(metal_f0, material, wo.z);
        vec3 filmed = film_f0(dielectric_f0, material, wo.z);
        // What a solid's interface shares out stands in a table: a film changes its colour alone.
        Float strength = max_component(dielectric_f0) / max(max_component(filmed), SMALLEST);
        dielectric_f0 = select(!thin && material.transmission > 0.0f, filmed * strength, filmed);
    }
    Float body = 1.0f - material.metallic;
    Bsdf bsdf;
    bsdf.wo = wo;
    bsdf.side = side;
    bsdf.refracts = !thin && material.transmission > 0.0f;
    bsdf.eta = 1.0f;
    if (has_feature(FEATURE_TRANSMISSION)) {
        bsdf.eta = select(bsdf.refracts, select(front, material.ior, 1.0f / material.ior), Float(1.0f));
    }
    // Light inside a solid is reflected in full past the critical angle, whatever the strength of its reflection.
    Float dielectric_f90 = select(bsdf.eta < 1.0f, Float(1.0f), material.specular);
    bsdf.f0 = blend(dielectric_f0, metal_f0, material.metallic);
    bsdf.f90 = blend(dielectric_f90, Float(1.0f), material.metallic);
    bsdf.dielectric_f0 = max_component(dielectric_f0);
    bsdf.dielectric_f90 = dielectric_f90;
    // From within, a solid has no body that scatters: what its interface lets pass goes out.
    Float clear = body * select(bsdf.eta < 1.0f, Float(1.0f), material.transmission);
    Float opaque = body - clear;
    bsdf.transmission_color = material.base_color * clear;
    bsdf.alpha = square(material.roughness);
    bsdf.along = bsdf.alpha;
    Float strength = 0.0f;
    if (has_feature(FEATURE_ANISOTROPY)) {
        strength = material.anisotropy;
        bsdf.along = blend(bsdf.alpha, Float(1.0f), square(strength));
        bsdf.alpha = select(strength > 0.0f, min(max(bsdf.alpha, SMOOTH_ALPHA), bsdf.along), bsdf.alpha);
    }
    bsdf.is_smooth = bsdf.along < SMOOTH_ALPHA;
    bsdf.root_o = lobe_root(bsdf, wo);
    // What one scattering returns of a white surface's light, and Schlick's weight for it on average.
    vec2 energy = lobe_energy(Uint(0u), wo.z, material.roughness);
    if (has_feature(FEATURE_ANISOTROPY)) {
        if (any_lane(strength > 0.0f)) {
            vec2 stretched = stretched_energy(bsdf, material.stretched_row, material.roughness, strength);
            energy = select(strength > 0.0f, stretched, energy);
        }
    }
    vec2 inside = energy;
    if (has_feature(FEATURE_TRANSMISSION)) {
        Uint energy_row = material.energy_row + select(front, Uint(0u), Uint(ENERGY_ROWS));
        inside = select(bsdf.refracts, lobe_energy(energy_row, wo.z, material.roughness), energy);
        if (has_feature(FEATURE_ANISOTROPY)) {
            Mask stretched = bsdf.refracts && strength > 0.0f;
            if (any_lane(stretched)) {
                // Of the material's energies: both sides round, then each stretched.
                Uint sides = select(front, Uint(2u * ENERGY_ROWS), Uint(2u * ENERGY_ROWS + STRETCHED_ROWS));
                Uint first_row = select(stretched, material.energy_row + sides, material.stretched_row);
                vec2 through = stretched_energy(bsdf, first_row, material.roughness, strength);
                inside = select(stretched, through, inside);
            }
        }
    }
    Float returned = select(bsdf.is_smooth, Float(1.0f), energy.x);
    Float weight = select(bsdf.is_smooth, fresnel_weight(bsdf, wo.z), min(inside.y / max(returned, SMALLEST), 1.0f));
    // Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks": what one scattering does not return
    // leaves like diffuse light, coloured once more; at an interface their mean Fresnel term shares it out.
    Float kept = 1.0f - returned;
    Float kept_inside = select(bsdf.is_smooth, Float(0.0f), 1.0f - inside.x);
    vec3 dielectric_again = dielectric_f0 * dielectric_f0 * (opaque * kept);
    bsdf.again_reflected = metal_f0 * metal_f0 * (material.metallic * kept) + dielectric_again;
    // A white body gives back all that the interface does not. Schlick's weight is 1/21 in the hemisphere's mean.
    Float entering = 1.0f - dielectric_reflectance(bsdf, weight);
    Float below = 1.0f - dielectric_reflectance(bsdf, weight) * returned - square(bsdf.dielectric_f0) * kept;
    Float mean_leaving = 1.0f - dielectric_reflectance(bsdf, Float(0.0476190476f));
    bsdf.diffuse_color = material.base_color * (opaque * max(below, 0.0f) / max(mean_leaving, SMALLEST));
    Float diffuse = max_component(material.base_color) * opaque * entering;
    Float passed = max_component(bsdf.transmission_color);
    Float glossy = max_component(reflectance(bsdf, weight)) + passed * entering;
    Float scale = 1.0f / max(diffuse + glossy, SMALLEST);
    bsdf.albedo = diffuse + glossy;
    bsdf.pick_diffuse = diffuse * scale;
    bsdf.pick_glossy = glossy * scale;
    bsdf.passing = passed / max(passed + material.metallic, SMALLEST);
    bsdf.again_transmitted = vec3(0.0f);
    bsdf.pick_reflected = bsdf.pick_glossy * kept;
    bsdf.pick_transmitted = 0.0f;
    if (any_lane(clear > 0.0f)) {
        Float turned_back = mean_fresnel(select(bsdf.refracts, bsdf.eta, material.ior));
        Float going_through = kept_inside * (1.0f - turned_back);
        bsdf.again_reflected = bsdf.again_reflected + vec3(clear * kept_inside * turned_back);
        bsdf.again_transmitted = bsdf.transmission_color * going_through;
        bsdf.pick_reflected = bsdf.pick_glossy * blend(kept, kept_inside * turned_back, bsdf.passing);
        bsdf.pick_transmitted = bsdf.pick_glossy * bsdf.passing * going_through;
    }
    bsdf.pick_sheen = 0.0f;
    if (has_feature(FEATURE_SHEEN)) {
        bsdf = with_sheen(bsdf, material);
    }
    return bsdf;
}

// Of what meets a microfacet, the share that sampling reflects; `weight` is the microfacet's own.
inline Float reflected_share(Bsdf bsdf, Float weight) {
    return 1.0f - bsdf.passing * (1.0f - dielectric_reflectance(bsdf, weight));
}

// The mirror image behind the plane of the geometric normal.
inline vec3 mirrored(vec3 w, vec3 side) { return w - side * (2.0f * dot(side, w)); }

// GGX, Walter et al. 2007, in a form without cancellation near the normal.
inline Float ggx_density(vec3 h, Float alpha) {
    Float a2 = alpha * alpha;
    Float d = (h.x * h.x + h.y * h.y) + a2 * h.z * h.z;
    return a2 / (PI * max(d * d, SMALLEST));
}

// The same, stretched along x: Burley 2012, "Physically-Based Shading at Disney", and KHR_materials_anisotropy.
inline Float stretched_density(vec3 h, Float along, Float across) {
    Float both = along * across;
    vec3 scaled = vec3(h.x * across, h.y * along, h.z * both);
    Float d = dot(scaled, scaled);
    return both * both * both / (PI * max(d * d, SMALLEST));
}

inline Float lobe_density(Bsdf bsdf, vec3 h) {
    Float density = ggx_density(h, bsdf.alpha);
    if (has_feature(FEATURE_ANISOTROPY)) {
        density = select(bsdf.along > bsdf.alpha, stretched_density(h, bsdf.along, bsdf.alpha), density);
    }
    return density;
}

// Visible normals: Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
inline vec3 sample_visible_normal(vec3 wo, Float along, Float across, vec2 u) {
    vec3 stretched = normalized(vec3(wo.x * along, wo.y * across, wo.z));
    Float z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    Float sine = sqrt(saturate(1.0f - z * z));
    vec2 around = cos_sin_turns(u.x);
    vec3 h = vec3(sine * around.x, sine * around.y, z) + stretched;
    return normalized(vec3(h.x * along, h.y * across, h.z));
}

// Lambert under the dielectric interface, which light crosses on its way in and out: with glTF's single factor at
// the half vector, a white surface would reflect more than it receives at grazing angles. Directions that a bent
// shading normal puts below the surface are folded back at its plane, so that no energy is lost; the density folds
// alike. So does what microfacets scatter more than once, which leaves on both sides.
inline BsdfValue evaluate_diffuse(Bsdf bsdf, vec3 wi) {
    Float folded = mirrored(wi, bsdf.side).z;
    Float cosine = max(wi.z, 0.0f) + max(folded, 0.0f);
    Float cosine_behind = max(-wi.z, 0.0f) + max(-folded, 0.0f);
    Float along = dot(bsdf.side, wi);
    Float above = select(along > 0.0f, cosine * INVERSE_PI, Float(0.0f));
    Float below = select(along < 0.0f, cosine_behind * INVERSE_PI, Float(0.0f));
    Float leaving = 1.0f - dielectric_reflectance(bsdf, fresnel_weight(bsdf, max(wi.z, folded)));
    BsdfValue result;
    result.value = (bsdf.diffuse_color * leaving + bsdf.again_reflected) * above;
    result.value = result.value + bsdf.again_transmitted * below;
    result.pdf = (bsdf.pick_diffuse + bsdf.pick_reflected) * above + bsdf.pick_transmitted * below;
    return result;
}

// Torrance-Sparrow reflection with GGX and height-correlated Smith masking (Heitz 2014); a thin wall transmits the
// same lobe, mirrored at the surface.
inline BsdfValue evaluate_reflection(Bsdf bsdf, vec3 wi, vec3 h, Float weight, Mask passes) {
    Float cosine = abs(wi.z);
    Float root_i = lobe_root(bsdf, wi);
    Float density = lobe_density(bsdf, h);
    Float visible = 0.5f / max(bsdf.wo.z * root_i + cosine * bsdf.root_o, SMALLEST);
    Float share = reflected_share(bsdf, weight);
    Float lobe = density * visible * cosine;
    vec3 color = select(passes, bsdf.transmission_color * (1.0f - dielectric_reflectance(bsdf, weight)),
                        reflectance(bsdf, weight));
    BsdfValue result;
    result.value = color * lobe;
    result.pdf = bsdf.pick_glossy * select(passes, 1.0f - share, share) * lobe;
    return result;
}

// Refraction into or out of a solid: Walter et al. 2007, equations 17 and 21, with visible normals.
inline BsdfValue evaluate_refraction(Bsdf bsdf, vec3 wi, vec3 h, Float weight) {
    Float wo_h = dot(bsdf.wo, h);
    Float wi_h = dot(wi, h);
    Float cosine = abs(wi.z);
    Float masking_o = 2.0f * bsdf.wo.z / max(bsdf.wo.z + bsdf.root_o, SMALLEST);
    Float masking_i = 2.0f * cosine / max(cosine + lobe_root(bsdf, wi), SMALLEST);
    Float denominator = wo_h + bsdf.eta * wi_h;
    Float jacobian = bsdf.eta * bsdf.eta * abs(wi_h) / max(denominator * denominator, SMALLEST);
    Float visible_density = masking_o * lobe_density(bsdf, h) * max(wo_h, 0.0f) / max(bsdf.wo.z, SMALLEST);
    Mask crosses = wo_h > 0.0f && wi_h < 0.0f;
    Float lobe = select(crosses, visible_density * jacobian * masking_i, Float(0.0f));
    BsdfValue result;
    result.value = bsdf.transmission_color * ((1.0f - dielectric_reflectance(bsdf, weight)) * lobe);
    result.pdf = bsdf.pick_glossy * (1.0f - reflected_share(bsdf, weight)) * lobe;
    return result;
}

// Of the light between wo and wi, what sheen lets through to the rest.
inline Float share_under_sheen(Bsdf bsdf, vec3 wi) {
    Float returned = sheen_energy(bsdf, abs(wi.z)).x;
    return min(bsdf.under_sheen, 1.0f - bsdf.sheen_strength * returned);
}

// Charlie's inverted Gaussian (Estevez and Kulla 2017), sampled evenly: most of it is at grazing angles.
inline BsdfValue evaluate_sheen(Bsdf bsdf, vec3 wi) {
    Mask above = dot(bsdf.side, wi) > 0.0f;
    vec3 h = normalized(bsdf.wo + wi);
    Float inverse_alpha = 1.0f / square(bsdf.sheen_roughness);
    Float sine = sqrt(max(1.0f - h.z * h.z, 0.0f));
    Float density = (2.0f + inverse_alpha) * power(sine, inverse_alpha) * INVERSE_TWO_PI;
    Float shadows = 1.0f + bsdf.sheen_shadow + sheen_shadow(saturate(wi.z), bsdf.sheen_roughness);
    Mask returns = above && wi.z > 0.0f && bsdf.sheen_strength > 0.0f;
    BsdfValue result;
    result.value =
        select(returns, bsdf.sheen_color * (density / (4.0f * max(bsdf.wo.z, GRAZING_SHEEN) * shadows)), vec3(0.0f));
    Float upright = select(wi.z > 0.0f, Float(INVERSE_TWO_PI), Float(0.0f));
    Float folded = select(mirrored(wi, bsdf.side).z > 0.0f, Float(INVERSE_TWO_PI), Float(0.0f));
    result.pdf = select(above, bsdf.pick_sheen * (upright + folded), Float(0.0f));
    return result;
}

inline BsdfValue evaluate_coat(Bsdf bsdf, vec3 wi) {
    vec3 local = to_local(bsdf.coat_frame, wi);
    vec3 h = normalized(bsdf.coat_wo + local);
    Float root_i = smith_root(local.z, bsdf.coat_alpha);
    Float density = ggx_density(h, bsdf.coat_alpha);
    Float visible = 0.5f / max(bsdf.coat_wo.z * root_i + local.z * bsdf.coat_root_o, SMALLEST);
    Float fresnel = COAT_F0 + (1.0f - COAT_F0) * schlick_weight(dot(bsdf.coat_wo, h));
    Mask returns = local.z > 0.0f && dot(bsdf.side, wi) > 0.0f;
    BsdfValue result;
    result.value = vec3(select(returns, bsdf.coat * fresnel * density * visible * local.z, Float(0.0f)));
    Float chosen = bsdf.pick_coat * density * 0.5f / (bsdf.coat_wo.z + bsdf.coat_root_o);
    result.pdf = select(returns, chosen, Float(0.0f));
    return result;
}

inline BsdfValue evaluate_bsdf(Bsdf bsdf, vec3 wi) {
    Mask above = dot(bsdf.side, wi) > 0.0f;
    Mask refracted = bsdf.refracts && !above;
    vec3 bisector = bsdf.wo + vec3(wi.x, wi.y, abs(wi.z));
    vec3 refractor = bsdf.wo + wi * bsdf.eta;
    vec3 h = normalized(select(refracted, select(refractor.z < 0.0f, -refractor, refractor), bisector));
    Float weight = fresnel_weight(bsdf, dot(bsdf.wo, h));
    BsdfValue diffuse = evaluate_diffuse(bsdf, wi);
    BsdfValue glossy = evaluate_reflection(bsdf, wi, h, weight, !above);
    if (has_feature(FEATURE_TRANSMISSION)) {
        BsdfValue refraction = evaluate_refraction(bsdf, wi, h, weight);
        glossy.value = select(refracted, refraction.value, glossy.value);
        glossy.pdf = select(refracted, refraction.pdf, glossy.pdf);
    }
    Mask same_sides = (wi.z > 0.0f) == above;
    Mask has_glossy = same_sides && !bsdf.is_smooth;
    BsdfValue result;
    result.value = diffuse.value + select(has_glossy, glossy.value, vec3(0.0f));
    result.pdf = diffuse.pdf + select(has_glossy, glossy.pdf, Float(0.0f));
    if (has_feature(FEATURE_SHEEN)) {
        BsdfValue sheen = evaluate_sheen(bsdf, wi);
        result.value = result.value * share_under_sheen(bsdf, wi) + sheen.value;
        result.pdf = result.pdf + sheen.pdf;
    }
    if (has_feature(FEATURE_COAT)) {
        BsdfValue coat = evaluate_coat(bsdf, wi);
        result.value = result.value * bsdf.under_coat + coat.value;
        result.pdf = result.pdf + coat.pdf;
    }
    return result;
}

inline vec3 sample_diffuse(Bsdf bsdf, vec2 u) {
    vec2 around = cos_sin_turns(u.y);
    Float sine = sqrt(u.x);
    vec3 wi = vec3(sine * around.x, sine * around.y, sqrt(max(1.0f - u.x, 0.0f)));
    return select(dot(bsdf.side, wi) < 0.0f, mirrored(wi, bsdf.side), wi);
}

inline vec3 sample_sheen(Bsdf bsdf, vec2 u) {
    vec2 around = cos_sin_turns(u.y);
    Float sine = sqrt(max(1.0f - u.x * u.x, 0.0f));
    vec3 wi = vec3(sine * around.x, sine * around.y, u.x);
    return select(dot(bsdf.side, wi) < 0.0f, mirrored(wi, bsdf.side), wi);
}

inline vec3 sample_coat(Bsdf bsdf, vec2 u) {
    vec3 h = sample_visible_normal(bsdf.coat_wo, bsdf.coat_alpha, bsdf.coat_alpha, u);
    return to_world(bsdf.coat_frame, h * (2.0f * dot(bsdf.coat_wo, h)) - bsdf.coat_wo);
}

// The share of visible microfacets' light in direction wi that no other microfacet keeps; 0 past the horizon.
inline Float unmasked_share(Bsdf bsdf, vec3 wi, Mask reflects) {
    Float cosine = abs(wi.z);
    Float root_i = lobe_root(bsdf, wi);
    Float share = cosine * (bsdf.wo.z + bsdf.root_o) / max(bsdf.wo.z * root_i + cosine * bsdf.root_o, SMALLEST);
    if (has_feature(FEATURE_TRANSMISSION)) {
        Float separate = 2.0f * cosine / max(cosine + root_i, SMALLEST);
        share = select(bsdf.refracts && !reflects, separate, share);
    }
    return select((wi.z > 0.0f) == reflects, share, Float(0.0f));
}

// Two more numbers from two, for what is seldom asked for.
inline vec2 numbers_from(vec2 u) {
    Uint x = hash_bits(floatBitsToUint(u.x));
    Uint y = hash_bits(x ^ floatBitsToUint(u.y));
    return vec2(unit_float(hash_bits(y ^ 0x5851f42du)), unit_float(hash_bits(y ^ 0x14057b7eu)));
}

// Chooses a lobe by `lobe`, then a direction by `u`. A microfacet's light that another one keeps goes on as light that
// is scattered more than once: each rough lobe is sampled by its value.
inline BsdfSample sample_bsdf(Bsdf bsdf, vec2 u, Float lobe) {
    Mask diffuses = lobe >= bsdf.pick_glossy;
    vec3 h = vec3(0.0f, 0.0f, 1.0f);
    if (any_lane(!diffuses && !bsdf.is_smooth)) {
        h = select(bsdf.is_smooth, h, sample_visible_normal(bsdf.wo, bsdf.along, bsdf.alpha, u));
    }
    Float wo_h = dot(bsdf.wo, h);
    Float weight = fresnel_weight(bsdf, wo_h);
    Float share = reflected_share(bsdf, weight);
    Float reflecting = bsdf.pick_glossy * share;
    Mask reflects = lobe < reflecting;
    vec3 reflected = h * (2.0f * wo_h) - bsdf.wo;
    vec3 passed = vec3(reflected.x, reflected.y, -reflected.z);
    Float sine_squared = 0.0f;
    if (has_feature(FEATURE_TRANSMISSION)) {
        sine_squared = transmitted_sine_squared(bsdf, wo_h);
        vec3 refracted = h * (wo_h / bsdf.eta - sqrt(max(1.0f - sine_squared, 0.0f))) - bsdf.wo * (1.0f / bsdf.eta);
        passed = select(bsdf.refracts, refracted, passed);
    }
    vec3 wi = select(reflects, reflected, passed);
    // A delta lobe goes where the geometry lets it.
    Mask wrong_side = (dot(bsdf.side, wi) > 0.0f) != reflects;
    wi = select(bsdf.is_smooth && wrong_side, mirrored(wi, bsdf.side), wi);
    // Where in its interval `lobe` lies is one more random number, and decides what is kept.
    Float low = select(reflects, Float(0.0f), reflecting);
    Float high = select(reflects, reflecting, bsdf.pick_glossy);
    Float unmasked = (high - low) * unmasked_share(bsdf, wi, reflects);
    Mask again = !diffuses && !bsdf.is_smooth && lobe - low >= unmasked;
    wi = select(diffuses, sample_diffuse(bsdf, u), wi);
    if (has_feature(FEATURE_SHEEN)) {
        Mask by_sheen = bsdf.pick_sheen > 0.0f && lobe >= bsdf.pick_glossy + bsdf.pick_diffuse;
        wi = select(by_sheen, sample_sheen(bsdf, u), wi);
    }
    Mask coated_out = false;
    if (has_feature(FEATURE_COAT)) {
        Mask by_coat = bsdf.pick_coat > 0.0f && lobe >= bsdf.pick_glossy + bsdf.pick_diffuse + bsdf.pick_sheen;
        wi = select(by_coat, sample_coat(bsdf, u), wi);
        coated_out = by_coat && (dot(bsdf.coat_frame.normal, wi) <= 0.0f || dot(bsdf.side, wi) <= 0.0f);
    }
    if (any_lane(again)) {
        vec3 scattered = sample_diffuse(bsdf, numbers_from(u));
        Float kept = ((lobe - low) - unmasked) / max((high - low) - unmasked, SMALLEST);
        Mask behind = kept * (bsdf.pick_reflected + bsdf.pick_transmitted) < bsdf.pick_transmitted;
        wi = select(again, select(behind, -scattered, scattered), wi);
    }
    wi = normalized(wi);
    BsdfValue rough = evaluate_bsdf(bsdf, wi);
    Mask by_microfacet = !diffuses && !again;
    Mask is_delta = bsdf.is_smooth && !diffuses;
    BsdfSample result;
    result.wi = wi;
    result.weight = rough.value * (1.0f / max(rough.pdf, SMALLEST));
    result.pdf = rough.pdf;
    if (any_lane(is_delta)) {
        vec3 color = select(reflects, reflectance(bsdf, weight),
                            bsdf.transmission_color * (1.0f - dielectric_reflectance(bsdf, weight)));
        if (has_feature(FEATURE_SHEEN)) {
            color = color * share_under_sheen(bsdf, wi);
        }
        if (has_feature(FEATURE_COAT)) {
            color = color * bsdf.under_coat;
        }
        Float picked = bsdf.pick_glossy * select(reflects, share, 1.0f - share);
        result.weight = select(is_delta, color * (1.0f / max(picked, SMALLEST)), result.weight);
        result.pdf = select(is_delta, Float(0.0f), result.pdf);
    }
    Mask total_reflection = by_microfacet && !reflects && bsdf.refracts && sine_squared >= 1.0f;
    Mask seen = (wi.z > 0.0f) == reflects && (dot(bsdf.side, wi) > 0.0f) == reflects;
    Mask through_horizon = by_microfacet && !seen;
    result.valid = is_delta || (rough.pdf > 0.0f && !through_horizon);
    result.valid = result.valid && !total_reflection && !coated_out;
    return result;
}

}  // namespace target_core::kernels
