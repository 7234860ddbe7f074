#include "fem/element_lanes.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"
#include "fem/tet_reference.hpp"

namespace knap {
namespace {

using Symmetric = std::array<double, 6>;

Symmetric components(const Mat3& s) { return {s(0, 0), s(1, 1), s(2, 2), s(1, 2), s(2, 0), s(0, 1)}; }

void store(const Symmetric& s, SymmetricLanes& to, Index lane) {
  for (std::size_t i = 0; i < 6; ++i) to[i][at(lane)] = s[i];
}

// Calls body(tet, group, lane) for the lanes in use.
template <class Body>
void for_each_lane(const ElementBlock& block, Body&& body) {
  for (Index group = 0; group < block.num_groups; ++group)
    for (Index lane = 0; lane < lanes; ++lane) {
      const Index t = tet_of_lane(block, group, lane);
      if (t != none) body(t, at(block.first_group + group), lane);
    }
}

bool has_branch(const ElasticForce& elastic, const ElementBlock& block) {
  return elastic.materials[at(block.material)].branch.is_active();
}

}  // namespace

void fill_groups(ElasticForce& elastic, const Topology& topology, std::span<const Vec3> reference_positions,
                 const ElementBlock& block) {
  const double mu = elastic.materials[at(block.material)].small_strain().mu;
  for (Index group = 0; group < block.num_groups; ++group) elastic.groups[at(block.first_group + group)] = {};
  for_each_lane(block, [&](Index t, std::size_t group, Index lane) {
    const TetReference tet = make_tet_reference(reference_positions, topology.tet_vertices[at(t)]);
    if (!(tet.volume > 0.0)) throw InputError(fmt::format("mesh: tet {} has volume {} m3", t, tet.volume));
    const Mat3 inverse_metric = tet.inverse_edges * tet.inverse_edges.transpose();
    store(components(-mu * tet.volume * inverse_metric), elastic.groups[group].stiffness, lane);
    elastic.groups[group].inverse_six_volume[at(lane)] = 1.0 / (6.0 * tet.volume);
  });
}

void relax_fully(ElasticForce& elastic, const Topology& topology, std::span<const Vec3> reference_positions,
                 const ElementBlock& block) {
  if (!has_branch(elastic, block)) return;
  for_each_lane(block, [&](Index t, std::size_t group, Index lane) {
    const TetReference tet = make_tet_reference(reference_positions, topology.tet_vertices[at(t)]);
    const Mat3 edges = tet.inverse_edges.inverse();
    store(components(edges.transpose() * edges), elastic.branch.groups[group].relaxed_metric, lane);
  });
}

void read_branch(const ElasticForce& elastic, const ElementBlock& block,
                 std::span<std::array<double, 6>> metric_of_tet) {
  if (!has_branch(elastic, block)) return;
  for_each_lane(block, [&](Index t, std::size_t group, Index lane) {
    const SymmetricLanes& from = elastic.branch.groups[group].relaxed_metric;
    for (std::size_t i = 0; i < 6; ++i) metric_of_tet[at(t)][i] = from[i][at(lane)];
  });
}

void write_branch(ElasticForce& elastic, const ElementBlock& block,
                  std::span<const std::array<double, 6>> metric_of_tet) {
  if (!has_branch(elastic, block)) return;
  for (Index group = 0; group < block.num_groups; ++group) elastic.branch.groups[at(block.first_group + group)] = {};
  for_each_lane(block, [&](Index t, std::size_t group, Index lane) {
    store(metric_of_tet[at(t)], elastic.branch.groups[group].relaxed_metric, lane);
  });
}

}  // namespace knap
