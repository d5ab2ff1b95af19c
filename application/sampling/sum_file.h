// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "application/sampling/run_identity.h"
#include "application/sampling/sample_sums.h"

// A picture of some samples that can be added to others: an EXR with the mean in R, G and B, for people and programs,
// and the exact sums in twelve channels of 32-bit integers, for pathtracer merge.

namespace application {

/// A file's part of a picture.
struct PicturePart {
    std::string file;
    RunIdentity run;
    std::vector<SampleRange> ranges;  ///< in order and apart
    bool exact = true;                ///< false: without sums, which are then the mean times the samples
    SampleSums sums{0, 0, false};
};

/// The bytes of such a file.
render_system::Result<std::string> encode_sums(const SampleSums& sums, const PictureNotes& notes);

/// Reads a file that `encode_sums` or `encode_exr` made, the latter without exact sums. Fails where it is none, or does
/// not say what it is of; the message names the file and the remedy.
render_system::Result<PicturePart> read_part(const std::string& file);

}  // namespace application
