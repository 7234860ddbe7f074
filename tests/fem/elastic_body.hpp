#pragma once
#include <cstring>
#include <random>

#include "fem/elastic_force.hpp"
#include "fem/sleeping_tets.hpp"
#include "tests/fem/grid_mesh.hpp"

namespace knap {

inline const Material elastic_material = make_material(1.0, 0.25, 1.0);
inline const Material viscous_material = make_material(1.0, 0.25, 1.0, {0.4, 2.0});

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// The vertices, each moved at random by at most so much along each axis.
inline std::vector<Vec4> moved(const TetMesh& mesh, double amplitude, unsigned seed = 7) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-amplitude, amplitude);
  std::vector<Vec4> x;
  for (const Vec3& v : mesh.vertices) x.push_back(padded(v + Vec3(shift(random), shift(random), shift(random))));
  return x;
}

/// A cube of n^3 cells and the forces in it.
struct ElasticBody {
  TetMesh mesh;
  Topology topology;
  ElasticForce elastic;

  std::vector<Vec4> forces(std::span<const Vec4> x, double dt = 0.0) {
    std::vector<Vec4> f(x.size(), Vec4::Constant(1e99));
    update_elastic_forces(elastic, x, f, dt);
    return f;
  }
  void activate(std::span<const Index> active) { set_active_tets(elastic, topology, mesh.vertices, active); }
};

inline ElasticBody elastic_body(Index n, std::span<const Material> materials,
                                std::span<const Index> material_of_tet = {}, double jitter = 0.15) {
  ElasticBody body{grid_mesh(n, 1.0, jitter), {}, {}};
  body.topology = make_topology(body.mesh);
  body.elastic = make_elastic_force(body.topology, body.mesh.vertices, materials, material_of_tet);
  return body;
}
inline ElasticBody elastic_body(Index n, const Material& material, double jitter = 0.15) {
  return elastic_body(n, std::span(&material, 1), {}, jitter);
}

}  // namespace knap
