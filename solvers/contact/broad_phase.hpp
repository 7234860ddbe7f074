#pragma once
#include <span>

#include "contact/contact_state.hpp"

namespace knap {

/// Position of a contact point [m].
Vec3 position(const ContactPoint& point, std::span<const Vec4> x);

/// Finds anew all pairs of a point and a tet of different fragments closer than the skin, at positions x, from the
/// contact's fragment labels. has_records tells which original vertices still have crack records: those join the pieces
/// of the vertex, so points there do not touch the tets around it.
void rebuild_candidates(ContactState& contact, const Topology& topology, std::span<const Vec4> x,
                        std::span<const std::uint8_t> has_records);

/// Bound of the way that any two nodes come nearer to each other at velocities v [m/s] within dt [m].
double largest_approach(std::span<const Vec4> v, double dt);

}  // namespace knap
