#include "app/particle_overlap.hpp"

#include <Eigen/Geometry>

#include "contact/tet_overlap.hpp"

namespace knap {
namespace {

struct BoxedTet {
  Eigen::AlignedBox3d box;
  TetShape shape;
};

Eigen::AlignedBox3d box_of(const TetMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.vertices) box.extend(x);
  return box;
}

// The tets that reach into a box.
std::vector<BoxedTet> tets_in(const TetMesh& mesh, const Eigen::AlignedBox3d& region) {
  std::vector<Vec4> x;
  for (const Vec3& vertex : mesh.vertices) x.push_back(padded(vertex));
  std::vector<BoxedTet> found;
  for (const TetCorners& tet : mesh.tets) {
    Eigen::AlignedBox3d box;
    for (const Index node : tet) box.extend(mesh.vertices[at(node)]);
    if (box.intersects(region)) found.push_back({box, make_tet_shape(tet, x)});
  }
  return found;
}

}  // namespace

bool overlap(const TetMesh& a, const TetMesh& b) {
  const Eigen::AlignedBox3d region = box_of(a).intersection(box_of(b));
  if (region.isEmpty()) return false;
  const auto near_a = tets_in(a, region), near_b = tets_in(b, region);
  // Two convex bodies are apart exactly when a face's plane or a direction across two edges parts them.
  for (const BoxedTet& one : near_a)
    for (const BoxedTet& other : near_b)
      if (one.box.intersects(other.box) && separation_by_faces(one.shape, other.shape) <= 0.0 &&
          separation_by_edges(one.shape, other.shape) <= 0.0)
        return true;
  return false;
}

}  // namespace knap
