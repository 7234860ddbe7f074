#pragma once
// The rows of the schema, by section.
#include "config/schema.hpp"

namespace knap {

std::vector<Key> particle_keys();
std::vector<Key> mesh_keys();
std::vector<Key> material_keys();
std::vector<Key> fracture_keys();
std::vector<Key> impact_keys();
std::vector<Key> tool_keys();
std::vector<Key> quasistatic_keys();
std::vector<Key> contact_keys();
std::vector<Key> run_keys();
std::vector<Key> output_keys();

}  // namespace knap
