// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/cluster/mpi_team.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace application {
namespace {

using render_system::PixelSum;
using render_system::Status;
using render_system::StatusCode;

/// Where the tiles of a round begin, and the end of the last one. Large ones come first: each is an eighth of what is
/// left to a rank if all are equally fast, so that a rank that is slow does not begin one that takes longer than all
/// others have still to do. Small ones come last and leave nobody waiting for long; there are few of them, since a core
/// is slower at them.
std::vector<uint64_t> tile_starts(uint64_t pixels, uint64_t ranks, uint64_t smallest) {
    constexpr uint64_t kShare = 8, kMost = 1 << 18;
    std::vector<uint64_t> starts;
    for (uint64_t start = 0; start < pixels;) {
        starts.push_back(start);
        const uint64_t even = (pixels - start) / (ranks * kShare) / smallest * smallest;
        start += std::clamp(even, smallest, std::max(smallest, kMost));
    }
    starts.push_back(pixels);
    return starts;
}

}  // namespace

MpiTeam::MpiTeam() { MPI_Comm_size(MPI_COMM_WORLD, &ranks_); }

int MpiTeam::rank_of_process() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

/// Ranks of one machine share memory. PATHTRACER_ANSWERS (0 or 1) overrules.
bool MpiTeam::needs_answers() {
    if (const char* wish = std::getenv("PATHTRACER_ANSWERS")) return std::string_view(wish) == "1";
    MPI_Comm machine = MPI_COMM_NULL;
    int here = 0, all = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &all);
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &here);
    MPI_Comm_free(&machine);
    return here < all;
}

MpiTeam::~MpiTeam() {
    answering_.end();
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
    answering_.end();  // after tasks
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
    MPI_Win_allocate(rank_ == 0 ? static_cast<MPI_Aint>(bytes) : 0, 1, MPI_INFO_NULL, MPI_COMM_WORLD, &shared_, &sums_);
    if (rank_ == 0) *counter = 0;
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Win_lock_all(0, counter_);
    MPI_Win_lock_all(0, sums_);
}

MpiTeam::Round MpiTeam::announced(Round round) {
    uint64_t numbers[] = {round.first, round.count, round.is_fresh ? 1u : 0u, round.smallest_tile};
    MPI_Bcast(numbers, 4, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    return {static_cast<uint32_t>(numbers[0]), static_cast<uint32_t>(numbers[1]), numbers[2] != 0, numbers[3]};
}

/// The counter of this round as it was before.
uint64_t MpiTeam::raised_by(uint64_t more) {
    uint64_t fetched = 0;
    MPI_Fetch_and_op(&more, &fetched, MPI_UINT64_T, 0, 0, MPI_SUM, counter_);
    MPI_Win_flush(0, counter_);
    return fetched - fetched_before_;
}

/// The task may take long, in which others ask for theirs.
uint64_t MpiTeam::next_task() {
    answering_.end();
    const uint64_t task = raised_by(1);
    answering_.begin();
    return task;
}

void MpiTeam::skip_tasks(uint64_t end) {
    answering_.end();
    raised_by(end);
}

void MpiTeam::add_up(std::span<uint64_t> numbers) {
    MPI_Reduce(rank_ == 0 ? MPI_IN_PLACE : numbers.data(), numbers.data(), static_cast<int>(numbers.size()),
               MPI_UINT64_T, MPI_SUM, 0, MPI_COMM_WORLD);
}

/// Where on rank 0 the sums of that pixel lie, and their squares.
uint64_t MpiTeam::place_of(uint64_t pixel) const { return pixel * sizeof(PixelSum); }
uint64_t MpiTeam::place_of_square(uint64_t pixel) const { return pixels_ * sizeof(PixelSum) + pixel * sizeof(double); }

/// Asks for what was there before. Sums are exact, so that they may come while samples are taken, and be added then;
/// squares are not, and those of one process are added one after the other.
void MpiTeam::ask_for_tile(uint64_t first_pixel) {
    there_.resize(tile_.size());
    const auto get = [&](void* values, uint64_t bytes, uint64_t place) {
        MPI_Get(values, static_cast<int>(bytes), MPI_BYTE, 0, static_cast<MPI_Aint>(place), static_cast<int>(bytes),
                MPI_BYTE, sums_);
    };
    get(there_.data(), there_.size() * sizeof(PixelSum), place_of(first_pixel));
    if (!squares_) return;
    get(tile_squares_.data(), tile_squares_.size() * sizeof(double), place_of_square(first_pixel));
    MPI_Win_flush(0, sums_);
}

void MpiTeam::add_what_was_there() {
    MPI_Win_flush(0, sums_);
    for (size_t i = 0; i < tile_.size(); ++i) add_sum(tile_[i], there_[i]);
}

/// It is there once next_tile() is done.
void MpiTeam::send_tile(uint64_t first_pixel) {
    const auto put = [&](const void* values, uint64_t bytes, uint64_t place) {
        MPI_Put(values, static_cast<int>(bytes), MPI_BYTE, 0, static_cast<MPI_Aint>(place), static_cast<int>(bytes),
                MPI_BYTE, sums_);
    };
    put(tile_.data(), tile_.size() * sizeof(PixelSum), place_of(first_pixel));
    if (squares_) put(tile_squares_.data(), tile_squares_.size() * sizeof(double), place_of_square(first_pixel));
}

/// Waits at the same time for the counter and until the last tile is where it belongs.
uint64_t MpiTeam::next_tile() {
    const uint64_t tile = raised_by(1);
    MPI_Win_flush(0, sums_);
    return tile;
}

void MpiTeam::render_tile(CoreSession& session, const Round& round, uint64_t first_pixel, uint64_t count) {
    times_.begin_tile(first_pixel, count);
    tile_.assign(count, {});
    tile_squares_.assign(squares_ ? count : 0, 0.0);
    if (!round.is_fresh) ask_for_tile(first_pixel);
    times_.note();
    answering_.begin();
    const Status status =
        session.render_part(tile_, tile_squares_, static_cast<uint32_t>(first_pixel), round.first, round.count);
    answering_.end();
    times_.note();
    if (!status.ok()) {
        fmt::print(stderr, "pathtracer: error: rank {}: {}; the run ends, --resume goes on from a checkpoint\n", rank_,
                   explain(status));
        MPI_Abort(MPI_COMM_WORLD, 2);
    }
    if (!round.is_fresh) add_what_was_there();
    send_tile(first_pixel);
    times_.end_tile();
}

void MpiTeam::work_off(CoreSession& session, const Round& round) {
    if (tiles_of_ != round.smallest_tile) {
        tiles_of_ = round.smallest_tile;
        starts_ = tile_starts(pixels_, static_cast<uint64_t>(ranks_), tiles_of_);
    }
    times_.begin_round();
    const uint64_t tiles = starts_.size() - 1;
    for (uint64_t tile = next_tile(); tile < tiles; tile = next_tile())
        render_tile(session, round, starts_[tile], starts_[tile + 1] - starts_[tile]);
    fetched_before_ += tiles + static_cast<uint64_t>(ranks_);  // each rank has fetched once in vain
    MPI_Barrier(MPI_COMM_WORLD);
}

/// Sums that another run has left, or none, come to where all ranks reach them.
void MpiTeam::share(const SampleSums& sums) {
    if (sums.samples == shared_samples_ || sums.samples == 0) return;
    std::memcpy(shared_, sums.pixels.data(), pixels_ * sizeof(PixelSum));
    if (squares_) std::memcpy(shared_ + place_of_square(0), sums.squares.data(), pixels_ * sizeof(double));
    MPI_Win_sync(sums_);
}

Status MpiTeam::render(CoreSession& session, SampleSums& sums, uint32_t first, uint32_t count) {
    open_windows(sums.pixels.size(), !sums.squares.empty());
    share(sums);
    constexpr uint64_t kFewestPerThread = 256;
    work_off(session, announced({first, count, sums.samples == 0, session.stats().threads * kFewestPerThread}));
    sums.samples += count;
    shared_samples_ = sums.samples;
    return Status::success();
}

void MpiTeam::collect(SampleSums& sums) {
    if (sums.samples == 0 || sums.samples != shared_samples_) return;  // nothing has been rendered since they were set
    MPI_Win_sync(sums_);
    std::memcpy(static_cast<void*>(sums.pixels.data()), shared_, pixels_ * sizeof(PixelSum));
    if (squares_) std::memcpy(sums.squares.data(), shared_ + place_of_square(0), pixels_ * sizeof(double));
}

void MpiTeam::end() {
    if (counter_ == MPI_WIN_NULL) open_windows(1, squares_);
    announced({});
}

Status MpiTeam::follow(CoreSession& session, bool squares) {
    open_windows(uint64_t{session.width()} * session.height(), squares);
    for (Round round = announced({}); round.count > 0; round = announced({})) work_off(session, round);
    return Status::success();
}

}  // namespace application
