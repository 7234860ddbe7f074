#include "contact/contact_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "contact/tet_overlap.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index candidates_per_block = 1024;
constexpr Index pairs_per_block = 64;
// Of the gap between two tets, what their way towards each other may use up until the next look; the rest is for
// round-off.
constexpr double part_of_gap = 0.999;
// A patch below this share of the square of a tet's height is a touch within round-off, without direction. A corner
// makes such a patch at a depth of 1e-5 of the height.
constexpr double smallest_patch = 1e-10;
// Patches of the same two fragments nearer than this share of a tet's height belong to the same touch.
constexpr double reach_of_touch = 0.5;
// Where the patches of a touch cancel to less than this share of their size (a plate pierced), each stands alone.
constexpr double least_direction = 0.1;
// While the ways of two deformable fragments together are below this share of a tet's height, their patch is kept.
constexpr double kept_patch = 0.02;
// A patch wider than this share of a tet's height carries a rigid body on several points.
constexpr double wide_patch = 0.02;

double least_height(const TetShape& shape) { return *std::min_element(shape.height.begin(), shape.height.end()); }

// The touch of a candidate if its tets overlap; sets when to look again.
bool narrow(const ContactState& contact, ContactCandidate& candidate, double travel, const ContactScene& scene,
            Touch& touch) {
  const auto& [first, second] = candidate.tets;
  const TetShape a = make_tet_shape(scene.topology.tet_nodes[at(first)], scene.x);
  const TetShape b = make_tet_shape(scene.topology.tet_nodes[at(second)], scene.x);
  if (!a.is_solid || !b.is_solid) return false;
  double gap = separation_by_faces(a, b);
  if (gap == 0.0) {
    touch.fragments = candidate.fragments;
    touch.carries_body = scene.rigid.of_tet(first) != none || scene.rigid.of_tet(second) != none;
    const OverlapPatch patch =
        overlap_patch(a, contact.free_faces[at(first)], b, contact.free_faces[at(second)], touch.carries_body != 0);
    touch.size = std::min(least_height(a), least_height(b));
    if (patch.size > smallest_patch * touch.size * touch.size) {
      touch.area = patch.area;
      touch.patch_size = patch.size;
      touch.corners = patch.corners;
      touch.weights = a.coordinates(patch.centre);
      if (touch.carries_body == 0) candidate.due = travel + kept_patch * touch.size;
      return true;
    }
    gap = separation_by_edges(a, b);  // the last to be asked, because it costs most
  }
  candidate.due = travel + part_of_gap * gap;
  return false;
}

// The candidates of a block that must be looked at now; returns their number.
Index collect_due(const ContactState& contact, Index block, std::span<Index> due) {
  const Index end = std::min(to_index(contact.candidates.size()), (block + 1) * candidates_per_block);
  Index count = 0;
  for (Index i = block * candidates_per_block; i < end; ++i) {
    const ContactCandidate& candidate = contact.candidates[at(i)];
    due[at(count)] = i;
    count += candidate.due <= contact.travel[at(candidate.fragments[0])] + contact.travel[at(candidate.fragments[1])];
  }
  return count;
}

// What candidates need lies anywhere in memory: asked for ahead, first corners, then their positions. Inlined because
// GCC takes a function that only prefetches for one without effect.
[[gnu::always_inline]] inline void prefetch_candidate(const ContactState& contact, const Topology& topology,
                                                      std::span<const Vec4> x, std::span<const Index> due, Index i) {
  constexpr Index far = 8, near = 4;
  if (i + far >= to_index(due.size())) return;
  for (const Index tet : contact.candidates[at(due[at(i + far)])].tets)
    __builtin_prefetch(&topology.tet_nodes[at(tet)]);
  for (const Index tet : contact.candidates[at(due[at(i + near)])].tets)
    for (const Index node : topology.tet_nodes[at(tet)]) __builtin_prefetch(&x[at(node)]);
}

// Those looked at now, in the order of the candidates.
std::vector<Touch> new_touches(ContactState& contact, const ContactScene& scene, std::vector<std::uint8_t>& looked_at) {
  const Index count = to_index(contact.candidates.size());
  std::vector<std::vector<Touch>> found(at(num_blocks(count, candidates_per_block)));
  parallel_blocks(to_index(found.size()), [&](Index block) {
    std::array<Index, std::size_t{candidates_per_block}> due;
    const Index num_due = collect_due(contact, block, due);
    for (Index i = 0; i < num_due; ++i) {
      prefetch_candidate(contact, scene.topology, scene.x, std::span(due).first(at(num_due)), i);
      ContactCandidate& candidate = contact.candidates[at(due[at(i)])];
      looked_at[at(due[at(i)])] = 1;
      const double travel = contact.travel[at(candidate.fragments[0])] + contact.travel[at(candidate.fragments[1])];
      Touch touch;
      touch.candidate = due[at(i)];
      if (narrow(contact, candidate, travel, scene, touch)) found[at(block)].push_back(touch);
    }
  });
  std::vector<Touch> touches;
  for (const auto& part : found) touches.insert(touches.end(), part.begin(), part.end());
  return touches;
}

// Of the touches of the last step those stay that were not looked at.
void refresh_touches(ContactState& contact, const ContactScene& scene) {
  std::vector<std::uint8_t> looked_at(contact.candidates.size(), 0);
  const std::vector<Touch> added = new_touches(contact, scene, looked_at);
  std::erase_if(contact.touches, [&](const Touch& touch) { return looked_at[at(touch.candidate)] != 0; });
  std::vector<Touch> all;
  all.reserve(contact.touches.size() + added.size());
  std::merge(contact.touches.begin(), contact.touches.end(), added.begin(), added.end(), std::back_inserter(all),
             [](const Touch& a, const Touch& b) { return a.candidate < b.candidate; });
  contact.touches = std::move(all);
  parallel_for(to_index(contact.touches.size()), [&](Index i) {
    Touch& touch = contact.touches[at(i)];
    touch.centre = Vec3::Zero();
    const TetCorners& nodes = scene.topology.tet_nodes[at(contact.candidates[at(touch.candidate)].tets[0])];
    for (std::size_t k = 0; k < 4; ++k) touch.centre += touch.weights[k] * xyz(scene.x[at(nodes[k])]);
  });
}

// The patch's area as seen from the lower to the higher of its two fragments.
Vec3 ordered_area(const Touch& touch) {
  return touch.fragments[0] < touch.fragments[1] ? touch.area : Vec3(-touch.area);
}

std::array<Index, 2> ordered_fragments(const Touch& touch) {
  return {std::min(touch.fragments[0], touch.fragments[1]), std::max(touch.fragments[0], touch.fragments[1])};
}

// A corner or an edge that goes into another fragment belongs to several tets, which each see only a part of it: the
// direction is that of all parts together.
void set_normals(std::vector<Touch>& touches, std::span<const Index> same_fragments) {
  for (const Index i : same_fragments) {
    Touch& touch = touches[at(i)];
    const double reach = reach_of_touch * touch.size;
    Vec3 sum = Vec3::Zero();
    double size = 0.0;
    for (const Index k : same_fragments) {
      const Touch& other = touches[at(k)];
      if ((other.centre - touch.centre).squaredNorm() > reach * reach) continue;
      sum += ordered_area(other);
      size += other.patch_size;
    }
    if (sum.norm() < least_direction * size) sum = ordered_area(touch);
    if (touch.fragments[0] > touch.fragments[1]) sum = -sum;
    touch.normal = sum.norm() > 0.0 ? Vec3(sum.normalized()) : Vec3::Zero();
  }
}

void set_all_normals(std::vector<Touch>& touches) {
  std::vector<std::pair<std::array<Index, 2>, Index>> order;  // fragments and touch
  order.reserve(touches.size());
  for (std::size_t i = 0; i < touches.size(); ++i) order.emplace_back(ordered_fragments(touches[i]), to_index(i));
  std::sort(order.begin(), order.end());
  std::vector<Index> sorted;
  sorted.reserve(order.size());
  std::vector<Index> begins;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || order[i].first != order[i - 1].first) begins.push_back(to_index(i));
    sorted.push_back(order[i].second);
  }
  begins.push_back(to_index(order.size()));
  parallel_for(
      to_index(begins.size()) - 1,
      [&](Index group) {
        const Index begin = begins[at(group)];
        set_normals(touches, std::span(sorted).subspan(at(begin), at(begins[at(group + 1)] - begin)));
      },
      pairs_per_block);
}

ContactSide side_of(Index tet, const Vec3& place, const Topology& topology, std::span<const Vec4> x,
                    const RigidBodies& rigid) {
  ContactSide side;
  side.body = rigid.of_tet(tet);
  if (side.body != none) return side;
  side.nodes = topology.tet_nodes[at(tet)];
  side.weights = make_tet_shape(side.nodes, x).coordinates(place);
  return side;
}

void add_point(const ContactState& contact, const ContactScene& from, const Touch& touch, const Vec3& place,
               std::vector<Contact>& contacts) {
  Contact added;
  added.tets = contact.candidates[at(touch.candidate)].tets;
  const bool is_next = !contacts.empty() && contacts.back().tets == added.tets;
  added.point = static_cast<std::int8_t>(is_next ? contacts.back().point + 1 : 0);
  added.place = place;
  added.normal = touch.normal;
  for (std::size_t k = 0; k < 2; ++k) added.sides[k] = side_of(added.tets[k], place, from.topology, from.x, from.rigid);
  contacts.push_back(added);
}

void add_contacts(const ContactState& contact, const ContactScene& from, const Touch& touch,
                  std::vector<Contact>& contacts) {
  if (touch.normal.isZero(0.0)) return;
  const auto& corners = touch.corners;
  const double width = (corners[1] - corners[0]).norm();
  if (touch.carries_body != 0 && width > wide_patch * touch.size) {
    for (const Vec3& corner : corners) add_point(contact, from, touch, corner, contacts);
  } else {
    add_point(contact, from, touch, touch.centre, contacts);
  }
}

// The nodes of a body that may reach the tool in this step, at twice the speed of now, since others may push it.
void add_tool_contacts(const ContactScene& scene, Index body, Index tool, double reach,
                       std::vector<Contact>& contacts) {
  for (const Index node : scene.rigid.nodes_of_body[body]) {
    const Vec3 place = xyz(scene.x[at(node)]);
    const ToolProximity near = proximity(scene.tools[at(tool)], place);
    if (near.gap > reach) continue;
    Contact added;
    added.tets = {key_of_tool(tool), node};
    added.place = place;
    added.normal = near.normal;
    added.gap = std::max(0.0, near.gap);
    added.sides[0].tool = tool;
    added.sides[1].body = body;
    contacts.push_back(added);
  }
}

void add_tool_contacts(const ContactScene& scene, std::vector<Contact>& contacts) {
  constexpr double steps_ahead = 2.0;
  for (Index b = 0; b < scene.rigid.num_bodies(); ++b) {
    const RigidBody& body = scene.rigid.bodies[at(b)];
    const double reach = steps_ahead * scene.dt * fastest_against_tools(body, scene.tools);
    for (Index k = 0; k < to_index(scene.tools.size()); ++k)
      if (proximity(scene.tools[at(k)], body.centre).gap <= body.radius + reach)
        add_tool_contacts(scene, b, k, reach, contacts);
  }
}

// The vector turned like the old normal into the new one.
Vec3 turned(const Vec3& vector, const Vec3& old_normal, const Vec3& new_normal) {
  return Eigen::Quaterniond::FromTwoVectors(old_normal, new_normal) * vector;
}

// Each new point of a pair takes the impulse of the nearest old one that no other has taken.
void take_impulses(std::span<const Contact> old, std::span<Contact> now) {
  std::array<bool, 3> taken{};
  for (Contact& contact : now) {
    std::size_t nearest = old.size();
    for (std::size_t k = 0; k < old.size(); ++k) {
      if (taken[k]) continue;
      if (nearest == old.size() ||
          (old[k].place - contact.place).squaredNorm() < (old[nearest].place - contact.place).squaredNorm())
        nearest = k;
    }
    if (nearest == old.size()) return;
    taken[nearest] = true;
    if (old[nearest].impulse.squaredNorm() > 0.0)
      contact.impulse = turned(old[nearest].impulse, old[nearest].normal, contact.normal);
  }
}

std::size_t end_of_pair(const std::vector<Contact>& contacts, std::size_t begin) {
  std::size_t end = begin;
  while (end < contacts.size() && contacts[end].tets == contacts[begin].tets) ++end;
  return end;
}

// Both lists are sorted by pair.
void keep_impulses(const std::vector<Contact>& old, std::vector<Contact>& now) {
  for (std::size_t i = 0, k = 0; i < now.size();) {
    const std::size_t end = end_of_pair(now, i);
    while (k < old.size() && old[k].tets < now[i].tets) ++k;
    if (k < old.size() && old[k].tets == now[i].tets)
      take_impulses(std::span(old).subspan(k, end_of_pair(old, k) - k), std::span(now).subspan(i, end - i));
    i = end;
  }
}

}  // namespace

double fastest_against_tools(const RigidBody& body, std::span<const Tool> tools) {
  double tool_speed = 0.0;
  for (const Tool& tool : tools)
    tool_speed = std::max(tool_speed, tool.velocity_at(body.centre).norm() + tool.state.spin.norm() * body.radius);
  return tool_speed + body.velocity.norm() + spin(body).norm() * body.radius;
}

void refresh_contacts(ContactState& contact, const ContactScene& scene) {
  refresh_touches(contact, scene);
  set_all_normals(contact.touches);
  // Sorted by pair, as the candidates are; tools come before all tets.
  std::vector<Contact> contacts;
  add_tool_contacts(scene, contacts);
  std::sort(contacts.begin(), contacts.end(), [](const Contact& a, const Contact& b) { return a.tets < b.tets; });
  for (const Touch& touch : contact.touches) add_contacts(contact, scene, touch, contacts);
  keep_impulses(contact.contacts, contacts);
  contact.contacts = std::move(contacts);
}

}  // namespace knap
