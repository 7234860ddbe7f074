#pragma once
// The chipping law, eps = C v^n: lateral cracks by published models have n = 2 to 4.5.
#include <array>
#include <span>
#include <string_view>

#include "analysis/statistics.hpp"

namespace knap {

struct PublishedExponent {
  double exponent = 0.0;
  std::string_view source{};
};
inline constexpr std::array<PublishedExponent, 5> published_exponents{{{2.0, "Ghadiri & Zhang 2002"},
                                                                       {2.33, "Marshall, Lawn & Evans 1982"},
                                                                       {2.44, "Wiederhorn & Lawn 1979"},
                                                                       {3.17, "Evans, Gulden & Rosenblatt 1978"},
                                                                       {4.5, "Wang et al. 2019"}}};

/// One run.
struct Chipping {
  double speed = 0.0;  ///< [m/s]
  double ratio = 0.0;  ///< mass lost over the particle's [-]
};

struct ChippingLaw {
  double exponent = 0.0;
  double factor = 0.0;  ///< C [(s/m)^n]
  Interval interval{};  ///< of the exponent, 95 %, bootstrap over the runs of each speed; NaN without repeats
  std::size_t num_speeds = 0;
  double slowest = 0.0, fastest = 0.0;  ///< speeds that the law is of [m/s]
};

/// Straight line through the logarithms of the mean ratio at each speed. Throws std::invalid_argument for fewer than
/// three speeds with a mean above zero.
ChippingLaw fit_chipping_law(std::span<const Chipping> runs);

}  // namespace knap
