#include "io/fragment_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/tet_mesh.hpp"

namespace knap {
namespace {

using Triangle = std::array<Index, 3>;

Triangle sorted(Triangle triangle) {
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

void check(const FrameTets& frame) {
  const auto require = [](bool holds) {
    if (!holds) throw std::invalid_argument("fragment surfaces: arrays do not fit together");
  };
  require(frame.reference.empty() || frame.reference.size() == frame.points.size());
  require(frame.fragment.size() == frame.tets.size());
  for (const TetCorners& tet : frame.tets)
    for (const Index node : tet) require(node >= 0 && at(node) < frame.points.size());
  for (const Index fragment : frame.fragment) require(fragment >= 0 && at(fragment) < frame.tets.size());
}

// The vertex of the undeformed mesh that each node was split from: nodes of one place, up to round-off. The grid is a
// millionth of the particle, and begins beside its corner so that coordinates of a regular mesh are in no doubt.
std::vector<Index> vertex_of_node(const FrameTets& frame) {
  std::vector<Index> vertex(frame.points.size());
  std::iota(vertex.begin(), vertex.end(), 0);
  if (frame.reference.empty()) return vertex;
  Eigen::AlignedBox3d box;
  for (const Vec3& x : frame.reference) box.extend(x);
  const double cell = std::max(1e-6 * box.diagonal().norm(), std::numeric_limits<double>::min());
  std::vector<std::array<std::int64_t, 3>> place;
  for (const Vec3& x : frame.reference) {
    const Vec3 a = (x - box.min()) / cell;
    place.push_back({std::llround(a.x() + 0.137), std::llround(a.y() + 0.137), std::llround(a.z() + 0.137)});
  }
  std::vector<Index> order = vertex;
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return place[at(a)] < place[at(b)]; });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (place[at(order[i])] == place[at(order[i - 1])]) vertex[at(order[i])] = vertex[at(order[i - 1])];
  return vertex;
}

struct Side {
  Triangle facet;  ///< vertices in ascending order: equal for the two sides
  Triangle nodes;
  Index tet;
  bool is_fracture = false;
};

std::vector<Side> sorted_sides(const FrameTets& frame) {
  const std::vector<Index> vertex = vertex_of_node(frame);
  std::vector<Side> sides;
  sides.reserve(4 * frame.tets.size());
  for (std::size_t t = 0; t < frame.tets.size(); ++t) {
    const TetCorners& tet = frame.tets[t];
    for (const auto& corners : facet_of_corner) {
      const Triangle nodes{tet[at(corners[0])], tet[at(corners[1])], tet[at(corners[2])]};
      const Triangle facet{vertex[at(nodes[0])], vertex[at(nodes[1])], vertex[at(nodes[2])]};
      sides.push_back({sorted(facet), nodes, to_index(t)});
    }
  }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.facet < b.facet; });
  return sides;
}

// What is outside, by fragment.
std::vector<Side> outer_sides(const FrameTets& frame) {
  const auto fragment = [&](const Side& side) { return frame.fragment[at(side.tet)]; };
  std::vector<Side> sides = sorted_sides(frame), outer;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i + 1 == sides.size() || sides[i].facet != sides[i + 1].facet) {
      outer.push_back(sides[i]);
      continue;
    }
    Side &plus = sides[i], &minus = sides[++i];
    if (fragment(plus) == fragment(minus) && sorted(plus.nodes) == sorted(minus.nodes)) continue;
    plus.is_fracture = minus.is_fracture = true;
    outer.insert(outer.end(), {plus, minus});
  }
  std::stable_sort(outer.begin(), outer.end(), [&](const Side& a, const Side& b) { return fragment(a) < fragment(b); });
  return outer;
}

double volume_of(std::span<const Vec3> x, const TetCorners& tet) {
  return std::abs(tet_volume(x[at(tet[0])], x[at(tet[1])], x[at(tet[2])], x[at(tet[3])]));
}

void add_volumes(FragmentSurfaces& surfaces, const FrameTets& frame) {
  const auto num = at(frame.fragment.empty() ? 0 : *std::max_element(frame.fragment.begin(), frame.fragment.end()) + 1);
  surfaces.volume.assign(num, 0.0);
  surfaces.centre.assign(num, Vec3::Zero());
  const std::span<const Vec3> reference = frame.reference.empty() ? frame.points : frame.reference;
  for (std::size_t t = 0; t < frame.tets.size(); ++t) {
    const TetCorners& tet = frame.tets[t];
    const std::size_t f = at(frame.fragment[t]);
    const double volume = volume_of(reference, tet);
    const auto& x = frame.points;
    surfaces.volume[f] += volume;
    surfaces.centre[f] += volume / 4 * (x[at(tet[0])] + x[at(tet[1])] + x[at(tet[2])] + x[at(tet[3])]);
  }
  for (std::size_t f = 0; f < num; ++f)
    if (surfaces.volume[f] > 0.0) surfaces.centre[f] /= surfaces.volume[f];
}

}  // namespace

FragmentSurfaces make_fragment_surfaces(const FrameTets& frame) {
  check(frame);
  FragmentSurfaces surfaces;
  add_volumes(surfaces, frame);
  const std::vector<Side> outer = outer_sides(frame);
  std::vector<Index> point_of_node(frame.points.size(), none);
  auto side = outer.begin();
  for (Index f = 0; f < surfaces.num_fragments(); ++f) {
    const Index first = to_index(surfaces.points.size());
    surfaces.first_point.push_back(first);
    surfaces.first_triangle.push_back(to_index(surfaces.triangles.size()));
    for (; side != outer.end() && frame.fragment[at(side->tet)] == f; ++side) {
      Triangle triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        Index& point = point_of_node[at(side->nodes[k])];
        if (point < first) {  // fragments may still have nodes in common: each gets its own
          point = to_index(surfaces.points.size());
          const Eigen::Vector3f x = frame.points[at(side->nodes[k])].cast<float>();
          surfaces.points.push_back({x.x(), x.y(), x.z()});
        }
        triangle[k] = point;
      }
      surfaces.triangles.push_back(triangle);
      surfaces.is_fracture.push_back(side->is_fracture);
    }
  }
  surfaces.first_point.push_back(to_index(surfaces.points.size()));
  surfaces.first_triangle.push_back(to_index(surfaces.triangles.size()));
  return surfaces;
}

}  // namespace knap
