#pragma once
#include <functional>

#include "cohesive/insertion_criterion.hpp"
#include "quasistatic/equilibrium.hpp"

namespace knap {

/// When the first facet opens.
struct OnsetCriterion {
  const CohesiveLaw& law;
  std::span<const double> strength;  ///< by facet [Pa]
};

/// One equilibrium on the way.
struct LoadStep {
  double approach = 0.0;          ///< of the platens since both touched [m]
  double force = 0.0;             ///< between them [N]
  double utilisation = 0.0;       ///< effective traction over strength of the most loaded facet [-]
  std::array<int, 2> contacts{};  ///< nodes on each platen
  int iterations = 0;             ///< of Newton's method
};

struct LoadPathOptions {
  double onset_tolerance = 1e-3;   ///< of the approach at onset [-]
  double largest_approach = 0.25;  ///< over the distance of the platens when both touch; a larger onset is an error
  double growth = 1.4;             ///< of the approach from one load step to the next, at most
  std::function<void(const LoadStep&)> progress{};  ///< called after each load step
};

/// The body as it is when its first facet is about to open.
struct Onset {
  std::vector<Vec4> x;          ///< by node [m]
  std::vector<Vec4> rate;       ///< dx/d(approach) by node [-]
  std::array<Vec3, 2> path;     ///< how far each platen has come from where it was given [m]
  OverloadedFacet facet;        ///< the first, at or just above its strength
  double force = 0.0;           ///< between the platens [N]
  double approach = 0.0;        ///< since both touched [m]
  double strain_energy = 0.0;   ///< [J]
  double out_of_line = 0.0;     ///< distance of the lines of the platens' forces [m]
  std::vector<LoadStep> steps;  ///< by approach, all below the onset but the last
  int factorisations = 0;
};

/// Presses a body between two parallel platens until a facet reaches its strength, on equilibria: the elastic part of a
/// slow compression. Throws InputError when the platens do not face each other, the body does not fit between them or
/// nothing breaks up to the largest approach, RuntimeFailure when no equilibrium is found.
Onset load_to_onset(const LoadedBody& body, const std::array<Platen, 2>& platens, const OnsetCriterion& criterion,
                    const LoadPathOptions& options = {});

}  // namespace knap
