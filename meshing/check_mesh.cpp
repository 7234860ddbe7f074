// Each check assumes that those before it passed.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "core/errors.hpp"
#include "meshing/mesh_quality.hpp"

namespace knap {
namespace {

constexpr double smallest_extent = 1e-6;  // [m]
constexpr double largest_extent = 10.0;   // [m]
constexpr double flat_shape = 1e-6;       // a shape quality that round-off alone can give

using Problem = std::optional<std::string>;

std::string described(const TetMesh& mesh, Index tet) {
  return fmt::format("tet {} (vertices {})", tet, fmt::join(mesh.tets[at(tet)], " "));
}

Problem empty(const TetMesh& mesh) {
  if (mesh.tets.empty()) return "it has no tets";
  constexpr std::size_t most = 1u << 29;  // corners are numbered 4 * tet + local index
  if (mesh.tets.size() >= most || mesh.vertices.size() >= most)
    return fmt::format("{} tets are too many, fewer than {} are supported", mesh.tets.size(), most);
  return {};
}

Problem wrong_vertices(const TetMesh& mesh) {
  for (Index t = 0; t < mesh.num_tets(); ++t) {
    TetCorners corners = mesh.tets[at(t)];
    for (const Index v : corners) {
      if (v < 0 || v >= mesh.num_vertices())
        return fmt::format("{} has a vertex that does not exist (there are {})", described(mesh, t),
                           mesh.num_vertices());
      const Vec3& x = mesh.vertices[at(v)];
      if (!x.allFinite())
        return fmt::format("vertex {} of {} is not finite: ({}, {}, {})", v, described(mesh, t), x.x(), x.y(), x.z());
    }
    std::sort(corners.begin(), corners.end());
    if (std::adjacent_find(corners.begin(), corners.end()) != corners.end())
      return fmt::format("{} has the same vertex twice", described(mesh, t));
  }
  return {};
}

Problem absurd_size(const TetMesh& mesh) {
  const double extent = bounding_box(mesh).largest_extent();
  if (extent >= smallest_extent && extent <= largest_extent) return {};
  return fmt::format(
      "it is {:g} m long, allowed is {:g} m to {:g} m: check mesh_scale, the metres in one unit of the file", extent,
      smallest_extent, largest_extent);
}

Problem coinciding_vertices(const TetMesh& mesh) {
  std::vector<Index> used;
  for (const TetCorners& tet : mesh.tets) used.insert(used.end(), tet.begin(), tet.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  const auto place = [&](Index v) {
    const Vec3& x = mesh.vertices[at(v)];
    return std::tuple(x.x(), x.y(), x.z());
  };
  std::stable_sort(used.begin(), used.end(), [&](Index a, Index b) { return place(a) < place(b); });
  const auto twin = [&](Index a, Index b) { return place(a) == place(b); };
  const auto pair = std::adjacent_find(used.begin(), used.end(), twin);
  if (pair == used.end()) return {};
  const Vec3& x = mesh.vertices[at(*pair)];
  return fmt::format(
      "vertices {} and {} are both at ({:g}, {:g}, {:g}) m: merge coinciding nodes, the mesh must be uncracked",
      pair[0], pair[1], x.x(), x.y(), x.z());
}

Problem flat_or_inverted_tets(const TetMesh& mesh) {
  Index count = 0;
  std::string first;
  for (Index t = 0; t < mesh.num_tets(); ++t) {
    const double shape = shape_quality(mesh, t);
    if (shape > flat_shape) continue;  // also false for not-a-number
    if (++count == 1)
      first = fmt::format("{} is {}: volume {:g} m3, shape quality {:g}", described(mesh, t),
                          shape < -flat_shape ? "inverted" : "flat", tet_volume(mesh, t), shape);
  }
  if (count == 0) return {};
  return count == 1 ? first : fmt::format("{} ({} such tets in all)", first, count);
}

Problem duplicated_tets(const TetMesh& mesh) {
  std::vector<std::pair<TetCorners, Index>> sorted;
  sorted.reserve(mesh.tets.size());
  for (Index t = 0; t < mesh.num_tets(); ++t) {
    sorted.emplace_back(mesh.tets[at(t)], t);
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  const auto pair =
      std::adjacent_find(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first == b.first; });
  if (pair == sorted.end()) return {};
  return fmt::format("{} and tet {} are the same", described(mesh, pair[0].second), pair[1].second);
}

// A facet as seen from one of its tets.
struct Facet {
  std::array<Index, 3> vertices;  // ascending
  bool even;                      // the outward order is an even permutation of the ascending one
  Index tet;
};

std::vector<Facet> sorted_facets(const TetMesh& mesh) {
  std::vector<Facet> facets;
  facets.reserve(4 * mesh.tets.size());
  for (Index t = 0; t < mesh.num_tets(); ++t)
    for (const auto& local : facet_of_corner) {
      const TetCorners& tet = mesh.tets[at(t)];
      Facet facet{{tet[at(local[0])], tet[at(local[1])], tet[at(local[2])]}, true, t};
      auto& v = facet.vertices;
      const auto order = [&](Index& a, Index& b) {
        if (a > b) std::swap(a, b), facet.even = !facet.even;
      };
      order(v[0], v[1]), order(v[1], v[2]), order(v[0], v[1]);
      facets.push_back(facet);
    }
  std::sort(facets.begin(), facets.end(),
            [](const Facet& a, const Facet& b) { return std::tie(a.vertices, a.tet) < std::tie(b.vertices, b.tet); });
  return facets;
}

Problem badly_shared_facets(const TetMesh& mesh, const std::vector<Facet>& facets) {
  const auto same = [&](std::size_t i, std::size_t j) {
    return j < facets.size() && facets[i].vertices == facets[j].vertices;
  };
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (!same(i, i + 1)) continue;
    const std::string facet = fmt::format("the facet with vertices {}", fmt::join(facets[i].vertices, " "));
    if (same(i, i + 2))
      return fmt::format("{} is shared by more than two tets: {}, {}, {}", facet, facets[i].tet, facets[i + 1].tet,
                         facets[i + 2].tet);
    if (facets[i].even == facets[i + 1].even)
      return fmt::format("{} and tet {} lie on the same side of {}: they overlap", described(mesh, facets[i].tet),
                         facets[i + 1].tet, facet);
  }
  return {};
}

Index root_of(std::vector<Index>& parent, Index i) {
  while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
  return i;
}

Problem unconnected_parts(const TetMesh& mesh, const std::vector<Facet>& facets) {
  std::vector<Index> parent(mesh.tets.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 0; i + 1 < facets.size(); ++i)
    if (facets[i].vertices == facets[i + 1].vertices) {
      const Index a = root_of(parent, facets[i].tet), b = root_of(parent, facets[i + 1].tet);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  std::vector<Index> size(mesh.tets.size(), 0);  // of the part whose lowest tet this is
  for (Index t = 0; t < mesh.num_tets(); ++t) ++size[at(root_of(parent, t))];
  const auto parts = std::count_if(size.begin(), size.end(), [](Index n) { return n > 0; });
  if (parts == 1) return {};
  const auto second = std::find_if(size.begin() + 1, size.end(), [](Index n) { return n > 0; });
  return fmt::format(
      "it has {} parts that share no facet: {} tets with tet 0, {} tets with tet {}; a particle is one piece", parts,
      size[0], *second, second - size.begin());
}

Problem first_problem(const TetMesh& mesh) {
  for (const auto check :
       {empty, wrong_vertices, absurd_size, coinciding_vertices, flat_or_inverted_tets, duplicated_tets})
    if (Problem problem = check(mesh)) return problem;
  const std::vector<Facet> facets = sorted_facets(mesh);
  if (Problem problem = badly_shared_facets(mesh, facets)) return problem;
  return unconnected_parts(mesh, facets);
}

}  // namespace

void check_mesh(const TetMesh& mesh, std::string_view source) {
  if (const Problem problem = first_problem(mesh))
    throw InputError(fmt::format("{}: {} (tets and vertices count from 0)", source, *problem));
}

}  // namespace knap
