#include "cohesive/hand_over.hpp"

#include <gtest/gtest.h>

#include "cohesive/fragments.hpp"
#include "simulation/step.hpp"
#include "tests/support/granule.hpp"

namespace knap {
namespace {

// A granule in the middle of its impact, where failed faces between fragments still meet.
Simulation breaking_granule() {
  Granule granule{.element_size = 0.2e-3, .contact_element_size = 0.15e-3};
  granule.particle.fracture = zeolite_fracture();
  granule.options.tools.push_back(wall(0.1));
  granule.particle.velocity = {0.0, 0.0, -28.0};
  Simulation s = make_granule(granule);
  for (int i = 0; i < 300; ++i) EXPECT_EQ(step(s), StepStatus::Ok);
  s.contact.fragment_of_tet = fragment_labels(s.topology, s.cracks, FragmentLabel::Strict);
  return s;
}

double least_normal_jump(const CrackFace& face, const NodalState& nodes) {
  double least = 1e300;
  for (const auto& [a, b] : face.nodes)
    least = std::min(least, (nodes.x[at(b)] - nodes.x[at(a)]).head<3>().dot(face.normal.head<3>()));
  return least;
}

TEST(HandOver, AFragmentThatLetsGoHandsOverWhatDoesNotOverlap) {
  Simulation s = breaking_granule();
  const auto& label = s.contact.fragment_of_tet;
  HandOverOptions options{.facet_size = s.reference.facet_size};
  hand_over_faces(s.cracks, s.topology, s.nodes.x, label, options);  // what has parted anyway
  const std::vector<FacetState> before = s.topology.facet_state;
  std::vector<std::uint8_t> lets_go(label.size(), 0);
  for (std::size_t t = 0; t < label.size(); ++t) lets_go[t] = label[t] % 3 == 1 ? 1 : 0;
  options.lets_go = lets_go;
  const Index count = hand_over_faces(s.cracks, s.topology, s.nodes.x, label, options);
  EXPECT_GT(count, 5);
  Index kept = 0, released = 0;
  for (const CrackFace& face : s.cracks.faces) {
    if (before[at(face.facet)] != FacetState::Failed) continue;
    const auto& [minus, plus] = s.topology.facet_tets[at(face.facet)];
    const bool wished = label[at(minus)] != label[at(plus)] && (lets_go[at(minus)] || lets_go[at(plus)]);
    const double least = least_normal_jump(face, s.nodes) / s.reference.facet_size[at(face.facet)];
    const bool gone = s.topology.facet_state[at(face.facet)] == FacetState::HandedOver;
    EXPECT_EQ(gone, wished && least >= -options.overlap_let_go);
    EXPECT_EQ(face.has_ended(), gone);
    (gone ? released : kept)++;
  }
  EXPECT_EQ(released, count);
  EXPECT_GT(kept, 5);
}

}  // namespace
}  // namespace knap
