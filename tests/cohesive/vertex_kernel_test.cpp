// The vector kernels of the vertex impulses against the plain scalars of plain_impulses.hpp, on random stars of nodes
// and records in every regime: 1e-12 of what the numbers are made of, a hundred or so roundings.
#include "cohesive/vertex_kernel.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <set>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/vector_targets.hpp"
#include "tests/cohesive/plain_impulses.hpp"

namespace knap {
namespace {

constexpr double tolerance = 1e-12;
constexpr double time_step = 1e-8, node_mass = 1e-9, corner_strength = 8e-3, failure_opening = 2e-6;

struct Dice {
  std::uint64_t state;

  double uniform(double low, double high) { return low + (high - low) * uniform01(state); }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  bool hits(double probability) { return uniform01(state) < probability; }
  std::size_t below(std::size_t n) { return splitmix64(state) % n; }
  Vec3 vector(double size) {
    const double x = uniform(-size, size), y = uniform(-size, size), z = uniform(-size, size);
    return {x, y, z};
  }
};

/// Cracks without a mesh: what the impulses need of one.
struct Scene {
  Topology topology;
  NodalState nodes;
  CrackState cracks;
  std::vector<CohesiveLaw> laws;
  int sweeps = 2;

  VertexImpulseOptions options() const { return {laws, time_step, sweeps}; }
};

// A few vertices are hubs of many nodes and records, most have a handful, some none.
constexpr std::size_t num_vertices = 400, num_facets = 700, num_hubs = 5;

void add_nodes(Scene& scene, Dice& dice, std::size_t vertex) {
  const std::size_t count = vertex < num_hubs ? 30 : 2 + dice.below(5);
  const double spread = dice.log_uniform(1e-10, 2.0 * failure_opening), speed = dice.log_uniform(1e-4, 3.0);
  const Vec3 middle = dice.vector(1e-3), velocity = dice.vector(speed);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 before = velocity + dice.vector(speed);
    scene.nodes.x.push_back(padded(middle + dice.vector(spread)));
    scene.nodes.v_before.push_back(padded(before));
    scene.nodes.v.push_back(padded(before + dice.vector(0.3 * speed)));
    scene.nodes.f.push_back(Vec4::Zero());
    scene.nodes.mass.push_back(dice.log_uniform(0.2, 5.0) * node_mass);
    scene.topology.vertex_of_node.push_back(static_cast<Index>(vertex));
  }
}

// A bare topology: how many vertices and facets there are, and whose the nodes are.
void add_stars(Scene& scene, Dice& dice) {
  for (std::size_t vertex = 0; vertex < num_vertices; ++vertex) add_nodes(scene, dice, vertex);
  scene.topology.corners_of_vertex.offsets.assign(num_vertices + 1, 0);
  scene.topology.facet_tets.resize(num_facets);
}

CrackFace random_face(Dice& dice, std::size_t facet) {
  CrackFace face;
  face.facet = static_cast<Index>(facet);
  face.area = 3e-9;
  face.normal = padded(dice.vector(1.0).normalized());
  const bool ends = dice.hits(0.1), rotates = dice.hits(0.3);
  face.normal[3] = ends      ? (rotates ? face_action::ends_and_rotates : face_action::ends)
                   : rotates ? face_action::rotates
                             : face_action::none;
  face.rotation = padded(dice.vector(1e3));
  face.centre = padded(dice.vector(1e-3));
  for (Vec4& couple : face.couple) couple = padded(dice.vector(1e-18));
  return face;
}

// Damage that goes with the regime; virgin records end at an opening of 3 dt^2 s0 (1/m_a + 1/m_b).
void set_regime(CrackRecord& record, Dice& dice, const NodalState& nodes) {
  const double virgin_opening = 3.0 * time_step * time_step * record.strength *
                                (1.0 / nodes.mass[at(record.node_a)] + 1.0 / nodes.mass[at(record.node_b)]);
  record.regime = std::array{RecordRegime::Virgin, RecordRegime::Softening, RecordRegime::Failed}[dice.below(3)];
  if (record.regime == RecordRegime::Virgin) {
    const double about_the_end = dice.uniform(1.0 - 1e-6, 1.0 + 1e-6);
    record.d_max = dice.hits(0.3) ? 0.0 : virgin_opening * (dice.hits(0.5) ? about_the_end : dice.uniform(0.0, 1.0));
  }
  if (record.regime == RecordRegime::Softening) record.d_max = dice.log_uniform(virgin_opening, record.delta_c);
  if (record.regime == RecordRegime::Failed) record.d_max = record.delta_c;
}

CrackRecord random_record(Scene& scene, Dice& dice, std::span<const Index> nodes) {
  CrackRecord record;
  record.node_a = nodes[dice.below(nodes.size())];
  record.node_b = dice.hits(0.1) ? record.node_a : nodes[dice.below(nodes.size())];
  record.strength = dice.uniform(0.5, 2.0) * corner_strength;
  record.delta_c = dice.uniform(0.5, 2.0) * failure_opening;
  set_regime(record, dice, scene.nodes);
  record.impulse = dice.vector(dice.log_uniform(0.01, 10.0) * time_step * record.strength);
  return record;
}

std::array<std::size_t, 3> random_vertices(Dice& dice) {
  std::set<std::size_t> vertices;
  while (vertices.size() < 3) vertices.insert(dice.hits(0.2) ? dice.below(num_hubs) : dice.below(num_vertices));
  const std::vector<std::size_t> list(vertices.begin(), vertices.end());
  return {list[0], list[1], list[2]};
}

void add_random_cracks(Scene& scene, Dice& dice) {
  std::vector<std::vector<Index>> nodes_of_vertex(num_vertices);
  for (Index i = 0; i < scene.nodes.size(); ++i) nodes_of_vertex[at(scene.topology.vertex_of_node[at(i)])].push_back(i);
  std::vector<CrackFace> faces;
  std::vector<VertexRecord> records;
  for (std::size_t facet = 0; facet < num_facets; ++facet) {
    CrackFace face = random_face(dice, facet);
    const auto vertices = random_vertices(dice);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      CrackRecord record = random_record(scene, dice, nodes_of_vertex[vertices[corner]]);
      record.face = static_cast<Index>(facet);
      record.corner = static_cast<std::uint8_t>(corner);
      face.nodes[corner] = {record.node_a, record.node_b};
      face.failed[corner] = record.regime == RecordRegime::Failed;
      records.push_back({static_cast<Index>(vertices[corner]), record});
    }
    faces.push_back(face);
  }
  std::stable_sort(records.begin(), records.end(),
                   [](const VertexRecord& a, const VertexRecord& b) { return a.vertex < b.vertex; });
  scene.cracks = make_crack_state(scene.topology);
  add_cracks(scene.cracks, faces, records);
  group_records(scene.cracks);
}

Scene random_scene(std::uint64_t seed, const CohesiveLaw& law, int sweeps = 2) {
  Dice dice{seed};
  Scene scene;
  scene.laws = {law};
  scene.sweeps = sweeps;
  add_stars(scene, dice);
  add_random_cracks(scene, dice);
  return scene;
}

plain::Record plain_record(const CrackRecord& r) {
  return {r.impulse, r.d_max, r.strength, r.delta_c, at(r.face), at(r.node_a), at(r.node_b), r.corner, r.regime};
}

plain::Face plain_face(const CrackFace& f) {
  plain::Face face{.normal = xyz(f.normal),
                   .ended = f.has_ended(),
                   .rotates = f.rotates(),
                   .rotation = xyz(f.rotation),
                   .centre = xyz(f.centre),
                   .couple = {xyz(f.couple[0]), xyz(f.couple[1]), xyz(f.couple[2])}};
  for (std::size_t corner = 0; corner < 3; ++corner) face.failed[corner] = f.failed[corner] != 0;
  return face;
}

std::vector<Vec3> three(const std::vector<Vec4>& field) {
  std::vector<Vec3> result;
  for (const Vec4& value : field) result.push_back(xyz(value));
  return result;
}

plain::State plain_state(const Scene& scene) {
  const CrackState& cracks = scene.cracks;
  plain::State s{.dt = time_step,
                 .sweeps = scene.sweeps,
                 .law = scene.laws.front(),
                 .faces = {},
                 .records_of_vertex = {},
                 .x = three(scene.nodes.x),
                 .v = three(scene.nodes.v),
                 .v_before = three(scene.nodes.v_before),
                 .mass = scene.nodes.mass,
                 .losses = cracks.losses_of_vertex,
                 .step_losses = cracks.step_losses_of_vertex,
                 .loss_size = std::vector<double>(num_vertices, 0.0),
                 .met_of_vertex = {}};
  for (const CrackFace& face : cracks.faces) s.faces.push_back(plain_face(face));
  for (Index vertex = 0; vertex < scene.topology.num_vertices(); ++vertex) {
    auto& records = s.records_of_vertex.emplace_back();
    for (const CrackRecord& record : cracks.records_of_vertex(vertex)) records.push_back(plain_record(record));
  }
  return s;
}

/// Sizes that the numbers of one vertex are made of.
struct Sizes {
  double speed = 0.0, impulse = 0.0;
};
std::vector<Sizes> sizes_of_vertices(const Scene& before, const plain::State& after) {
  std::vector<Sizes> sizes(num_vertices);
  for (std::size_t node = 0; node < after.v.size(); ++node) {
    Sizes& of = sizes[at(before.topology.vertex_of_node[node])];
    of.speed = std::max({of.speed, after.v[node].norm(), before.nodes.v[node].norm()});
    of.impulse = std::max(of.impulse, after.mass[node] * after.v[node].norm());
  }
  for (std::size_t vertex = 0; vertex < num_vertices; ++vertex)
    for (const plain::Record& record : after.records_of_vertex[vertex])
      sizes[vertex].impulse = std::max(sizes[vertex].impulse, record.impulse.norm());
  return sizes;
}

void expect_same_losses(const CrackLosses& a, const CrackLosses& b, double size, std::size_t vertex) {
  EXPECT_NEAR(a.cohesive, b.cohesive, tolerance * size) << vertex;
  EXPECT_NEAR(a.closure, b.closure, tolerance * size) << vertex;
  EXPECT_NEAR(a.friction, b.friction, tolerance * size) << vertex;
  EXPECT_NEAR(a.cohesive_shear, b.cohesive_shear, tolerance * size) << vertex;
}

void expect_same_record(const plain::Record& a, const plain::Record& b, double impulse, std::size_t vertex) {
  EXPECT_LE((a.impulse - b.impulse).norm(), tolerance * impulse) << vertex;
  EXPECT_NEAR(a.d_max, b.d_max, tolerance * b.d_max) << vertex;
  EXPECT_EQ(a.regime, b.regime) << vertex;
}

void expect_same(const Scene& before, const Scene& scene, const plain::State& expected) {
  const plain::State actual = plain_state(scene);
  const auto sizes = sizes_of_vertices(before, expected);
  for (std::size_t node = 0; node < actual.v.size(); ++node)
    EXPECT_LE((actual.v[node] - expected.v[node]).norm(),
              tolerance * sizes[at(scene.topology.vertex_of_node[node])].speed)
        << node;
  for (std::size_t vertex = 0; vertex < num_vertices; ++vertex) {
    for (std::size_t i = 0; i < actual.records_of_vertex[vertex].size(); ++i) {
      const plain::Record& record = expected.records_of_vertex[vertex][i];
      const double impulse = sizes[vertex].impulse;
      expect_same_record(actual.records_of_vertex[vertex][i], record, impulse, vertex);
      const double jump = (actual.x[record.b] - actual.x[record.a]).norm();
      const plain::Face& face = expected.faces[record.face];
      EXPECT_LE((actual.faces[record.face].couple[record.corner] - face.couple[record.corner]).norm(),
                tolerance * (face.couple[record.corner].norm() + jump * impulse))
          << vertex;
      EXPECT_EQ(actual.faces[record.face].failed[record.corner], face.failed[record.corner]) << vertex;
    }
    expect_same_losses(actual.losses[vertex], expected.losses[vertex], expected.loss_size[vertex], vertex);
    expect_same_losses(actual.step_losses[vertex], expected.step_losses[vertex], expected.loss_size[vertex], vertex);
  }
}

// Other impulses reach some of the nodes before the step is settled.
std::vector<Index> push_some_nodes(NodalState& nodes) {
  Dice dice{99};
  std::vector<Index> pushed;
  for (Index i = 0; i < nodes.size(); ++i)
    if (dice.hits(0.1)) {
      xyz(nodes.v[at(i)]) += dice.vector(0.5);
      pushed.push_back(i);
    }
  return pushed;
}

std::vector<std::size_t> vertices_of(const Topology& topology, const std::vector<Index>& nodes) {
  std::set<std::size_t> vertices;
  for (const Index node : nodes) vertices.insert(at(topology.vertex_of_node[at(node)]));
  return {vertices.begin(), vertices.end()};
}

void expect_step_as_plain(Scene scene) {
  const Scene before = scene;
  plain::State expected = plain_state(scene);
  plain::apply_impulses(expected);
  apply_vertex_impulses(scene.cracks, scene.nodes, scene.options());
  expect_same(before, scene, expected);
  const auto pushed = push_some_nodes(scene.nodes);
  expected.v = three(scene.nodes.v);
  plain::settle(expected, vertices_of(scene.topology, pushed));
  settle_crack_losses(scene.cracks, scene.topology, scene.nodes, pushed, scene.options());
  expect_same(before, scene, expected);
}

std::vector<CohesiveLaw> laws() {
  return {{.beta = 1.5, .kappa = 1.0},
          {.beta = 1.3, .kappa = 0.6, .softening_friction = SofteningFriction::Blended},
          {.beta = 0.5, .kappa = 3.0, .internal_friction = 0.4, .sliding_friction = 0.2},
          {.beta = 1.0,
           .kappa = 1.7,
           .internal_friction = 0.0,
           .sliding_friction = 0.5,
           .softening_friction = SofteningFriction::Blended}};
}

class VertexKernel : public testing::TestWithParam<std::string> {
 protected:
  VertexKernel() { use_vector_target(GetParam()); }
  ~VertexKernel() override { use_vector_target(""); }
};

TEST_P(VertexKernel, DoesWhatThePlainScalarsDo) {
  for (const CohesiveLaw& law : laws())
    for (std::uint64_t seed = 1; seed <= 4; ++seed) expect_step_as_plain(random_scene(seed, law));
}

TEST_P(VertexKernel, DoesSoForAnyNumberOfSweeps) {
  for (const int sweeps : {0, 1, 5}) expect_step_as_plain(random_scene(7, laws()[1], sweeps));
}

TEST_P(VertexKernel, DamagesNothingThatHasNotOpened) {
  Scene scene = random_scene(3, laws()[0]);
  for (Index i = 0; i < scene.nodes.size(); ++i)
    xyz(scene.nodes.x[at(i)]) = scene.topology.vertex_of_node[at(i)] * Vec3(1e-5, 0.0, 0.0);
  const plain::State before = plain_state(scene);
  apply_vertex_impulses(scene.cracks, scene.nodes, scene.options());
  const plain::State after = plain_state(scene);
  for (std::size_t vertex = 0; vertex < num_vertices; ++vertex)
    for (std::size_t i = 0; i < after.records_of_vertex[vertex].size(); ++i)
      EXPECT_EQ(after.records_of_vertex[vertex][i].d_max, before.records_of_vertex[vertex][i].d_max);
}

// Two particles: the vertices of each do what they do where all have its law.
TEST_P(VertexKernel, GivesEachParticleItsLaw) {
  constexpr Index first_of_second = 211;  // in the middle of a group
  const auto after_step = [](const std::vector<CohesiveLaw>& of_particles) {
    Scene scene = random_scene(6, of_particles.front());
    scene.laws = of_particles;
    scene.cracks.first_vertices = {0, first_of_second};
    group_records(scene.cracks);
    apply_vertex_impulses(scene.cracks, scene.nodes, scene.options());
    const auto pushed = push_some_nodes(scene.nodes);
    settle_crack_losses(scene.cracks, scene.topology, scene.nodes, pushed, scene.options());
    return scene;
  };
  const CohesiveLaw one = laws()[0], other = laws()[2];
  const Scene both = after_step({one, other}), ones = after_step({one, one}), others = after_step({other, other});
  for (std::size_t i = 0; i < both.nodes.v.size(); ++i) {
    const Scene& same = both.topology.vertex_of_node[i] < first_of_second ? ones : others;
    ASSERT_EQ(both.nodes.v[i], same.nodes.v[i]) << i;
  }
  for (Index v = 0; v < both.topology.num_vertices(); ++v) {
    const Scene& same = v < first_of_second ? ones : others;
    ASSERT_EQ(both.cracks.losses_of_vertex[at(v)].friction, same.cracks.losses_of_vertex[at(v)].friction) << v;
    ASSERT_EQ(both.cracks.losses_of_vertex[at(v)].cohesive, same.cracks.losses_of_vertex[at(v)].cohesive) << v;
  }
  EXPECT_NE(crack_energies(ones.cracks, ones.nodes, ones.options()).losses.friction,
            crack_energies(others.cracks, others.nodes, others.options()).losses.friction);
}

INSTANTIATE_TEST_SUITE_P(EveryTarget, VertexKernel, testing::ValuesIn(vector_targets()),
                         [](const auto& target) { return target.param; });

// The scenes above hold everything that can happen to a record, many times.
TEST(PlainImpulses, MeetEveryCase) {
  std::array<int, 9> times{};
  std::size_t most = 0, fewest = num_facets;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    plain::State s = plain_state(random_scene(seed, laws()[1]));
    plain::apply_impulses(s);
    for (const auto& vertex : s.met_of_vertex) {
      most = std::max(most, vertex.size());
      fewest = std::min(fewest, vertex.size());
      for (const plain::Met& m : vertex)
        for (const auto& [kind, met] : {std::pair{0, m.leaves_virgin},
                                        {1, m.fails},
                                        {2, m.grows},
                                        {3, m.tension && m.slides},
                                        {4, m.tension && m.sticks},
                                        {5, m.pushes && m.slides},
                                        {6, m.pushes && m.sticks},
                                        {7, m.idle},
                                        {8, m.spins}})
          times[static_cast<std::size_t>(kind)] += met ? 1 : 0;
    }
  }
  EXPECT_THAT(times, testing::Each(testing::Ge(20)));
  EXPECT_GT(most, 60u);
  EXPECT_EQ(fewest, 0u);
}

/// Everything that a step changes, bit by bit.
std::vector<std::uint64_t> bits_after_step(const std::string& target, int threads) {
  use_vector_target(target);
  set_num_threads(threads);
  Scene scene = random_scene(5, laws()[2]);
  apply_vertex_impulses(scene.cracks, scene.nodes, scene.options());
  const auto pushed = push_some_nodes(scene.nodes);
  settle_crack_losses(scene.cracks, scene.topology, scene.nodes, pushed, scene.options());
  set_num_threads(0);
  use_vector_target("");
  const plain::State s = plain_state(scene);
  std::vector<std::uint64_t> bits;
  const auto add = [&bits](double value) { bits.push_back(std::bit_cast<std::uint64_t>(value)); };
  const auto add_vector = [&add](const Vec3& value) { std::for_each(value.begin(), value.end(), add); };
  for (const Vec3& v : s.v) add_vector(v);
  for (const plain::Face& face : s.faces)
    for (const Vec3& couple : face.couple) add_vector(couple);
  for (const CrackLosses& losses : s.losses)
    for (const double loss : {losses.cohesive, losses.closure, losses.friction, losses.cohesive_shear}) add(loss);
  for (const auto& records : s.records_of_vertex)
    for (const plain::Record& record : records) {
      add_vector(record.impulse);
      add(record.d_max);
      bits.push_back(static_cast<std::uint64_t>(record.regime));
    }
  return bits;
}

TEST(VertexKernelBits, DoNotDependOnTheNumberOfThreads) {
  for (const std::string& target : vector_targets()) {
    const auto alone = bits_after_step(target, 1);
    EXPECT_EQ(bits_after_step(target, 2), alone) << target;
    EXPECT_EQ(bits_after_step(target, 3), alone) << target;
  }
}

TEST(VertexKernelBits, AreTheSameForBothVectorSets) {
  const auto targets = vector_targets();
  for (const char* target : {"AVX3", "AVX2"})
    if (std::find(targets.begin(), targets.end(), target) == targets.end())
      GTEST_SKIP() << "this processor has no " << target;
  EXPECT_EQ(bits_after_step("AVX3", 2), bits_after_step("AVX2", 2));
}

}  // namespace
}  // namespace knap
