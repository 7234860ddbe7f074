#pragma once
// Size distributions on common sieves, and the two laws they are told by.
#include <span>
#include <vector>

#include "analysis/breakage.hpp"
#include "analysis/fit.hpp"

namespace knap {

/// Sieves of the series 2^(1/4), descending from `largest` to `smallest` [m]. Throws std::invalid_argument
/// unless both are above 0.
std::vector<double> sieve_series(double largest, double smallest);
/// The mass fraction that passes each sieve, of a distribution ascending in size.
std::vector<double> passing(std::span<const SizeRow> rows, std::span<const double> sieves);

/// Mass finer than x: F = 1 - exp(-(x/x63)^n), Rosin & Rammler 1933: "x63" [m], "n"; least squares in F.
Fit fit_rosin_rammler(std::span<const double> sizes, std::span<const double> finer);
/// F = (x/k)^m, Gates 1915, Schuhmann 1940: "k" [m], "m"; least squares in ln F.
Fit fit_gates_gaudin_schuhmann(std::span<const double> sizes, std::span<const double> finer);

}  // namespace knap
