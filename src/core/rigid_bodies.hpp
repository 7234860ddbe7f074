#pragma once
// Fragments carried as rigid bodies. A body is made of nodes: its mass and inertia are those of the lumped nodal
// masses, so that momenta and kinetic energy of nodes that move by v = V + w x r are the body's. The angular momentum
// is the state and the spin follows from it: free rotation then keeps it exactly.
#include <Eigen/Geometry>
#include <limits>

#include "core/csr.hpp"
#include "core/nodal_state.hpp"

namespace knap {

/// One fragment carried as a rigid body. Velocities live at half steps, like those of nodes.
struct RigidBody {
  static constexpr double unbreakable = std::numeric_limits<double>::infinity();

  double mass = 0.0;  ///< [kg]
  Vec3 centre = Vec3::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body axes were the world's when it was made
  Vec3 velocity = Vec3::Zero();                                     ///< of the centre [m/s]
  Vec3 angular_momentum = Vec3::Zero();                             ///< about the centre, world axes [kg m2/s]
  Vec3 velocity_before = Vec3::Zero();                              ///< before this step's kick and impulses [m/s]
  Vec3 angular_momentum_before = Vec3::Zero();                      ///< likewise [kg m2/s]
  Mat3 inertia = Mat3::Zero();                                      ///< about the centre, body axes [kg m2]
  Mat3 inverse_inertia = Mat3::Zero();                              ///< body axes [1/(kg m2)]
  Mat3 inverse_inertia_world = Mat3::Zero();                        ///< derived: at the current orientation [1/(kg m2)]
  double size = 0.0;                                                ///< diameter of the sphere of its volume [m]
  double radius = 0.0;          ///< of the sphere about the centre that holds its nodes [m]
  double strength = 0.0;        ///< of its weakest facet [Pa]; infinite = nothing left to break
  double critical_speed = 0.0;  ///< at which an impact could break it [m/s]; infinite likewise
  double crossing_time = 0.0;   ///< of a wave [s]
  double load = 0.0;            ///< sum of contact forces, averaged over a crossing time [N]
  double strain_energy = 0.0;   ///< stored in its frozen tets [J]

  bool can_break() const { return strength < unbreakable; }
};

/// All bodies of a run and who belongs to them.
struct RigidBodies {
  std::vector<RigidBody> bodies;
  std::vector<Index> body_of_node;  ///< none = deformable; nodes beyond the end are deformable, too
  std::vector<Index> body_of_tet;   ///< none = deformable; empty while there is no body
  Csr nodes_of_body;
  std::vector<Vec3> place;  ///< by nodes_of_body.items: of the node from the centre, body axes [m]

  /// What the contacts tell, by body, for the present step, in the order of the bodies.
  std::vector<double> approach;  ///< largest approach speed of its contacts, before the solve [m/s]
  std::vector<double> push;      ///< sum of the magnitudes of its contact impulses, tools included [N s]

  Index num_bodies() const { return to_index(bodies.size()); }
  Index of_node(Index node) const { return at(node) < body_of_node.size() ? body_of_node[at(node)] : none; }
  Index of_tet(Index tet) const { return at(tet) < body_of_tet.size() ? body_of_tet[at(tet)] : none; }
};

/// A body of the given nodes, at their positions and with their momenta; mass, motion and inertia only.
RigidBody make_rigid_body(std::span<const Index> nodes, const NodalState& state);
/// Appends a body and its parts; x are the positions of all nodes [m].
void append_body(RigidBodies& rigid, const RigidBody& body, std::span<const Index> tets, std::span<const Index> nodes,
                 std::span<const Vec4> x);
/// Removes the bodies marked by 1; the others keep their order, and what contacts have told is cleared.
void remove_bodies(RigidBodies& rigid, std::span<const std::uint8_t> leaves);

/// Clears what the contact layer has told, at the start of a step.
void clear_contact_reports(RigidBodies& rigid);

/// Derives inverse_inertia_world from orientation and inverse_inertia.
void update_inertia(RigidBody& body);
/// Angular velocity [rad/s].
inline Vec3 spin(const RigidBody& body) { return body.inverse_inertia_world * body.angular_momentum; }
/// Velocity of the body's matter at a point in space [m/s].
inline Vec3 velocity_at(const RigidBody& body, const Vec3& point) {
  return body.velocity + spin(body).cross(point - body.centre);
}
/// The same before this step's kick and impulses [m/s].
inline Vec3 velocity_before_at(const RigidBody& body, const Vec3& point) {
  const Vec3 spin_before = body.inverse_inertia_world * body.angular_momentum_before;
  return body.velocity_before + spin_before.cross(point - body.centre);
}
/// Changes the momenta by an impulse [N s] at a point in space.
inline void apply_impulse(RigidBody& body, const Vec3& point, const Vec3& impulse) {
  body.velocity += impulse / body.mass;
  body.angular_momentum += (point - body.centre).cross(impulse);
}
/// Velocity change at `point` is this matrix times an impulse at the same point [1/kg].
Mat3 inverse_mass_at(const RigidBody& body, const Vec3& point);
/// Kinetic energy [J], exactly that of the body's nodes.
inline double kinetic_energy(const RigidBody& body) {
  return 0.5 * body.mass * body.velocity.squaredNorm() + 0.5 * body.angular_momentum.dot(spin(body));
}

}  // namespace knap
