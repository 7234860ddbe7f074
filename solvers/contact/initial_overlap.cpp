#include "contact/initial_overlap.hpp"

#include <algorithm>
#include <limits>

#include "contact/tet_overlap.hpp"

namespace knap {
namespace {

// Tets are shrunk by this much, so that round-off makes no overlap of faces that touch.
constexpr double shrinkage = 1e-6;

struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 high = Vec3::Constant(std::numeric_limits<double>::lowest());

  void add(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  bool meets(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

struct BoxedTet {
  Index tet = none;
  Box box;
};

Box box_of(const TetCorners& tet, std::span<const Vec4> x) {
  Box box;
  for (const Index node : tet) box.add({xyz(x[at(node)]), xyz(x[at(node)])});
  return box;
}

TetShape shrunk(const TetCorners& tet, std::span<const Vec4> x) {
  Vec4 centre = Vec4::Zero();
  for (const Index node : tet) centre += 0.25 * x[at(node)];
  std::array<Vec4, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = x[at(tet[i])] + shrinkage * (centre - x[at(tet[i])]);
  return make_tet_shape({0, 1, 2, 3}, corners);
}

/// The tets of a particle within a box, by their lower end along x.
struct Tets {
  std::vector<BoxedTet> list;
  double longest = 0.0;  ///< extent along x [m]
};
Tets tets_within(std::span<const BoxedTet> all, const Box& box) {
  Tets within;
  for (const BoxedTet& tet : all) {
    if (!tet.box.meets(box)) continue;
    within.list.push_back(tet);
    within.longest = std::max(within.longest, tet.box.high.x() - tet.box.low.x());
  }
  std::sort(within.list.begin(), within.list.end(), [](const BoxedTet& a, const BoxedTet& b) {
    return std::pair{a.box.low.x(), a.tet} < std::pair{b.box.low.x(), b.tet};
  });
  return within;
}

/// A particle's tets and the box around them.
struct Particle {
  std::vector<BoxedTet> tets;
  Box box;
};

std::optional<std::array<Index, 2>> overlap(const Particle& first, const Particle& second,
                                            std::span<const TetCorners> tets, std::span<const Vec4> x) {
  if (!first.box.meets(second.box)) return std::nullopt;
  const Tets others = tets_within(second.tets, first.box);
  for (const BoxedTet& tet : tets_within(first.tets, second.box).list) {
    const TetShape shape = shrunk(tets[at(tet.tet)], x);
    const auto begin =
        std::lower_bound(others.list.begin(), others.list.end(), tet.box.low.x() - others.longest,
                         [](const BoxedTet& other, double lowest) { return other.box.low.x() < lowest; });
    for (auto other = begin; other != others.list.end() && other->box.low.x() <= tet.box.high.x(); ++other) {
      if (!other->box.meets(tet.box)) continue;
      const TetShape other_shape = shrunk(tets[at(other->tet)], x);
      if (separation_by_faces(shape, other_shape) > 0.0 || separation_by_edges(shape, other_shape) > 0.0) continue;
      return std::array{tet.tet, other->tet};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::array<Index, 2>> overlapping_tets(std::span<const TetCorners> tets, std::span<const Vec4> x,
                                                     std::span<const Index> particle_of_tet) {
  std::vector<Particle> particles;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    const std::size_t p = at(particle_of_tet[t]);
    if (p >= particles.size()) particles.resize(p + 1);
    particles[p].tets.push_back({to_index(t), box_of(tets[t], x)});
    particles[p].box.add(particles[p].tets.back().box);
  }
  for (std::size_t p = 0; p < particles.size(); ++p)
    for (std::size_t q = p + 1; q < particles.size(); ++q)
      if (const auto found = overlap(particles[p], particles[q], tets, x)) return found;
  return std::nullopt;
}

}  // namespace knap
