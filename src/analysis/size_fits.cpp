#include "analysis/size_fits.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace knap {
namespace {

FitParameter size_parameter(const char* name, std::span<const double> sizes) {
  const auto [least, largest] = std::minmax_element(sizes.begin(), sizes.end());
  return {name, "m", 1e-2 * *least, 1e8 * *largest, true};
}

}  // namespace

std::vector<double> sieve_series(double largest, double smallest) {
  if (!(smallest > 0.0) || !std::isfinite(largest)) throw std::invalid_argument("sieves: sizes must be above 0");
  std::vector<double> sieves;
  for (int i = 0;; ++i) {
    const double size = largest * std::exp2(-0.25 * i);
    if (size < smallest * (1.0 - 1e-9)) return sieves;
    sieves.push_back(size);
  }
}

std::vector<double> passing(std::span<const SizeRow> rows, std::span<const double> sieves) {
  std::vector<double> finer;
  for (const double sieve : sieves) {
    const auto coarser = std::upper_bound(rows.begin(), rows.end(), sieve,
                                          [](double size, const SizeRow& row) { return size < row.sieve_size; });
    finer.push_back(coarser == rows.begin() ? 0.0 : std::prev(coarser)->finer_fraction);
  }
  return finer;
}

Fit fit_rosin_rammler(std::span<const double> sizes, std::span<const double> finer) {
  return least_squares_fit(
      {size_parameter("x63", sizes), {"n", "-", 0.05, 20.0, true}},
      [&](std::span<const double> p, std::size_t i) { return -std::expm1(-std::pow(sizes[i] / p[0], p[1])); }, finer);
}

Fit fit_gates_gaudin_schuhmann(std::span<const double> sizes, std::span<const double> finer) {
  std::vector<double> logarithms;
  for (const double f : finer) logarithms.push_back(std::log(f));
  return least_squares_fit(
      {size_parameter("k", sizes), {"m", "-", 0.02, 20.0, true}},
      [&](std::span<const double> p, std::size_t i) { return p[1] * std::log(sizes[i] / p[0]); }, logarithms);
}

}  // namespace knap
