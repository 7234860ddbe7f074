#include "cohesive/record_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "cohesive/cohesive_state.hpp"
#include "core/errors.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

constexpr Index vertices_per_chunk = 256;

using LocalNodes = std::vector<Index>;

std::uint8_t local_number(LocalNodes& nodes, Index node) {
  const auto found = std::find(nodes.begin(), nodes.end(), node);
  const auto number = found - nodes.begin();
  if (found == nodes.end()) nodes.push_back(node);
  if (number > std::numeric_limits<std::uint8_t>::max())
    throw InputError(fmt::format("mesh: more than {} pieces around one vertex", number));
  return static_cast<std::uint8_t>(number);
}

LocalNodes number_nodes(std::span<CrackRecord> records) {
  LocalNodes nodes;
  for (CrackRecord& record : records) {
    record.local_a = local_number(nodes, record.node_a);
    record.local_b = local_number(nodes, record.node_b);
  }
  return nodes;
}

/// Groups and nodes of a chunk of vertices, counted from its start.
struct Chunk {
  std::vector<RecordGroup> groups;
  std::vector<PerLane<Index>> nodes;
};

void append_group(Chunk& chunk, const CrackState& cracks, std::span<const Index> vertices,
                  std::span<const LocalNodes* const> nodes_of_lane) {
  RecordGroup group;
  group.vertex.fill(none);
  group.first_nodes = to_index(chunk.nodes.size());
  for (std::size_t lane = 0; lane < vertices.size(); ++lane) {
    group.vertex[lane] = vertices[lane];
    group.first_record[lane] = cracks.record_offsets[at(vertices[lane])];
    group.num_records[lane] = to_index(cracks.records_of_vertex(vertices[lane]).size());
    group.max_records = std::max(group.max_records, group.num_records[lane]);
    group.num_nodes = std::max(group.num_nodes, to_index(nodes_of_lane[lane]->size()));
  }
  chunk.nodes.resize(chunk.nodes.size() + at(group.num_nodes));
  for (std::size_t k = 0; k < at(group.num_nodes); ++k) {
    PerLane<Index>& row = chunk.nodes[at(group.first_nodes) + k];
    row.fill(none);
    for (std::size_t lane = 0; lane < vertices.size(); ++lane)
      if (k < nodes_of_lane[lane]->size()) row[lane] = (*nodes_of_lane[lane])[k];
  }
  chunk.groups.push_back(group);
}

Chunk make_chunk(CrackState& cracks, std::span<const Index> vertices) {
  struct Member {
    Index vertex;
    LocalNodes nodes;
  };
  std::vector<Member> members;
  for (const Index vertex : vertices) members.push_back({vertex, number_nodes(cracks.records_of_vertex(vertex))});
  std::stable_sort(members.begin(), members.end(), [&cracks](const Member& a, const Member& b) {
    return cracks.records_of_vertex(a.vertex).size() > cracks.records_of_vertex(b.vertex).size();
  });
  Chunk chunk;
  for (std::size_t first = 0; first < members.size(); first += at(group_lanes)) {
    const std::size_t count = std::min(members.size() - first, at(group_lanes));
    PerLane<Index> lane_vertices{};
    PerLane<const LocalNodes*> lane_nodes{};
    for (std::size_t lane = 0; lane < count; ++lane) {
      lane_vertices[lane] = members[first + lane].vertex;
      lane_nodes[lane] = &members[first + lane].nodes;
    }
    append_group(chunk, cracks, std::span(lane_vertices).first(count), std::span(lane_nodes).first(count));
  }
  return chunk;
}

void append_chunk(RecordGroups& all, const Chunk& chunk) {
  const Index first_nodes = to_index(all.nodes.size());
  all.nodes.insert(all.nodes.end(), chunk.nodes.begin(), chunk.nodes.end());
  for (RecordGroup group : chunk.groups) {
    group.first_nodes += first_nodes;
    for (const Index vertex : group.vertex)
      if (vertex != none) all.group_of_vertex[at(vertex)] = to_index(all.groups.size());
    all.max_records = std::max(all.max_records, group.max_records);
    all.max_nodes = std::max(all.max_nodes, group.num_nodes);
    all.groups.push_back(group);
  }
}

}  // namespace

void group_records(CrackState& cracks) {
  const Index count = to_index(cracks.vertices.size());
  std::vector<Chunk> chunks(at(num_blocks(count, vertices_per_chunk)));
  parallel_blocks(to_index(chunks.size()), [&](Index c) {
    const Index first = c * vertices_per_chunk;
    const auto vertices =
        std::span(cracks.vertices).subspan(at(first), at(std::min(vertices_per_chunk, count - first)));
    chunks[at(c)] = make_chunk(cracks, vertices);
  });
  RecordGroups all;
  all.group_of_vertex.assign(cracks.losses_of_vertex.size(), none);
  for (const Chunk& chunk : chunks) append_chunk(all, chunk);
  cracks.groups = std::move(all);
}

}  // namespace knap
