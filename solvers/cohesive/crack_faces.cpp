#include "cohesive/crack_faces.hpp"

#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index faces_per_block = 256;
constexpr Index vertices_per_block = 64;

void update_rotation(CrackFace& face, const NodalState& nodes) {
  const Vec3 couple = face.couple[0] + face.couple[1] + face.couple[2];
  face.rotation.setZero();
  if (couple.squaredNorm() == 0.0) return;
  double mass = 0.0;
  Vec3 first = Vec3::Zero();
  for (const auto& pair : face.nodes)
    for (const Index node : pair) {
      mass += nodes.mass[at(node)];
      first += nodes.mass[at(node)] * xyz(nodes.x[at(node)]);
    }
  face.centre = first / mass;
  Mat3 inertia = Mat3::Zero();
  for (const auto& pair : face.nodes)
    for (const Index node : pair) {
      const Vec3 r = xyz(nodes.x[at(node)]) - face.centre;
      inertia += nodes.mass[at(node)] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
  face.rotation = -inertia.ldlt().solve(couple);
}

}  // namespace

void update_normal(CrackFace& face, std::span<const Vec4> x) {
  const auto mid = [&](std::size_t k) -> Vec3 { return xyz(x[at(face.nodes[k][0])]) + xyz(x[at(face.nodes[k][1])]); };
  const Vec3 a = mid(0);
  const Vec3 area = (mid(1) - a).cross(mid(2) - a);
  const double norm = area.norm();
  if (norm > 0.0) face.normal = area / norm;
}

void update_crack_faces(CrackState& cracks, Topology& topology, const NodalState& nodes) {
  parallel_for(
      to_index(cracks.faces.size()),
      [&](Index slot) {
        CrackFace& face = cracks.faces[at(slot)];
        update_normal(face, nodes.x);
        update_rotation(face, nodes);
        if (face.failed[0] && face.failed[1] && face.failed[2])
          topology.facet_state[at(face.facet)] = FacetState::Failed;
      },
      faces_per_block);
}

void restore_angular_momentum(const CrackState& cracks, NodalState& nodes) {
  parallel_for(
      to_index(cracks.vertices.size()),
      [&](Index i) {
        for (const CrackRecord& record : cracks.records_of_vertex[at(cracks.vertices[at(i)])]) {
          const CrackFace& face = cracks.faces[at(record.face)];
          if (face.rotation.squaredNorm() == 0.0) continue;
          for (const Index node : {record.node_a, record.node_b})
            xyz(nodes.v[at(node)]) += face.rotation.cross(xyz(nodes.x[at(node)]) - face.centre);
        }
      },
      vertices_per_block);
}

Vec3 pending_angular_momentum(const CrackState& cracks) {
  Vec3 sum = Vec3::Zero();
  for (const CrackFace& face : cracks.faces) sum += face.couple[0] + face.couple[1] + face.couple[2];
  return sum;
}

}  // namespace knap
