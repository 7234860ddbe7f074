// One list of all persistent state. Arrays of structs are stored a column a field, by lists of their members, so that
// no padding byte gets into files or hashes.
#include "simulation/persistent_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/errors.hpp"
#include "core/hash.hpp"
#include "fem/sleeping_tets.hpp"

namespace knap {
namespace {

template <class Struct, class Member>
struct Field {
  const char* name;
  Member Struct::*member;
};
template <class Struct, class Member>
Field(const char*, Member Struct::*) -> Field<Struct, Member>;

constexpr auto fields(const CrackRecord*) {
  return std::tuple{Field{"impulse", &CrackRecord::impulse}, Field{"strength", &CrackRecord::strength},
                    Field{"delta_c", &CrackRecord::delta_c}, Field{"d_max", &CrackRecord::d_max},
                    Field{"face", &CrackRecord::face},       Field{"node_a", &CrackRecord::node_a},
                    Field{"node_b", &CrackRecord::node_b},   Field{"corner", &CrackRecord::corner},
                    Field{"regime", &CrackRecord::regime}};
}
constexpr auto fields(const CrackFace*) {
  return std::tuple{Field{"facet", &CrackFace::facet},
                    Field{"nodes", &CrackFace::nodes},
                    Field{"normal", &CrackFace::normal},
                    Field{"couple", &CrackFace::couple},
                    Field{"carried_couple", &CrackFace::carried_couple},
                    Field{"area", &CrackFace::area},
                    Field{"failed", &CrackFace::failed},
                    Field{"sleeps", &CrackFace::sleeps}};
}
constexpr auto fields(const CrackLosses*) {
  return std::tuple{Field{"cohesive", &CrackLosses::cohesive}, Field{"closure", &CrackLosses::closure},
                    Field{"friction", &CrackLosses::friction}, Field{"cohesive_shear", &CrackLosses::cohesive_shear}};
}
constexpr auto fields(const ContactCandidate*) {
  return std::tuple{Field{"tets", &ContactCandidate::tets}, Field{"fragments", &ContactCandidate::fragments},
                    Field{"due", &ContactCandidate::due}};
}
constexpr auto fields(const Touch*) {
  return std::tuple{Field{"candidate", &Touch::candidate},
                    Field{"size", &Touch::size},
                    Field{"area_along_edges", &Touch::area_along_edges},
                    Field{"patch_size", &Touch::patch_size},
                    Field{"weights", &Touch::weights},
                    Field{"first_in_second", &Touch::first_in_second},
                    Field{"carries_body", &Touch::carries_body}};
}
// Its sides follow from the positions before they are used again; what is kept is what the next step starts from.
constexpr auto fields(const Contact*) {
  return std::tuple{Field{"tets", &Contact::tets},       Field{"point", &Contact::point},
                    Field{"place", &Contact::place},     Field{"normal", &Contact::normal},
                    Field{"impulse", &Contact::impulse}, Field{"anchor", &Contact::anchor}};
}
constexpr auto fields(const RigidBody*) {
  return std::tuple{Field{"mass", &RigidBody::mass},
                    Field{"centre", &RigidBody::centre},
                    Field{"orientation", &RigidBody::orientation},
                    Field{"velocity", &RigidBody::velocity},
                    Field{"angular_momentum", &RigidBody::angular_momentum},
                    Field{"velocity_before", &RigidBody::velocity_before},
                    Field{"angular_momentum_before", &RigidBody::angular_momentum_before},
                    Field{"inertia", &RigidBody::inertia},
                    Field{"inverse_inertia", &RigidBody::inverse_inertia},
                    Field{"inverse_inertia_world", &RigidBody::inverse_inertia_world},
                    Field{"size", &RigidBody::size},
                    Field{"radius", &RigidBody::radius},
                    Field{"strength", &RigidBody::strength},
                    Field{"critical_speed", &RigidBody::critical_speed},
                    Field{"crossing_time", &RigidBody::crossing_time},
                    Field{"load", &RigidBody::load},
                    Field{"strain_energy", &RigidBody::strain_energy}};
}
constexpr auto fields(const FreezingState*) { return std::tuple{Field{"vibration", &FreezingState::vibration}}; }
constexpr auto fields(const BranchState*) {
  return std::tuple{Field{"dt", &BranchState::dt}, Field{"stored", &BranchState::stored},
                    Field{"pending", &BranchState::pending}, Field{"dissipated", &BranchState::dissipated}};
}
constexpr auto fields(const Clock*) { return std::tuple{Field{"dt", &Clock::dt}, Field{"step", &Clock::step}}; }
constexpr auto fields(const GravityImpulse*) {
  return std::tuple{Field{"linear", &GravityImpulse::linear}, Field{"angular", &GravityImpulse::angular}};
}
constexpr auto fields(const ForceWatch*) {
  return std::tuple{Field{"impulse", &ForceWatch::impulse}, Field{"largest", &ForceWatch::largest}};
}
constexpr auto fields(const ToolState*) {
  return std::tuple{Field{"position", &ToolState::position},
                    Field{"orientation", &ToolState::orientation},
                    Field{"velocity", &ToolState::velocity},
                    Field{"spin", &ToolState::spin},
                    Field{"velocity_before", &ToolState::velocity_before},
                    Field{"spin_before", &ToolState::spin_before},
                    Field{"impulse", &ToolState::impulse},
                    Field{"angular_impulse", &ToolState::angular_impulse},
                    Field{"moment", &ToolState::moment},
                    Field{"work", &ToolState::work},
                    Field{"friction_loss", &ToolState::friction_loss},
                    Field{"impact_loss", &ToolState::impact_loss},
                    Field{"max_force", &ToolState::max_force},
                    Field{"first_step", &ToolState::first_step},
                    Field{"last_step", &ToolState::last_step}};
}
constexpr auto fields(const PrescribedState*) {
  return std::tuple{Field{"impulse", &PrescribedState::impulse}, Field{"work", &PrescribedState::work}};
}
constexpr auto fields(const RunTotals*) {
  return std::tuple{Field{"mass_scaling_energy", &RunTotals::mass_scaling_energy},
                    Field{"added_mass", &RunTotals::added_mass},
                    Field{"added_linear", &RunTotals::added_linear},
                    Field{"added_angular", &RunTotals::added_angular},
                    Field{"last_contact_step", &RunTotals::last_contact_step},
                    Field{"smallest_volume_ratio", &RunTotals::smallest_volume_ratio},
                    Field{"inserted_facets", &RunTotals::inserted_facets},
                    Field{"noted_damage", &RunTotals::noted_damage}};
}
constexpr auto fields(const EnergyLedger*) {
  return std::tuple{Field{"value", &EnergyLedger::value}, Field{"initial", &EnergyLedger::initial},
                    Field{"reference", &EnergyLedger::reference},
                    Field{"max_closure_error", &EnergyLedger::max_closure_error}};
}

/// How a member is laid out: `count` scalars of type Scalar.
template <class T>
struct Layout {
  using Scalar = T;
  static constexpr std::size_t count = 1;
};
template <class T, std::size_t n>
struct Layout<std::array<T, n>> {
  using Scalar = typename Layout<T>::Scalar;
  static constexpr std::size_t count = n * Layout<T>::count;
};
template <int rows, int columns>
struct Layout<Eigen::Matrix<double, rows, columns>> {
  using Scalar = double;
  static constexpr std::size_t count = std::size_t{rows} * columns;
};
template <>
struct Layout<Eigen::Quaterniond> {
  using Scalar = double;
  static constexpr std::size_t count = 4;
};

template <class Member>
auto* scalars(Member& member) {
  using Scalar = typename Layout<std::remove_const_t<Member>>::Scalar;
  using Pointer = std::conditional_t<std::is_const_v<Member>, const Scalar*, Scalar*>;
  static_assert(sizeof(Member) == sizeof(Scalar) * Layout<std::remove_const_t<Member>>::count);
  return reinterpret_cast<Pointer>(&member);
}

/// Where columns of this scalar type go: floating point and 64-bit counts as doubles (counts stay below 2^53).
template <class Scalar>
constexpr bool stored_as_double = std::is_floating_point_v<Scalar> || sizeof(Scalar) == 8;

struct Writer {
  Checkpoint& checkpoint;

  template <class Scalar>
  void column(const std::string& name, std::size_t size, const auto& value) {
    if constexpr (stored_as_double<Scalar>) {
      auto& out = checkpoint.doubles[name];
      for (std::size_t i = 0; i < size; ++i) out.push_back(static_cast<double>(value(i)));
    } else if constexpr (sizeof(Scalar) == 4) {
      auto& out = checkpoint.ints[name];
      for (std::size_t i = 0; i < size; ++i) out.push_back(static_cast<std::int32_t>(value(i)));
    } else {
      auto& out = checkpoint.bytes[name];
      for (std::size_t i = 0; i < size; ++i) out.push_back(static_cast<std::uint8_t>(value(i)));
    }
  }
  template <class T>
  void plain(const std::string& name, const std::vector<T>& values) {
    using L = Layout<T>;
    column<typename L::Scalar>(name, values.size() * L::count,
                               [&](std::size_t i) { return scalars(values[i / L::count])[i % L::count]; });
  }
  template <class Struct>
  void structs(const std::string& name, const std::vector<Struct>& values) {
    const auto one = [&](const auto& field) {
      using L = Layout<std::remove_cvref_t<decltype(values[0].*field.member)>>;
      column<typename L::Scalar>(name + "." + field.name, values.size() * L::count, [&](std::size_t i) {
        return scalars(values[i / L::count].*field.member)[i % L::count];
      });
    };
    std::apply([&](const auto&... field) { (one(field), ...); }, fields(static_cast<const Struct*>(nullptr)));
  }
};

struct Reader {
  const Checkpoint& checkpoint;

  template <class Scalar>
  const auto& source(const std::string& name) const {
    const auto find = [&](const auto& map) -> const auto& {
      const auto found = map.find(name);
      if (found == map.end()) throw InputError(fmt::format("checkpoint: no array '{}'", name));
      return found->second;
    };
    if constexpr (stored_as_double<Scalar>)
      return find(checkpoint.doubles);
    else if constexpr (sizeof(Scalar) == 4)
      return find(checkpoint.ints);
    else
      return find(checkpoint.bytes);
  }
  template <class T>
  void plain(const std::string& name, std::vector<T>& values) const {
    using L = Layout<T>;
    const auto& in = source<typename L::Scalar>(name);
    values.resize(in.size() / L::count);
    for (std::size_t i = 0; i < values.size() * L::count; ++i)
      scalars(values[i / L::count])[i % L::count] = static_cast<typename L::Scalar>(in[i]);
  }
  template <class Struct>
  void structs(const std::string& name, std::vector<Struct>& values) const {
    const auto one = [&](const auto& field) {
      using L = Layout<std::remove_cvref_t<decltype(values[0].*field.member)>>;
      const auto& in = source<typename L::Scalar>(name + "." + field.name);
      values.resize(in.size() / L::count);
      for (std::size_t i = 0; i < values.size() * L::count; ++i)
        scalars(values[i / L::count].*field.member)[i % L::count] = static_cast<typename L::Scalar>(in[i]);
    };
    std::apply([&](const auto&... field) { (one(field), ...); }, fields(static_cast<const Struct*>(nullptr)));
  }
};

template <class Visitor, class Struct>
void visit_single(Visitor& visit, const std::string& name, Struct& value) {
  std::vector<std::remove_const_t<Struct>> one{value};
  visit.structs(name, one);
  if constexpr (!std::is_const_v<Struct>) value = one.at(0);
}

// The number of tools is the case's.
template <class Visitor, class Tools>
void visit_tools(Visitor& visit, Tools& tools) {
  std::vector<ToolState> states;
  for (const Tool& tool : tools) states.push_back(tool.state);
  visit.structs("tools", states);
  if constexpr (!std::is_const_v<Tools>)
    for (std::size_t k = 0; k < tools.size(); ++k) tools[k].state = states.at(k);
}

// Their number is the case's; a case without any has no such arrays.
template <class Visitor, class Groups>
void visit_prescribed(Visitor& visit, Groups& groups) {
  if (groups.empty()) return;
  std::vector<PrescribedState> states;
  for (const PrescribedNodes& group : groups) states.push_back(group.state);
  visit.structs("prescribed", states);
  if constexpr (!std::is_const_v<Groups>)
    for (std::size_t k = 0; k < groups.size(); ++k) groups[k].state = states.at(k);
}

/// The list.
template <class Visitor, class Run>
void visit_persistent(Visitor visit, Run& s) {
  visit_nodal_fields(s.nodes, [&](const char* name, auto& field) { visit.plain(name, field); });
  visit.plain("topology.tet_nodes", s.topology.tet_nodes);
  visit.plain("topology.facet_state", s.topology.facet_state);
  visit.plain("topology.vertex_of_node", s.topology.vertex_of_node);
  visit.structs("cracks.records", s.cracks.records);
  visit.plain("cracks.record_offsets", s.cracks.record_offsets);
  visit.structs("cracks.faces", s.cracks.faces);
  visit.structs("cracks.losses", s.cracks.losses_of_vertex);
  visit.plain("cracks.vertices", s.cracks.vertices);
  visit.plain("contact.fragment_of_tet", s.contact.fragment_of_tet);
  visit.plain("contact.free_faces", s.contact.free_faces);
  visit.plain("contact.surface_nodes.offsets", s.contact.surface_nodes.offsets);
  visit.plain("contact.surface_nodes.items", s.contact.surface_nodes.items);
  visit.plain("contact.travel", s.contact.travel);
  visit.plain("contact.margin", s.contact.margin);
  visit.structs("contact.candidates", s.contact.candidates);
  visit.structs("contact.touches", s.contact.touches);
  visit.structs("contact.contacts", s.contact.contacts);
  visit.structs("rigid.bodies", s.rigid.bodies);
  visit.plain("rigid.body_of_node", s.rigid.body_of_node);
  visit.plain("rigid.body_of_tet", s.rigid.body_of_tet);
  visit.plain("rigid.node_offsets", s.rigid.nodes_of_body.offsets);
  visit.plain("rigid.nodes", s.rigid.nodes_of_body.items);
  visit.plain("rigid.place", s.rigid.place);
  visit.plain("rigid.approach", s.rigid.approach);
  visit.plain("rigid.push", s.rigid.push);
  visit.plain("freezing.last_change", s.freezing.last_change);
  visit.plain("freezing.noted_damage", s.freezing.noted_damage);
  visit.plain("freezing.lets_go", s.freezing.lets_go);
  visit_single(visit, "freezing", s.freezing);
  visit_single(visit, "branch", s.elastic.branch);
  visit_single(visit, "clock", s.clock);
  visit_single(visit, "totals", s.totals);
  visit_tools(visit, s.tools);
  visit_prescribed(visit, s.prescribed);
  visit_single(visit, "gravity", s.totals.gravity);
  visit_single(visit, "force_watch", s.totals.force_watch);
  visit_single(visit, "ledger", s.ledger);
  visit_single(visit, "last_good_ledger", s.last_good_ledger);
}

// Of all that a run starts from and that decides how it goes on.
std::string case_hash(const Simulation& s) {
  StateHash hash;
  for (const Vec3& x : s.reference.vertices) hash.add_bytes(x.data(), 3 * sizeof(double));
  hash.add(s.topology.tet_vertices);
  hash.add(s.reference.facet_strength);
  hash.add(s.reference.bonds.strength);
  hash.add(s.reference.bonds.stiffness);
  hash.add(s.reference.fracture_energy);
  const SimulationOptions& o = s.options;
  for (std::size_t p = 0; p < o.particles.size(); ++p) {
    const ParticleOptions& particle = o.particles[p];
    const CohesiveLaw& law = s.reference.laws[p];
    hash.add(std::vector{particle.young_modulus, particle.poisson_ratio, particle.density, particle.viscous_ratio,
                         particle.relaxation_time, particle.friction, law.beta, law.kappa, law.internal_friction,
                         law.sliding_friction, static_cast<double>(law.softening_friction), particle.velocity.x(),
                         particle.velocity.y(), particle.velocity.z(), particle.spin.x(), particle.spin.y(),
                         particle.spin.z()});
  }
  hash.add(s.reference.particle_of_tet);
  hash.add(std::vector{o.step_safety, o.gravity.x(), o.gravity.y(), o.gravity.z()});
  for (const ToolOptions& tool : o.tools) hash.add(defining_numbers(tool));
  for (const PrescribedOptions& group : o.prescribed) hash.add(defining_numbers(group));
  const RigidFragmentOptions& r = o.rigid_fragments;
  hash.add(std::vector{r.enabled ? 1.0 : 0.0, r.whole ? 1.0 : 0.0, r.quiet_crossings,
                       static_cast<double>(r.quiet_steps), r.noticeable_damage, r.strain_share, r.vibration_share,
                       r.loss_share, r.approach_share, r.load_share, o.restitution});
  hash.add(std::vector{o.insertion_interval, o.label_interval, o.ledger_interval, o.impulse_sweeps, o.contact_interval,
                       o.contact_sweeps});
  return hash.hex();
}

void restore_bulk(Simulation& s, const Reader& reader) {
  std::vector<Index> asleep, active, all_tets(at(s.topology.num_tets()));
  std::iota(all_tets.begin(), all_tets.end(), 0);
  reader.plain("bulk.sleeping_tets", asleep);
  std::set_difference(all_tets.begin(), all_tets.end(), asleep.begin(), asleep.end(), std::back_inserter(active));
  refresh_elastic_force(s.elastic, s.topology, all_tets);
  set_active_tets(s.elastic, s.topology, s.reference.vertices, active);
  std::vector<std::array<double, 6>> metrics;
  reader.plain("branch.relaxed_metric", metrics);
  set_relaxed_metrics(s.elastic, metrics);
}

}  // namespace

Checkpoint make_checkpoint(const Simulation& s) {
  Checkpoint checkpoint;
  visit_persistent(Writer{checkpoint}, s);
  checkpoint.doubles["scalars"] = {s.cracks.cracked_area,        static_cast<double>(s.cracks.last_damage_step),
                                   s.contact.dissipated,         static_cast<double>(s.contact.fragments),
                                   s.contact.frame_velocity.x(), s.contact.frame_velocity.y(),
                                   s.contact.frame_velocity.z()};
  Writer writer{checkpoint};
  writer.plain("bulk.sleeping_tets", sleeping_tets(s.elastic));
  writer.plain("branch.relaxed_metric", relaxed_metrics(s.elastic));
  checkpoint.texts["case"] = case_hash(s);
  return checkpoint;
}

void restore_checkpoint(Simulation& s, const Checkpoint& checkpoint) {
  const auto from = checkpoint.texts.find("case");
  if (from == checkpoint.texts.end() || from->second != case_hash(s))
    throw InputError("checkpoint: it was taken of another case; resume with the mesh and the values it belongs to");
  const Reader reader{checkpoint};
  visit_persistent(reader, s);
  std::vector<double> scalars;
  reader.plain("scalars", scalars);
  s.cracks.cracked_area = scalars.at(0);
  s.cracks.last_damage_step = static_cast<std::int64_t>(scalars.at(1));
  s.contact.dissipated = scalars.at(2);
  s.contact.fragments = static_cast<Index>(scalars.at(3));
  s.contact.frame_velocity = {scalars.at(4), scalars.at(5), scalars.at(6)};
  for (Index slot = 0; slot < to_index(s.cracks.faces.size()); ++slot)
    s.cracks.face_of_facet[at(s.cracks.faces[at(slot)].facet)] = slot;
  list_awake_faces(s.cracks);
  group_records(s.cracks);
  restore_bulk(s, reader);
}

std::string state_hash(const Simulation& s) {
  const Checkpoint checkpoint = make_checkpoint(s);
  StateHash hash;
  const auto add_all = [&hash](const auto& arrays) {
    for (const auto& [name, values] : arrays) {
      hash.add_bytes(name.data(), name.size());
      hash.add(values);
    }
  };
  add_all(checkpoint.doubles);
  add_all(checkpoint.ints);
  add_all(checkpoint.bytes);
  return hash.hex();
}

}  // namespace knap
