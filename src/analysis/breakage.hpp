#pragma once
// What a run did to the particle, in the numbers of the breakage literature. docs/breakage_measures.md defines each.
#include <span>
#include <string_view>

#include "analysis/fragments.hpp"

namespace knap {

enum class BreakageClass {
  Intact,     ///< lost less than 0.1 % of its mass
  Chipped,    ///< one big piece is left, and it holds at least 75 %
  Split,      ///< two to four big pieces together hold at least 75 %
  Fragmented  ///< anything more
};
/// The name of a class in report.json.
std::string_view name(BreakageClass breakage_class);

/// Mass fraction finer than a part of the particle's size.
struct FinerFraction {
  int divisor = 0;        ///< n of t_n
  double fraction = 0.0;  ///< t_n: mass that passes a sieve of d/n over the particle's mass [-]
  bool resolved = false;  ///< d/n is above the element size: the mesh could have made such pieces
};

/// One row of the cumulative size distribution.
struct SizeRow {
  double sieve_size = 0.0;      ///< [m]
  double finer_fraction = 0.0;  ///< mass of all fragments up to and with this size over the particle's mass [-]
  Index finer_count = 0;        ///< their number
};

inline constexpr std::array<int, 6> fineness_divisors{2, 4, 10, 25, 50, 75};

/// All fractions are of the particle's mass.
struct BreakageMeasures {
  Index count = 0;  ///< of fragments, single tets included
  Index count_above_1pct = 0;
  Index count_above_0p1pct = 0;
  double largest_mass_fraction = 0.0;
  double second_mass_fraction = 0.0;
  double unresolved_mass_fraction = 0.0;  ///< in fragments under min_resolved_tets
  double mass_sum_fraction = 0.0;         ///< of all fragments: 1 unless mass went lost
  double chipping_ratio = 0.0;            ///< outside the largest fragment, fines included
  std::array<FinerFraction, fineness_divisors.size()> finer{};
  BreakageClass breakage_class = BreakageClass::Intact;
};

struct ParticleScale {
  double mass = 0.0;          ///< before the impact [kg]
  double diameter = 0.0;      ///< of the sphere of equal volume [m]
  double element_size = 0.0;  ///< mean edge of the mesh [m]
};

/// `fragments` in the order of find_fragments: the largest first.
BreakageMeasures breakage_measures(std::span<const Fragment> fragments, const ParticleScale& particle);

/// Cumulative distribution of mass over sieve size, ascending, one row for each size that occurs.
std::vector<SizeRow> size_distribution(std::span<const Fragment> fragments, const ParticleScale& particle);

}  // namespace knap
