#include "validation/support/driven_crack.hpp"

#include "simulation/initial_cracks.hpp"
#include "simulation/make_simulation.hpp"

namespace knap {
namespace {

// Two tets on either side of a facet in the plane z = 0.
Simulation cracked_pair(const DrivenCrackOptions& options) {
  TetMesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.3, 0.3, 0.8}, {0.3, 0.3, -0.8}};
  for (Vec3& x : mesh.vertices) x *= 1e-3;  // round-off of positions stays small beside the opening
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  ParticleOptions particle{.young_modulus = 1.0, .poisson_ratio = 0.0, .density = 1e26};
  particle.fracture = FractureOptions{options.law, options.strength, options.fracture_energy};
  Simulation s = make_simulation({.particles = {particle}}, mesh);
  s.clock.dt = 1.0;
  const InitialCrack crack{.facet = 0, .strength = options.strength, .damage = {0.0, 0.0, 0.0}};
  open_initial_cracks(s, std::span(&crack, 1));
  return s;
}

struct Frame {
  Vec3 normal, tangent;
};

// Puts the nodes of the plus side at a jump, with the velocities of the steps before and after.
void place(Simulation& s, const Vec3& jump, const Vec3& before, const Vec3& after) {
  for (const CrackRecord& record : s.cracks.records) {
    s.nodes.x[at(record.node_b)] = s.nodes.x[at(record.node_a)] + padded(jump);
    s.nodes.v[at(record.node_a)] = s.nodes.v_before[at(record.node_a)] = Vec4::Zero();
    s.nodes.v_before[at(record.node_b)] = padded(before);
    s.nodes.v[at(record.node_b)] = padded(after);
  }
}

// The impulse that the crack has given to the plus side, per time and area.
Vec3 traction(const Simulation& s, const Vec3& velocity) {
  Vec3 impulse = Vec3::Zero();
  for (const CrackRecord& record : s.cracks.records)
    impulse += s.nodes.mass[at(record.node_b)] * (Vec3(xyz(s.nodes.v[at(record.node_b)])) - velocity);
  return -impulse / (s.clock.dt * s.cracks.faces[0].area);
}

}  // namespace

CrackPath drive_crack(const DrivenCrackOptions& options, std::span<const std::array<double, 2>> path) {
  Simulation s = cracked_pair(options);
  const Frame frame{xyz(s.cracks.faces[0].normal), Vec3::UnitX()};
  const VertexImpulseOptions impulses{s.reference.laws, s.clock.dt, s.options.impulse_sweeps};
  const auto jump = [&](std::size_t i) { return Vec3(path[i][0] * frame.normal + path[i][1] * frame.tangent); };
  CrackPath result;
  Vec3 before = Vec3::Zero();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool is_last = i + 1 == path.size();
    const Vec3 velocity = is_last ? Vec3(Vec3::Zero()) : Vec3((jump(i + 1) - jump(i)) / s.clock.dt);
    place(s, jump(i), before, velocity);
    before = velocity;
    apply_vertex_impulses(s.cracks, s.nodes, impulses);
    const Vec3 t = traction(s, velocity);
    settle_crack_losses(s.cracks, s.topology, s.nodes, {}, impulses);
    result.points.push_back({path[i][0], path[i][1], t.dot(frame.normal), t.dot(frame.tangent)});
    if (i == 0) continue;
    const CrackPoint& a = result.points[i - 1];
    const CrackPoint& b = result.points[i];
    result.work +=
        0.5 * (a.normal + b.normal) * (b.opening - a.opening) + 0.5 * (a.tangent + b.tangent) * (b.slip - a.slip);
  }
  const double area = s.cracks.faces[0].area;
  place(s, jump(path.size() - 1), before, before);
  const CrackEnergies energies = crack_energies(s.cracks, s.nodes, impulses);
  result.dissipated = energies.losses.cohesive / area;
  result.stored = energies.stored / area;
  return result;
}

std::vector<std::array<double, 2>> straight_path(std::span<const std::array<double, 2>> corners, int steps) {
  std::vector<std::array<double, 2>> path{{0.0, 0.0}};
  for (const auto& corner : corners) {
    const auto from = path.back();
    for (int i = 1; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      const double t = path.size() <= at(steps) ? share * share : share;
      path.push_back({from[0] + t * (corner[0] - from[0]), from[1] + t * (corner[1] - from[1])});
    }
  }
  return path;
}

}  // namespace knap
