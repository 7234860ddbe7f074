#pragma once
// Tets that belong to a rigid body sleep: no force, no energy, no stress, and the memory of their viscoelastic branch
// stands still.
#include "fem/elastic_force.hpp"

namespace knap {

/// From now on the given tets, ascending, are those that do not sleep. What bulk_state no longer counts is for the
/// caller to book; the share dt/tau of their branch's energy that is already in BranchState::pending is booked all the
/// same. A tet that wakes remembers what its branch had relaxed to.
void set_active_tets(ElasticForce& elastic, const Topology& topology, std::span<const Vec3> reference_positions,
                     std::span<const Index> active);

/// The branch of the given sleeping tets relaxes fully at positions x [m]: they wake without branch stress.
void relax_sleeping(ElasticForce& elastic, const Topology& topology, std::span<const Index> tets,
                    std::span<const Vec4> x);

/// The tets that sleep, ascending.
std::vector<Index> sleeping_tets(const ElasticForce& elastic);

/// What the branch of each tet has relaxed to [m2], whether it sleeps or not; empty without a branch.
std::vector<std::array<double, 6>> relaxed_metrics(const ElasticForce& elastic);
void set_relaxed_metrics(ElasticForce& elastic, std::span<const std::array<double, 6>> metric_of_tet);

}  // namespace knap
