// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: rewritten; the original is source_core/kernels/language.glsl and what GLSL has built in.
//
// The words that let C++ speak GLSL, for any lane type F: float today, 8 or 16 lanes of it tomorrow. Only what the
// kernels use. Each operation rounds once, in the order written here, so that both cores compute the same bits.
#pragma once

#include <cstdint>
#include <type_traits>

namespace target_core {

using uint = uint32_t;

template <class F>
struct Vec2 {
    F x, y;
    Vec2() = default;
    Vec2(F x_in, F y_in) : x(x_in), y(y_in) {}
    explicit Vec2(F s) : x(s), y(s) {}
};

template <class F>
struct Vec4;

template <class F>
struct Vec3 {
    F x, y, z;
    Vec3() = default;
    Vec3(F x_in, F y_in, F z_in) : x(x_in), y(y_in), z(z_in) {}
    explicit Vec3(F s) : x(s), y(s), z(s) {}
    template <class G>
    explicit Vec3(const Vec4<G>& v) : x(v.x), y(v.y), z(v.z) {}
};

template <class F>
struct alignas(sizeof(F) == 4 ? 16 : alignof(F)) Vec4 {
    F x, y, z, w;
    Vec4() = default;
    Vec4(F x_in, F y_in, F z_in, F w_in) : x(x_in), y(y_in), z(z_in), w(w_in) {}
    explicit Vec4(F s) : x(s), y(s), z(s), w(s) {}
    Vec4(const Vec3<F>& v, F w_in) : x(v.x), y(v.y), z(v.z), w(w_in) {}
};

// The rows of tables and settings: the same for all lanes.
using vec4 = Vec4<float>;
using uvec4 = Vec4<uint>;

// ---- Vec2 ----
template <class F>
inline Vec2<F> operator+(Vec2<F> a, Vec2<F> b) {
    return {a.x + b.x, a.y + b.y};
}
template <class F>
inline Vec2<F> operator-(Vec2<F> a, Vec2<F> b) {
    return {a.x - b.x, a.y - b.y};
}
template <class F>
inline Vec2<F> operator*(Vec2<F> a, std::type_identity_t<F> s) {
    return {a.x * s, a.y * s};
}

// ---- Vec3 ----
template <class F>
inline Vec3<F> operator-(Vec3<F> a) {
    return {-a.x, -a.y, -a.z};
}
template <class F>
inline Vec3<F> operator+(Vec3<F> a, Vec3<F> b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class F>
inline Vec3<F> operator-(Vec3<F> a, Vec3<F> b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class F>
inline Vec3<F> operator*(Vec3<F> a, Vec3<F> b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class F>
inline Vec3<F> operator*(Vec3<F> a, std::type_identity_t<F> s) {
    return {a.x * s, a.y * s, a.z * s};
}
template <class F>
inline F dot(Vec3<F> a, Vec3<F> b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class F>
inline Vec3<F> cross(Vec3<F> a, Vec3<F> b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
// ---- Vec4 ----
template <class F>
inline Vec4<F> operator+(Vec4<F> a, Vec4<F> b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
}
template <class F>
inline Vec4<F> operator-(Vec4<F> a, Vec4<F> b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
}
template <class F>
inline Vec4<F> operator*(Vec4<F> a, std::type_identity_t<F> s) {
    return {a.x * s, a.y * s, a.z * s, a.w * s};
}

}  // namespace target_core
