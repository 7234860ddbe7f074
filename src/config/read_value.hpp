#pragma once
#include <filesystem>
#include <string>

#include "config/case_document.hpp"
#include "config/schema.hpp"

namespace knap {

/// A value that fits its key, or what is wrong with it.
struct ReadValue {
  Value value;
  std::string problem;  ///< "" = it fits; otherwise what is allowed, as the end of a sentence
};

/// Checks type, unit and range of `raw` against `key` and converts it to SI. `folder` is where relative paths start.
ReadValue read_value(const Key& key, const RawValue& raw, const std::filesystem::path& folder);

/// ` (did you mean "x"?)`, or "" when no candidate is near or begins with the word.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace knap
