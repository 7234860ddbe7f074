// Two spheres collide. Without friction and head on they part as two points that keep momentum and energy do; at an
// angle, with friction and spin, the sums of their momenta stay what they were.
#include <fmt/format.h>

#include <cmath>

#include "meshing/tetrahedralise.hpp"
#include "simulation/make_simulation.hpp"
#include "validation/problems.hpp"
#include "validation/support/checked_step.hpp"

namespace knap {
namespace {

constexpr double speed = 10.0;  // of approach [m/s]

/// A sphere of zeolite or of something heavier and stiffer.
struct Ball {
  double radius = 1e-3;          ///< [m]
  double stiffness = 1.0;        ///< over zeolite's [-]
  double density_ratio = 1.0;    ///< [-]
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  Vec3 spin = Vec3::Zero();      ///< [rad/s]
};

/// Of one collision along z, the first ball below.
struct Collision {
  std::array<double, 2> mass{}, velocity{};      ///< after it [kg], [m/s]
  double linear = 0.0, angular = 0.0;            ///< largest changes of the sums [-]
  double closure_error = 0.0;                    ///< [-]
  std::vector<double> time{};                    ///< [us]
  std::array<std::vector<double>, 2> history{};  ///< velocities along z [m/s]
};

TetMesh mesh_of(const Ball& ball, double elements, int pole) {
  const double contact = 0.13 * ball.radius;  // radius of the contact, about [m]
  TetMesh mesh = tetrahedralise(Sphere{2.0 * ball.radius}, {.element_size = 0.7 * ball.radius / elements,
                                                            .contact_element_size = contact / elements,
                                                            .contact_extent = 2.4 * contact,
                                                            .contact_points = {{0.0, 0.0, pole * ball.radius}},
                                                            .seed = pole + 2});
  double most = 0.0;
  for (const Vec3& x : mesh.vertices) most = std::max(most, pole * x.z());
  for (Vec3& x : mesh.vertices) x.z() -= pole * (most + 1e-9);
  return mesh;
}

ParticleOptions particle_of(const Ball& ball, double friction) {
  return {.young_modulus = 2.45e9 * ball.stiffness,
          .poisson_ratio = 0.25,
          .density = 1270.0 * ball.density_ratio,
          .friction = friction,
          .velocity = ball.velocity,
          .spin = ball.spin};
}

// Mass and velocity along z of the nodes [first, last).
std::array<double, 2> mass_and_velocity(const NodalState& nodes, Index first, Index last) {
  double mass = 0.0, momentum = 0.0;
  for (Index i = first; i < last; ++i) mass += nodes.mass[at(i)], momentum += nodes.mass[at(i)] * nodes.v[at(i)].z();
  return {mass, momentum / mass};
}

Collision collide(const std::array<Ball, 2>& balls, double friction, double elements) {
  const std::vector<TetMesh> meshes{mesh_of(balls[0], elements, 1), mesh_of(balls[1], elements, -1)};
  const SimulationOptions options{.particles = {particle_of(balls[0], friction), particle_of(balls[1], friction)},
                                  .step_safety = 0.8};
  Simulation s = make_simulation(options, meshes);
  const std::array<Index, 3> nodes{0, meshes[0].num_vertices(), s.nodes.size()};
  const double own = std::min(balls[0].radius, balls[1].radius);
  const double scale = speed * mass_and_velocity(s.nodes, nodes[0], nodes[1])[0];
  Collision result;
  while (s.clock.time() < 14e-6) {
    checked_step(s);
    if (s.clock.step % 20 != 0) continue;
    const Momentum now = momentum(s.nodes);
    const Momentum& start = s.reference.start;
    result.linear = std::max(result.linear, (now.linear - start.linear).norm() / scale);
    result.angular = std::max(result.angular, (now.angular - start.angular).norm() / (scale * own));
    result.time.push_back(1e6 * s.clock.time());
    for (std::size_t k = 0; k < 2; ++k)
      result.history[k].push_back(mass_and_velocity(s.nodes, nodes[k], nodes[k + 1])[1]);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    result.mass[k] = mass_and_velocity(s.nodes, nodes[k], nodes[k + 1])[0];
    result.velocity[k] = result.history[k].back();
  }
  result.closure_error = s.ledger.max_closure_error;
  return result;
}

// The first ball meets the second, which rests.
void show_head_on(Evidence& evidence, const std::string& name, const Collision& found) {
  const auto& [m1, m2] = found.mass;
  const std::string why = "waves take less than 1 % of the approach";
  evidence.relative(name + ": velocity of the first after over that before, plus 1 [-]",
                    found.velocity[0] / speed + 1.0, (m1 - m2) / (m1 + m2) + 1.0, 0.01, why);
  evidence.relative(name + ": velocity of the second after over that of the first before [-]",
                    found.velocity[1] / speed, 2.0 * m1 / (m1 + m2), 0.01, why);
  evidence.between(name + ": restitution [-]", (found.velocity[1] - found.velocity[0]) / speed, 0.99, 1.0, why);
}

void show_momenta(Evidence& evidence, const std::string& name, const Collision& found) {
  evidence.at_most(name + ": change of linear momentum [-]", found.linear, 1e-12, "round-off");
  evidence.at_most(name + ": change of angular momentum [-]", found.angular, 1e-12, "round-off");
  evidence.at_most(name + ": error of the energy balance [-]", found.closure_error, 1e-3, "method.md section 3");
}

}  // namespace

void show_collision_momenta(Evidence& evidence) {
  const double elements = evidence.is_short() ? 2.5 : 3.5;
  const Ball thrown{.velocity = {0.0, 0.0, speed}};
  const Ball heavy{.radius = 1e-3, .stiffness = 5.0, .density_ratio = 3.0};
  const Collision equal = collide({thrown, Ball{}}, 0.0, elements), unlike = collide({thrown, heavy}, 0.0, elements);
  show_head_on(evidence, "equal", equal);
  show_head_on(evidence, "a heavier second", unlike);
  show_momenta(evidence, "equal", equal);
  show_momenta(evidence, "a heavier second", unlike);
  const Ball spinning{.velocity = {0.5 * speed, 0.2 * speed, speed}, .spin = {1e3, -2e3, 3e3}};
  const Ball small{.radius = 0.7e-3, .density_ratio = 3.0, .spin = {0.0, 4e3, 0.0}};
  show_momenta(evidence, "oblique, friction and spin", collide({spinning, small}, 0.4, elements));
  const auto& [m1, m2] = unlike.mass;
  const std::vector<double> ends{0.0, unlike.time.back()};
  const double first = speed * (m1 - m2) / (m1 + m2), second = speed * 2.0 * m1 / (m1 + m2);
  evidence.curve({{"time [us]", unlike.time},
                  {"velocity of the first [m/s]", unlike.history[0]},
                  {"velocity of the second [m/s]", unlike.history[1]}});
  evidence.plot({.title = "A sphere meets one three times as heavy",
                 .x_label = "time [us]",
                 .y_label = "velocity [m/s]",
                 .series = {{"first", unlike.time, unlike.history[0]},
                            {"second", unlike.time, unlike.history[1]},
                            {"two points, first", ends, {first, first}, PlotSeries::Style::Dashes},
                            {"two points, second", ends, {second, second}, PlotSeries::Style::Dashes}}});
}

}  // namespace knap
