// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/locate/path_fields.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>

namespace application {

using render_system::NONE;
using render_system::PathKernel;
using render_system::PathStates;

namespace {

constexpr uint32_t ROW_WORDS = 4;

/// Some numbers of a row that make one field.
struct FieldPlace {
    PathField field;
    PathRow row;
    uint32_t first;
    uint32_t count;
};

constexpr FieldPlace RADIANCE = {PathField::radiance, PathRow::radiance, 0, 3};
constexpr std::array<FieldPlace, 6> RAY = {{{PathField::ray_direction, PathRow::direction, 0, 3},
                                            {PathField::pdf, PathRow::throughput, 3, 1},
                                            {PathField::throughput, PathRow::throughput, 0, 3},
                                            {PathField::ray_origin, PathRow::origin, 0, 3},
                                            {PathField::cone_width, PathRow::origin, 3, 1},
                                            {PathField::cone_growth, PathRow::direction, 3, 1}}};
constexpr std::array<FieldPlace, 4> SHADOW = {{{PathField::shadow_direction, PathRow::shadow_direction, 0, 3},
                                               {PathField::shadow_distance, PathRow::shadow_origin, 3, 1},
                                               {PathField::shadow_contribution, PathRow::shadow_contribution, 0, 3},
                                               {PathField::shadow_origin, PathRow::shadow_origin, 0, 3}}};
constexpr FieldPlace MEAN = {PathField::pixel, PathRow::mean, 0, 4};

bool agree(float a, float b, float allowed) {
    if (allowed == 0.0f) return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
    if (!std::isfinite(a) || !std::isfinite(b)) return a == b || (std::isnan(a) && std::isnan(b));
    return std::abs(a - b) <= allowed;
}

/// Where one side has no such row there is nothing to hold against each other.
bool agrees(const FieldPlace& place, const PathView& a, const PathView& b, PathTolerance tolerance) {
    const float* left = a.row(place.row);
    const float* right = b.row(place.row);
    if (!left || !right) return true;
    float largest = 0.0f;
    for (uint32_t i = place.first; i < place.first + place.count; ++i)
        for (const float value : {left[i], right[i]})
            if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    for (uint32_t i = place.first; i < place.first + place.count; ++i)
        if (!agree(left[i], right[i], tolerance.relative * largest)) return false;
    return true;
}

template <class Places>
uint32_t first_of(const Places& places, const PathView& a, const PathView& b, PathTolerance tolerance) {
    for (const FieldPlace& place : places)
        if (!agrees(place, a, b, tolerance)) return static_cast<uint32_t>(place.field);
    return PATH_FIELDS;
}

/// Row `index` of some rows; null past their end.
const float* row_at(std::span<const float> rows, uint32_t index) {
    return (size_t{index} + 1) * ROW_WORDS <= rows.size() ? rows.data() + size_t{index} * ROW_WORDS : nullptr;
}

/// Makes the views of one wave or tile.
class Views {
public:
    explicit Views(const PathStates& states) : states_(states), place_(states.path_count, NONE) {}

    std::vector<PathView> make() {
        switch (states_.kernel) {
            case PathKernel::generate:
            case PathKernel::finalize:
                for (uint32_t path = 0; path < states_.path_count; ++path) add(path);
                break;
            case PathKernel::extend:
                for (const uint32_t path : states_.queue) add(path);
                break;
            case PathKernel::shade:
                for_each_surface([&](uint32_t path, uint32_t, uint32_t) { add(path); });
                break;
            case PathKernel::connect:
                for_each_shadow_ray([&](uint32_t path, uint32_t) { add(path); });
                break;
        }
        fill();
        return std::move(views_);
    }

private:
    void add(uint32_t path) {
        if (path >= states_.path_count || place_[path] != NONE) return;
        place_[path] = static_cast<uint32_t>(views_.size());
        views_.emplace_back().path = path;
    }

    PathView* find(uint32_t path) {
        return path < states_.path_count && place_[path] != NONE ? &views_[place_[path]] : nullptr;
    }

    template <class Use>
    void for_each_surface(Use use) {
        const std::span<const uint32_t> rows = states_.surfaces;
        for (size_t at = 0; at + ROW_WORDS <= rows.size(); at += ROW_WORDS) use(rows[at], rows[at + 1], rows[at + 2]);
    }

    template <class Use>
    void for_each_shadow_ray(Use use) {
        const std::span<const float> rows = states_.shadow_directions;
        for (uint32_t ray = 0; (size_t{ray} + 1) * ROW_WORDS <= rows.size(); ++ray)
            use(std::bit_cast<uint32_t>(rows[size_t{ray} * ROW_WORDS + 3]), ray);
    }

    void fill() {
        const bool makes_rays = states_.kernel == PathKernel::generate || states_.kernel == PathKernel::shade;
        if (makes_rays) {
            for (const uint32_t path : states_.queue)
                if (PathView* view = find(path)) view->goes_on = true;
        }
        for_each_surface([&](uint32_t path, uint32_t instance, uint32_t primitive) {
            if (PathView* view = find(path)) {
                view->instance = instance;
                view->primitive = primitive;
            }
        });
        for (PathView& view : views_) {
            const auto put = [&](PathRow row, std::span<const float> rows) {
                view.rows[static_cast<size_t>(row)] = row_at(rows, view.path);
            };
            if (states_.kernel == PathKernel::finalize) {
                put(PathRow::mean, states_.means);
                continue;
            }
            put(PathRow::radiance, states_.radiances);
            if (!makes_rays || !view.goes_on) continue;
            put(PathRow::origin, states_.origins);
            put(PathRow::direction, states_.directions);
            put(PathRow::throughput, states_.throughputs);
        }
        if (states_.kernel == PathKernel::shade) fill_shadow_rays();
    }

    void fill_shadow_rays() {
        for_each_shadow_ray([&](uint32_t path, uint32_t ray) {
            PathView* view = find(path);
            if (!view) return;
            view->rows[static_cast<size_t>(PathRow::shadow_origin)] = row_at(states_.shadow_origins, ray);
            view->rows[static_cast<size_t>(PathRow::shadow_direction)] = row_at(states_.shadow_directions, ray);
            view->rows[static_cast<size_t>(PathRow::shadow_contribution)] = row_at(states_.shadow_contributions, ray);
        });
    }

    const PathStates& states_;
    std::vector<uint32_t> place_;  // of each path in views_
    std::vector<PathView> views_;
};

}  // namespace

const char* field_name(PathField field) {
    constexpr std::array<const char*, PATH_FIELDS> NAMES = {"queue",
                                                            "hit",
                                                            "radiance",
                                                            "shadow_ray",
                                                            "shadow_direction",
                                                            "shadow_distance",
                                                            "shadow_contribution",
                                                            "shadow_origin",
                                                            "continues",
                                                            "ray_direction",
                                                            "pdf",
                                                            "throughput",
                                                            "ray_origin",
                                                            "cone_width",
                                                            "cone_growth",
                                                            "pixel"};
    return NAMES[static_cast<size_t>(field)];
}

const char* kernel_name(PathKernel kernel) {
    constexpr std::array<const char*, render_system::PATH_KERNELS> NAMES = {"generate", "extend", "shade", "connect",
                                                                            "finalize"};
    return NAMES[static_cast<size_t>(kernel)];
}

std::vector<PathView> paths_of(const PathStates& states) { return Views(states).make(); }

uint32_t first_different_field(PathKernel kernel, const PathView& a, const PathView& b, PathTolerance tolerance) {
    if (kernel == PathKernel::finalize) return first_of(std::array{MEAN}, a, b, tolerance);
    if (kernel == PathKernel::extend && (a.instance != b.instance || a.primitive != b.primitive))
        return static_cast<uint32_t>(PathField::hit);
    if (const uint32_t field = first_of(std::array{RADIANCE}, a, b, tolerance); field != PATH_FIELDS) return field;
    if (a.has_shadow_ray() != b.has_shadow_ray()) return static_cast<uint32_t>(PathField::shadow_ray);
    if (const uint32_t field = first_of(SHADOW, a, b, tolerance); field != PATH_FIELDS) return field;
    if (a.goes_on != b.goes_on) return static_cast<uint32_t>(PathField::continues);
    return first_of(RAY, a, b, tolerance);
}

}  // namespace application
