// Our own parser rather than gmsh's, which is not hardened against malformed files: of 8,000 mutated meshes of five
// tets (tests/fuzz/mesh_reader_fuzz) gmsh 4.8.4 crashed on 8, ran out of 4 GB on 146 and opened 2,060 without an error
// but also without a tet. This one needs no more memory than a small multiple of the file.
#include "meshing/read_msh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/errors.hpp"
#include "meshing/msh_formats.hpp"

namespace knap {
namespace {

void check_endianness(MshCursor& cursor) {
  const std::size_t offset = cursor.offset();
  const std::int64_t one = cursor.int32("the number that shows the byte order");
  if (one == 0x01000000)
    cursor.fail(offset, "the file was written on a machine of other byte order; save it again as ASCII");
  if (one != 1) cursor.fail(offset, fmt::format("the number that shows the byte order is {} instead of 1", one));
}

enum class MshVersion { V2, V4 };

MshVersion read_format(MshCursor& cursor) {
  cursor.expect_line("$MeshFormat");
  const std::size_t offset = cursor.offset();
  const std::string_view line = cursor.line();
  const std::string_view version = line.substr(0, line.find(' '));
  if (version != "2.2" && version != "4.1")
    cursor.fail(offset, "only versions 2.2 and 4.1 are supported; save the mesh with gmsh -format msh41");
  const std::string_view rest = line.substr(version.size());
  if (rest != " 0 8" && rest != " 1 8")
    cursor.fail(offset, "expected '<version> <0 = ASCII, 1 = binary> 8', the 8 being the bytes of a number");
  cursor.is_binary = rest == " 1 8";
  if (cursor.is_binary) check_endianness(cursor);
  cursor.expect_line("$EndMeshFormat");
  return version == "2.2" ? MshVersion::V2 : MshVersion::V4;
}

MshContents read_sections(MshCursor& cursor) {
  const MshVersion version = read_format(cursor);
  MshContents contents;
  bool has_nodes = false, has_elements = false;
  while (!cursor.at_end()) {
    const std::size_t offset = cursor.offset();
    const std::string section(cursor.line());
    if (section.size() < 2 || section[0] != '$') cursor.fail(offset, "expected a section, a line that starts with $");
    bool* const seen = section == "$Nodes" ? &has_nodes : section == "$Elements" ? &has_elements : nullptr;
    const std::string end = "$End" + section.substr(1);
    if (seen == nullptr) {
      cursor.skip_past_line(end);
      continue;
    }
    if (*seen) cursor.fail(offset, "a second section " + section);
    *seen = true;
    if (seen == &has_nodes) (version == MshVersion::V2 ? read_msh2_nodes : read_msh4_nodes)(cursor, contents);
    if (seen == &has_elements) (version == MshVersion::V2 ? read_msh2_elements : read_msh4_elements)(cursor, contents);
    cursor.expect_line(end);
  }
  if (!has_nodes || !has_elements)
    cursor.fail(cursor.offset(), fmt::format("the file has no section {}", has_nodes ? "$Elements" : "$Nodes"));
  return contents;
}

using TagIndex = std::pair<std::int64_t, Index>;

std::vector<TagIndex> sorted_tags(const MshCursor& cursor, const std::vector<MshNode>& nodes) {
  std::vector<TagIndex> tags;
  tags.reserve(nodes.size());
  for (const MshNode& node : nodes) tags.emplace_back(node.tag, to_index(tags.size()));
  std::sort(tags.begin(), tags.end());
  const auto twin = std::adjacent_find(tags.begin(), tags.end(),
                                       [](const TagIndex& a, const TagIndex& b) { return a.first == b.first; });
  if (twin != tags.end()) cursor.fail(nodes[at(twin[1].second)].offset, fmt::format("a second node {}", twin->first));
  return tags;
}

TetCorners corners_of(const MshCursor& cursor, const MshTet& tet, const std::vector<TagIndex>& tags) {
  TetCorners corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto found = std::lower_bound(tags.begin(), tags.end(), TagIndex{tet.nodes[k], 0});
    if (found == tags.end() || found->first != tet.nodes[k])
      cursor.fail(tet.offset,
                  fmt::format("element {} has node {}, which the file does not have", tet.tag, tet.nodes[k]));
    corners[k] = found->second;
  }
  return corners;
}

TetMesh make_mesh(const MshCursor& cursor, const MshContents& contents, double scale) {
  constexpr std::size_t most = 1u << 29;
  if (contents.nodes.size() >= most || contents.tets.size() >= most)
    cursor.fail(0, fmt::format("the file has {} nodes and {} tets, fewer than {} are supported", contents.nodes.size(),
                               contents.tets.size(), most));
  if (contents.tets.empty()) cursor.fail(0, "the file has no tets; was only the surface meshed?");
  const std::vector<TagIndex> tags = sorted_tags(cursor, contents.nodes);
  TetMesh mesh;
  mesh.vertices.reserve(contents.nodes.size());
  for (const MshNode& node : contents.nodes) mesh.vertices.push_back(scale * node.x);
  mesh.tets.reserve(contents.tets.size());
  for (const MshTet& tet : contents.tets) {
    mesh.tets.push_back(corners_of(cursor, tet, tags));
    const double volume = tet_volume(mesh, mesh.num_tets() - 1);
    if (!(volume > 0.0))
      cursor.fail(tet.offset,
                  fmt::format("element {} (nodes {} {} {} {}) is {}: volume {:g} m3", tet.tag, tet.nodes[0],
                              tet.nodes[1], tet.nodes[2], tet.nodes[3], volume < 0.0 ? "inverted" : "flat", volume));
  }
  return mesh;
}

}  // namespace

TetMesh parse_msh(std::string_view bytes, const std::string& name, double scale) {
  if (!(scale > 0.0) || !std::isfinite(scale))
    throw InputError(fmt::format("mesh_scale is {:g}, allowed: above 0 m per unit of the file", scale));
  MshCursor cursor(bytes, name);
  const MshContents contents = read_sections(cursor);
  return make_mesh(cursor, contents, scale);
}

TetMesh read_msh(const std::filesystem::path& path, double scale) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError(fmt::format("{}: there is no such mesh file", path.string()));
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream) throw InputError(fmt::format("{}: cannot be read", path.string()));
  return parse_msh(bytes, path.string(), scale);
}

}  // namespace knap
