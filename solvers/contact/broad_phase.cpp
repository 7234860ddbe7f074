// Fat boxes of the tets with free faces, in the cells of an unbounded regular grid, the cells hashed into buckets:
// fragments that fly far cost nothing. A fragment's boxes are fattened by its own margin, so that a few fast ones do
// not make the boxes of all others large or the rebuilds frequent.
#include "contact/broad_phase.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "contact/free_faces.hpp"
#include "contact/tet_overlap.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index buckets_per_block = 1024;
// A fragment's margin lets it go on as it does for so many steps, but is at most so many times the least one: wider
// boxes would meet too many others.
constexpr double steps_ahead = 48.0;
constexpr double widest_margin = 4.0;

using Box = Eigen::AlignedBox3d;
using Cell = Eigen::Vector3i;

/// A tet with a free face and its fat box.
struct SurfaceTet {
  Index tet = none;
  Index fragment = none;
  Box box;
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

  Cell cell(const Vec3& p) const {
    // Beyond a billion cells all is one cell: slow there, but right.
    return (p / cell_size).array().floor().max(-1e9).min(1e9).cast<int>();
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

/// Largest speed of any surface node of the fragment in the contact's frame [m/s].
double largest_speed(const ContactState& contact, Index fragment, std::span<const Vec4> v) {
  double largest = 0.0;
  for (const Index node : contact.surface_nodes[fragment])
    largest = std::max(largest, (xyz(v[at(node)]) - contact.frame_velocity).squaredNorm());
  return std::sqrt(largest);
}

void set_margins(ContactState& contact, const ContactSurroundings& here) {
  contact.frame_velocity = mean_velocity(contact.surface_nodes.items, here.nodes.v);
  contact.travel.assign(at(contact.fragments), 0.0);
  contact.margin.assign(at(contact.fragments), 0.0);
  parallel_for(
      contact.fragments,
      [&](Index f) {
        const double ahead = steps_ahead * here.dt * largest_speed(contact, f, here.nodes.v);
        contact.margin[at(f)] = std::min(contact.skin + ahead, widest_margin * contact.skin);
      },
      16);
}

std::vector<SurfaceTet> fat_boxes(const ContactState& contact, const ContactSurroundings& here,
                                  std::span<const Index> tets) {
  std::vector<SurfaceTet> boxes(tets.size());
  parallel_for(to_index(tets.size()), [&](Index i) {
    SurfaceTet& fat = boxes[at(i)];
    fat.tet = tets[at(i)];
    fat.fragment = contact.fragment_of_tet[at(fat.tet)];
    for (const Index node : here.topology.tet_nodes[at(fat.tet)]) fat.box.extend(Vec3(xyz(here.nodes.x[at(node)])));
    const double margin = contact.margin[at(fat.fragment)];
    fat.box.min().array() -= margin;
    fat.box.max().array() += margin;
  });
  return boxes;
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
  for (const SurfaceTet& fat : boxes) extents.push_back(fat.box.sizes().maxCoeff());
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

// Adds the candidate of two boxes that meet, unless the tets are too far apart after all.
void add_candidate(const ContactState& contact, const ContactSurroundings& here, const SurfaceTet& a,
                   const SurfaceTet& b, std::vector<ContactCandidate>& found) {
  const double reach = contact.margin[at(a.fragment)] + contact.margin[at(b.fragment)];
  const double gap = separation_by_faces(make_tet_shape(here.topology.tet_nodes[at(a.tet)], here.nodes.x),
                                         make_tet_shape(here.topology.tet_nodes[at(b.tet)], here.nodes.x));
  if (gap > reach || are_joined(a, b, here)) return;
  found.push_back({{a.tet, b.tet}, {a.fragment, b.fragment}, gap});
}

// Pairs that share several cells are found in the cell of the lowest corner that both boxes have.
void search_bucket(const ContactState& contact, const ContactSurroundings& here, const BoxGrid& grid,
                   const std::vector<SurfaceTet>& boxes, std::span<const Index> bucket,
                   std::vector<ContactCandidate>& found) {
  for (std::size_t i = 0; i < bucket.size(); ++i) {
    const Entry& first = grid.entries[at(bucket[i])];
    const SurfaceTet& a = boxes[at(first.surface_tet)];
    for (std::size_t j = i + 1; j < bucket.size(); ++j) {
      const Entry& second = grid.entries[at(bucket[j])];
      if (second.cell != first.cell) continue;
      const SurfaceTet& b = boxes[at(second.surface_tet)];
      if (a.fragment == b.fragment || !a.box.intersects(b.box)) continue;
      if (grid.cell(a.box.min().cwiseMax(b.box.min())) != first.cell) continue;
      if (a.tet < b.tet) {
        add_candidate(contact, here, a, b, found);
      } else {
        add_candidate(contact, here, b, a, found);
      }
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

}  // namespace

void rebuild_candidates(ContactState& contact, const ContactSurroundings& here) {
  contact.candidates.clear();
  contact.touches.clear();
  if (contact.fragments < 2) return;
  contact.free_faces = free_faces(here.topology);
  const std::vector<Index> tets = tets_with_free_faces(contact.free_faces);
  if (tets.empty()) return;
  contact.surface_nodes = nodes_by_fragment(contact, here.topology, tets);
  set_margins(contact, here);
  const std::vector<SurfaceTet> boxes = fat_boxes(contact, here, tets);
  const BoxGrid grid = make_grid(boxes);
  std::vector<std::vector<ContactCandidate>> found(at(num_blocks(grid.of_bucket.num_rows(), buckets_per_block)));
  parallel_blocks(to_index(found.size()), [&](Index block) {
    const Index end = std::min(grid.of_bucket.num_rows(), (block + 1) * buckets_per_block);
    for (Index bucket = block * buckets_per_block; bucket < end; ++bucket)
      search_bucket(contact, here, grid, boxes, grid.of_bucket[bucket], found[at(block)]);
  });
  for (auto& part : found) {
    make_room(contact.candidates, contact.candidates.size() + part.size());
    contact.candidates.insert(contact.candidates.end(), part.begin(), part.end());
    part = {};
  }
  sort_by_tets(contact.candidates, here.topology.num_tets());
}

bool advance_travel(ContactState& contact, std::span<const Vec4> v, double dt) {
  parallel_for(
      contact.fragments, [&](Index f) { contact.travel[at(f)] += dt * largest_speed(contact, f, v); }, 16);
  for (std::size_t f = 0; f < contact.travel.size(); ++f)
    if (contact.travel[f] > contact.margin[f]) return true;
  return false;
}

}  // namespace knap
