// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "application/core_session.h"
#include "application/sampling/run_identity.h"
#include "application/sampling/sample_sums.h"

namespace application {

/// Processes that render one picture, or the frames of one sequence, together. Every one of them has the scene and a
/// core; one leads and speaks. Of a picture it decides how many samples come next, and writes; of a sequence each
/// member writes the frames that it got. All calls but next_task() and skip_tasks() are made by all members, in the
/// same order.
class Team {
public:
    virtual ~Team() = default;

    virtual bool leads() const = 0;

    /// Whether all could do what they had to: mine, or that of the first member that could not.
    virtual render_system::Status agree(const render_system::Status& mine) = 0;

    /// Fails where a member would take other samples than the leader, naming what differs.
    virtual render_system::Status agree_on(const RunIdentity& run) = 0;

    /// The leader's number, on all.
    virtual uint64_t told(uint64_t number) = 0;

    /// The leader: adds the samples [first, first + count) of every pixel to `sums`, tile by tile on whoever is free.
    /// What they are then lies with the team; their number alone is here until collect().
    virtual render_system::Status render(CoreSession& session, SampleSums& sums, uint32_t first, uint32_t count) = 0;

    /// The leader: brings the sums here that render() has left.
    virtual void collect(SampleSums& sums) = 0;

    /// The leader: lets the others go, until they follow again.
    virtual void end() = 0;

    /// All others: renders what the leader asks for, until it ends.
    virtual render_system::Status follow(CoreSession& session, bool squares) = 0;

    /// Once, before tasks instead of pictures: they are counted from 0 on.
    virtual void open_tasks() = 0;
    /// The next task, which no other member is given.
    virtual uint64_t next_task() = 0;
    /// Gives out no task below `end` any more.
    virtual void skip_tasks(uint64_t end) = 0;
    /// Puts the sums over all members into the leader's numbers.
    virtual void add_up(std::span<uint64_t> numbers) = 0;
};

/// The Team of this process; none where it works alone.
Team* team();
void set_team(Team* team);

/// `mine`, or why another member of the team could not go on; alone, `mine`.
render_system::Status agreed(const render_system::Status& mine);

}  // namespace application
