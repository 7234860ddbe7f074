#include "meshing/read_msh.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/errors.hpp"
#include "meshing/mesh_quality.hpp"

namespace knap {
namespace {

using testing::AllOf;
using testing::HasSubstr;

struct Format {
  double version;
  bool binary;
  bool parametric;
};

class EveryFormat : public testing::TestWithParam<Format> {};

INSTANTIATE_TEST_SUITE_P(ReadMsh, EveryFormat,
                         testing::Values(Format{2.2, false, false}, Format{2.2, true, false}, Format{4.1, false, false},
                                         Format{4.1, true, false}, Format{4.1, false, true}, Format{4.1, true, true}),
                         [](const auto& instance) {
                           return fmt::format("v{}_{}{}", static_cast<int>(10 * instance.param.version),
                                              instance.param.binary ? "binary" : "ascii",
                                              instance.param.parametric ? "_parametric" : "");
                         });

// The tets of the current gmsh model as corner coordinates.
std::vector<std::array<Vec3, 4>> gmsh_tets() {
  std::vector<std::size_t> node_tags, tet_tags, tet_nodes;
  std::vector<double> x, parameters;
  gmsh::model::mesh::getNodes(node_tags, x, parameters);
  std::map<std::size_t, Vec3> place;
  for (std::size_t i = 0; i < node_tags.size(); ++i) place[node_tags[i]] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
  gmsh::model::mesh::getElementsByType(4, tet_tags, tet_nodes);
  std::vector<std::array<Vec3, 4>> tets(tet_tags.size());
  for (std::size_t i = 0; i < tet_nodes.size(); ++i) tets[i / 4][i % 4] = place[tet_nodes[i]];
  return tets;
}

TEST_P(EveryFormat, ReadsWhatGmshWrites) {
  const Format& format = GetParam();
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      fmt::format("knap_{}_{}.msh", ::getpid(), testing::UnitTest::GetInstance()->random_seed());
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
  gmsh::option::setNumber("Mesh.MshFileVersion", format.version);
  gmsh::option::setNumber("Mesh.Binary", format.binary);
  gmsh::option::setNumber("Mesh.SaveParametric", format.parametric);
  gmsh::option::setNumber("Mesh.SaveAll", 1);
  const int sphere = gmsh::model::occ::addSphere(0, 0, 0, 0.5);
  gmsh::model::occ::synchronize();
  gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {sphere}), "grain");
  gmsh::model::mesh::generate(3);
  gmsh::write(path);
  const auto expected = gmsh_tets();
  gmsh::finalize();

  const TetMesh mesh = read_msh(path, 2.0);
  std::filesystem::remove(path);
  EXPECT_NO_THROW(check_mesh(mesh));
  ASSERT_EQ(mesh.tets.size(), expected.size());
  const double tolerance = format.binary ? 0.0 : 2e-15;  // gmsh writes 16 digits
  for (std::size_t t = 0; t < expected.size(); ++t)
    for (std::size_t k = 0; k < 4; ++k)
      ASSERT_LE((mesh.vertices[at(mesh.tets[t][k])] - 2.0 * expected[t][k]).norm(), tolerance);
}

// One tet, a triangle and a point.
const std::string nodes2 = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n7 0 0 1\n$EndNodes\n";
const std::string elements2 = "$Elements\n3\n1 15 2 0 1 1\n2 2 2 0 1 1 2 3\n9 4 2 0 1 1 2 3 7\n$EndElements\n";
const std::string format2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string format4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string nodes4 = "$Nodes\n1 4 1 7\n3 1 0 4\n1\n2\n3\n7\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n";
const std::string elements4 = "$Elements\n2 2 2 9\n2 1 2 1\n2 1 2 3\n3 1 4 1\n9 1 2 3 7\n$EndElements\n";

std::string message_of(const std::string& bytes, double scale = 1e-3) {
  try {
    parse_msh(bytes, "grain.msh", scale);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t place = text.find(what);
  EXPECT_NE(place, std::string::npos) << what;
  return text.replace(place, what.size(), with);
}

TEST(ReadMsh, ReadsHandWrittenFilesInBothVersions) {
  for (const std::string& file : {format2 + nodes2 + elements2, format4 + nodes4 + elements4}) {
    const TetMesh mesh = parse_msh(file, "grain.msh", 1e-3);
    EXPECT_EQ(mesh.num_vertices(), 4);
    ASSERT_EQ(mesh.num_tets(), 1);
    EXPECT_EQ(mesh.tets[0], (TetCorners{0, 1, 2, 3}));
    EXPECT_DOUBLE_EQ(volume(mesh), 1e-9 / 6.0);
  }
}

TEST(ReadMsh, WindowsLineEndsUnknownSectionsAndAnyOrderAreFine) {
  std::string file = format2 + "$Comments\nhello $Nodes\n$EndComments\n\n$Periodic\n$EndPeriodic\n" + elements2 +
                     nodes2 + "$NodeData\n1\n$EndNodeData";
  EXPECT_EQ(message_of(file), "none");
  std::string windows;
  for (const char c : file) windows += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(message_of(windows), "none");
}

TEST(ReadMsh, NamesFileAndLine) {
  EXPECT_THAT(message_of(format2 + replaced(nodes2, "3 0 1 0", "3 0 one 0") + elements2),
              AllOf(HasSubstr("grain.msh:8: "), HasSubstr("expected a node's y, found one")));
  EXPECT_THAT(message_of(format4 + nodes4 + replaced(elements4, "9 1 2 3 7", "9 1 2 3 8")),
              AllOf(HasSubstr("grain.msh:21: "), HasSubstr("element 9 has node 8")));
}

TEST(ReadMsh, RefusesAnInvertedOrFlatTet) {
  EXPECT_THAT(message_of(format2 + nodes2 + replaced(elements2, "1 2 3 7", "2 1 3 7")),
              AllOf(HasSubstr("grain.msh:15: "), HasSubstr("element 9 (nodes 2 1 3 7) is inverted")));
  EXPECT_THAT(message_of(format2 + replaced(nodes2, "7 0 0 1", "7 1 1 0") + elements2), HasSubstr("is flat"));
  EXPECT_THAT(message_of(format2 + nodes2 + replaced(elements2, "1 2 3 7", "1 2 3 3")), HasSubstr("is flat"));
}

TEST(ReadMsh, RefusesOtherElements) {
  for (const auto& [type, name] : {std::pair{5, "hexahedron"}, {6, "prism"}, {7, "pyramid"}, {3, "quadrangle"}})
    EXPECT_THAT(message_of(format2 + nodes2 + replaced(elements2, "9 4 2", fmt::format("9 {} 2", type))),
                AllOf(HasSubstr(name), HasSubstr("only meshes of tets")));
  for (const auto& [type, name] : {std::pair{11, "10-node tet"}, {9, "6-node triangle"}, {8, "3-node line"}})
    EXPECT_THAT(message_of(format4 + nodes4 + replaced(elements4, "3 1 4 1", fmt::format("3 1 {} 1", type))),
                AllOf(HasSubstr(name), HasSubstr("Mesh.ElementOrder = 1")));
  EXPECT_THAT(message_of(format2 + nodes2 + replaced(elements2, "9 4 2", "9 77 2")), HasSubstr("type 77"));
}

TEST(ReadMsh, RefusesOtherVersionsAndByteOrders) {
  EXPECT_THAT(message_of(replaced(format2, "2.2", "4.0") + nodes2 + elements2), HasSubstr("only versions 2.2 and 4.1"));
  EXPECT_THAT(message_of(replaced(format4, "0 8", "0 4") + nodes4 + elements4), HasSubstr("bytes of a number"));
  const std::string swapped("$MeshFormat\n2.2 1 8\n\0\0\0\1\n$EndMeshFormat\n", 40);
  EXPECT_THAT(message_of(swapped), AllOf(HasSubstr("byte 20"), HasSubstr("byte order")));
  EXPECT_THAT(message_of(replaced(swapped, "\1", "\2")), HasSubstr("byte order"));
  EXPECT_THAT(message_of("solid cube\n"), HasSubstr("expected $MeshFormat, found solid cube"));
  EXPECT_THAT(message_of(""), HasSubstr("expected $MeshFormat, found the end of the file"));
}

TEST(ReadMsh, CountsThatLieAllocateNothing) {
  for (const std::string count : {"5", "2147483647", "9223372036854775807"}) {
    EXPECT_THAT(message_of(format2 + replaced(nodes2, "4\n", count + "\n") + elements2), HasSubstr("grain.msh:"));
    EXPECT_THAT(
        message_of(format4 + replaced(nodes4, "1 4 1 7\n3 1 0 4", "1 " + count + " 1 7\n3 1 0 " + count) + elements4),
        HasSubstr("grain.msh:"));
    EXPECT_THAT(message_of(format4 + nodes4 + replaced(elements4, "3 1 4 1", "3 1 4 " + count)),
                HasSubstr("grain.msh:"));
  }
  EXPECT_THAT(message_of(format2 + replaced(nodes2, "4\n", "-4\n") + elements2), HasSubstr("-4"));
  EXPECT_THAT(message_of(format2 + replaced(nodes2, "4\n", "3\n") + elements2), HasSubstr("expected $EndNodes"));
  EXPECT_THAT(message_of(format4 + replaced(nodes4, "1 4 1 7", "1 5 1 7") + elements4), HasSubstr("announces 5"));
}

TEST(ReadMsh, RefusesRepeatedNodesAndSectionsAndMissingOnes) {
  EXPECT_THAT(message_of(format2 + replaced(nodes2, "3 0 1 0", "2 0 1 0") + elements2), HasSubstr("a second node 2"));
  EXPECT_THAT(message_of(format2 + nodes2 + nodes2 + elements2), HasSubstr("a second section $Nodes"));
  EXPECT_THAT(message_of(format2 + nodes2), HasSubstr("no section $Elements"));
  EXPECT_THAT(message_of(format2 + elements2), HasSubstr("no section $Nodes"));
  EXPECT_THAT(message_of(format2 + nodes2 + "$Elements\n0\n$EndElements\n"), HasSubstr("no tets"));
  EXPECT_THAT(message_of(format2 + nodes2 + "$Junk\n1 2 3\n" + elements2), HasSubstr("no $EndJunk"));
  EXPECT_THAT(message_of(format2 + "junk\n" + nodes2 + elements2), HasSubstr("expected a section"));
}

TEST(ReadMsh, RefusesNumbersThatAreNone) {
  for (const std::string bad : {"nan", "inf", "1e999", "0x10", "1,5", "--1"})
    EXPECT_THAT(message_of(format2 + replaced(nodes2, "2 1 0 0", "2 " + bad + " 0 0") + elements2),
                HasSubstr("grain.msh:7: "))
        << bad;
}

TEST(ReadMsh, EveryTruncationIsRefused) {
  for (const std::string& file : {format2 + nodes2 + elements2, format4 + nodes4 + elements4})
    for (std::size_t size = 0; size + 1 < file.size(); ++size)
      EXPECT_NE(message_of(file.substr(0, size)), "none") << size;
}

TEST(ReadMsh, RefusesScalesAndPathsThatMakeNoSense) {
  for (const double scale : {0.0, -1.0, std::nan("")})
    EXPECT_THAT(message_of(format2 + nodes2 + elements2, scale), HasSubstr("mesh_scale"));
  EXPECT_THROW(read_msh("/no/such/mesh.msh", 1.0), InputError);
  EXPECT_THROW(read_msh(std::filesystem::temp_directory_path(), 1.0), InputError);
}

}  // namespace
}  // namespace knap
