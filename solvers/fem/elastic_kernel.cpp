#include "fem/elastic_kernel.hpp"

#include "core/choose_targets-inl.hpp"
#include "materials/neo_hookean.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fem/elastic_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "fem/vector_transpose-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace knap {
namespace HWY_NAMESPACE {

struct Symmetric {
  V xx, yy, zz, yz, zx, xy;
};
struct Edges {
  Vec3V a, b, c;
};

HWY_INLINE Vec3V combination(V u, const Vec3V& a, V v, const Vec3V& b, V w, const Vec3V& c) {
  return scaled_sum(u, a, scaled_sum(v, b, scaled(w, c)));
}
// Full contraction A : B.
HWY_INLINE V contraction(const Symmetric& a, const Symmetric& b) {
  const V off = hn::MulAdd(a.xy, b.xy, hn::MulAdd(a.zx, b.zx, hn::Mul(a.yz, b.yz)));
  const V diagonal = hn::MulAdd(a.zz, b.zz, hn::MulAdd(a.yy, b.yy, hn::Mul(a.xx, b.xx)));
  return hn::MulAdd(hn::Set(Tag(), 2.0), off, diagonal);
}

HWY_INLINE Symmetric load_symmetric(const SymmetricLanes& s, Index lane) {
  return {hn::Load(Tag(), &s[0][at(lane)]), hn::Load(Tag(), &s[1][at(lane)]), hn::Load(Tag(), &s[2][at(lane)]),
          hn::Load(Tag(), &s[3][at(lane)]), hn::Load(Tag(), &s[4][at(lane)]), hn::Load(Tag(), &s[5][at(lane)])};
}
HWY_INLINE void store_symmetric(const Symmetric& a, SymmetricLanes& s, Index lane) {
  hn::Store(a.xx, Tag(), &s[0][at(lane)]);
  hn::Store(a.yy, Tag(), &s[1][at(lane)]);
  hn::Store(a.zz, Tag(), &s[2][at(lane)]);
  hn::Store(a.yz, Tag(), &s[3][at(lane)]);
  hn::Store(a.zx, Tag(), &s[4][at(lane)]);
  hn::Store(a.xy, Tag(), &s[5][at(lane)]);
}

HWY_INLINE Edges load_edges(const double* x, const LocalCorners* corners) {
  const NodeRows origin = load_node_rows(x, corners, 0);
  return {columns(difference(load_node_rows(x, corners, 1), origin)),
          columns(difference(load_node_rows(x, corners, 2), origin)),
          columns(difference(load_node_rows(x, corners, 3), origin))};
}

HWY_INLINE Symmetric metric(const Edges& d) {
  return {dot(d.a, d.a), dot(d.b, d.b), dot(d.c, d.c), dot(d.b, d.c), dot(d.c, d.a), dot(d.a, d.b)};
}

// p a + q b, entry by entry.
HWY_INLINE Symmetric sum(V p, const Symmetric& a, V q, const Symmetric& b) {
  return {hn::MulAdd(p, a.xx, hn::Mul(q, b.xx)), hn::MulAdd(p, a.yy, hn::Mul(q, b.yy)),
          hn::MulAdd(p, a.zz, hn::Mul(q, b.zz)), hn::MulAdd(p, a.yz, hn::Mul(q, b.yz)),
          hn::MulAdd(p, a.zx, hn::Mul(q, b.zx)), hn::MulAdd(p, a.xy, hn::Mul(q, b.xy))};
}

// A B A for symmetric A, B.
HWY_INLINE Symmetric sandwich(const Symmetric& a, const Symmetric& b) {
  const Vec3V ax{a.xx, a.xy, a.zx}, ay{a.xy, a.yy, a.yz}, az{a.zx, a.yz, a.zz};
  const Vec3V bx{b.xx, b.xy, b.zx}, by{b.xy, b.yy, b.yz}, bz{b.zx, b.yz, b.zz};
  const Vec3V cx{dot(bx, ax), dot(by, ax), dot(bz, ax)}, cy{dot(bx, ay), dot(by, ay), dot(bz, ay)},
      cz{dot(bx, az), dot(by, az), dot(bz, az)};
  return {dot(ax, cx), dot(ay, cy), dot(az, cz), dot(ay, cz), dot(az, cx), dot(ax, cy)};
}

struct Coefficients {
  V mu, lambda_plus_mu, branch_trace, branch_shear, decay, relaxed, inverse_decay;
  // dU/dJ of the law.
  HWY_INLINE V slope(V volume_ratio) const {
    return hn::MulSub(lambda_plus_mu, hn::Sub(volume_ratio, hn::Set(Tag(), 1.0)), mu);
  }
};
HWY_INLINE Coefficients broadcast(const KernelCoefficients& k) {
  const Tag d;
  return {hn::Set(d, k.mu),           hn::Set(d, k.lambda_plus_mu), hn::Set(d, k.branch_trace),
          hn::Set(d, k.branch_shear), hn::Set(d, 0.5 * k.decay),    hn::Set(d, 1.0 - k.decay * k.decay),
          hn::Set(d, 0.5 / k.decay)};
}

// Stress of the branch times volume in edge components, V S_b, at its elastic strain e.
HWY_INLINE Symmetric branch_stress(const Coefficients& k, const Symmetric& stiffness, V inverse_six_volume,
                                   const Symmetric& e) {
  const V trace = hn::Mul(hn::Mul(k.branch_trace, inverse_six_volume), contraction(stiffness, e));
  return sum(trace, stiffness, hn::Mul(k.branch_shear, inverse_six_volume), sandwich(stiffness, e));
}

struct Branch {
  Symmetric stress;  // V S_b
  V stored;
};

// Half a step of relaxation, stress, half a step of relaxation (see viscoelastic_branch.hpp).
HWY_INLINE Branch advance_branch(const Coefficients& k, const ElementGroup& group, Index lane,
                                 const Symmetric& metric_now, const Symmetric& stiffness,
                                 SymmetricLanes& relaxed_metric) {
  const V one = hn::Set(Tag(), 1.0);
  const Symmetric remembered = load_symmetric(relaxed_metric, lane);
  const Symmetric gap = sum(one, metric_now, hn::Neg(one), remembered);
  store_symmetric(sum(one, remembered, k.relaxed, gap), relaxed_metric, lane);
  const Symmetric e = {hn::Mul(k.decay, gap.xx), hn::Mul(k.decay, gap.yy), hn::Mul(k.decay, gap.zz),
                       hn::Mul(k.decay, gap.yz), hn::Mul(k.decay, gap.zx), hn::Mul(k.decay, gap.xy)};
  const Symmetric stress = branch_stress(k, stiffness, hn::Load(Tag(), &group.inverse_six_volume[at(lane)]), e);
  return {stress, hn::Mul(hn::Set(Tag(), 0.5), contraction(stress, e))};
}

// The branch's elastic strain at the whole step whose forces were computed last.
HWY_INLINE Symmetric branch_strain(const Coefficients& k, const Symmetric& metric_now,
                                   const SymmetricLanes& relaxed_metric, Index lane) {
  return sum(k.inverse_decay, metric_now, hn::Neg(k.inverse_decay), load_symmetric(relaxed_metric, lane));
}

HWY_INLINE Symmetric difference(const Symmetric& a, const Symmetric& b) {
  return {hn::Sub(a.xx, b.xx), hn::Sub(a.yy, b.yy), hn::Sub(a.zz, b.zz),
          hn::Sub(a.yz, b.yz), hn::Sub(a.zx, b.zx), hn::Sub(a.xy, b.xy)};
}

// Forces on corners b, c, d: D T - slope/6 cof D with T = -(mu V G + V S_b).
HWY_INLINE Edges corner_forces(const Coefficients& k, const Edges& d, const Symmetric& t, V inverse_six_volume) {
  const Vec3V bc = cross(d.b, d.c);
  const V slope = k.slope(hn::Mul(dot(d.a, bc), inverse_six_volume));
  const V s = hn::Mul(hn::Set(Tag(), -1.0 / 6.0), slope);
  Edges h;
  h.a = scaled_sum(t.xx, d.a, scaled_sum(t.xy, d.b, scaled_sum(t.zx, d.c, scaled(s, bc))));
  h.b = scaled_sum(t.xy, d.a, scaled_sum(t.yy, d.b, scaled_sum(t.yz, d.c, scaled(s, cross(d.c, d.a)))));
  h.c = scaled_sum(t.zx, d.a, scaled_sum(t.yz, d.b, scaled_sum(t.zz, d.c, scaled(s, cross(d.a, d.b)))));
  return h;
}

// Adds the rows of a unit of tets to their nodes at local corner i.
HWY_INLINE void add_rows(const Rows& r, const LocalCorners* corners, std::size_t i, double* f) {
#pragma GCC unroll 4
  for (Index lane = 0; lane < unit; ++lane) add_to(f + corners[lane][i], r, lane);
}

// Adds the corner forces of a vector of tets to the local nodes, four tets at a time whatever the vector width.
HWY_INLINE void scatter(const Edges& h, const LocalCorners* corners, double* f) {
#pragma GCC unroll 2
  for (Index number = 0; number < width / unit; ++number, corners += unit) {
    const Rows b = rows(number, h.a.x, h.a.y, h.a.z);
    add_rows(b, corners, 1, f);
    const Rows c = rows(number, h.b.x, h.b.y, h.b.z);
    add_rows(c, corners, 2, f);
    const Rows d = rows(number, h.c.x, h.c.y, h.c.z);
    add_rows(d, corners, 3, f);
    const Rows minus_a = sum(sum(b, c), d);
#pragma GCC unroll 4
    for (Index lane = 0; lane < unit; ++lane) subtract_from(f + corners[lane][0], minus_a, lane);
  }
}

// Sum over the lane group of accumulated values, lane by lane.
HWY_INLINE double lane_sum(const V* values) {
  HWY_ALIGN double value[lanes];
  for (Index lane = 0; lane < lanes; lane += width) hn::StoreU(values[lane / width], Tag(), value + lane);
  double total = 0.0;
  for (const double v : value) total += v;
  return total;
}

// Positions into the local nodes, forces set to zero.
HWY_INLINE void load_nodes(const BlockView& view, double* local) {
  constexpr double zero[4] = {};
  const std::vector<Index>& nodes = view.block->nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    copy_row(view.x + 4 * nodes[i], local + node_stride * i);
    copy_row(zero, local + node_stride * i + 4);
  }
}

// Fetches the data of a later group into the cache. The hardware's streams stop at every page, that is every nine
// groups: without this the sweeps over large meshes take up to twice as long. Beyond the last group it fetches nothing
// of use.
HWY_INLINE void prefetch_group(const BlockView& view, Index g) {
  constexpr std::ptrdiff_t distance = 24, line = 64;
  const char* group =
      reinterpret_cast<const char*>(view.groups) + (g + distance) * std::ptrdiff_t{sizeof(ElementGroup)};
#pragma GCC unroll 8
  for (std::ptrdiff_t byte = 0; byte < std::ptrdiff_t{sizeof(ElementGroup)}; byte += line)
    __builtin_prefetch(group + byte, 0, 2);
  __builtin_prefetch(reinterpret_cast<const char*>(view.corners) + (g + distance) * line, 0, 2);
  if (!view.branch) return;
  const char* branch =
      reinterpret_cast<const char*>(view.branch) + (g + distance) * std::ptrdiff_t{sizeof(BranchGroup)};
#pragma GCC unroll 8
  for (std::ptrdiff_t byte = 0; byte < std::ptrdiff_t{sizeof(BranchGroup)}; byte += line)
    __builtin_prefetch(branch + byte, 0, 2);
}

template <bool with_branch>
HWY_INLINE double force_sweep(const BlockView& view, const KernelCoefficients& numbers, double* local) {
  const Coefficients k = broadcast(numbers);
  V stored[lanes / width];
  for (V& s : stored) s = hn::Zero(Tag());
  for (Index g = 0; g < view.block->num_groups; ++g) {
    const ElementGroup& group = view.groups[g];
    prefetch_group(view, g);
    for (Index lane = 0; lane < lanes; lane += width) {
      const LocalCorners* corners = view.corners + g * lanes + lane;
      const Edges edges = load_edges(local, corners);
      Symmetric t = load_symmetric(group.stiffness, lane);
      if constexpr (with_branch) {
        const Branch branch = advance_branch(k, group, lane, metric(edges), t, view.branch[g].relaxed_metric);
        stored[lane / width] = hn::Add(stored[lane / width], branch.stored);
        t = difference(t, branch.stress);
      }
      scatter(corner_forces(k, edges, t, hn::Load(Tag(), &group.inverse_six_volume[at(lane)])), corners, local + 4);
    }
  }
  return with_branch ? lane_sum(stored) : 0.0;
}

double AddBlockForces(const BlockView& view, const KernelCoefficients& k, double* f, double* slots) {
  const ElementBlock& block = *view.block;
  HWY_ALIGN double local[node_stride * max_block_nodes];
  load_nodes(view, local);
  const double stored = view.branch ? force_sweep<true>(view, k, local) : force_sweep<false>(view, k, local);
  const double* from = local + 4;
  for (Index i = 0; i < block.num_private; ++i, from += node_stride) copy_row(from, f + 4 * block.nodes[at(i)]);
  double* to = slots + 4 * block.first_slot;
  for (std::size_t i = at(block.num_private); i < block.nodes.size(); ++i, from += node_stride, to += 4)
    copy_row(from, to);
  return stored;
}

BulkState BlockState(const BlockView& view, const KernelCoefficients& numbers) {
  HWY_ALIGN double local[node_stride * max_block_nodes];
  load_nodes(view, local);
  const Coefficients k = broadcast(numbers);
  const Tag d;
  const V half = hn::Set(d, 0.5), sixth = hn::Set(d, 1.0 / 6.0), one = hn::Set(d, 1.0);
  V energy[lanes / width];
  for (V& e : energy) e = hn::Zero(d);
  V smallest = hn::Zero(d);  // J - 1
  for (Index g = 0; g < view.block->num_groups; ++g) {
    prefetch_group(view, g);
    for (Index lane = 0; lane < lanes; lane += width) {
      const Edges edges = load_edges(local, view.corners + g * lanes + lane);
      const Symmetric t = load_symmetric(view.groups[g].stiffness, lane);
      const V inverse = hn::Load(d, &view.groups[g].inverse_six_volume[at(lane)]);
      const V volume = hn::IfThenElseZero(hn::Gt(inverse, hn::Zero(d)), hn::Div(sixth, inverse));
      const V j = hn::Sub(hn::Mul(dot(edges.a, cross(edges.b, edges.c)), inverse), one);
      const Symmetric c = metric(edges);
      smallest = hn::Min(smallest, hn::IfThenElseZero(hn::Gt(inverse, hn::Zero(d)), j));
      // V W = -T:C/2 - 3/2 mu V + V j ((lambda + mu)/2 j - mu), j = J - 1
      const V shear = hn::MulAdd(hn::Mul(hn::Set(d, 3.0), k.mu), volume, contraction(t, c));
      const V volumetric = hn::Mul(hn::Mul(volume, j), hn::MulSub(hn::Mul(half, k.lambda_plus_mu), j, k.mu));
      V& sum_of_lane = energy[lane / width];
      sum_of_lane = hn::Add(sum_of_lane, hn::NegMulAdd(half, shear, volumetric));
      if (view.branch) {
        const Symmetric e = branch_strain(k, c, view.branch[g].relaxed_metric, lane);
        const V stored = contraction(branch_stress(k, t, inverse, e), e);
        sum_of_lane = hn::MulAdd(half, stored, sum_of_lane);
      }
    }
  }
  HWY_ALIGN double lowest[width];
  hn::Store(smallest, d, lowest);
  return {lane_sum(energy), 1.0 + *std::min_element(lowest, lowest + width)};
}

HWY_INLINE void store_tets(const Symmetric& s, V volume_ratio, const ElementBlock& block, Index g, Index lane0,
                           TetStress* stress) {
  for (Index number = 0; number < width / unit; ++number) {
    const Rows first = rows(number, s.xx, s.yy, s.zz, s.yz);
    const Rows second = rows(number, s.zx, s.xy, volume_ratio, hn::Zero(Tag()));
#pragma GCC unroll 4
    for (Index lane = 0; lane < unit; ++lane) {
      const Index tet = tet_of_lane(block, g, lane0 + number * unit + lane);
      if (tet == none) continue;
      store(first, lane, &stress[tet].xx);
      store(second, lane, &stress[tet].zx);
    }
  }
}

HWY_INLINE void store_bounds(V norm, const ElementBlock& block, Index g, Index lane0, float* bound) {
  constexpr double rounded_up = 1.0 + 1e-6;  // more than a float can lose
  HWY_ALIGN double value[width];
  hn::Store(hn::Mul(hn::Set(Tag(), rounded_up), norm), Tag(), value);
  for (Index lane = 0; lane < width; ++lane) {
    const Index tet = tet_of_lane(block, g, lane0 + lane);
    if (tet != none) bound[tet] = static_cast<float>(value[lane]);
  }
}

void StoreBlockStress(const BlockView& view, const KernelCoefficients& numbers, TetStress* stress, float* bound) {
  HWY_ALIGN double local[node_stride * max_block_nodes];
  load_nodes(view, local);
  const Coefficients k = broadcast(numbers);
  const Tag d;
  for (Index g = 0; g < view.block->num_groups; ++g) {
    prefetch_group(view, g);
    for (Index lane = 0; lane < lanes; lane += width) {
      const Edges edges = load_edges(local, view.corners + g * lanes + lane);
      Symmetric t = load_symmetric(view.groups[g].stiffness, lane);
      const V inverse = hn::Load(d, &view.groups[g].inverse_six_volume[at(lane)]);
      if (view.branch) {
        const Symmetric e = branch_strain(k, metric(edges), view.branch[g].relaxed_metric, lane);
        t = difference(t, branch_stress(k, t, inverse, e));
      }
      const V ratio = hn::Mul(dot(edges.a, cross(edges.b, edges.c)), inverse);
      const V scale =
          hn::Div(hn::Mul(hn::Set(d, -6.0), inverse), hn::Max(hn::Abs(ratio), hn::Set(d, smallest_volume_ratio)));
      const Vec3V p = combination(t.xx, edges.a, t.xy, edges.b, t.zx, edges.c),
                  q = combination(t.xy, edges.a, t.yy, edges.b, t.yz, edges.c),
                  r = combination(t.zx, edges.a, t.yz, edges.b, t.zz, edges.c);
      const auto entry = [&](V ax, V bx, V cx, V py, V qy, V ry) {
        return hn::Mul(scale, hn::MulAdd(ax, py, hn::MulAdd(bx, qy, hn::Mul(cx, ry))));
      };
      const V slope = k.slope(ratio);
      const Symmetric s{hn::Add(slope, entry(edges.a.x, edges.b.x, edges.c.x, p.x, q.x, r.x)),
                        hn::Add(slope, entry(edges.a.y, edges.b.y, edges.c.y, p.y, q.y, r.y)),
                        hn::Add(slope, entry(edges.a.z, edges.b.z, edges.c.z, p.z, q.z, r.z)),
                        entry(edges.a.y, edges.b.y, edges.c.y, p.z, q.z, r.z),
                        entry(edges.a.z, edges.b.z, edges.c.z, p.x, q.x, r.x),
                        entry(edges.a.x, edges.b.x, edges.c.x, p.y, q.y, r.y)};
      store_tets(s, ratio, *view.block, g, lane, stress);
      store_bounds(hn::Sqrt(contraction(s, s)), *view.block, g, lane, bound);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace knap
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace knap {

HWY_EXPORT(AddBlockForces);
HWY_EXPORT(BlockState);
HWY_EXPORT(StoreBlockStress);

double add_block_forces(const BlockView& view, const KernelCoefficients& k, double* f, double* slots) {
  return HWY_DYNAMIC_DISPATCH(AddBlockForces)(view, k, f, slots);
}
BulkState block_state(const BlockView& view, const KernelCoefficients& k) {
  return HWY_DYNAMIC_DISPATCH(BlockState)(view, k);
}
void store_block_stress(const BlockView& view, const KernelCoefficients& k, TetStress* stress, float* bound) {
  HWY_DYNAMIC_DISPATCH(StoreBlockStress)(view, k, stress, bound);
}

}  // namespace knap
#endif
