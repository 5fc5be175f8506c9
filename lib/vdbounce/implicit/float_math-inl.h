// SPDX-License-Identifier: Apache-2.0
//
// Exponential and logarithm of vectors of floats. Highway's own (contrib/math) fuse products with sums where a
// processor can, so that their last bits depend on it; these do not. Polynomials of Moshier's Cephes library (expf,
// logf), relative error 2e-7. Compiled once for each target.

#if defined(VDBOUNCE_IMPLICIT_FLOAT_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VDBOUNCE_IMPLICIT_FLOAT_MATH_INL_H_
#undef VDBOUNCE_IMPLICIT_FLOAT_MATH_INL_H_
#else
#define VDBOUNCE_IMPLICIT_FLOAT_MATH_INL_H_
#endif

#include <cstddef>
#include <cstdint>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// ln 2 in two parts, the first of few digits.
constexpr float kLn2High = 0.693359375f;
constexpr float kLn2Low = -2.12194440e-4f;

template <class D, class V, std::size_t count> HWY_INLINE V polynomial(D d, V x, const float (&coefficients)[count])
{
    V sum = hn::Set(d, coefficients[0]);
    for (std::size_t i = 1; i < count; ++i) sum = hn::Add(hn::Mul(sum, x), hn::Set(d, coefficients[i]));
    return sum;
}

// e^x for x within -80 and 80.
template <class D, class V> HWY_INLINE V exponential(D d, V x)
{
    constexpr float kExp[] = {1.9875691500e-4f, 1.3981999507e-3f, 8.3334519073e-3f,
                              4.1665795894e-2f, 1.6666665459e-1f, 5.0000001201e-1f};
    const hn::RebindToSigned<D> di;
    const V powers = hn::Round(hn::Mul(x, hn::Set(d, 1.44269504088896341f)));
    V rest = hn::Sub(x, hn::Mul(powers, hn::Set(d, kLn2High)));
    rest = hn::Sub(rest, hn::Mul(powers, hn::Set(d, kLn2Low)));
    const V curve = hn::Mul(polynomial(d, rest, kExp), hn::Mul(rest, rest));
    const V mantissa = hn::Add(hn::Add(curve, rest), hn::Set(d, 1.0f));
    const auto exponent = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, powers), hn::Set(di, 127)));
    return hn::Mul(mantissa, hn::BitCast(d, exponent));
}

// ln x for normal numbers above zero.
template <class D, class V> HWY_INLINE V logarithm(D d, V x)
{
    constexpr float kLog[] = {7.0376836292e-2f,  -1.1514610310e-1f, 1.1676998740e-1f,
                              -1.2420140846e-1f, 1.4249322787e-1f,  -1.6668057665e-1f,
                              2.0000714765e-1f,  -2.4999993993e-1f, 3.3333331174e-1f};
    constexpr float kRootOfHalf = 0.707106781186547524f;
    const hn::RebindToSigned<D> di;
    const auto bits = hn::BitCast(di, x);
    const auto mantissaBits = hn::Or(hn::And(bits, hn::Set(di, 0x007fffff)), hn::Set(di, 0x3f000000));
    const V mantissa = hn::BitCast(d, mantissaBits); // 0.5 to 1
    const V power = hn::ConvertTo(d, hn::Sub(hn::ShiftRight<23>(bits), hn::Set(di, 126)));
    const auto small = hn::Lt(mantissa, hn::Set(d, kRootOfHalf));
    const V e = hn::Sub(power, hn::IfThenElseZero(small, hn::Set(d, 1.0f)));
    const V m = hn::Sub(hn::Add(mantissa, hn::IfThenElseZero(small, mantissa)), hn::Set(d, 1.0f));
    const V square = hn::Mul(m, m);
    V rest = hn::Mul(hn::Mul(polynomial(d, m, kLog), m), square);
    rest = hn::Add(rest, hn::Mul(e, hn::Set(d, kLn2Low)));
    rest = hn::Sub(rest, hn::Mul(square, hn::Set(d, 0.5f)));
    return hn::Add(hn::Add(m, rest), hn::Mul(e, hn::Set(d, kLn2High)));
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#endif
