#include "tests/io/broken_ball.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/topology.hpp"

namespace knap {
namespace {

constexpr double radius = 1e-3;  // [m]

/// A cube of n^3 cells of six tets each, mapped to a ball: each shell of the cube becomes a sphere.
TetMesh ball_mesh(Index n) {
  TetMesh mesh;
  const Index m = n + 1;
  for (Index i = 0; i < m * m * m; ++i) {
    const Vec3 cube = 2.0 / n * Vec3(i % m, i / m % m, i / (m * m)) - Vec3::Ones();
    const double shell = cube.cwiseAbs().maxCoeff();
    mesh.vertices.push_back(shell > 0.0 ? Vec3(radius * shell * cube.normalized()) : Vec3::Zero());
  }
  constexpr std::array<std::array<Index, 2>, 6> walks{{{1, 2}, {2, 1}, {0, 2}, {2, 0}, {0, 1}, {1, 0}}};
  const std::array<Index, 3> stride{1, m, m * m};
  for (Index cell = 0; cell < n * n * n; ++cell) {
    const Index base = cell % n + m * (cell / n % n) + m * m * (cell / (n * n));
    for (const auto& [first, second] : walks) {
      const Index a = base + stride[at(3 - first - second)];
      TetCorners tet{base, a, a + stride[at(first)], base + 1 + m + m * m};
      const auto& x = mesh.vertices;
      if (tet_volume(x[at(tet[0])], x[at(tet[1])], x[at(tet[2])], x[at(tet[3])]) < 0.0) std::swap(tet[1], tet[2]);
      mesh.tets.push_back(tet);
    }
  }
  return mesh;
}

/// A number in [0, 1) that looks random.
double noise(Index i) {
  const double x = std::sin(12.9898 * i + 4.1) * 43758.5453;
  return x - std::floor(x);
}

/// The nearest of scattered seeds in the crushed cone over the lower pole, else the wedge around the axis.
Index label_of(const Vec3& x, const std::vector<Vec3>& seeds) {
  const double depth = x.z() / radius + 1.0;  // above the pole
  const double off_axis = std::hypot(x.x(), x.y()) / radius;
  if (off_axis + 0.9 * depth < 0.62) {
    Index nearest = 0;
    for (Index s = 1; s < to_index(seeds.size()); ++s) {
      if ((seeds[at(s)] - x).norm() < (seeds[at(nearest)] - x).norm()) nearest = s;
    }
    return 6 + nearest;
  }
  const double angle = std::atan2(x.y(), x.x()) + 0.25 * std::sin(2.5 * x.z() / radius) + std::numbers::pi;
  return static_cast<Index>(std::floor(angle / (2.0 * std::numbers::pi) * 6.0 + 6.4)) % 6;
}

std::vector<Vec3> seeds_in_cone() {
  std::vector<Vec3> seeds;
  for (Index s = 0; s < 60; ++s) {
    const double angle = 2.0 * std::numbers::pi * noise(3 * s);
    const double r = 0.6 * std::sqrt(noise(3 * s + 1)) * radius;
    seeds.emplace_back(r * std::cos(angle), r * std::sin(angle), (0.6 * noise(3 * s + 2) - 1.0) * radius);
  }
  return seeds;
}

Vec3 centroid(const TetMesh& mesh, const TetCorners& tet) {
  Vec3 sum = Vec3::Zero();
  for (const Index vertex : tet) sum += mesh.vertices[at(vertex)];
  return sum / 4.0;
}

/// Gives each fragment its own copy of the nodes, moved outwards a little.
void part_fragments(const TetMesh& mesh, PictureInput& input) {
  std::vector<Vec3> centre(input.fragment_mass.size(), Vec3::Zero());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Index fragment = input.fragment_of_tet[t];
    const double mass = 2500.0 * tet_volume(mesh, to_index(t));
    input.fragment_mass[at(fragment)] += mass;
    centre[at(fragment)] += mass * centroid(mesh, mesh.tets[t]);
  }
  std::map<std::array<Index, 2>, Index> copies;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Index fragment = input.fragment_of_tet[t];
    const Vec3 shift = 0.035 * centre[at(fragment)] / input.fragment_mass[at(fragment)];
    TetCorners nodes{};
    for (std::size_t k = 0; k < 4; ++k) {
      const Index vertex = mesh.tets[t][k];
      const auto [copy, is_new] = copies.try_emplace({vertex, fragment}, to_index(input.points.size()));
      if (is_new) input.points.push_back(mesh.vertices[at(vertex)] + shift);
      nodes[k] = copy->second;
    }
    input.tets.push_back(nodes);
  }
}

void break_facets(const TetMesh& mesh, PictureInput& input) {
  const Topology topology = make_topology(mesh);
  for (Index f = 0; f < topology.num_facets(); ++f) {
    const auto& tets = topology.facet_tets[at(f)];
    if (input.fragment_of_tet[at(tets[0])] == input.fragment_of_tet[at(tets[1])]) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      std::array<Index, 3> nodes{};
      for (std::size_t k = 0; k < 3; ++k) nodes[k] = input.tets[at(tets[side])][topology.facet_corners[at(f)][k][side]];
      input.broken_facets.push_back(nodes);
      input.damage_of_tet[at(tets[side])] = 1.0;
    }
  }
}

}  // namespace

PictureInput broken_ball(Index n) {
  const TetMesh mesh = ball_mesh(n);
  const std::vector<Vec3> seeds = seeds_in_cone();
  PictureInput input;
  for (const TetCorners& tet : mesh.tets) {
    const Vec3 x = centroid(mesh, tet);
    input.fragment_of_tet.push_back(label_of(x, seeds));
    const double from_pole = (x + Vec3(0.0, 0.0, radius)).norm() / radius;
    input.damage_of_tet.push_back(std::exp(-2.2 * from_pole * from_pole));
  }
  input.fragment_mass.resize(6 + seeds.size(), 0.0);
  part_fragments(mesh, input);
  break_facets(mesh, input);
  input.wall_height = -1.035 * radius;
  input.title = "glass sphere 2 mm, 60 m/s on a rigid wall";
  input.subtitle = "42 fragments, largest 15.9 %, energy balance closed to 0.02 %, t = 31.4 \xC2\xB5s";
  return input;
}

namespace {

TEST(BrokenBall, TetsArePositiveAndFillABall) {
  const PictureInput input = broken_ball(8);
  double total = 0.0;
  for (const auto& [a, b, c, d] : input.tets) {
    const auto& x = input.points;
    EXPECT_GT(tet_volume(x[at(a)], x[at(b)], x[at(c)], x[at(d)]), 0.0);
    total += tet_volume(x[at(a)], x[at(b)], x[at(c)], x[at(d)]);
  }
  EXPECT_NEAR(total, 4.0 / 3.0 * std::numbers::pi * radius * radius * radius, 0.08 * 4.2 * radius * radius * radius);
}

}  // namespace
}  // namespace knap
