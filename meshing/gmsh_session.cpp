#include "meshing/gmsh_session.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <string>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/parallel.hpp"

#ifdef __SANITIZE_ADDRESS__
// gmsh 4.8 leaks a few kilobytes in its surface mesher.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libgmsh"; }
#endif

namespace knap {
namespace {

// Every option that shapes a mesh, so that a host program's settings cannot. Sizes come from the field alone.
//
// Mesh.Algorithm3D = 1 (Delaunay) rather than 10 (HXT): HXT of gmsh 4.8 sorts vertices by their address in memory, so
// the same input gives another mesh at every call (10,235 to 10,459 tets for one sphere), and no option prevents it.
// Delaunay gives the same bits whatever the heap looks like, in the same time. Mesh.OptimizeThreshold = 0.5 instead of
// 0.3 removes most of its slivers (smallest height +30 %).
const std::vector<std::pair<std::string, double>> mesh_options{
    {"General.Terminal", 0},
    {"General.NumThreads", 1},
    {"General.AbortOnError", 0},  // a throw inside gmsh's OpenMP loops would end the process: see generate_mesh
    {"Mesh.MaxNumThreads1D", 1},
    {"Mesh.MaxNumThreads2D", 1},
    {"Mesh.MaxNumThreads3D", 1},
    {"Mesh.Algorithm", 6},
    {"Mesh.Algorithm3D", 1},
    {"Mesh.Optimize", 1},
    {"Mesh.OptimizeThreshold", 0.5},
    {"Mesh.OptimizeNetgen", 0},
    {"Mesh.ElementOrder", 1},
    {"Mesh.RandomSeed", 1},
    {"Mesh.RandomFactor", 1e-9},
    {"Mesh.RandomFactor3D", 1e-12},
    {"Mesh.Smoothing", 1},
    {"Mesh.MeshSizeFactor", 1},
    {"Mesh.MeshSizeMin", 0},
    {"Mesh.MeshSizeMax", 1e22},
    {"Mesh.MeshSizeExtendFromBoundary", 0},
    {"Mesh.MeshSizeFromPoints", 0},
    {"Mesh.MeshSizeFromCurvature", 0},
    {"Mesh.MeshSizeFromParametricPoints", 0},
};

// False also when a host program has finalised gmsh behind our back.
bool is_up() {
  try {
    double value = -1.0;
    gmsh::option::getNumber("General.Terminal", value);
    return value >= 0.0;
  } catch (...) {
    return false;
  }
}

// gmsh is never finalised here: it cannot tell who initialised it, and asking it cold prints an error.
void initialise_gmsh() {
  static const bool first_time = (gmsh::initialize(0, nullptr, false), true);
  if (first_time && !is_up()) gmsh::initialize(0, nullptr, false);
}

// Sets our options and opens a model; the destructor puts back what was there.
class Session {
 public:
  Session() {
    initialise_gmsh();
    for (const auto& [name, value] : mesh_options) {
      double before = 0.0;
      gmsh::option::getNumber(name, before);
      saved_options_.emplace_back(name, before);
      gmsh::option::setNumber(name, value);
    }
    gmsh::model::getCurrent(saved_model_);
    gmsh::model::add("knap");
  }
  ~Session() {
    try {
      gmsh::model::remove();
      std::vector<std::string> models;
      gmsh::model::list(models);
      for (const std::string& model : models)
        if (model == saved_model_) gmsh::model::setCurrent(saved_model_);
      for (const auto& [name, value] : saved_options_) gmsh::option::setNumber(name, value);
    } catch (...) {  // nothing better can be done while leaving
    }
    set_num_threads(saved_threads_);  // General.NumThreads = 1 holds for all of OpenMP
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  int saved_threads_ = num_threads();
  std::string saved_model_;
  std::vector<std::pair<std::string, double>> saved_options_;
};

}  // namespace

void with_gmsh(const std::function<void()>& work) {
  try {
    const Session session;
    work();
  } catch (const std::string& message) {  // what gmsh 4.8 throws
    throw RuntimeFailure(fmt::format("gmsh failed: {}", message));
  }
}

void generate_mesh(int dimension) {
  gmsh::model::mesh::generate(dimension);
  std::string message;  // cleared by gmsh when it starts
  gmsh::logger::getLastError(message);
  if (!message.empty()) throw RuntimeFailure(fmt::format("gmsh failed: {}", message));
}

}  // namespace knap
