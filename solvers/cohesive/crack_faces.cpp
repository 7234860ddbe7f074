#include "cohesive/crack_faces.hpp"

#include "core/parallel.hpp"

namespace knap {
namespace {

// Faces near each other have their turn together, so that few vectors of records hold one that rotates.
constexpr Index faces_per_block = 256;
// Nearly collinear nodes have next to no inertia about their line. This share of the mean inertia is added to it; what
// the rotation then does not give back, it carries to the next.
constexpr double inertia_regularisation = 0.02;

Mat3 inertia_about(const CrackFace& face, const NodalState& nodes, const Vec3& centre) {
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, yz = 0.0, zx = 0.0;
  for (const auto& pair : face.nodes)
    for (const Index node : pair) {
      const Vec3 r = xyz(nodes.x[at(node)]) - centre;
      const Vec3 mr = nodes.mass[at(node)] * r;
      xx += mr.x() * r.x();
      yy += mr.y() * r.y();
      zz += mr.z() * r.z();
      xy += mr.x() * r.y();
      yz += mr.y() * r.z();
      zx += mr.z() * r.x();
    }
  Mat3 inertia;
  inertia << yy + zz, -xy, -zx, -xy, zz + xx, -yz, -zx, -yz, xx + yy;
  return inertia;
}

}  // namespace

Vec3 pending_couple(const CrackFace& face) {
  return xyz(face.couple[0]) + xyz(face.couple[1]) + xyz(face.couple[2]) + face.carried_couple;
}

namespace {

// Returns whether there is anything to give back.
bool update_rotation(CrackFace& face, const NodalState& nodes) {
  const Vec3 couple = pending_couple(face);
  face.couple.fill(Vec4::Zero());
  face.carried_couple = couple;
  if (couple.isZero(0.0)) return false;
  double mass = 0.0;
  Vec3 first = Vec3::Zero();
  for (const auto& pair : face.nodes)
    for (const Index node : pair) {
      mass += nodes.mass[at(node)];
      first += nodes.mass[at(node)] * xyz(nodes.x[at(node)]);
    }
  const Vec3 centre = first / mass;
  const Mat3 inertia = inertia_about(face, nodes, centre);
  const double shift = inertia_regularisation * inertia.trace() / 3.0;
  const Mat3 regular = inertia + shift * Mat3::Identity();
  const double determinant = regular.determinant();
  if (!(determinant > 0.0)) return false;  // all six nodes in one point: keep the couple
  const Vec3 a = regular.col(0), b = regular.col(1), c = regular.col(2);
  const Vec3 rotation = -Vec3(b.cross(c).dot(couple), c.cross(a).dot(couple), a.cross(b).dot(couple)) / determinant;
  face.carried_couple += inertia * rotation;
  face.rotation = padded(rotation);
  face.centre = padded(centre);
  return true;
}

// The nodes of a face lie anywhere in memory: asked for some faces ahead, they are there when its turn comes. GCC takes
// a function that only prefetches for one without effect, unless it is inlined.
[[gnu::always_inline]] inline void prefetch_nodes(std::span<const CrackFace> faces, Index slot, const NodalState& nodes,
                                                  bool with_masses) {
  constexpr Index distance = 12;
  if (slot + 2 * distance >= to_index(faces.size())) return;
  __builtin_prefetch(&faces[at(slot + 2 * distance)].nodes);
  __builtin_prefetch(&faces[at(slot + 2 * distance)].normal, 1);
  for (const auto& pair : faces[at(slot + distance)].nodes)
    for (const Index node : pair) {
      __builtin_prefetch(&nodes.x[at(node)]);
      if (with_masses) __builtin_prefetch(&nodes.mass[at(node)]);
    }
}

}  // namespace

Vec3 mid_surface_normal(const CrackFace& face, std::span<const Vec4> x) {
  const auto mid = [&](std::size_t k) -> Vec4 { return x[at(face.nodes[k][0])] + x[at(face.nodes[k][1])]; };
  const Vec4 a = mid(0), b = mid(1) - a, c = mid(2) - a;
  const Vec3 area = Vec3(xyz(b)).cross(Vec3(xyz(c)));
  const double norm = area.norm();
  return norm > 0.0 ? Vec3(area / norm) : Vec3(xyz(face.normal));
}

void update_normal(CrackFace& face, std::span<const Vec4> x) { xyz(face.normal) = mid_surface_normal(face, x); }

void update_crack_faces(CrackState& cracks, Topology& topology, const NodalState& nodes, Index turn) {
  const auto update = [&](Index slot) {
    CrackFace& face = cracks.faces[at(slot)];
    const bool has_turn = turn == all_turns || (slot / faces_per_block) % num_turns == turn;
    prefetch_nodes(cracks.faces, slot, nodes, has_turn);
    update_normal(face, nodes.x);
    face.normal[3] = has_turn && update_rotation(face, nodes) ? face_action::rotates : face_action::none;
    if (face.failed[0] && face.failed[1] && face.failed[2]) topology.facet_state[at(face.facet)] = FacetState::Failed;
  };
  if (cracks.any_sleeps)
    parallel_for(
        to_index(cracks.awake_faces.size()), [&](Index i) { update(cracks.awake_faces[at(i)]); }, faces_per_block);
  else
    parallel_for(to_index(cracks.faces.size()), update, faces_per_block);
}

Vec3 pending_angular_momentum(const CrackState& cracks) {
  Vec3 sum = Vec3::Zero();
  for (const CrackFace& face : cracks.faces) sum += pending_couple(face);
  return sum;
}

}  // namespace knap
