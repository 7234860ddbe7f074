#include "cohesive/intrinsic_bonds.hpp"

#include <array>

#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index facets_per_block = 2048;

// The springs of one facet.
struct Bond {
  Vec3 normal;                     // of the mid-surface, minus to plus
  std::array<Vec3, 3> traction;    // at its corners, of the plus side on the minus side [Pa]
  std::array<double, 3> energy{};  // per area [J/m2]
  Vec3 mean_traction() const { return (traction[0] + traction[1] + traction[2]) / 3.0; }
};

Bond bond_of(const IntrinsicBonds& bonds, const BondScene& scene, Index facet) {
  const Topology& topology = scene.topology;
  std::array<Vec3, 3> middle, jump;
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = xyz(scene.x[at(topology.facet_node(facet, k, 0))]);
    const Vec3 b = xyz(scene.x[at(topology.facet_node(facet, k, 1))]);
    middle[at(k)] = 0.5 * (a + b);
    jump[at(k)] = b - a;
  }
  const CohesiveLaw& law = scene.laws.of(topology.facet_tets[at(facet)][0]);
  const double along = bonds.stiffness[at(facet)];
  const double across = along * law.beta * law.beta / law.kappa;
  Bond bond{.normal = (middle[1] - middle[0]).cross(middle[2] - middle[0]).normalized(), .traction = {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const double jn = jump[k].dot(bond.normal);
    const Vec3 tangential = jump[k] - jn * bond.normal;
    bond.traction[k] = along * jn * bond.normal + across * tangential;
    bond.energy[k] = 0.5 * bond.traction[k].dot(jump[k]);
  }
  return bond;
}

bool holds(const IntrinsicBonds& bonds, const Topology& topology, Index facet) {
  return bonds.stiffness[at(facet)] > 0.0 && topology.facet_state[at(facet)] == FacetState::Bonded;
}

}  // namespace

void part_corners(Topology& topology, NodalState& nodes, std::span<const Index> tets,
                  std::span<const double> corner_mass) {
  std::vector<std::uint8_t> is_taken(at(topology.num_nodes()), 0);
  for (const Index tet : tets)
    for (Index& node : topology.tet_nodes[at(tet)]) {
      const Index vertex = topology.vertex_of_node[at(node)];
      if (is_taken[at(node)] == 1) {
        node = append_copy(nodes, node);
        topology.vertex_of_node.push_back(vertex);
        is_taken.push_back(0);
      }
      is_taken[at(node)] = 1;
      nodes.mass[at(node)] = corner_mass[at(tet)];
    }
}

void add_bond_stiffnesses(const IntrinsicBonds& bonds, const Topology& topology, const LawsOfTets& laws,
                          std::span<const double> facet_area, std::span<double> corner_stiffness) {
  for (Index facet = 0; facet < topology.num_facets(); ++facet) {
    if (bonds.stiffness[at(facet)] == 0.0) continue;
    const auto& tets = topology.facet_tets[at(facet)];
    const CohesiveLaw& law = laws.of(tets[0]);
    const double k = bonds.stiffness[at(facet)] * std::max(1.0, law.beta * law.beta / law.kappa);
    // (u_b - u_a)^2 <= 2 u_a^2 + 2 u_b^2
    for (const auto& corners : topology.facet_corners[at(facet)])
      for (std::size_t side = 0; side < 2; ++side)
        corner_stiffness[at(4 * tets[side] + corners[side])] += 2.0 * k * facet_area[at(facet)] / 3.0;
  }
}

void add_bond_forces(const IntrinsicBonds& bonds, const BondScene& scene, std::span<Vec4> f) {
  const Topology& topology = scene.topology;
  // A node belongs to one tet: by tets, every bond twice, no two threads meet.
  parallel_for(topology.num_tets(), [&](Index tet) {
    for (const Index facet : topology.tet_facets[at(tet)]) {
      if (facet == none || !holds(bonds, topology, facet)) continue;
      const Bond bond = bond_of(bonds, scene, facet);
      const int side = topology.facet_tets[at(facet)][0] == tet ? 0 : 1;
      const double area = (side == 0 ? 1.0 : -1.0) * scene.facet_area[at(facet)] / 3.0;
      for (int k = 0; k < 3; ++k) f[at(topology.facet_node(facet, k, side))] += padded(area * bond.traction[at(k)]);
    }
  });
}

double bond_energy(const IntrinsicBonds& bonds, const BondScene& scene) {
  return ordered_sum<double>(scene.topology.num_facets(), [&](Index facet) {
    if (!holds(bonds, scene.topology, facet)) return 0.0;
    const Bond bond = bond_of(bonds, scene, facet);
    return scene.facet_area[at(facet)] / 3.0 * (bond.energy[0] + bond.energy[1] + bond.energy[2]);
  });
}

double soften_bond(CrackRecord& record, const CohesiveLaw& law, const BondCorner& bond) {
  const double spring = bond.stiffness * bond.area;   // [N/m]
  const double opening = record.strength / spring;    // at the strength
  record.strength /= 1.0 - opening / record.delta_c;  // the softening line goes through that point
  const double mode = law.beta * law.beta / law.kappa;
  const double jn = bond.jump.dot(bond.normal);
  const Vec3 tangential = bond.jump - jn * bond.normal;
  const double jt2 = tangential.squaredNorm();
  record.d_max = std::min(record.delta_c, std::max(opening, std::sqrt(effective_opening2(law, jn, jt2))));
  record.regime = RecordRegime::Softening;
  const double secant = secant_stiffness(record.strength, record.d_max, record.delta_c);
  const Vec3 held = spring * (jn * bond.normal + mode * tangential);
  const Vec3 holds = secant * (std::max(jn, 0.0) * bond.normal + mode * tangential);
  record.impulse = -bond.dt * (held - holds);
  return 0.5 * spring * (jn * jn + mode * jt2) - 0.5 * secant * energy_opening2(law, jn, jt2);
}

std::vector<OverloadedFacet> overloaded_bonds(const IntrinsicBonds& bonds, const BondScene& scene) {
  const Topology& topology = scene.topology;
  std::vector<std::vector<OverloadedFacet>> found(at(num_blocks(topology.num_facets(), facets_per_block)));
  parallel_blocks(to_index(found.size()), [&](Index block) {
    const Index end = std::min(topology.num_facets(), (block + 1) * facets_per_block);
    for (Index facet = block * facets_per_block; facet < end; ++facet) {
      if (!holds(bonds, topology, facet)) continue;
      const Bond bond = bond_of(bonds, scene, facet);
      const Vec3 mean = bond.mean_traction();
      const double effective = effective_traction(scene.laws.of(topology.facet_tets[at(facet)][0]), mean, bond.normal);
      if (effective >= bonds.strength[at(facet)]) found[at(block)].push_back({facet, effective, mean});
    }
  });
  std::vector<OverloadedFacet> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace knap
