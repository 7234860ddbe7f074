#pragma once
#include "fem/elastic_force.hpp"

namespace knap {

/// Writes the reference data of the tets of a block into its lanes. Throws InputError on a tet without positive volume.
void fill_groups(ElasticForce& elastic, const Topology& topology, std::span<const Vec3> reference_positions,
                 const ElementBlock& block);

/// Gives the branch of a block's tets no strain in the reference state, if they have a branch.
void relax_fully(ElasticForce& elastic, const Topology& topology, std::span<const Vec3> reference_positions,
                 const ElementBlock& block);

/// The relaxed metrics of a block's tets from its lanes into an array by tet, and back.
void read_branch(const ElasticForce& elastic, const ElementBlock& block,
                 std::span<std::array<double, 6>> metric_of_tet);
void write_branch(ElasticForce& elastic, const ElementBlock& block,
                  std::span<const std::array<double, 6>> metric_of_tet);

}  // namespace knap
