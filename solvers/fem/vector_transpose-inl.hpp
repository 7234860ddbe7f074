// Between rows of four doubles (nodal vectors in memory) and vectors over tets; included once for every instruction
// set. Loads with register transposes: hardware gathers are several times slower.
#if defined(KNAP_FEM_VECTOR_TRANSPOSE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef KNAP_FEM_VECTOR_TRANSPOSE_INL_HPP
#undef KNAP_FEM_VECTOR_TRANSPOSE_INL_HPP
#else
#define KNAP_FEM_VECTOR_TRANSPOSE_INL_HPP
#endif

#include <hwy/highway.h>

#include "core/vector3-inl.hpp"
#include "fem/element_blocks.hpp"

HWY_BEFORE_NAMESPACE();
namespace knap {
namespace HWY_NAMESPACE {
static_assert(lanes % width == 0);
inline constexpr Index unit = width < 4 ? width : 4;  ///< tets whose rows are written at a time

// Each instruction set defines
//   NodeRows   rows of one corner of all tets of a vector; load_node_rows, difference, columns
//   Rows       rows of one unit of tets; rows(unit's number, x, y, z[, w]), sum, store, add_to, subtract_from
#if HWY_TARGET == HWY_AVX3
using RowTag = hn::Half<Tag>;
/// Pairs of rows of lanes (0,2) (1,3) (4,6) (5,7): the order that the shuffles below put right.
struct NodeRows {
  V pair[4];
};
/// Lanes (0,2) and (1,3) of a unit.
struct Rows {
  V even, odd;
};

HWY_INLINE V load_pair(const double* low, const double* high) {
  return hn::Combine(Tag(), hn::Load(RowTag(), high), hn::Load(RowTag(), low));
}
HWY_INLINE NodeRows load_node_rows(const double* base, const LocalCorners* c, std::size_t i) {
  return {{load_pair(base + c[0][i], base + c[2][i]), load_pair(base + c[1][i], base + c[3][i]),
           load_pair(base + c[4][i], base + c[6][i]), load_pair(base + c[5][i], base + c[7][i])}};
}
HWY_INLINE NodeRows difference(const NodeRows& a, const NodeRows& b) {
  return {{hn::Sub(a.pair[0], b.pair[0]), hn::Sub(a.pair[1], b.pair[1]), hn::Sub(a.pair[2], b.pair[2]),
           hn::Sub(a.pair[3], b.pair[3])}};
}
HWY_INLINE Vec3V columns(const NodeRows& r) {
  const V xz = hn::InterleaveLower(Tag(), r.pair[0], r.pair[1]), xz4 = hn::InterleaveLower(Tag(), r.pair[2], r.pair[3]);
  const V yw = hn::InterleaveUpper(Tag(), r.pair[0], r.pair[1]), yw4 = hn::InterleaveUpper(Tag(), r.pair[2], r.pair[3]);
  return {V{_mm512_shuffle_f64x2(xz.raw, xz4.raw, 0x88)}, V{_mm512_shuffle_f64x2(yw.raw, yw4.raw, 0x88)},
          V{_mm512_shuffle_f64x2(xz.raw, xz4.raw, 0xDD)}};
}

HWY_INLINE Rows rows(Index number, V x, V y, V z) {
  const long long k = 4 * number;
  const __m512i even = _mm512_setr_epi64(k, k + 1, k + 8, 0, k + 2, k + 3, k + 10, 0);
  const __m512i odd = _mm512_setr_epi64(k, k + 1, k + 9, 0, k + 2, k + 3, k + 11, 0);
  const V xy = hn::InterleaveLower(Tag(), x, y), xy1 = hn::InterleaveUpper(Tag(), x, y);
  return {V{_mm512_maskz_permutex2var_pd(0x77, xy.raw, even, z.raw)},
          V{_mm512_maskz_permutex2var_pd(0x77, xy1.raw, odd, z.raw)}};
}
HWY_INLINE Rows rows(Index number, V x, V y, V z, V w) {
  const long long k = 4 * number;
  const __m512i half = _mm512_setr_epi64(k, k + 1, k + 8, k + 9, k + 2, k + 3, k + 10, k + 11);
  const V xy = hn::InterleaveLower(Tag(), x, y), xy1 = hn::InterleaveUpper(Tag(), x, y);
  const V zw = hn::InterleaveLower(Tag(), z, w), zw1 = hn::InterleaveUpper(Tag(), z, w);
  return {V{_mm512_permutex2var_pd(xy.raw, half, zw.raw)}, V{_mm512_permutex2var_pd(xy1.raw, half, zw1.raw)}};
}
HWY_INLINE Rows sum(const Rows& a, const Rows& b) { return {hn::Add(a.even, b.even), hn::Add(a.odd, b.odd)}; }
HWY_INLINE hn::Vec<RowTag> row(const Rows& r, Index lane) {
  const V pair = (lane & 1) ? r.odd : r.even;
  return (lane & 2) ? hn::UpperHalf(RowTag(), pair) : hn::LowerHalf(RowTag(), pair);
}

#elif HWY_TARGET == HWY_AVX2
using RowTag = Tag;
struct Rows {
  V row[4];
};
using NodeRows = Rows;

HWY_INLINE NodeRows load_node_rows(const double* base, const LocalCorners* c, std::size_t i) {
  return {{hn::Load(Tag(), base + c[0][i]), hn::Load(Tag(), base + c[1][i]), hn::Load(Tag(), base + c[2][i]),
           hn::Load(Tag(), base + c[3][i])}};
}
HWY_INLINE NodeRows difference(const NodeRows& a, const NodeRows& b) {
  return {{hn::Sub(a.row[0], b.row[0]), hn::Sub(a.row[1], b.row[1]), hn::Sub(a.row[2], b.row[2]),
           hn::Sub(a.row[3], b.row[3])}};
}
HWY_INLINE Vec3V columns(const NodeRows& r) {
  const V xz = hn::InterleaveLower(Tag(), r.row[0], r.row[1]), xz2 = hn::InterleaveLower(Tag(), r.row[2], r.row[3]);
  const V yw = hn::InterleaveUpper(Tag(), r.row[0], r.row[1]), yw2 = hn::InterleaveUpper(Tag(), r.row[2], r.row[3]);
  return {hn::ConcatLowerLower(Tag(), xz2, xz), hn::ConcatLowerLower(Tag(), yw2, yw),
          hn::ConcatUpperUpper(Tag(), xz2, xz)};
}

HWY_INLINE Rows rows(Index, V x, V y, V z, V w) {
  const V xy = hn::InterleaveLower(Tag(), x, y), xy1 = hn::InterleaveUpper(Tag(), x, y);
  const V zw = hn::InterleaveLower(Tag(), z, w), zw1 = hn::InterleaveUpper(Tag(), z, w);
  return {{hn::ConcatLowerLower(Tag(), zw, xy), hn::ConcatLowerLower(Tag(), zw1, xy1),
           hn::ConcatUpperUpper(Tag(), zw, xy), hn::ConcatUpperUpper(Tag(), zw1, xy1)}};
}
HWY_INLINE Rows rows(Index number, V x, V y, V z) { return rows(number, x, y, z, hn::Zero(Tag())); }
HWY_INLINE Rows sum(const Rows& a, const Rows& b) {
  return {{hn::Add(a.row[0], b.row[0]), hn::Add(a.row[1], b.row[1]), hn::Add(a.row[2], b.row[2]),
           hn::Add(a.row[3], b.row[3])}};
}
HWY_INLINE V row(const Rows& r, Index lane) { return r.row[lane]; }
#endif

#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
HWY_INLINE void store(const Rows& r, Index lane, double* to) { hn::Store(row(r, lane), RowTag(), to); }
HWY_INLINE void add_to(double* to, const Rows& r, Index lane) {
  hn::Store(hn::Add(hn::Load(RowTag(), to), row(r, lane)), RowTag(), to);
}
HWY_INLINE void subtract_from(double* to, const Rows& r, Index lane) {
  hn::Store(hn::Sub(hn::Load(RowTag(), to), row(r, lane)), RowTag(), to);
}

#else  // Any other instruction set: through memory.
struct Rows {
  double row[width][4];
};
using NodeRows = Rows;

HWY_INLINE NodeRows load_node_rows(const double* base, const LocalCorners* c, std::size_t i) {
  NodeRows r;
  for (Index lane = 0; lane < width; ++lane)
    for (Index k = 0; k < 4; ++k) r.row[lane][k] = base[c[lane][i] + k];
  return r;
}
HWY_INLINE NodeRows difference(const NodeRows& a, const NodeRows& b) {
  NodeRows r;
  for (Index lane = 0; lane < width; ++lane)
    for (Index k = 0; k < 4; ++k) r.row[lane][k] = a.row[lane][k] - b.row[lane][k];
  return r;
}
HWY_INLINE Vec3V columns(const NodeRows& r) {
  HWY_ALIGN double column[3][width];
  for (Index lane = 0; lane < width; ++lane)
    for (Index k = 0; k < 3; ++k) column[k][lane] = r.row[lane][k];
  return {hn::LoadU(Tag(), column[0]), hn::LoadU(Tag(), column[1]), hn::LoadU(Tag(), column[2])};
}

HWY_INLINE Rows rows(Index, V x, V y, V z, V w) {
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
HWY_INLINE Rows rows(Index number, V x, V y, V z) { return rows(number, x, y, z, hn::Zero(Tag())); }
HWY_INLINE Rows sum(const Rows& a, const Rows& b) {
  Rows r;
  for (Index lane = 0; lane < width; ++lane)
    for (Index k = 0; k < 4; ++k) r.row[lane][k] = a.row[lane][k] + b.row[lane][k];
  return r;
}
HWY_INLINE void store(const Rows& r, Index lane, double* to) {
  for (Index k = 0; k < 4; ++k) to[k] = r.row[lane][k];
}
HWY_INLINE void add_to(double* to, const Rows& r, Index lane) {
  for (Index k = 0; k < 4; ++k) to[k] += r.row[lane][k];
}
HWY_INLINE void subtract_from(double* to, const Rows& r, Index lane) {
  for (Index k = 0; k < 4; ++k) to[k] -= r.row[lane][k];
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
