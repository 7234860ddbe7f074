#include "simulation/rested_piece.hpp"

#include <gtest/gtest.h>

#include "cohesive/fragments.hpp"
#include "simulation/persistent_arrays.hpp"
#include "simulation/step.hpp"
#include "tests/support/bar_mesh.hpp"
#include "tests/support/granule.hpp"

namespace knap {
namespace {

// A zeolite granule some time after it has hit a wall so fast that it breaks.
const Simulation& broken_granule() {
  static const Simulation broken = [] {
    Granule granule{.element_size = 0.3e-3, .contact_element_size = 0.3e-3};
    granule.particle.fracture = zeolite_fracture();
    granule.particle.fracture->weibull_modulus = 10.0;
    granule.particle.fracture->weibull_reference_volume = 1e-12;
    granule.particle.velocity = {0.0, 0.0, -22.0};
    granule.options.tools = {wall(0.3)};
    Simulation s = make_granule(granule);
    while (s.clock.time() < 12e-6) EXPECT_EQ(step(s), StepStatus::Ok);
    return s;
  }();
  return broken;
}

struct Kept {
  RestedPiece piece;
  std::vector<Index> tets;  ///< of the run it is from, ascending
};
Kept largest_piece(const Simulation& s) {
  const auto label = fragment_labels(s.topology, s.cracks, FragmentLabel::Damage);
  std::vector<double> volume(at(num_fragments(label)), 0.0);
  for (std::size_t tet = 0; tet < label.size(); ++tet) volume[at(label[tet])] += s.reference.tet_volume[tet];
  const Index largest = static_cast<Index>(std::max_element(volume.begin(), volume.end()) - volume.begin());
  Kept kept{rested_piece(s, label, largest), {}};
  for (Index tet = 0; tet < to_index(label.size()); ++tet)
    if (label[at(tet)] == largest) kept.tets.push_back(tet);
  return kept;
}

TEST(RestedPiece, OfAnUntouchedParticleIsTheParticle) {
  Granule granule{.element_size = 0.3e-3, .contact_element_size = 0.3e-3};
  granule.particle.fracture = zeolite_fracture();
  granule.particle.velocity = {0.0, 0.0, -5.0};
  granule.options.tools = {wall(0.3)};
  const Simulation s = make_granule(granule);
  const auto label = fragment_labels(s.topology, s.cracks, FragmentLabel::Damage);
  const RestedPiece piece = rested_piece(s, label, 0);
  EXPECT_TRUE(piece.cracks.empty());
  EXPECT_EQ(state_hash(make_simulation(s.options, piece)), state_hash(s));
}

TEST(RestedPiece, KeepsTetsStrengthsAndDamage) {
  const Simulation& s = broken_granule();
  const Kept kept = largest_piece(s);
  ASSERT_LT(kept.tets.size(), at(s.topology.num_tets()));
  ASSERT_GT(kept.piece.cracks.size(), 50u);
  const Simulation again = make_simulation(s.options, kept.piece);
  ASSERT_EQ(again.topology.num_tets(), to_index(kept.tets.size()));
  std::size_t crack = 0;
  for (Index facet = 0; facet < again.topology.num_facets(); ++facet) {
    // The same facet by its tets, not by its number.
    const auto& [minus, plus] = again.topology.facet_tets[at(facet)];
    const auto& facets = s.topology.tet_facets[at(kept.tets[at(minus)])];
    const auto old = std::find_if(facets.begin(), facets.end(), [&](Index f) {
      return f != none && s.topology.facet_tets[at(f)] == std::array{kept.tets[at(minus)], kept.tets[at(plus)]};
    });
    ASSERT_NE(old, facets.end());
    EXPECT_EQ(again.reference.facet_strength[at(facet)], s.reference.facet_strength[at(*old)]);
    const bool is_cracked = s.topology.facet_state[at(*old)] != FacetState::Bonded;
    ASSERT_EQ(again.topology.facet_state[at(facet)] != FacetState::Bonded, is_cracked);
    if (!is_cracked) continue;
    EXPECT_EQ(kept.piece.cracks.at(crack++).facet, facet);
    const Index face = s.cracks.face_of_facet[at(*old)];
    if (face == none) continue;  // handed over: nothing left of it
    for (int k = 0; k < 3; ++k) {
      const auto damage = [&](const Simulation& run, Index f) {
        for (const CrackRecord& record : run.cracks.records_of_vertex(run.topology.facet_vertex(f, k)))
          if (run.cracks.faces[at(record.face)].facet == f) return record.damage();
        return -1.0;
      };
      EXPECT_NEAR(damage(again, facet), damage(s, *old), 1e-12);
    }
  }
  EXPECT_EQ(crack, kept.piece.cracks.size());
}

TEST(RestedPiece, IsOnePieceWithoutForces) {
  const Simulation& s = broken_granule();
  const Kept kept = largest_piece(s);
  SimulationOptions options = s.options;
  options.tools.clear();
  options.particles[0].velocity.setZero();
  Simulation piece = make_simulation(options, kept.piece);
  double volume = 0.0;
  for (const Index tet : kept.tets) volume += s.reference.tet_volume[at(tet)];
  EXPECT_NEAR(piece.reference.start.mass, 1270.0 * volume, 1e-12 * 1270.0 * volume + piece.totals.added_mass);
  for (const FragmentLabel label : {FragmentLabel::Strict, FragmentLabel::Damage})
    EXPECT_EQ(num_fragments(fragment_labels(piece.topology, piece.cracks, label)), 1);
  const std::int64_t cracks = piece.totals.inserted_facets;
  for (int i = 0; i < 500; ++i) ASSERT_EQ(step(piece), StepStatus::Ok);
  EXPECT_EQ(piece.totals.inserted_facets, cracks);
  double fastest = 0.0;
  for (const Vec4& v : piece.nodes.v) fastest = std::max(fastest, v.norm());
  EXPECT_LT(fastest, 1e-9);  // [m/s], beside 22 m/s: round-off
}

// Of linear softening that had come to damage D, (1 - D) G_c is left to be spent.
TEST(InitialCracks, ABarSpendsWhatIsLeftOfTheFractureEnergy) {
  constexpr double damage = 0.4, fracture_energy = 2.0, strength = 1e6, cell = 1e-4;
  ParticleOptions particle{.young_modulus = 1e9, .poisson_ratio = 0.0, .density = 1000.0};
  particle.fracture = FractureOptions{.strength = 1e3 * strength, .fracture_energy = fracture_energy};
  // The ledger errs by the share of delta_c that opens in a step: 0.25, 0.13, 0.07 % at 0.5, 0.25, 0.125.
  Simulation s = make_simulation({.particles = {particle}, .step_safety = 0.125}, bar_mesh({20, 1, 1}, cell));
  std::vector<InitialCrack> cracks;
  for (Index f = 0; f < s.topology.num_facets(); ++f) {
    bool in_plane = true;
    for (int k = 0; k < 3; ++k)
      in_plane = in_plane && std::abs(s.reference.vertices[at(s.topology.facet_vertex(f, k))].x() - 10.0 * cell) < 1e-9;
    if (in_plane) cracks.push_back({f, strength, {damage, damage, damage}});
  }
  open_initial_cracks(s, cracks);
  EXPECT_EQ(s.cracks.records.size(), 3 * cracks.size());
  for (std::size_t tet = 0; tet < s.topology.tet_nodes.size(); ++tet) {
    double centre = 0.0;
    for (const Index vertex : s.topology.tet_vertices[tet]) centre += 0.25 * s.reference.vertices[at(vertex)].x();
    for (const Index node : s.topology.tet_nodes[tet])
      s.nodes.v[at(node)] = padded((centre > 10.0 * cell ? 1.5 : -1.5) * Vec3::UnitX());
  }
  balance_from_here(s);
  const double delta_c = 2.0 * fracture_energy / strength;
  while (s.clock.time() < 8.0 * delta_c) ASSERT_EQ(step(s), StepStatus::Ok);
  for (const CrackRecord& record : s.cracks.records) ASSERT_EQ(record.regime, RecordRegime::Failed);
  balance_energies(s);
  EXPECT_NEAR(s.ledger[EnergyTerm::CohesiveDissipated], (1.0 - damage) * fracture_energy * cell * cell,
              0.005 * fracture_energy * cell * cell);  // the step's share of the opening
  EXPECT_LT(s.ledger.max_closure_error, 1e-3);
}

}  // namespace
}  // namespace knap
