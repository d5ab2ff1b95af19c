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
Mask wants_ray(Pixels pixels, Float rays) {
    vec4 direct = load_guides(pixels, GUIDE_DIRECT);
    Float first = load_guides(pixels, GUIDE_NORMAL).w;
    Float others = load_guides(pixels, GUIDE_LAYER + GUIDE_NORMAL).w;
    Float scale = 1.0f / max(rays, 1.0f);
    Float bright = luminance(vec3(direct)) * scale;
    Float variance = (direct.w * scale - bright * bright) / max(rays - 1.0f, 1.0f);
    Mask mixed = others > 0.0f || (first > 0.0f && first < rays);
    return mixed || variance > 0.01f * square(bright + 0.05f);
}

// All pixels take the first rays. One that has gone without one does so from then on: nothing has changed.
void choose_path(Uint job) {
    Uint pixel = job + pass.first_pixel;
    Pixels here = pixels_in_order(pixel);
    vec4 rays = load_guides(here, GUIDE_RAYS);
    Mask wanted = rays.x < float(pass.filter_step);
    Mask asks = !wanted && rays.y > 0.0f;
    if (any_lane(asks)) {
        wanted = wanted || (asks && wants_ray(here, rays.x));
    }
    Float change = select(wanted, Float(1.0f), Float(0.0f)) - rays.y;
    if (any_lane(change != 0.0f)) {
        add_to_guide(pixel, Uint(GUIDE_RAYS), vec4(0.0f, change, 0.0f, 0.0f), true);
    }
    push_extension_ray(job, wanted);
}

void gather_light(Uint job) {
    Uint pixel = job + pass.first_pixel;
    Float taken = load_guides(pixels_in_order(pixel), GUIDE_RAYS).y;
    if (any_lane(taken > 0.0f)) {
        vec3 light = vec3(load_path_radiance(rows_from(job))) * taken;
        light = select(luminance(light) < 1.0e18f, light, vec3(0.0f));  // whose square is finite
        add_to_guide(pixel, Uint(GUIDE_DIRECT), vec4(light, square(luminance(light))), true);
        add_to_guide(pixel, Uint(GUIDE_RAYS), vec4(taken, 0.0f, 0.0f, 0.0f), true);
    }
}

// How far the square of a difference in luminance may be off by noise, in variances of both, before pixels are told
// apart by it: of indirect light and of direct light.
const float LIKE_BY_NOISE = 48.0f;
const float LIKE_BY_DIRECT_NOISE = 16.0f;

Float likely_square(Float variance, float by_noise) { return min(variance * by_noise + 1.0e-8f, 1.0e30f); }

// Variances are of luminance, and so pixels are told apart by that: it stands where green was, since red, blue and
// luminance are as much as a colour.
vec3 green_as_luminance(vec3 light) { return vec3(light.x, luminance(light), light.z); }

vec3 green_again(vec3 light) {
    return vec3(light.x, (light.y - (0.2126f * light.x + 0.0722f * light.z)) * (1.0f / 0.7152f), light.z);
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
    Pixels here = pixels_in_order(job + pass.first_pixel);
    Float scale = pass.sample_scale;
    vec4 mean = load_filter_picture(here);
    vec3 direct = vec3(load_guides(here, GUIDE_DIRECT)) * scale;
    vec4 first = load_guides(here, GUIDE_ALBEDO);
    vec4 others = load_guides(here, GUIDE_LAYER + GUIDE_ALBEDO);
    vec3 albedo = (vec3(first) + vec3(others)) * scale;
    Float of_first = load_guides(here, GUIDE_NORMAL).w;
    Float of_others = load_guides(here, GUIDE_LAYER + GUIDE_NORMAL).w;
    Mask empty = of_first == 0.0f;
    Mask unknown = mean.w >= NO_MEAN;
    vec3 scattered = select(empty, vec3(0.0f), vec3(mean) - direct);
    albedo = select(empty, vec3(1.0f), albedo);
    vec3 light = vec3(scattered.x / albedo.x, scattered.y / albedo.y, scattered.z / albedo.z);
    Float shade = 1.0f / luminance(albedo);
    Float variance = select(unknown, Float(-1.0f), mean.w * shade * shade);
    light = select(unknown, vec3(0.0f), light);
    store_light(PLANE_LIGHT, here, light, select(empty, Float(0.0f), variance));
    Float mixed = min(of_first, of_others) / max(of_first + of_others, 1.0f);
    store_plane(PLANE_TRUST, here, select(unknown, Float(0.0f), 1.0f - 2.0f * mixed));
    store_plane(PLANE_LAYER, here, select(of_others > of_first, Float(1.0f), Float(0.0f)));
}

// A row of the first layer of pixels, or of the second one.
vec4 load_layer(Pixels pixels, Mask second, uint row) {
    bool of_one = !any_lane(!second);
    vec4 found = load_guides(pixels, of_one ? GUIDE_LAYER + row : row);
    if (!of_one && any_lane(second)) {
        found = select(second, load_guides(pixels, GUIDE_LAYER + row), found);
    }
    return found;
}

// What guides say of the layer, and direct light: by albedo where it is that of all rays.
void prepare_filter(Uint job) {
    Pixels here = pixels_in_order(job + pass.first_pixel);
    Mask second = load_plane(PLANE_LAYER, here) > 0.0f;
    vec4 normal = load_layer(here, second, GUIDE_NORMAL);
    vec4 albedo = load_layer(here, second, GUIDE_ALBEDO);
    Float rays = load_guides(here, GUIDE_RAYS).x;
    Float share = 1.0f / max(normal.w, 1.0f);
    Float scale = 1.0f / rays;
    vec3 mean = normalized(vec3(normal));
    store_plane(PLANE_NORMAL, here, mean.x);
    store_plane(PLANE_NORMAL + 1u, here, mean.y);
    store_plane(PLANE_NORMAL + 2u, here, mean.z);
    store_plane(PLANE_NEARNESS, here, albedo.w * share);
    store_plane(PLANE_ALBEDO, here, albedo.x * scale);
    store_plane(PLANE_ALBEDO + 1u, here, albedo.y * scale);
    store_plane(PLANE_ALBEDO + 2u, here, albedo.z * scale);
    vec4 direct = load_guides(here, GUIDE_DIRECT);
    Mask of_one = normal.w > 0.0f && normal.w == rays;
    vec3 color = select(of_one, vec3(albedo), vec3(rays));
    vec3 light = vec3(direct.x / color.x, direct.y / color.y, direct.z / color.z);
    Float bright = luminance(vec3(direct)) * scale;
    Float spread = max(direct.w * scale - bright * bright, 0.0f) / max(rays - 1.0f, 1.0f);
    Float variance = spread / square(luminance(color) * scale);
    Mask mixed = load_layer(here, !second, GUIDE_NORMAL).w > 0.0f;
    Float none = select(mixed, Float(TWO_LAYERS), Float(LAYER_AND_SKY));
    Float likely = select(of_one, likely_square(variance, LIKE_BY_DIRECT_NOISE), none);
    store_light(PLANE_DIRECT, here, green_as_luminance(light), likely);
}

// Pixels that a filter stands on, and how far from there it looks.
struct Place {
    Pixels pixels;
    Int row;
    Int column;
    int step;
};

Place place_of(Uint pixel, int step) {
    Place place;
    place.pixels = pixels_in_order(pixel);
    place.row = pixel_row(place.pixels, settings.width);
    place.column = pixel_column(place.pixels, place.row, settings.width);
    place.step = step;
    return place;
}

// Whether the picture goes on so many steps from a place.
Mask is_inside(Place place, int right, int down) {
    Int column = place.column + right * place.step;
    Int row = place.row + down * place.step;
    Mask beside = column >= 0 && column < Int(settings.width);
    Mask above = row >= 0 && row < Int(settings.height);
    return right == 0 ? above : down == 0 ? beside : beside && above;
}

// Pixels so many steps off; what stands where the picture does not go on means nothing.
Pixels pixels_at(Place place, int right, int down) {
    return pixels_beside(place.pixels, (down * int(settings.width) + right) * place.step);
}

// What the middle of a filter is like, for others to be held against.
struct Middle {
    vec4 light;
    vec3 normal;  // eight times as long
    Float nearness;
    Float slope_right;  // what nearness grows by in a step
    Float slope_down;
    Float strict;  // how much the square of a difference in nearness counts
};

vec3 load_normal(Pixels pixels) {
    return vec3(load_plane(PLANE_NORMAL, pixels), load_plane(PLANE_NORMAL + 1u, pixels),
                load_plane(PLANE_NORMAL + 2u, pixels));
}

// One over the square of the difference that is within a surface.
Float strictness(Float nearness, Float slopes) { return 1.0f / square(0.02f * nearness + 0.5f * slopes + 1.0e-12f); }

Middle middle_of(Pixels here, uint plane, Float nearness, Float slope_right, Float slope_down) {
    Middle middle;
    middle.light = load_light(plane, here);
    middle.normal = load_normal(here) * 8.0f;
    middle.nearness = nearness;
    middle.slope_right = slope_right;
    middle.slope_down = slope_down;
    middle.strict = strictness(nearness, abs(slope_right) + abs(slope_down));
    return middle;
}

Middle load_middle(Place place, uint plane) {
    Pixels here = place.pixels;
    float step = float(place.step);
    return middle_of(here, plane, load_plane(PLANE_NEARNESS, here), load_plane(PLANE_SLOPE, here) * step,
                     load_plane(PLANE_SLOPE + 1u, here) * step);
}

// How far geometry tells pixels so many steps off from the middle: 1 for the same surface, 0 and less for another one.
// That is 1 - 4 |a - b|^2 for normals a and b, less the square of how far they are off the plane through the middle.
Float likeness(Middle middle, Pixels other, int right, int down) {
    Float expected = middle.nearness;
    if (right != 0) {
        expected = right > 0 ? expected + middle.slope_right : expected - middle.slope_right;
    }
    if (down != 0) {
        expected = down > 0 ? expected + middle.slope_down : expected - middle.slope_down;
    }
    Float off = load_plane(PLANE_NEARNESS, other) - expected;
    return (dot(load_normal(other), middle.normal) - 7.0f) - off * off * middle.strict;
}

Float weight_of(Float alike) {
    Float left = max(alike, 0.0f);
    return left * left;
}

// The smaller of two steps of nearness: across an edge it is large.
Float gentle(Float before, Float after) { return select(abs(before) < abs(after), before, after); }

// How nearness grows to the right or down; past the sides of the picture it goes on as it came.
Float slope_of(Place place, Float nearness, int right, int down) {
    Float before = nearness - load_plane(PLANE_NEARNESS, pixels_at(place, -right, -down));
    Float after = load_plane(PLANE_NEARNESS, pixels_at(place, right, down)) - nearness;
    before = select(is_inside(place, -right, -down), before, after);
    after = select(is_inside(place, right, down), after, before);
    return gentle(before, after);
}

// What is gathered of the pixels around a place.
struct Gathered {
    vec3 light;
    Float variances;
    Float weights;
    Float squares;  // of luminance
    Float excess;
};

void gather_steady(Place place, Middle middle, int right, int down, inout Gathered gathered) {
    Pixels other = pixels_at(place, right, down);
    Float alike = weight_of(likeness(middle, other, right, down)) * load_plane(PLANE_TRUST, other);
    Float weight = select(is_inside(place, right, down), alike, Float(0.0f));
    vec4 others = load_light(pass.filter_from, other);
    Float bright = luminance(vec3(others));
    gathered.weights = gathered.weights + weight;
    gathered.variances = gathered.variances + weight * others.w;
    gathered.light = gathered.light + vec3(others) * weight;
    gathered.squares = gathered.squares + weight * bright * bright;
}

// Slopes of nearness. Variances of a few samples are noise themselves: each becomes the mean of those of like pixels
// beside, above and below; where it is not known it is judged from their light. Light that is of two layers gives way
// to that of pixels around that have one.
void steady_filter(Uint job) {
    Place place = place_of(job + pass.first_pixel, 1);
    Pixels here = place.pixels;
    Float nearness = load_plane(PLANE_NEARNESS, here);
    Float slope_right = slope_of(place, nearness, 1, 0);
    Float slope_down = slope_of(place, nearness, 0, 1);
    store_plane(PLANE_SLOPE, here, slope_right);
    store_plane(PLANE_SLOPE + 1u, here, slope_down);
    Middle middle = middle_of(here, pass.filter_from, nearness, slope_right, slope_down);
    vec4 light = middle.light;
    Float trust = load_plane(PLANE_TRUST, here);
    Gathered gathered;
    gathered.weights = 1.0e-6f;
    gathered.variances = 0.0f;
    gathered.squares = 0.0f;
    gathered.light = vec3(light) * 1.0e-6f;
    gather_steady(place, middle, -1, 0, gathered);
    gather_steady(place, middle, 1, 0, gathered);
    gather_steady(place, middle, 0, -1, gathered);
    gather_steady(place, middle, 0, 1, gathered);
    Float weights = gathered.weights;
    Float scale = 1.0f / weights;
    vec3 mean = gathered.light * scale;
    Float around = max(gathered.squares * scale - square(luminance(mean)), 0.0f);
    Float pooled = (gathered.variances + max(light.w, 0.0f)) / (weights + 1.0f);
    Float variance = select(light.w < 0.0f, around, pooled);
    // One sample in a thousand brings a thousand times as much: it is spread over all that is like it, with no regard
    // to what that looks like.
    Float limit = luminance(mean) + 6.0f * sqrt(around);
    Float bright = luminance(vec3(light));
    Float shrunk = min(limit / max(bright, 1.0e-12f), 1.0f);
    shrunk = select(weights < 0.5f, Float(1.0f), shrunk);
    vec3 steady = green_as_luminance(blend(mean, vec3(light) * shrunk, trust));
    store_light(pass.filter_to, here, steady, likely_square(variance, LIKE_BY_NOISE));
    store_plane(pass.filter_to + 4u, here, bright * (1.0f - shrunk) * trust);
    store_plane(PLANE_VARIANCE, here, variance);
}

void gather_level(Place place, Middle middle, Float excess, int right, int down, inout Gathered gathered) {
    Pixels other = pixels_at(place, right, down);
    vec4 others = load_light(pass.filter_from, other);
    Float off = others.y - middle.light.y;
    Float apart = likeness(middle, other, right, down);
    Float alike = weight_of(apart - off * off / (middle.light.w + others.w));
    Float near = max(apart, 0.0f);
    Mask counts = is_inside(place, right, down);
    Float weight = select(counts, right == 0 || down == 0 ? alike : alike * 0.5f, Float(0.0f));
    Float share = select(counts, right == 0 || down == 0 ? near : near * 0.5f, Float(0.0f));
    gathered.light = gathered.light + vec3(others) * weight;
    gathered.variances = gathered.variances + weight * weight * others.w;
    gathered.weights = gathered.weights + weight;
    Float given = load_plane(pass.filter_from + 4u, other) - excess;
    gathered.excess = gathered.excess + given * share;
}

// One level of indirect light: the mean of like pixels `filter_step` apart, by a small kernel, whose middle counts
// twice. What was too bright goes by geometry alone, as much to each pixel as comes back, so that none is lost.
void filter_level(Uint job) {
    Place place = place_of(job + pass.first_pixel, int(pass.filter_step));
    Pixels here = place.pixels;
    Middle middle = load_middle(place, pass.filter_from);
    Float excess = load_plane(pass.filter_from + 4u, here);
    Gathered gathered;
    gathered.light = vec3(middle.light) * 2.0f;
    gathered.variances = middle.light.w * 4.0f;
    gathered.weights = 2.0f;
    gathered.excess = 0.0f;
    gather_level(place, middle, excess, -1, -1, gathered);
    gather_level(place, middle, excess, 0, -1, gathered);
    gather_level(place, middle, excess, 1, -1, gathered);
    gather_level(place, middle, excess, -1, 0, gathered);
    gather_level(place, middle, excess, 1, 0, gathered);
    gather_level(place, middle, excess, -1, 1, gathered);
    gather_level(place, middle, excess, 0, 1, gathered);
    gather_level(place, middle, excess, 1, 1, gathered);
    Float scale = 1.0f / gathered.weights;
    store_light(pass.filter_to, here, gathered.light * scale, gathered.variances * scale * scale);
    store_plane(pass.filter_to + 4u, here, excess + gathered.excess * 0.125f);
}

void gather_direct(Place place, Middle middle, int right, int down, inout Gathered gathered) {
    Pixels other = pixels_at(place, right, down);
    vec4 others = load_light(PLANE_DIRECT, other);
    Float off = others.y - middle.light.y;
    Float alike = weight_of(likeness(middle, other, right, down) - off * off / (middle.light.w + others.w));
    Float weight = select(is_inside(place, right, down) && others.w >= 0.0f, alike, Float(0.0f));
    gathered.light = gathered.light + vec3(others) * weight;
    gathered.weights = gathered.weights + weight;
}

// Direct light, and what is kept in place of its variance: of pixels that show one surface the mean of those beside,
// above and below that are like them, the middle counting twice.
vec4 steady_direct(Place place) {
    Middle middle = load_middle(place, PLANE_DIRECT);
    vec4 light = middle.light;
    Gathered gathered;
    gathered.light = vec3(light) * 2.0f;
    gathered.weights = 2.0f;
    gather_direct(place, middle, 0, -1, gathered);
    gather_direct(place, middle, -1, 0, gathered);
    gather_direct(place, middle, 1, 0, gathered);
    gather_direct(place, middle, 0, 1, gathered);
    vec3 mean = gathered.light * (1.0f / gathered.weights);
    return vec4(green_again(select(light.w < 0.0f, vec3(light), mean)), light.w);
}

// Indirect light with what was taken off it, which is grey.
vec3 load_whole_light(Pixels pixels) {
    return vec3(load_light(pass.filter_from, pixels)) + vec3(load_plane(pass.filter_from + 4u, pixels));
}

void gather_layer(Place place, vec3 normal, Float near, Float strict, int right, int down, inout Gathered gathered) {
    Pixels other = pixels_at(place, right, down);
    Float off = load_plane(PLANE_NEARNESS, other) - near;
    Float alike = weight_of((dot(load_normal(other), normal) - 1.0f) - off * off * strict);
    Float weight = select(is_inside(place, right, down), alike, Float(0.0f));
    gathered.light = gathered.light + load_whole_light(other) * weight;
    gathered.weights = gathered.weights + weight;
}

// The light of a layer that is not its pixel's own: that of pixels beside, above and below that have it. The likeness
// is 1 - |a - b|^2 of normals a and b, less the square of a difference in nearness by a tenth of it.
vec3 borrowed_light(Place place, vec4 normal, Float sum_of_near, vec3 own) {
    Float near = sum_of_near * (1.0f / max(normal.w, 1.0f));
    Float strict = 1.0f / square(0.1f * near + 1.0e-12f);
    vec3 twice = normalized(vec3(normal)) * 2.0f;
    Gathered gathered;
    gathered.weights = 1.0e-6f;
    gathered.light = own * 1.0e-6f;
    gather_layer(place, twice, near, strict, 0, -1, gathered);
    gather_layer(place, twice, near, strict, -1, 0, gathered);
    gather_layer(place, twice, near, strict, 1, 0, gathered);
    gather_layer(place, twice, near, strict, 0, 1, gathered);
    return gathered.light * (1.0f / gathered.weights);
}

// The picture again: each layer's light by its albedo, and direct light.
void finish_filter(Uint job) {
    Place place = place_of(job + pass.first_pixel, 1);
    Pixels here = place.pixels;
    vec3 light = load_whole_light(here);
    vec3 albedo =
        vec3(load_plane(PLANE_ALBEDO, here), load_plane(PLANE_ALBEDO + 1u, here), load_plane(PLANE_ALBEDO + 2u, here));
    vec4 direct = steady_direct(place);
    vec3 radiance = green_again(light) * albedo + vec3(direct) * select(direct.w < 0.0f, vec3(1.0f), albedo);
    Mask mixed = direct.w == TWO_LAYERS;
    if (any_lane(mixed)) {
        Mask other = load_plane(PLANE_LAYER, here) == 0.0f;
        vec4 normal = load_layer(here, other, GUIDE_NORMAL);
        vec4 given = load_layer(here, other, GUIDE_ALBEDO);
        Float scale = 1.0f / load_guides(here, GUIDE_RAYS).x;
        vec3 more = green_again(borrowed_light(place, normal, given.w, light)) * (vec3(given) * scale);
        radiance = radiance + select(mixed, more, vec3(0.0f));
    }
    // Where that is farther off the mean of the samples than their variance explains, if that is known, it is wrong,
    // not they. Of few samples variance says little: they may have missed what is rare and bright.
    vec4 mean = load_filter_picture(here);
    vec3 off = vec3(mean) - radiance;
    Float variance = load_plane(PLANE_VARIANCE, here);
    Float doubt = max(mean.w, variance * square(luminance(albedo)));
    doubt = max(doubt, square(luminance(radiance)) * pass.sample_scale);
    Float kept = max(1.0f - 12.0f * doubt / (dot(off, off) + 1.0e-12f), 0.0f);
    radiance = radiance + off * select(mean.w < 0.0f, Float(0.0f), kept);
    if (settings.frame == 0u) {
        store_filter_picture(here, vec4(radiance, 1.0f));
    } else {
        store_light(pass.filter_to, here, radiance, Float(0.0f));
    }
}

#endif
