// Between rows of four doubles, one a lane, wherever they lie in memory, and vectors over the lanes; included once for
// every instruction set. Loads with register transposes: hardware gathers and scatters are several times slower.
#if defined(KNAP_COHESIVE_LANE_ROWS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef KNAP_COHESIVE_LANE_ROWS_INL_HPP
#undef KNAP_COHESIVE_LANE_ROWS_INL_HPP
#else
#define KNAP_COHESIVE_LANE_ROWS_INL_HPP
#endif

#include <hwy/highway.h>

#include <cstring>

#include "cohesive/record_groups.hpp"
#include "core/vector3-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace knap {
namespace HWY_NAMESPACE {
static_assert(group_lanes % width == 0);

struct Columns {
  V x, y, z, w;
  HWY_INLINE Vec3V xyz() const { return {x, y, z}; }
};

// Each instruction set defines Rows; load_rows(address) with address(lane) -> const double*, store_rows(rows, address),
// add, columns(rows), rows(columns). Lanes may share an address when they store the same.
#if HWY_TARGET == HWY_AVX3
using RowTag = hn::Half<Tag>;
/// Pairs of rows of lanes (0,2) (1,3) (4,6) (5,7): the order that the shuffles below put right.
struct Rows {
  V pair[4];
};

template <class Address>
HWY_INLINE V load_pair(const Address& address, Index low, Index high) {
  return hn::Combine(Tag(), hn::LoadU(RowTag(), address(high)), hn::LoadU(RowTag(), address(low)));
}
template <class Address>
HWY_INLINE Rows load_rows(const Address& address) {
  return {{load_pair(address, 0, 2), load_pair(address, 1, 3), load_pair(address, 4, 6), load_pair(address, 5, 7)}};
}
template <class Address>
HWY_INLINE void store_pair(V pair, const Address& address, Index low, Index high) {
  hn::StoreU(hn::LowerHalf(RowTag(), pair), RowTag(), address(low));
  hn::StoreU(hn::UpperHalf(RowTag(), pair), RowTag(), address(high));
}
template <class Address>
HWY_INLINE void store_rows(const Rows& r, const Address& address) {
  store_pair(r.pair[0], address, 0, 2);
  store_pair(r.pair[1], address, 1, 3);
  store_pair(r.pair[2], address, 4, 6);
  store_pair(r.pair[3], address, 5, 7);
}
HWY_INLINE Rows add(const Rows& a, const Rows& b) {
  return {{hn::Add(a.pair[0], b.pair[0]), hn::Add(a.pair[1], b.pair[1]), hn::Add(a.pair[2], b.pair[2]),
           hn::Add(a.pair[3], b.pair[3])}};
}
HWY_INLINE Columns columns(const Rows& r) {
  const V xz = hn::InterleaveLower(Tag(), r.pair[0], r.pair[1]), xz4 = hn::InterleaveLower(Tag(), r.pair[2], r.pair[3]);
  const V yw = hn::InterleaveUpper(Tag(), r.pair[0], r.pair[1]), yw4 = hn::InterleaveUpper(Tag(), r.pair[2], r.pair[3]);
  return {V{_mm512_shuffle_f64x2(xz.raw, xz4.raw, 0x88)}, V{_mm512_shuffle_f64x2(yw.raw, yw4.raw, 0x88)},
          V{_mm512_shuffle_f64x2(xz.raw, xz4.raw, 0xDD)}, V{_mm512_shuffle_f64x2(yw.raw, yw4.raw, 0xDD)}};
}
HWY_INLINE Rows rows(const Columns& c) {
  const __m512i lower = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
  const __m512i upper = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
  const V xy = hn::InterleaveLower(Tag(), c.x, c.y), xy1 = hn::InterleaveUpper(Tag(), c.x, c.y);
  const V zw = hn::InterleaveLower(Tag(), c.z, c.w), zw1 = hn::InterleaveUpper(Tag(), c.z, c.w);
  return {{V{_mm512_permutex2var_pd(xy.raw, lower, zw.raw)}, V{_mm512_permutex2var_pd(xy1.raw, lower, zw1.raw)},
           V{_mm512_permutex2var_pd(xy.raw, upper, zw.raw)}, V{_mm512_permutex2var_pd(xy1.raw, upper, zw1.raw)}}};
}

#elif HWY_TARGET == HWY_AVX2
struct Rows {
  V row[4];
};
template <class Address>
HWY_INLINE Rows load_rows(const Address& address) {
  return {{hn::LoadU(Tag(), address(0)), hn::LoadU(Tag(), address(1)), hn::LoadU(Tag(), address(2)),
           hn::LoadU(Tag(), address(3))}};
}
template <class Address>
HWY_INLINE void store_rows(const Rows& r, const Address& address) {
  hn::StoreU(r.row[0], Tag(), address(0));
  hn::StoreU(r.row[1], Tag(), address(1));
  hn::StoreU(r.row[2], Tag(), address(2));
  hn::StoreU(r.row[3], Tag(), address(3));
}
HWY_INLINE Rows add(const Rows& a, const Rows& b) {
  return {{hn::Add(a.row[0], b.row[0]), hn::Add(a.row[1], b.row[1]), hn::Add(a.row[2], b.row[2]),
           hn::Add(a.row[3], b.row[3])}};
}
HWY_INLINE Columns columns(const Rows& r) {
  const V xz = hn::InterleaveLower(Tag(), r.row[0], r.row[1]), xz2 = hn::InterleaveLower(Tag(), r.row[2], r.row[3]);
  const V yw = hn::InterleaveUpper(Tag(), r.row[0], r.row[1]), yw2 = hn::InterleaveUpper(Tag(), r.row[2], r.row[3]);
  return {hn::ConcatLowerLower(Tag(), xz2, xz), hn::ConcatLowerLower(Tag(), yw2, yw),
          hn::ConcatUpperUpper(Tag(), xz2, xz), hn::ConcatUpperUpper(Tag(), yw2, yw)};
}
HWY_INLINE Rows rows(const Columns& c) {
  const V xy = hn::InterleaveLower(Tag(), c.x, c.y), xy1 = hn::InterleaveUpper(Tag(), c.x, c.y);
  const V zw = hn::InterleaveLower(Tag(), c.z, c.w), zw1 = hn::InterleaveUpper(Tag(), c.z, c.w);
  return {{hn::ConcatLowerLower(Tag(), zw, xy), hn::ConcatLowerLower(Tag(), zw1, xy1),
           hn::ConcatUpperUpper(Tag(), zw, xy), hn::ConcatUpperUpper(Tag(), zw1, xy1)}};
}

#else  // Any other instruction set: through memory.
struct Rows {
  double row[width][4];
};
template <class Address>
HWY_INLINE Rows load_rows(const Address& address) {
  Rows r;
  for (Index lane = 0; lane < width; ++lane) std::memcpy(r.row[lane], address(lane), sizeof r.row[lane]);
  return r;
}
template <class Address>
HWY_INLINE void store_rows(const Rows& r, const Address& address) {
  for (Index lane = 0; lane < width; ++lane) std::memcpy(address(lane), r.row[lane], sizeof r.row[lane]);
}
HWY_INLINE Rows add(const Rows& a, const Rows& b) {
  Rows r;
  for (Index lane = 0; lane < width; ++lane)
    for (Index k = 0; k < 4; ++k) r.row[lane][k] = a.row[lane][k] + b.row[lane][k];
  return r;
}
HWY_INLINE Columns columns(const Rows& r) {
  HWY_ALIGN double column[4][width];
  for (Index lane = 0; lane < width; ++lane)
    for (Index k = 0; k < 4; ++k) column[k][lane] = r.row[lane][k];
  return {hn::LoadU(Tag(), column[0]), hn::LoadU(Tag(), column[1]), hn::LoadU(Tag(), column[2]),
          hn::LoadU(Tag(), column[3])};
}
HWY_INLINE Rows rows(const Columns& c) {
  HWY_ALIGN double column[4][width];
  hn::StoreU(c.x, Tag(), column[0]);
  hn::StoreU(c.y, Tag(), column[1]);
  hn::StoreU(c.z, Tag(), column[2]);
  hn::StoreU(c.w, Tag(), column[3]);
  Rows r;
  for (Index lane = 0; lane < width; ++lane)
    for (Index k = 0; k < 4; ++k) r.row[lane][k] = column[k][lane];
  return r;
}
#endif

using Word = hn::RebindToSigned<Tag>;

/// Addresses of rows of four doubles, one a lane.
struct Addresses {
  HWY_ALIGN std::int64_t address[width];

  HWY_INLINE double* operator()(Index lane) const { return reinterpret_cast<double*>(address[lane]); }
};

HWY_INLINE hn::Vec<Word> load_indices(const Index* indices) {
  return hn::PromoteTo(Word(), hn::LoadU(hn::Rebind<Index, Tag>(), indices));
}
/// base + index 2^log_size, or `idle` where the index is none.
template <int log_size>
HWY_INLINE Addresses addresses(const void* base, hn::Vec<Word> indices, const void* idle) {
  const auto number_of = [](const void* p) HWY_ATTR {
    return hn::Set(Word(), static_cast<std::int64_t>(reinterpret_cast<std::intptr_t>(p)));
  };
  Addresses result;
  const auto there = hn::Add(number_of(base), hn::ShiftLeft<log_size>(indices));
  hn::Store(hn::IfThenElse(hn::Lt(indices, hn::Zero(Word())), number_of(idle), there), Word(), result.address);
  return result;
}
template <std::ptrdiff_t doubles>
struct Shifted {
  const Addresses& rows;
  HWY_INLINE double* operator()(Index lane) const { return rows(lane) + doubles; }
};

}  // namespace HWY_NAMESPACE
}  // namespace knap
HWY_AFTER_NAMESPACE();
#endif
