// The project's figures by name: elastic kernel and step, growth with size, and a whole breaking run against its
// elastic twin. Usage: figures [--json FILE] [--time SECONDS of the breaking run, default 20e-6] [--only
// elastic|breaking]
#include <fmt/format.h>

#include <malloc.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <map>
#include <string>

#include "core/parallel.hpp"
#include "meshing/tetrahedralise.hpp"
#include "simulation/make_simulation.hpp"
#include "simulation/step.hpp"
#include "tests/fem/grid_mesh.hpp"

namespace knap {
namespace {

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

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

TetMesh sphere_46k() {
  TetMesh mesh = tetrahedralise(Sphere{2e-3}, {.element_size = 99.7e-6});
  double lowest = 0.0;
  for (const Vec3& x : mesh.vertices) lowest = std::min(lowest, x.z());
  for (Vec3& x : mesh.vertices) x.z() += 1e-9 - lowest;
  return mesh;
}

double resident_bytes() {
  malloc_trim(0);
  std::ifstream statm("/proc/self/statm");
  double size = 0.0, resident = 0.0;
  statm >> size >> resident;
  return resident * 4096.0;
}

struct WholeRun {
  double time = 0.0;   // wall clock [s]
  double bytes = 0.0;  // what the simulation holds at its end
  double closure_error = 0.0;
  PhaseTimes phases;
};

WholeRun whole_run(const TetMesh& mesh, const SimulationOptions& options, int threads, double end_time) {
  set_num_threads(threads);
  const double before = resident_bytes();
  Simulation s = make_simulation(options, mesh);
  WholeRun run;
  run.time = seconds([&] {
    while (s.clock.time() < end_time && step(s) == StepStatus::Ok) {
    }
  });
  run.bytes = resident_bytes() - before;
  run.closure_error = s.ledger.max_closure_error;
  run.phases = s.phase_times;
  return run;
}

}  // namespace
}  // namespace knap

namespace knap {
namespace {

class Figures {
 public:
  void give(const std::string& name, double value) {
    values_[name] = value;
    fmt::print("{:36} {:.4g}\n", name, value);
    std::fflush(stdout);
  }
  bool write(const std::string& path) const {
    std::ofstream file(path);
    file << "{\n";
    std::size_t left = values_.size();
    for (const auto& [name, value] : values_)
      file << fmt::format("  \"{}\": {:.6g}{}\n", name, value, --left ? "," : "");
    file << "}\n";
    return file.good();
  }

 private:
  std::map<std::string, double> values_;
};

void elastic_figures(Figures& figures) {
  constexpr Index cells_10k = 12, cells_140k = 29, cells_2m = 69;  // six tets a cell
  const double one = force_rate(cells_140k, 1);
  figures.give("elastic_force_140k_tets_per_s", one);
  figures.give("elastic_force_threads2_speedup", force_rate(cells_140k, 2) / one);
  figures.give("elastic_step_140k_tets_per_s", step_rate(cells_140k, 8));
  figures.give("step_cost_2M_over_10k", step_rate(cells_10k, 30) / step_rate(cells_2m, 10));
}

void print_phases(const WholeRun& run) {
  fmt::print("  {:.1f} s:", run.time);
  for (std::size_t i = 0; i < num_phases; ++i)
    fmt::print(" {} {:.1f} %", name(static_cast<Phase>(i)), 100.0 * run.phases[i] / run.time);
  fmt::print("\n");
}

constexpr double strength = 20e6;

// A run and its elastic twin one after the other, because a shared machine is not always equally fast.
void breaking_figures(Figures& figures, double end_time) {
  const TetMesh mesh = sphere_46k();
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
  if (only != "breaking") elastic_figures(figures);
  if (only != "elastic") breaking_figures(figures, end_time);
  return json.empty() || figures.write(json) ? 0 : 1;
}
