#include "meshing/tetrahedralise.hpp"

#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <iostream>

#include "core/errors.hpp"
#include "core/hash.hpp"
#include "core/parallel.hpp"
#include "meshing/mesh_quality.hpp"
#include "meshing/reorder.hpp"
#include "meshing/vertex_star.hpp"

namespace knap {
namespace {

constexpr double pi = 3.14159265358979324;
constexpr double degree = pi / 180.0;

std::string hash_of(const TetMesh& mesh) {
  StateHash hash;
  for (const Vec3& x : mesh.vertices) hash.add_bytes(x.data(), sizeof(double) * 3);
  hash.add(mesh.tets);
  return hash.hex();
}

TetrahedraliseOptions graded_options(double h) {
  return {
      .element_size = h, .contact_element_size = h / 3, .contact_extent = 0.3e-3, .contact_points = {{0, 0, -1e-3}}};
}

// Mean edge of the tets whose centroid is between two distances from a point.
double mean_edge_between(const TetMesh& mesh, const Vec3& centre, double nearest, double farthest) {
  TetMesh part{mesh.vertices, {}};
  for (const auto& [a, b, c, d] : mesh.tets) {
    const auto& v = mesh.vertices;
    const double distance = (0.25 * (v[at(a)] + v[at(b)] + v[at(c)] + v[at(d)]) - centre).norm();
    if (distance >= nearest && distance <= farthest) part.tets.push_back({a, b, c, d});
  }
  return mean_edge(part);
}

struct Case {
  const char* name;
  Shape shape;
};

class EveryShape : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Tetrahedralise, EveryShape,
                         testing::Values(Case{"sphere", Sphere{2e-3}}, Case{"prolate", Ellipsoid{{1e-3, 1e-3, 2e-3}}},
                                         Case{"oblate", Ellipsoid{{2e-3, 2e-3, 1e-3}}},
                                         Case{"triaxial", Ellipsoid{{2e-3, 1.5e-3, 1e-3}}},
                                         Case{"box", Box{{2e-3, 1.5e-3, 1e-3}}}),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(EveryShape, MeshIsValidAndOfTheVolumeSizeAndNumberAskedFor) {
  const Shape& shape = GetParam().shape;
  for (const std::int64_t seed : {0, 1, 2}) {
    const TetrahedraliseOptions options{.element_size = 0.15e-3, .seed = seed};
    const TetMesh mesh = tetrahedralise(shape, options);
    EXPECT_NO_THROW(check_mesh(mesh));
    const MeshQuality quality = measure_quality(mesh);
    EXPECT_GT(quality.min_shape, 0.3);
    EXPECT_GT(quality.min_dihedral, 14.0 * degree);
    EXPECT_GT(quality.mean_shape, 0.75);
    EXPECT_NEAR(quality.mean_edge, options.element_size, 0.04 * options.element_size);
    EXPECT_NEAR(quality.num_tets, expected_num_tets(shape, options), 0.12 * quality.num_tets);
    EXPECT_GT(quality.total_volume, 0.97 * volume(shape));
    EXPECT_LT(quality.total_volume, volume(shape) * (1.0 + 1e-12));
  }
}

TEST_P(EveryShape, SurfaceVerticesLieOnTheShape) {
  const Shape& shape = GetParam().shape;
  const TetMesh mesh = tetrahedralise(shape, {.element_size = 0.25e-3, .seed = 1});
  const std::vector<bool> on_surface = surface_vertices(mesh);
  const Vec3 half = 0.5 * extent(shape);
  for (std::size_t v = 0; v < on_surface.size(); ++v) {
    if (!on_surface[v]) continue;
    const Vec3 x = mesh.vertices[v].cwiseQuotient(half);
    EXPECT_NEAR(std::holds_alternative<Box>(shape) ? x.lpNorm<Eigen::Infinity>() : x.norm(), 1.0, 4e-16);
  }
}

TEST_P(EveryShape, SeedsRepeatToTheBitAndGiveDifferentMeshes) {
  const Shape& shape = GetParam().shape;
  const auto mesh_of = [&](std::int64_t seed) {
    return tetrahedralise(shape, {.element_size = 0.25e-3, .seed = seed});
  };
  std::vector<std::string> hashes;
  for (const std::int64_t seed : {0, 1, 2, 3}) hashes.push_back(hash_of(mesh_of(seed)));
  for (const std::int64_t seed : {3, 1, 0, 2})
    EXPECT_EQ(hash_of(mesh_of(seed)), hashes[static_cast<std::size_t>(seed)]);
  // Truly different: hardly a vertex of one mesh is near one of another.
  const TetMesh a = mesh_of(1), b = mesh_of(2);
  Index close = 0;
  for (const Vec3& x : a.vertices)
    close += std::any_of(b.vertices.begin(), b.vertices.end(), [&](const Vec3& y) { return (x - y).norm() < 0.01e-3; });
  EXPECT_LT(close, a.num_vertices() / 4);
}

TEST(Tetrahedralise, SphereVolumeConvergesFromBelowAsTheSquareOfTheSize) {
  const Sphere sphere{2e-3};
  const auto lost = [&](double h) {
    return 1.0 - volume(tetrahedralise(sphere, {.element_size = h})) / volume(sphere);
  };
  const double coarse = lost(0.24e-3), fine = lost(0.12e-3);
  EXPECT_GT(fine, 0.0);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
  EXPECT_NEAR(fine, 1.37 * 0.06 * 0.06, 0.15 * 1.37 * 0.06 * 0.06);  // the coefficient of the header
}

TEST(Tetrahedralise, GradedMeshHasTheSizesAskedFor) {
  const TetrahedraliseOptions options = graded_options(0.12e-3);
  const TetMesh mesh = tetrahedralise(Sphere{2e-3}, options);
  const MeshQuality quality = measure_quality(mesh);
  EXPECT_GT(quality.min_shape, 0.3);
  EXPECT_NEAR(quality.num_tets, expected_num_tets(Sphere{2e-3}, options), 0.12 * quality.num_tets);
  EXPECT_NEAR(mean_edge_between(mesh, options.contact_points[0], 0.0, 0.3e-3), 0.04e-3, 0.05 * 0.04e-3);
  EXPECT_NEAR(mean_edge_between(mesh, options.contact_points[0], 0.43e-3, 0.47e-3), 0.08e-3, 0.1 * 0.08e-3);
  EXPECT_NEAR(mean_edge_between(mesh, options.contact_points[0], 0.7e-3, 2e-3), 0.12e-3, 0.05 * 0.12e-3);
}

TEST(Tetrahedralise, IsRefinedAtEveryContactPoint) {
  TetrahedraliseOptions options = graded_options(0.18e-3);
  options.contact_points.emplace_back(-options.contact_points[0]);
  const TetMesh mesh = tetrahedralise(Sphere{2e-3}, options);
  const double tets = static_cast<double>(mesh.num_tets());
  EXPECT_NEAR(tets, expected_num_tets(Sphere{2e-3}, options), 0.12 * tets);
  for (const Vec3& point : options.contact_points)
    EXPECT_NEAR(mean_edge_between(mesh, point, 0.0, 0.3e-3), 0.06e-3, 0.05 * 0.06e-3);
  EXPECT_NEAR(mean_edge_between(mesh, Vec3::Zero(), 0.0, 0.3e-3), 0.18e-3, 0.1 * 0.18e-3);
  options.contact_points.clear();
  EXPECT_THROW(tetrahedralise(Sphere{2e-3}, options), InputError);
}

TEST(Tetrahedralise, TheContactStaysWhereItIsWhenTheSeedTurnsTheMesh) {
  TetrahedraliseOptions options = graded_options(0.24e-3);
  for (const std::int64_t seed : {1, 2, 3}) {
    options.seed = seed;
    const TetMesh mesh = tetrahedralise(Sphere{2e-3}, options);
    EXPECT_NEAR(mean_edge_between(mesh, options.contact_points[0], 0.0, 0.3e-3), 0.08e-3, 0.06 * 0.08e-3);
    EXPECT_NEAR(mean_edge_between(mesh, -options.contact_points[0], 0.0, 0.6e-3), 0.24e-3, 0.1 * 0.24e-3);
  }
}

TEST(Tetrahedralise, TheMeshScalesWithTheParticle) {
  const TetMesh small = tetrahedralise(Sphere{2e-6 * 1024}, {.element_size = 0.25e-6 * 1024});
  const TetMesh large = tetrahedralise(Sphere{2e-6 * 2048}, {.element_size = 0.25e-6 * 2048});
  ASSERT_EQ(small.tets, large.tets);
  for (std::size_t v = 0; v < small.vertices.size(); ++v) ASSERT_EQ(2.0 * small.vertices[v], large.vertices[v]);
}

TEST(Tetrahedralise, IsMortonOrdered) {
  const TetMesh mesh = tetrahedralise(Sphere{2e-3}, {.element_size = 0.3e-3});
  EXPECT_EQ(hash_of(morton_ordered(mesh)), hash_of(mesh));
}

TEST(Tetrahedralise, PerturbationMovesVerticesButKeepsQualityAndVolume) {
  const TetrahedraliseOptions regular{.element_size = 0.25e-3};
  TetrahedraliseOptions perturbed = regular;
  perturbed.perturbation = 0.2;
  const TetMesh a = tetrahedralise(Sphere{2e-3}, regular), b = tetrahedralise(Sphere{2e-3}, perturbed);
  EXPECT_NE(hash_of(a), hash_of(b));
  EXPECT_EQ(hash_of(b), hash_of(tetrahedralise(Sphere{2e-3}, perturbed)));
  EXPECT_EQ(a.num_tets(), b.num_tets());
  EXPECT_NEAR(volume(a), volume(b), 1e-12 * volume(a));  // the surface has not moved
  EXPECT_GE(measure_quality(b).min_shape, 0.1);
}

TEST(Tetrahedralise, RefusesOptionsThatMakeNoSense) {
  const auto message = [](const Shape& shape, const TetrahedraliseOptions& options) -> std::string {
    try {
      tetrahedralise(shape, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  using testing::HasSubstr;
  EXPECT_THAT(message(Sphere{2e-3}, {}), HasSubstr("element_size is 0"));
  EXPECT_THAT(message(Sphere{2e-3}, {.element_size = 2e-3}), HasSubstr("element_size is 0.002"));
  EXPECT_THAT(message(Sphere{2e-3}, {.element_size = 1e-7}), HasSubstr("number of tets"));
  EXPECT_THAT(message(Sphere{2e-3}, {.element_size = std::nan("")}), HasSubstr("element_size is nan"));
  EXPECT_THAT(message(Sphere{-1.0}, {.element_size = 1e-4}), HasSubstr("smallest size"));
  EXPECT_THAT(message(Sphere{2e-3}, {.element_size = 1e-4, .contact_element_size = 2e-4}),
              HasSubstr("contact_element_size"));
  EXPECT_THAT(message(Sphere{2e-3}, {.element_size = 1e-4, .contact_extent = -1.0}), HasSubstr("contact_extent"));
  EXPECT_THAT(message(Sphere{2e-3}, {.element_size = 1e-4, .perturbation = 0.5}), HasSubstr("perturbation"));
}

TEST(Tetrahedralise, LeavesOpenMPAndAHostsGmshAsTheyWere) {
  const std::string alone = hash_of(tetrahedralise(Sphere{2e-3}, {.element_size = 0.3e-3}));
  set_num_threads(3);
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("Mesh.Algorithm3D", 10);
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.01);
  gmsh::model::add("mine");
  gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
  gmsh::model::occ::synchronize();
  EXPECT_EQ(hash_of(tetrahedralise(Sphere{2e-3}, {.element_size = 0.3e-3})), alone);
  EXPECT_EQ(num_threads(), 3);
  std::string model;
  gmsh::model::getCurrent(model);
  EXPECT_EQ(model, "mine");
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, 3);
  EXPECT_EQ(entities.size(), 1u);
  double value = 0.0;
  gmsh::option::getNumber("Mesh.Algorithm3D", value);
  EXPECT_EQ(value, 10);
  gmsh::finalize();
  EXPECT_EQ(hash_of(tetrahedralise(Sphere{2e-3}, {.element_size = 0.3e-3})), alone);  // also after that
  set_num_threads(0);
}

constexpr const char* fresh_process = "KNAP_TEST_PRINT_HASHES";

std::string hashes_of_some_meshes() {
  std::string hashes;
  for (const Shape& shape :
       {Shape(Sphere{2e-3}), Shape(Ellipsoid{{2e-3, 1.5e-3, 1e-3}}), Shape(Box{{1e-3, 1e-3, 2e-3}})})
    for (const std::int64_t seed : {0, 5}) {
      TetrahedraliseOptions options = graded_options(0.25e-3);
      options.seed = seed;
      hashes += hash_of(tetrahedralise(shape, options)) + " ";
    }
  return hashes;
}

// Not a test of its own: what the next one runs in a fresh process.
TEST(Tetrahedralise, PrintsHashesWhenAsked) {
  if (std::getenv(fresh_process) != nullptr) std::cout << "hashes: " << hashes_of_some_meshes() << "\n";
}

TEST(Tetrahedralise, AFreshProcessMakesTheSameBits) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe");
  const std::string command =
      std::string(fresh_process) + "=1 '" + program + "' --gtest_filter=Tetrahedralise.PrintsHashesWhenAsked";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  EXPECT_EQ(::pclose(pipe), 0);
  EXPECT_THAT(output, testing::HasSubstr("hashes: " + hashes_of_some_meshes()));
}

}  // namespace
}  // namespace knap
