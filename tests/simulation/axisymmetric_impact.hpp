#pragma once
// A second solution of the elastic impact that shares nothing with the program but the law of the material: triangles
// of the half disc in cylindrical coordinates, explicit, one exact wall. Lengths in R, densities in rho, stresses in
// E*. So cheap that the contact can have any number of elements: 12 leave it 0.2 % from its limit.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace knap {

/// Peak force and duration over Hertz's for the mass of the mesh, and final over initial speed.
struct ImpactOverHertz {
  double force = 0.0;
  double duration = 0.0;
  double restitution = 0.0;
};

struct AxisymmetricImpact {
  double group = 0.0;          ///< rho v^2 / E*
  double poisson_ratio = 0.0;  ///< [-]
  int elements = 12;           ///< of the contact radius
  bool small_strain = false;   ///< Hooke's law instead of the neo-Hookean one
};

class AxisymmetricSphere {
 public:
  explicit AxisymmetricSphere(const AxisymmetricImpact& impact)
      : impact_(impact), contact_radius_(std::pow(1.25 * std::numbers::pi * impact.group, 0.2)) {
    make_mesh();
    prepare_triangles();
  }

  ImpactOverHertz run() {
    const double speed = std::sqrt(impact_.group);
    const double approach = std::pow(15.0 * mass_ * impact_.group / 16.0, 0.4);
    const double duration = 2.9433 * approach / speed;
    for (Node& node : nodes_) node.v = {0.0, -speed};
    const double window = duration / 200.0;
    double impulse = 0.0, impulse_before = 0.0, window_start = 0.0, largest = 0.0, first = -1.0, last = 0.0;
    for (double time = 0.0; time < 1.25 * duration; time += dt_) {
      if (time - window_start >= window) {
        largest = std::max(largest, (impulse - impulse_before) / (time - window_start));
        impulse_before = impulse, window_start = time;
      }
      add_forces();
      const double push = move();
      impulse += push;
      if (push > 0.0 && first < 0.0) first = time;
      if (push > 0.0) last = time;
    }
    return {largest / (4.0 / 3.0 * std::pow(approach, 1.5)), (last - first) / duration,
            impulse / (mass_ * speed) - 1.0};
  }

 private:
  using Pair = std::array<double, 2>;  // radial, axial
  struct Node {
    Pair x{}, u{}, v{}, f{};
    double mass = 0.0;
    bool on_surface = false;
  };
  struct Triangle {
    std::array<std::size_t, 3> nodes{};
    Pair gradient[3]{};
    double hoop = 0.0;  // strain per radial displacement of a node
    double volume = 0.0;
  };

  // Rows of nodes on circles about the pole, joined by triangles; the size grows linearly away from the contact.
  void make_mesh() {
    const double n = impact_.elements, fine = contact_radius_ / n;
    std::size_t before = 0, count_before = 1;
    nodes_.push_back({.x = {0.0, -1.0}, .on_surface = true});
    for (double s = fine; count_before > 0;) {
      const double size = std::min(0.75 / n, std::max(fine, fine + 1.25 / n * (s - 1.5 * contact_radius_)));
      const bool end = s > 2.0 - 0.3 * size;
      const double widest = end ? 0.0 : std::acos(0.5 * s);
      const std::size_t segments = end ? 0 : std::max<std::size_t>(1, std::lround(s * widest / size));
      const std::size_t row = nodes_.size();
      for (std::size_t i = 0; i <= segments; ++i) {
        const double angle = end ? 0.0 : widest * static_cast<double>(i) / static_cast<double>(segments);
        const double r = end ? 2.0 : s;
        nodes_.push_back({.x = {r * std::sin(angle), r * std::cos(angle) - 1.0}, .on_surface = i == segments});
      }
      join_rows(before, count_before, row, segments + 1);
      before = row, count_before = end ? 0 : segments + 1;
      s += size * std::max(0.35, std::sqrt(1.0 - 0.25 * std::min(s * s, 4.0)));
    }
  }

  void join_rows(std::size_t a, std::size_t count_a, std::size_t b, std::size_t count_b) {
    std::size_t i = 0, j = 0;
    while (i + 1 < count_a || j + 1 < count_b) {
      const bool along_a =
          j + 1 == count_b || (i + 1 < count_a && (2 * i + 1) * (count_b - 1) < (2 * j + 1) * (count_a - 1));
      if (along_a) {
        triangles_.push_back({.nodes = {a + i, a + i + 1, b + j}});
        ++i;
      } else {
        triangles_.push_back({.nodes = {a + i, b + j + 1, b + j}});
        ++j;
      }
    }
  }

  void prepare_triangles() {
    const double nu = impact_.poisson_ratio, young = 1.0 - nu * nu;
    shear_ = 0.5 * young / (1.0 + nu);
    lambda_ = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
    std::vector<double> stiffness(nodes_.size(), 0.0);
    for (Triangle& t : triangles_) {
      const Pair &a = nodes_[t.nodes[0]].x, &b = nodes_[t.nodes[1]].x, &c = nodes_[t.nodes[2]].x;
      const double twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      const double sum_r = a[0] + b[0] + c[0];
      t.volume = std::numbers::pi * twice_area * sum_r / 3.0;
      t.hoop = 1.0 / sum_r;
      double norm = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Pair &p = nodes_[t.nodes[(k + 1) % 3]].x, &q = nodes_[t.nodes[(k + 2) % 3]].x;
        t.gradient[k] = {(p[1] - q[1]) / twice_area, (q[0] - p[0]) / twice_area};
        norm += t.gradient[k][0] * t.gradient[k][0] + t.gradient[k][1] * t.gradient[k][1] + t.hoop * t.hoop;
      }
      for (const std::size_t i : t.nodes) {
        nodes_[i].mass += std::numbers::pi * twice_area * (sum_r + nodes_[i].x[0]) / 12.0;
        stiffness[i] += t.volume * (lambda_ + 2.0 * shear_) * norm;
      }
    }
    double fastest = 0.0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      fastest = std::max(fastest, stiffness[i] / nodes_[i].mass);
      mass_ += nodes_[i].mass;
    }
    dt_ = 1.4 / std::sqrt(fastest);
  }

  // First Piola-Kirchhoff stress {rr, rz, zr, zz, hoop} of the displacement gradient {rr, rz, zr, zz, hoop}.
  std::array<double, 5> stress(const std::array<double, 5>& g) const {
    const double mu = shear_;
    if (impact_.small_strain) {
      const double mean = lambda_ * (g[0] + g[3] + g[4]), shear = mu * (g[1] + g[2]);
      return {mean + 2.0 * mu * g[0], shear, shear, mean + 2.0 * mu * g[3], mean + 2.0 * mu * g[4]};
    }
    const double rr = 1.0 + g[0], zz = 1.0 + g[3], hoop = 1.0 + g[4], plane = rr * zz - g[1] * g[2];
    const double slope = (lambda_ + mu) * (plane * hoop - 1.0) - mu;
    return {mu * rr + slope * zz * hoop, mu * g[1] - slope * g[2] * hoop, mu * g[2] - slope * g[1] * hoop,
            mu * zz + slope * rr * hoop, mu * hoop + slope * plane};
  }

  void add_forces() {
    for (Node& node : nodes_) node.f = {};
    for (const Triangle& t : triangles_) {
      std::array<double, 5> g{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Pair& u = nodes_[t.nodes[k]].u;
        const auto [along_r, along_z] = t.gradient[k];
        g = {g[0] + along_r * u[0], g[1] + along_z * u[0], g[2] + along_r * u[1], g[3] + along_z * u[1],
             g[4] + t.hoop * u[0]};
      }
      const auto p = stress(g);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [along_r, along_z] = t.gradient[k];
        Pair& f = nodes_[t.nodes[k]].f;
        f[0] -= t.volume * (p[0] * along_r + p[1] * along_z + p[4] * t.hoop);
        f[1] -= t.volume * (p[2] * along_r + p[3] * along_z);
      }
    }
  }

  // One step of every node; the impulse of the wall.
  double move() {
    double push = 0.0;
    for (Node& node : nodes_) {
      for (std::size_t k = 0; k < 2; ++k) node.v[k] += dt_ / node.mass * node.f[k];
      if (node.x[0] == 0.0) node.v[0] = 0.0;
      const double gap = 1.0 + node.x[1] + node.u[1] + dt_ * node.v[1];
      if (node.on_surface && gap < 0.0) {
        push -= node.mass * gap / dt_;
        node.v[1] -= gap / dt_;
      }
      for (std::size_t k = 0; k < 2; ++k) node.u[k] += dt_ * node.v[k];
    }
    return push;
  }

  AxisymmetricImpact impact_;
  double contact_radius_;
  double shear_ = 0.0, lambda_ = 0.0, dt_ = 0.0, mass_ = 0.0;
  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
};

}  // namespace knap
