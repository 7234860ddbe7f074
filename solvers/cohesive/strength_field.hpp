#pragma once
#include <span>

#include "core/topology.hpp"

namespace knap {

/// Strength and fracture energy of the facets.
struct StrengthOptions {
  double strength = 0.0;          ///< sigma_c [Pa]
  double fracture_energy = 0.0;   ///< mode I [J/m2]
  double weibull_modulus = 0.0;   ///< 0 = the same strength everywhere
  double reference_volume = 0.0;  ///< for which `strength` is the characteristic value [m3]
  std::uint64_t seed = 1;
};

/// Tensile strength of every interior facet [Pa]. Weibull: sigma_c (V0/V (-ln(1-U)))^(1/m), V a quarter of both tets
/// (so that the facets share the volume), U fixed by seed and facet number.
std::vector<double> facet_strengths(const Topology& topology, std::span<const double> tet_volumes,
                                    const StrengthOptions& options);

}  // namespace knap
