#pragma once
#include <vector>

#include "core/types.hpp"
#include "meshing/msh_cursor.hpp"

namespace knap {

struct MshNode {
  std::int64_t tag;
  Vec3 x;              ///< in units of the file
  std::size_t offset;  ///< in the file, for messages
};
struct MshTet {
  std::int64_t tag;
  std::array<std::int64_t, 4> nodes;
  std::size_t offset;
};
/// What a .msh file holds that a particle needs.
struct MshContents {
  std::vector<MshNode> nodes;
  std::vector<MshTet> tets;
};

/// Readers of one section each, from after its first line up to its $End line.
void read_msh2_nodes(MshCursor& cursor, MshContents& contents);
void read_msh2_elements(MshCursor& cursor, MshContents& contents);
void read_msh4_nodes(MshCursor& cursor, MshContents& contents);
void read_msh4_elements(MshCursor& cursor, MshContents& contents);

inline constexpr std::int64_t msh_tet = 4;
/// Number of nodes of a first-order point, line, triangle or tet. Throws InputError for the types that a mesh of tets
/// cannot have, which `offset` points at.
int num_nodes_of_msh_element(const MshCursor& cursor, std::size_t offset, std::int64_t type);

}  // namespace knap
