// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What kernel languages have built in, in C++: compiled before the functions that `porttool difftest` runs. Everything
// is a template, so that what a project defines itself is preferred, and rounds once per operation, in the order
// written.
#pragma once

#include <bit>
#include <cfloat>
#include <climits>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <type_traits>

namespace porttool_prelude {

template <class T>
concept Number = std::is_arithmetic_v<T> || std::is_same_v<T, _Float16>;  // not every library counts halves

/// What a vector of A and a lone B make: `v * 2.0` stays a vector of floats.
template <class A, class B>
using ByNumber = std::conditional_t<std::is_floating_point_v<A>, A, std::common_type_t<A, B>>;

template <class T, int N>
struct Storage;
template <class T>
struct Storage<T, 1> {
    union {
        T at[1];
        T x, r, s, s0;
    };
};
template <class T>
struct Storage<T, 2> {
    union {
        T at[2];
        struct {
            union {
                T x, r, s, s0;
            };
            union {
                T y, g, t, s1;
            };
        };
    };
};
template <class T>
struct Storage<T, 3> {
    union {
        T at[3];
        struct {
            union {
                T x, r, s, s0;
            };
            union {
                T y, g, t, s1;
            };
            union {
                T z, b, p, s2;
            };
        };
    };
};
template <class T>
struct Storage<T, 4> {
    union {
        T at[4];
        struct {
            union {
                T x, r, s, s0;
            };
            union {
                T y, g, t, s1;
            };
            union {
                T z, b, p, s2;
            };
            union {
                T w, a, q, s3;
            };
        };
    };
};

/// SYCL's names for how what does not fit is rounded.
enum class rounding_mode { automatic, rte, rtz, rtp, rtn };

template <class T, int N, int... I>
struct Parts;

template <class T, int N>
struct vec : Storage<T, N> {
    vec() = default;
    template <class A>
    requires Number<A>
    constexpr vec(A value) {
        for (int i = 0; i < N; ++i) this->at[i] = static_cast<T>(value);
    }
    template <class A, int M>
    requires(M >= N) constexpr vec(const vec<A, M>& other) {
        for (int i = 0; i < N; ++i) this->at[i] = static_cast<T>(other.at[i]);
    }
    template <class A, class B, class... More>
    constexpr vec(const A& first, const B& second, const More&... more) {
        int filled = 0;
        fill(filled, first);
        fill(filled, second);
        (fill(filled, more), ...);
    }
    constexpr T& operator[](int i) { return this->at[i]; }
    constexpr const T& operator[](int i) const { return this->at[i]; }

    template <int... I>
    constexpr vec<T, sizeof...(I)> swizzle() const {
        return {this->at[I]...};
    }
    template <int... I>
    constexpr Parts<T, N, I...> parts() {
        return {*this};
    }
    /// SYCL's; to the nearest real, to the whole number towards 0.
    template <class A, rounding_mode R = rounding_mode::automatic>
    requires(R == rounding_mode::automatic) constexpr vec<A, N> convert() const { return vec<A, N>(*this); }
    /// SYCL's; the same bytes as another vector.
    template <class V>
    requires(sizeof(V) == sizeof(T) * N) constexpr V as() const { return std::bit_cast<V>(*this); }
    static constexpr int size() { return N; }

private:
    template <class A>
    constexpr void fill(int& filled, const A& value) {
        if constexpr (requires { value.at; }) {
            for (const auto one : value.at)
                if (filled < N) this->at[filled++] = static_cast<T>(one);
        } else {
            if (filled < N) this->at[filled++] = static_cast<T>(value);
        }
    }
};

/// Components of a vector that are assigned to: `v.xy += w`.
template <class T, int N, int... I>
struct Parts {
    vec<T, N>& whole;
    template <class A>
    const Parts& operator=(const A& value) const {
        const vec<T, sizeof...(I)> now(value);
        int i = 0;
        ((whole.at[I] = now.at[i++]), ...);
        return *this;
    }
    template <class A>
    const Parts& operator+=(const A& value) const {
        return *this = whole.template swizzle<I...>() + value;
    }
    template <class A>
    const Parts& operator-=(const A& value) const {
        return *this = whole.template swizzle<I...>() - value;
    }
    template <class A>
    const Parts& operator*=(const A& value) const {
        return *this = whole.template swizzle<I...>() * value;
    }
    template <class A>
    const Parts& operator/=(const A& value) const {
        return *this = whole.template swizzle<I...>() / value;
    }
};

#define PORTTOOL_BINARY(op)                                                                   \
    template <class A, class B, int N>                                                        \
    constexpr auto operator op(const vec<A, N>& a, const vec<B, N>& b) {                      \
        vec<std::common_type_t<A, B>, N> out{};                                               \
        for (int i = 0; i < N; ++i) out.at[i] = a.at[i] op b.at[i];                           \
        return out;                                                                           \
    }                                                                                         \
    template <class A, Number B, int N>                                                       \
    constexpr auto operator op(const vec<A, N>& a, B b) {                                     \
        using T = ByNumber<A, B>;                                                             \
        vec<T, N> out{};                                                                      \
        for (int i = 0; i < N; ++i) out.at[i] = static_cast<T>(a.at[i]) op static_cast<T>(b); \
        return out;                                                                           \
    }                                                                                         \
    template <Number A, class B, int N>                                                       \
    constexpr auto operator op(A a, const vec<B, N>& b) {                                     \
        using T = ByNumber<B, A>;                                                             \
        vec<T, N> out{};                                                                      \
        for (int i = 0; i < N; ++i) out.at[i] = static_cast<T>(a) op static_cast<T>(b.at[i]); \
        return out;                                                                           \
    }                                                                                         \
    template <class A, class B, int N>                                                        \
    constexpr vec<A, N>& operator op##=(vec<A, N>& a, const B& b) {                           \
        return a = a op b;                                                                    \
    }
PORTTOOL_BINARY(+)
PORTTOOL_BINARY(-)
PORTTOOL_BINARY(*)
PORTTOOL_BINARY(/)
PORTTOOL_BINARY(%)
PORTTOOL_BINARY(&)
PORTTOOL_BINARY(|)
PORTTOOL_BINARY(^)
PORTTOOL_BINARY(<<)
PORTTOOL_BINARY(>>)
#undef PORTTOOL_BINARY

template <class T, int N>
constexpr vec<T, N> operator-(const vec<T, N>& v) {
    vec<T, N> out{};
    for (int i = 0; i < N; ++i) out.at[i] = -v.at[i];
    return out;
}
template <class T, int N>
constexpr vec<T, N> operator+(const vec<T, N>& v) {
    return v;
}
template <class T, int N>
constexpr vec<T, N> operator~(const vec<T, N>& v) {
    vec<T, N> out{};
    for (int i = 0; i < N; ++i) out.at[i] = ~v.at[i];
    return out;
}
template <class T, int N>
constexpr bool operator==(const vec<T, N>& a, const vec<T, N>& b) {
    for (int i = 0; i < N; ++i)
        if (!(a.at[i] == b.at[i])) return false;
    return true;
}
template <class T, int N>
constexpr bool operator!=(const vec<T, N>& a, const vec<T, N>& b) {
    return !(a == b);
}

using uint = unsigned int;
using uchar = unsigned char;
using schar = signed char;
using ushort = unsigned short;
using ulong = unsigned long;
using longlong = long long;
using ulonglong = unsigned long long;
using half = _Float16;

template <class T>
struct vec1 {
    T x;
};

#define PORTTOOL_VECTORS(T, cuda)                       \
    using cuda##1 = vec1<T>;                            \
    using cuda##2 = vec<T, 2>;                          \
    using cuda##3 = vec<T, 3>;                          \
    using cuda##4 = vec<T, 4>;                          \
    template <class... A>                               \
    constexpr vec<T, 2> make_##cuda##2(const A&... a) { \
        return {a...};                                  \
    }                                                   \
    template <class... A>                               \
    constexpr vec<T, 3> make_##cuda##3(const A&... a) { \
        return {a...};                                  \
    }                                                   \
    template <class... A>                               \
    constexpr vec<T, 4> make_##cuda##4(const A&... a) { \
        return {a...};                                  \
    }
PORTTOOL_VECTORS(float, float)
PORTTOOL_VECTORS(double, double)
PORTTOOL_VECTORS(int, int)
PORTTOOL_VECTORS(unsigned int, uint)
PORTTOOL_VECTORS(char, char)
PORTTOOL_VECTORS(unsigned char, uchar)
PORTTOOL_VECTORS(short, short)
PORTTOOL_VECTORS(unsigned short, ushort)
PORTTOOL_VECTORS(long, long)
PORTTOOL_VECTORS(unsigned long, ulong)
PORTTOOL_VECTORS(long long, longlong)
PORTTOOL_VECTORS(bool, bool)
PORTTOOL_VECTORS(_Float16, half)
#undef PORTTOOL_VECTORS
using vec2 = vec<float, 2>;
using vec3 = vec<float, 3>;
using vec4 = vec<float, 4>;
using dvec2 = vec<double, 2>;
using dvec3 = vec<double, 3>;
using dvec4 = vec<double, 4>;
using ivec2 = vec<int, 2>;
using ivec3 = vec<int, 3>;
using ivec4 = vec<int, 4>;
using uvec2 = vec<unsigned int, 2>;
using uvec3 = vec<unsigned int, 3>;
using uvec4 = vec<unsigned int, 4>;
using bvec2 = vec<bool, 2>;
using bvec3 = vec<bool, 3>;
using bvec4 = vec<bool, 4>;

// ---- Functions of each component; those of one number that <cmath> has are taken from there ----

#define PORTTOOL_EACH(name, expression)                              \
    template <class T, int N>                                        \
    constexpr auto name(const vec<T, N>& v) {                        \
        vec<decltype(expression(T())), N> out{};                     \
        for (int i = 0; i < N; ++i) out.at[i] = expression(v.at[i]); \
        return out;                                                  \
    }
#define PORTTOOL_OF_CMATH(name) \
    template <Number T>         \
    constexpr auto name(T x) {  \
        return std::name(x);    \
    }                           \
    PORTTOOL_EACH(name, std::name)
PORTTOOL_OF_CMATH(abs)
PORTTOOL_OF_CMATH(fabs)
PORTTOOL_OF_CMATH(sqrt)
PORTTOOL_OF_CMATH(cbrt)
PORTTOOL_OF_CMATH(sin)
PORTTOOL_OF_CMATH(cos)
PORTTOOL_OF_CMATH(tan)
PORTTOOL_OF_CMATH(asin)
PORTTOOL_OF_CMATH(acos)
PORTTOOL_OF_CMATH(atan)
PORTTOOL_OF_CMATH(sinh)
PORTTOOL_OF_CMATH(cosh)
PORTTOOL_OF_CMATH(tanh)
PORTTOOL_OF_CMATH(exp)
PORTTOOL_OF_CMATH(exp2)
PORTTOOL_OF_CMATH(log)
PORTTOOL_OF_CMATH(log2)
PORTTOOL_OF_CMATH(log10)
PORTTOOL_OF_CMATH(floor)
PORTTOOL_OF_CMATH(ceil)
PORTTOOL_OF_CMATH(trunc)
PORTTOOL_OF_CMATH(round)
PORTTOOL_OF_CMATH(rint)
PORTTOOL_OF_CMATH(isnan)
PORTTOOL_OF_CMATH(isinf)
PORTTOOL_OF_CMATH(isfinite)
#undef PORTTOOL_OF_CMATH

/// A float stays one; whole numbers become floats, as in the shading languages.
template <class T>
using Real = std::conditional_t<std::is_same_v<T, double>, double, float>;

#define PORTTOOL_OWN(name, expression)     \
    template <Number T>                    \
    constexpr Real<T> name(T value) {      \
        using R = Real<T>;                 \
        const R x = static_cast<R>(value); \
        return static_cast<R>(expression); \
    }                                      \
    PORTTOOL_EACH(name, name)
PORTTOOL_OWN(fract, x - std::floor(x))
PORTTOOL_OWN(frac, x - std::floor(x))
PORTTOOL_OWN(inversesqrt, R(1) / std::sqrt(x))
PORTTOOL_OWN(rsqrt, R(1) / std::sqrt(x))
PORTTOOL_OWN(rsqrtf, R(1) / std::sqrt(x))
PORTTOOL_OWN(native_rsqrt, R(1) / std::sqrt(x))
PORTTOOL_OWN(half_rsqrt, R(1) / std::sqrt(x))
PORTTOOL_OWN(rcp, R(1) / x)
PORTTOOL_OWN(native_recip, R(1) / x)
PORTTOOL_OWN(half_recip, R(1) / x)
PORTTOOL_OWN(__frcp_rn, R(1) / x)
PORTTOOL_OWN(saturate, (x > R(0) ? (x < R(1) ? x : R(1)) : R(0)))
PORTTOOL_OWN(__saturatef, (x > R(0) ? (x < R(1) ? x : R(1)) : R(0)))
PORTTOOL_OWN(radians, x* R(0.017453292519943295))
PORTTOOL_OWN(degrees, x* R(57.29577951308232))
PORTTOOL_OWN(roundEven, std::nearbyint(x))
PORTTOOL_OWN(native_sqrt, std::sqrt(x))
PORTTOOL_OWN(half_sqrt, std::sqrt(x))
PORTTOOL_OWN(__fsqrt_rn, std::sqrt(x))
PORTTOOL_OWN(native_sin, std::sin(x))
PORTTOOL_OWN(native_cos, std::cos(x))
PORTTOOL_OWN(native_tan, std::tan(x))
PORTTOOL_OWN(native_exp, std::exp(x))
PORTTOOL_OWN(native_exp2, std::exp2(x))
PORTTOOL_OWN(native_log, std::log(x))
PORTTOOL_OWN(native_log2, std::log2(x))
PORTTOOL_OWN(half_sin, std::sin(x))
PORTTOOL_OWN(half_cos, std::cos(x))
PORTTOOL_OWN(half_exp, std::exp(x))
PORTTOOL_OWN(half_log, std::log(x))
PORTTOOL_OWN(exp10, std::pow(R(10), x))
PORTTOOL_OWN(cospi, std::cos(x* R(3.141592653589793)))
PORTTOOL_OWN(sinpi, std::sin(x* R(3.141592653589793)))
PORTTOOL_OWN(cospif, std::cos(x* R(3.141592653589793)))
PORTTOOL_OWN(sinpif, std::sin(x* R(3.141592653589793)))
#undef PORTTOOL_OWN

template <Number T>
constexpr T sign(T x) {
    return static_cast<T>((x > T(0)) - (x < T(0)));
}
PORTTOOL_EACH(sign, sign)
template <Number T>
constexpr int firstbithigh(T x) {
    return x == 0 ? -1 : 31 - std::countl_zero(static_cast<uint32_t>(x));
}
template <Number T>
constexpr uint32_t bitfieldReverse(T value) {
    uint32_t x = static_cast<uint32_t>(value), out = 0;
    for (int i = 0; i < 32; ++i) out = (out << 1) | ((x >> i) & 1u);
    return out;
}
template <Number T>
constexpr uint32_t __brev(T x) {
    return bitfieldReverse(x);
}
template <Number T>
constexpr uint32_t reversebits(T x) {
    return bitfieldReverse(x);
}
template <Number T>
constexpr int bitCount(T x) {
    return std::popcount(static_cast<std::make_unsigned_t<T>>(x));
}
template <Number T>
constexpr int popcount(T x) {
    return bitCount(x);
}
template <Number T>
constexpr int countbits(T x) {
    return bitCount(x);
}
template <Number T>
constexpr int __popc(T x) {
    return bitCount(x);
}
template <Number T>
constexpr int __popcll(T x) {
    return bitCount(x);
}
template <Number T>
constexpr int clz(T x) {
    return std::countl_zero(static_cast<std::make_unsigned_t<T>>(x));
}
template <Number T>
constexpr int __clz(T x) {
    return std::countl_zero(static_cast<uint32_t>(x));
}
template <Number T>
constexpr int __clzll(T x) {
    return std::countl_zero(static_cast<uint64_t>(x));
}
template <Number T>
constexpr int __ffs(T x) {
    return x == 0 ? 0 : std::countr_zero(static_cast<uint32_t>(x)) + 1;
}
template <Number T>
constexpr int ctz(T x) {
    return std::countr_zero(static_cast<std::make_unsigned_t<T>>(x));
}
template <Number T>
constexpr int findLSB(T x) {
    return x == 0 ? -1 : std::countr_zero(static_cast<uint32_t>(x));
}
template <Number T>
constexpr int firstbitlow(T x) {
    return findLSB(x);
}
template <Number T>
constexpr int findMSB(T value) {
    const auto x = static_cast<uint32_t>(value);
    const uint32_t bits = std::is_signed_v<T> && value < 0 ? ~x : x;
    return bits == 0 ? -1 : 31 - std::countl_zero(bits);
}
template <Number T>
constexpr T bitfieldExtract(T value, int offset, int bits) {
    if (bits == 0) return 0;
    using U = std::make_unsigned_t<T>;
    const int spare = static_cast<int>(sizeof(T)) * 8 - bits;
    return static_cast<T>(static_cast<T>(static_cast<U>(value) << (spare - offset)) >> spare);
}

#define PORTTOOL_BITS(name, To, From)                                                          \
    template <class T>                                                                         \
    requires(sizeof(T) == sizeof(From) && Number<T>) constexpr To name(T x) {                  \
        return std::bit_cast<To>(static_cast<From>(x));                                        \
    }                                                                                          \
    template <class T, int N>                                                                  \
    constexpr vec<To, N> name(const vec<T, N>& v) {                                            \
        vec<To, N> out{};                                                                      \
        for (int i = 0; i < N; ++i) out.at[i] = std::bit_cast<To>(static_cast<From>(v.at[i])); \
        return out;                                                                            \
    }
PORTTOOL_BITS(floatBitsToUint, uint32_t, float)
PORTTOOL_BITS(floatBitsToInt, int32_t, float)
PORTTOOL_BITS(uintBitsToFloat, float, uint32_t)
PORTTOOL_BITS(intBitsToFloat, float, int32_t)
PORTTOOL_BITS(__float_as_uint, uint32_t, float)
PORTTOOL_BITS(__float_as_int, int32_t, float)
PORTTOOL_BITS(__uint_as_float, float, uint32_t)
PORTTOOL_BITS(__int_as_float, float, int32_t)
PORTTOOL_BITS(float_as_uint, uint32_t, float)
PORTTOOL_BITS(float_as_int, int32_t, float)
PORTTOOL_BITS(uint_as_float, float, uint32_t)
PORTTOOL_BITS(int_as_float, float, int32_t)
PORTTOOL_BITS(__double_as_longlong, long long, double)
PORTTOOL_BITS(__longlong_as_double, double, long long)
#undef PORTTOOL_BITS
#define PORTTOOL_AS(name, To)                                                                              \
    template <class T>                                                                                     \
    requires(sizeof(T) == sizeof(To) && Number<T>) constexpr To name(T x) { return std::bit_cast<To>(x); } \
    template <class T, int N>                                                                              \
    constexpr vec<To, N> name(const vec<T, N>& v) {                                                        \
        vec<To, N> out{};                                                                                  \
        for (int i = 0; i < N; ++i) out.at[i] = std::bit_cast<To>(v.at[i]);                                \
        return out;                                                                                        \
    }
PORTTOOL_AS(as_float, float)
PORTTOOL_AS(as_int, int32_t)
PORTTOOL_AS(as_uint, uint32_t)
PORTTOOL_AS(asfloat, float)
PORTTOOL_AS(asint, int32_t)
PORTTOOL_AS(asuint, uint32_t)
PORTTOOL_AS(as_double, double)
PORTTOOL_AS(as_long, int64_t)
PORTTOOL_AS(as_ulong, uint64_t)
#undef PORTTOOL_AS

/// A number within the range of another type, rounded to zero: OpenCL's convert_*, CUDA's __float2int_rz.
#define PORTTOOL_CONVERT(name, To, rounded) \
    template <Number T>                     \
    constexpr To name(T x) {                \
        return static_cast<To>(rounded);    \
    }                                       \
    PORTTOOL_EACH(name, name)
PORTTOOL_CONVERT(convert_float, float, x)
PORTTOOL_CONVERT(convert_double, double, x)
PORTTOOL_CONVERT(convert_int, int, x)
PORTTOOL_CONVERT(convert_uint, unsigned int, x)
PORTTOOL_CONVERT(convert_uchar, unsigned char, x)
PORTTOOL_CONVERT(convert_char, signed char, x)
PORTTOOL_CONVERT(convert_short, short, x)
PORTTOOL_CONVERT(convert_ushort, unsigned short, x)
PORTTOOL_CONVERT(convert_int_rtz, int, std::trunc(x))
PORTTOOL_CONVERT(__float2int_rz, int, std::trunc(x))
PORTTOOL_CONVERT(__float2int_rn, int, std::nearbyint(x))
PORTTOOL_CONVERT(__float2int_rd, int, std::floor(x))
PORTTOOL_CONVERT(__float2int_ru, int, std::ceil(x))
PORTTOOL_CONVERT(__float2uint_rz, unsigned int, std::trunc(x))
PORTTOOL_CONVERT(__float2uint_rn, unsigned int, std::nearbyint(x))
PORTTOOL_CONVERT(__int2float_rn, float, x)
PORTTOOL_CONVERT(__uint2float_rn, float, x)
PORTTOOL_CONVERT(__half2float, float, x)
PORTTOOL_CONVERT(__float2half, _Float16, x)
#undef PORTTOOL_CONVERT
constexpr _Float16 fmax(_Float16 a, _Float16 b) { return b != b || a > b ? a : b; }
constexpr _Float16 fmin(_Float16 a, _Float16 b) { return b != b || a < b ? a : b; }
#define PORTTOOL_CONVERT_VECTORS(T, name)                       \
    template <class A>                                          \
    constexpr vec<T, 2> convert_##name##2(const vec<A, 2>& v) { \
        return v;                                               \
    }                                                           \
    template <class A>                                          \
    constexpr vec<T, 3> convert_##name##3(const vec<A, 3>& v) { \
        return v;                                               \
    }                                                           \
    template <class A>                                          \
    constexpr vec<T, 4> convert_##name##4(const vec<A, 4>& v) { \
        return v;                                               \
    }
PORTTOOL_CONVERT_VECTORS(float, float)
PORTTOOL_CONVERT_VECTORS(int, int)
PORTTOOL_CONVERT_VECTORS(unsigned int, uint)
#undef PORTTOOL_CONVERT_VECTORS

// ---- Functions of two and three values, numbers or vectors, mixed as the languages have them ----

template <class T>
struct IsVector : std::false_type {};
template <class T, int N>
struct IsVector<vec<T, N>> : std::true_type {};

/// The component i of a vector, or the number itself.
template <class T>
constexpr auto part(const T& value, int i) {
    if constexpr (IsVector<T>::value)
        return value.at[i];
    else
        return value;
}

#define PORTTOOL_TWO(name, expression)                                                              \
    template <Number A, Number B>                                                                   \
    constexpr auto name(A first, B second) {                                                        \
        using R = std::common_type_t<A, B>;                                                         \
        const R a = static_cast<R>(first), b = static_cast<R>(second);                              \
        return static_cast<R>(expression);                                                          \
    }                                                                                               \
    template <class A, int N, class B>                                                              \
    constexpr vec<A, N> name(const vec<A, N>& first, const B& second) {                             \
        vec<A, N> out{};                                                                            \
        for (int i = 0; i < N; ++i) out.at[i] = name(first.at[i], static_cast<A>(part(second, i))); \
        return out;                                                                                 \
    }                                                                                               \
    template <Number A, class B, int N>                                                             \
    constexpr vec<B, N> name(A first, const vec<B, N>& second) {                                    \
        vec<B, N> out{};                                                                            \
        for (int i = 0; i < N; ++i) out.at[i] = name(static_cast<B>(first), second.at[i]);          \
        return out;                                                                                 \
    }
PORTTOOL_TWO(min, (b < a ? b : a))
PORTTOOL_TWO(max, (a < b ? b : a))
PORTTOOL_TWO(mod, (a - b * std::floor(a / b)))
PORTTOOL_TWO(step, (b < a ? R(0) : R(1)))
PORTTOOL_TWO(native_powr, std::pow(a, b))
PORTTOOL_TWO(powr, std::pow(a, b))
PORTTOOL_TWO(native_divide, (a / b))
PORTTOOL_TWO(__fdividef, (a / b))
PORTTOOL_TWO(fdividef, (a / b))
PORTTOOL_TWO(__fdiv_rn, (a / b))
PORTTOOL_TWO(__fmul_rn, (a * b))
PORTTOOL_TWO(__fadd_rn, (a + b))
PORTTOOL_TWO(__fsub_rn, (a - b))
PORTTOOL_TWO(__dmul_rn, (a * b))
PORTTOOL_TWO(__dadd_rn, (a + b))
PORTTOOL_TWO(mul24, (a * b))
PORTTOOL_TWO(__mul24, (a * b))
PORTTOOL_TWO(rotate, ((a << (b & 31)) | (static_cast<std::make_unsigned_t<R>>(a) >> ((32 - b) & 31))))
#define PORTTOOL_TWO_OF_CMATH(name) \
    template <Number A, Number B>   \
    constexpr auto name(A a, B b) { \
        return std::name(a, b);     \
    }                               \
    PORTTOOL_TWO_OF_CMATH_VECTORS_(name)
#define PORTTOOL_TWO_OF_CMATH_VECTORS_(name)                                                             \
    template <class A, int N, class B>                                                                   \
    constexpr vec<A, N> name(const vec<A, N>& first, const B& second) {                                  \
        vec<A, N> out{};                                                                                 \
        for (int i = 0; i < N; ++i) out.at[i] = std::name(first.at[i], static_cast<A>(part(second, i))); \
        return out;                                                                                      \
    }
PORTTOOL_TWO_OF_CMATH(pow)
PORTTOOL_TWO_OF_CMATH(fmod)
PORTTOOL_TWO_OF_CMATH(fmin)
PORTTOOL_TWO_OF_CMATH(fmax)
PORTTOOL_TWO_OF_CMATH(atan2)
PORTTOOL_TWO_OF_CMATH(copysign)
#undef PORTTOOL_TWO_OF_CMATH
#undef PORTTOOL_TWO_OF_CMATH_VECTORS_
#undef PORTTOOL_TWO
template <Number A, Number B>
constexpr auto atan(A y, B x) {
    return std::atan2(y, x);
}

// What C has for floats alone, so that a project's own for vectors do not hide them.
#define PORTTOOL_SINGLE(name)                 \
    template <Number A>                       \
    float name(A a) {                         \
        return ::name(static_cast<float>(a)); \
    }
PORTTOOL_SINGLE(sqrtf)
PORTTOOL_SINGLE(sinf)
PORTTOOL_SINGLE(cosf)
PORTTOOL_SINGLE(tanf)
PORTTOOL_SINGLE(asinf)
PORTTOOL_SINGLE(acosf)
PORTTOOL_SINGLE(atanf)
PORTTOOL_SINGLE(sinhf)
PORTTOOL_SINGLE(coshf)
PORTTOOL_SINGLE(tanhf)
PORTTOOL_SINGLE(expf)
PORTTOOL_SINGLE(exp2f)
PORTTOOL_SINGLE(expm1f)
PORTTOOL_SINGLE(logf)
PORTTOOL_SINGLE(log2f)
PORTTOOL_SINGLE(log10f)
PORTTOOL_SINGLE(log1pf)
PORTTOOL_SINGLE(floorf)
PORTTOOL_SINGLE(ceilf)
PORTTOOL_SINGLE(truncf)
PORTTOOL_SINGLE(roundf)
PORTTOOL_SINGLE(rintf)
PORTTOOL_SINGLE(nearbyintf)
PORTTOOL_SINGLE(fabsf)
PORTTOOL_SINGLE(cbrtf)
PORTTOOL_SINGLE(erff)
#undef PORTTOOL_SINGLE
#define PORTTOOL_SINGLE_OF_TWO(name)                                 \
    template <Number A, Number B>                                    \
    float name(A a, B b) {                                           \
        return ::name(static_cast<float>(a), static_cast<float>(b)); \
    }
PORTTOOL_SINGLE_OF_TWO(powf)
PORTTOOL_SINGLE_OF_TWO(fmodf)
PORTTOOL_SINGLE_OF_TWO(fminf)
PORTTOOL_SINGLE_OF_TWO(fmaxf)
PORTTOOL_SINGLE_OF_TWO(atan2f)
PORTTOOL_SINGLE_OF_TWO(copysignf)
PORTTOOL_SINGLE_OF_TWO(hypotf)
PORTTOOL_SINGLE_OF_TWO(remainderf)
#undef PORTTOOL_SINGLE_OF_TWO

template <class X, class L, class H>
constexpr auto clamp(const X& x, const L& low, const H& high) {
    return min(max(x, low), high);
}
template <class A, class B, class T>
constexpr auto mix(const A& a, const B& b, const T& t) {
    if constexpr (std::is_same_v<T, bool>)
        return t ? b : a;
    else if constexpr (IsVector<T>::value) {
        if constexpr (std::is_same_v<decltype(t.x), const bool> || std::is_same_v<decltype(t.x), bool>) {
            A out{};
            for (size_t i = 0; i < sizeof(out.at) / sizeof(out.at[0]); ++i) out.at[i] = t.at[i] ? b.at[i] : a.at[i];
            return out;
        } else
            return a * (1 - t) + b * t;
    } else
        return a * (T(1) - t) + b * t;
}
template <class A, class B, class T>
constexpr auto lerp(const A& a, const B& b, const T& t) {
    return a + (b - a) * t;
}
template <class A, class B, class X>
constexpr auto smoothstep(const A& low, const B& high, const X& x) {
    const auto t = clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}
template <class A, class B, class C>
constexpr auto mad(const A& a, const B& b, const C& c) {
    return a * b + c;
}
template <class T, int N>
constexpr vec<T, N> fma(const vec<T, N>& a, const vec<T, N>& b, const vec<T, N>& c) {
    vec<T, N> out{};
    for (int i = 0; i < N; ++i) out.at[i] = std::fma(a.at[i], b.at[i], c.at[i]);
    return out;
}
template <Number A, Number B, Number C>
constexpr float __fmaf_rn(A a, B b, C c) {
    return std::fma(static_cast<float>(a), static_cast<float>(b), static_cast<float>(c));
}
template <class A, class B>
constexpr uint32_t __umulhi(A a, B b) {
    return static_cast<uint32_t>((static_cast<uint64_t>(static_cast<uint32_t>(a)) * static_cast<uint32_t>(b)) >> 32);
}
template <class A, class B>
constexpr uint32_t mul_hi(A a, B b) {
    return __umulhi(a, b);
}
/// Four products of bytes, added up.
constexpr int __dp4a(int a, int b, int sum) {
    for (int i = 0; i < 32; i += 8) sum += static_cast<signed char>(a >> i) * static_cast<signed char>(b >> i);
    return sum;
}
constexpr unsigned int __dp4a(unsigned int a, unsigned int b, unsigned int sum) {
    for (int i = 0; i < 32; i += 8) sum += ((a >> i) & 0xffu) * ((b >> i) & 0xffu);
    return sum;
}
/// Four of the eight bytes of two words: a digit of the selector tells which, and its highest bit asks for the sign.
template <class A, class B, class S>
constexpr uint32_t __byte_perm(A low, B high, S selector) {
    const uint64_t bytes = static_cast<uint64_t>(static_cast<uint32_t>(high)) << 32 | static_cast<uint32_t>(low);
    uint32_t out = 0;
    for (int i = 0; i < 4; ++i) {
        const uint32_t digit = static_cast<uint32_t>(selector) >> (4 * i);
        uint32_t byte = static_cast<uint32_t>(bytes >> (8 * (digit & 7u))) & 0xffu;
        if ((digit & 8u) != 0) byte = (byte & 0x80u) != 0 ? 0xffu : 0;
        out |= byte << (8 * i);
    }
    return out;
}
template <Number A>
constexpr A pown(A x, int power) {
    return static_cast<A>(std::pow(x, static_cast<A>(power)));
}
constexpr _Float16 __low2half(const vec<_Float16, 2>& v) { return v.at[0]; }
constexpr _Float16 __high2half(const vec<_Float16, 2>& v) { return v.at[1]; }
constexpr vec<_Float16, 2> __hmul2(const vec<_Float16, 2>& a, const vec<_Float16, 2>& b) { return a * b; }
constexpr vec<_Float16, 2> __hadd2(const vec<_Float16, 2>& a, const vec<_Float16, 2>& b) { return a + b; }
constexpr vec<_Float16, 2> __hsub2(const vec<_Float16, 2>& a, const vec<_Float16, 2>& b) { return a - b; }
constexpr _Float16 __hmul(_Float16 a, _Float16 b) { return a * b; }
constexpr _Float16 __hadd(_Float16 a, _Float16 b) { return a + b; }
constexpr _Float16 __hsub(_Float16 a, _Float16 b) { return a - b; }
constexpr _Float16 __hdiv(_Float16 a, _Float16 b) { return a / b; }
constexpr float __low2float(const vec<_Float16, 2>& v) { return static_cast<float>(v.at[0]); }
constexpr float __high2float(const vec<_Float16, 2>& v) { return static_cast<float>(v.at[1]); }
constexpr vec<float, 2> __half22float2(const vec<_Float16, 2>& v) { return {__low2float(v), __high2float(v)}; }
template <class T>
constexpr T __ldg(const T* at) {
    return *at;
}
template <class T>
constexpr void sincos(T angle, T* sine, T* cosine) {
    *sine = std::sin(angle);
    *cosine = std::cos(angle);
}
template <class T>
constexpr T sincos(T angle, T* cosine) {
    *cosine = std::cos(angle);
    return std::sin(angle);
}

// ---- Geometry ----

template <class T, int N>
constexpr T dot(const vec<T, N>& a, const vec<T, N>& b) {
    T sum = a.at[0] * b.at[0];
    for (int i = 1; i < N; ++i) sum = sum + a.at[i] * b.at[i];
    return sum;
}
template <Number T>
constexpr T dot(T a, T b) {
    return a * b;
}
template <class T, int N>
constexpr vec<T, N> cross(const vec<T, N>& a, const vec<T, N>& b) {
    vec<T, N> out{};
    out.at[0] = a.at[1] * b.at[2] - b.at[1] * a.at[2];
    out.at[1] = a.at[2] * b.at[0] - b.at[2] * a.at[0];
    out.at[2] = a.at[0] * b.at[1] - b.at[0] * a.at[1];
    return out;
}
template <class T, int N>
constexpr T length(const vec<T, N>& v) {
    return std::sqrt(dot(v, v));
}
template <Number T>
constexpr T length(T x) {
    return std::abs(x);
}
template <class T, int N>
constexpr T fast_length(const vec<T, N>& v) {
    return length(v);
}
template <class T, int N>
constexpr T distance(const vec<T, N>& a, const vec<T, N>& b) {
    return length(a - b);
}
template <class T, int N>
constexpr vec<T, N> normalize(const vec<T, N>& v) {
    return v / length(v);
}
template <class T, int N>
constexpr vec<T, N> fast_normalize(const vec<T, N>& v) {
    return v / length(v);
}
template <class T, int N>
constexpr vec<T, N> reflect(const vec<T, N>& i, const vec<T, N>& n) {
    return i - 2.0f * dot(n, i) * n;
}
template <class T, int N>
constexpr vec<T, N> refract(const vec<T, N>& i, const vec<T, N>& n, T eta) {
    const T d = dot(n, i), k = T(1) - eta * eta * (T(1) - d * d);
    return k < T(0) ? vec<T, N>(T(0)) : eta * i - (eta * d + std::sqrt(k)) * n;
}
template <class T, int N>
constexpr vec<T, N> faceforward(const vec<T, N>& n, const vec<T, N>& i, const vec<T, N>& reference) {
    return dot(reference, i) < T(0) ? n : -n;
}

// ---- Comparisons of each component ----

#define PORTTOOL_COMPARE(name, op)                                        \
    template <class A, class B, int N>                                    \
    constexpr vec<bool, N> name(const vec<A, N>& a, const vec<B, N>& b) { \
        vec<bool, N> out{};                                               \
        for (int i = 0; i < N; ++i) out.at[i] = a.at[i] op b.at[i];       \
        return out;                                                       \
    }
PORTTOOL_COMPARE(lessThan, <)
PORTTOOL_COMPARE(lessThanEqual, <=)
PORTTOOL_COMPARE(greaterThan, >)
PORTTOOL_COMPARE(greaterThanEqual, >=)
PORTTOOL_COMPARE(equal, ==)
PORTTOOL_COMPARE(notEqual, !=)
#undef PORTTOOL_COMPARE
template <class A, class B, int N>
constexpr vec<bool, N> operator<(const vec<A, N>& a, const vec<B, N>& b) {
    return lessThan(a, b);
}
template <class A, class B, int N>
constexpr vec<bool, N> operator>(const vec<A, N>& a, const vec<B, N>& b) {
    return greaterThan(a, b);
}
template <class T, int N>
constexpr bool any(const vec<T, N>& v) {
    for (const T one : v.at)
        if (one) return true;
    return false;
}
template <class T, int N>
constexpr bool all(const vec<T, N>& v) {
    for (const T one : v.at)
        if (!one) return false;
    return true;
}
template <Number T, class C>
constexpr T select(T no, T yes, C where) {
    return where ? yes : no;
}
template <class T, int N>
constexpr vec<T, N> select(const vec<T, N>& no, const vec<T, N>& yes, bool where) {
    return where ? yes : no;
}
#define PORTTOOL_RELATION(name, op) \
    template <Number A, Number B>   \
    constexpr int name(A a, B b) {  \
        return a op b;              \
    }
PORTTOOL_RELATION(isequal, ==)
PORTTOOL_RELATION(isnotequal, !=)
#undef PORTTOOL_RELATION
#undef PORTTOOL_EACH

// ---- Matrices, by columns ----

template <class T, int C, int R>
struct mat {
    vec<T, R> column[C];
    mat() = default;
    template <Number A>
    constexpr explicit mat(A diagonal) {
        for (int c = 0; c < C; ++c)
            for (int r = 0; r < R; ++r) column[c].at[r] = c == r ? static_cast<T>(diagonal) : T(0);
    }
    template <int D, int S>
    constexpr explicit mat(const mat<T, D, S>& other) {
        for (int c = 0; c < C; ++c)
            for (int r = 0; r < R; ++r) column[c].at[r] = c < D && r < S ? other.column[c].at[r] : c == r ? T(1) : T(0);
    }
    template <class A, class B, class... More>
    constexpr mat(const A& first, const B& second, const More&... more) {
        int filled = 0;
        fill(filled, first);
        fill(filled, second);
        (fill(filled, more), ...);
    }
    constexpr vec<T, R>& operator[](int i) { return column[i]; }
    constexpr const vec<T, R>& operator[](int i) const { return column[i]; }

private:
    template <class A>
    constexpr void fill(int& filled, const A& value) {
        if constexpr (IsVector<A>::value) {
            for (const auto one : value.at) put(filled, one);
        } else
            put(filled, value);
    }
    template <class A>
    constexpr void put(int& filled, A value) {
        if (filled < C * R) column[filled / R].at[filled % R] = static_cast<T>(value);
        ++filled;
    }
};
template <class T, int C, int R>
constexpr vec<T, R> operator*(const mat<T, C, R>& m, const vec<T, C>& v) {
    vec<T, R> sum = m.column[0] * v.at[0];
    for (int c = 1; c < C; ++c) sum = sum + m.column[c] * v.at[c];
    return sum;
}
template <class T, int C, int R>
constexpr vec<T, C> operator*(const vec<T, R>& v, const mat<T, C, R>& m) {
    vec<T, C> out{};
    for (int c = 0; c < C; ++c) out.at[c] = dot(v, m.column[c]);
    return out;
}
template <class T, int K, int R, int C>
constexpr mat<T, C, R> operator*(const mat<T, K, R>& a, const mat<T, C, K>& b) {
    mat<T, C, R> out{};
    for (int c = 0; c < C; ++c) out.column[c] = a * b.column[c];
    return out;
}
template <class T, int C, int R, Number A>
constexpr mat<T, C, R> operator*(const mat<T, C, R>& m, A scale) {
    mat<T, C, R> out{};
    for (int c = 0; c < C; ++c) out.column[c] = m.column[c] * scale;
    return out;
}
template <class T, int C, int R>
constexpr mat<T, R, C> transpose(const mat<T, C, R>& m) {
    mat<T, R, C> out{};
    for (int c = 0; c < C; ++c)
        for (int r = 0; r < R; ++r) out.column[r].at[c] = m.column[c].at[r];
    return out;
}
using mat2 = mat<float, 2, 2>;
using mat3 = mat<float, 3, 3>;
using mat4 = mat<float, 4, 4>;
using dmat2 = mat<double, 2, 2>;
using dmat3 = mat<double, 3, 3>;
using dmat4 = mat<double, 4, 4>;
using mat3x4 = mat<float, 3, 4>;
using mat4x3 = mat<float, 4, 3>;

// ---- What oneAPI adds to SYCL ----

namespace ext::oneapi {

/// The upper half of a float, to the nearest one, to an even one of two.
struct bfloat16 {
    uint16_t bits = 0;

    bfloat16() = default;
    constexpr bfloat16(float x) {
        const uint32_t all = std::bit_cast<uint32_t>(x);
        const bool is_nan = (all & 0x7fffffffu) > 0x7f800000u;
        bits = static_cast<uint16_t>(is_nan ? (all >> 16) | 0x40u : (all + 0x7fffu + ((all >> 16) & 1u)) >> 16);
    }
    constexpr operator float() const { return std::bit_cast<float>(static_cast<uint32_t>(bits) << 16); }
};

namespace experimental {
#define PORTTOOL_OF_BFLOAT16(name) \
    constexpr bfloat16 name(bfloat16 x) { return bfloat16(std::name(static_cast<float>(x))); }
PORTTOOL_OF_BFLOAT16(sqrt)
PORTTOOL_OF_BFLOAT16(exp)
PORTTOOL_OF_BFLOAT16(exp2)
PORTTOOL_OF_BFLOAT16(log)
PORTTOOL_OF_BFLOAT16(log2)
PORTTOOL_OF_BFLOAT16(log10)
PORTTOOL_OF_BFLOAT16(sin)
PORTTOOL_OF_BFLOAT16(cos)
PORTTOOL_OF_BFLOAT16(tanh)
PORTTOOL_OF_BFLOAT16(fabs)
PORTTOOL_OF_BFLOAT16(floor)
PORTTOOL_OF_BFLOAT16(ceil)
PORTTOOL_OF_BFLOAT16(trunc)
PORTTOOL_OF_BFLOAT16(rint)
#undef PORTTOOL_OF_BFLOAT16
constexpr bfloat16 fmin(bfloat16 a, bfloat16 b) {
    return bfloat16(std::fmin(static_cast<float>(a), static_cast<float>(b)));
}
constexpr bfloat16 fmax(bfloat16 a, bfloat16 b) {
    return bfloat16(std::fmax(static_cast<float>(a), static_cast<float>(b)));
}
constexpr bfloat16 fma(bfloat16 a, bfloat16 b, bfloat16 c) {
    return bfloat16(std::fma(static_cast<float>(a), static_cast<float>(b), static_cast<float>(c)));
}
}  // namespace experimental

}  // namespace ext::oneapi

}  // namespace porttool_prelude

// What a compiler of device code takes, and this one need not know.
#define __device__
#define __host__
#define __global__
#define __constant__
#define __shared__
#define __forceinline__ inline
#define __noinline__
#define __launch_bounds__(...)
#define __align__(n)
#define __managed__
#define __kernel
#define __constant
#define __global
#define __local
#define __private
#define __generic
#define SYCL_EXTERNAL
// The C library declares functions of these names and has none.
#define __sinf native_sin
#define __cosf native_cos
#define __tanf native_tan
#define __expf native_exp
#define __logf native_log
#define __log2f native_log2
#define __log10f log10f
#define __powf native_powr
#define __exp10f exp10
#define __sincosf sincos
#ifndef M_PI_F
#define M_PI_F 3.14159274101257f
#define M_1_PI_F 0.31830987334251f
#define M_PI_2_F 1.57079637050629f
#endif
#ifndef CUDART_PI_F
#define CUDART_PI_F 3.141592654f
#define CUDART_INF_F INFINITY
#endif
