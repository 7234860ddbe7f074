// Rows of four doubles (nodal vectors) to vectors over tets and back; included once for every instruction set.
#if defined(KNAP_FEM_VECTOR_TRANSPOSE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef KNAP_FEM_VECTOR_TRANSPOSE_INL_HPP
#undef KNAP_FEM_VECTOR_TRANSPOSE_INL_HPP
#else
#define KNAP_FEM_VECTOR_TRANSPOSE_INL_HPP
#endif

#include <hwy/highway.h>

#include "fem/element_blocks.hpp"

HWY_BEFORE_NAMESPACE();
namespace knap {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, std::size_t{lanes}>;
using V = hn::Vec<Tag>;
inline constexpr Index width = static_cast<Index>(hn::MaxLanes(Tag()));  ///< tets of a vector

struct Vec3V {
  V x, y, z;
};

#if HWY_TARGET == HWY_AVX3
using HalfTag = hn::Half<Tag>;
/// Four rows a register pair: pair p of lanes 4h + {0,2} and 4h + {1,3}, h = half.
struct Rows {
  V pair[4];
};

HWY_INLINE V load_pair(const double* low, const double* high) {
  return hn::Combine(Tag(), hn::Load(HalfTag(), high), hn::Load(HalfTag(), low));
}

HWY_INLINE Rows load_rows(const double* base, const LocalCorners* c, std::size_t i) {
  return {{load_pair(base + c[0][i], base + c[2][i]), load_pair(base + c[1][i], base + c[3][i]),
           load_pair(base + c[4][i], base + c[6][i]), load_pair(base + c[5][i], base + c[7][i])}};
}

HWY_INLINE Vec3V columns(const Rows& r) {
  const V xz = hn::InterleaveLower(Tag(), r.pair[0], r.pair[1]), xz4 = hn::InterleaveLower(Tag(), r.pair[2], r.pair[3]);
  const V yw = hn::InterleaveUpper(Tag(), r.pair[0], r.pair[1]), yw4 = hn::InterleaveUpper(Tag(), r.pair[2], r.pair[3]);
  return {V{_mm512_shuffle_f64x2(xz.raw, xz4.raw, 0x88)}, V{_mm512_shuffle_f64x2(yw.raw, yw4.raw, 0x88)},
          V{_mm512_shuffle_f64x2(xz.raw, xz4.raw, 0xDD)}};
}

HWY_INLINE Rows rows(V x, V y, V z, V w) {
  const V xy = hn::InterleaveLower(Tag(), x, y), xy1 = hn::InterleaveUpper(Tag(), x, y);
  const V zw = hn::InterleaveLower(Tag(), z, w), zw1 = hn::InterleaveUpper(Tag(), z, w);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11), high = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
  return {{V{_mm512_permutex2var_pd(xy.raw, low, zw.raw)}, V{_mm512_permutex2var_pd(xy1.raw, low, zw1.raw)},
           V{_mm512_permutex2var_pd(xy.raw, high, zw.raw)}, V{_mm512_permutex2var_pd(xy1.raw, high, zw1.raw)}}};
}

HWY_INLINE hn::Vec<HalfTag> row(const Rows& r, Index lane) {
  const V pair = r.pair[(lane >> 2) * 2 + (lane & 1)];
  return (lane & 2) ? hn::UpperHalf(HalfTag(), pair) : hn::LowerHalf(HalfTag(), pair);
}
HWY_INLINE void add_row(const Rows& r, Index lane, double* to) {
  hn::Store(hn::Add(hn::Load(HalfTag(), to), row(r, lane)), HalfTag(), to);
}
HWY_INLINE void store_row(const Rows& r, Index lane, double* to) { hn::Store(row(r, lane), HalfTag(), to); }

HWY_INLINE Rows operator-(const Rows& a, const Rows& b) {
  return {{hn::Sub(a.pair[0], b.pair[0]), hn::Sub(a.pair[1], b.pair[1]), hn::Sub(a.pair[2], b.pair[2]),
           hn::Sub(a.pair[3], b.pair[3])}};
}

#elif HWY_TARGET == HWY_AVX2
struct Rows {
  V row[4];
};

HWY_INLINE Rows load_rows(const double* base, const LocalCorners* c, std::size_t i) {
  return {{hn::Load(Tag(), base + c[0][i]), hn::Load(Tag(), base + c[1][i]), hn::Load(Tag(), base + c[2][i]),
           hn::Load(Tag(), base + c[3][i])}};
}

HWY_INLINE Vec3V columns(const Rows& r) {
  const V xz = hn::InterleaveLower(Tag(), r.row[0], r.row[1]), xz2 = hn::InterleaveLower(Tag(), r.row[2], r.row[3]);
  const V yw = hn::InterleaveUpper(Tag(), r.row[0], r.row[1]), yw2 = hn::InterleaveUpper(Tag(), r.row[2], r.row[3]);
  return {hn::ConcatLowerLower(Tag(), xz2, xz), hn::ConcatLowerLower(Tag(), yw2, yw),
          hn::ConcatUpperUpper(Tag(), xz2, xz)};
}

HWY_INLINE Rows rows(V x, V y, V z, V w) {
  const V xy = hn::InterleaveLower(Tag(), x, y), xy1 = hn::InterleaveUpper(Tag(), x, y);
  const V zw = hn::InterleaveLower(Tag(), z, w), zw1 = hn::InterleaveUpper(Tag(), z, w);
  return {{hn::ConcatLowerLower(Tag(), zw, xy), hn::ConcatLowerLower(Tag(), zw1, xy1),
           hn::ConcatUpperUpper(Tag(), zw, xy), hn::ConcatUpperUpper(Tag(), zw1, xy1)}};
}

HWY_INLINE void add_row(const Rows& r, Index lane, double* to) {
  hn::Store(hn::Add(hn::Load(Tag(), to), r.row[lane]), Tag(), to);
}
HWY_INLINE void store_row(const Rows& r, Index lane, double* to) { hn::Store(r.row[lane], Tag(), to); }

HWY_INLINE Rows operator-(const Rows& a, const Rows& b) {
  return {{hn::Sub(a.row[0], b.row[0]), hn::Sub(a.row[1], b.row[1]), hn::Sub(a.row[2], b.row[2]),
           hn::Sub(a.row[3], b.row[3])}};
}

#else  // Any other instruction set: through memory.
struct Rows {
  double row[width][4];
};

HWY_INLINE Rows load_rows(const double* base, const LocalCorners* c, std::size_t i) {
  Rows r;
  for (Index lane = 0; lane < width; ++lane)
    for (Index k = 0; k < 4; ++k) r.row[lane][k] = base[c[lane][i] + k];
  return r;
}

HWY_INLINE Vec3V columns(const Rows& r) {
  HWY_ALIGN double column[3][width];
  for (Index lane = 0; lane < width; ++lane)
    for (Index k = 0; k < 3; ++k) column[k][lane] = r.row[lane][k];
  return {hn::LoadU(Tag(), column[0]), hn::LoadU(Tag(), column[1]), hn::LoadU(Tag(), column[2])};
}

HWY_INLINE Rows rows(V x, V y, V z, V w) {
  HWY_ALIGN double column[4][width];
  hn::StoreU(x, Tag(), column[0]);
  hn::StoreU(y, Tag(), column[1]);
  hn::StoreU(z, Tag(), column[2]);
  hn::StoreU(w, Tag(), column[3]);
  Rows r;
  for (Index lane = 0; lane < width; ++lane)
    for (Index k = 0; k < 4; ++k) r.row[lane][k] = column[k][lane];
  return r;
}

HWY_INLINE void add_row(const Rows& r, Index lane, double* to) {
  for (Index k = 0; k < 4; ++k) to[k] += r.row[lane][k];
}
HWY_INLINE void store_row(const Rows& r, Index lane, double* to) {
  for (Index k = 0; k < 4; ++k) to[k] = r.row[lane][k];
}

HWY_INLINE Rows operator-(const Rows& a, const Rows& b) {
  Rows r;
  for (Index lane = 0; lane < width; ++lane)
    for (Index k = 0; k < 4; ++k) r.row[lane][k] = a.row[lane][k] - b.row[lane][k];
  return r;
}
#endif

/// Copies one padded vector.
HWY_INLINE void copy_row(const double* from, double* to) {
  const hn::CappedTag<double, 4> d;
  for (std::size_t k = 0; k < 4; k += hn::MaxLanes(d)) hn::StoreU(hn::LoadU(d, from + k), d, to + k);
}

}  // namespace HWY_NAMESPACE
}  // namespace knap
HWY_AFTER_NAMESPACE();
#endif
