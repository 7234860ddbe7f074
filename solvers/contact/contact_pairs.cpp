#include "contact/contact_pairs.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "contact/broad_phase.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index candidates_per_block = 1024;
// Of the gap to a tet, what the way towards it may use up until the next look; the rest is for round-off.
constexpr double part_of_gap = 0.999;

bool by_point_and_tet(const Contact& a, const Contact& b) {
  return std::tie(a.point_key, a.tet) < std::tie(b.point_key, b.tet);
}

/// Barycentric coordinates of p in a tet and their gradients [1/m].
struct Barycentric {
  std::array<double, 4> lambda{-1.0, -1.0, -1.0, -1.0};
  std::array<Vec3, 4> gradient{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // left so by an inverted tet

  Barycentric(const TetCorners& nodes, std::span<const Vec4> x, const Vec3& p) {
    const Vec3 origin = xyz(x[at(nodes[0])]);
    const Vec3 a = xyz(x[at(nodes[1])]) - origin;
    const Vec3 b = xyz(x[at(nodes[2])]) - origin;
    const Vec3 c = xyz(x[at(nodes[3])]) - origin;
    const Vec3 bc = b.cross(c);
    const double determinant = a.dot(bc);
    if (determinant <= 0.0) return;
    gradient[1] = bc / determinant;
    gradient[2] = c.cross(a) / determinant;
    gradient[3] = a.cross(b) / determinant;
    gradient[0] = -(gradient[1] + gradient[2] + gradient[3]);
    const Vec3 r = p - origin;
    for (std::size_t i = 1; i < 4; ++i) lambda[i] = gradient[i].dot(r);
    lambda[0] = 1.0 - lambda[1] - lambda[2] - lambda[3];
  }
  bool inside() const {
    return std::all_of(lambda.begin(), lambda.end(), [](double l) { return l >= 0.0; });
  }
  double depth(std::size_t face) const { return lambda[face] / gradient[face].norm(); }
  /// Lower bound of the distance between point and tet [m].
  double gap() const {
    double largest = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
      if (lambda[i] < 0.0 && !gradient[i].isZero(0.0)) largest = std::max(largest, -depth(i));
    return largest;
  }
};

/// The contact of the same point and tet in the last step, if there was one.
const Contact* last_step(const ContactState& contact, std::int64_t point_key, Index tet) {
  Contact wanted;
  wanted.point_key = point_key;
  wanted.tet = tet;
  const auto old = std::lower_bound(contact.contacts.begin(), contact.contacts.end(), wanted, by_point_and_tet);
  return old != contact.contacts.end() && !by_point_and_tet(wanted, *old) ? &*old : nullptr;
}

/// The free face nearest to the point; every candidate tet has one.
std::size_t nearest_free_face(unsigned free_faces, const Barycentric& coordinates) {
  std::size_t nearest = 4;
  for (std::size_t i = 0; i < 4; ++i)
    if ((free_faces >> i & 1u) != 0 && (nearest == 4 || coordinates.depth(i) < coordinates.depth(nearest))) nearest = i;
  return nearest;
}

Contact touching(const ContactState& contact, const ContactCandidate& candidate, const TetCorners& nodes,
                 const Barycentric& coordinates) {
  const ContactPoint& point = contact.points[at(candidate.point)];
  Contact found;
  found.point_key = point.key;
  found.tet = candidate.tet;
  std::size_t face = nearest_free_face(contact.free_faces[at(candidate.tet)], coordinates);
  if (const Contact* old = last_step(contact, point.key, candidate.tet)) {
    found.impulse = old->impulse;
    if (old->impulse.squaredNorm() > 0.0)
      face = static_cast<std::size_t>(old->face);  // a lasting contact keeps its face
  }
  found.face = static_cast<std::int8_t>(face);
  found.normal = -coordinates.gradient[face].normalized();
  found.depth = coordinates.depth(face);
  for (std::size_t i = 0; i < 3; ++i) {
    found.nodes[i] = point.is_node() ? point.nodes[0] : point.nodes[i];
    found.weights[i] = point.is_node() ? (i == 0 ? 1.0 : 0.0) : 1.0 / 3.0;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    found.nodes[3 + i] = nodes[i];
    found.weights[3 + i] = -coordinates.lambda[i];
  }
  return found;
}

// The contact of a candidate if its point is inside; otherwise sets when to look again.
std::optional<Contact> narrow(const ContactState& contact, ContactCandidate& candidate, const Topology& topology,
                              std::span<const Vec4> x) {
  const TetCorners& nodes = topology.tet_nodes[at(candidate.tet)];
  const Barycentric coordinates(nodes, x, position(contact.points[at(candidate.point)], x));
  if (coordinates.inside()) return touching(contact, candidate, nodes, coordinates);
  candidate.due = contact.travel + part_of_gap * coordinates.gap();
  return std::nullopt;
}

// The candidates of a block that must be looked at now; returns their number.
Index collect_due(const ContactState& contact, Index block, std::span<Index> due) {
  const Index end = std::min(to_index(contact.candidates.size()), (block + 1) * candidates_per_block);
  Index count = 0;
  for (Index i = block * candidates_per_block; i < end; ++i) {
    due[at(count)] = i;
    count += contact.candidates[at(i)].due <= contact.travel ? 1 : 0;
  }
  return count;
}

// What candidates need lies anywhere in memory: asked for ahead, first points and corners, then their positions.
// Inlined because GCC takes a function that only prefetches for one without effect.
[[gnu::always_inline]] inline void prefetch_candidate(const ContactState& contact, const Topology& topology,
                                                      std::span<const Vec4> x, std::span<const Index> due, Index i) {
  constexpr Index far = 16, near = 8;
  if (i + far >= to_index(due.size())) return;
  const ContactCandidate& later = contact.candidates[at(due[at(i + far)])];
  __builtin_prefetch(&contact.points[at(later.point)]);
  __builtin_prefetch(&topology.tet_nodes[at(later.tet)]);
  const ContactCandidate& soon = contact.candidates[at(due[at(i + near)])];
  for (const Index node : contact.points[at(soon.point)].nodes)
    if (node != none) __builtin_prefetch(&x[at(node)]);
  for (const Index node : topology.tet_nodes[at(soon.tet)]) __builtin_prefetch(&x[at(node)]);
}

}  // namespace

void refresh_contacts(ContactState& contact, const Topology& topology, std::span<const Vec4> x) {
  const Index count = to_index(contact.candidates.size());
  std::vector<std::vector<Contact>> found(at(num_blocks(count, candidates_per_block)));
  parallel_blocks(to_index(found.size()), [&](Index block) {
    std::array<Index, std::size_t{candidates_per_block}> due;
    const Index num_due = collect_due(contact, block, due);
    for (Index i = 0; i < num_due; ++i) {
      prefetch_candidate(contact, topology, x, std::span(due).first(at(num_due)), i);
      if (const auto now = narrow(contact, contact.candidates[at(due[at(i)])], topology, x))
        found[at(block)].push_back(*now);
    }
  });
  contact.contacts.clear();
  for (const auto& part : found) contact.contacts.insert(contact.contacts.end(), part.begin(), part.end());
  std::sort(contact.contacts.begin(), contact.contacts.end(), by_point_and_tet);
}

}  // namespace knap
