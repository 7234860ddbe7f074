#pragma once
#include <limits>

#include "fem/elastic_force.hpp"
#include "quasistatic/constrained_solver.hpp"

namespace knap {

/// A flat rigid tool; the particle is on the side its normal points to.
struct Platen {
  Vec3 point = Vec3::Zero();                                ///< the middle of its face [m]
  Vec3 normal = Vec3::UnitZ();                              ///< unit
  double radius = std::numeric_limits<double>::infinity();  ///< of its face [m]
  double friction = 0.0;                                    ///< Coulomb [-]
  double share = 0.5;                                       ///< of the approach that this platen travels [-]
};

/// What is loaded: an elastic body without cracks.
struct LoadedBody {
  const Topology& topology;
  std::span<const Vec3> reference_positions;  ///< by vertex [m]
  const Material& material;                   ///< its long-term elasticity counts
};

/// A node and the platen it may be on.
struct PlatenContact {
  bool is_closed = false;
  bool slides = false;
  std::uint8_t platen = 0;
  double push = 0.0;                    ///< normal force on the node [N]
  Vec3 friction = Vec3::Zero();         ///< force on the node along the platen [N]
  Vec3 friction_before = Vec3::Zero();  ///< at the start of this load step [N]
  Vec3 anchor = Vec3::Zero();           ///< where the node was then [m]
};

/// An equilibrium on the load path, with all it depends on.
struct LoadState {
  double approach = 0.0;                ///< of the platens since they both touched [m]
  std::vector<Vec4> x;                  ///< by node [m]
  std::vector<PlatenContact> contacts;  ///< by node
};

/// Finds equilibria of a body between two parallel platens that face each other, at prescribed approach.
///
/// Newton's iteration and the set of touching nodes go together (a primal-dual active set: Hintermueller, Ito & Kunisch
/// 2003, SIAM J. Optim. 13, 865): after each iteration nodes behind a platen join it, and nodes that it would have to
/// pull leave it. Coulomb's friction is integrated over a load step like plasticity, by return to the cone, with a
/// tangential stiffness that is high against that of the node (Wriggers 2006, Computational Contact Mechanics, 5.2).
///
/// Between frictionless platens nothing holds a body sideways, and a sphere not against rolling either. There every
/// step of the iteration has no momentum along the platens and no angular momentum: rigid motions appear only where the
/// deformation asks for them. No force is needed for that unless the platens press past each other, and then it is the
/// body's own inertia, as in a dynamic run; out_of_line() tells. Elsewhere soft springs act on the steps and vanish
/// with them.
class EquilibriumSolver {
 public:
  /// The platens must have opposite normals along z: platens[0] is below. Throws InputError if the body does not fit
  /// between them.
  EquilibriumSolver(const LoadedBody& body, const std::array<Platen, 2>& platens);

  /// The body at rest, touching both platens.
  LoadState start() const;
  /// Takes a state to the equilibrium at another approach [m]. False: none was found, the state is spoilt.
  [[nodiscard]] bool solve(LoadState& state, double approach);
  /// dx/d(approach) by node [-], with the contacts as they are.
  std::vector<Vec4> rate(const LoadState& state);

  /// Of the state just solved.
  double force(const LoadState& state) const;  ///< by which a platen presses: the mean of both [N]
  /// How far apart the lines of the two platens' forces are [m].
  double out_of_line(const LoadState& state) const;
  double strain_energy(const LoadState& state) { return knap::strain_energy(elastic_, state.x); }  ///< [J]
  TetStresses stresses(const LoadState& state);

  /// How far the platens come together until both touch [m], of which each travels its share.
  double free_approach() const { return free_approach_; }
  /// Height of platen k's face where it was given [m].
  double start_height(int platen) const { return platens_[static_cast<std::size_t>(platen)].point.z(); }
  /// Height of platen k's face [m].
  double height(int platen, double approach) const;
  int iterations() const { return iterations_; }
  int factorisations() const { return linear_.factorisations(); }

 private:
  bool step(LoadState& state);
  void move(LoadState& state, std::span<const Vec4> from, const Eigen::VectorXd& d, double part);
  void search_line(LoadState& state, std::span<const Vec4> from, const LinearConstraints& constraints,
                   const Eigen::VectorXd& d, double slope);
  bool update_contacts(LoadState& state);
  void update_friction(LoadState& state, Index node) const;
  void add_friction_stiffness(const LoadState& state);
  bool touch(LoadState& state, Index node) const;
  bool is_frictionless() const { return platens_[0].friction == 0.0 && platens_[1].friction == 0.0; }
  Eigen::VectorXd load(const LoadState& state) const;
  LinearConstraints constraints(const LoadState& state) const;
  bool solve_linear(const LinearConstraints& constraints, const Eigen::VectorXd& right, Eigen::VectorXd& d);

  LoadedBody body_;
  std::array<Platen, 2> platens_;
  Material material_;  // without its viscoelastic branch, which has relaxed
  ElasticForce elastic_;
  SparseMatrix stiffness_;
  ConstrainedSolver linear_;
  std::vector<Vec4> f_;  // of the bulk at the state last measured [N]
  double extent_ = 0.0;
  double free_approach_ = 0.0;
  double lift_ = 0.0;            // of the body, to touch both
  std::vector<double> hold_;     // of a sticking node, by node [N/m]
  std::vector<double> volume_;   // by node [m3]
  double mean_stiffness_ = 0.0;  // of the diagonal [N/m]
  double spring_ = 0.0;          // over that
  bool holds_ = false;  // nodes do not slide yet: a body just touched must find its contacts before it slips away
  int iterations_ = 0;
};

}  // namespace knap
