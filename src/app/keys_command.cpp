#include <fmt/format.h>

#include "app/commands.hpp"
#include "config/schema.hpp"

namespace knap {

ExitCode keys_command(bool markdown) {
  fmt::print("{}", markdown ? keys_as_markdown() : describe_keys());
  return ExitCode::Ok;
}

}  // namespace knap
