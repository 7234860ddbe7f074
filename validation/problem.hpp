#pragma once
#include <span>
#include <string>

#include "validation/evidence.hpp"

namespace knap {

/// One comparison of Knap with something that is known without it. Its sources are in validation/<name>/.
struct Problem {
  std::string name;       ///< of its folder, its plot
  std::string group;      ///< elastic, fracture, contact, particle, convergence, sensitivity
  std::string reference;  ///< what it is compared with, and where that comes from
  void (*show)(Evidence& evidence);
  bool in_short = true;  ///< part of --short
};

/// All problems, in the order of the table.
std::span<const Problem> problems();

}  // namespace knap
