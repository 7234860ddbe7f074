#pragma once
#include <span>

#include "core/tet_mesh.hpp"

namespace knap {

/// A linear tet in its reference state.
struct TetReference {
  Mat3 inverse_edges;   ///< inverse of the matrix of columns b-a, c-a, d-a [1/m]
  double volume = 0.0;  ///< [m3]
};

inline TetReference make_tet_reference(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Mat3 edges;
  edges << b - a, c - a, d - a;
  return {edges.inverse(), edges.determinant() / 6.0};
}

inline TetReference make_tet_reference(std::span<const Vec3> positions, const TetCorners& tet) {
  return make_tet_reference(positions[at(tet[0])], positions[at(tet[1])], positions[at(tet[2])], positions[at(tet[3])]);
}

/// Gradients of the four shape functions in the reference state [1/m].
inline std::array<Vec3, 4> shape_gradients(const TetReference& tet) {
  const Vec3 b = tet.inverse_edges.row(0), c = tet.inverse_edges.row(1), d = tet.inverse_edges.row(2);
  return {-(b + c + d), b, c, d};
}

/// Deformation gradient of a tet with current corners a, b, c, d [-].
inline Mat3 deformation_gradient(const TetReference& tet, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Mat3 edges;
  edges << b - a, c - a, d - a;
  return edges * tet.inverse_edges;
}

/// Reference volume of every tet [m3].
inline std::vector<double> tet_volumes(std::span<const TetCorners> tets, std::span<const Vec3> positions) {
  std::vector<double> volumes(tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t) volumes[t] = make_tet_reference(positions, tets[t]).volume;
  return volumes;
}

}  // namespace knap
