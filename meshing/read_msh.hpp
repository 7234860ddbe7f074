#pragma once
#include <filesystem>
#include <string_view>

#include "core/tet_mesh.hpp"

namespace knap {

/// The nodes and 4-node tets of a Gmsh .msh file, version 2.2 or 4.1, ASCII or binary, in the file's order; `scale` is
/// metres per unit of the file. Points, lines and triangles are skipped. Throws InputError with line or byte for
/// anything malformed, unsupported or inverted. Next: check_mesh, then morton_ordered.
TetMesh read_msh(const std::filesystem::path& path, double scale);

/// The same from memory; `name` stands for the file in messages.
TetMesh parse_msh(std::string_view bytes, const std::string& name, double scale);

}  // namespace knap
