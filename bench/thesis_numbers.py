# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""The thesis's numbers, as far as this project has them. What is not here nobody made up."""

# Samples: SSIM, RMSE of levels from 0 to 255, of its two cores.
TABLE1 = {
    "Sponza": {1: (0.697, 56.3), 16: (0.737, 32.5), 1024: (0.801, 28.1)},
    "Pica Pica": {1: (0.736, 50.4), 16: (0.813, 33.8), 1024: (0.878, 31.9)},
}

# Block: CPU lines, shared, Moss %, GPU lines, shared, Moss %, 1 - (lines not shared) / (lines) of the CPU.
TABLE2 = {
    "Render core": (2007, 181, 8, 800, 181, 25, 0.09),
    "BSDF": (100, 73, 86, 141, 73, 62, 0.73),
    "Shading": (216, 101, 51, 246, 101, 37, 0.47),
    "Extend": (43, 0, 0, 109, 0, 0, 0.0),
}

# Rows of the tables of speed: its GPU, and its CPU.
CPU = "one thread of a 2.2 GHz i7"
SPEED = [["thesis: GPU core", "38.46", "26", "103", "-"], ["thesis: CPU core", "0.91", "1100", "2.1", "-"]]
RAYS = [["thesis", "-", "-", "-", 2670000, "61.0 (extension)"]]
TIME = [["thesis: GPU core", "-", "-", "-", "-", "-", "-", "53"], ["thesis: CPU core", "-", "-", "-", "-", "-", "-", "36"]]
