// Vectors of up to eight doubles and three-vectors of them; included once for every instruction set. The fixed order of
// every sum, fused multiply-adds included, is what makes the bits independent of the width.
#if defined(KNAP_CORE_VECTOR3_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef KNAP_CORE_VECTOR3_INL_HPP
#undef KNAP_CORE_VECTOR3_INL_HPP
#else
#define KNAP_CORE_VECTOR3_INL_HPP
#endif

#include <hwy/highway.h>

#include "core/types.hpp"

HWY_BEFORE_NAMESPACE();
namespace knap {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;
using V = hn::Vec<Tag>;
using M = hn::Mask<Tag>;
inline constexpr Index width = static_cast<Index>(hn::MaxLanes(Tag()));  ///< lanes of a vector

struct Vec3V {
  V x, y, z;
};

HWY_INLINE V dot(const Vec3V& a, const Vec3V& b) {
  return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
HWY_INLINE Vec3V cross(const Vec3V& a, const Vec3V& b) {
  return {hn::NegMulAdd(a.z, b.y, hn::Mul(a.y, b.z)), hn::NegMulAdd(a.x, b.z, hn::Mul(a.z, b.x)),
          hn::NegMulAdd(a.y, b.x, hn::Mul(a.x, b.y))};
}
HWY_INLINE Vec3V scaled(V s, const Vec3V& a) { return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)}; }
// s a + b
HWY_INLINE Vec3V scaled_sum(V s, const Vec3V& a, const Vec3V& b) {
  return {hn::MulAdd(s, a.x, b.x), hn::MulAdd(s, a.y, b.y), hn::MulAdd(s, a.z, b.z)};
}
HWY_INLINE Vec3V sum(const Vec3V& a, const Vec3V& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vec3V difference(const Vec3V& a, const Vec3V& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

}  // namespace HWY_NAMESPACE
}  // namespace knap
HWY_AFTER_NAMESPACE();
#endif
