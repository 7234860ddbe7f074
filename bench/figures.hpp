#pragma once
// What the programs of figures share: a list of named numbers, timing, whole runs.
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

namespace knap {

/// Named numbers, printed as they come.
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

inline double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double resident_bytes() {
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

inline WholeRun whole_run(const TetMesh& mesh, const SimulationOptions& options, int threads, double end_time) {
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

inline void print_phases(const WholeRun& run) {
  fmt::print("  {:.1f} s:", run.time);
  for (std::size_t i = 0; i < num_phases; ++i)
    fmt::print(" {} {:.1f} %", name(static_cast<Phase>(i)), 100.0 * run.phases[i] / run.time);
  fmt::print("\n");
}

/// A sphere just above the wall z = 0.
inline TetMesh standing_sphere(double diameter, double element_size) {
  TetMesh mesh = tetrahedralise(Sphere{diameter}, {.element_size = element_size});
  double lowest = 0.0;
  for (const Vec3& x : mesh.vertices) lowest = std::min(lowest, x.z());
  for (Vec3& x : mesh.vertices) x.z() += 1e-9 - lowest;
  return mesh;
}

/// contact_figures.cpp
void contact_figures(Figures& figures);

}  // namespace knap
