#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Prints the reference values that tests/metrics/image_metrics_test.cpp holds our formulas against.

The images come from integer formulas that the test repeats, so nothing but these few numbers crosses over. Needs
Debian's python3-skimage: /usr/bin/python3 tests/metrics/reference_values.py
"""
import numpy
import skimage
from skimage.metrics import mean_squared_error, peak_signal_noise_ratio, structural_similarity


def hash_noise(x, y, channel):
    """A value 0 to 255 from a position: one round of integer hashing, modulo 2^32."""
    h = (x * 73856093) ^ (y * 19349663) ^ (channel * 83492791)
    h = (h * 2654435761) & 0xFFFFFFFF
    return h >> 24


def pattern(x, y, channel):
    """Slow ramps with a checkerboard on top, so that windows differ in mean and in structure."""
    ramp = (x * (channel + 2) + y * 3) // 4
    check = 60 if ((x // 7) + (y // 5)) % 2 else 0
    return (ramp + check) % 256


def image(width, height, value):
    rows = [[[value(x, y, c) for c in range(3)] for x in range(width)] for y in range(height)]
    return numpy.array(rows, dtype=numpy.uint8)


def noisy(strength):
    def value(x, y, c):
        offset = (hash_noise(x, y, c) * (2 * strength + 1)) // 256 - strength
        return min(255, max(0, pattern(x, y, c) + offset))
    return value


def one_sided(x, y, c):
    """Only the red channel differs, and only in the left half."""
    return 255 - pattern(x, y, c) if c == 0 and x < 40 else pattern(x, y, c)


CASES = [
    ("noise of 3 levels", 97, 61, pattern, noisy(3)),
    ("noise of 60 levels", 97, 61, pattern, noisy(60)),
    ("unrelated", 64, 64, pattern, hash_noise),
    ("one channel, one half", 80, 45, pattern, one_sided),
    ("smallest", 11, 11, pattern, noisy(20)),
    ("one row of windows", 40, 11, pattern, noisy(20)),
    ("black and white", 16, 16, lambda x, y, c: 0, lambda x, y, c: 255),
]

if __name__ == "__main__":
    print(f"// scikit-image {skimage.__version__}, numpy {numpy.__version__}")
    for name, width, height, first, second in CASES:
        a, b = image(width, height, first), image(width, height, second)
        ssim = structural_similarity(a, b, gaussian_weights=True, sigma=1.5, use_sample_covariance=False,
                                     data_range=255, channel_axis=2)
        rmse = mean_squared_error(a, b) ** 0.5
        psnr = peak_signal_noise_ratio(a, b, data_range=255)
        off = (numpy.abs(a.astype(int) - b.astype(int)).max(axis=2) > 1).mean()
        print(f'{{"{name}", {width}, {height}, ssim={ssim:.12f}, rmse={rmse:.12f}, psnr={psnr:.12f}, off={off:.12f}}}')
