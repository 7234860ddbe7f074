#pragma once
#include <string>
#include <vector>

namespace knap {

/// Instruction sets that the vector kernels are compiled for and this processor can run, best first.
std::vector<std::string> vector_targets();
/// Confines all vector kernels to one of vector_targets(), for tests and benchmarks; "" = the best one again.
void use_vector_target(const std::string& name);

}  // namespace knap
