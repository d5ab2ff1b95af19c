// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/cluster/team.h"

namespace application {
namespace {

Team* team_of_process = nullptr;

}  // namespace

Team* team() { return team_of_process; }

void set_team(Team* team) { team_of_process = team; }

render_system::Status agreed(const render_system::Status& mine) { return team() ? team()->agree(mine) : mine; }

}  // namespace application
