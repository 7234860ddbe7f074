#include <fmt/format.h>

#include "meshing/msh_formats.hpp"

namespace knap {

int num_nodes_of_msh_element(const MshCursor& cursor, std::size_t offset, std::int64_t type) {
  switch (type) {
    case 15:
      return 1;  // point
    case 1:
      return 2;  // line
    case 2:
      return 3;  // triangle
    case msh_tet:
      return 4;
    case 3:
    case 5:
    case 6:
    case 7:
      cursor.fail(offset, fmt::format("element type {} ({}): only meshes of tets are supported", type,
                                      type == 3   ? "quadrangle"
                                      : type == 5 ? "hexahedron"
                                      : type == 6 ? "prism"
                                                  : "pyramid"));
    case 8:
    case 9:
    case 11:
      cursor.fail(offset, fmt::format("element type {} ({}): save the mesh with Mesh.ElementOrder = 1", type,
                                      type == 8   ? "3-node line"
                                      : type == 9 ? "6-node triangle"
                                                  : "10-node tet"));
    default:
      cursor.fail(offset, fmt::format("element type {} is not supported, only 4-node tets are", type));
  }
}

}  // namespace knap
