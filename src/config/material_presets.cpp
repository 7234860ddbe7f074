// Source of a number: "published" = a measurement printed in the literature on the material, "computed" = follows from
// published numbers, "assumed" = a usual value without a source. The middle is taken where a range is known. Densities
// are envelope densities: with them the speed at which Hertz's peak force reaches the measured fracture force is the
// observed breakage speed, with the skeletal density it is a third too low.
#include "config/material_presets.hpp"

#include <algorithm>

namespace knap {
namespace {

// Restitution below damage, measured: about 0.65. This elastic preset rebounds with 0.95; a viscous branch of ratio 0.3
// and relaxation time 2 us gives 0.81.
MaterialPreset zeolite_4ak() {
  return {
      "zeolite_4ak",
      "zeolite 4AK granules, 1.2-2.5 mm",
      {{"material", "young_modulus", "2.45 GPa", "published"},
       {"material", "poisson_ratio", "0.25", "assumed"},
       {"material", "density", "1270 kg/m3", "computed: envelope of a granule of skeletal density 2180 kg/m3"},
       {"fracture", "strength", "8.34 MPa", "published"},
       {"fracture", "fracture_energy", "8.6 J/m2", "computed: K_IC 0.15 MPa m^1/2, low end of the assumed 0.15-0.3"}}};
}

// Restitution below damage, measured: 0.74-0.82; friction on a wall 0.37.
MaterialPreset gamma_alumina() {
  return {
      "gamma_alumina",
      "gamma-alumina granules, 1.0-1.18 mm",
      {{"material", "young_modulus", "12.23 GPa", "published; 15 GPa in discrete-element studies"},
       {"material", "poisson_ratio", "0.3", "published"},
       {"material", "density", "1470 kg/m3", "computed: envelope of a granule of skeletal density 3370 kg/m3"},
       {"fracture", "strength", "17.84 MPa", "published; 26 MPa from the fracture force at 1.09 mm"},
       {"fracture", "fracture_energy", "9.1 J/m2", "computed: K_IC 0.35 MPa m^1/2, low end of the assumed 0.35-0.7"}}};
}

MaterialPreset fertiliser_npk() {
  return {"fertiliser_npk",
          "NPK or CAN fertiliser granules, 3.2-7.2 mm",
          {{"material", "young_modulus", "2 GPa", "assumed, 1-3 GPa"},
           {"material", "poisson_ratio", "0.25", "assumed"},
           {"material", "density", "1650 kg/m3", "assumed"},
           {"fracture", "strength", "3.75 MPa", "assumed, 1.5-6 MPa"},
           {"fracture", "toughness", "0.1 MPa m^1/2", "assumed"}}};
}

MaterialPreset plaster() {
  return {"plaster",
          "plaster spheres, 50-75 mm",
          {{"material", "young_modulus", "10 GPa", "assumed, 5-15 GPa"},
           {"material", "poisson_ratio", "0.2", "assumed"},
           {"material", "density", "1575 kg/m3", "assumed, 1200-1950 kg/m3"},
           {"fracture", "strength", "5 MPa", "assumed, 2-8 MPa"},
           {"fracture", "toughness", "0.275 MPa m^1/2", "assumed, 0.15-0.4 MPa m^1/2"}}};
}

// Very fine meshes: a 2 mm bead needs about 8 million tets to resolve its cohesive zone.
MaterialPreset soda_lime_glass() {
  return {"soda_lime_glass",
          "soda-lime glass beads",
          {{"material", "young_modulus", "71 GPa", "usual value"},
           {"material", "poisson_ratio", "0.23", "usual value"},
           {"material", "density", "2450 kg/m3", "usual value, 2400-2500 kg/m3"},
           {"fracture", "strength", "70.5 MPa", "published, 41-100 MPa"},
           {"fracture", "toughness", "0.75 MPa m^1/2", "usual value"}}};
}

}  // namespace

const std::vector<MaterialPreset>& material_presets() {
  static const std::vector<MaterialPreset> presets{zeolite_4ak(), gamma_alumina(), fertiliser_npk(), plaster(),
                                                   soda_lime_glass()};
  return presets;
}

const MaterialPreset* find_preset(std::string_view name) {
  const auto& presets = material_presets();
  const auto found = std::find_if(presets.begin(), presets.end(), [&](const auto& p) { return p.name == name; });
  return found == presets.end() ? nullptr : &*found;
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const auto& preset : material_presets()) names.push_back(preset.name);
  return names;
}

}  // namespace knap
