// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "application/cluster/answering.h"
#include "application/cluster/team.h"
#include "application/cluster/tile_times.h"

namespace application {

/// A team of MPI's ranks; rank 0 leads. Tiles, runs of pixels, and tasks are handed out by a counter on rank 0 that
/// each rank fetches and raises by itself (one-sided). The sums lie in memory of rank 0; whoever has a tile gets its
/// sums, adds its samples and puts them back. So rank 0 does nothing between two rounds, and a pixel's samples are
/// added in the order of one process. MPI must be initialised, and is not finalised here.
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
    void collect(SampleSums& sums) override;
    void end() override;
    render_system::Status follow(CoreSession& session, bool squares) override;
    void open_tasks() override { open_windows(0, false); }
    uint64_t next_task() override;
    void skip_tasks(uint64_t end) override;
    void add_up(std::span<uint64_t> numbers) override;

private:
    /// Samples [first, first + count) of all pixels; count 0 ends.
    struct Round {
        uint32_t first = 0;
        uint32_t count = 0;
        bool is_fresh = false;  // no samples were taken before
        uint64_t smallest_tile = 0;
    };

    void open_windows(uint64_t pixels, bool squares);
    Round announced(Round round);
    std::string text_of(int rank, const std::string& mine);
    static int rank_of_process();
    static bool needs_answers();
    void share(const SampleSums& sums);
    void work_off(CoreSession& session, const Round& round);
    void render_tile(CoreSession& session, const Round& round, uint64_t first_pixel, uint64_t count);
    uint64_t raised_by(uint64_t more);
    uint64_t place_of(uint64_t pixel) const;
    uint64_t place_of_square(uint64_t pixel) const;
    void ask_for_tile(uint64_t first_pixel);
    void add_what_was_there();
    void send_tile(uint64_t first_pixel);
    uint64_t next_tile();

    int rank_ = rank_of_process();
    int ranks_ = 1;
    TileTimes times_{rank_};
    Answering answering_{needs_answers()};  // of rank 0 all ask; others' own questions go on while they render
    MPI_Win counter_ = MPI_WIN_NULL;        // on rank 0: how many tiles or tasks were fetched, ever
    MPI_Win sums_ = MPI_WIN_NULL;           // on rank 0: the sums of all pixels, then of their squares
    std::byte* shared_ = nullptr;           // on rank 0: that memory
    uint32_t shared_samples_ = 0;           // on rank 0: in it
    uint64_t pixels_ = 0;
    std::vector<uint64_t> starts_;  // of the tiles, and the end of the last
    uint64_t tiles_of_ = 0;         // the smallest tile that they are for
    uint64_t fetched_before_ = 0;   // in all rounds before this one
    bool squares_ = false;
    std::vector<render_system::PixelSum> tile_;   // samples of this round, then with what was there
    std::vector<render_system::PixelSum> there_;  // before this round
    std::vector<double> tile_squares_;
};

}  // namespace application
