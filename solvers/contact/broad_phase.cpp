// Fat boxes of the tets with free faces, in the cells of an unbounded regular grid, the cells hashed into buckets:
// fragments that fly far cost nothing. A fragment's boxes are fattened by its own margin, so that a few fast ones do
// not make the boxes of all others large or the rebuilds frequent.
#include "contact/broad_phase.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "contact/free_faces.hpp"
#include "contact/tet_overlap.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index buckets_per_block = 1024;
// A fragment's margin, which lets it go on as it does for a while, is at most so many times the least one: wider boxes
// would meet too many others.
constexpr double widest_margin = 8.0;

using Box = Eigen::AlignedBox3f;  // rounded outwards
using Cell = Eigen::Vector3i;

/// A tet with a free face and its fat box.
struct SurfaceTet {
  Index tet = none;
  Index fragment = none;
  Box box;
};

/// The tets with free faces.
struct Surface {
  std::vector<SurfaceTet> tets;
  std::vector<TetShape> shapes;
};

/// A box in a cell.
struct Entry {
  Index surface_tet = none;
  Cell cell = Cell::Zero();
};

struct BoxGrid {
  double cell_size = 1.0;
  std::uint32_t mask = 0;
  std::vector<Entry> entries;
  Csr of_bucket;  ///< bucket -> entries

  Cell cell(const Eigen::Vector3f& p) const {
    // Beyond a billion cells all is one cell: slow there, but right.
    return (p.cast<double>() / cell_size).array().floor().max(-1e9).min(1e9).cast<int>();
  }
  Index bucket(const Cell& c) const {
    const auto part = [](int i, std::uint32_t prime) { return static_cast<std::uint32_t>(i) * prime; };
    return static_cast<Index>((part(c.x(), 73856093u) ^ part(c.y(), 19349663u) ^ part(c.z(), 83492791u)) & mask);
  }
};

std::vector<Index> tets_with_free_faces(std::span<const std::uint8_t> free_faces) {
  std::vector<Index> tets;
  for (std::size_t t = 0; t < free_faces.size(); ++t)
    if (free_faces[t] != 0) tets.push_back(to_index(t));
  return tets;
}

Csr nodes_by_fragment(const ContactState& contact, const Topology& topology, std::span<const Index> tets) {
  std::vector<Index> fragment_of_node(at(topology.num_nodes()), none);
  for (const Index t : tets)
    for (const Index node : topology.tet_nodes[at(t)]) fragment_of_node[at(node)] = contact.fragment_of_tet[at(t)];
  return make_csr(contact.fragments, fragment_of_node);
}

Vec3 mean_velocity(std::span<const Index> nodes, std::span<const Vec4> v) {
  Vec3 sum = Vec3::Zero();
  for (const Index node : nodes) sum += xyz(v[at(node)]);
  return nodes.empty() ? sum : Vec3(sum / static_cast<double>(nodes.size()));
}

/// Bound of the speed of any surface node of the fragment in the contact's frame [m/s].
double largest_speed(const ContactState& contact, Index fragment, const FragmentMotion& motion) {
  const auto nodes = contact.surface_nodes[fragment];
  if (nodes.empty()) return 0.0;
  if (const Index body = motion.rigid.of_node(nodes.front()); body != none) {
    const RigidBody& rigid = motion.rigid.bodies[at(body)];
    return (rigid.velocity - contact.frame_velocity).norm() + spin(rigid).norm() * rigid.radius;
  }
  double largest = 0.0;
  for (const Index node : nodes)
    largest = std::max(largest, (xyz(motion.v[at(node)]) - contact.frame_velocity).squaredNorm());
  return std::sqrt(largest);
}

void set_margins(ContactState& contact, const ContactSurroundings& here) {
  contact.frame_velocity = mean_velocity(contact.surface_nodes.items, here.nodes.v);
  contact.travel.assign(at(contact.fragments), 0.0);
  contact.margin.assign(at(contact.fragments), 0.0);
  parallel_for(
      contact.fragments,
      [&](Index f) {
        const double ahead = here.time_ahead * largest_speed(contact, f, {here.nodes.v, here.rigid});
        contact.margin[at(f)] = std::min(contact.skin + ahead, widest_margin * contact.skin);
      },
      16);
}

Box fat_box(const TetShape& shape, double margin) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Eigen::AlignedBox3d exact;
  for (const Vec3& corner : shape.corners) exact.extend(corner);
  Box box;
  for (Eigen::Index k = 0; k < 3; ++k) {
    box.min()[k] = std::nextafter(static_cast<float>(exact.min()[k] - margin), -infinity);
    box.max()[k] = std::nextafter(static_cast<float>(exact.max()[k] + margin), infinity);
  }
  return box;
}

Surface make_surface(const ContactState& contact, const ContactSurroundings& here, std::span<const Index> tets) {
  Surface surface{std::vector<SurfaceTet>(tets.size()), std::vector<TetShape>(tets.size())};
  parallel_for(to_index(tets.size()), [&](Index i) {
    TetShape& shape = surface.shapes[at(i)];
    shape = make_tet_shape(here.topology.tet_nodes[at(tets[at(i)])], here.nodes.x);
    SurfaceTet& fat = surface.tets[at(i)];
    fat.tet = tets[at(i)];
    fat.fragment = contact.fragment_of_tet[at(fat.tet)];
    fat.box = fat_box(shape, contact.margin[at(fat.fragment)]);
  });
  return surface;
}

template <class Visit>
void visit_cells(const BoxGrid& grid, const Box& box, Visit&& visit) {
  const Cell low = grid.cell(box.min()), high = grid.cell(box.max());
  for (int k = low.z(); k <= high.z(); ++k)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int i = low.x(); i <= high.x(); ++i) visit(Cell(i, j, k));
}

// The median extent, so that a few large boxes do not coarsen the grid.
double typical_extent(const std::vector<SurfaceTet>& boxes) {
  std::vector<double> extents;
  extents.reserve(boxes.size());
  for (const SurfaceTet& fat : boxes) extents.push_back(static_cast<double>(fat.box.sizes().maxCoeff()));
  const auto middle = extents.begin() + static_cast<std::ptrdiff_t>(extents.size() / 2);
  std::nth_element(extents.begin(), middle, extents.end());
  return *middle;
}

BoxGrid make_grid(const std::vector<SurfaceTet>& boxes) {
  BoxGrid grid;
  grid.cell_size = typical_extent(boxes);
  grid.entries.reserve(8 * boxes.size());
  for (Index i = 0; i < to_index(boxes.size()); ++i)
    visit_cells(grid, boxes[at(i)].box, [&](const Cell& cell) { grid.entries.push_back({i, cell}); });
  const std::uint32_t buckets = std::bit_ceil(static_cast<std::uint32_t>(grid.entries.size() / 4 + 1));
  grid.mask = buckets - 1;
  std::vector<Index> bucket_of_entry;
  bucket_of_entry.reserve(grid.entries.size());
  for (const Entry& entry : grid.entries) bucket_of_entry.push_back(grid.bucket(entry.cell));
  grid.of_bucket = make_csr(static_cast<Index>(buckets), bucket_of_entry);
  return grid;
}

// Whether a crack still joins the two fragments at a vertex that both tets have.
bool are_joined(const SurfaceTet& a, const SurfaceTet& b, const ContactSurroundings& here) {
  const TetCorners& of_a = here.topology.tet_vertices[at(a.tet)];
  const TetCorners& of_b = here.topology.tet_vertices[at(b.tet)];
  for (const Index vertex : of_a) {
    if (std::find(of_b.begin(), of_b.end(), vertex) == of_b.end()) continue;
    const FragmentJoint joint{vertex, {std::min(a.fragment, b.fragment), std::max(a.fragment, b.fragment)}};
    if (std::binary_search(here.joints.begin(), here.joints.end(), joint)) return true;
  }
  return false;
}

// Adds the candidate of two surface tets whose boxes meet, unless they are too far apart after all.
void add_candidate(const ContactState& contact, const ContactSurroundings& here, const Surface& surface, Index first,
                   Index second, std::vector<ContactCandidate>& found) {
  const SurfaceTet& a = surface.tets[at(first)];
  const SurfaceTet& b = surface.tets[at(second)];
  const double reach = contact.margin[at(a.fragment)] + contact.margin[at(b.fragment)];
  const double gap = separation_by_faces(surface.shapes[at(first)], surface.shapes[at(second)]);
  if (gap > reach || are_joined(a, b, here)) return;
  found.push_back({{a.tet, b.tet}, {a.fragment, b.fragment}, gap});
}

/// The boxes of a bucket coordinate by coordinate, so that one is compared with many at a time.
struct Bucket {
  std::array<std::vector<float>, 3> low, high;
  std::vector<Index> fragment;
  std::vector<Index> meets;  ///< of each box: whether it meets the one in question

  void fill(const BoxGrid& grid, const Surface& surface, std::span<const Index> entries) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k].resize(entries.size());
      high[k].resize(entries.size());
    }
    fragment.resize(entries.size());
    meets.resize(entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const SurfaceTet& fat = surface.tets[at(grid.entries[at(entries[i])].surface_tet)];
      fragment[i] = fat.fragment;
      for (std::size_t k = 0; k < 3; ++k) {
        low[k][i] = fat.box.min()[static_cast<Eigen::Index>(k)];
        high[k][i] = fat.box.max()[static_cast<Eigen::Index>(k)];
      }
    }
  }
  // Those behind box i that meet it and are of another fragment.
  void compare(std::size_t i) {
    const float x0 = low[0][i], x1 = high[0][i], y0 = low[1][i], y1 = high[1][i], z0 = low[2][i], z1 = high[2][i];
    const Index own = fragment[i];
    for (std::size_t j = i + 1; j < fragment.size(); ++j)
      meets[j] = (low[0][j] <= x1) & (high[0][j] >= x0) & (low[1][j] <= y1) & (high[1][j] >= y0) & (low[2][j] <= z1) &
                 (high[2][j] >= z0) & (fragment[j] != own);
  }
};

// Pairs that share several cells are found in the cell of the lowest corner that both boxes have.
void search_bucket(const ContactState& contact, const ContactSurroundings& here, const BoxGrid& grid,
                   const Surface& surface, std::span<const Index> entries, std::vector<ContactCandidate>& found) {
  thread_local Bucket bucket;
  bucket.fill(grid, surface, entries);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& first = grid.entries[at(entries[i])];
    const Box& box = surface.tets[at(first.surface_tet)].box;
    bucket.compare(i);
    for (std::size_t j = i + 1; j < entries.size(); ++j) {
      if (bucket.meets[j] == 0) continue;
      const Entry& second = grid.entries[at(entries[j])];
      const Box& other = surface.tets[at(second.surface_tet)].box;
      if (second.cell != first.cell || grid.cell(box.min().cwiseMax(other.min())) != first.cell) continue;
      const auto [low, high] = std::minmax(first.surface_tet, second.surface_tet);  // ascending as the tets are
      add_candidate(contact, here, surface, low, high, found);
    }
  }
}

// By pair, so that a sweep walks the memory in order.
void sort_by_tets(std::vector<ContactCandidate>& candidates, Index num_tets) {
  std::vector<Index> first;
  first.reserve(candidates.size());
  for (const ContactCandidate& candidate : candidates) first.push_back(candidate.tets[0]);
  const Csr of_tet = make_csr(num_tets, first);
  std::vector<ContactCandidate> sorted;
  sorted.reserve(candidates.size());
  for (const Index i : of_tet.items) sorted.push_back(candidates[at(i)]);
  for (Index tet = 0; tet < num_tets; ++tet)
    std::sort(sorted.begin() + of_tet.offsets[at(tet)], sorted.begin() + of_tet.offsets[at(tet + 1)],
              [](const ContactCandidate& a, const ContactCandidate& b) { return a.tets[1] < b.tets[1]; });
  candidates = std::move(sorted);
}

// Those stay whose tets are still candidates and have the free faces that they had, to be looked at for their drift.
void keep_touches(ContactState& contact, std::span<const ContactCandidate> old_candidates,
                  std::span<const std::uint8_t> old_free_faces) {
  std::size_t next = 0;
  std::erase_if(contact.touches, [&](Touch& touch) {
    const auto& tets = old_candidates[at(touch.candidate)].tets;
    while (next < contact.candidates.size() && contact.candidates[next].tets < tets) ++next;
    if (next == contact.candidates.size() || contact.candidates[next].tets != tets) return true;
    touch.candidate = to_index(next);
    contact.candidates[next].due = 0.0;
    return std::any_of(tets.begin(), tets.end(),
                       [&](Index tet) { return old_free_faces[at(tet)] != contact.free_faces[at(tet)]; });
  });
}

}  // namespace

void rebuild_candidates(ContactState& contact, const ContactSurroundings& here) {
  const std::vector<ContactCandidate> old_candidates = std::exchange(contact.candidates, {});
  if (contact.fragments < 2) return contact.touches.clear();
  const std::vector<std::uint8_t> old_free_faces = std::exchange(contact.free_faces, free_faces(here.topology));
  const std::vector<Index> tets = tets_with_free_faces(contact.free_faces);
  if (tets.empty()) return contact.touches.clear();
  contact.surface_nodes = nodes_by_fragment(contact, here.topology, tets);
  set_margins(contact, here);
  const Surface surface = make_surface(contact, here, tets);
  const BoxGrid grid = make_grid(surface.tets);
  std::vector<std::vector<ContactCandidate>> found(at(num_blocks(grid.of_bucket.num_rows(), buckets_per_block)));
  parallel_blocks(to_index(found.size()), [&](Index block) {
    const Index end = std::min(grid.of_bucket.num_rows(), (block + 1) * buckets_per_block);
    for (Index bucket = block * buckets_per_block; bucket < end; ++bucket)
      search_bucket(contact, here, grid, surface, grid.of_bucket[bucket], found[at(block)]);
  });
  for (auto& part : found) {
    make_room(contact.candidates, contact.candidates.size() + part.size());
    contact.candidates.insert(contact.candidates.end(), part.begin(), part.end());
    part = {};
  }
  sort_by_tets(contact.candidates, here.topology.num_tets());
  keep_touches(contact, old_candidates, old_free_faces);
}

bool advance_travel(ContactState& contact, const FragmentMotion& motion, double dt) {
  parallel_for(
      contact.fragments, [&](Index f) { contact.travel[at(f)] += dt * largest_speed(contact, f, motion); }, 16);
  for (std::size_t f = 0; f < contact.travel.size(); ++f)
    if (contact.travel[f] > contact.margin[f]) return true;
  return false;
}

}  // namespace knap
