// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/filter.glsl.
#pragma once

#include "target_core/kernels/path_state.h"

namespace target_core::kernels {

// An edge-avoiding a-trous wavelet filter (Dammertz et al. 2010) of light without albedo and emission, guided by its
// variance (Schied et al. 2017, SVGF). Weights are compact polynomials where those papers have exponentials.

// What its sample's camera ray brought straight from a light or the sky: all that the path has so far.
inline void gather_emission(Uint job) {
    vec3 emission = vec3(load_path_radiance(rows_from(job)));
    add_to_guide(job + pass.first_pixel, Uint(GUIDE_EMISSION), vec4(emission, 0.0f), true);
}

inline void store_light(uint plane, Pixels pixels, vec3 light, Float variance) {
    store_plane(plane, pixels, light.x);
    store_plane(plane + 1u, pixels, light.y);
    store_plane(plane + 2u, pixels, light.z);
    store_plane(plane + 3u, pixels, variance);
}

inline vec4 load_light(uint plane, Pixels pixels) {
    return vec4(load_plane(plane, pixels), load_plane(plane + 1u, pixels), load_plane(plane + 2u, pixels),
                load_plane(plane + 3u, pixels));
}

// Light from the picture, by the albedo of its own samples: rays that met nothing have none, so that light beside the
// sky is that of the surface. Light that is not known is that of like pixels around.
inline void divide_by_albedo(Uint job) {
    Uint pixel = job + pass.first_pixel;
    Float scale = pass.sample_scale;
    vec4 mean = load_filter_picture(pixel);
    vec3 emission = vec3(load_guide(pixel, Uint(GUIDE_EMISSION))) * scale;
    vec4 first = load_guide(pixel, Uint(GUIDE_ALBEDO));
    vec4 others = load_guide(pixel, Uint(GUIDE_LAYER + GUIDE_ALBEDO));
    vec3 albedo = (vec3(first) + vec3(others)) * scale;
    Float of_first = load_guide(pixel, Uint(GUIDE_NORMAL)).w;
    Float of_others = load_guide(pixel, Uint(GUIDE_LAYER + GUIDE_NORMAL)).w;
    Mask empty = of_first == 0.0f;
    Mask unknown = mean.w >= NO_MEAN;
    vec3 scattered = select(empty, vec3(0.0f), vec3(mean) - emission);
    albedo = select(empty, vec3(1.0f), albedo);
    vec3 light = vec3(scattered.x / albedo.x, scattered.y / albedo.y, scattered.z / albedo.z);
    Float shade = 1.0f / luminance(albedo);
    Pixels here = pixels_from(pixel);
    Float variance = select(unknown, Float(-1.0f), mean.w * shade * shade);
    light = select(unknown, vec3(0.0f), light);
    store_light(PLANE_LIGHT, here, light, select(empty, Float(0.0f), variance));
    Float mixed = min(of_first, of_others) / max(of_first + of_others, 1.0f);
    store_plane(PLANE_TRUST, here, select(unknown, Float(0.0f), 1.0f - 2.0f * mixed));
    store_plane(PLANE_LAYER, here, select(of_others > of_first, Float(float(GUIDE_LAYER)), Float(0.0f)));
}

inline void prepare_filter(Uint job) {
    Uint pixel = job + pass.first_pixel;
    Pixels here = pixels_from(pixel);
    Uint layer = Uint(load_plane(PLANE_LAYER, here));
    vec4 normal = load_guide(pixel, layer + GUIDE_NORMAL);
    Float share = 1.0f / max(normal.w, 1.0f);
    vec3 mean = normalized(vec3(normal));
    store_plane(PLANE_NORMAL, here, mean.x);
    store_plane(PLANE_NORMAL + 1u, here, mean.y);
    store_plane(PLANE_NORMAL + 2u, here, mean.z);
    store_plane(PLANE_NEARNESS, here, load_guide(pixel, layer + GUIDE_ALBEDO).w * share);
}

// A pixel that a filter stands on.
struct Place {
    Uint pixel;
    Int row;
    Int column;
};

inline Place place_of(Uint pixel) {
    Place place;
    place.pixel = pixel;
    Uint row = pixel / settings.width;
    place.row = Int(row);
    place.column = Int(pixel - row * settings.width);
    return place;
}

// Whether the picture goes on so far from a place.
inline Mask is_inside(Place place, int right, int down) {
    Int column = place.column + right;
    Int row = place.row + down;
    return column >= 0 && column < Int(settings.width) && row >= 0 && row < Int(settings.height);
}

// A pixel so far off; past the first or the last one, that one.
inline Pixels pixels_at(Place place, int right, int down) {
    Int pixel = Int(place.pixel) + (down * int(settings.width) + right);
    return pixels_from(Uint(clamp(pixel, 0, int(settings.pixel_count) - 1)));
}

// What the middle of a filter is like, for others to be held against.
struct Middle {
    vec3 normal;
    Float nearness;
    Float slope_right;
    Float slope_down;
};

inline vec3 load_normal(Pixels pixels) {
    return vec3(load_plane(PLANE_NORMAL, pixels), load_plane(PLANE_NORMAL + 1u, pixels),
                load_plane(PLANE_NORMAL + 2u, pixels));
}

inline Middle load_middle(Pixels here) {
    Middle middle;
    middle.normal = load_normal(here);
    middle.nearness = load_plane(PLANE_NEARNESS, here);
    middle.slope_right = load_plane(PLANE_SLOPE, here);
    middle.slope_down = load_plane(PLANE_SLOPE + 1u, here);
    return middle;
}

// How far geometry tells a pixel from the middle: 0 for the same surface, 1 and more for another one.
inline Float difference_of(Middle middle, Pixels other, int right, int down) {
    vec3 bend = load_normal(other) - middle.normal;
    Float step_right = middle.slope_right * float(right);
    Float step_down = middle.slope_down * float(down);
    Float off = load_plane(PLANE_NEARNESS, other) - (middle.nearness + step_right + step_down);
    Float tolerance = 0.01f * middle.nearness + 0.5f * (abs(step_right) + abs(step_down)) + 1.0e-12f;
    return dot(bend, bend) * 8.0f + off * off / (tolerance * tolerance);
}

inline Float fall_off(Float difference) {
    Float left = max(1.0f - difference, 0.0f);
    return left * left;
}

// The smaller of two steps of nearness to neighbours: across an edge it is large.
inline Float gentle(Float middle, Float before, Float after) {
    Float left = middle - before;
    Float right = after - middle;
    return select(abs(left) < abs(right), left, right);
}

// Slopes of nearness. Variances of a few samples are noise themselves: each becomes the mean of those of like pixels
// around; where it is not known it is judged from their light. Light that is of two layers gives way to that of pixels
// around that have one.
inline void steady_filter(Uint job) {
    Place place = place_of(job + pass.first_pixel);
    Pixels here = pixels_from(place.pixel);
    Middle middle;
    middle.normal = load_normal(here);
    middle.nearness = load_plane(PLANE_NEARNESS, here);
    Float left = load_plane(PLANE_NEARNESS, pixels_at(place, -1, 0));
    Float right = load_plane(PLANE_NEARNESS, pixels_at(place, 1, 0));
    Float up = load_plane(PLANE_NEARNESS, pixels_at(place, 0, -1));
    Float below = load_plane(PLANE_NEARNESS, pixels_at(place, 0, 1));
    middle.slope_right = gentle(middle.nearness, left, right);
    middle.slope_down = gentle(middle.nearness, up, below);
    store_plane(PLANE_SLOPE, here, middle.slope_right);
    store_plane(PLANE_SLOPE + 1u, here, middle.slope_down);
    vec4 light = load_light(pass.filter_from, here);
    Float trust = load_plane(PLANE_TRUST, here);
    Float weights = 1.0e-6f;
    Float variances = 0.0f;
    Float squares = 0.0f;
    vec3 sum = vec3(light) * 1.0e-6f;
    for (int down = -1; down <= 1; ++down) {
        for (int across = -1; across <= 1; ++across) {
            if (across == 0 && down == 0) {
                continue;
            }
            Pixels other = pixels_at(place, across, down);
            Float alike = fall_off(difference_of(middle, other, across, down)) * load_plane(PLANE_TRUST, other);
            Float weight = select(is_inside(place, across, down), alike, Float(0.0f));
            vec4 others = load_light(pass.filter_from, other);
            Float bright = luminance(vec3(others));
            weights = weights + weight;
            variances = variances + weight * others.w;
            sum = sum + vec3(others) * weight;
            squares = squares + weight * bright * bright;
        }
    }
    Float scale = 1.0f / weights;
    vec3 mean = sum * scale;
    Float around = max(squares * scale - square(luminance(mean)), 0.0f);
    Float pooled = (variances + max(light.w, 0.0f)) / (weights + 1.0f);
    Float variance = select(light.w < 0.0f, around, pooled);
    // One sample in a thousand brings a thousand times as much: no more than what is around makes likely.
    Float limit = luminance(mean) + 6.0f * sqrt(around);
    Float shrunk = min(limit / max(luminance(vec3(light)), 1.0e-12f), 1.0f);
    vec3 own = vec3(light) * select(weights < 0.5f, Float(1.0f), shrunk);
    store_light(pass.filter_to, here, blend(mean, own, trust), variance);
    add_to_guide(place.pixel, Uint(GUIDE_EMISSION), vec4(vec3(0.0f), variance), true);
}

// One level: the mean of like pixels `filter_step` apart, by a small kernel.
inline void filter_level(Uint job) {
    Place place = place_of(job + pass.first_pixel);
    Pixels here = pixels_from(place.pixel);
    vec4 light = load_light(pass.filter_from, here);
    Middle middle = load_middle(here);
    vec3 sum = vec3(light);
    Float variances = light.w;
    Float weights = 1.0f;
    int step = int(pass.filter_step);
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            if (x == 0 && y == 0) {
                continue;
            }
            Pixels other = pixels_at(place, x * step, y * step);
            vec4 others = load_light(pass.filter_from, other);
            vec3 off = vec3(others) - vec3(light);
            Float difference = difference_of(middle, other, x * step, y * step) +
                               dot(off, off) / (48.0f * (light.w + others.w) + 1.0e-8f);
            Float kernel = x == 0 || y == 0 ? 0.5f : 0.25f;
            Float weight = select(is_inside(place, x * step, y * step), kernel * fall_off(difference), Float(0.0f));
            sum = sum + vec3(others) * weight;
            variances = variances + weight * weight * others.w;
            weights = weights + weight;
        }
    }
    Float scale = 1.0f / weights;
    store_light(pass.filter_to, here, sum * scale, variances * scale * scale);
}

// The light of a layer that is not its pixel's own: that of pixels around that have it.
inline vec3 borrowed_light(Place place, Uint layer, vec3 own) {
    vec4 normal = load_guide(place.pixel, layer + GUIDE_NORMAL);
    Float share = 1.0f / max(normal.w, 1.0f);
    Float near = load_guide(place.pixel, layer + GUIDE_ALBEDO).w * share;
    vec3 mean = normalized(vec3(normal));
    Float weights = 1.0e-6f;
    vec3 sum = own * 1.0e-6f;
    for (int down = -1; down <= 1; ++down) {
        for (int across = -1; across <= 1; ++across) {
            Pixels other = pixels_at(place, across, down);
            vec3 bend = load_normal(other) - mean;
            Float off = (load_plane(PLANE_NEARNESS, other) - near) / (0.1f * near + 1.0e-12f);
            Float alike = fall_off(dot(bend, bend) + off * off);
            Float weight = select(is_inside(place, across, down), alike, Float(0.0f));
            sum = sum + vec3(load_light(pass.filter_from, other)) * weight;
            weights = weights + weight;
        }
    }
    return sum * (1.0f / weights);
}

// The picture again: each layer's light by its albedo, and emission, by all camera rays.
inline void finish_filter(Uint job) {
    Place place = place_of(job + pass.first_pixel);
    Pixels here = pixels_from(place.pixel);
    Uint layer = Uint(load_plane(PLANE_LAYER, here));
    Uint other = Uint(GUIDE_LAYER) - layer;
    vec3 light = vec3(load_light(pass.filter_from, here));
    vec3 albedo = vec3(load_guide(place.pixel, layer + GUIDE_ALBEDO));
    vec4 emission = load_guide(place.pixel, Uint(GUIDE_EMISSION));
    vec3 radiance = light * albedo + vec3(emission);
    Mask mixed = load_guide(place.pixel, other + GUIDE_NORMAL).w > 0.0f;
    if (any_lane(mixed)) {
        vec3 more = borrowed_light(place, other, light) * vec3(load_guide(place.pixel, other + GUIDE_ALBEDO));
        radiance = radiance + select(mixed, more, vec3(0.0f));
    }
    radiance = radiance * pass.sample_scale;
    // Where that is farther off the mean of the samples than their variance explains, if that is known, it is wrong,
    // not they.
    vec4 mean = load_filter_picture(place.pixel);
    vec3 off = vec3(mean) - radiance;
    Float doubt = max(mean.w, emission.w * square(luminance(albedo) * pass.sample_scale));
    Float kept = max(1.0f - 12.0f * doubt / (dot(off, off) + 1.0e-12f), 0.0f);
    radiance = radiance + off * select(mean.w < 0.0f, Float(0.0f), kept);
    if (settings.frame == 0u) {
        store_filter_picture(place.pixel, vec4(radiance, 1.0f));
    } else {
        store_light(pass.filter_to, here, radiance, Float(0.0f));
    }
}

}  // namespace target_core::kernels
