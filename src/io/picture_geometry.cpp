#include "io/picture_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/tet_mesh.hpp"

namespace knap {
namespace {

constexpr double main_share = 0.98;

using Triangle = std::array<Index, 3>;

Triangle sorted(Triangle triangle) {
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

std::array<Index, 2> edge(const Triangle& triangle, std::size_t k) {
  const Index a = triangle[k];
  const Index b = triangle[(k + 1) % 3];
  return {std::min(a, b), std::max(a, b)};
}

struct TetFacet {
  Triangle key;  ///< nodes in ascending order
  Triangle nodes;
  Index tet;
};

std::vector<TetFacet> sorted_facets(const PictureInput& input) {
  std::vector<TetFacet> facets;
  facets.reserve(4 * input.tets.size());
  for (Index t = 0; t < to_index(input.tets.size()); ++t) {
    const TetCorners& tet = input.tets[at(t)];
    for (const auto& corners : facet_of_corner) {
      const Triangle nodes{tet[at(corners[0])], tet[at(corners[1])], tet[at(corners[2])]};
      facets.push_back({sorted(nodes), nodes, t});
    }
  }
  std::sort(facets.begin(), facets.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
  return facets;
}

void find_surface(const PictureInput& input, PictureGeometry& geometry) {
  std::vector<Triangle> broken;
  for (const Triangle& facet : input.broken_facets) broken.push_back(sorted(facet));
  std::sort(broken.begin(), broken.end());
  const std::vector<TetFacet> facets = sorted_facets(input);
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (i + 1 < facets.size() && facets[i].key == facets[i + 1].key) {
      ++i;  // shared by two tets: inside
      continue;
    }
    geometry.surface.push_back(facets[i].nodes);
    geometry.tet_of_surface.push_back(facets[i].tet);
    geometry.is_crack_face.push_back(std::binary_search(broken.begin(), broken.end(), facets[i].key));
  }
}

void find_crack_lines(PictureGeometry& geometry) {
  std::set<std::array<Index, 2>> crack_edges;
  std::set<std::array<Index, 2>> lines;
  for (std::size_t i = 0; i < geometry.surface.size(); ++i) {
    if (!geometry.is_crack_face[i]) continue;
    for (std::size_t k = 0; k < 3; ++k) crack_edges.insert(edge(geometry.surface[i], k));
  }
  for (std::size_t i = 0; i < geometry.surface.size(); ++i) {
    if (geometry.is_crack_face[i]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      if (crack_edges.contains(edge(geometry.surface[i], k))) lines.insert(edge(geometry.surface[i], k));
    }
  }
  geometry.crack_lines.assign(lines.begin(), lines.end());
}

void rank_fragments(const PictureInput& input, PictureGeometry& geometry) {
  const std::vector<double>& mass = input.fragment_mass;
  const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
  std::vector<Index> order(mass.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return mass[at(a)] > mass[at(b)]; });
  geometry.fragment_rank.assign(mass.size(), none);
  double heavier = 0.0;
  for (Index rank = 0; rank < to_index(order.size()); ++rank) {
    const Index fragment = order[at(rank)];
    const bool is_main = rank == 0 || heavier < main_share * total;
    heavier += mass[at(fragment)];
    // The heaviest is never dust, so that there is something to look at.
    if (rank > 0 && mass[at(fragment)] < input.dust_share * total) break;
    geometry.fragment_rank[at(fragment)] = rank;
    if (is_main) geometry.num_main = rank + 1;
  }
}

void find_centres(const PictureInput& input, PictureGeometry& geometry) {
  std::vector<double> volume(input.fragment_mass.size(), 0.0);
  geometry.fragment_centre.assign(input.fragment_mass.size(), Vec3::Zero());
  for (std::size_t t = 0; t < input.tets.size(); ++t) {
    const auto& [a, b, c, d] = input.tets[t];
    const std::vector<Vec3>& x = input.points;
    const double tet = std::abs(tet_volume(x[at(a)], x[at(b)], x[at(c)], x[at(d)]));
    volume[at(input.fragment_of_tet[t])] += tet;
    geometry.fragment_centre[at(input.fragment_of_tet[t])] += tet / 4 * (x[at(a)] + x[at(b)] + x[at(c)] + x[at(d)]);
  }
  double total = 0.0;
  for (std::size_t f = 0; f < volume.size(); ++f) {
    if (geometry.fragment_rank[f] != none) {
      geometry.centre += geometry.fragment_centre[f];
      total += volume[f];
    }
    if (volume[f] > 0.0) geometry.fragment_centre[f] /= volume[f];
  }
  if (total > 0.0) geometry.centre /= total;
}

}  // namespace

PictureGeometry make_picture_geometry(const PictureInput& input) {
  PictureGeometry geometry;
  find_surface(input, geometry);
  find_crack_lines(geometry);
  rank_fragments(input, geometry);
  find_centres(input, geometry);
  return geometry;
}

std::vector<Vec3> exploded_points(const PictureInput& input, const PictureGeometry& geometry, double factor) {
  std::vector<Vec3> points = input.points;
  for (std::size_t t = 0; t < input.tets.size(); ++t) {
    const Vec3& centre = geometry.fragment_centre[at(input.fragment_of_tet[t])];
    for (const Index node : input.tets[t]) {
      points[at(node)] = input.points[at(node)] + factor * (centre - geometry.centre);
    }
  }
  return points;
}

std::vector<Vec3> main_points(const std::vector<Vec3>& points, const PictureInput& input,
                              const PictureGeometry& geometry) {
  std::vector<Vec3> shown;
  for (std::size_t t = 0; t < input.tets.size(); ++t) {
    const Index rank = geometry.fragment_rank[at(input.fragment_of_tet[t])];
    if (rank == none || rank >= geometry.num_main) continue;
    for (const Index node : input.tets[t]) shown.push_back(points[at(node)]);
  }
  return shown;
}

}  // namespace knap
