#include "cohesive/insertion_criterion.hpp"

#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index facets_per_block = 2048;
// The stresses of a facet's tets lie anywhere in memory: asked for this many facets ahead.
constexpr Index prefetch_distance = 24;

Vec3 facet_normal(const Topology& topology, std::span<const Vec4> x, Index facet) {
  const Vec3 a = xyz(x[at(topology.facet_node(facet, 0, 0))]);
  const Vec3 b = xyz(x[at(topology.facet_node(facet, 1, 0))]);
  const Vec3 c = xyz(x[at(topology.facet_node(facet, 2, 0))]);
  return (b - a).cross(c - a).normalized();
}

OverloadedFacet load_of_facet(const Topology& topology, std::span<const Vec4> x, const TetStresses& stresses,
                              const LawsOfTets& laws, Index facet) {
  const auto& [minus, plus] = topology.facet_tets[at(facet)];
  const Vec3 n = facet_normal(topology, x, facet);
  const Vec3 t = facet_traction(stresses.stress[at(minus)], stresses.stress[at(plus)], n);
  return {facet, effective_traction(laws.of(minus), t, n), t};
}

}  // namespace

double effective_traction(const CohesiveLaw& law, const Vec3& t, const Vec3& normal) {
  const double tn = t.dot(normal);
  const double tt2 = std::max(0.0, t.squaredNorm() - tn * tn);
  if (tn >= 0.0) return std::sqrt(tn * tn + tt2 / (law.beta * law.beta));
  return (std::sqrt(tt2) + law.internal_friction * tn) / law.beta;
}

std::vector<OverloadedFacet> overloaded_facets(const Topology& topology, std::span<const Vec4> x,
                                               const TetStresses& stresses, std::span<const double> strength,
                                               const LawsOfTets& laws) {
  const Index blocks = num_blocks(topology.num_facets(), facets_per_block);
  std::vector<std::vector<OverloadedFacet>> found(at(blocks));
  // The effective traction is at most |t| max(1, 1/beta), and |t| at most the mean of the two stresses' bounds.
  double bound_factor = 0.5;
  for (const CohesiveLaw& law : laws.laws) bound_factor = std::max(bound_factor, 0.5 / law.beta);
  const auto may_fail = [&](Index facet) {
    const auto& [minus, plus] = topology.facet_tets[at(facet)];
    const double bound = stresses.bound[at(minus)] + stresses.bound[at(plus)];
    return bound_factor * bound >= strength[at(facet)] && topology.facet_state[at(facet)] == FacetState::Bonded;
  };
  parallel_blocks(blocks, [&](Index block) {
    const Index end = std::min(topology.num_facets(), (block + 1) * facets_per_block);
    std::array<Index, std::size_t{facets_per_block}> facets;
    Index count = 0;
    for (Index facet = block * facets_per_block; facet < end; ++facet) {
      facets[at(count)] = facet;
      count += may_fail(facet) ? 1 : 0;
    }
    for (Index i = 0; i < count; ++i) {
      for (const Index tet : topology.facet_tets[at(facets[at(std::min(i + prefetch_distance, count - 1))])])
        __builtin_prefetch(&stresses.stress[at(tet)]);
      const Index facet = facets[at(i)];
      const OverloadedFacet load = load_of_facet(topology, x, stresses, laws, facet);
      if (load.effective >= strength[at(facet)]) found[at(block)].push_back(load);
    }
  });
  std::vector<OverloadedFacet> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

OverloadedFacet most_loaded_facet(const Topology& topology, std::span<const Vec4> x, const TetStresses& stresses,
                                  std::span<const double> strength, const LawsOfTets& laws) {
  std::vector<OverloadedFacet> most(at(num_blocks(topology.num_facets(), facets_per_block)));
  const auto exceeds = [&](const OverloadedFacet& a, const OverloadedFacet& b) {
    return b.facet == none || a.effective * strength[at(b.facet)] > b.effective * strength[at(a.facet)];
  };
  parallel_blocks(to_index(most.size()), [&](Index block) {
    const Index end = std::min(topology.num_facets(), (block + 1) * facets_per_block);
    for (Index facet = block * facets_per_block; facet < end; ++facet) {
      if (topology.facet_state[at(facet)] != FacetState::Bonded) continue;
      const OverloadedFacet load = load_of_facet(topology, x, stresses, laws, facet);
      if (exceeds(load, most[at(block)])) most[at(block)] = load;
    }
  });
  OverloadedFacet all;
  for (const OverloadedFacet& load : most)
    if (load.facet != none && exceeds(load, all)) all = load;
  return all;
}

}  // namespace knap
