// Speed of the bulk sweeps: tets per second by mesh size, instruction set and threads. The counters are those of the
// best sweep, which a busy machine disturbs less than the mean; with more threads than idle cores set
// OMP_WAIT_POLICY=passive.
//   kernel_bench --benchmark_filter=forces/AVX3
#include <benchmark/benchmark.h>

#include <ctime>
#include <memory>

#include "core/parallel.hpp"
#include "core/vector_targets.hpp"
#include "fem/elastic_force.hpp"
#include "tests/fem/grid_mesh.hpp"

namespace {

using namespace knap;

struct Body {
  Topology topology;
  std::vector<Vec4> x, f;
  ElasticForce elastic;
};

// A cube of about the wanted number of tets, slightly compressed; kept for the next benchmark of the same size.
Body& body(Index num_tets, bool viscous) {
  static std::pair<Index, bool> last{0, false};
  static std::unique_ptr<Body> kept;
  if (kept && last == std::pair{num_tets, viscous}) return *kept;
  kept.reset();
  const TetMesh mesh = grid_mesh(static_cast<Index>(std::lround(std::cbrt(num_tets / 6.0))), 2e-3, 0.15);
  kept = std::make_unique<Body>();
  for (const Vec3& v : mesh.vertices) kept->x.push_back(padded(0.999 * v));
  kept->f.resize(kept->x.size());
  const ViscoelasticBranch branch = viscous ? ViscoelasticBranch{0.3, 2e-6} : ViscoelasticBranch{};
  kept->topology = make_topology(mesh);
  kept->elastic = make_elastic_force(kept->topology, mesh.vertices, make_material(15e9, 0.2, 2000.0, branch));
  last = {num_tets, viscous};
  return *kept;
}

enum class Sweep { Forces, ViscousForces, Stress, Energy, Refresh };

// One thread is timed by its processor time, which other programs do not count in.
double seconds(int threads) {
  timespec now{};
  clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void sweep_once(Body& b, Sweep sweep) {
  if (sweep == Sweep::Stress)
    update_stress(b.elastic, b.x);
  else if (sweep == Sweep::Energy)
    benchmark::DoNotOptimize(strain_energy(b.elastic, b.x));
  else if (sweep == Sweep::Refresh)
    refresh_elastic_force(b.elastic, b.topology, std::array{Index{100}, Index{4000}});
  else
    update_elastic_forces(b.elastic, b.x, b.f, 3e-9);
  benchmark::ClobberMemory();
}

void run(benchmark::State& state, Sweep sweep, const std::string& target, int threads) {
  Body& b = body(static_cast<Index>(state.range(0)), sweep == Sweep::ViscousForces);
  use_vector_target(target);
  set_num_threads(threads);
  double best = 1e30;
  for (auto _ : state) {
    const double start = seconds(threads);
    sweep_once(b, sweep);
    best = std::min(best, seconds(threads) - start);
  }
  const auto tets = static_cast<double>(b.elastic.stress.size());
  state.counters["best_Mtets_per_s"] = 1e-6 * tets / best;
  state.counters["best_ns_per_tet"] = 1e9 * best / tets;
  use_vector_target("");
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::pair<std::string, Sweep>> sweeps{{"forces", Sweep::Forces},
                                                          {"viscous_forces", Sweep::ViscousForces},
                                                          {"stress", Sweep::Stress},
                                                          {"energy", Sweep::Energy},
                                                          {"refresh", Sweep::Refresh}};
  for (const auto& [name, sweep] : sweeps)
    for (const Index size : {10'000, 46'000, 140'000, 500'000, 2'000'000})
      for (const std::string& target : vector_targets())
        for (const int threads : {1, 2})
          benchmark::RegisterBenchmark((name + "/" + target + "/threads:" + std::to_string(threads)).c_str(), run,
                                       sweep, target, threads)
              ->Arg(size)
              ->UseRealTime()
              ->Unit(benchmark::kMicrosecond);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
