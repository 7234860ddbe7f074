// The project's figures by name: elastic kernel and step, growth with size, a whole breaking run against its
// elastic twin, contact, and the onset of fracture. Usage: figures [--json FILE] [--time SECONDS of the breaking run,
// default 20e-6] [--only elastic|breaking|contact]
#include "bench/figures.hpp"

#include "tests/fem/grid_mesh.hpp"

namespace knap {
namespace {

/// Shortest of several repetitions [s]: what the machine can do when nobody else wants it.
double best_of(int repetitions, const std::function<void()>& work) {
  double best = seconds(work);
  for (int i = 1; i < repetitions; ++i) best = std::min(best, seconds(work));
  return best;
}

// An unbreakable particle is checked for breaking like any other, but never breaks.
constexpr double unbreakable = 1e12;

/// A sphere of an alumina-like material, 2 mm, and its way to break.
SimulationOptions alumina_like(double strength, const CohesiveLaw& law = {}) {
  ParticleOptions particle{.young_modulus = 15e9, .poisson_ratio = 0.25, .density = 2000.0};
  particle.velocity = {0.0, 0.0, -30.0};
  particle.fracture = FractureOptions{.law = law, .strength = strength, .fracture_energy = 20.0};
  SimulationOptions options{.particles = {particle}};
  options.tools = {wall(0.3)};
  return options;
}

Simulation elastic_cube(Index cells) {
  TetMesh mesh = grid_mesh(cells, 2e-3, 0.15);
  for (Vec3& x : mesh.vertices) x.z() += 1e-3;
  return make_simulation(alumina_like(unbreakable), mesh);
}

double force_rate(Index cells, int threads) {
  set_num_threads(threads);
  Simulation s = elastic_cube(cells);
  const double time = best_of(30, [&] { update_elastic_forces(s.elastic, s.nodes.x, s.nodes.f, 0.0); });
  return s.topology.num_tets() / time;
}

double step_rate(Index cells, int repetitions) {
  set_num_threads(1);
  Simulation s = elastic_cube(cells);
  const int steps = 24;  // a whole period of criterion and energy balance
  const double time = best_of(repetitions, [&] {
    for (int i = 0; i < steps; ++i) step(s);
  });
  return s.topology.num_tets() * steps / time;
}

void elastic_figures(Figures& figures) {
  constexpr Index cells_10k = 12, cells_140k = 29, cells_2m = 69;  // six tets a cell
  const double one = force_rate(cells_140k, 1);
  figures.give("elastic_force_140k_tets_per_s", one);
  figures.give("elastic_force_threads2_speedup", force_rate(cells_140k, 2) / one);
  figures.give("elastic_step_140k_tets_per_s", step_rate(cells_140k, 8));
  figures.give("step_cost_2M_over_10k", step_rate(cells_10k, 30) / step_rate(cells_2m, 10));
}

constexpr double strength = 20e6;

// A run and its elastic twin one after the other, because a shared machine is not always equally fast.
void breaking_figures(Figures& figures, double end_time) {
  const TetMesh mesh = standing_sphere(2e-3, 99.7e-6);
  fmt::print("breaking runs: {} tets, 30 m/s, {:g} us\n", mesh.num_tets(), end_time * 1e6);
  const WholeRun elastic = whole_run(mesh, alumina_like(unbreakable), 1, end_time);
  print_phases(elastic);
  const WholeRun breaking = whole_run(mesh, alumina_like(strength), 1, end_time);
  print_phases(breaking);
  figures.give("breaking_over_elastic_46k", breaking.time / elastic.time);
  figures.give("breaking_bytes_per_tet", breaking.bytes / mesh.num_tets());
  figures.give("breaking_closure_error", breaking.closure_error);
  const WholeRun two_threads = whole_run(mesh, alumina_like(strength), 2, end_time);
  print_phases(two_threads);
  figures.give("breaking_threads2_speedup", breaking.time / two_threads.time);
  // Harder to shear, as the granules of the method's first study.
  const CohesiveLaw tough{.beta = 2.0, .internal_friction = 0.4, .sliding_friction = 0.4};
  const WholeRun fewer_cracks = whole_run(mesh, alumina_like(strength, tough), 1, end_time);
  print_phases(fewer_cracks);
  figures.give("breaking_over_elastic_46k_beta2", fewer_cracks.time / elastic.time);
}

}  // namespace
}  // namespace knap

int main(int argc, char** argv) {
  using namespace knap;
  std::string json, only;
  double end_time = 20e-6;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::string(argv[i]) == "--json") json = argv[i + 1];
    if (std::string(argv[i]) == "--time") end_time = std::stod(argv[i + 1]);
    if (std::string(argv[i]) == "--only") only = argv[i + 1];
  }
  Figures figures;
  const auto wants = [&only](const char* part) { return only.empty() || only == part; };
  if (wants("elastic")) elastic_figures(figures);
  if (wants("breaking")) breaking_figures(figures, end_time);
  if (wants("contact")) contact_figures(figures);
  return json.empty() || figures.write(json) ? 0 : 1;
}
