#include "quasistatic/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"
#include "fem/tet_reference.hpp"

namespace knap {
namespace {

// Of the force between the platens: what may be left of the forces on the nodes, and with how much a node may hang on a
// platen.
constexpr double force_tolerance = 1e-6;
// Of the body's extent: how far behind a platen a node may be.
constexpr double gap_tolerance = 1e-12;
// Of the mean diagonal of the stiffness: the springs on the steps. More where the stiffness is not positive definite (a
// body that would roll over on few nodes), up to the second.
constexpr double smallest_spring = 1e-8;
constexpr double largest_spring = 1e-3;
constexpr int most_iterations = 60;
// Stiffness of a sticking node's hold on the platen over its own in the body.
constexpr double hold_ratio = 3.0;
// By how much a step must lower the slope of the potential along it, and how often that is tried.
constexpr double slope_drop = 0.5;
constexpr int most_line_searches = 8;

// The sign of the height of platen k's normal.
double direction(int platen) { return platen == 0 ? 1.0 : -1.0; }

bool faces(const Platen& platen, const Vec4& x) {
  return (x.head<2>() - platen.point.head<2>()).squaredNorm() <= platen.radius * platen.radius;
}

Material without_branch(Material material) {
  material.branch = {};
  return material;
}

std::vector<Vec4> positions(const LoadedBody& body) {
  std::vector<Vec4> x;
  for (const Index vertex : body.topology.vertex_of_node) x.push_back(padded(body.reference_positions[at(vertex)]));
  return x;
}

// How near the body is to platen k's face: its lowest height above it [m].
double nearest(std::span<const Vec4> x, const Platen& platen, int k) {
  double gap = std::numeric_limits<double>::infinity();
  for (const Vec4& node : x)
    if (faces(platen, node)) gap = std::min(gap, direction(k) * (node.z() - platen.point.z()));
  return gap;
}

}  // namespace

EquilibriumSolver::EquilibriumSolver(const LoadedBody& body, const std::array<Platen, 2>& platens)
    : body_(body),
      platens_(platens),
      material_(without_branch(body.material)),
      elastic_(make_elastic_force(body.topology, body.reference_positions, material_)),
      stiffness_(stiffness_pattern(body.topology)),
      linear_(stiffness_),
      f_(at(body.topology.num_nodes()), Vec4::Zero()) {
  const auto x = positions(body);
  Vec4 low = x.front(), high = low;
  for (const Vec4& node : x) low = low.cwiseMin(node), high = high.cwiseMax(node);
  extent_ = (high - low).maxCoeff();
  const double below = nearest(x, platens[0], 0);
  const double above = nearest(x, platens[1], 1);
  free_approach_ = below + above;
  if (!std::isfinite(free_approach_)) throw InputError("quasistatic: a platen does not lie over the particle");
  if (free_approach_ < -gap_tolerance * extent_)
    throw InputError(fmt::format("quasistatic: the particle does not fit between the platens, it is {:.4g} m too high",
                                 -free_approach_));
  free_approach_ = std::max(0.0, free_approach_);
  lift_ = platens[0].share * free_approach_ - below;
  update_stiffness(stiffness_, body.topology, body.reference_positions, material_, x);
  mean_stiffness_ = stiffness_.diagonal().mean();
  for (Index i = 0; i < to_index(x.size()); ++i)
    hold_.push_back(hold_ratio * stiffness_.diagonal().segment<3>(3 * i).mean());
  volume_.assign(x.size(), 0.0);
  for (Index tet = 0; tet < body.topology.num_tets(); ++tet)
    for (const Index node : body.topology.tet_nodes[at(tet)])
      volume_[at(node)] +=
          make_tet_reference(body.reference_positions, body.topology.tet_vertices[at(tet)]).volume / 4.0;
}

LoadState EquilibriumSolver::start() const {
  LoadState state{0.0, positions(body_), {}};
  for (Vec4& x : state.x) x.z() += lift_;
  state.contacts.resize(state.x.size());
  return state;
}

double EquilibriumSolver::height(int platen, double approach) const {
  const Platen& p = platens_[static_cast<std::size_t>(platen)];
  return p.point.z() + direction(platen) * p.share * (free_approach_ + approach);
}

double EquilibriumSolver::force(const LoadState& state) const {
  double sum = 0.0;
  for (const PlatenContact& contact : state.contacts) sum += std::max(0.0, contact.push);
  return 0.5 * sum;
}

double EquilibriumSolver::out_of_line(const LoadState& state) const {
  std::array<Eigen::Vector2d, 2> moment{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  std::array<double, 2> sum{};
  for (Index i = 0; i < to_index(state.x.size()); ++i) {
    const PlatenContact& contact = state.contacts[at(i)];
    moment[contact.platen] += contact.push * state.x[at(i)].head<2>();
    sum[contact.platen] += contact.push;
  }
  return (moment[0] / sum[0] - moment[1] / sum[1]).norm();
}

TetStresses EquilibriumSolver::stresses(const LoadState& state) {
  update_stress(elastic_, state.x);
  return {elastic_.stress, elastic_.stress_bound};
}

// Closes the contact of a node that is behind a platen.
bool EquilibriumSolver::touch(LoadState& state, Index node) const {
  const Vec4& x = state.x[at(node)];
  for (int k = 0; k < 2; ++k) {
    const Platen& platen = platens_[static_cast<std::size_t>(k)];
    const double gap = direction(k) * (x.z() - height(k, state.approach));
    if (gap >= -gap_tolerance * extent_ || !faces(platen, x)) continue;
    PlatenContact& contact = state.contacts[at(node)];
    contact.platen = static_cast<std::uint8_t>(k);
    contact.is_closed = true;
    contact.slides = platen.friction == 0.0;
    contact.friction_before.setZero();
    return true;
  }
  return false;
}

// What Newton's iteration is to balance: the forces of the bulk and those of friction.
Eigen::VectorXd EquilibriumSolver::load(const LoadState& state) const {
  Eigen::VectorXd right(stiffness_.cols());
  for (Index i = 0; i < to_index(state.x.size()); ++i) {
    const PlatenContact& contact = state.contacts[at(i)];
    right.segment<3>(3 * i) = xyz(f_[at(i)]);
    if (contact.is_closed) right.segment<3>(3 * i) += contact.friction;
  }
  return right;
}

LinearConstraints EquilibriumSolver::constraints(const LoadState& state) const {
  LinearConstraints constraints{Eigen::VectorXd::Ones(stiffness_.cols()), {}};
  for (Index i = 0; i < to_index(state.contacts.size()); ++i) {
    const PlatenContact& contact = state.contacts[at(i)];
    if (contact.is_closed) constraints.is_free[3 * i + 2] = 0.0;
  }
  if (!is_frictionless()) return constraints;
  Vec3 centre = Vec3::Zero();
  double volume = 0.0;
  for (Index i = 0; i < to_index(state.x.size()); ++i) {
    centre += volume_[at(i)] * xyz(state.x[at(i)]);
    volume += volume_[at(i)];
  }
  centre /= volume;
  Eigen::MatrixXd momenta(stiffness_.cols(), 5);  // two linear, three angular, as functions of the step
  for (Index i = 0; i < to_index(state.x.size()); ++i) {
    const Vec3 arm = xyz(state.x[at(i)]) - centre;
    momenta.block<3, 2>(3 * i, 0) = volume_[at(i)] * Mat3::Identity().leftCols<2>();
    for (int axis = 0; axis < 3; ++axis)
      momenta.block<3, 1>(3 * i, 2 + axis) = volume_[at(i)] * Vec3::Unit(axis).cross(arm);
  }
  momenta.array().colwise() *= constraints.is_free.array();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(momenta.colwise().normalized());
  constraints.still = qr.householderQ() * Eigen::MatrixXd::Identity(stiffness_.cols(), 5);
  return constraints;
}

bool EquilibriumSolver::solve_linear(const LinearConstraints& constraints, const Eigen::VectorXd& right,
                                     Eigen::VectorXd& d) {
  const Eigen::VectorXd prescribed = d;
  for (double added = 0.0; spring_ <= 1.01 * largest_spring; spring_ *= 10.0) {
    const double spring = spring_ * mean_stiffness_;
    for (Eigen::Index i = 0; i < stiffness_.cols(); ++i)
      stiffness_.valuePtr()[stiffness_.outerIndexPtr()[i]] += spring - added;  // the diagonal comes first
    added = spring;
    d = prescribed;
    if (linear_.solve(stiffness_, constraints, right, d)) return true;
  }
  return false;
}

void EquilibriumSolver::move(LoadState& state, std::span<const Vec4> from, const Eigen::VectorXd& d, double part) {
  for (Index i = 0; i < to_index(state.x.size()); ++i) {
    xyz(state.x[at(i)]) = xyz(from[at(i)]) + part * d.segment<3>(3 * i);
    const PlatenContact& contact = state.contacts[at(i)];
    if (contact.is_closed) state.x[at(i)].z() = height(contact.platen, state.approach);  // exactly
  }
  update_elastic_forces(elastic_, state.x, f_, 0.0);
}

// Where friction turns along a step, a full one may go too far: the part of it is sought at which the potential, that
// of friction at constant push included, is lowest.
void EquilibriumSolver::search_line(LoadState& state, std::span<const Vec4> from, const LinearConstraints& constraints,
                                    const Eigen::VectorXd& d, double slope) {
  double low = 0.0, slope_low = slope, high = 1.0;
  for (int i = 0; i < most_line_searches; ++i) {
    for (Index node = 0; node < to_index(state.x.size()); ++node)
      if (state.contacts[at(node)].is_closed) update_friction(state, node);
    const double here = d.dot(constraints.project(load(state)));
    if (here >= -slope_drop * slope) return;
    const double part = low + (high - low) * std::max(0.1, slope_low / (slope_low - here));
    high = part;
    move(state, from, d, part);
  }
}

bool EquilibriumSolver::step(LoadState& state) {
  update_stiffness(stiffness_, body_.topology, body_.reference_positions, material_, state.x);
  add_friction_stiffness(state);
  Eigen::VectorXd d = Eigen::VectorXd::Zero(stiffness_.cols());
  bool is_moved = false;  // by the platens
  for (Index i = 0; i < to_index(state.x.size()); ++i) {
    const PlatenContact& contact = state.contacts[at(i)];
    if (!contact.is_closed) continue;
    d[3 * i + 2] = height(contact.platen, state.approach) - state.x[at(i)].z();
    is_moved |= d[3 * i + 2] != 0.0;
  }
  const LinearConstraints constraints = this->constraints(state);
  const Eigen::VectorXd right = load(state);
  if (!solve_linear(constraints, right, d)) return false;
  const std::vector<Vec4> from = state.x;
  move(state, from, d, 1.0);
  if (!is_moved && !is_frictionless()) search_line(state, from, constraints, d, d.dot(constraints.project(right)));
  return true;
}

// Coulomb's law: the force of an elastic hold, returned to the cone where it is beyond.
void EquilibriumSolver::update_friction(LoadState& state, Index node) const {
  PlatenContact& contact = state.contacts[at(node)];
  const Vec4& x = state.x[at(node)];
  const double most = platens_[contact.platen].friction * std::max(0.0, contact.push);
  const Vec3 slip(x.x() - contact.anchor.x(), x.y() - contact.anchor.y(), 0.0);
  contact.friction = contact.friction_before - hold_[at(node)] * slip;
  const double held = contact.friction.norm();
  contact.slides = held >= most && !(holds_ && most > 0.0);
  if (contact.slides) contact.friction *= held > 0.0 ? most / held : 0.0;
}

// The derivative of the friction forces at constant push; across its direction a sliding node is held too.
void EquilibriumSolver::add_friction_stiffness(const LoadState& state) {
  for (Index i = 0; i < to_index(state.x.size()); ++i) {
    const PlatenContact& contact = state.contacts[at(i)];
    if (!contact.is_closed) continue;
    const double hold = hold_[at(i)];
    Eigen::Matrix2d k = hold * Eigen::Matrix2d::Identity();
    if (contact.slides) {
      const double most = contact.friction.norm();
      if (most == 0.0) continue;
      const Vec3 slip = xyz(state.x[at(i)]) - contact.anchor;
      const Eigen::Vector2d along = contact.friction.head<2>() / most;
      const double held = (contact.friction_before - hold * slip).head<2>().norm();
      k = hold * most / held * (Eigen::Matrix2d::Identity() - along * along.transpose());
    }
    const Index* column = stiffness_.outerIndexPtr() + 3 * i;
    stiffness_.valuePtr()[column[0]] += k(0, 0);
    stiffness_.valuePtr()[column[0] + 1] += k(1, 0);
    stiffness_.valuePtr()[column[1]] += k(1, 1);
  }
}

bool EquilibriumSolver::update_contacts(LoadState& state) {
  for (Index i = 0; i < to_index(state.x.size()); ++i) {
    PlatenContact& contact = state.contacts[at(i)];
    contact.push = contact.is_closed ? -direction(contact.platen) * f_[at(i)].z() : 0.0;
  }
  const double pull = force_tolerance * force(state);
  bool changed = false;
  for (Index i = 0; i < to_index(state.x.size()); ++i) {
    PlatenContact& contact = state.contacts[at(i)];
    if (contact.is_closed && contact.push < -pull) {
      contact = {.platen = contact.platen, .anchor = contact.anchor};
      changed = true;
    } else if (!contact.is_closed) {
      changed |= touch(state, i);
    }
    if (contact.is_closed) update_friction(state, i);
  }
  return changed;
}

bool EquilibriumSolver::solve(LoadState& state, double approach) {
  state.approach = approach;
  iterations_ = 0;
  spring_ = smallest_spring;
  for (Index i = 0; i < to_index(state.x.size()); ++i) {
    PlatenContact& contact = state.contacts[at(i)];
    contact.anchor = xyz(state.x[at(i)]);
    contact.friction_before = contact.friction;
  }
  holds_ = std::none_of(state.contacts.begin(), state.contacts.end(), [](const auto& c) { return c.is_closed; });
  if (holds_)
    for (Index i = 0; i < to_index(state.x.size()); ++i) touch(state, i);
  update_elastic_forces(elastic_, state.x, f_, 0.0);
  for (bool at_rest = false; !at_rest;) {
    if (++iterations_ > most_iterations || !step(state)) return false;
    const bool changed = update_contacts(state);
    const Eigen::VectorXd unbalanced = constraints(state).project(load(state));
    if (!unbalanced.allFinite()) return false;
    at_rest = !changed && unbalanced.norm() <= force_tolerance * force(state);
    if (holds_ && at_rest) {  // held by as much as it takes; now by friction
      holds_ = at_rest = false;
      update_contacts(state);
    }
  }
  return force(state) > 0.0;
}

std::vector<Vec4> EquilibriumSolver::rate(const LoadState& state) {
  spring_ = smallest_spring;
  update_stiffness(stiffness_, body_.topology, body_.reference_positions, material_, state.x);
  add_friction_stiffness(state);
  Eigen::VectorXd d = Eigen::VectorXd::Zero(stiffness_.cols());
  for (Index i = 0; i < to_index(state.x.size()); ++i) {
    const PlatenContact& contact = state.contacts[at(i)];
    if (contact.is_closed) d[3 * i + 2] = direction(contact.platen) * platens_[contact.platen].share;
  }
  if (!solve_linear(constraints(state), Eigen::VectorXd::Zero(d.size()), d)) return {};
  std::vector<Vec4> rate;
  for (Index i = 0; i < to_index(state.x.size()); ++i) rate.push_back(padded(d.segment<3>(3 * i)));
  return rate;
}

}  // namespace knap
