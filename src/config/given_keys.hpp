#pragma once
// What a case and the command line give, key by key, before defaults: the first half of reading a case.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/case_document.hpp"
#include "config/read_value.hpp"
#include "config/schema.hpp"

namespace knap {

/// A key's value and where it was given.
struct Given {
  Value value;
  std::string place;  ///< "" = by a preset
  bool from_command_line = false;
};

/// What one table gives, in the order of the schema.
using KeyLayer = std::vector<std::optional<Given>>;

struct GivenKeys {
  KeyLayer common;                  ///< of the case, and the parts that are of all particles
  std::vector<KeyLayer> particles;  ///< at least one
  std::vector<KeyLayer> tools;
};

/// The place of a key in a layer.
std::size_t row_of(const Key& key);

/// "mesh.element_size", or "particle.mesh.element_size" where it is of one particle.
std::string full_name(const Key& key, bool of_one_element);

/// Reads every entry by itself and adds a line to `problems` for each that is wrong; overrides win over the file.
/// Relative paths start at `folder`.
GivenKeys read_given_keys(const CaseDocument& document, std::span<const Override> overrides,
                          const std::filesystem::path& folder, std::vector<std::string>& problems);

}  // namespace knap
