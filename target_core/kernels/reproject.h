// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/reproject.glsl.
#pragma once

#include "target_core/kernels/filter.h"
#include "target_core/kernels/motion.h"

namespace target_core::kernels {

// Temporal accumulation by reprojection: of light with its moments before the wavelet (Schied et al. 2017, SVGF), and
// of the picture after it (Karis 2014, temporal anti-aliasing). What is remembered is clipped to what is around now, in
// YCoCg (Salvi 2016, variance clipping). Where nothing moves nothing is clipped, and light becomes the plain mean.

// Luma and two differences of colour (Malvar and Sullivan 2003): the colours of one surface lie close to a line in it.
inline vec3 to_ycocg(vec3 rgb) {
    return vec3((rgb.x + rgb.z) * 0.25f + rgb.y * 0.5f, (rgb.x - rgb.z) * 0.5f, rgb.y * 0.5f - (rgb.x + rgb.z) * 0.25f);
}

inline vec3 from_ycocg(vec3 v) {
    Float rest = v.x - v.z;
    return vec3(rest + v.y, v.x + v.z, rest - v.y);
}

inline vec3 load_colour(uint plane, Pixels pixels) {
    return vec3(load_plane(plane, pixels), load_plane(plane + 1u, pixels), load_plane(plane + 2u, pixels));
}

// Where what a pixel shows was in the frame before: how far off in columns and rows, and how near.
inline vec3 motion_at(Place place) {
    Mask second = load_plane(PLANE_LAYER, place.pixels) > 0.0f;
    vec4 met = load_layer(place.pixels, second, GUIDE_NORMAL);
    vec3 motion = vec3(load_guides(place.pixels, GUIDE_MOTION));
    motion = select(second, vec3(load_guides(place.pixels, GUIDE_MOTION + 1u)), motion) * (1.0f / max(met.w, 1.0f));
    // The sky turns with the eye alone.
    Float x = (Float(place.column) + 0.5f) / float(settings.width);
    Float y = (Float(place.row) + 0.5f) / float(settings.height);
    Camera now = camera_now();
    vec3 far = place_seen(camera_before(), (now.screen + now.right * x) + now.down * y);
    vec3 turn = vec3(far.x - (Float(place.column) + 0.5f), far.y - (Float(place.row) + 0.5f), 0.0f);
    turn = select(now.parallel, vec3(0.0f), turn);
    motion = select(met.w == 0.0f, turn, motion);
    return select(settings.motion == STANDS_STILL, vec3(0.0f, 0.0f, load_plane(PLANE_NEARNESS, place.pixels)), motion);
}

// A place of the frame before: the pixel above and left of it, and how far on it is from there.
struct Before {
    Int column;
    Int row;
    Float right;
    Float down;
    Mask inside;  // of the picture
};

inline Before place_before(Place place, vec3 motion) {
    Float x = clamp(Float(place.column) + motion.x, -4.0f, float(settings.width) + 4.0f);
    Float y = clamp(Float(place.row) + motion.y, -4.0f, float(settings.height) + 4.0f);
    Before before;
    before.column = Int(floor(x));
    before.row = Int(floor(y));
    before.right = x - floor(x);
    before.down = y - floor(y);
    before.inside = x > -0.5f && y > -0.5f && x < float(settings.width) - 0.5f && y < float(settings.height) - 0.5f;
    return before;
}

// A pixel so far from there; past the sides of the picture, that at the side.
inline Pixels pixels_before(Before before, int right, int down) {
    Int column = clamp(before.column + right, 0, int(settings.width) - 1);
    Int row = clamp(before.row + down, 0, int(settings.height) - 1);
    return pixels_from(Uint(row * int(settings.width) + column));
}

// What is remembered of the light of a surface.
struct Memory {
    vec3 light;
    Float variance;
    Float moment;
    Float second_moment;
    Float frames;  // that are in it; 0: nothing
};

// The mean of the four pixels around that showed the same surface, which was so near.
inline Memory recall(Before before, vec3 normal, Float near) {
    Memory memory;
    memory.light = vec3(0.0f);
    memory.variance = 0.0f;
    memory.moment = 0.0f;
    memory.second_moment = 0.0f;
    memory.frames = 0.0f;
    Float weights = 1.0e-6f;
    for (int y = 0; y <= 1; ++y) {
        Float of_row = y == 0 ? 1.0f - before.down : before.down;
        for (int x = 0; x <= 1; ++x) {
            Float of_column = x == 0 ? 1.0f - before.right : before.right;
            Pixels other = pixels_before(before, x, y);
            vec3 others =
                vec3(load_history_before(HISTORY_NORMAL, other), load_history_before(HISTORY_NORMAL + 1u, other),
                     load_history_before(HISTORY_NORMAL + 2u, other));
            vec3 bend = others - normal;
            Float off = abs(load_history_before(HISTORY_NEARNESS, other) - near);
            Mask alike = before.inside && dot(bend, bend) < 0.25f && off <= 0.1f * near;
            Float weight = select(alike, of_row * of_column, Float(0.0f));
            vec3 light = vec3(load_history_before(HISTORY_LIGHT, other), load_history_before(HISTORY_LIGHT + 1u, other),
                              load_history_before(HISTORY_LIGHT + 2u, other));
            memory.light = memory.light + light * weight;
            memory.variance = memory.variance + load_history_before(HISTORY_LIGHT + 3u, other) * weight;
            memory.moment = memory.moment + load_history_before(HISTORY_MOMENT, other) * weight;
            memory.second_moment = memory.second_moment + load_history_before(HISTORY_MOMENT + 1u, other) * weight;
            memory.frames = memory.frames + load_history_before(HISTORY_LENGTH, other) * weight;
            weights = weights + weight;
        }
    }
    Float scale = select(weights < 0.05f, Float(0.0f), 1.0f / weights);
    memory.light = memory.light * scale;
    memory.variance = memory.variance * scale;
    memory.moment = memory.moment * scale;
    memory.second_moment = memory.second_moment * scale;
    memory.frames = memory.frames * scale;
    return memory;
}

// What colours around a pixel are like, itself among them, in YCoCg.
struct Around {
    vec3 mean;
    vec3 deviation;
    Float weights;
};

// Of the pixels that show the same surface, or of all.
inline Around look_around(Place place, uint plane, bool same_surface) {
    Pixels here = place.pixels;
    vec3 normal = load_normal(here);
    Float near = load_plane(PLANE_NEARNESS, here);
    vec3 sum = vec3(0.0f);
    vec3 squares = vec3(0.0f);
    Float weights = 0.0f;
    for (int down = -1; down <= 1; ++down) {
        for (int across = -1; across <= 1; ++across) {
            Pixels other = pixels_at(place, across, down);
            Mask alike = is_inside(place, across, down);
            if (same_surface) {
                vec3 bend = load_normal(other) - normal;
                alike =
                    alike && dot(bend, bend) < 0.25f && abs(load_plane(PLANE_NEARNESS, other) - near) <= 0.1f * near;
            }
            vec3 colour = to_ycocg(load_colour(plane, other));
            Float weight = select(alike, Float(1.0f), Float(0.0f));
            sum = sum + colour * weight;
            squares = squares + colour * colour * weight;
            weights = weights + weight;
        }
    }
    Around around;
    Float scale = 1.0f / max(weights, 1.0f);
    around.mean = sum * scale;
    vec3 spread = squares * scale - around.mean * around.mean;
    around.deviation = vec3(sqrt(max(spread.x, 0.0f)), sqrt(max(spread.y, 0.0f)), sqrt(max(spread.z, 0.0f)));
    around.weights = weights;
    return around;
}

// A colour of before, drawn towards the mean of what is around as far as it stands out of that.
inline vec3 clipped(vec3 colour, Around around) {
    vec3 off = to_ycocg(colour) - around.mean;
    Float slack = 1.0e-3f * around.mean.x + 1.0e-6f;
    vec3 reach = around.deviation * 1.5f;
    Float beyond =
        max(max(abs(off.x) / (reach.x + slack), abs(off.y) / (reach.y + slack)), abs(off.z) / (reach.z + slack));
    return from_ycocg(around.mean + off * (1.0f / max(beyond, 1.0f)));
}

// How much of a memory is still worth believing: all of it within 1.25 standard errors of what is around, nothing
// beyond twice that.
inline Float belief(Memory memory, Around around) {
    Float off = abs(to_ycocg(memory.light).x - around.mean.x);
    Float error =
        around.deviation.x / sqrt(max(around.weights, 1.0f)) + sqrt(memory.variance) + 1.0e-3f * around.mean.x;
    return saturate(2.0f - off / (1.25f * error + 1.0e-6f));
}

// The light of a pixel becomes the mean of its own and what is remembered of it, and is remembered in its turn.
inline void reproject_light(Uint job) {
    Place place = place_of(job + pass.first_pixel, 1);
    Pixels here = place.pixels;
    vec3 motion = motion_at(place);
    vec4 light = load_light(pass.filter_from, here);
    vec3 normal = load_normal(here);
    Memory memory = recall(place_before(place, motion), normal, motion.z);
    Around around = look_around(place, pass.filter_from, true);
    Float length = select(settings.frame > 1u, memory.frames, Float(0.0f));
    if (settings.motion != STANDS_STILL) {
        length = min(length, 7.0f) * belief(memory, around);
        memory.light = clipped(memory.light, around);
    }
    Mask unknown = load_filter_picture(here).w >= NO_MEAN;
    Float share = select(unknown && length > 0.0f, Float(0.0f), 1.0f / (length + 1.0f));
    Float bright = luminance(vec3(light));
    Float moment = blend(memory.moment, bright, share);
    Float second_moment = blend(memory.second_moment, bright * bright, share);
    // Of one frame: told by its samples, else by frames before it, else by what is around.
    Float of_frames = max(second_moment - moment * moment, 0.0f);
    Float own = select(length < 3.5f, square(around.deviation.x), of_frames);
    own = select(light.w < 0.0f, own, light.w);
    Float variance = memory.variance * square(1.0f - share) + own * square(share);
    vec3 mean = blend(memory.light, vec3(light), share);
    store_light(pass.filter_to, here, mean, variance);
    store_history(HISTORY_LIGHT, here, mean.x);
    store_history(HISTORY_LIGHT + 1u, here, mean.y);
    store_history(HISTORY_LIGHT + 2u, here, mean.z);
    store_history(HISTORY_LIGHT + 3u, here, variance);
    store_history(HISTORY_MOMENT, here, moment);
    store_history(HISTORY_MOMENT + 1u, here, second_moment);
    store_history(HISTORY_LENGTH, here, length + select(unknown, Float(0.0f), Float(1.0f)));
    store_history(HISTORY_NORMAL, here, normal.x);
    store_history(HISTORY_NORMAL + 1u, here, normal.y);
    store_history(HISTORY_NORMAL + 2u, here, normal.z);
    store_history(HISTORY_NEARNESS, here, load_plane(PLANE_NEARNESS, here));
    // The mean that the filter is held to.
    vec3 albedo = vec3(load_guides(here, GUIDE_ALBEDO)) + vec3(load_guides(here, GUIDE_LAYER + GUIDE_ALBEDO));
    vec3 direct = vec3(load_guides(here, GUIDE_DIRECT));
    Float scale = 1.0f / load_guides(here, GUIDE_RAYS).x;
    Float doubt = variance * square(luminance(albedo) * scale);
    store_filter_picture(here, vec4((mean * albedo + direct) * scale, select(unknown, Float(NO_MEAN), doubt)));
}

// Weights of Catmull and Rom for four pixels in a row, the second of which lies `t` before the place.
inline vec4 catmull_rom(Float t) {
    return vec4(t * (t * (1.0f - t * 0.5f) - 0.5f), 1.0f + t * t * (1.5f * t - 2.5f),
                t * (0.5f + t * (2.0f - 1.5f * t)), t * t * (0.5f * t - 0.5f));
}

// What was shown at a place of the frame before, by a small kernel that keeps edges as sharp as they were, but no
// sharper: nothing brighter or darker than the four pixels around.
inline vec3 recall_picture(Before before) {
    vec4 across = catmull_rom(before.right);
    vec4 down = catmull_rom(before.down);
    vec3 sum = vec3(0.0f);
    vec3 least = vec3(1.0e30f);
    vec3 most = vec3(-1.0e30f);
    for (int row = 0; row < 4; ++row) {
        Float of_row = row == 0 ? down.x : row == 1 ? down.y : row == 2 ? down.z : down.w;
        for (int column = 0; column < 4; ++column) {
            Float of_column = column == 0 ? across.x : column == 1 ? across.y : column == 2 ? across.z : across.w;
            Pixels other = pixels_before(before, column - 1, row - 1);
            vec3 picture =
                vec3(load_history_before(HISTORY_PICTURE, other), load_history_before(HISTORY_PICTURE + 1u, other),
                     load_history_before(HISTORY_PICTURE + 2u, other));
            sum = sum + picture * (of_row * of_column);
            if ((row == 1 || row == 2) && (column == 1 || column == 2)) {
                least = min(least, picture);
                most = -min(-most, -picture);
            }
        }
    }
    return vec3(clamp(sum.x, least.x, most.x), clamp(sum.y, least.y, most.y), clamp(sum.z, least.z, most.z));
}

// The picture becomes the mean of itself and of what was shown, and is remembered. Later frames count for more: what
// the first ones know is little. A surface that was not to be seen before has nothing to be a mean with.
inline void reproject_picture(Uint job) {
    Place place = place_of(job + pass.first_pixel, 1);
    Pixels here = place.pixels;
    vec3 colour = load_colour(pass.filter_from, here);
    Before before = place_before(place, motion_at(place));
    vec3 shown = recall_picture(before);
    Float share = max(Float(2.0f / (float(settings.frame) + 1.0f)), 0.0625f);
    if (settings.motion != STANDS_STILL) {
        shown = clipped(shown, look_around(place, pass.filter_from, false));
        share = max(max(share, 0.6f), 1.0f / max(load_history(HISTORY_LENGTH, here), 1.0f));
    }
    share = select(settings.frame > 1u && before.inside, share, Float(1.0f));
    colour = blend(shown, colour, share);
    store_history(HISTORY_PICTURE, here, colour.x);
    store_history(HISTORY_PICTURE + 1u, here, colour.y);
    store_history(HISTORY_PICTURE + 2u, here, colour.z);
    store_filter_picture(here, vec4(colour, 1.0f));
}

}  // namespace target_core::kernels
