// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/locate/path_comparison.h"

#include <algorithm>
#include <tuple>

namespace application {

using render_system::NONE;
using render_system::PathKernel;
using render_system::PathStates;

namespace {

/// The place of a kernel among all that a path runs through.
auto order_of(PathKernel kernel, uint32_t segment) {
    return std::tuple(kernel == PathKernel::finalize, segment, kernel);
}

PathHit hit_of(const PathView& view) { return {view.instance, view.primitive}; }

}  // namespace

PathField KernelDifference::field() const {
    return static_cast<PathField>(std::max_element(fields.begin(), fields.end()) - fields.begin());
}

PathComparison::PathComparison(PathLog& log, const render_system::HostScene& scene, size_t pixels,
                               PathTolerance tolerance)
    : log_(log), scene_(scene), tolerance_(tolerance), partings_(pixels), sum_differs_(pixels), parted_in_(pixels) {}

void PathComparison::after(const PathStates& states) {
    for (const PathView& view : paths_of(states)) {
        const size_t pixel = size_t{states.first_pixel} + view.path;
        if (pixel < partings_.size() && partings_[pixel].fate == Fate::same) compare(pixel, states, view);
    }
}

void PathComparison::compare(size_t pixel, const PathStates& states, const PathView& view) {
    Parting& parting = partings_[pixel];
    const auto part = [&](Fate fate, PathKernel kernel, uint32_t segment, uint32_t field) {
        parting.fate = fate;
        parting.kernel = kernel;
        parting.segment = kernel == PathKernel::finalize ? 0 : segment;
        parting.field = static_cast<PathField>(field);
    };
    const auto step = log_.take_step(pixel);
    const auto here = order_of(states.kernel, states.segment);
    const bool ends = states.kernel == PathKernel::finalize;
    if (!step || step->kernel != states.kernel || (!ends && step->segment != states.segment)) {
        const bool other_is_first = step && order_of(step->kernel, step->segment) < here;
        part(Fate::parted, other_is_first ? step->kernel : states.kernel,
             other_is_first ? step->segment : states.segment, static_cast<uint32_t>(PathField::queue));
        return;
    }
    ++compared_.at(static_cast<size_t>(states.kernel));
    if (states.kernel == PathKernel::extend) parting.hit = view.instance == NONE ? hit_of(step->view) : hit_of(view);
    if (ends && sum_differs_[pixel]) return;
    const uint32_t field = first_different_field(states.kernel, step->view, view, tolerance_);
    if (field == PATH_FIELDS) return;
    part(static_cast<PathField>(field) == PathField::hit && ties(states, view, step->view) ? Fate::tied : Fate::parted,
         states.kernel, states.segment, field);
}

bool PathComparison::ties(const PathStates& states, const PathView& a, const PathView& b) const {
    const size_t row = size_t{a.path} * 4;
    if (tolerance_.relative == 0.0f || row + 4 > std::min(states.origins.size(), states.directions.size()))
        return false;
    return is_tie(scene_, &states.origins[row], &states.directions[row], hit_of(a), hit_of(b));
}

void PathComparison::finish_sample() {
    for (size_t pixel = 0; pixel < partings_.size(); ++pixel) {
        Parting& parting = partings_[pixel];
        if (parting.fate == Fate::same) {
            // What the first core went on with and the second did not.
            if (const auto step = log_.take_step(pixel)) {
                parting = {Fate::parted, step->kernel, PathField::queue, step->segment, parting.hit};
            }
        }
        if (parting.fate != Fate::same) add(pixel, parting);
        parting = {};
    }
    paths_ += partings_.size();
    log_.clear();
}

void PathComparison::add(size_t pixel, const Parting& parting) {
    sum_differs_[pixel] = true;
    uint8_t& mark = parted_in_[pixel];
    if (parting.fate == Fate::tied) {
        ++ties_;
        if (mark == 0) mark = PathDifferences::TIE;
        return;
    }
    const auto kernel_mark = static_cast<uint8_t>(1 + static_cast<uint32_t>(parting.kernel));
    mark = mark == 0 ? kernel_mark : std::min(mark, kernel_mark);
    KernelDifference& kernel = kernels_[parting.kernel];
    if (kernel.paths == 0 || parting.segment < kernel.segment) {
        kernel.kernel = parting.kernel;
        kernel.segment = parting.segment;
        kernel.pixel = static_cast<uint32_t>(pixel);
        kernel.fields = {};
    }
    if (parting.segment == kernel.segment) ++kernel.fields[static_cast<size_t>(parting.field)];
    ++kernel.paths;
    if (parting.kernel == PathKernel::finalize || parting.kernel == PathKernel::generate) return;
    if (const uint32_t material = material_of(parting.hit); material != NONE) {
        ++kernel.instances[parting.hit.instance];
        ++kernel.materials[material];
    }
}

uint32_t PathComparison::material_of(const PathHit& hit) const {
    if (hit.instance >= scene_.instances().size()) return NONE;
    const uint32_t mesh = scene_.instances()[hit.instance].mesh;
    if (mesh >= scene_.meshes().size() || hit.primitive >= scene_.meshes()[mesh].triangles.size()) return NONE;
    return scene_.meshes()[mesh].triangles[hit.primitive].w;
}

PathDifferences PathComparison::differences() const {
    PathDifferences result;
    for (const auto& [kernel, difference] : kernels_) result.kernels.push_back(difference);
    std::sort(result.kernels.begin(), result.kernels.end(), [](const auto& a, const auto& b) {
        return order_of(a.kernel, a.segment) < order_of(b.kernel, b.segment);
    });
    result.paths = paths_;
    result.compared = compared_;
    result.explained_by_ties = ties_;
    result.parted_in = parted_in_;
    return result;
}

}  // namespace application
