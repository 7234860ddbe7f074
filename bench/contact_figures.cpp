// Contact in a granule that breaks, a pile of fragments, the late phase of a run with and without rigid bodies, and the
// onset of fracture by equilibria.
#include "bench/figures.hpp"
#include "simulation/quasistatic_start.hpp"
#include "tests/support/loose_pieces.hpp"

namespace knap {
namespace {

ParticleOptions zeolite(double speed) {
  ParticleOptions particle{.young_modulus = 2.45e9, .poisson_ratio = 0.25, .density = 1270.0};
  particle.velocity = {0.0, 0.0, -speed};
  particle.fracture = FractureOptions{.strength = 8.34e6, .fracture_energy = 8.6};
  return particle;
}

double contact_share(const WholeRun& run) {
  const auto time = [&](Phase phase) { return run.phases[static_cast<std::size_t>(phase)]; };
  return (time(Phase::ContactDetection) + time(Phase::ContactImpulses)) / run.time;
}

void impact_figures(Figures& figures) {
  SimulationOptions options{.particles = {zeolite(40.0)}};
  options.tools = {wall(0.3)};
  const TetMesh mesh = standing_sphere(2e-3, 100e-6);
  fmt::print("zeolite, {} tets, 40 m/s, 12 us\n", mesh.num_tets());
  const WholeRun one = whole_run(mesh, options, 1, 12e-6);
  print_phases(one);
  figures.give("contact_share_40mps_46k", contact_share(one));
  const WholeRun two = whole_run(mesh, options, 2, 12e-6);
  print_phases(two);
  figures.give("contact_threads2_speedup_40mps", one.time / two.time);
}

// Cubes one upon the other in a box without a lid, under gravity; seconds a step and contact.
double pile_cost(Index per_side) {
  constexpr double edge = 1e-4;
  TetMesh mesh;
  for (Index i = 0; i < per_side; ++i)
    for (Index j = 0; j < per_side; ++j)
      for (Index k = 0; k < per_side; ++k)
        add_cube(mesh, 1, edge, 1.001 * edge * (Vec3(i, j, k) + Vec3::Constant(0.5)));
  SimulationOptions options = loose_options(false, 0.3);
  options.gravity = {0.0, 0.0, -1e4};  // [m/s2], so that it settles in a few thousand steps
  for (int axis = 0; axis < 3; ++axis) {
    options.tools.push_back(wall(0.3, Vec3::Zero(), Vec3::Unit(axis)));
    if (axis < 2) options.tools.push_back(wall(0.3, 1.001 * edge * per_side * Vec3::Ones(), -Vec3::Unit(axis)));
  }
  set_num_threads(1);
  Simulation s = make_simulation(options, mesh);
  const auto steps = [&s](int count) {
    for (int i = 0; i < count; ++i) step(s);
  };
  steps(3000);
  const double time = seconds([&] { steps(500); });
  fmt::print("pile of {} fragments: {} contacts, {:.3g} ms a step\n", s.contact.fragments, s.contact.contacts.size(),
             time / 500.0 * 1e3);
  return time / static_cast<double>(s.contact.contacts.size());
}

struct LatePhase {
  double first_half = 0.0, second_half = 0.0;  // wall clock [s]
};
LatePhase late_phase(const TetMesh& mesh, bool rigid) {
  SimulationOptions options{.particles = {zeolite(22.0)}};
  options.tools = {wall(0.3)};
  options.rigid_fragments.enabled = rigid;
  set_num_threads(1);
  Simulation s = make_simulation(options, mesh);
  const auto until = [&s](double time) {
    while (s.clock.time() < time && step(s) == StepStatus::Ok) {
    }
  };
  const LatePhase phase{seconds([&] { until(100e-6); }), seconds([&] { until(200e-6); })};
  fmt::print("{} tets, 22 m/s, {} rigid bodies: {:.1f} s to 100 us, {:.1f} s to 200 us\n", mesh.num_tets(),
             s.rigid.num_bodies(), phase.first_half, phase.second_half);
  return phase;
}

void rigid_figures(Figures& figures) {
  const TetMesh mesh = standing_sphere(1.5e-3, 0.13e-3);
  const LatePhase deformable = late_phase(mesh, false), rigid = late_phase(mesh, true);
  figures.give("rigid_first_half_speedup_8k", deformable.first_half / rigid.first_half);
  figures.give("rigid_second_half_speedup_8k", deformable.second_half / rigid.second_half);
}

// The largest memory of the process since it was told to forget [bytes].
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }
double peak_bytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kilobytes = 0.0;
  while (status >> word)
    if (word == "VmHWM:") status >> kilobytes;
  return 1024.0 * kilobytes;
}

// A granule between a plane and one that comes down; memory of the whole program.
void onset_figures(Figures& figures) {
  const double diameter = 1.5e-3;
  const TetMesh mesh = standing_sphere(diameter, 57e-6);
  SimulationOptions options{.particles = {zeolite(0.0)}};
  ToolOptions above = wall(0.3, 1.001 * diameter * Vec3::UnitZ(), -Vec3::UnitZ());
  above.name = "plane above";
  above.motion = ConstantVelocity{{0.0, 0.0, -0.1}};
  options.tools = {wall(0.3), above};
  set_num_threads(2);
  Simulation s = make_simulation(options, mesh);
  forget_peak();
  const double time = seconds([&] { start_at_onset(s); });
  fmt::print("onset of fracture: {} tets\n", mesh.num_tets());
  figures.give("onset_100k_s", time);
  figures.give("onset_100k_gib", peak_bytes() / (1024.0 * 1024.0 * 1024.0));
}

}  // namespace

void contact_figures(Figures& figures) {
  impact_figures(figures);
  figures.give("pile_cost_per_contact_2197_over_216", pile_cost(13) / pile_cost(6));
  rigid_figures(figures);
  onset_figures(figures);
}

}  // namespace knap
