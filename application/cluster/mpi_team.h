// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "application/cluster/team.h"

namespace application {

/// A team of MPI's ranks; rank 0 leads. Tiles, runs of pixels, and tasks are handed out by a counter on rank 0 that
/// each rank fetches and raises by itself (one-sided), and finished tiles are put into memory of rank 0. MPI must be
/// initialised, and is not finalised here.
class MpiTeam final : public Team {
public:
    MpiTeam();
    ~MpiTeam() override;
    MpiTeam(const MpiTeam&) = delete;
    MpiTeam& operator=(const MpiTeam&) = delete;

    int rank() const { return rank_; }
    int ranks() const { return ranks_; }

    bool leads() const override { return rank_ == 0; }
    render_system::Status agree(const render_system::Status& mine) override;
    render_system::Status agree_on(const RunIdentity& run) override;
    uint64_t told(uint64_t number) override;
    render_system::Status render(CoreSession& session, SampleSums& sums, uint32_t first, uint32_t count) override;
    void end() override;
    render_system::Status follow(CoreSession& session, bool squares) override;
    void open_tasks() override { open_windows(0, false); }
    uint64_t next_task() override { return raised_by(1); }
    void skip_tasks(uint64_t end) override { raised_by(end); }
    void add_up(std::span<uint64_t> numbers) override;

private:
    /// Samples [first, first + count) of all pixels; count 0 ends.
    struct Round {
        uint32_t first = 0;
        uint32_t count = 0;
    };

    void open_windows(uint64_t pixels, bool squares);
    Round announced(Round round);
    std::string text_of(int rank, const std::string& mine);
    void work_off(CoreSession& session, const Round& round);
    uint64_t raised_by(uint64_t more);
    void put_tile(uint64_t first_pixel);

    int rank_ = 0;
    int ranks_ = 1;
    MPI_Win counter_ = MPI_WIN_NULL;  // on rank 0: how many tiles or tasks were fetched, ever
    MPI_Win sums_ = MPI_WIN_NULL;     // on rank 0: the round's sums of all pixels, then their squares
    std::byte* round_memory_ = nullptr;
    uint64_t pixels_ = 0;
    uint64_t tile_pixels_ = 0;
    uint64_t fetched_before_ = 0;  // in all rounds before this one
    bool squares_ = false;
    std::vector<render_system::PixelSum> tile_;
    std::vector<double> tile_squares_;
};

}  // namespace application
