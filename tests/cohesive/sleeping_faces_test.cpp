#include "cohesive/sleeping_faces.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "cohesive/crack_faces.hpp"
#include "cohesive/insertion_criterion.hpp"
#include "cohesive/vertex_impulses.hpp"
#include "fem/sleeping_tets.hpp"
#include "simulation/persistent_arrays.hpp"
#include "tests/observers/breaking_box.hpp"

namespace knap {
namespace {

VertexImpulseOptions impulse_options(const Simulation& s) {
  return {s.reference.laws, s.clock.dt, s.options.impulse_sweeps};
}

// A box in the midst of breaking, with records in every regime.
const Simulation& cracked_box() {
  static const Simulation box = [] {
    Simulation s = breaking_box();
    advance(s, 300);
    return s;
  }();
  return box;
}

std::array<int, 3> num_records_by_regime(const CrackState& cracks) {
  std::array<int, 3> count{};
  for (const CrackRecord& record : cracks.records) ++count[static_cast<std::size_t>(record.regime)];
  return count;
}

// The tets above a height are one body.
std::vector<Index> body_above(const Simulation& s, double height) {
  std::vector<Index> body(s.topology.tet_nodes.size(), none);
  for (Index t = 0; t < s.topology.num_tets(); ++t)
    if (s.reference.vertices[at(s.topology.tet_vertices[at(t)][0])].z() > height) body[at(t)] = 4;
  return body;
}

bool sleeps(const CrackState& cracks, const CrackRecord& record) { return cracks.faces[at(record.face)].sleeps != 0; }

// One step's work of the cracks after the free motion of a step without bulk forces.
void one_step(Simulation& s) {
  kick(s.nodes, s.clock.dt);
  update_crack_faces(s.cracks, s.topology, s.nodes, all_turns);
  apply_vertex_impulses(s.cracks, s.nodes, impulse_options(s));
  std::vector<Index> every_other_node;
  for (Index i = 0; i < s.nodes.size(); i += 2) every_other_node.push_back(i);
  settle_crack_losses(s.cracks, s.topology, s.nodes, every_other_node, impulse_options(s));
}

TEST(SleepingFaces, AreThoseInsideOneBody) {
  Simulation s = cracked_box();
  for (const int count : num_records_by_regime(s.cracks)) ASSERT_GT(count, 20);
  auto bodies = body_above(s, 0.4e-3);
  for (std::size_t t = 0; t < bodies.size(); t += 3)
    if (bodies[t] != none) bodies[t] = 5;  // two bodies: what lies between them stays awake
  set_sleeping_faces(s.cracks, s.topology, bodies);
  int asleep = 0;
  for (const CrackFace& face : s.cracks.faces) {
    const auto& [minus, plus] = s.topology.facet_tets[at(face.facet)];
    EXPECT_EQ(face.sleeps != 0, bodies[at(minus)] != none && bodies[at(minus)] == bodies[at(plus)]);
    asleep += face.sleeps;
  }
  EXPECT_GT(asleep, 10);
  EXPECT_EQ(s.cracks.faces.size() - s.cracks.awake_faces.size(), static_cast<std::size_t>(asleep));
}

TEST(SleepingFaces, KeepTheirState) {
  Simulation s = cracked_box();
  set_sleeping_faces(s.cracks, s.topology, body_above(s, 0.4e-3));
  const CrackState before = s.cracks;
  one_step(s);
  std::size_t kept = 0, changed = 0;
  for (std::size_t r = 0; r < before.records.size(); ++r) {
    const bool same = std::memcmp(&before.records[r], &s.cracks.records[r], sizeof(CrackRecord)) == 0;
    if (!sleeps(before, before.records[r])) {
      changed += same ? 0 : 1;
      continue;
    }
    ++kept;
    EXPECT_TRUE(same) << r;
  }
  EXPECT_GT(kept, 100u);
  EXPECT_GT(changed, 100u);
  for (std::size_t f = 0; f < before.faces.size(); ++f) {
    if (!before.faces[f].sleeps) continue;
    EXPECT_EQ(std::memcmp(&before.faces[f], &s.cracks.faces[f], sizeof(CrackFace)), 0) << f;
  }
}

// What the awake records do where sleeping ones share their vertices is what they do where there are no others.
TEST(SleepingFaces, LeaveTheOthersAsIfTheyWereNotThere) {
  Simulation asleep = cracked_box(), gone = cracked_box();
  set_sleeping_faces(asleep.cracks, asleep.topology, body_above(asleep, 0.4e-3));
  set_sleeping_faces(gone.cracks, gone.topology, body_above(gone, 0.4e-3));
  for (CrackFace& face : gone.cracks.faces)
    if (face.sleeps) face.normal[3] = face_action::ends;
  tidy_faces(gone.cracks);
  EXPECT_FALSE(gone.cracks.any_sleeps);
  int shared = 0;
  for (const Index vertex : gone.cracks.vertices)
    shared += gone.cracks.records_of_vertex(vertex).size() < asleep.cracks.records_of_vertex(vertex).size() ? 1 : 0;
  ASSERT_GT(shared, 10);
  one_step(asleep);
  one_step(gone);
  for (std::size_t i = 0; i < gone.nodes.v.size(); ++i) ASSERT_EQ(asleep.nodes.v[i], gone.nodes.v[i]) << i;
  for (std::size_t v = 0; v < gone.cracks.losses_of_vertex.size(); ++v) {
    ASSERT_EQ(asleep.cracks.losses_of_vertex[v].cohesive, gone.cracks.losses_of_vertex[v].cohesive) << v;
    ASSERT_EQ(asleep.cracks.losses_of_vertex[v].closure, gone.cracks.losses_of_vertex[v].closure) << v;
    ASSERT_EQ(asleep.cracks.losses_of_vertex[v].friction, gone.cracks.losses_of_vertex[v].friction) << v;
  }
}

// The records awake at a vertex are handed over: nothing more is spent there.
TEST(SleepingFaces, SpendNothingOnceAlone) {
  Simulation s = cracked_box();
  one_step(s);
  set_sleeping_faces(s.cracks, s.topology, body_above(s, 0.4e-3));
  one_step(s);
  for (CrackFace& face : s.cracks.faces)
    if (!face.sleeps) face.normal[3] = face_action::ends;
  tidy_faces(s.cracks);
  EXPECT_TRUE(s.cracks.groups.groups.empty());
  ASSERT_GT(s.cracks.vertices.size(), 10u);
  const auto before = s.cracks.losses_of_vertex;
  one_step(s);
  for (std::size_t v = 0; v < before.size(); ++v) {
    EXPECT_EQ(s.cracks.losses_of_vertex[v].cohesive, before[v].cohesive);
    EXPECT_EQ(s.cracks.losses_of_vertex[v].closure, before[v].closure);
    EXPECT_EQ(s.cracks.losses_of_vertex[v].friction, before[v].friction);
  }
}

// The energy stored in a body's cracks stays what it is however the body moves.
TEST(SleepingFaces, StoreTheirEnergyInAnyRigidMotion) {
  Simulation s = cracked_box();
  set_sleeping_faces(s.cracks, s.topology, body_above(s, -1.0));
  EXPECT_TRUE(s.cracks.awake_faces.empty());
  const double before = crack_energies(s.cracks, s.nodes, impulse_options(s)).stored;
  ASSERT_GT(before, 1e-4 * s.reference.incident_energy);
  const Mat3 R = Eigen::AngleAxisd(2.0, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  const Vec3 spin(3e4, -1e4, 2e4);
  for (Index i = 0; i < s.nodes.size(); ++i) {
    const Vec3 x = R * xyz(s.nodes.x[at(i)]);
    s.nodes.x[at(i)] = padded(x);
    s.nodes.v[at(i)] = padded(spin.cross(x));
  }
  // Jumps are a thousandth of the coordinates, which are rounded.
  EXPECT_NEAR(crack_energies(s.cracks, s.nodes, impulse_options(s)).stored / before, 1.0, 1e-10);
}

TEST(SleepingFaces, WokenGoOnWithTheBitsOfThoseThatNeverSlept) {
  Simulation slept = cracked_box(), never = cracked_box();
  set_sleeping_faces(slept.cracks, slept.topology, body_above(slept, 0.4e-3));
  set_sleeping_faces(slept.cracks, slept.topology, std::vector<Index>(slept.topology.tet_nodes.size(), none));
  advance(slept, 60);
  advance(never, 60);
  EXPECT_EQ(state_hash(slept), state_hash(never));
}

// No facet of a sleeping tet is overloaded, however hard its neighbour pulls.
TEST(SleepingFaces, NoCrackBesideASleepingTet) {
  Simulation s = breaking_box();
  for (Vec4& x : s.nodes.x) x.z() *= 1.05;
  const auto overloaded = [&] {
    update_stress(s.elastic, s.nodes.x);
    return overloaded_facets(s.topology, s.nodes.x, {s.elastic.stress, s.elastic.stress_bound},
                             s.reference.facet_strength, {s.reference.laws, {}});
  };
  const auto all = overloaded();
  std::vector<Index> active;
  for (Index t = 0; t < s.topology.num_tets(); ++t)
    if (t % 5 != 0) active.push_back(t);
  set_active_tets(s.elastic, s.topology, s.reference.vertices, active);
  std::vector<Index> expected, found;
  for (const OverloadedFacet& o : all) {
    const auto& [minus, plus] = s.topology.facet_tets[at(o.facet)];
    if (minus % 5 != 0 && plus % 5 != 0) expected.push_back(o.facet);
  }
  for (const OverloadedFacet& o : overloaded()) found.push_back(o.facet);
  EXPECT_GT(found.size(), 50u);
  EXPECT_LT(found.size(), all.size());
  EXPECT_EQ(found, expected);
}

TEST(SleepingFaces, SameBitsAcrossACheckpoint) {
  Simulation whole = breaking_box(0.3);
  advance(whole, 300);
  const auto bodies = body_above(whole, 0.4e-3);
  std::vector<Index> active, all;
  for (Index t = 0; t < whole.topology.num_tets(); ++t) {
    if (bodies[at(t)] == none) active.push_back(t);
    all.push_back(t);
  }
  set_active_tets(whole.elastic, whole.topology, whole.reference.vertices, active);
  set_sleeping_faces(whole.cracks, whole.topology, bodies);
  Simulation resumed = breaking_box(0.3);
  restore_checkpoint(resumed, make_checkpoint(whole));
  EXPECT_EQ(sleeping_tets(resumed.elastic), sleeping_tets(whole.elastic));
  EXPECT_EQ(state_hash(resumed), state_hash(whole));
  const auto go_on = [&](int steps) {
    for (int i = 0; i < steps; ++i)
      for (Simulation* s : {&whole, &resumed}) step(*s);
    EXPECT_EQ(state_hash(resumed), state_hash(whole));
  };
  go_on(50);
  for (Simulation* s : {&whole, &resumed}) {
    set_active_tets(s->elastic, s->topology, s->reference.vertices, all);
    set_sleeping_faces(s->cracks, s->topology, std::vector<Index>(all.size(), none));
  }
  go_on(50);
}

}  // namespace
}  // namespace knap
