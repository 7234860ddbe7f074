#include "cohesive/record_groups.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cohesive/cohesive_state.hpp"
#include "core/errors.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index vertices_per_chunk = 256;
constexpr std::size_t most_local_nodes = 256;
constexpr Index rows_per_face = sizeof(CrackFace) / sizeof(Vec4);
constexpr Index first_couple_row = 1;

/// The nodes of one vertex by local number, in the order in which its records name them.
struct LocalNodes {
  std::array<Index, most_local_nodes> nodes;
  std::size_t count = 0;

  // `guess` is the number that the node had last time.
  std::uint8_t number(Index node, std::uint8_t guess) {
    if (guess < count && nodes[guess] == node) return guess;
    const auto end = nodes.begin() + static_cast<std::ptrdiff_t>(count);
    const auto found = std::find(nodes.begin(), end, node);
    if (found == end) {
      if (count == most_local_nodes)
        throw InputError(fmt::format("mesh: more than {} pieces around one vertex", most_local_nodes));
      nodes[count++] = node;
    }
    return static_cast<std::uint8_t>(found - nodes.begin());
  }
};

/// Groups of a chunk of vertices, counted from its start.
struct Chunk {
  std::vector<RecordGroup> groups;
  std::vector<RecordSlots> slots;
  std::vector<PerLane<Index>> nodes;
};

RecordSlots no_slots() {
  RecordSlots slots;
  slots.record.fill(none);
  slots.couple.fill(none);
  return slots;
}

bool sleeps(const CrackState& cracks, const CrackRecord& record) {
  return cracks.any_sleeps && cracks.faces[at(record.face)].sleeps;
}

Index num_awake_records(const CrackState& cracks, Index vertex) {
  const auto records = cracks.records_of_vertex(vertex);
  if (!cracks.any_sleeps) return to_index(records.size());
  return static_cast<Index>(std::count_if(records.begin(), records.end(),
                                          [&](const CrackRecord& record) { return !sleeps(cracks, record); }));
}

// The vertices with records to solve; the others spend nothing.
std::vector<Index> awake_vertices(CrackState& cracks) {
  std::vector<Index> awake;
  awake.reserve(cracks.vertices.size());
  for (const Index v : cracks.vertices)
    if (num_awake_records(cracks, v) > 0)
      awake.push_back(v);
    else
      cracks.step_losses_of_vertex[at(v)] = {};
  return awake;
}

void fill_lane(Chunk& chunk, RecordGroup& group, std::size_t lane, CrackState& cracks, Index vertex) {
  group.vertex[lane] = vertex;
  LocalNodes local;
  RecordSlots* slots = chunk.slots.data() + group.first_slots;
  const Index end = cracks.record_offsets[at(vertex) + 1];
  for (Index r = cracks.record_offsets[at(vertex)]; r < end; ++r) {
    CrackRecord& record = cracks.records[at(r)];
    if (sleeps(cracks, record)) continue;
    record.local_a = local.number(record.node_a, record.local_a);
    record.local_b = local.number(record.node_b, record.local_b);
    slots->record[lane] = r;
    slots->couple[lane] = rows_per_face * record.face + first_couple_row + record.corner;
    slots->a[lane] = record.local_a;
    slots->b[lane] = record.local_b;
    ++slots;
  }
  while (group.num_nodes < to_index(local.count)) {
    chunk.nodes.emplace_back().fill(none);
    ++group.num_nodes;
  }
  for (std::size_t n = 0; n < local.count; ++n) chunk.nodes[at(group.first_nodes) + n][lane] = local.nodes[n];
}

Chunk make_chunk(CrackState& cracks, std::span<const Index> vertices) {
  const auto count = [&cracks](Index v) { return num_awake_records(cracks, v); };
  std::vector<Index> sorted(vertices.begin(), vertices.end());
  std::stable_sort(sorted.begin(), sorted.end(), [&count](Index a, Index b) { return count(a) > count(b); });
  Chunk chunk;
  chunk.nodes.reserve(2 * sorted.size());
  for (std::size_t first = 0; first < sorted.size(); first += at(group_lanes)) {
    RecordGroup group;
    group.vertex.fill(none);
    group.law = law_of_vertex(cracks, sorted[first]);
    group.first_nodes = to_index(chunk.nodes.size());
    group.first_slots = to_index(chunk.slots.size());
    group.num_slots = count(sorted[first]);
    chunk.slots.resize(chunk.slots.size() + at(group.num_slots), no_slots());
    const std::size_t members = std::min(sorted.size() - first, at(group_lanes));
    for (std::size_t lane = 0; lane < members; ++lane) fill_lane(chunk, group, lane, cracks, sorted[first + lane]);
    chunk.groups.push_back(group);
  }
  return chunk;
}

void append_chunk(RecordGroups& all, const Chunk& chunk) {
  for (RecordGroup group : chunk.groups) {
    group.first_nodes += to_index(all.nodes.size());
    group.first_slots += to_index(all.slots.size());
    all.max_slots = std::max(all.max_slots, group.num_slots);
    all.max_nodes = std::max(all.max_nodes, group.num_nodes);
    all.groups.push_back(group);
  }
  all.nodes.insert(all.nodes.end(), chunk.nodes.begin(), chunk.nodes.end());
  all.slots.insert(all.slots.end(), chunk.slots.begin(), chunk.slots.end());
}

}  // namespace

std::vector<std::span<const Index>> parts_of_one_law(const CrackState& cracks, std::span<const Index> vertices,
                                                     Index largest) {
  std::vector<std::span<const Index>> parts;
  while (!vertices.empty()) {
    const Index law = law_of_vertex(cracks, vertices.front());
    std::size_t count = std::min(vertices.size(), at(largest));
    while (law_of_vertex(cracks, vertices[count - 1]) != law) --count;
    parts.push_back(vertices.first(count));
    vertices = vertices.subspan(count);
  }
  return parts;
}

void group_records(CrackState& cracks) {
  const std::vector<Index> awake = awake_vertices(cracks);
  const auto parts = parts_of_one_law(cracks, awake, vertices_per_chunk);
  std::vector<Chunk> chunks(parts.size());
  parallel_blocks(to_index(chunks.size()), [&](Index c) { chunks[at(c)] = make_chunk(cracks, parts[at(c)]); });
  RecordGroups& all = cracks.groups;
  all.groups.clear();
  all.slots.clear();
  all.nodes.clear();
  all.max_slots = all.max_nodes = 0;
  for (const Chunk& chunk : chunks) append_chunk(all, chunk);
}

}  // namespace knap
