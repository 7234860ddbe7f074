#include "contact/repair_surface.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/errors.hpp"

namespace knap {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Soup = std::vector<std::array<Vec3, 3>>;

// Corners this near, over the surface's extent, are one: a few units in the last place of single precision.
constexpr double same_place = 1e-6;
constexpr double smallest_extent = 1e-6, largest_extent = 100.0, largest_coordinate = 1000.0;  // [m]

/// Triangles under repair and the numbers they have in the file, from 1.
struct Numbered {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::size_t> numbers;
};

double extent_of(const Soup& soup, const std::string& name) {
  Vec3 low = soup.front()[0], high = low;
  for (const auto& triangle : soup)
    for (const Vec3& corner : triangle) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  const double extent = (high - low).maxCoeff();
  if (!(extent >= smallest_extent && extent <= largest_extent))
    throw InputError(fmt::format("{}: the surface is {:.3g} m large, outside {:g} m to {:g} m: is its scale right?",
                                 name, extent, smallest_extent, largest_extent));
  if (!(low.minCoeff() >= -largest_coordinate && high.maxCoeff() <= largest_coordinate))
    throw InputError(fmt::format("{}: the surface is more than {:g} m from the origin", name, largest_coordinate));
  return extent;
}

/// Joins corners: in a grid of cells as large as the tolerance the first corner within it is taken.
class Welder {
 public:
  Welder(std::vector<Vec3>& vertices, double tolerance) : vertices_(vertices), tolerance_(tolerance) {}

  Index vertex(const Vec3& corner) {
    const Cell cell = cell_of(corner);
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto found = vertices_in_.find({cell[0] + i, cell[1] + j, cell[2] + k});
          if (found == vertices_in_.end()) continue;
          for (const Index candidate : found->second)
            if ((vertices_[at(candidate)] - corner).norm() <= tolerance_) return candidate;
        }
    vertices_in_[cell].push_back(to_index(vertices_.size()));
    vertices_.push_back(corner);
    return to_index(vertices_.size()) - 1;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell_of(const Vec3& corner) const {
    Cell cell;
    for (std::size_t i = 0; i < 3; ++i)
      cell[i] = static_cast<std::int64_t>(std::floor(corner[static_cast<Eigen::Index>(i)] / tolerance_));
    return cell;
  }

  std::vector<Vec3>& vertices_;
  double tolerance_;
  std::map<Cell, std::vector<Index>> vertices_in_;
};

Numbered welded(const Soup& soup, double tolerance) {
  Numbered result;
  Welder welder(result.vertices, tolerance);
  std::set<Triangle> known;
  for (std::size_t number = 1; number <= soup.size(); ++number) {
    Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = welder.vertex(soup[number - 1][i]);
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
    Triangle sorted = triangle;
    std::sort(sorted.begin(), sorted.end());
    if (!known.insert(sorted).second) continue;
    result.triangles.push_back(triangle);
    result.numbers.push_back(number);
  }
  return result;
}

struct EdgeSide {
  Index triangle;
  bool ascending;  // the triangle goes along the edge from its lower vertex to the higher
};
using Edges = std::map<std::pair<Index, Index>, std::vector<EdgeSide>>;

Edges edges_of(const Numbered& surface, const std::string& name) {
  Edges edges;
  for (Index t = 0; t < to_index(surface.triangles.size()); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = surface.triangles[at(t)][i], b = surface.triangles[at(t)][(i + 1) % 3];
      auto& sides = edges[std::minmax(a, b)];
      sides.push_back({t, a < b});
      if (sides.size() > 2)
        throw InputError(fmt::format("{}: the triangles {}, {} and {} share an edge; a surface has two at most", name,
                                     surface.numbers[at(sides[0].triangle)], surface.numbers[at(sides[1].triangle)],
                                     surface.numbers[at(t)]));
    }
  return edges;
}

/// A neighbour across an edge, and whether it lies the other way round.
struct Neighbour {
  Index triangle;
  bool flipped;
};

std::vector<std::vector<Neighbour>> neighbours_of(const Edges& edges, std::size_t num_triangles) {
  std::vector<std::vector<Neighbour>> neighbours(num_triangles);
  for (const auto& [edge, sides] : edges) {
    if (sides.size() < 2) continue;
    const bool flipped = sides[0].ascending == sides[1].ascending;
    neighbours[at(sides[0].triangle)].push_back({sides[1].triangle, flipped});
    neighbours[at(sides[1].triangle)].push_back({sides[0].triangle, flipped});
  }
  return neighbours;
}

// Turns triangles so that neighbours agree; the first of each part stays as it is, if the most of it agree with it.
void orient(Numbered& surface, const std::string& name) {
  const auto neighbours = neighbours_of(edges_of(surface, name), surface.triangles.size());
  enum class Side : std::uint8_t { Unknown, Kept, Turned };
  std::vector<Side> side(surface.triangles.size(), Side::Unknown);
  for (Index seed = 0; seed < to_index(side.size()); ++seed) {
    if (side[at(seed)] != Side::Unknown) continue;
    std::vector<Index> part{seed};
    side[at(seed)] = Side::Kept;
    std::ptrdiff_t num_turned = 0;
    for (std::size_t next = 0; next < part.size(); ++next)
      for (const Neighbour& neighbour : neighbours[at(part[next])]) {
        const bool turned = (side[at(part[next])] == Side::Turned) != neighbour.flipped;
        Side& there = side[at(neighbour.triangle)];
        if (there == Side::Unknown) {
          there = turned ? Side::Turned : Side::Kept;
          num_turned += turned ? 1 : 0;
          part.push_back(neighbour.triangle);
        } else if ((there == Side::Turned) != turned) {
          throw InputError(fmt::format("{}: the surface has one side only (a Moebius strip) at triangle {}", name,
                                       surface.numbers[at(neighbour.triangle)]));
        }
      }
    const Side wrong = 2 * num_turned > std::ssize(part) ? Side::Kept : Side::Turned;
    for (const Index t : part)
      if (side[at(t)] == wrong) std::swap(surface.triangles[at(t)][1], surface.triangles[at(t)][2]);
  }
}

// Triangle fans that meet in one vertex only are given a vertex each: CGAL's meshes know no other.
void separate_fans(Numbered& surface) {
  std::vector<std::vector<Index>> at_vertex(surface.vertices.size());
  for (Index t = 0; t < to_index(surface.triangles.size()); ++t)
    for (const Index vertex : surface.triangles[at(t)]) at_vertex[at(vertex)].push_back(t);
  for (Index vertex = 0; vertex < to_index(at_vertex.size()); ++vertex) {
    std::vector<Index> rest = at_vertex[at(vertex)];
    for (bool first = true; !rest.empty(); first = false) {
      std::vector<Index> fan{rest.front()};
      rest.erase(rest.begin());
      for (std::size_t next = 0; next < fan.size(); ++next)
        for (auto other = rest.begin(); other != rest.end();) {
          const auto& a = surface.triangles[at(fan[next])];
          const auto shared = std::count_if(a.begin(), a.end(), [&](Index v) {
            const auto& b = surface.triangles[at(*other)];
            return std::find(b.begin(), b.end(), v) != b.end();
          });
          if (shared < 2) {
            ++other;
            continue;
          }
          fan.push_back(*other);
          other = rest.erase(other);
        }
      if (first) continue;
      surface.vertices.push_back(surface.vertices[at(vertex)]);
      for (const Index t : fan)
        std::replace(surface.triangles[at(t)].begin(), surface.triangles[at(t)].end(), vertex,
                     to_index(surface.vertices.size()) - 1);
    }
  }
}

Mesh cgal_mesh(const Numbered& surface, const std::string& name) {
  Mesh mesh;
  for (const Vec3& x : surface.vertices) mesh.add_vertex({x.x(), x.y(), x.z()});
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& corners = surface.triangles[t];
    const auto vertex = [&](std::size_t i) { return Mesh::Vertex_index(static_cast<unsigned>(corners[i])); };
    if (CGAL::collinear(mesh.point(vertex(0)), mesh.point(vertex(1)), mesh.point(vertex(2))))
      throw InputError(fmt::format("{}: the corners of triangle {} lie on one line", name, surface.numbers[t]));
    if (mesh.add_face(vertex(0), vertex(1), vertex(2)) == Mesh::null_face())
      throw InputError(fmt::format("{}: triangle {} does not fit its neighbours", name, surface.numbers[t]));
  }
  return mesh;
}

// Whether two triangles that touch in one corner, which is not the same vertex of the mesh, meet nowhere else.
bool touch_in_a_corner_only(const Numbered& surface, std::size_t first, std::size_t second) {
  const auto point = [&](std::size_t triangle, std::size_t i) {
    const Vec3& x = surface.vertices[at(surface.triangles[triangle][i % 3])];
    return Kernel::Point_3(x.x(), x.y(), x.z());
  };
  const auto triangle = [&](std::size_t t) { return Kernel::Triangle_3(point(t, 0), point(t, 1), point(t, 2)); };
  const auto opposite = [&](std::size_t t, std::size_t i) {
    return Kernel::Segment_3(point(t, i + 1), point(t, i + 2));
  };
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (point(first, i) == point(second, j))
        return !CGAL::do_intersect(opposite(first, i), triangle(second)) &&
               !CGAL::do_intersect(opposite(second, j), triangle(first));
  return false;
}

void check_intersections(const Mesh& mesh, const Numbered& surface, const std::string& name) {
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
  for (const auto& [a, b] : pairs) {
    const auto first = static_cast<std::size_t>(a), second = static_cast<std::size_t>(b);
    if (touch_in_a_corner_only(surface, first, second)) continue;
    throw InputError(fmt::format("{}: the triangles {} and {} cut each other", name,
                                 std::min(surface.numbers[first], surface.numbers[second]),
                                 std::max(surface.numbers[first], surface.numbers[second])));
  }
}

// Of closed surfaces: outer ones outwards, those of cavities inwards.
void turn_outwards(Mesh& mesh, Numbered& surface) {
  if (!CGAL::is_closed(mesh)) return;
  CGAL::Polygon_mesh_processing::orient_to_bound_a_volume(mesh);
  for (const Mesh::Face_index face : mesh.faces()) {
    std::size_t i = 0;
    for (const Mesh::Vertex_index vertex : mesh.vertices_around_face(mesh.halfedge(face)))
      surface.triangles[static_cast<std::size_t>(face)][i++] = static_cast<Index>(static_cast<unsigned>(vertex));
  }
}

}  // namespace

TriangleSurface repaired_surface(const std::vector<std::array<Vec3, 3>>& triangles, const std::string& name) {
  if (triangles.empty()) throw InputError(fmt::format("{}: the file has no triangles", name));
  Numbered numbered = welded(triangles, same_place * extent_of(triangles, name));
  if (numbered.triangles.empty()) throw InputError(fmt::format("{}: no triangle has any extent", name));
  orient(numbered, name);
  separate_fans(numbered);
  Mesh mesh = cgal_mesh(numbered, name);
  check_intersections(mesh, numbered, name);
  turn_outwards(mesh, numbered);
  TriangleSurface surface;
  surface.vertices = std::move(numbered.vertices);
  surface.triangles = std::move(numbered.triangles);
  complete_surface(surface);
  return surface;
}

}  // namespace knap
