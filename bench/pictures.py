# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures as arrays of numpy: OpenEXR as `pathtracer` writes it, WebP through dwebp, Radiance, PNG; and how far two are apart.

Needs `apt-get install python3-numpy webp`. A file that is not of its kind raises ValueError with its name.
"""
import struct
import subprocess
import zlib

import numpy

FLOAT32, ZIP_LINES = 2, 16
ZIP = 3


def read_exr(path):
    """Height x width x 3 floats of a scan-line file of float channels R, G, B, compressed by zip: what pathtracer writes."""
    data = path.read_bytes()
    if data[:4] != b"v/1\x01":
        raise ValueError(f"{path} is no OpenEXR file")
    at, header = 8, {}
    while data[at]:
        name_end = data.index(b"\0", at)
        start = data.index(b"\0", name_end + 1) + 5
        length = struct.unpack_from("<i", data, start - 4)[0]
        header[data[at:name_end].decode()], at = data[start:start + length], start + length
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    channels = channel_names(header["channels"])
    if header["compression"][0] != ZIP or not {"R", "G", "B"} <= set(channels):
        raise ValueError(f"{path} has no float channels R, G, B compressed by zip")
    lines = numpy.empty((height, len(channels), width), "<f4")
    for offset in struct.unpack_from(f"<{-(-height // ZIP_LINES)}Q", data, at + 1):
        y, packed = struct.unpack_from("<2i", data, offset)
        count = min(ZIP_LINES, bottom + 1 - y)
        lines[y - top:y - top + count] = unzipped(data[offset + 8:offset + 8 + packed], count * lines[0].nbytes).reshape(
            count, len(channels), width)
    return numpy.stack([lines[:, channels.index(name)] for name in "RGB"], axis=-1)


def channel_names(attribute):
    names, at = [], 0
    while attribute[at]:
        end = attribute.index(b"\0", at)
        if struct.unpack_from("<i", attribute, end + 1)[0] == FLOAT32:
            names.append(attribute[at:end].decode())
        at = end + 17
    return names


def unzipped(packed, size):
    """A block of scan lines: differences of bytes, the low and the high halves of which were parted."""
    if len(packed) == size:
        return numpy.frombuffer(packed, "<f4")
    raw = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).astype(numpy.int64)
    raw[1:] -= 128
    raw = (numpy.cumsum(raw) & 255).astype(numpy.uint8)
    whole = numpy.empty_like(raw)
    whole[0::2], whole[1::2] = raw[:(size + 1) // 2], raw[(size + 1) // 2:]
    return whole.view("<f4")


def read_webp(path):
    """Height x width x 4 values from 0 to 1, alpha last."""
    done = subprocess.run(["dwebp", "-quiet", "-pam", str(path), "-o", "-"], capture_output=True, check=False)
    head, mark, values = done.stdout.partition(b"ENDHDR\n")
    if done.returncode != 0 or not mark:
        raise ValueError(f"{path} is no WebP picture")
    fields = dict(line.split(" ", 1) for line in head.decode().splitlines()[1:] if line)
    shape = (int(fields["HEIGHT"]), int(fields["WIDTH"]), int(fields["DEPTH"]))
    picture = numpy.frombuffer(values, numpy.uint8).reshape(shape).astype(numpy.float32) / 255
    return picture if shape[2] == 4 else numpy.dstack([picture, numpy.ones(shape[:2], numpy.float32)])


def read_radiance(path):
    """Height x width x 4 bytes (RGBE) of a Radiance picture whose rows go down and to the right."""
    data = path.read_bytes()
    head, mark, rest = data.partition(b"\n\n")
    size, _, rest = rest.partition(b"\n")
    words = size.split()
    if not data.startswith(b"#?") or not mark or len(words) != 4 or words[0] != b"-Y" or words[2] != b"+X":
        raise ValueError(f"{path} is no Radiance picture that goes down and to the right")
    height, width = int(words[1]), int(words[3])
    if rest[:2] != b"\2\2":
        return numpy.frombuffer(rest, numpy.uint8, height * width * 4).reshape(height, width, 4)
    rows = numpy.empty((height, 4, width), numpy.uint8)
    at = 0
    for row in rows:
        at += 4
        line = bytearray()
        while len(line) < 4 * width:
            count = rest[at]
            line += rest[at + 1:at + 2] * (count - 128) if count > 128 else rest[at + 1:at + 1 + count]
            at += 2 if count > 128 else 1 + count
        row[:] = numpy.frombuffer(line, numpy.uint8).reshape(4, width)
    return rows.transpose(0, 2, 1)


def write_radiance(path, pixels):
    """Writes RGBE bytes as runs that repeat nothing, which every reader takes."""
    height, width = pixels.shape[:2]
    lines = [b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width)]
    for row in pixels:
        lines.append(struct.pack(">BBH", 2, 2, width))
        for channel in row.T:
            values = channel.tobytes()
            for at in range(0, width, 128):
                run = values[at:at + 128]
                lines += [bytes([len(run)]), run]
    path.write_bytes(b"".join(lines))


def write_png(path, picture):
    """Writes height x width x 3 values from 0 to 1."""
    levels = numpy.rint(numpy.clip(picture, 0, 1) * 255).astype(numpy.uint8)
    height, width = levels.shape[:2]
    rows = numpy.concatenate([numpy.zeros((height, 1), numpy.uint8), levels.reshape(height, width * 3)], axis=1)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))


def aces_levels(radiance):
    """Radiance by the curve of the reference pictures: Stephen Hill's fit of ACES, 1 / 0.6 brighter, and a gamma of 2.2."""
    into = numpy.array([[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]])
    back = numpy.array([[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]])
    v = numpy.clip(radiance, 0, 1e9) / 0.6 @ into.T
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081)
    return numpy.clip(v @ back.T, 0, 1) ** (1 / 2.2)


def over_white(picture):
    return picture[..., :3] * picture[..., 3:] + (1 - picture[..., 3:])


def halved(picture):
    """Half the width and height: the mean of four pixels each, of the colour as it covers."""
    covering = numpy.dstack([picture[..., :3] * picture[..., 3:], picture[..., 3]])
    height, width = (length // 2 * 2 for length in picture.shape[:2])
    mean = covering[:height, :width].reshape(height // 2, 2, width // 2, 2, 4).mean(axis=(1, 3))
    return numpy.dstack([mean[..., :3] / numpy.maximum(mean[..., 3:], 1e-6), mean[..., 3]])


def rmse(a, b, where):
    """Of levels from 0 to 255, over the pixels in `where`; not a number where there are none."""
    return float(numpy.sqrt(numpy.mean((a[where] - b[where]) ** 2)) * 255) if where.any() else float("nan")


def blurred(image):
    """By a Gaussian of 1.5 pixels, cut at 5, the edges repeated."""
    weights = numpy.exp(-numpy.arange(-5, 6) ** 2 / (2 * 1.5 ** 2))
    weights /= weights.sum()
    for axis in (0, 1):
        padded = numpy.pad(image, [(5, 5) if a == axis else (0, 0) for a in (0, 1)], mode="edge")
        length = image.shape[axis]
        image = sum(w * numpy.take(padded, range(i, i + length), axis) for i, w in enumerate(weights))
    return image


def ssim(a, b, where):
    """Wang et al. 2004 on luminance of levels, the mean over the pixels in `where`."""
    if not where.any():
        return float("nan")
    x, y = (p[..., :3] @ numpy.array([0.2126, 0.7152, 0.0722]) for p in (a, b))
    mean_x, mean_y = blurred(x), blurred(y)
    var_x, var_y = blurred(x * x) - mean_x ** 2, blurred(y * y) - mean_y ** 2
    both = blurred(x * y) - mean_x * mean_y
    c1, c2 = 0.01 ** 2, 0.03 ** 2
    values = (2 * mean_x * mean_y + c1) * (2 * both + c2) / ((mean_x ** 2 + mean_y ** 2 + c1) * (var_x + var_y + c2))
    return float(values[where].mean())
