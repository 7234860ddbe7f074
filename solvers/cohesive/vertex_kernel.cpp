#include "cohesive/vertex_kernel.hpp"

#include <algorithm>
#include <cstddef>

#include "core/choose_targets-inl.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cohesive/vertex_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "cohesive/ask_ahead-inl.hpp"
#include "cohesive/impulse_law-inl.hpp"
#include "cohesive/lane_rows-inl.hpp"

#ifndef KNAP_COHESIVE_VERTEX_KERNEL_ONCE
#define KNAP_COHESIVE_VERTEX_KERNEL_ONCE
namespace knap {
// The rows of four doubles that the kernels read and write.
static_assert(offsetof(CrackRecord, d_max) == 24 && offsetof(CrackRecord, strength) == 32);
static_assert(offsetof(CrackRecord, delta_c) == 40 && offsetof(CrackRecord, node_b) == 56);
static_assert(offsetof(CrackRecord, regime) == 61 && offsetof(CrackRecord, local_a) == 62 && sizeof(CrackRecord) == 64);
static_assert(offsetof(CrackFace, normal) == 0 && offsetof(CrackFace, couple) == 32 && sizeof(CrackFace) == 256);
static_assert(offsetof(CrackFace, rotation) == 192 && offsetof(CrackFace, centre) == 224);

inline constexpr Index doubles_per_node = sizeof(NodeRow) / sizeof(double);
inline constexpr Index local_v = offsetof(NodeRow, v) / sizeof(double);
inline constexpr Index local_v_before = offsetof(NodeRow, v_before) / sizeof(double);
}  // namespace knap
#endif

HWY_BEFORE_NAMESPACE();
namespace knap {
namespace HWY_NAMESPACE {

HWY_INLINE Vec3V where(M mask, const Vec3V& a) {
  return {hn::IfThenElseZero(mask, a.x), hn::IfThenElseZero(mask, a.y), hn::IfThenElseZero(mask, a.z)};
}
HWY_INLINE Rows rows(const Vec3V& a) { return rows(Columns{a.x, a.y, a.z, zero()}); }

HWY_INLINE V load(const LaneValues& values, Index lane0) { return hn::LoadU(Tag(), values.data() + lane0); }
HWY_INLINE void store(V v, LaneValues& values, Index lane0) { hn::StoreU(v, Tag(), values.data() + lane0); }
HWY_INLINE Vec3V load(const LaneVector& values, Index lane0) {
  return {load(values[0], lane0), load(values[1], lane0), load(values[2], lane0)};
}
HWY_INLINE void store(const Vec3V& v, LaneVector& values, Index lane0) {
  store(v.x, values[0], lane0);
  store(v.y, values[1], lane0);
  store(v.z, values[2], lane0);
}

/// One vector of lanes of a group.
struct Lanes {
  const ImpulseView& view;
  const ImpulseCoefficients& k;
  const RecordGroup& group;
  ImpulseWorkspace& workspace;
  Index lane0;

  double* local() const { return workspace.nodes.data()->x[0].data() + 4 * lane0; }
  const RecordSlots& slots(Index i) const { return view.groups->slots[at(group.first_slots + i)]; }
  const Index* nodes(Index n) const { return view.groups->nodes[at(group.first_nodes + n)].data() + lane0; }
};

inline constexpr int log_row = 5, log_record = 6;

HWY_INLINE auto local_rows(const Lanes& l, const PerLane<std::uint16_t>& offsets, Index field) {
  return [base = l.local() + field, o = offsets.data() + l.lane0](Index lane)
             HWY_ATTR { return base + o[lane] + 4 * lane; };
}

// Nodes into the local rows.
HWY_INLINE void load_nodes(const Lanes& l) {
  for (Index n = 0; n < l.group.num_nodes; ++n) {
    const auto nodes = load_indices(l.nodes(n));
    const Vec4& idle = l.workspace.idle_node;
    double* local = l.local() + n * doubles_per_node;
    const auto to = [=](Index field) HWY_ATTR { return [=](Index lane) HWY_ATTR { return local + field + 4 * lane; }; };
    Columns x = columns(load_rows(addresses<log_row>(l.view.x, nodes, &idle)));
    x.w = hn::Div(number(1.0), hn::GatherIndex(Tag(), l.view.mass, hn::Max(nodes, hn::Zero(Word()))));
    store_rows(rows(x), to(0));
    store_rows(load_rows(addresses<log_row>(l.view.v, nodes, &idle)), to(local_v));
    store_rows(load_rows(addresses<log_row>(l.view.v_before, nodes, &idle)), to(local_v_before));
  }
}

// The new velocities to memory; v_before becomes the mean velocity of the step.
HWY_INLINE void store_nodes(const Lanes& l) {
  for (Index n = 0; n < l.group.num_nodes; ++n) {
    double* local = l.local() + n * doubles_per_node;
    store_rows(load_rows([=](Index lane) HWY_ATTR { return local + local_v + 4 * lane; }),
               addresses<log_row>(l.view.v, load_indices(l.nodes(n)), &l.workspace.idle_node));
    for (Index i = 0; i < 4 * width; i += width) {
      const V both = hn::Add(hn::LoadU(Tag(), local + local_v + i), hn::LoadU(Tag(), local + local_v_before + i));
      hn::StoreU(hn::Mul(number(0.5), both), Tag(), local + local_v_before + i);
    }
  }
}

/// Records of the lanes as they lie in memory.
struct Gathered {
  Vec3V impulse, normal;
  V d_max, strength, delta_c, action;
  V face_and_a, b_and_rest;  // the bits of face, node_a; node_b, corner, regime, local_a, local_b
  M open, virgin, failed;
};

HWY_INLINE Gathered gather(const Addresses& records, const Addresses& faces) {
  const Columns first = columns(load_rows(records)), second = columns(load_rows(Shifted<4>{records}));
  const Columns face = columns(load_rows(faces));
  const hn::RebindToUnsigned<Tag> bits;
  const auto word = hn::BitCast(bits, second.w);
  const auto byte = hn::Set(bits, 0xFF);
  const auto regime = hn::And(hn::ShiftRight<40>(word), byte);
  const auto is = [&](RecordRegime r) HWY_ATTR {
    return hn::RebindMask(Tag(), hn::Eq(regime, hn::Set(bits, static_cast<std::uint64_t>(r))));
  };
  const M open = hn::RebindMask(Tag(), hn::Ne(hn::And(hn::ShiftRight<48>(word), byte), hn::ShiftRight<56>(word)));
  return {first.xyz(),
          face.xyz(),
          first.w,
          second.x,
          second.y,
          face.w,
          second.z,
          second.w,
          open,
          is(RecordRegime::Virgin),
          is(RecordRegime::Failed)};
}

// First rows of the faces whose couples lie at these rows.
HWY_INLINE hn::Vec<Word> face_rows(hn::Vec<Word> couples) {
  return hn::And(couples, hn::Set(Word(), ~std::int64_t{rows_per_face - 1}));
}

HWY_INLINE M is_rotating(V action) {
  return hn::Or(hn::Gt(action, zero()), hn::Eq(action, number(face_action::ends_and_rotates)));
}

// The indices of the lanes in the mask, none elsewhere.
HWY_INLINE hn::Vec<Word> only(M mask, hn::Vec<Word> indices) {
  return hn::IfThenElse(hn::RebindMask(Word(), mask), indices, hn::Set(Word(), none));
}

/// Rotation velocities of nodes a and b, zero where the face is the idle one.
struct Spin {
  Vec3V a, b;
};
HWY_INLINE Spin rotation_velocities(const Addresses& faces, const Vec3V& xa, const Vec3V& xb) {
  const Vec3V rotation = columns(load_rows(Shifted<4 * rotation_row>{faces})).xyz();
  const Vec3V centre = columns(load_rows(Shifted<4 * rotation_row + 4>{faces})).xyz();
  return {cross(rotation, difference(xa, centre)), cross(rotation, difference(xb, centre))};
}

// Marks in records and faces what has changed its regime.
HWY_INLINE void note_regimes(const Lanes& l, const RecordSlots& slots, M leaves_virgin, M fails) {
  std::uint8_t leaving[8] = {}, failing[8] = {};
  hn::StoreMaskBits(Tag(), leaves_virgin, leaving);
  hn::StoreMaskBits(Tag(), fails, failing);
  for (Index lane = 0; lane < width; ++lane) {
    if (!(((leaving[0] | failing[0]) >> lane) & 1)) continue;
    CrackRecord& record = l.view.records[slots.record[at(l.lane0 + lane)]];
    if ((leaving[0] >> lane) & 1) record.regime = RecordRegime::Softening;
    if (!((failing[0] >> lane) & 1)) continue;
    record.regime = RecordRegime::Failed;
    l.view.faces[record.face].failed[record.corner] = 1;
  }
}

// Raises d_max to the present opening and books what that spends where the records soften.
HWY_INLINE V grow_damage(const ImpulseCoefficients& k, const Gathered& g, M alive, const Opening& o, V energy2,
                         Spent& spent) {
  const V shear2 = number(k.law.beta / k.law.kappa * (k.law.beta / k.law.kappa));
  const V mode = number(k.law.beta * k.law.beta / k.law.kappa);
  const V d2 = hn::MulAdd(shear2, o.tangential2, hn::Mul(o.opening, o.opening));
  const M grows = hn::And(alive, hn::Gt(d2, hn::Mul(g.d_max, g.d_max)));
  const V reached = hn::Min(hn::Sqrt(d2), g.delta_c);
  const V grown = hn::IfThenElseZero(grows, hn::Max(zero(), hn::Sub(reached, g.d_max)));
  const M softens = hn::AndNot(hn::Or(g.virgin, g.failed), grows);
  const V rate = hn::IfThenElseZero(softens, hn::Div(hn::Mul(hn::Mul(number(0.5), g.strength), grown), d2));
  spent.cohesive = hn::MulAdd(rate, energy2, spent.cohesive);
  spent.cohesive_shear = hn::MulAdd(rate, hn::Mul(mode, o.tangential2), spent.cohesive_shear);
  return hn::IfThenElse(grows, reached, g.d_max);
}

/// State after the damage of this step.
struct Advanced {
  V d_max;
  M virgin;
  Vec3V secant_impulse;
};

HWY_INLINE Advanced advance(const Lanes& l, Index i, const Gathered& g, M acting, const Vec3V& jump, V inverse_mass_sum,
                            const Opening& o, Spent& spent) {
  const RecordRow& row = l.workspace.rows[at(i)];
  const ImpulseCoefficients& k = l.k;
  const V mode = number(k.law.beta * k.law.beta / k.law.kappa);
  const M alive = hn::AndNot(g.failed, acting);
  const V energy2 = hn::MulAdd(mode, o.tangential2, hn::Mul(o.opening, o.opening));
  const V d_max = grow_damage(k, g, alive, o, energy2, spent);
  const V virgin_limit = hn::Mul(hn::Mul(number(k.virgin_factor), g.strength), inverse_mass_sum);
  const M leaves_virgin = hn::And(hn::And(alive, g.virgin), hn::Gt(d_max, virgin_limit));
  const M fails = hn::And(alive, hn::Ge(d_max, g.delta_c));
  const M virgin = hn::AndNot(hn::Or(leaves_virgin, fails), g.virgin);
  const M softening = hn::AndNot(hn::Or(virgin, fails), alive);
  if (!hn::AllFalse(Tag(), hn::Or(leaves_virgin, fails))) note_regimes(l, l.slots(i), leaves_virgin, fails);
  const V one = number(1.0);
  const V stiffness = hn::Max(zero(), hn::Mul(g.strength, hn::Sub(hn::Div(one, d_max), hn::Div(one, g.delta_c))));
  const V along = hn::NegMulAdd(mode, o.normal, o.opening);  // <jn> n + mode (j - jn n)
  const V pull = hn::Neg(hn::Mul(number(k.dt), stiffness));
  const Vec3V stretch = scaled_sum(along, g.normal, scaled(mode, jump));
  const Vec3V secant = where(softening, scaled(pull, stretch));
  const M books = hn::And(leaves_virgin, softening);
  if (!hn::AllFalse(Tag(), books)) {
    // The impulses of the virgin phase paid for the whole opening; from now on the state pays for the recoverable part,
    // and the half step from the last opening to this one is not in any sum yet.
    const Vec3V slip = difference(columns(load_rows(local_rows(l, row.b, local_v_before))).xyz(),
                                  columns(load_rows(local_rows(l, row.a, local_v_before))).xyz());
    const V paid = hn::MulAdd(stiffness, energy2, dot(secant, slip));
    spent.cohesive = hn::Sub(spent.cohesive, hn::IfThenElseZero(books, hn::Mul(number(0.5), paid)));
  }
  return {d_max, virgin, secant};
}

HWY_INLINE void set_local_offsets(const Lanes& l, const RecordSlots& slots, RecordRow& row) {
  const hn::CappedTag<std::uint16_t, std::size_t{group_lanes}> d;
  const auto size = hn::Set(d, static_cast<std::uint16_t>(doubles_per_node));
  for (std::size_t i = at(l.lane0); i < at(l.lane0 + width); i += hn::MaxLanes(d)) {
    hn::StoreU(hn::Mul(hn::LoadU(d, slots.a.data() + i), size), d, row.a.data() + i);
    hn::StoreU(hn::Mul(hn::LoadU(d, slots.b.data() + i), size), d, row.b.data() + i);
  }
}

// Prepares a row and applies the rotations, the impulses of the last step and the secant forces.
HWY_INLINE void start_row(const Lanes& l, Index i, Spent& spent) {
  RecordRow& row = l.workspace.rows[at(i)];
  const Index lane0 = l.lane0;
  const RecordSlots& slots = l.slots(i);
  set_local_offsets(l, slots, row);
  const auto face_indices = face_rows(load_indices(slots.couple.data() + lane0));
  const Addresses faces = addresses<log_row>(l.view.faces, face_indices, &l.workspace.idle_face);
  const Gathered g =
      gather(addresses<log_record>(l.view.records, load_indices(slots.record.data() + lane0), &l.workspace.idle_record),
             faces);
  const Columns xa = columns(load_rows(local_rows(l, row.a, 0))), xb = columns(load_rows(local_rows(l, row.b, 0)));
  const M ended = hn::Lt(g.action, zero());
  const M acting = hn::AndNot(ended, g.open);
  const Vec3V jump = difference(xb.xyz(), xa.xyz());
  const Opening o = opening_of(jump, g.normal);
  const V inverse_mass_sum = hn::Add(xa.w, xb.w);
  const V one = number(1.0);
  const V effective_mass = hn::IfThenElseZero(acting, hn::Div(one, inverse_mass_sum));
  store(g.normal, row.normal, lane0);
  store(jump, row.jump, lane0);
  store(xa.w, row.inverse_mass_a, lane0);
  store(xb.w, row.inverse_mass_b, lane0);
  store(effective_mass, row.effective_mass, lane0);
  const V closing_impulse = hn::Mul(effective_mass, hn::Mul(o.opening, number(1.0 / l.k.dt)));
  store(closing_impulse, row.closing_impulse, lane0);
  const Advanced now = advance(l, i, g, acting, jump, inverse_mass_sum, o, spent);
  const Resistance r = resistance(l.k, hn::And(acting, now.virgin), g.strength, now.d_max, g.delta_c);
  store(now.d_max, row.d_max, lane0);
  store(now.secant_impulse, row.secant_impulse, lane0);
  store(r.shear_capacity, row.shear_capacity, lane0);
  store(r.friction, row.friction, lane0);
  store(hn::IfThenElseZero(now.virgin, one), row.virgin, lane0);
  const Vec3V impulse = admissible(g.normal, number(l.k.law.beta), number(1.0 / l.k.law.beta), r, closing_impulse,
                                   where(acting, g.impulse));
  store(impulse, row.impulse, lane0);
  const Vec3V total = sum(impulse, now.secant_impulse);
  Vec3V change_a = scaled(hn::Neg(xa.w), total), change_b = scaled(xb.w, total);
  const M rotating = is_rotating(g.action);
  row.rotates = !hn::AllFalse(Tag(), rotating);
  if (row.rotates) {
    const Spin spin = rotation_velocities(
        addresses<log_row>(l.view.faces, only(rotating, face_indices), &l.workspace.idle_face), xa.xyz(), xb.xyz());
    store(scaled(hn::Div(one, xa.w), spin.a), l.workspace.spins[at(i)].a, lane0);
    store(scaled(hn::Div(one, xb.w), spin.b), l.workspace.spins[at(i)].b, lane0);
    change_a = sum(change_a, spin.a);
    change_b = sum(change_b, spin.b);
  }
  // One after the other: at a closed tip both are the same node.
  const auto a = local_rows(l, row.a, local_v), b = local_rows(l, row.b, local_v);
  store_rows(add(load_rows(a), rows(change_a)), a);
  store_rows(add(load_rows(b), rows(change_b)), b);
}

HWY_INLINE void relax_row(const Lanes& l, RecordRow& row, V beta, V inverse_beta) {
  const auto at_a = local_rows(l, row.a, local_v), at_b = local_rows(l, row.b, local_v);
  const Columns a = columns(load_rows(at_a)), b = columns(load_rows(at_b));
  const Vec3V n = load(row.normal, l.lane0), last = load(row.impulse, l.lane0);
  const V mass = load(row.effective_mass, l.lane0);
  const Vec3V trial = difference(last, scaled(mass, difference(b.xyz(), a.xyz())));
  const Resistance resistance{load(row.shear_capacity, l.lane0), load(row.friction, l.lane0)};
  const Vec3V impulse = admissible(n, beta, inverse_beta, resistance, load(row.closing_impulse, l.lane0), trial);
  store(impulse, row.impulse, l.lane0);
  const Vec3V change = difference(impulse, last);
  const Vec3V new_a = scaled_sum(hn::Neg(load(row.inverse_mass_a, l.lane0)), change, a.xyz());
  const Vec3V new_b = scaled_sum(load(row.inverse_mass_b, l.lane0), change, b.xyz());
  store_rows(rows(new_a), at_a);
  store_rows(rows(new_b), at_b);
}

// Work taken from the bodies by rotations: momenta that they add, mean velocities.
HWY_INLINE void book_rotations(const Spin& momentum, const Vec3V& mean_a, const Vec3V& mean_b, Spent& spent) {
  spent.friction = hn::Sub(spent.friction, dot(momentum.a, mean_a));
  spent.friction = hn::Sub(spent.friction, dot(momentum.b, mean_b));
}

// Impulses, damage and couples back to memory; books the row.
HWY_INLINE void finish_row(const Lanes& l, Index i, Spent& spent) {
  const Index lane0 = l.lane0;
  const RecordRow& row = l.workspace.rows[at(i)];
  const RecordSlots& slots = l.slots(i);
  const Vec3V impulse = load(row.impulse, lane0);
  store_rows(
      rows(Columns{impulse.x, impulse.y, impulse.z, load(row.d_max, lane0)}),
      addresses<log_record>(l.view.records, load_indices(slots.record.data() + lane0), &l.workspace.idle_record));
  const Addresses couples =
      addresses<log_row>(l.view.faces, load_indices(slots.couple.data() + lane0), &l.workspace.idle_face);
  const Vec3V total = sum(impulse, load(row.secant_impulse, lane0));
  store_rows(add(load_rows(couples), rows(cross(load(row.jump, lane0), total))), couples);
  const Vec3V mean_a = columns(load_rows(local_rows(l, row.a, local_v_before))).xyz();
  const Vec3V mean_b = columns(load_rows(local_rows(l, row.b, local_v_before))).xyz();
  book_impulses({load(row.normal, lane0), impulse, load(row.shear_capacity, lane0), load(row.friction, lane0),
                 hn::Gt(load(row.virgin, lane0), zero())},
                difference(mean_b, mean_a), spent);
  if (!row.rotates) return;
  const SpinRow& spin = l.workspace.spins[at(i)];
  book_rotations({load(spin.a, lane0), load(spin.b, lane0)}, mean_a, mean_b, spent);
}

HWY_INLINE void store_step_losses(const ImpulseView& view, const Index* vertices, const Spent& spent) {
  HWY_ALIGN double value[3][width];
  hn::Store(spent.separation, Tag(), value[0]);
  hn::Store(spent.closure, Tag(), value[1]);
  hn::Store(spent.friction, Tag(), value[2]);
  for (Index lane = 0; lane < width; ++lane) {
    const Index vertex = vertices[lane];
    if (vertex != none) view.step_losses[vertex] = {value[0][lane], value[1][lane], value[2][lane], 0.0};
  }
}

HWY_INLINE void add_damage_losses(const Lanes& l, const Spent& spent) {
  HWY_ALIGN double value[2][width];
  hn::Store(spent.cohesive, Tag(), value[0]);
  hn::Store(spent.cohesive_shear, Tag(), value[1]);
  for (Index lane = 0; lane < width; ++lane) {
    const Index vertex = l.group.vertex[at(l.lane0 + lane)];
    if (vertex == none) continue;
    l.view.losses[vertex].cohesive += value[0][lane];
    l.view.losses[vertex].cohesive_shear += value[1][lane];
  }
}

HWY_INLINE void solve_lanes(const Lanes& l, const NextGroup& next) {
  const V beta = number(l.k.law.beta), inverse_beta = number(1.0 / l.k.law.beta);
  Spent spent = nothing_spent();
  load_nodes(l);
  for (Index i = 0; i < l.group.num_slots; ++i) {
    next.ask_for_records(i);
    start_row(l, i, spent);
  }
  for (int sweep = 0; sweep < l.k.sweeps; ++sweep)
    for (Index i = 0; i < l.group.num_slots; ++i) {
      if (sweep == 0) next.ask_for_nodes(i);
      relax_row(l, l.workspace.rows[at(i)], beta, inverse_beta);
    }
  store_nodes(l);
  for (Index i = 0; i < l.group.num_slots; ++i) {
    next.ask_for_couples(i);
    finish_row(l, i, spent);
  }
  add_damage_losses(l, spent);
  store_step_losses(l.view, l.group.vertex.data() + l.lane0, spent);
}

void SolveGroups(const ImpulseView& view, const ImpulseCoefficients* k, Index first, Index last,
                 ImpulseWorkspace& workspace) {
  const std::vector<RecordGroup>& groups = view.groups->groups;
  for (Index g = first; g < last; ++g) {
    const RecordGroup* next = at(g) + 1 < groups.size() ? &groups[at(g) + 1] : nullptr;
    for (Index lane0 = 0; lane0 < group_lanes; lane0 += width)
      solve_lanes({view, k[groups[at(g)].law], groups[at(g)], workspace, lane0}, {view, lane0 == 0 ? next : nullptr});
  }
}

// The nodes of records, from the bits that tell them.
HWY_INLINE hn::Vec<Word> upper_half(V word) { return hn::ShiftRight<32>(hn::BitCast(Word(), word)); }
HWY_INLINE hn::Vec<Word> lower_half(V word) { return hn::ShiftRight<32>(hn::ShiftLeft<32>(hn::BitCast(Word(), word))); }

HWY_INLINE Vec3V mean_velocity(const ImpulseView& view, hn::Vec<Word> nodes, const Vec4& idle) {
  const Vec3V v = columns(load_rows(addresses<log_row>(view.v, nodes, &idle))).xyz();
  const Vec3V v_before = columns(load_rows(addresses<log_row>(view.v_before, nodes, &idle))).xyz();
  return scaled(number(0.5), sum(v, v_before));
}

/// Momentum that the rotations have given to one node of each record.
HWY_INLINE Spin rotation_momenta(const ImpulseView& view, const Addresses& faces, hn::Vec<Word> a, hn::Vec<Word> b,
                                 const Vec4& idle) {
  const Spin spin = rotation_velocities(faces, columns(load_rows(addresses<log_row>(view.x, a, &idle))).xyz(),
                                        columns(load_rows(addresses<log_row>(view.x, b, &idle))).xyz());
  const auto mass = [&](hn::Vec<Word> nodes)
                        HWY_ATTR { return hn::GatherIndex(Tag(), view.mass, hn::Max(nodes, hn::Zero(Word()))); };
  return {scaled(mass(a), spin.a), scaled(mass(b), spin.b)};
}

// Books the records numbered i of the vertices.
HWY_INLINE void book_row(const ImpulseView& view, const ImpulseCoefficients& k, const Index* records,
                         ImpulseWorkspace& workspace, Spent& spent) {
  const auto record_indices = load_indices(records);
  const Addresses at_records = addresses<log_record>(view.records, record_indices, &workspace.idle_record);
  HWY_ALIGN Index face_of_record[width];
  for (Index lane = 0; lane < width; ++lane)
    face_of_record[lane] = records[lane] == none ? none : view.records[records[lane]].face;
  const auto face_indices = load_indices(face_of_record);
  const Addresses faces = addresses<log_row + 3>(view.faces, face_indices, &workspace.idle_face);
  const Gathered g = gather(at_records, faces);
  const auto a = upper_half(g.face_and_a), b = lower_half(g.b_and_rest);
  const Vec3V mean_a = mean_velocity(view, a, workspace.idle_node),
              mean_b = mean_velocity(view, b, workspace.idle_node);
  const Resistance r = resistance(k, g.virgin, g.strength, g.d_max, g.delta_c);
  book_impulses({g.normal, g.impulse, r.shear_capacity, r.friction, g.virgin}, difference(mean_b, mean_a), spent);
  const M rotating = is_rotating(g.action);
  if (hn::AllFalse(Tag(), rotating)) return;
  const Addresses rotating_faces =
      addresses<log_row + 3>(view.faces, only(rotating, face_indices), &workspace.idle_face);
  book_rotations(rotation_momenta(view, rotating_faces, a, b, workspace.idle_node), mean_a, mean_b, spent);
}

void BookVertices(const ImpulseView& view, const ImpulseCoefficients& k, std::span<const Index> vertices,
                  ImpulseWorkspace& workspace) {
  PerLane<Index> vertex;
  vertex.fill(none);
  std::copy(vertices.begin(), vertices.end(), vertex.begin());
  for (const Index v : vertices) prefetch_records_of(view, v);
  for (const Index v : vertices) prefetch_surroundings_of(view, v);
  for (Index lane0 = 0; lane0 < group_lanes; lane0 += width) {
    Spent spent = nothing_spent();
    bool any = true;
    for (Index i = 0; any; ++i) {
      HWY_ALIGN Index records[width];
      any = false;
      for (Index lane = 0; lane < width; ++lane) {
        const Index v = vertex[at(lane0 + lane)];
        const Index r = v == none ? none : view.record_offsets[v] + i;
        const bool idle = v == none || r >= view.record_offsets[v + 1];
        records[lane] = idle || (view.any_sleeps && view.faces[view.records[r].face].sleeps) ? none : r;
        any |= !idle;
      }
      if (any) book_row(view, k, records, workspace, spent);
    }
    store_step_losses(view, vertex.data() + lane0, spent);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace knap
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace knap {

HWY_EXPORT(SolveGroups);
HWY_EXPORT(BookVertices);

void solve_groups(const ImpulseView& view, const ImpulseCoefficients* k, Index first, Index last,
                  ImpulseWorkspace& workspace) {
  const std::size_t slots = at(view.groups->max_slots), nodes = at(view.groups->max_nodes);
  if (workspace.rows.size() < slots) workspace.rows.resize(slots);
  if (workspace.spins.size() < slots) workspace.spins.resize(slots);
  if (workspace.nodes.size() < nodes) workspace.nodes.resize(nodes);
  HWY_DYNAMIC_DISPATCH(SolveGroups)(view, k, first, last, workspace);
}
void book_vertices(const ImpulseView& view, const ImpulseCoefficients& k, std::span<const Index> vertices,
                   ImpulseWorkspace& workspace) {
  HWY_DYNAMIC_DISPATCH(BookVertices)(view, k, vertices, workspace);
}

}  // namespace knap
#endif
