// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/cluster/mpi_team.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace application {
namespace {

using render_system::PixelSum;
using render_system::Status;
using render_system::StatusCode;

/// Enough tiles that the last ones leave no rank waiting for long, and large enough that a rank's threads share one
/// well.
uint64_t pixels_per_tile(uint64_t pixels, uint64_t ranks, uint64_t threads) {
    constexpr uint64_t kTilesPerRank = 48, kFewestPerThread = 512, kMost = 1 << 16;
    return std::clamp(pixels / (ranks * kTilesPerRank), std::min(kMost, threads * kFewestPerThread), kMost);
}

}  // namespace

MpiTeam::MpiTeam() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
}

MpiTeam::~MpiTeam() {
    for (MPI_Win* window : {&counter_, &sums_}) {
        if (*window == MPI_WIN_NULL) continue;
        MPI_Win_unlock_all(*window);
        MPI_Win_free(window);
    }
}

std::string MpiTeam::text_of(int rank, const std::string& mine) {
    uint64_t size = mine.size();
    MPI_Bcast(&size, 1, MPI_UINT64_T, rank, MPI_COMM_WORLD);
    std::string text = rank == rank_ ? mine : std::string(size, '\0');
    MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, rank, MPI_COMM_WORLD);
    return text;
}

Status MpiTeam::agree(const Status& mine) {
    int failed = mine.ok() ? ranks_ : rank_, first = ranks_;
    MPI_Allreduce(&failed, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (first == ranks_) return Status::success();
    const std::string message = text_of(first, mine.message);
    return Status::error(StatusCode::invalid_argument,
                         first == 0 ? message : fmt::format("rank {}: {}", first, message));
}

Status MpiTeam::agree_on(const RunIdentity& run) {
    const std::string other = first_difference(RunIdentity::read(text_of(0, run.text())), run, "is", "here");
    return agree(other.empty() ? Status::success()
                               : Status::invalid("this rank renders another picture than rank 0: " + other +
                                                 "; start the same program with the same --core on all"));
}

uint64_t MpiTeam::told(uint64_t number) {
    MPI_Bcast(&number, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    return number;
}

void MpiTeam::open_windows(uint64_t pixels, bool squares) {
    if (counter_ != MPI_WIN_NULL) return;
    pixels_ = pixels;
    squares_ = squares;
    uint64_t* counter = nullptr;
    MPI_Win_allocate(rank_ == 0 ? sizeof(uint64_t) : 0, sizeof(uint64_t), MPI_INFO_NULL, MPI_COMM_WORLD, &counter,
                     &counter_);
    const uint64_t bytes = pixels * (sizeof(PixelSum) + (squares ? sizeof(double) : 0));
    MPI_Win_allocate(rank_ == 0 ? static_cast<MPI_Aint>(bytes) : 0, 1, MPI_INFO_NULL, MPI_COMM_WORLD, &round_memory_,
                     &sums_);
    if (rank_ == 0) *counter = 0;
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Win_lock_all(0, counter_);
    MPI_Win_lock_all(0, sums_);
}

MpiTeam::Round MpiTeam::announced(Round round) {
    uint32_t numbers[2] = {round.first, round.count};
    MPI_Bcast(numbers, 2, MPI_UINT32_T, 0, MPI_COMM_WORLD);
    return {numbers[0], numbers[1]};
}

/// The counter of this round as it was before.
uint64_t MpiTeam::raised_by(uint64_t more) {
    uint64_t fetched = 0;
    MPI_Fetch_and_op(&more, &fetched, MPI_UINT64_T, 0, 0, MPI_SUM, counter_);
    MPI_Win_flush(0, counter_);
    return fetched - fetched_before_;
}

void MpiTeam::add_up(std::span<uint64_t> numbers) {
    MPI_Reduce(rank_ == 0 ? MPI_IN_PLACE : numbers.data(), numbers.data(), static_cast<int>(numbers.size()),
               MPI_UINT64_T, MPI_SUM, 0, MPI_COMM_WORLD);
}

void MpiTeam::put_tile(uint64_t first_pixel) {
    const auto put = [&](const void* values, uint64_t bytes, uint64_t place) {
        MPI_Put(values, static_cast<int>(bytes), MPI_BYTE, 0, static_cast<MPI_Aint>(place), static_cast<int>(bytes),
                MPI_BYTE, sums_);
    };
    put(tile_.data(), tile_.size() * sizeof(PixelSum), first_pixel * sizeof(PixelSum));
    if (squares_)
        put(tile_squares_.data(), tile_squares_.size() * sizeof(double),
            pixels_ * sizeof(PixelSum) + first_pixel * sizeof(double));
    MPI_Win_flush(0, sums_);
}

void MpiTeam::work_off(CoreSession& session, const Round& round) {
    const uint64_t tiles = (pixels_ + tile_pixels_ - 1) / tile_pixels_;
    for (uint64_t tile = raised_by(1); tile < tiles; tile = raised_by(1)) {
        const uint64_t first_pixel = tile * tile_pixels_;
        const uint64_t count = std::min(tile_pixels_, pixels_ - first_pixel);
        tile_.assign(count, {});
        tile_squares_.assign(squares_ ? count : 0, 0.0);
        const Status status =
            session.render_part(tile_, tile_squares_, static_cast<uint32_t>(first_pixel), round.first, round.count);
        if (!status.ok()) {
            fmt::print(stderr, "pathtracer: error: rank {}: {}; the run ends, --resume goes on from a checkpoint\n",
                       rank_, explain(status));
            MPI_Abort(MPI_COMM_WORLD, 2);
        }
        put_tile(first_pixel);
    }
    fetched_before_ += tiles + static_cast<uint64_t>(ranks_);  // each rank has fetched once in vain
    MPI_Barrier(MPI_COMM_WORLD);
}

Status MpiTeam::render(CoreSession& session, SampleSums& sums, uint32_t first, uint32_t count) {
    open_windows(sums.pixels.size(), !sums.squares.empty());
    uint64_t tile_pixels = pixels_per_tile(pixels_, static_cast<uint64_t>(ranks_), session.stats().threads);
    MPI_Bcast(&tile_pixels, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    tile_pixels_ = tile_pixels;
    work_off(session, announced({first, count}));
    MPI_Win_sync(sums_);
    PixelSum part;
    for (uint64_t i = 0; i < pixels_; ++i) {
        std::memcpy(&part, round_memory_ + i * sizeof(PixelSum), sizeof(part));
        add_sum(sums.pixels[i], part);
    }
    double square = 0.0;
    for (uint64_t i = 0; i < sums.squares.size(); ++i) {
        std::memcpy(&square, round_memory_ + pixels_ * sizeof(PixelSum) + i * sizeof(square), sizeof(square));
        sums.squares[i] += square;
    }
    sums.samples += count;
    return Status::success();
}

void MpiTeam::end() {
    if (counter_ == MPI_WIN_NULL) open_windows(1, squares_);
    uint64_t nothing = 0;
    MPI_Bcast(&nothing, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
}

Status MpiTeam::follow(CoreSession& session, bool squares) {
    const auto pixels = uint64_t{session.width()} * session.height();
    open_windows(pixels, squares);
    while (true) {
        MPI_Bcast(&tile_pixels_, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
        if (tile_pixels_ == 0) return Status::success();
        work_off(session, announced({}));
    }
}

}  // namespace application
