// Version 2.2: counts are text also in binary files.
#include <fmt/format.h>

#include "meshing/msh_formats.hpp"

namespace knap {
namespace {

std::int64_t read_count(MshCursor& cursor, const char* what) {
  const std::size_t offset = cursor.offset();
  const std::int64_t count = cursor.text_integer(what);
  if (count < 0) cursor.fail(offset, fmt::format("{} is {}", what, count));
  if (!cursor.line().empty()) cursor.fail(offset, fmt::format("expected nothing but {} on this line", what));
  return count;
}

struct ElementKind {
  std::int64_t type;
  std::int64_t num_tags;
  int num_nodes;
};

ElementKind checked_kind(const MshCursor& cursor, std::size_t offset, std::int64_t type, std::int64_t num_tags) {
  if (num_tags < 0) cursor.fail(offset, fmt::format("the number of tags of an element is {}", num_tags));
  return {type, num_tags, num_nodes_of_msh_element(cursor, offset, type)};
}

// The part of an element that follows its number (and, in text, its kind).
void read_tags_and_nodes(MshCursor& cursor, const ElementKind& kind, MshTet element, MshContents& contents) {
  for (std::int64_t i = 0; i < kind.num_tags; ++i) cursor.int32("a tag of an element");
  for (int k = 0; k < kind.num_nodes; ++k) element.nodes[at(k)] = cursor.int32("a node of an element");
  if (kind.type == msh_tet) contents.tets.push_back(element);
}

void read_text_element(MshCursor& cursor, MshContents& contents) {
  const std::int64_t tag = cursor.int32("an element's number");
  const std::size_t offset = cursor.offset();
  const std::int64_t type = cursor.int32("an element's type");
  const ElementKind kind = checked_kind(cursor, offset, type, cursor.int32("the number of tags"));
  read_tags_and_nodes(cursor, kind, {tag, {}, offset}, contents);
}

// A block of elements of one kind; returns how many.
std::int64_t read_binary_block(MshCursor& cursor, MshContents& contents, std::int64_t most) {
  const std::size_t begin = cursor.offset();
  const std::int64_t type = cursor.int32("an element's type");
  const std::int64_t count = cursor.int32("the number of elements in a block");
  const ElementKind kind = checked_kind(cursor, begin, type, cursor.int32("the number of tags"));
  if (count < 1 || count > most) cursor.fail(begin, fmt::format("a block of {} elements where {} remain", count, most));
  for (std::int64_t i = 0; i < count; ++i) {
    const std::size_t offset = cursor.offset();
    const std::int64_t tag = cursor.int32("an element's number");
    read_tags_and_nodes(cursor, kind, {tag, {}, offset}, contents);
  }
  return count;
}

}  // namespace

void read_msh2_nodes(MshCursor& cursor, MshContents& contents) {
  const std::int64_t count = read_count(cursor, "the number of nodes");
  for (std::int64_t i = 0; i < count; ++i) {
    const std::size_t offset = cursor.offset();
    const std::int64_t tag = cursor.int32("a node's number");
    const double x = cursor.real("a node's x");
    const double y = cursor.real("a node's y");
    const double z = cursor.real("a node's z");
    contents.nodes.push_back({tag, {x, y, z}, offset});
  }
}

void read_msh2_elements(MshCursor& cursor, MshContents& contents) {
  const std::int64_t count = read_count(cursor, "the number of elements");
  for (std::int64_t done = 0; done < count;) {
    if (cursor.is_binary) {
      done += read_binary_block(cursor, contents, count - done);
    } else {
      read_text_element(cursor, contents);
      ++done;
    }
  }
}

}  // namespace knap
