// The rows of [particle] and its parts.
#include "config/key_builder.hpp"
#include "config/material_presets.hpp"
#include "config/schema_rows.hpp"

namespace knap {
namespace {

using enum Quantity;

KeyCondition shape_is(ParticleShape shape, const std::string& word) {
  return {"shape = \"" + word + "\"",
          [=](const RunConfig& config, std::size_t i) { return config.particles[i].shape == shape; }};
}
KeyCondition shape_is_meshed_here() {
  return {"shape is not \"mesh_file\"",
          [](const RunConfig& config, std::size_t i) { return config.particles[i].shape != ParticleShape::MeshFile; }};
}

constexpr auto fracture_of = [](auto& config, std::size_t i) -> auto& { return config.particles[i].fracture; };

// Toughness and fracture energy say the same; only the one that was given is kept apart from zero or written.
Access fracture_energy_access() {
  Access access = field(fracture_of, &FractureConfig::fracture_energy);
  access.get = [](const RunConfig& c, std::size_t i) {
    const FractureConfig& fracture = c.particles[i].fracture;
    return fracture.toughness > 0.0 ? Value() : value_of(fracture.fracture_energy);
  };
  return access;
}

std::vector<Key> weibull_keys() {
  using C = FractureConfig;
  constexpr auto in = fracture_of;
  const KeyCondition scattered{"weibull_modulus > 0", [](const RunConfig& c, std::size_t i) {
                                 return c.particles[i].fracture.weibull_modulus > 0.0;
                               }};
  return {
      quantity("weibull_modulus", Ratio, "[0, 1000]", value("0"), field(in, &C::weibull_modulus),
               "Weibull modulus of the scatter of strength between facets; 0 is uniform strength."),
      quantity("weibull_reference_volume", Volume, "[1 um3, 1000 m3]", required_when(scattered),
               field(in, &C::weibull_reference_volume), "Volume for which `strength` holds."),
      integer("weibull_seed", "[0, 1e15]", derived("run.seed, for later particles 1000 more each"),
              field(in, &C::weibull_seed), "Seed of that scatter."),
  };
}

}  // namespace

std::vector<Key> particle_keys() {
  using C = ParticleConfig;
  constexpr auto in = [](auto& config, std::size_t i) -> auto& { return config.particles[i]; };
  const std::vector<std::string> shapes{"sphere", "ellipsoid", "box", "mesh_file"};
  const KeyCondition from_file = shape_is(ParticleShape::MeshFile, "mesh_file");
  return {
      word("name", KeyType::Name, {}, derived("particle1, particle2, ..."), field(in, &C::name),
           "Name of the particle, of letters, digits, - and _."),
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
      vector("position", Length, "[-100 m, 100 m]", absent("lowest point just above z = 0, centre on the z axis"),
             field(in, &C::position), "Where the centre of the shape is at the start, or the origin of a mesh file."),
      vector("velocity", Speed, "[-5 km/s, 5 km/s]", absent("that of [impact], at rest without it"),
             field(in, &C::velocity), "Velocity at the start."),
      vector("spin", AngularSpeed, "[-1e7 rad/s, 1e7 rad/s]", absent("that of [impact]"), field(in, &C::spin),
             "Angular velocity at the start, about x, y, z."),
  };
}

std::vector<Key> mesh_keys() {
  using C = MeshConfig;
  constexpr auto in = [](auto& config, std::size_t i) -> auto& { return config.particles[i].mesh; };
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
                word("contact_on_top", KeyType::Switch, {},
                     derived("true where flat tools load the particle from below and from above"),
                     field(in, &C::contact_on_top),
                     "Whether the highest point is an expected contact too, not the lowest alone.")),
      only_when(
          shape_is_meshed_here(),
          integer("seed", "[0, 1e15]", derived("run.seed, for later particles 1000 more each"), field(in, &C::seed),
                  "Variant of the mesh, to see how results scatter: 0 is the mesh as generated, others rotate or "
                  "jitter it.")),
      only_when(shape_is_meshed_here(),
                quantity("perturbation", Ratio, "[0, 0.3]", value("0"), field(in, &C::perturbation),
                         "Random displacement of interior nodes over the local edge length.")),
  };
}

std::vector<Key> material_keys() {
  using C = MaterialConfig;
  constexpr auto in = [](auto& config, std::size_t i) -> auto& { return config.particles[i].material; };
  const KeyCondition viscous{"viscous_ratio > 0", [](const RunConfig& c, std::size_t i) {
                               return c.particles[i].material.viscous_ratio > 0.0;
                             }};
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

std::vector<Key> fracture_keys() {
  using C = FractureConfig;
  constexpr auto in = fracture_of;
  const std::vector<std::string> insertions{"none", "extrinsic", "intrinsic"};
  const std::vector<std::string> frictions{"keeps_confined_strength", "blended"};
  const KeyCondition breakable{"insertion is not \"none\"", [](const RunConfig& c, std::size_t i) {
                                 return c.particles[i].fracture.insertion != Insertion::None;
                               }};
  const KeyCondition intrinsic{"insertion = \"intrinsic\"", [](const RunConfig& c, std::size_t i) {
                                 return c.particles[i].fracture.insertion == Insertion::Intrinsic;
                               }};
  std::vector<Key> keys{
      word("insertion", KeyType::Choice, insertions, value("extrinsic"), choice(in, &C::insertion, insertions),
           "How cracks come: none (unbreakable), extrinsic (cohesive elements where the stress reaches the "
           "strength) or intrinsic (cohesive elements everywhere from the start, much slower: a cross-check)."),
      only_when(intrinsic, quantity("penalty_ratio", Ratio, "[1, 1000]", value("10"), field(in, &C::penalty_ratio),
                                    "First stiffness of intrinsic facets over M/h, the P-wave modulus over the size of "
                                    "their elements; the body is softer by one over it.")),
      quantity("strength", Stress, "[1 Pa, 1 TPa]", required_when(breakable), field(in, &C::strength),
               "Tensile strength sigma_c of a facet."),
      quantity("fracture_energy", SurfaceEnergy, "[1e-6 J/m2, 1e7 J/m2]", derived("required unless toughness is given"),
               fracture_energy_access(), "Energy G_c to open a crack in mode I; give this or toughness."),
      quantity("toughness", Toughness, "[1 Pa m^1/2, 1000 MPa m^1/2]", derived("none: fracture_energy is used"),
               field(in, &C::toughness),
               "Fracture toughness K_IC; G_c = K_IC^2 (1 - nu^2)/E; give this or fracture_energy."),
      quantity("mode_ii_ratio", Ratio, "[0.1, 100]", value("1"), field(in, &C::mode_ii_ratio),
               "Fracture energy in shear (mode II) over that in tension."),
      quantity("crushed_zone_facets", Ratio, "[0, 100]", value("0"), field(in, &C::crushed_zone_facets),
               "Facets across the crushed zone under the contact that mode_ii_ratio is meant for: they share the slip, "
               "so that finer meshes crush less; a mesh with another number of them gets the ratio with which it "
               "crushes alike. 0 takes mode_ii_ratio as it is."),
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

}  // namespace knap
