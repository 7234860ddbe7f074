#pragma once
// What a case asks for, in SI, checked and complete: the end product of reading a case file, constant from then on.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace knap {

inline constexpr std::int64_t not_given = -1;  ///< a seed that run.seed replaces

struct MeshConfig {
  double element_size = 0.0;           ///< far from the contact [m]; default: about 20k tets
  double contact_element_size = 0.0;   ///< at the expected contact point [m]; default: element_size
  double contact_extent = 0.0;         ///< radius of the refined region [m]
  std::optional<bool> contact_on_top;  ///< also at the highest point; absent only for a mesh file
  std::int64_t seed = not_given;       ///< 0 = gmsh's own mesh; others rotate or jitter it
  double perturbation = 0.0;           ///< random displacement of interior nodes over the local edge length [-]
  bool operator==(const MeshConfig&) const = default;
};

struct MaterialConfig {
  std::string preset;            ///< "" = none
  double young_modulus = 0.0;    ///< long-term [Pa]
  double poisson_ratio = 0.0;    ///< [-]
  double density = 0.0;          ///< envelope [kg/m3]
  double viscous_ratio = 0.0;    ///< stiffness of the viscoelastic branch over the long-term one [-]; 0 = elastic
  double relaxation_time = 0.0;  ///< of that branch [s]
  bool operator==(const MaterialConfig&) const = default;
};

/// Friction between the faces of a softening crack, before full failure.
enum class CrackFriction {
  KeepsConfinedStrength,  ///< internal friction until full failure, then sliding friction
  Blended                 ///< (1 - D) internal + D sliding friction
};

enum class Insertion { None, Extrinsic, Intrinsic };

struct FractureConfig {
  Insertion insertion = Insertion::Extrinsic;
  double penalty_ratio = 0.0;         ///< alpha of the intrinsic facets' first stiffness alpha M/h [-]
  double strength = 0.0;              ///< sigma_c [Pa]
  double fracture_energy = 0.0;       ///< mode I G_c [J/m2]; K_IC^2 (1 - nu^2)/E when toughness is given
  double toughness = 0.0;             ///< K_IC [Pa m^1/2] as given; 0 when fracture_energy was given instead
  double mode_ii_ratio = 1.0;         ///< mode II over mode I fracture energy [-]
  double crushed_zone_facets = 0.0;   ///< facets across the crushed zone that mode_ii_ratio is meant for [-]; 0 = any
  double shear_strength_ratio = 1.5;  ///< beta: cohesion over tensile strength [-]
  double internal_friction = 0.8;     ///< mu_i of the criterion and of unbroken facets [-]
  double sliding_friction = 0.1;      ///< mu of failed facets and between fragments [-]
  CrackFriction crack_friction = CrackFriction::KeepsConfinedStrength;
  double weibull_modulus = 0.0;           ///< 0 = uniform strength
  double weibull_reference_volume = 0.0;  ///< [m3]; strength holds for this volume
  std::int64_t weibull_seed = not_given;
  bool allow_unresolved = false;  ///< run although the sanity card refuses the mesh
  bool operator==(const FractureConfig&) const = default;
};

enum class ParticleShape { Sphere, Ellipsoid, Box, MeshFile };

/// A particle with all that is its own. [mesh], [material] and [fracture] are those of every particle that has no
/// [particle.mesh] and so on.
struct ParticleConfig {
  std::string name;  ///< default: particle1, particle2, ...
  ParticleShape shape = ParticleShape::Sphere;
  double diameter = 0.0;            ///< sphere [m]
  Vec3 diameters = Vec3::Zero();    ///< ellipsoid, along x, y, z [m]
  Vec3 lengths = Vec3::Zero();      ///< box, along x, y, z [m]
  std::filesystem::path mesh_file;  ///< Gmsh .msh, absolute; written relative to the case file's folder
  double mesh_scale = 1.0;          ///< metres per unit of mesh_file
  std::optional<Vec3> position;  ///< of the shape's centre, or of a mesh file's origin [m]; absent = just above z = 0
  std::optional<Vec3> velocity;  ///< at the start [m/s]; absent = that of [impact]
  std::optional<Vec3> spin;      ///< at the start [rad/s]; absent = that of [impact]
  MeshConfig mesh;
  MaterialConfig material;
  FractureConfig fracture;
  bool operator==(const ParticleConfig&) const = default;
};

/// How a piece lies that is thrown again.
enum class PieceOrientation {
  Random,  ///< anyhow, by run.seed
  Kept     ///< as it lay in the particle, so that it meets the wall with the same side
};

struct ImpactConfig {
  double speed = 0.0;          ///< [m/s]; 0 = none given, at rest
  double angle = 0.0;          ///< from the wall plane [rad]; pi/2 = normal
  double azimuth = 0.0;        ///< of the tangential velocity, from x towards y [rad]
  Vec3 spin = Vec3::Zero();    ///< angular velocity at the start [rad/s]
  std::optional<bool> wall;    ///< whether there is the plane z = 0; absent = where there are no tools
  double wall_friction = 0.0;  ///< [-]
  int repeat = 1;              ///< impacts one after the other, each of the largest piece of the one before
  PieceOrientation repeat_orientation = PieceOrientation::Random;
  bool operator==(const ImpactConfig&) const = default;
};

enum class ToolKind { Plane, Platen, Sphere, Cylinder, Stl };
enum class MotionKind { Rest, Velocity, Ramp, Rotation, Free };

/// A rigid body that loads the particle.
struct ToolConfig {
  std::string name;  ///< default: tool1, tool2, ...
  ToolKind type = ToolKind::Plane;
  double radius = 0.0;           ///< platen, sphere, cylinder [m]
  double length = 0.0;           ///< cylinder [m]
  double thickness = 0.0;        ///< platen [m]
  Vec3 normal = Vec3::UnitZ();   ///< plane and platen: outward; stl: where the file's z axis points; any length
  Vec3 axis = Vec3::UnitY();     ///< of a cylinder; any length
  std::filesystem::path file;    ///< stl, absolute
  double scale = 1.0;            ///< metres per unit of the file
  std::optional<Vec3> position;  ///< of the tool's centre or of its face's [m]; absent = just touching the particle
  double friction = 0.0;         ///< Coulomb [-]
  MotionKind motion = MotionKind::Rest;
  Vec3 velocity = Vec3::Zero();         ///< the final one of a ramp, the first one of a free tool [m/s]
  double ramp_time = 0.0;               ///< [s]
  double angular_speed = 0.0;           ///< [rad/s]
  Vec3 rotation_axis = Vec3::UnitZ();   ///< any length
  Vec3 rotation_centre = Vec3::Zero();  ///< a point on the axis [m]
  double stop_at_force_drop = 0.0;  ///< the run ends when the tool's force is below this part of its largest; 0 = never
  double mass = 0.0;                ///< of a free tool [kg]
  bool operator==(const ToolConfig&) const = default;
};

/// A compression that starts at the onset of fracture: what is elastic before is solved on equilibria.
struct QuasistaticConfig {
  bool enabled = false;
  double onset_tolerance = 0.0;   ///< of the approach at onset [-]
  double largest_approach = 0.0;  ///< over the distance of the tools when both touch [-]
  bool operator==(const QuasistaticConfig&) const = default;
};

/// Fragments that have come loose.
struct ContactConfig {
  double restitution = 0.0;             ///< between fragments carried as rigid bodies [-]
  bool rigid_fragments = false;         ///< carry fragments that have stopped breaking as rigid bodies
  double freeze_after_crossings = 0.0;  ///< without damage, in times that a wave takes to cross the fragment
  double wake_at_speed_share = 0.0;     ///< of the speed at which it would break: a faster approach wakes it
  double wake_at_load_share = 0.0;      ///< of its strength: a larger 0.9 F/d^2 wakes it
  bool operator==(const ContactConfig&) const = default;
};

struct TimeConfig {
  std::optional<double> end_time;  ///< [s]; absent = stop automatically
  double step_safety = 0.5;        ///< time step over the nodal stability bound [-]
  int threads = 0;                 ///< 0 = all processors
  int insertion_interval = 4;      ///< steps between two checks of the insertion criterion
  std::int64_t seed = 0;           ///< of everything random without a seed of its own
  Vec3 gravity = Vec3::Zero();     ///< [m/s2]
  bool operator==(const TimeConfig&) const = default;
};

struct OutputConfig {
  int frames = 40;                         ///< number of VTK frames over the run; 0 = none
  std::optional<double> history_interval;  ///< simulated time between rows of history.csv [s]; absent = 500 rows
  double checkpoint_interval = 60.0;       ///< wall-clock time between checkpoints [s]; 0 = none
  bool picture = true;
  bool operator==(const OutputConfig&) const = default;
};

struct RunConfig {
  std::vector<ParticleConfig> particles = std::vector<ParticleConfig>(1);  ///< at least one
  ImpactConfig impact;
  QuasistaticConfig quasistatic;
  ContactConfig contact;
  std::vector<ToolConfig> tools;
  TimeConfig run;
  OutputConfig output;
  bool operator==(const RunConfig&) const = default;
};

/// Whether the plane z = 0 is a wall.
inline bool has_wall(const RunConfig& config) { return config.impact.wall.value_or(config.tools.empty()); }

}  // namespace knap
