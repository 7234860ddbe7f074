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

/// A contact point in the grid, with all that the search reads.
struct GridPoint {
  Vec3 position = Vec3::Zero();  ///< [m]
  Cell cell = Cell::Zero();
  Index point = none;  ///< in ContactState::points
  Index fragment = none;
};

/// Points sorted into the cells of an unbounded regular grid, the cells hashed into buckets: fragments that fly far
/// cost nothing.
struct PointGrid {
  double cell_size = 1.0;
  std::uint32_t mask = 0;
  std::vector<Index> offsets;             ///< bucket b has points [offsets[b], offsets[b + 1])
  std::vector<GridPoint> points;          ///< by bucket
  std::vector<Index> fragment_of_bucket;  ///< the only one with points in it, none = several

  Cell cell(const Vec3& p) const {
    // Beyond a billion cells all is one cell: slow there, but right.
    return (p / cell_size).array().floor().max(-1e9).min(1e9).cast<int>();
  }
  Index bucket(const Cell& c) const {
    const auto part = [](int i, std::uint32_t prime) { return static_cast<std::uint32_t>(i) * prime; };
    return static_cast<Index>((part(c.x(), 73856093u) ^ part(c.y(), 19349663u) ^ part(c.z(), 83492791u)) & mask);
  }
};

void note_fragments(PointGrid& grid) {
  grid.fragment_of_bucket.assign(grid.offsets.size() - 1, none);
  for (std::size_t bucket = 0; bucket + 1 < grid.offsets.size(); ++bucket) {
    const std::span points(grid.points.data() + grid.offsets[bucket], grid.points.data() + grid.offsets[bucket + 1]);
    const auto same = [&points](const GridPoint& point) { return point.fragment == points.front().fragment; };
    if (!points.empty() && std::all_of(points.begin(), points.end(), same))
      grid.fragment_of_bucket[bucket] = points.front().fragment;
  }
}

PointGrid make_grid(const std::vector<ContactPoint>& points, std::span<const Vec4> x, double cell_size) {
  PointGrid grid;
  grid.cell_size = cell_size;
  const std::uint32_t buckets = std::bit_ceil(static_cast<std::uint32_t>(2 * points.size() + 1));
  grid.mask = buckets - 1;
  std::vector<GridPoint> unsorted;
  std::vector<Index> bucket_of_point;
  unsorted.reserve(points.size());
  bucket_of_point.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = position(points[i], x);
    unsorted.push_back({p, grid.cell(p), to_index(i), points[i].fragment});
    bucket_of_point.push_back(grid.bucket(unsorted.back().cell));
  }
  Csr points_of_bucket = make_csr(static_cast<Index>(buckets), bucket_of_point);
  grid.offsets = std::move(points_of_bucket.offsets);
  grid.points.reserve(points.size());
  for (const Index i : points_of_bucket.items) grid.points.push_back(unsorted[at(i)]);
  note_fragments(grid);
  return grid;
}

/// Calls visit(point) for the points in a box that belong to other fragments.
template <class Visit>
void visit_points(const PointGrid& grid, const Eigen::AlignedBox3d& box, Index fragment, Visit&& visit) {
  const Cell low = grid.cell(box.min()), high = grid.cell(box.max());
  for (int k = low.z(); k <= high.z(); ++k)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int i = low.x(); i <= high.x(); ++i) {
        const Cell cell(i, j, k);
        const Index bucket = grid.bucket(cell);
        if (grid.fragment_of_bucket[at(bucket)] == fragment) continue;
        for (Index p = grid.offsets[at(bucket)]; p < grid.offsets[at(bucket + 1)]; ++p) {
          const GridPoint& point = grid.points[at(p)];
          if (point.fragment != fragment && point.cell == cell && box.contains(point.position)) visit(point);
        }
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

std::vector<Index> tets_with_free_faces(std::span<const std::uint8_t> free_faces) {
  std::vector<Index> tets;
  for (std::size_t t = 0; t < free_faces.size(); ++t)
    if (free_faces[t] != 0) tets.push_back(to_index(t));
  return tets;
}

/// What the search reads beside the contact's own state.
struct Surroundings {
  const Topology& topology;
  std::span<const Vec4> x;
  std::span<const std::uint8_t> has_records;
  const PointGrid& grid;
};

void add_candidates_of_tet(const ContactState& contact, const Surroundings& here, Index tet,
                           std::vector<ContactCandidate>& found) {
  const TetCorners& nodes = here.topology.tet_nodes[at(tet)];
  Eigen::AlignedBox3d box;
  for (const Index node : nodes) box.extend(Vec3(xyz(here.x[at(node)])));
  box.min().array() -= contact.skin;
  box.max().array() += contact.skin;
  const TetPlanes planes(nodes, here.x);
  visit_points(here.grid, box, contact.fragment_of_tet[at(tet)], [&](const GridPoint& point) {
    const double separation = planes.distance_bound(point.position);
    if (separation > contact.skin) return;
    if (joined_by_records(contact.points[at(point.point)], tet, here.topology, here.has_records)) return;
    found.push_back({point.point, tet, separation});
  });
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
  const std::vector<Index> tets = tets_with_free_faces(contact.free_faces);
  const PointGrid grid = make_grid(contact.points, x, mean_tet_size(topology, x, tets));
  const Surroundings here{topology, x, has_records, grid};
  std::vector<std::vector<ContactCandidate>> found(at(num_blocks(to_index(tets.size()), tets_per_block)));
  parallel_blocks(to_index(found.size()), [&](Index block) {
    const Index end = std::min(to_index(tets.size()), (block + 1) * tets_per_block);
    for (Index k = block * tets_per_block; k < end; ++k)
      add_candidates_of_tet(contact, here, tets[at(k)], found[at(block)]);
  });
  for (auto& part : found) {
    make_room(contact.candidates, contact.candidates.size() + part.size());
    contact.candidates.insert(contact.candidates.end(), part.begin(), part.end());
    part = {};
  }
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
