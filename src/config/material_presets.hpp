#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace knap {

/// One value of a preset, written as in a case file.
struct PresetValue {
  std::string section, key, text;
  std::string source;  ///< where the number is from
};

struct MaterialPreset {
  std::string name;
  std::string title;
  std::vector<PresetValue> values;
};

/// Materials of the literature; each value can be overridden by the case.
const std::vector<MaterialPreset>& material_presets();

/// The preset of that name, or nullptr.
const MaterialPreset* find_preset(std::string_view name);
std::vector<std::string> preset_names();

}  // namespace knap
