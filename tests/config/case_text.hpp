#pragma once
// Small cases for the tests of this folder.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "config/load_config.hpp"
#include "core/errors.hpp"

namespace knap::testing_cases {

/// The shortest valid case. Its lines: 1 [particle], 2 diameter, 3 [material], 4 preset, 5 [impact], 6 speed.
inline const std::string shortest =
    "[particle]\ndiameter = \"2 mm\"\n[material]\npreset = \"zeolite_4ak\"\n[impact]\nspeed = \"15 m/s\"\n";

inline RunConfig config_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return config_from_text(text, "case.toml", overrides);
}

/// The message of the InputError that the case must cause.
inline std::string complaint(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)config_of(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError for:\n" << text;
  return "";
}

}  // namespace knap::testing_cases
