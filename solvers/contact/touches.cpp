#include "contact/touches.hpp"

#include <algorithm>
#include <cmath>

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
// While the corners of one of two deformable tets have moved less than this share of a tet's height in the other, their
// patch is kept.
constexpr double kept_patch = 0.02;

double least_height(const TetShape& shape) { return *std::min_element(shape.height.begin(), shape.height.end()); }

// The touch of a candidate if its tets overlap; sets when to look again.
bool narrow(const ContactState& contact, ContactCandidate& candidate, double travel, const ContactScene& scene,
            const TetShape& a, Touch& touch) {
  const auto& [first, second] = candidate.tets;
  const TetShape b = make_tet_shape(scene.topology.tet_nodes[at(second)], scene.x);
  if (!a.is_solid || !b.is_solid) return false;
  double gap = separation_by_faces(a, b);
  if (gap == 0.0) {
    touch.carries_body = scene.rigid.of_tet(first) != none || scene.rigid.of_tet(second) != none;
    const OverlapPatch patch =
        overlap_patch(a, contact.free_faces[at(first)], b, contact.free_faces[at(second)], touch.carries_body != 0);
    touch.size = std::min(least_height(a), least_height(b));
    if (patch.size > smallest_patch * touch.size * touch.size) {
      for (std::size_t k = 0; k < 3; ++k) touch.area_along_edges[k] = a.gradient[k + 1].dot(patch.area);
      touch.patch_size = patch.size;
      touch.corners = patch.corners;
      touch.weights = a.coordinates(patch.centre);
      for (std::size_t k = 0; k < 4; ++k) touch.first_in_second[k] = b.coordinates(a.corners[k]);
      if (touch.carries_body == 0) candidate.due = travel + kept_patch * touch.size;
      return true;
    }
    gap = separation_by_edges(a, b);  // the last to be asked, because it costs most
  }
  candidate.due = travel + part_of_gap * gap;
  return false;
}

double travel_of(const ContactState& contact, const ContactCandidate& candidate) {
  return contact.travel[at(candidate.fragments[0])] + contact.travel[at(candidate.fragments[1])];
}

// How far the first tet has moved in the second one, which may have moved with it, since their patch was found [m].
double drift(const Touch& touch, const ContactCandidate& candidate, const ContactScene& scene) {
  const TetCorners& first = scene.topology.tet_nodes[at(candidate.tets[0])];
  const TetCorners& second = scene.topology.tet_nodes[at(candidate.tets[1])];
  double largest = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 moved = xyz(scene.x[at(first[k])]) - place_in(second, touch.first_in_second[k], scene.x);
    largest = std::max(largest, moved.squaredNorm());
  }
  return std::sqrt(largest);
}

// Lets those touches wait whose tets have moved together: ways are a bound, and a far one for these.
void let_touches_wait(ContactState& contact, const ContactScene& scene) {
  parallel_for(
      to_index(contact.touches.size()),
      [&](Index i) {
        const Touch& touch = contact.touches[at(i)];
        ContactCandidate& candidate = contact.candidates[at(touch.candidate)];
        const double travel = travel_of(contact, candidate);
        if (touch.carries_body != 0 || candidate.due > travel) return;
        const double left = kept_patch * touch.size - drift(touch, candidate, scene);
        if (left > 0.0) candidate.due = travel + left;
      },
      pairs_per_block);
}

// The candidates of a block that must be looked at now; returns their number.
Index collect_due(const ContactState& contact, Index block, std::span<Index> due) {
  const Index end = std::min(to_index(contact.candidates.size()), (block + 1) * candidates_per_block);
  Index count = 0;
  for (Index i = block * candidates_per_block; i < end; ++i) {
    const ContactCandidate& candidate = contact.candidates[at(i)];
    due[at(count)] = i;
    count += candidate.due <= travel_of(contact, candidate);
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
    Index shaped = none;  // candidates of one tet follow each other
    TetShape shape;
    for (Index i = 0; i < num_due; ++i) {
      prefetch_candidate(contact, scene.topology, scene.x, std::span(due).first(at(num_due)), i);
      ContactCandidate& candidate = contact.candidates[at(due[at(i)])];
      looked_at[at(due[at(i)])] = 1;
      if (candidate.tets[0] != shaped) {
        shaped = candidate.tets[0];
        shape = make_tet_shape(scene.topology.tet_nodes[at(shaped)], scene.x);
      }
      Touch touch;
      touch.candidate = due[at(i)];
      if (narrow(contact, candidate, travel_of(contact, candidate), scene, shape, touch))
        found[at(block)].push_back(touch);
    }
  });
  std::vector<Touch> touches;
  for (const auto& part : found) touches.insert(touches.end(), part.begin(), part.end());
  return touches;
}

// Of the touches of the last look those stay that were not looked at.
void find_touches(ContactState& contact, const ContactScene& scene) {
  std::vector<std::uint8_t> looked_at(contact.candidates.size(), 0);
  const std::vector<Touch> added = new_touches(contact, scene, looked_at);
  std::erase_if(contact.touches, [&](const Touch& touch) { return looked_at[at(touch.candidate)] != 0; });
  std::vector<Touch> all;
  all.reserve(contact.touches.size() + added.size());
  std::merge(contact.touches.begin(), contact.touches.end(), added.begin(), added.end(), std::back_inserter(all),
             [](const Touch& a, const Touch& b) { return a.candidate < b.candidate; });
  contact.touches = std::move(all);
}

// A kept patch moves and turns with its first tet.
void place_touches(ContactState& contact, const ContactScene& scene) {
  parallel_for(to_index(contact.touches.size()), [&](Index i) {
    Touch& touch = contact.touches[at(i)];
    const TetCorners& first = scene.topology.tet_nodes[at(contact.candidates[at(touch.candidate)].tets[0])];
    touch.centre = place_in(first, touch.weights, scene.x);
    touch.area = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      touch.area += touch.area_along_edges[k] * (xyz(scene.x[at(first[k + 1])]) - xyz(scene.x[at(first[0])]));
  });
}

// The touches of the same two fragments.
struct TouchesOfPair {
  std::span<const Index> touches;
  std::span<const std::uint8_t> is_turned;  ///< by touch: its first tet belongs to the higher fragment

  // The patch's area as seen from the lower to the higher fragment.
  Vec3 area(const Touch& touch, Index i) const { return is_turned[at(i)] != 0 ? Vec3(-touch.area) : touch.area; }
};

// A corner or an edge that goes into another fragment belongs to several tets, which each see only a part of it: the
// direction is that of all parts together.
void set_normals(std::vector<Touch>& touches, const TouchesOfPair& pair) {
  for (const Index i : pair.touches) {
    Touch& touch = touches[at(i)];
    const double reach = reach_of_touch * touch.size;
    Vec3 sum = Vec3::Zero();
    double size = 0.0;
    for (const Index k : pair.touches) {
      const Touch& other = touches[at(k)];
      if ((other.centre - touch.centre).squaredNorm() > reach * reach) continue;
      sum += pair.area(other, k);
      size += other.patch_size;
    }
    if (sum.norm() < least_direction * size) sum = pair.area(touch, i);
    if (pair.is_turned[at(i)] != 0) sum = -sum;
    touch.normal = sum.norm() > 0.0 ? Vec3(sum.normalized()) : Vec3::Zero();
  }
}

void set_all_normals(ContactState& contact) {
  std::vector<Touch>& touches = contact.touches;
  std::vector<std::pair<std::array<Index, 2>, Index>> order;  // fragments and touch
  std::vector<std::uint8_t> is_turned;
  order.reserve(touches.size());
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const auto& [first, second] = contact.candidates[at(touches[i].candidate)].fragments;
    order.emplace_back(std::array{std::min(first, second), std::max(first, second)}, to_index(i));
    is_turned.push_back(first > second ? 1 : 0);
  }
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
        const Index count = begins[at(group + 1)] - begin;
        set_normals(touches, {std::span(sorted).subspan(at(begin), at(count)), is_turned});
      },
      pairs_per_block);
}

}  // namespace

void refresh_touches(ContactState& contact, const ContactScene& scene) {
  let_touches_wait(contact, scene);
  find_touches(contact, scene);
  place_touches(contact, scene);
  set_all_normals(contact);
}

}  // namespace knap
