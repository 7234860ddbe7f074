#include "analysis/fragments.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "analysis/convex_hull.hpp"
#include "analysis/fragment_size.hpp"
#include "core/csr.hpp"
#include "core/parallel.hpp"
#include "core/tet_mesh.hpp"

namespace knap {
namespace {

/// Sums over the lumped masses of one fragment.
struct Motion {
  double mass = 0.0;
  Vec3 centre = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Mat3 second_moment = Mat3::Zero();     ///< of mass about the centre [kg m2]
  Vec3 angular_momentum = Vec3::Zero();  ///< about the centre [kg m2/s]
};

Index particle_of(const FragmentInput& in, std::span<const Index> tets) {
  return in.particle_of_tet.empty() ? 0 : in.particle_of_tet[at(tets.front())];
}
double density_of(const FragmentInput& in, std::span<const Index> tets) {
  return in.densities[at(particle_of(in, tets))];
}

Motion find_motion(const FragmentInput& in, std::span<const Index> tets) {
  const double density = density_of(in, tets);
  Motion motion;
  for (const Index tet : tets) {
    const double mass = density * in.tet_volume[at(tet)];
    motion.mass += mass;
    for (const Index node : in.tet_nodes[at(tet)]) {
      motion.centre += 0.25 * mass * xyz(in.x[at(node)]);
      motion.velocity += 0.25 * mass * xyz(in.v[at(node)]);
    }
  }
  motion.centre /= motion.mass;
  motion.velocity /= motion.mass;
  for (const Index tet : tets) {
    const double mass = 0.25 * density * in.tet_volume[at(tet)];
    for (const Index node : in.tet_nodes[at(tet)]) {
      const Vec3 arm = xyz(in.x[at(node)]) - motion.centre;
      const Vec3 relative = xyz(in.v[at(node)]) - motion.velocity;
      motion.second_moment += mass * arm * arm.transpose();
      motion.angular_momentum += mass * arm.cross(relative);
    }
  }
  return motion;
}

/// The least spin [rad/s] with I w = L: directions about which a degenerate piece has no inertia get none.
Vec3 find_spin(const Motion& motion) {
  const Mat3 inertia = motion.second_moment.trace() * Mat3::Identity() - motion.second_moment;
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(inertia);
  const double floor = 1e-10 * eigen.eigenvalues()[2];
  Vec3 spin = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = eigen.eigenvectors().col(i);
    if (eigen.eigenvalues()[i] > floor) spin += axis * (axis.dot(motion.angular_momentum) / eigen.eigenvalues()[i]);
  }
  return spin;
}

/// Second moment of mass [kg m2] of the solid tets about `centre`: unlike that of the lumped masses it is a property of
/// the shape alone, not of how it is meshed.
Mat3 solid_moment(const FragmentInput& in, std::span<const Index> tets, const Vec3& centre) {
  const double density = density_of(in, tets);
  Mat3 moment = Mat3::Zero();
  for (const Index tet : tets) {
    Mat3 squares = Mat3::Zero();
    Vec3 sum = Vec3::Zero();
    for (const Index node : in.tet_nodes[at(tet)]) {
      const Vec3 arm = xyz(in.x[at(node)]) - centre;
      squares += arm * arm.transpose();
      sum += arm;
    }
    moment += density * in.tet_volume[at(tet)] / 20.0 * (squares + sum * sum.transpose());
  }
  return moment;
}

/// Principal axes as columns. The small tilt towards x, y, z gives a body without preferred axes (cube, sphere) these,
/// instead of axes made of round-off.
Mat3 principal_axes(Mat3 moment) {
  moment.diagonal() += 1e-8 * moment.trace() * Vec3(2.0, 1.0, 0.0);
  return Eigen::SelfAdjointEigenSolver<Mat3>(moment).eigenvectors();
}

struct Surface {
  double area = 0.0;         ///< [m2]
  std::vector<Vec3> points;  ///< each node once [m]
};

/// A facet is surface when no tet of the same fragment lies behind it.
bool is_surface(const FragmentInput& in, Index tet, std::size_t corner) {
  const Index facet = in.tet_facets[at(tet)][corner];
  if (facet == none) return true;
  const auto& sides = in.facet_tets[at(facet)];
  return in.label[at(sides[0])] != in.label[at(sides[1])];
}

Surface find_surface(const FragmentInput& in, std::span<const Index> tets) {
  Surface surface;
  std::vector<Index> nodes;
  for (const Index tet : tets) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
      if (!is_surface(in, tet, corner)) continue;
      std::array<Index, 3> face;
      for (std::size_t k = 0; k < 3; ++k) face[k] = in.tet_nodes[at(tet)][at(facet_of_corner[corner][k])];
      const Vec3 a = xyz(in.x[at(face[0])]);
      const Vec3 b = xyz(in.x[at(face[1])]);
      const Vec3 c = xyz(in.x[at(face[2])]);
      surface.area += 0.5 * (b - a).cross(c - a).norm();
      nodes.insert(nodes.end(), face.begin(), face.end());
    }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (const Index node : nodes) surface.points.emplace_back(xyz(in.x[at(node)]));
  return surface;
}

double current_volume(const FragmentInput& in, std::span<const Index> tets) {
  double volume = 0.0;
  for (const Index tet : tets) {
    const TetCorners& n = in.tet_nodes[at(tet)];
    volume += tet_volume(xyz(in.x[at(n[0])]), xyz(in.x[at(n[1])]), xyz(in.x[at(n[2])]), xyz(in.x[at(n[3])]));
  }
  return std::max(volume, 0.0);
}

double ratio(double part, double whole, double if_empty) { return whole > 0.0 ? part / whole : if_empty; }

Fragment make_fragment(const FragmentInput& in, Index id, std::span<const Index> tets) {
  const Motion motion = find_motion(in, tets);
  Fragment fragment;
  fragment.id = id;
  fragment.particle = particle_of(in, tets);
  fragment.num_tets = to_index(tets.size());
  fragment.mass = motion.mass;
  fragment.volume = motion.mass / density_of(in, tets);
  fragment.centre = motion.centre;
  fragment.velocity = motion.velocity;
  fragment.spin = find_spin(motion);

  const Surface surface = find_surface(in, tets);
  const ConvexHull hull = convex_hull(surface.points);
  const Mat3 axes = principal_axes(solid_moment(in, tets, motion.centre));
  const double volume = current_volume(in, tets);
  fragment.sizes = extents(hull.points, axes);
  std::sort(fragment.sizes.data(), fragment.sizes.data() + 3, std::greater<>());
  fragment.sieve_size = sieve_size(hull.points, axes);
  fragment.surface = surface.area;
  const double sphere = std::cbrt(std::numbers::pi) * std::pow(6.0 * volume, 2.0 / 3.0);  // Wadell 1932
  fragment.sphericity = ratio(sphere, surface.area, 0.0);
  fragment.elongation = ratio(fragment.sizes[1], fragment.sizes[0], 1.0);
  fragment.flatness = ratio(fragment.sizes[2], fragment.sizes[1], 1.0);
  fragment.convexity = std::min(1.0, ratio(volume, hull.volume, 1.0));
  return fragment;
}

}  // namespace

std::vector<Index> labels_by_size(std::span<const Index> label, std::span<const double> tet_volume) {
  assert(label.size() == tet_volume.size());
  if (label.empty()) return {};
  const Index num_labels = *std::max_element(label.begin(), label.end()) + 1;
  std::vector<double> volume(at(num_labels), 0.0);
  std::vector<Index> lowest_tet(at(num_labels), to_index(label.size()));
  for (Index tet = to_index(label.size()); tet-- > 0;) {
    volume[at(label[at(tet)])] += tet_volume[at(tet)];
    lowest_tet[at(label[at(tet)])] = tet;
  }
  std::vector<Index> order(at(num_labels));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    if (volume[at(a)] != volume[at(b)]) return volume[at(a)] > volume[at(b)];
    return lowest_tet[at(a)] < lowest_tet[at(b)];
  });
  std::vector<Index> rank(at(num_labels));
  for (Index i = 0; i < num_labels; ++i) rank[at(order[at(i)])] = i;
  std::vector<Index> renamed(label.size());
  std::transform(label.begin(), label.end(), renamed.begin(), [&](Index l) { return rank[at(l)]; });
  return renamed;
}

std::vector<Fragment> find_fragments(const FragmentInput& input) {
  assert(!input.densities.empty() && input.tet_nodes.size() == input.label.size());
  if (input.label.empty()) return {};
  const std::vector<Index> label = labels_by_size(input.label, input.tet_volume);
  const Index count = *std::max_element(label.begin(), label.end()) + 1;
  const Csr tets_of_fragment = make_csr(count, label);
  std::vector<Fragment> fragments(at(count));
  parallel_for(
      count, [&](Index id) { fragments[at(id)] = make_fragment(input, id, tets_of_fragment[id]); }, 16);
  return fragments;
}

}  // namespace knap
