#include "analysis/breakage.hpp"

#include <algorithm>
#include <cassert>

namespace knap {
namespace {

// The rule of breakage classes; docs/breakage_measures.md gives the reasons.
constexpr double intact_loss = 1e-3;  // below: nothing a balance would notice came off
constexpr double big_piece = 0.1;     // mass fraction from which a piece is a part, not a chip
constexpr double held_by_big_pieces = 0.75;
constexpr int most_split_pieces = 4;

BreakageClass find_class(std::span<const Fragment> fragments, const ParticleScale& particle) {
  if (!fragments.empty() && fragments[0].mass > (1.0 - intact_loss) * particle.mass) return BreakageClass::Intact;
  int pieces = 0;
  double held = 0.0;
  for (const Fragment& fragment : fragments) {
    if (fragment.mass < big_piece * particle.mass) break;
    ++pieces;
    held += fragment.mass / particle.mass;
  }
  if (held < held_by_big_pieces || pieces > most_split_pieces) return BreakageClass::Fragmented;
  return pieces == 1 ? BreakageClass::Chipped : BreakageClass::Split;
}

FinerFraction finer_fraction(std::span<const Fragment> fragments, const ParticleScale& particle, int divisor) {
  const double size = particle.diameter / divisor;
  FinerFraction finer{.divisor = divisor, .resolved = size > particle.element_size};
  for (const Fragment& fragment : fragments) {
    if (fragment.sieve_size < size) finer.fraction += fragment.mass / particle.mass;
  }
  return finer;
}

}  // namespace

std::string_view name(BreakageClass breakage_class) {
  switch (breakage_class) {
    case BreakageClass::Intact:
      return "intact";
    case BreakageClass::Chipped:
      return "chipped";
    case BreakageClass::Split:
      return "split";
    case BreakageClass::Fragmented:
      return "fragmented";
  }
  return "";
}

BreakageMeasures breakage_measures(std::span<const Fragment> fragments, const ParticleScale& particle) {
  assert(particle.mass > 0.0);
  assert(std::is_sorted(fragments.begin(), fragments.end(), [](auto& a, auto& b) { return a.mass > b.mass; }));
  BreakageMeasures measures;
  measures.count = to_index(fragments.size());
  for (const Fragment& fragment : fragments) {
    const double fraction = fragment.mass / particle.mass;
    measures.mass_sum_fraction += fraction;
    if (fraction > 1e-2) ++measures.count_above_1pct;
    if (fraction > 1e-3) ++measures.count_above_0p1pct;
    if (!fragment.resolved()) measures.unresolved_mass_fraction += fraction;
  }
  if (!fragments.empty()) measures.largest_mass_fraction = fragments[0].mass / particle.mass;
  if (fragments.size() > 1) measures.second_mass_fraction = fragments[1].mass / particle.mass;
  measures.chipping_ratio = std::max(0.0, 1.0 - measures.largest_mass_fraction);
  std::transform(fineness_divisors.begin(), fineness_divisors.end(), measures.finer.begin(),
                 [&](int divisor) { return finer_fraction(fragments, particle, divisor); });
  measures.breakage_class = find_class(fragments, particle);
  return measures;
}

std::vector<SizeRow> size_distribution(std::span<const Fragment> fragments, const ParticleScale& particle) {
  std::vector<const Fragment*> by_size;
  for (const Fragment& fragment : fragments) by_size.push_back(&fragment);
  std::stable_sort(by_size.begin(), by_size.end(),
                   [](const Fragment* a, const Fragment* b) { return a->sieve_size < b->sieve_size; });
  std::vector<SizeRow> rows;
  double mass = 0.0;
  Index count = 0;
  for (const Fragment* fragment : by_size) {
    mass += fragment->mass;
    ++count;
    if (rows.empty() || rows.back().sieve_size != fragment->sieve_size) rows.emplace_back();
    rows.back() = {fragment->sieve_size, mass / particle.mass, count};
  }
  return rows;
}

}  // namespace knap
