#include "cohesive/strength_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/bar_mesh.hpp"

namespace knap {
namespace {

std::vector<double> unit_volumes(const Topology& topology, double volume) {
  return std::vector<double>(at(topology.num_tets()), volume);
}

TEST(StrengthField, UniformWithoutAModulus) {
  const Topology topology = make_topology(bar_mesh({2, 2, 2}, 1.0));
  for (const double s : facet_strengths(topology, unit_volumes(topology, 1.0), {.strength = 5e6})) EXPECT_EQ(s, 5e6);
}

// For facets of the reference volume, P(strength < s) = 1 - exp(-(s/s0)^m): mean s0 Gamma(1 + 1/m). The standard error
// of the mean over these 20k facets is below 0.3 %.
TEST(StrengthField, WeibullHasItsMeanAndItsMedian) {
  const Topology topology = make_topology(bar_mesh({16, 16, 16}, 1.0));
  auto s = facet_strengths(topology, unit_volumes(topology, 2.0),
                           {.strength = 1.0, .weibull_modulus = 3.0, .reference_volume = 1.0, .seed = 7});
  double mean = 0.0;
  for (const double value : s) mean += value / static_cast<double>(s.size());
  EXPECT_NEAR(mean, std::tgamma(1.0 + 1.0 / 3.0), 0.01);
  std::nth_element(s.begin(), s.begin() + static_cast<std::ptrdiff_t>(s.size() / 2), s.end());
  EXPECT_NEAR(s[s.size() / 2], std::pow(std::log(2.0), 1.0 / 3.0), 0.01);
}

TEST(StrengthField, SmallerVolumesAreStronger) {
  const Topology topology = make_topology(bar_mesh({4, 4, 4}, 1.0));
  const StrengthOptions options{.strength = 1.0, .weibull_modulus = 4.0, .reference_volume = 1.0};
  const auto large = facet_strengths(topology, unit_volumes(topology, 2.0), options);
  const auto small = facet_strengths(topology, unit_volumes(topology, 2.0 / 16.0), options);
  for (std::size_t i = 0; i < large.size(); ++i) EXPECT_NEAR(small[i] / large[i], 2.0, 1e-12);
}

}  // namespace
}  // namespace knap
