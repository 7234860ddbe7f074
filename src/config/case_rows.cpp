// The rows of what is one in a case: [impact], [quasistatic], [contact], [run], [output].
#include <algorithm>

#include "config/key_builder.hpp"
#include "config/schema_rows.hpp"

namespace knap {
namespace {

using enum Quantity;

bool has_nothing_else_to_move(const RunConfig& config, std::size_t) {
  const auto& particles = config.particles;
  return config.tools.empty() &&
         std::any_of(particles.begin(), particles.end(), [](const ParticleConfig& p) { return !p.velocity; });
}

}  // namespace

std::vector<Key> impact_keys() {
  using C = ImpactConfig;
  constexpr auto in = [](auto& config, std::size_t) -> auto& { return config.impact; };
  const KeyCondition nothing_else_moves{"there is no [[tool]] and a particle has no velocity",
                                        has_nothing_else_to_move};
  const KeyCondition repeated{"repeat > 1", [](const RunConfig& c, std::size_t) { return c.impact.repeat > 1; }};
  const std::vector<std::string> orientations{"random", "kept"};
  const KeyCondition walled{"there is a wall", [](const RunConfig& c, std::size_t) { return has_wall(c); }};
  return {
      quantity("speed", Speed, "[1 mm/s, 5 km/s]", required_when(nothing_else_moves), field(in, &C::speed),
               "Speed of the particle when it meets the wall; of all particles without a velocity of their own."),
      quantity("angle", Angle, "(0 deg, 90 deg]", value("90 deg"), field(in, &C::angle),
               "Angle of the path to the wall's plane, 90 deg = normal impact; a bare number is in radians."),
      quantity("azimuth", Angle, "[-360 deg, 360 deg]", value("0 deg"), field(in, &C::azimuth),
               "Direction of an oblique path in the wall's plane, from x towards y; a bare number is in radians."),
      vector("spin", AngularSpeed, "[-1e7 rad/s, 1e7 rad/s]", value("[0, 0, 0]"), field(in, &C::spin),
             "Angular velocity of the particle at the start, about x, y, z."),
      word("wall", KeyType::Switch, {}, absent("true, but false where there is a [[tool]]"), field(in, &C::wall),
           "Whether the plane z = 0 is a wall at rest."),
      only_when(walled, quantity("wall_friction", Ratio, "[0, 10]", value("0.3"), field(in, &C::wall_friction),
                                 "Coefficient of friction between particle and wall.")),
      integer("repeat", "[1, 1000]", value("1"), field(in, &C::repeat),
              "Number of impacts: after each the largest piece, at rest again, is thrown with its damage."),
      only_when(repeated, word("repeat_orientation", KeyType::Choice, orientations, value("random"),
                               choice(in, &C::repeat_orientation, orientations),
                               "How that piece lies: at random by run.seed, or as it lay in the particle.")),
  };
}

std::vector<Key> quasistatic_keys() {
  using C = QuasistaticConfig;
  constexpr auto in = [](auto& config, std::size_t) -> auto& { return config.quasistatic; };
  const KeyCondition enabled{"enabled = true", [](const RunConfig& c, std::size_t) { return c.quasistatic.enabled; }};
  return {
      word("enabled", KeyType::Switch, {}, value("false"), field(in, &C::enabled),
           "Whether the run starts at the onset of fracture, the elastic compression before it solved on equilibria."),
      only_when(enabled, quantity("onset_tolerance", Ratio, "[1e-6, 0.1]", value("0.001"),
                                  field(in, &C::onset_tolerance), "Relative error of the approach at the onset.")),
      only_when(enabled,
                quantity("largest_approach", Ratio, "[0.001, 0.5]", value("0.25"), field(in, &C::largest_approach),
                         "Approach of the tools, over their distance when both touch, up to which the onset "
                         "is looked for.")),
  };
}

std::vector<Key> contact_keys() {
  using C = ContactConfig;
  constexpr auto in = [](auto& config, std::size_t) -> auto& { return config.contact; };
  const KeyCondition rigid{"rigid_fragments = true",
                           [](const RunConfig& c, std::size_t) { return c.contact.rigid_fragments; }};
  return {
      word(
          "rigid_fragments", KeyType::Switch, {}, value("false"), field(in, &C::rigid_fragments),
          "Whether fragments that have stopped breaking are carried as rigid bodies until something could break them."),
      only_when(rigid, quantity("restitution", Ratio, "[0, 1]", value("0"), field(in, &C::restitution),
                                "Speed of parting over speed of approach between rigid fragments.")),
      only_when(rigid,
                quantity("freeze_after_crossings", Ratio, "[0, 1e6]", value("5"), field(in, &C::freeze_after_crossings),
                         "Quiet time before a fragment becomes rigid, in times that a wave takes to cross it.")),
      only_when(rigid,
                quantity("wake_at_speed_share", Ratio, "(0, 1]", value("0.25"), field(in, &C::wake_at_speed_share),
                         "An approach faster than this part of its critical impact speed wakes a fragment.")),
      only_when(rigid, quantity("wake_at_load_share", Ratio, "(0, 1]", value("0.3"), field(in, &C::wake_at_load_share),
                                "A load 0.9 F/d^2 above this part of its strength wakes a fragment.")),
  };
}

std::vector<Key> run_keys() {
  using C = TimeConfig;
  constexpr auto in = [](auto& config, std::size_t) -> auto& { return config.run; };
  return {
      quantity("end_time", Time, "[1 ps, 100 s]", absent("automatic: when nothing breaks any more"),
               field(in, &C::end_time), "Simulated time at which the run ends."),
      quantity("step_safety", Ratio, "[0.001, 0.9]", value("0.5"), field(in, &C::step_safety),
               "Time step over the largest stable one."),
      integer("threads", "[0, 1024]", value("0"), field(in, &C::threads),
              "Number of threads, 0 = all processors; results do not depend on it."),
      integer("insertion_interval", "[1, 1000]", value("4"), field(in, &C::insertion_interval),
              "Time steps between two checks for new cracks."),
      vector("gravity", Acceleration, "[-1e6 m/s2, 1e6 m/s2]", value("[0, 0, 0]"), field(in, &C::gravity),
             "Acceleration of gravity along x, y, z."),
      integer("seed", "[0, 1e15]", value("0"), field(in, &C::seed),
              "Seed of everything random that is given no seed of its own: mesh.seed, fracture.weibull_seed."),
  };
}

std::vector<Key> output_keys() {
  using C = OutputConfig;
  constexpr auto in = [](auto& config, std::size_t) -> auto& { return config.output; };
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

}  // namespace knap
