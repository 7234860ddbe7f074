#pragma once
#include "study/findings.hpp"

namespace knap {

/// What a population balance is made of.
struct BalanceInput {
  std::vector<std::size_t> broken{};  ///< runs of the study
  double diameter = 0.0;              ///< of their particles [m]
  double largest_energy = 0.0;        ///< of an impact [J/kg]
  Fit selection{};                    ///< fit_vogel_peukert
  std::string suffix{};               ///< of the files
};

/// Measures B(x|y), tells it by two laws, and writes selection.csv, breakage.csv and population_balance.json. Throws
/// RuntimeFailure if what would be written does not conserve mass or has a negative class.
void add_population_balance(Findings& findings, PageSection& section, const Study& study, const Series& series,
                            const BalanceInput& input, nlohmann::ordered_json& json);

}  // namespace knap
