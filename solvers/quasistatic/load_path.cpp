#include "quasistatic/load_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace knap {
namespace {

constexpr double parallel_tolerance = 1e-9;
constexpr double smallest_growth = 1.002;
constexpr int most_refinements = 60;
// A body that only touches is pressed at first by this share of its height.
constexpr double smallest_first_approach = 1e-4;
// So many nodes below a platen's face hold a body against rolling.
constexpr std::size_t nodes_that_support = 4;

// The same problem with the lower platen's normal along z.
struct UprightProblem {
  Mat3 turn = Mat3::Identity();
  std::vector<Vec3> vertices;
  std::array<Platen, 2> platens;
};

UprightProblem upright(const LoadedBody& body, const std::array<Platen, 2>& platens) {
  const Vec3& axis = platens[0].normal;
  if ((platens[0].normal + platens[1].normal).norm() > parallel_tolerance)
    throw InputError("quasistatic: the two platens must be parallel and face each other");
  UprightProblem problem{Mat3::Identity(), {body.reference_positions.begin(), body.reference_positions.end()}, platens};
  if (axis == Vec3::UnitZ()) return problem;  // not a bit is changed
  problem.turn = Eigen::Quaterniond::FromTwoVectors(axis, Vec3::UnitZ()).toRotationMatrix();
  for (Vec3& v : problem.vertices) v = problem.turn * v;
  for (Platen& platen : problem.platens) platen.point = problem.turn * platen.point;
  return problem;
}

// Far enough for several nodes to lie behind each face.
double first_approach(const LoadState& start) {
  std::vector<double> heights;
  for (const Vec4& x : start.x) heights.push_back(x.z());
  std::sort(heights.begin(), heights.end());
  const std::size_t k = std::min(nodes_that_support, heights.size()) - 1;
  const double extent = heights.back() - heights.front();
  const double below = heights[k] - heights.front();
  const double above = heights.back() - heights[heights.size() - 1 - k];
  return std::max(smallest_first_approach * extent, 2.02 * std::max(below, above));
}

class LoadPath {
 public:
  LoadPath(const LoadedBody& body, const std::array<Platen, 2>& platens, const OnsetCriterion& criterion,
           const LoadPathOptions& options)
      : body_(body), criterion_(criterion), options_(options), solver_(body, platens), low_(solver_.start()) {
    const double height = solver_.height(1, 0.0) - solver_.height(0, 0.0);
    largest_approach_ = options.largest_approach * height;
  }

  // Brackets the onset from below and above.
  void load() {
    double approach = first_approach(low_);
    while (!step_to(approach)) {
      if (approach >= largest_approach_)
        throw InputError(fmt::format(
            "quasistatic: no facet reaches its strength up to an approach of {:.4g} m, where the most loaded one bears "
            "{:.3g} of it; a lower fracture.strength or a run without [quasistatic] is needed",
            approach, lower().utilisation));
      approach = std::min(largest_approach_, approach * growth());
    }
  }

  // Closes the bracket.
  void refine() {
    for (int i = 0; high_.approach - low_.approach > options_.onset_tolerance * high_.approach; ++i) {
      if (i == most_refinements) throw RuntimeFailure("quasistatic: the onset is not found");
      step_to(next_guess(i));
    }
  }

  Onset onset() {
    Onset onset;
    onset.facet = high_facet_;
    onset.force = solver_.force(high_);
    onset.approach = high_.approach;
    onset.rate = solver_.rate(high_);
    if (onset.rate.empty()) throw RuntimeFailure("quasistatic: the body is not stable at the onset");
    onset.strain_energy = solver_.strain_energy(high_);
    onset.out_of_line = solver_.out_of_line(high_);
    for (int k = 0; k < 2; ++k)
      onset.path[static_cast<std::size_t>(k)] = Vec3(0, 0, solver_.height(k, high_.approach) - solver_.start_height(k));
    onset.factorisations = solver_.factorisations();
    onset.x = std::move(high_.x);
    onset.steps = std::move(steps_);
    onset.steps.push_back(high_step_);
    return onset;
  }

 private:
  // Solves at an approach, with smaller steps on the way where needed. Whether the onset lies before it.
  bool step_to(double approach) {
    LoadState state = low_;
    if (!solver_.solve(state, approach)) {
      const double half = 0.5 * (low_.approach + approach);
      if (steps_.empty()) return step_from_rest(approach);
      if (half - low_.approach < 0.01 * options_.onset_tolerance * approach)
        throw RuntimeFailure(fmt::format("quasistatic: no equilibrium found at an approach of {:.6g} m", approach));
      return step_to(half) || step_to(approach);
    }
    return book(std::move(state));
  }

  // On few nodes a body may roll away: the first step then goes further.
  bool step_from_rest(double approach) {
    if (approach > largest_approach_)
      throw RuntimeFailure("quasistatic: no equilibrium of the body as it lies is found");
    return step_to(1.5 * approach);
  }

  bool book(LoadState state) {
    const OverloadedFacet facet = most_loaded_facet(body_.topology, state.x, solver_.stresses(state),
                                                    criterion_.strength, {std::span(&criterion_.law, 1), {}});
    LoadStep step{state.approach, solver_.force(state), 0.0, {}, solver_.iterations()};
    if (facet.facet != none) step.utilisation = facet.effective / criterion_.strength[at(facet.facet)];
    for (const PlatenContact& contact : state.contacts) step.contacts[contact.platen] += contact.is_closed ? 1 : 0;
    if (options_.progress) options_.progress(step);
    if (step.utilisation < 1.0) {
      low_ = std::move(state);
      steps_.push_back(step);
      return false;
    }
    high_ = std::move(state);
    high_step_ = step;
    high_facet_ = facet;
    return true;
  }

  LoadStep lower() const { return steps_.empty() ? LoadStep{} : steps_.back(); }

  // From the slope of the utilisation over the approach, both logarithmic, to just above 1.
  double growth() const {
    const LoadStep& last = steps_.back();
    double power = 0.5;
    if (steps_.size() > 1) {
      const LoadStep& before = steps_[steps_.size() - 2];
      power = std::log(last.utilisation / before.utilisation) / std::log(last.approach / before.approach);
    }
    const double wanted = power > 0.1 ? std::pow(1.001 / last.utilisation, 1.0 / power) : options_.growth;
    return std::clamp(wanted * (1.0 + 0.4 * options_.onset_tolerance), smallest_growth, options_.growth);
  }

  // Beside the secant, on the side of the farther end of the bracket, so that both close in; should that not do, the
  // middle.
  double next_guess(int i) const {
    const double width = high_.approach - low_.approach;
    if (i >= 4 && i % 2 == 0) return low_.approach + 0.5 * width;
    const double rise = high_step_.utilisation - lower().utilisation;
    const double secant = low_.approach + (1.0 - lower().utilisation) / rise * width;
    const double aside = 0.45 * options_.onset_tolerance * high_.approach;
    const double guess = high_.approach - secant > secant - low_.approach ? secant + aside : secant - aside;
    return std::clamp(guess, low_.approach + 1e-4 * width, high_.approach - 1e-4 * width);
  }

  LoadedBody body_;
  OnsetCriterion criterion_;
  const LoadPathOptions& options_;
  EquilibriumSolver solver_;
  double largest_approach_ = 0.0;
  LoadState low_, high_;  // the last equilibrium below the onset, the first above
  LoadStep high_step_;
  OverloadedFacet high_facet_;
  std::vector<LoadStep> steps_;
};

}  // namespace

Onset load_to_onset(const LoadedBody& body, const std::array<Platen, 2>& platens, const OnsetCriterion& criterion,
                    const LoadPathOptions& options) {
  const UprightProblem problem = upright(body, platens);
  LoadPath path({body.topology, problem.vertices, body.material}, problem.platens, criterion, options);
  path.load();
  path.refine();
  Onset onset = path.onset();
  if (problem.turn == Mat3::Identity()) return onset;
  const Mat3 back = problem.turn.transpose();
  for (Vec4& x : onset.x) x = padded(back * xyz(x));
  for (Vec4& rate : onset.rate) rate = padded(back * xyz(rate));
  for (Vec3& travel : onset.path) travel = back * travel;
  onset.facet.traction = back * onset.facet.traction;
  return onset;
}

}  // namespace knap
