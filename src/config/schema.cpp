#include "config/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>

#include "config/key_builder.hpp"
#include "config/material_presets.hpp"

namespace knap {

Range range(std::string_view text, Quantity quantity) {
  const std::size_t comma = text.find(", ");
  const auto bound = [&](std::string_view end) {
    const Conversion converted = convert_to_si(end, quantity);
    assert(converted.problem.empty());
    return converted.value;
  };
  return {bound(text.substr(1, comma - 1)), bound(text.substr(comma + 2, text.size() - comma - 3)), text.front() == '(',
          text.back() == ')', std::string(text)};
}

namespace {

using enum Quantity;

Condition shape_is(ParticleShape shape, const std::string& word) {
  return {"shape = \"" + word + "\"", [=](const RunConfig& config) { return config.particle.shape == shape; }};
}
Condition shape_is_meshed_here() {
  return {"shape is not \"mesh_file\"",
          [](const RunConfig& config) { return config.particle.shape != ParticleShape::MeshFile; }};
}

std::vector<Key> particle_keys() {
  using C = ParticleConfig;
  constexpr auto in = &RunConfig::particle;
  const std::vector<std::string> shapes{"sphere", "ellipsoid", "box", "mesh_file"};
  const Condition from_file = shape_is(ParticleShape::MeshFile, "mesh_file");
  return {
      word("shape", KeyType::Choice, shapes, value("sphere"), choice(in, &C::shape, shapes),
           "Geometry of the particle; its first contact is at its lowest point."),
      only_when(
          shape_is(ParticleShape::Sphere, "sphere"),
          quantity("diameter", Length, "[1 um, 10 m]", required(), field(in, &C::diameter), "Diameter of the sphere.")),
      only_when(shape_is(ParticleShape::Ellipsoid, "ellipsoid"),
                vector("diameters", Length, "[1 um, 10 m]", required(), field(in, &C::diameters),
                       "Diameters of the ellipsoid along x, y, z; the wall's normal is z.")),
      only_when(shape_is(ParticleShape::Box, "box"),
                vector("lengths", Length, "[1 um, 10 m]", required(), field(in, &C::lengths),
                       "Edge lengths of the box along x, y, z; the wall's normal is z.")),
      only_when(from_file, word("mesh_file", KeyType::File, {}, required(), field(in, &C::mesh_file),
                                "Tetrahedral mesh (Gmsh .msh); a relative path starts at the case file's folder.")),
      only_when(from_file, quantity("mesh_scale", Length, "[1 nm, 1 km]", value("1 m"), field(in, &C::mesh_scale),
                                    "Length of one unit of mesh_file.")),
  };
}

std::vector<Key> mesh_keys() {
  using C = MeshConfig;
  constexpr auto in = &RunConfig::mesh;
  return {
      only_when(shape_is_meshed_here(),
                quantity("element_size", Length, "[10 nm, 1 m]", derived("about 20 000 tets"),
                         field(in, &C::element_size), "Edge length of the tets far from the contact.")),
      only_when(shape_is_meshed_here(),
                quantity("contact_element_size", Length, "[10 nm, 1 m]", derived("element_size"),
                         field(in, &C::contact_element_size), "Edge length of the tets at the expected contact.")),
      only_when(shape_is_meshed_here(),
                quantity("contact_extent", Length, "[10 nm, 10 m]", derived("1/4 of the smallest particle extent"),
                         field(in, &C::contact_extent), "Radius of the refined region around the contact.")),
      only_when(shape_is_meshed_here(),
                integer("seed", "[0, 1e15]", derived("run.seed"), field(in, &C::seed),
                        "Variant of the mesh, to see how results scatter: 0 is the mesh as generated, others rotate or "
                        "jitter it.")),
      only_when(shape_is_meshed_here(),
                quantity("perturbation", Ratio, "[0, 0.3]", value("0"), field(in, &C::perturbation),
                         "Random displacement of interior nodes over the local edge length.")),
  };
}

std::vector<Key> material_keys() {
  using C = MaterialConfig;
  constexpr auto in = &RunConfig::material;
  const Condition viscous{"viscous_ratio > 0", [](const RunConfig& c) { return c.material.viscous_ratio > 0.0; }};
  return {
      word("preset", KeyType::Choice, preset_names(), absent("none"), field(in, &C::preset),
           "Named material that fills the keys of [material] and [fracture] that are not given."),
      quantity("young_modulus", Stress, "[1 kPa, 10 TPa]", required(), field(in, &C::young_modulus),
               "Young's modulus E, the long-term one of a viscoelastic material."),
      quantity("poisson_ratio", Ratio, "[0, 0.49]", required(), field(in, &C::poisson_ratio), "Poisson's ratio nu."),
      quantity("density", Density, "[1 kg/m3, 30000 kg/m3]", required(), field(in, &C::density),
               "Density of the particle with its pores (envelope density)."),
      quantity("viscous_ratio", Ratio, "[0, 10]", value("0"), field(in, &C::viscous_ratio),
               "Stiffness of the viscoelastic branch over the long-term one; 0 is purely elastic."),
      quantity("relaxation_time", Time, "[1 ps, 100 s]", required_when(viscous), field(in, &C::relaxation_time),
               "Relaxation time of the viscoelastic branch."),
  };
}

// Toughness and fracture energy say the same; only the one that was given is kept apart from zero or written.
Access fracture_energy_access() {
  Access access = field(&RunConfig::fracture, &FractureConfig::fracture_energy);
  access.get = [](const RunConfig& c) {
    return c.fracture.toughness > 0.0 ? Value() : value_of(c.fracture.fracture_energy);
  };
  return access;
}

std::vector<Key> weibull_keys() {
  using C = FractureConfig;
  constexpr auto in = &RunConfig::fracture;
  const Condition scattered{"weibull_modulus > 0", [](const RunConfig& c) { return c.fracture.weibull_modulus > 0.0; }};
  return {
      quantity("weibull_modulus", Ratio, "[0, 1000]", value("0"), field(in, &C::weibull_modulus),
               "Weibull modulus of the scatter of strength between facets; 0 is uniform strength."),
      quantity("weibull_reference_volume", Volume, "[1 um3, 1000 m3]", required_when(scattered),
               field(in, &C::weibull_reference_volume), "Volume for which `strength` holds."),
      integer("weibull_seed", "[0, 1e15]", derived("run.seed"), field(in, &C::weibull_seed), "Seed of that scatter."),
  };
}

std::vector<Key> fracture_keys() {
  using C = FractureConfig;
  constexpr auto in = &RunConfig::fracture;
  const std::vector<std::string> insertions{"none", "extrinsic"};
  const std::vector<std::string> frictions{"keeps_confined_strength", "blended"};
  const Condition breakable{"insertion is not \"none\"",
                            [](const RunConfig& c) { return c.fracture.insertion != Insertion::None; }};
  std::vector<Key> keys{
      word("insertion", KeyType::Choice, insertions, value("extrinsic"), choice(in, &C::insertion, insertions),
           "How cracks come: none (unbreakable) or extrinsic (cohesive elements where the stress reaches the "
           "strength)."),
      quantity("strength", Stress, "[1 Pa, 1 TPa]", required_when(breakable), field(in, &C::strength),
               "Tensile strength sigma_c of a facet."),
      quantity("fracture_energy", SurfaceEnergy, "[1e-6 J/m2, 1e7 J/m2]", derived("required unless toughness is given"),
               fracture_energy_access(), "Energy G_c to open a crack in mode I; give this or toughness."),
      quantity("toughness", Toughness, "[1 Pa m^1/2, 1000 MPa m^1/2]", derived("none: fracture_energy is used"),
               field(in, &C::toughness),
               "Fracture toughness K_IC; G_c = K_IC^2 (1 - nu^2)/E; give this or fracture_energy."),
      quantity("mode_ii_ratio", Ratio, "[0.1, 100]", value("1"), field(in, &C::mode_ii_ratio),
               "Fracture energy in shear (mode II) over that in tension."),
      quantity("shear_strength_ratio", Ratio, "[0.1, 100]", value("1.5"), field(in, &C::shear_strength_ratio),
               "Cohesion in shear over tensile strength (beta)."),
      quantity("internal_friction", Ratio, "[0, 10]", value("0.8"), field(in, &C::internal_friction),
               "Coefficient of friction of the failure criterion and of facets not fully failed (mu_i)."),
      quantity("sliding_friction", Ratio, "[0, 10]", value("0.1"), field(in, &C::sliding_friction),
               "Coefficient of friction of failed facets and between fragments (mu)."),
      word("crack_friction", KeyType::Choice, frictions, value(frictions[0]), choice(in, &C::crack_friction, frictions),
           "Friction of a softening crack: internal until it has failed, or blended into sliding with its damage."),
  };
  for (Key& key : weibull_keys()) keys.push_back(std::move(key));
  keys.push_back(word("allow_unresolved", KeyType::Switch, {}, value("false"), field(in, &C::allow_unresolved),
                      "Run although the mesh is too coarse for the cohesive zone."));
  return keys;
}

std::vector<Key> impact_keys() {
  using C = ImpactConfig;
  constexpr auto in = &RunConfig::impact;
  return {
      quantity("speed", Speed, "[1 mm/s, 5 km/s]", required(), field(in, &C::speed),
               "Speed of the particle when it meets the wall."),
      quantity("angle", Angle, "(0 deg, 90 deg]", value("90 deg"), field(in, &C::angle),
               "Angle of the path to the wall's plane, 90 deg = normal impact; a bare number is in radians."),
      quantity("azimuth", Angle, "[-360 deg, 360 deg]", value("0 deg"), field(in, &C::azimuth),
               "Direction of an oblique path in the wall's plane, from x towards y; a bare number is in radians."),
      vector("spin", AngularSpeed, "[-1e7 rad/s, 1e7 rad/s]", value("[0, 0, 0]"), field(in, &C::spin),
             "Angular velocity of the particle at the start, about x, y, z."),
      quantity("wall_friction", Ratio, "[0, 10]", value("0.3"), field(in, &C::wall_friction),
               "Coefficient of friction between particle and wall."),
  };
}

std::vector<Key> run_keys() {
  using C = TimeConfig;
  constexpr auto in = &RunConfig::run;
  return {
      quantity("end_time", Time, "[1 ps, 100 s]", absent("automatic: when nothing breaks any more"),
               field(in, &C::end_time), "Simulated time at which the run ends."),
      quantity("step_safety", Ratio, "[0.001, 0.9]", value("0.5"), field(in, &C::step_safety),
               "Time step over the largest stable one."),
      integer("threads", "[0, 1024]", value("0"), field(in, &C::threads),
              "Number of threads, 0 = all processors; results do not depend on it."),
      integer("insertion_interval", "[1, 1000]", value("4"), field(in, &C::insertion_interval),
              "Time steps between two checks for new cracks."),
      integer("seed", "[0, 1e15]", value("0"), field(in, &C::seed),
              "Seed of everything random that is given no seed of its own: mesh.seed, fracture.weibull_seed."),
  };
}

std::vector<Key> output_keys() {
  using C = OutputConfig;
  constexpr auto in = &RunConfig::output;
  return {
      integer("frames", "[0, 100000]", value("40"), field(in, &C::frames),
              "Number of VTK frames over the run, 0 = none."),
      quantity("history_interval", Time, "[1 ps, 100 s]", absent("automatic: about 500 rows"),
               field(in, &C::history_interval), "Simulated time between two rows of history.csv."),
      quantity("checkpoint_interval", Time, "[0 s, 604800 s]", value("60 s"), field(in, &C::checkpoint_interval),
               "Wall-clock time between two checkpoints, 0 = none."),
      word("picture", KeyType::Switch, {}, value("true"), field(in, &C::picture),
           "Whether to draw a picture of the final state."),
  };
}

std::vector<Key> make_schema() {
  std::vector<Key> all;
  const auto add = [&](const char* section, std::vector<Key> keys) {
    for (Key& key : keys) {
      key.section = section;
      all.push_back(std::move(key));
    }
  };
  add("particle", particle_keys());
  add("mesh", mesh_keys());
  add("material", material_keys());
  add("fracture", fracture_keys());
  add("impact", impact_keys());
  add("run", run_keys());
  add("output", output_keys());
  return all;
}

}  // namespace

const std::vector<Key>& schema() {
  static const std::vector<Key> keys = make_schema();
  return keys;
}

const Key* find_key(std::string_view section, std::string_view name) {
  const auto& keys = schema();
  const auto found = std::find_if(keys.begin(), keys.end(),
                                  [&](const Key& key) { return key.section == section && key.name == name; });
  return found == keys.end() ? nullptr : &*found;
}

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const Key& key : schema())
    if (names.empty() || names.back() != key.section) names.push_back(key.section);
  return names;
}

std::vector<std::string> key_names(std::string_view section) {
  std::vector<std::string> names;
  for (const Key& key : schema())
    if (key.section == section) names.push_back(key.name);
  return names;
}

bool applies(const Key& key, const RunConfig& config) { return !key.applies.holds || key.applies.holds(config); }

bool is_required(const Key& key, const RunConfig& config) {
  if (!applies(key, config)) return false;
  return key.fallback.kind == Fallback::Kind::Required ||
         (key.fallback.kind == Fallback::Kind::RequiredWhen && key.fallback.when.holds(config));
}

std::string in_words(const Range& range) {
  const std::size_t comma = range.text.find(", ");
  const std::string low = range.text.substr(1, comma - 1);
  const std::string high = range.text.substr(comma + 2, range.text.size() - comma - 3);
  const std::string start = range.low_open ? fmt::format("above {} ", low) : fmt::format("from {} ", low);
  return start + (range.high_open ? "to below " : range.low_open ? "up to " : "to ") + high;
}

}  // namespace knap
