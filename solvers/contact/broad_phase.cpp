#include "contact/broad_phase.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "contact/free_faces.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index tets_per_block = 512;

using Cell = Eigen::Vector3i;

/// Points sorted into the cells of an unbounded regular grid, the cells hashed into buckets: fragments that fly far
/// cost nothing.
struct PointGrid {
  double cell_size = 1.0;
  std::uint32_t mask = 0;
  std::vector<Cell> cell_of_point;
  Csr points_of_bucket;

  Cell cell(const Vec3& p) const {
    // Beyond a billion cells all is one cell: slow there, but right.
    return (p / cell_size).array().floor().max(-1e9).min(1e9).cast<int>();
  }
  Index bucket(const Cell& c) const {
    const auto part = [](int i, std::uint32_t prime) { return static_cast<std::uint32_t>(i) * prime; };
    return static_cast<Index>((part(c.x(), 73856093u) ^ part(c.y(), 19349663u) ^ part(c.z(), 83492791u)) & mask);
  }
};

PointGrid make_grid(const std::vector<Vec3>& positions, double cell_size) {
  PointGrid grid;
  grid.cell_size = cell_size;
  const std::uint32_t buckets = std::bit_ceil(static_cast<std::uint32_t>(2 * positions.size() + 1));
  grid.mask = buckets - 1;
  std::vector<Index> bucket_of_point(positions.size());
  grid.cell_of_point.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    grid.cell_of_point[i] = grid.cell(positions[i]);
    bucket_of_point[i] = grid.bucket(grid.cell_of_point[i]);
  }
  grid.points_of_bucket = make_csr(static_cast<Index>(buckets), bucket_of_point);
  return grid;
}

/// Calls visit(point) for the points in the cells that a box touches.
template <class Visit>
void visit_points(const PointGrid& grid, const Eigen::AlignedBox3d& box, Visit&& visit) {
  const Cell low = grid.cell(box.min()), high = grid.cell(box.max());
  for (int k = low.z(); k <= high.z(); ++k)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int i = low.x(); i <= high.x(); ++i) {
        const Cell cell(i, j, k);
        for (const Index p : grid.points_of_bucket[grid.bucket(cell)])
          if (grid.cell_of_point[at(p)] == cell) visit(p);
      }
}

/// The outward face planes of a tet, to bound distances from below.
struct TetPlanes {
  std::array<Vec3, 4> normal;
  std::array<double, 4> offset;

  TetPlanes(const TetCorners& nodes, std::span<const Vec4> x) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& corners = facet_of_corner[i];
      const Vec3 a = xyz(x[at(nodes[at(corners[0])])]);
      const Vec3 b = xyz(x[at(nodes[at(corners[1])])]);
      const Vec3 c = xyz(x[at(nodes[at(corners[2])])]);
      normal[i] = (b - a).cross(c - a).normalized();
      offset[i] = normal[i].dot(a);
    }
  }
  double distance_bound(const Vec3& p) const {
    double largest = -1e300;
    for (std::size_t i = 0; i < 4; ++i) largest = std::max(largest, normal[i].dot(p) - offset[i]);
    return std::max(0.0, largest);
  }
};

bool joined_by_records(const ContactPoint& point, Index tet, const Topology& topology,
                       std::span<const std::uint8_t> has_records) {
  const TetCorners& vertices = topology.tet_vertices[at(tet)];
  for (const Index node : point.nodes) {
    if (node == none) continue;
    const Index vertex = topology.vertex_of_node[at(node)];
    if (has_records[at(vertex)] && std::find(vertices.begin(), vertices.end(), vertex) != vertices.end()) return true;
  }
  return false;
}

double mean_tet_size(const Topology& topology, std::span<const Vec4> x, const std::vector<Index>& tets) {
  double sum = 0.0;
  for (const Index t : tets)
    sum += (xyz(x[at(topology.tet_nodes[at(t)][0])]) - xyz(x[at(topology.tet_nodes[at(t)][1])])).norm();
  return tets.empty() ? 1.0 : sum / static_cast<double>(tets.size());
}

}  // namespace

Vec3 position(const ContactPoint& point, std::span<const Vec4> x) {
  if (point.is_node()) return xyz(x[at(point.nodes[0])]);
  return (xyz(x[at(point.nodes[0])]) + xyz(x[at(point.nodes[1])]) + xyz(x[at(point.nodes[2])])) / 3.0;
}

void rebuild_candidates(ContactState& contact, const Topology& topology, std::span<const Vec4> x,
                        std::span<const std::uint8_t> has_records) {
  contact.travel = 0.0;
  contact.points.clear();
  contact.candidates.clear();
  if (contact.fragments < 2) return;
  contact.free_faces = free_faces(topology);
  contact.points = contact_points(topology, contact.free_faces, contact.fragment_of_tet);
  std::vector<Index> tets;
  for (Index t = 0; t < topology.num_tets(); ++t)
    if (contact.free_faces[at(t)] != 0) tets.push_back(t);

  std::vector<Vec3> positions(contact.points.size());
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = position(contact.points[i], x);
  const PointGrid grid = make_grid(positions, mean_tet_size(topology, x, tets));

  const Index blocks = num_blocks(to_index(tets.size()), tets_per_block);
  std::vector<std::vector<ContactCandidate>> found(at(blocks));
  parallel_blocks(blocks, [&](Index block) {
    const Index end = std::min(to_index(tets.size()), (block + 1) * tets_per_block);
    for (Index k = block * tets_per_block; k < end; ++k) {
      const Index tet = tets[at(k)];
      Eigen::AlignedBox3d box;
      for (const Index node : topology.tet_nodes[at(tet)]) box.extend(Vec3(xyz(x[at(node)])));
      box.min().array() -= contact.skin;
      box.max().array() += contact.skin;
      const TetPlanes planes(topology.tet_nodes[at(tet)], x);
      visit_points(grid, box, [&](Index p) {
        const ContactPoint& point = contact.points[at(p)];
        if (point.fragment == contact.fragment_of_tet[at(tet)] || !box.contains(positions[at(p)])) return;
        const double separation = planes.distance_bound(positions[at(p)]);
        if (separation > contact.skin || joined_by_records(point, tet, topology, has_records)) return;
        found[at(block)].push_back({p, tet, separation});
      });
    }
  });
  for (const auto& part : found) contact.candidates.insert(contact.candidates.end(), part.begin(), part.end());
}

double largest_approach(std::span<const Vec4> v, double dt) {
  struct Range {
    Vec4 low = Vec4::Constant(1e300), high = Vec4::Constant(-1e300);
    Range& operator+=(const Range& other) {
      low = low.cwiseMin(other.low);
      high = high.cwiseMax(other.high);
      return *this;
    }
  };
  const Range range = ordered_sum<Range>(to_index(v.size()), [&](Index i) { return Range{v[at(i)], v[at(i)]}; });
  return v.empty() ? 0.0 : dt * (range.high - range.low).norm();
}

}  // namespace knap
