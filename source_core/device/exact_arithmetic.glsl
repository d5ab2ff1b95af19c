// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: one-sided; the target core has what its processor does. Read before a kernel's text where a device may round
// otherwise (exact_arithmetic.h). Numbers are held as a significand of 24 bits, the highest set, and the exponent field
// that goes with it. Results come with two more bits: the next one, and whether anything is behind it. `const in` makes
// glslang pass values; for plain parameters it passes pointers. The first of a loop's 26 digits is always 1, so that it
// ends when the last one is there: a driver that sees no count unrolls nothing.

float exact_packed(const in uint sign, const in uint digits, const in int exponent) {
    uint kept = digits;
    int field = exponent;
    if (field < 1) {
        uint lost = uint(min(1 - field, 27));
        kept = (kept >> lost) | uint((kept & ((1u << lost) - 1u)) != 0u);
        field = 1;
    }
    uint rest = kept & 3u;
    uint rounded = (kept >> 2) + uint(rest == 3u || (rest == 2u && (kept & 4u) != 0u));
    uint bits = field > 254 ? 0x7f800000u : min((uint(field - 1) << 23) + rounded, 0x7f800000u);
    return uintBitsToFloat(sign | bits);
}

// Of the bits of a positive number that is finite: its significand, and the exponent field that goes with it, which is
// below 1 for denormals.
uint exact_significand(const in uint bits) {
    int up = max(23 - findMSB(bits), 0);
    return up > 0 ? bits << up : (bits & 0x007fffffu) | 0x00800000u;
}
int exact_field(const in uint bits) {
    int up = max(23 - findMSB(bits), 0);
    return up > 0 ? 1 - up : int(bits >> 23);
}

float exact_quotient(const in float dividend, const in float divisor) {
    uint a = floatBitsToUint(dividend);
    uint b = floatBitsToUint(divisor);
    uint sign = (a ^ b) & 0x80000000u;
    a &= 0x7fffffffu;
    b &= 0x7fffffffu;
    if (a > 0x7f800000u || b > 0x7f800000u || (a == b && (a == 0u || a == 0x7f800000u))) {
        return uintBitsToFloat(0xffc00000u);
    }
    if (a == 0x7f800000u || b == 0u) {
        return uintBitsToFloat(sign | 0x7f800000u);
    }
    if (b == 0x7f800000u || a == 0u) {
        return uintBitsToFloat(sign);
    }
    uint left = exact_significand(a);
    uint by = exact_significand(b);
    int exponent = exact_field(a) - exact_field(b) + 127;
    if (left < by) {
        left <<= 1;
        exponent -= 1;
    }
    uint digits = 0u;
    while (digits < 0x02000000u) {
        bool fits = left >= by;
        left = (fits ? left - by : left) << 1;
        digits = (digits << 1) | uint(fits);
    }
    return exact_packed(sign, digits | uint(left != 0u), exponent);
}

float exact_root(const in float x) {
    uint a = floatBitsToUint(x);
    if (a == 0u || a == 0x80000000u || a == 0x7f800000u) {
        return x;
    }
    if (a > 0x7f800000u) {
        return uintBitsToFloat(0xffc00000u);
    }
    int exponent = exact_field(a) - 127;
    int odd = exponent & 1;
    uint digits_of_x = exact_significand(a) << (1 + odd);
    uint digits = 0u;
    uint left = 0u;
    for (int at = 24; digits < 0x02000000u; at -= 2) {
        left = (left << 2) | (at >= 0 ? (digits_of_x >> at) & 3u : 0u);
        uint trial = (digits << 2) | 1u;
        bool fits = left >= trial;
        left = fits ? left - trial : left;
        digits = (digits << 1) | uint(fits);
    }
    return exact_packed(0u, digits | uint(left != 0u), (exponent - odd) / 2 + 127);
}

float exact_smaller(const in float a, const in float b) { return b < a ? b : a; }
float exact_larger(const in float a, const in float b) { return a < b ? b : a; }
float exact_clamped(const in float x, const in float low, const in float high) {
    return exact_smaller(exact_larger(x, low), high);
}

float exact_dot(const in vec2 a, const in vec2 b) { return a.x * b.x + a.y * b.y; }
float exact_dot(const in vec3 a, const in vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
float exact_dot(const in vec4 a, const in vec4 b) { return ((a.x * b.x + a.y * b.y) + a.z * b.z) + a.w * b.w; }
vec3 exact_cross(const in vec3 a, const in vec3 b) {
    return vec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
}
