// Version 4.1: the same sequence of numbers as text or in binary.
#include <fmt/format.h>

#include "meshing/msh_formats.hpp"

namespace knap {
namespace {

struct SectionHeader {
  std::int64_t num_blocks;
  std::int64_t num_items;
};

SectionHeader read_header(MshCursor& cursor) {
  const std::int64_t num_blocks = cursor.size("the number of blocks");
  const std::int64_t num_items = cursor.size("the number of items");
  cursor.size("the smallest number");
  cursor.size("the largest number");
  return {num_blocks, num_items};
}

void check_total(const MshCursor& cursor, std::size_t offset, std::int64_t announced, std::int64_t found) {
  if (announced != found)
    cursor.fail(offset, fmt::format("the section announces {} items, its blocks have {}", announced, found));
}

/// Reads the blocks of a section; read_block(items that remain) returns how many items its block has.
template <class ReadBlock>
void read_blocks(MshCursor& cursor, ReadBlock&& read_block) {
  const std::size_t begin = cursor.offset();
  const SectionHeader header = read_header(cursor);
  std::int64_t total = 0;
  for (std::int64_t block = 0; block < header.num_blocks; ++block) total += read_block(header.num_items - total);
  check_total(cursor, begin, header.num_items, total);
}

void read_nodes(MshCursor& cursor, std::int64_t count, std::int64_t num_parameters, MshContents& contents) {
  const std::size_t first = contents.nodes.size();
  for (std::int64_t i = 0; i < count; ++i) {
    const std::size_t offset = cursor.offset();
    contents.nodes.push_back({cursor.size("a node's number"), Vec3::Zero(), offset});
  }
  for (std::size_t i = first; i < contents.nodes.size(); ++i) {
    for (int k = 0; k < 3; ++k) contents.nodes[i].x[k] = cursor.real("a node's coordinate");
    for (std::int64_t k = 0; k < num_parameters; ++k) cursor.real("a node's parameter");
  }
}

std::int64_t read_node_block(MshCursor& cursor, std::int64_t remaining, MshContents& contents) {
  const std::size_t offset = cursor.offset();
  const std::int64_t dimension = cursor.int32("an entity's dimension");
  cursor.int32("an entity's number");
  const std::int64_t is_parametric = cursor.int32("the parametric flag");
  const std::int64_t count = cursor.size("the number of nodes in a block");
  if (dimension < 0 || dimension > 3 || is_parametric < 0 || is_parametric > 1 || count > remaining)
    cursor.fail(offset,
                fmt::format("a block of nodes of dimension {}, parametric flag {}, with {} nodes where {} remain",
                            dimension, is_parametric, count, remaining));
  read_nodes(cursor, count, is_parametric * dimension, contents);
  return count;
}

std::int64_t read_element_block(MshCursor& cursor, std::int64_t remaining, MshContents& contents) {
  const std::size_t block_offset = cursor.offset();
  cursor.int32("an entity's dimension");
  cursor.int32("an entity's number");
  const std::int64_t type = cursor.int32("an element's type");
  const std::int64_t count = cursor.size("the number of elements in a block");
  const int num_nodes = num_nodes_of_msh_element(cursor, block_offset, type);
  if (count > remaining)
    cursor.fail(block_offset, fmt::format("a block of {} elements where {} remain", count, remaining));
  for (std::int64_t i = 0; i < count; ++i) {
    const std::size_t offset = cursor.offset();
    MshTet element{cursor.size("an element's number"), {}, offset};
    for (int k = 0; k < num_nodes; ++k) element.nodes[at(k)] = cursor.size("a node of an element");
    if (type == msh_tet) contents.tets.push_back(element);
  }
  return count;
}

}  // namespace

void read_msh4_nodes(MshCursor& cursor, MshContents& contents) {
  read_blocks(cursor, [&](std::int64_t remaining) { return read_node_block(cursor, remaining, contents); });
}

void read_msh4_elements(MshCursor& cursor, MshContents& contents) {
  read_blocks(cursor, [&](std::int64_t remaining) { return read_element_block(cursor, remaining, contents); });
}

}  // namespace knap
