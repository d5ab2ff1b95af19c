// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/filter.h.
#ifndef FILTER_GLSL
#define FILTER_GLSL

#include "path_state.glsl"

// An edge-avoiding a-trous wavelet filter (Dammertz et al. 2010) of light by albedo, guided by its variance (Schied et
// al. 2017, SVGF). Weights are compact polynomials where those papers have exponentials. Direct light, of which guides
// bring more samples than the picture has, and the rest are filtered apart: the one has edges, the other noise.

// Whether a pixel that has so many camera rays takes one more: if it shows more than one surface, or if its direct
// light is not sure to a tenth. What is nearly black need not be.
Mask wants_ray(Uint pixel, Float rays) {
    vec4 direct = load_guide(pixel, Uint(GUIDE_DIRECT));
    Float first = load_guide(pixel, Uint(GUIDE_NORMAL)).w;
    Float others = load_guide(pixel, Uint(GUIDE_LAYER + GUIDE_NORMAL)).w;
    Float scale = 1.0f / max(rays, 1.0f);
    Float bright = luminance(vec3(direct)) * scale;
    Float variance = (direct.w * scale - bright * bright) / max(rays - 1.0f, 1.0f);
    Mask mixed = others > 0.0f || (first > 0.0f && first < rays);
    return mixed || variance > 0.01f * square(bright + 0.05f);
}

// All pixels take the first rays. One that has gone without one does so from then on: nothing has changed.
void choose_path(Uint job) {
    Uint pixel = job + pass.first_pixel;
    vec4 rays = load_guide(pixel, Uint(GUIDE_RAYS));
    Mask wanted = rays.x < float(pass.filter_step);
    Mask asks = !wanted && rays.y > 0.0f;
    if (any_lane(asks)) {
        wanted = wanted || (asks && wants_ray(pixel, rays.x));
    }
    Float change = select(wanted, Float(1.0f), Float(0.0f)) - rays.y;
    if (any_lane(change != 0.0f)) {
        add_to_guide(pixel, Uint(GUIDE_RAYS), vec4(0.0f, change, 0.0f, 0.0f), true);
    }
    push_extension_ray(job, wanted);
}

void gather_light(Uint job) {
    Uint pixel = job + pass.first_pixel;
    Float taken = load_guide(pixel, Uint(GUIDE_RAYS)).y;
    if (any_lane(taken > 0.0f)) {
        vec3 light = vec3(load_path_radiance(rows_from(job))) * taken;
        light = select(luminance(light) < 1.0e18f, light, vec3(0.0f));  // whose square is finite
        add_to_guide(pixel, Uint(GUIDE_DIRECT), vec4(light, square(luminance(light))), true);
        add_to_guide(pixel, Uint(GUIDE_RAYS), vec4(taken, 0.0f, 0.0f, 0.0f), true);
    }
}

void store_light(uint plane, Pixels pixels, vec3 light, Float variance) {
    store_plane(plane, pixels, light.x);
    store_plane(plane + 1u, pixels, light.y);
    store_plane(plane + 2u, pixels, light.z);
    store_plane(plane + 3u, pixels, variance);
}

vec4 load_light(uint plane, Pixels pixels) {
    return vec4(load_plane(plane, pixels), load_plane(plane + 1u, pixels), load_plane(plane + 2u, pixels),
                load_plane(plane + 3u, pixels));
}

// Indirect light from the picture, by the albedo of its own samples: rays that met nothing have none, so that light
// beside the sky is that of the surface. Light that is not known is that of like pixels around.
void divide_by_albedo(Uint job) {
    Uint pixel = job + pass.first_pixel;
    Float scale = pass.sample_scale;
    vec4 mean = load_filter_picture(pixel);
    vec3 direct = vec3(load_guide(pixel, Uint(GUIDE_DIRECT))) * scale;
    vec4 first = load_guide(pixel, Uint(GUIDE_ALBEDO));
    vec4 others = load_guide(pixel, Uint(GUIDE_LAYER + GUIDE_ALBEDO));
    vec3 albedo = (vec3(first) + vec3(others)) * scale;
    Float of_first = load_guide(pixel, Uint(GUIDE_NORMAL)).w;
    Float of_others = load_guide(pixel, Uint(GUIDE_LAYER + GUIDE_NORMAL)).w;
    Mask empty = of_first == 0.0f;
    Mask unknown = mean.w >= NO_MEAN;
    vec3 scattered = select(empty, vec3(0.0f), vec3(mean) - direct);
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

// What guides say of the layer, and direct light where it is that of all rays.
void prepare_filter(Uint job) {
    Uint pixel = job + pass.first_pixel;
    Pixels here = pixels_from(pixel);
    Uint layer = Uint(load_plane(PLANE_LAYER, here));
    vec4 normal = load_guide(pixel, layer + GUIDE_NORMAL);
    vec4 albedo = load_guide(pixel, layer + GUIDE_ALBEDO);
    Float share = 1.0f / max(normal.w, 1.0f);
    vec3 mean = normalized(vec3(normal));
    store_plane(PLANE_NORMAL, here, mean.x);
    store_plane(PLANE_NORMAL + 1u, here, mean.y);
    store_plane(PLANE_NORMAL + 2u, here, mean.z);
    store_plane(PLANE_NEARNESS, here, albedo.w * share);
    vec4 direct = load_guide(pixel, Uint(GUIDE_DIRECT));
    Float rays = load_guide(pixel, Uint(GUIDE_RAYS)).x;
    Mask of_one = normal.w > 0.0f && normal.w == rays;
    vec3 color = select(of_one, vec3(albedo), vec3(1.0f));
    vec3 light = vec3(direct.x / color.x, direct.y / color.y, direct.z / color.z);
    Float bright = luminance(vec3(direct)) * share;
    Float spread = max(direct.w * share - bright * bright, 0.0f) / max(rays - 1.0f, 1.0f);
    Float variance = spread / square(luminance(color) * share);
    store_light(PLANE_DIRECT, here, light, select(of_one, variance, Float(-1.0f)));
}

// A pixel that a filter stands on.
struct Place {
    Pixels pixels;
    Uint pixel;
    Int row;
    Int column;
};

Place place_of(Uint pixel) {
    Place place;
    place.pixels = pixels_from(pixel);
    place.pixel = pixel;
    Uint row = pixel / settings.width;
    place.row = Int(row);
    place.column = Int(pixel - row * settings.width);
    return place;
}

// Whether the picture goes on so far from a place.
Mask is_inside(Place place, int right, int down) {
    Int column = place.column + right;
    Int row = place.row + down;
    return column >= 0 && column < Int(settings.width) && row >= 0 && row < Int(settings.height);
}

// A pixel so far off; past the first or the last one, that one.
Pixels pixels_at(Place place, int right, int down) {
    return pixels_beside(place.pixels, down * int(settings.width) + right);
}

// What the middle of a filter is like, for others to be held against.
struct Middle {
    vec3 normal;
    Float nearness;
    Float slope_right;
    Float slope_down;
};

vec3 load_normal(Pixels pixels) {
    return vec3(load_plane(PLANE_NORMAL, pixels), load_plane(PLANE_NORMAL + 1u, pixels),
                load_plane(PLANE_NORMAL + 2u, pixels));
}

Middle load_middle(Pixels here) {
    Middle middle;
    middle.normal = load_normal(here);
    middle.nearness = load_plane(PLANE_NEARNESS, here);
    middle.slope_right = load_plane(PLANE_SLOPE, here);
    middle.slope_down = load_plane(PLANE_SLOPE + 1u, here);
    return middle;
}

// How much a difference in nearness counts so far off: one over the square of what is within a surface.
Float strictness(Middle middle, int right, int down) {
    Float steps = abs(middle.slope_right * float(right)) + abs(middle.slope_down * float(down));
    return 1.0f / square(0.02f * middle.nearness + 0.5f * steps + 1.0e-12f);
}

// How far geometry tells a pixel from the middle: 0 for the same surface, 1 and more for another one.
Float difference_of(Middle middle, Pixels other, int right, int down, Float strict) {
    vec3 bend = load_normal(other) - middle.normal;
    Float steps = middle.slope_right * float(right) + middle.slope_down * float(down);
    Float off = load_plane(PLANE_NEARNESS, other) - (middle.nearness + steps);
    return dot(bend, bend) * 4.0f + off * off * strict;
}

Float fall_off(Float difference) {
    Float left = max(1.0f - difference, 0.0f);
    return left * left;
}

// The smaller of two steps of nearness to neighbours: across an edge it is large.
Float gentle(Float middle, Float before, Float after) {
    Float left = middle - before;
    Float right = after - middle;
    return select(abs(left) < abs(right), left, right);
}

// Slopes of nearness. Variances of a few samples are noise themselves: each becomes the mean of those of like pixels
// beside, above and below; where it is not known it is judged from their light. Light that is of two layers gives way
// to that of pixels around that have one.
void steady_filter(Uint job) {
    Place place = place_of(job + pass.first_pixel);
    Pixels here = place.pixels;
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
    Float beside = strictness(middle, 1, 0);
    Float above = strictness(middle, 0, 1);
    vec4 light = load_light(pass.filter_from, here);
    Float trust = load_plane(PLANE_TRUST, here);
    Float weights = 1.0e-6f;
    Float variances = 0.0f;
    Float squares = 0.0f;
    vec3 sum = vec3(light) * 1.0e-6f;
    for (int i = 0; i < 4; ++i) {
        int across = i == 0 ? -1 : i == 1 ? 1 : 0;
        int down = i == 2 ? -1 : i == 3 ? 1 : 0;
        Pixels other = pixels_at(place, across, down);
        Float difference = difference_of(middle, other, across, down, i < 2 ? beside : above);
        Float alike = fall_off(difference) * load_plane(PLANE_TRUST, other);
        Float weight = select(is_inside(place, across, down), alike, Float(0.0f));
        vec4 others = load_light(pass.filter_from, other);
        Float bright = luminance(vec3(others));
        weights = weights + weight;
        variances = variances + weight * others.w;
        sum = sum + vec3(others) * weight;
        squares = squares + weight * bright * bright;
    }
    Float scale = 1.0f / weights;
    vec3 mean = sum * scale;
    Float around = max(squares * scale - square(luminance(mean)), 0.0f);
    Float pooled = (variances + max(light.w, 0.0f)) / (weights + 1.0f);
    Float variance = select(light.w < 0.0f, around, pooled);
    // One sample in a thousand brings a thousand times as much: it is spread over all that is like it, with no regard
    // to what that looks like.
    Float limit = luminance(mean) + 6.0f * sqrt(around);
    Float bright = luminance(vec3(light));
    Float shrunk = min(limit / max(bright, 1.0e-12f), 1.0f);
    shrunk = select(weights < 0.5f, Float(1.0f), shrunk);
    store_light(pass.filter_to, here, blend(mean, vec3(light) * shrunk, trust), variance);
    store_plane(pass.filter_to + 4u, here, bright * (1.0f - shrunk) * trust);
    store_plane(pass.filter_from + 4u, here, variance);  // for the last stage: no level comes by there
}

// Direct light: the mean of like pixels around, of those that show one surface.
void filter_direct(Uint job) {
    Place place = place_of(job + pass.first_pixel);
    Pixels here = place.pixels;
    vec4 light = load_light(pass.filter_from, here);
    Middle middle = load_middle(here);
    Float beside = strictness(middle, 1, 0);
    Float above = strictness(middle, 0, 1);
    Float diagonal = strictness(middle, 1, 1);
    vec3 sum = vec3(light);
    Float weights = 1.0f;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            if (x == 0 && y == 0) {
                continue;
            }
            Pixels other = pixels_at(place, x, y);
            vec4 others = load_light(pass.filter_from, other);
            vec3 off = vec3(others) - vec3(light);
            Float strict = y == 0 ? beside : x == 0 ? above : diagonal;
            Float difference =
                difference_of(middle, other, x, y, strict) + dot(off, off) / (32.0f * (light.w + others.w) + 1.0e-8f);
            Float kernel = x == 0 || y == 0 ? 0.5f : 0.25f;
            Mask counts = is_inside(place, x, y) && others.w >= 0.0f;
            Float weight = select(counts, kernel * fall_off(difference), Float(0.0f));
            sum = sum + vec3(others) * weight;
            weights = weights + weight;
        }
    }
    store_light(pass.filter_to, here, select(light.w < 0.0f, vec3(light), sum * (1.0f / weights)), light.w);
}

// One level of the rest: the mean of like pixels `filter_step` apart, by a small kernel. What was too bright goes by
// geometry alone, as much to each pixel as comes back, so that none is lost.
void filter_level(Uint job) {
    Place place = place_of(job + pass.first_pixel);
    Pixels here = place.pixels;
    vec4 light = load_light(pass.filter_from, here);
    Middle middle = load_middle(here);
    int step = int(pass.filter_step);
    Float beside = strictness(middle, step, 0);
    Float above = strictness(middle, 0, step);
    Float diagonal = strictness(middle, step, step);
    vec3 sum = vec3(light);
    Float variances = light.w;
    Float weights = 1.0f;
    Float excess = load_plane(pass.filter_from + 4u, here);
    Float gained = 0.0f;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            if (x == 0 && y == 0) {
                continue;
            }
            Pixels other = pixels_at(place, x * step, y * step);
            vec4 others = load_light(pass.filter_from, other);
            vec3 off = vec3(others) - vec3(light);
            Float strict = y == 0 ? beside : x == 0 ? above : diagonal;
            Float apart = difference_of(middle, other, x * step, y * step, strict);
            Float difference = apart + dot(off, off) / (120.0f * (light.w + others.w) + 1.0e-8f);
            Float kernel = x == 0 || y == 0 ? 0.5f : 0.25f;
            Float inside = select(is_inside(place, x * step, y * step), Float(kernel), Float(0.0f));
            Float weight = inside * fall_off(difference);
            sum = sum + vec3(others) * weight;
            variances = variances + weight * weight * others.w;
            weights = weights + weight;
            Float given = (load_plane(pass.filter_from + 4u, other) - excess) * (inside * fall_off(apart));
            gained = gained + given;
        }
    }
    Float scale = 1.0f / weights;
    store_light(pass.filter_to, here, sum * scale, variances * scale * scale);
    store_plane(pass.filter_to + 4u, here, excess + gained * 0.25f);
}

// Indirect light with what was taken off it.
vec3 load_whole_light(Pixels pixels) {
    return vec3(load_light(pass.filter_from, pixels)) + vec3(load_plane(pass.filter_from + 4u, pixels));
}

// The light of a layer that is not its pixel's own: that of pixels around that have it.
vec3 borrowed_light(Place place, Uint layer, vec3 own) {
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
            sum = sum + load_whole_light(other) * weight;
            weights = weights + weight;
        }
    }
    return sum * (1.0f / weights);
}

// The picture again: each layer's light by its albedo, and direct light, which is at `filter_to`, by all camera rays.
void finish_filter(Uint job) {
    Place place = place_of(job + pass.first_pixel);
    Pixels here = place.pixels;
    Uint layer = Uint(load_plane(PLANE_LAYER, here));
    Uint other = Uint(GUIDE_LAYER) - layer;
    vec3 light = load_whole_light(here);
    vec3 albedo = vec3(load_guide(place.pixel, layer + GUIDE_ALBEDO));
    Float scale = 1.0f / load_guide(place.pixel, Uint(GUIDE_RAYS)).x;
    vec4 direct = load_light(pass.filter_to, here);
    vec3 known = vec3(load_guide(place.pixel, Uint(GUIDE_DIRECT)));
    vec3 radiance = light * albedo + select(direct.w < 0.0f, known, vec3(direct) * albedo);
    Mask mixed = load_guide(place.pixel, other + GUIDE_NORMAL).w > 0.0f;
    if (any_lane(mixed)) {
        vec3 more = borrowed_light(place, other, light) * vec3(load_guide(place.pixel, other + GUIDE_ALBEDO));
        radiance = radiance + select(mixed, more, vec3(0.0f));
    }
    radiance = radiance * scale;
    // Where that is farther off the mean of the samples than their variance explains, if that is known, it is wrong,
    // not they. Of few samples variance says little: they may have missed what is rare and bright.
    vec4 mean = load_filter_picture(place.pixel);
    vec3 off = vec3(mean) - radiance;
    Float variance = load_plane(pass.filter_to + 4u, here);
    Float doubt = max(mean.w, variance * square(luminance(albedo) * scale));
    doubt = max(doubt, square(luminance(radiance)) * pass.sample_scale);
    Float kept = max(1.0f - 12.0f * doubt / (dot(off, off) + 1.0e-12f), 0.0f);
    radiance = radiance + off * select(mean.w < 0.0f, Float(0.0f), kept);
    if (settings.frame == 0u) {
        store_filter_picture(place.pixel, vec4(radiance, 1.0f));
    } else {
        store_light(pass.filter_to, here, radiance, Float(0.0f));
    }
}

#endif
