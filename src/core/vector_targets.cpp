#include "core/vector_targets.hpp"

#include "core/choose_targets-inl.hpp"
//
#include <hwy/highway.h>

namespace knap {

std::vector<std::string> vector_targets() {
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.emplace_back(hwy::TargetName(target));
  return names;
}

void use_vector_target(const std::string& name) {
  std::int64_t wanted = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    if (name == hwy::TargetName(target)) wanted = target;
  hwy::GetChosenTarget().Update(wanted != 0 ? wanted : hwy::SupportedTargets());
}

}  // namespace knap
