#include "cohesive/strength_field.hpp"

#include <cmath>

#include "core/random.hpp"

namespace knap {

std::vector<double> facet_strengths(const Topology& topology, std::span<const double> tet_volumes,
                                    const StrengthOptions& options) {
  std::vector<double> strengths(at(topology.num_facets()), options.strength);
  if (options.weibull_modulus <= 0.0) return strengths;
  for (Index facet = 0; facet < topology.num_facets(); ++facet) {
    const auto& [minus, plus] = topology.facet_tets[at(facet)];
    const double facet_volume = (tet_volumes[at(minus)] + tet_volumes[at(plus)]) / 4.0;
    std::uint64_t state = options.seed * 0x9e3779b97f4a7c15ULL + static_cast<std::uint64_t>(facet);
    splitmix64(state);
    const double u = uniform01(state);
    strengths[at(facet)] *=
        std::pow(options.reference_volume / facet_volume * -std::log1p(-u), 1.0 / options.weibull_modulus);
  }
  return strengths;
}

}  // namespace knap
