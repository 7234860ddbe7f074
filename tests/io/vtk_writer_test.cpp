#include "io/vtk_writer.hpp"

#include <gmock/gmock.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <limits>
#include <stdexcept>

#include "core/errors.hpp"
#include "tests/io/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {
namespace {

using testing::HasSubstr;
class VtkWriter : public TemporaryFolder {
 protected:
  vtkUnstructuredGrid* read_back(const std::filesystem::path& path) {
    reader_->SetFileName(path.c_str());
    reader_->Update();
    return reader_->GetOutput();
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader_;
};

VtkGrid two_tets_and_a_triangle() {
  VtkGrid grid;
  grid.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1.0 / 3.0, 1, -1e-300}};
  grid.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  grid.triangles = {{1, 2, 3}};
  grid.point_fields = {{"velocity [m/s]", 3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0.1, -0.0, 1e300}}};
  grid.point_int_fields = {{"vertex", 1, {4, 3, 2, 1, std::numeric_limits<std::int32_t>::min()}}};
  grid.cell_fields = {{"damage", 1, {0.25, 0.5, 1.0}}, {"energy [J]", 1, {1e-9, 2e-9, 0}}};
  grid.cell_int_fields = {{"fragment", 1, {0, 1, -1}}};
  return grid;
}

void expect_same(vtkDataArray* array, int components, const auto& values) {
  ASSERT_NE(array, nullptr);
  ASSERT_EQ(array->GetNumberOfComponents(), components);
  ASSERT_EQ(array->GetNumberOfValues(), static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto k = static_cast<vtkIdType>(i);
    EXPECT_EQ(array->GetComponent(k / components, static_cast<int>(k % components)), values[i]);
  }
}

TEST_F(VtkWriter, GridReadsBackTheSame) {
  const VtkGrid grid = two_tets_and_a_triangle();
  write_vtu(folder / "frame.vtu", grid);
  EXPECT_EQ(num_files(), 1u);
  vtkUnstructuredGrid* read = read_back(folder / "frame.vtu");
  ASSERT_EQ(read->GetNumberOfPoints(), 5);
  for (Index i = 0; i < 5; ++i) EXPECT_EQ(Vec3(read->GetPoint(i)), grid.points[at(i)]);
  ASSERT_EQ(read->GetNumberOfCells(), 3);
  for (Index t = 0; t < 2; ++t) {
    ASSERT_EQ(read->GetCellType(t), VTK_TETRA);
    vtkNew<vtkIdList> corners;
    read->GetCellPoints(t, corners);
    for (Index k = 0; k < 4; ++k) EXPECT_EQ(corners->GetId(k), grid.tets[at(t)][at(k)]);
  }
  EXPECT_EQ(read->GetCellType(2), VTK_TRIANGLE);
  expect_same(read->GetPointData()->GetArray("velocity [m/s]"), 3, grid.point_fields[0].values);
  expect_same(read->GetPointData()->GetArray("vertex"), 1, grid.point_int_fields[0].values);
  expect_same(read->GetCellData()->GetArray("damage"), 1, grid.cell_fields[0].values);
  expect_same(read->GetCellData()->GetArray("energy [J]"), 1, grid.cell_fields[1].values);
  expect_same(read->GetCellData()->GetArray("fragment"), 1, grid.cell_int_fields[0].values);
}

TEST_F(VtkWriter, FileIsCompressedAppendedAndTheSameEachTime) {
  write_vtu(folder / "a.vtu", two_tets_and_a_triangle());
  write_vtu(folder / "b.vtu", two_tets_and_a_triangle());
  const std::string text = content(folder / "a.vtu");
  EXPECT_EQ(text, content(folder / "b.vtu"));
  EXPECT_THAT(text, HasSubstr("vtkZLibDataCompressor"));
  EXPECT_THAT(text, HasSubstr("<AppendedData encoding=\"raw\">"));
}

TEST_F(VtkWriter, NoPointsAndNoCellsIsValid) {
  VtkGrid grid;
  grid.cell_fields = {{"damage", 1, {}}};
  write_vtu(folder / "empty.vtu", grid);
  vtkUnstructuredGrid* read = read_back(folder / "empty.vtu");
  EXPECT_EQ(read->GetNumberOfPoints(), 0);
  EXPECT_EQ(read->GetNumberOfCells(), 0);
}

TEST_F(VtkWriter, PointsWithoutCellsAreValid) {
  VtkGrid grid;
  grid.points = {{1, 2, 3}};
  write_vtu(folder / "points.vtu", grid);
  EXPECT_EQ(read_back(folder / "points.vtu")->GetNumberOfPoints(), 1);
}

TEST_F(VtkWriter, FieldOfTheWrongSizeIsRefused) {
  VtkGrid grid = two_tets_and_a_triangle();
  grid.cell_fields[0].values.pop_back();
  EXPECT_THAT(message_of<std::invalid_argument>([&] { write_vtu(folder / "frame.vtu", grid); }), HasSubstr("damage"));
  EXPECT_EQ(num_files(), 0u);
}

TEST_F(VtkWriter, FullDiskLeavesTheOldFrame) {
  write_vtu(folder / "frame.vtu", {});
  const std::string old = content(folder / "frame.vtu");
  const std::string message = message_of<RuntimeFailure>([&] {
    const FullDisk full(500);
    write_vtu(folder / "frame.vtu", two_tets_and_a_triangle());
  });
  EXPECT_THAT(message, HasSubstr("frame.vtu: cannot write: File too large"));
  EXPECT_EQ(content(folder / "frame.vtu"), old);
  EXPECT_EQ(num_files(), 1u);
}

TEST_F(VtkWriter, UnwritablePlaceIsNamed) {
  const std::filesystem::path path = below_a_file("frame.vtu");
  EXPECT_THAT(message_of<RuntimeFailure>([&] { write_vtu(path, {}); }), HasSubstr(path.string()));
}

TEST_F(VtkWriter, PvdListsTimesAndFiles) {
  const std::vector<PvdFrame> frames{{0.0, "frames/0000.vtu"}, {1.5e-6, "frames/<&\">.vtu"}};
  write_pvd(folder / "run.pvd", frames);
  const std::string text = content(folder / "run.pvd");
  EXPECT_THAT(text, HasSubstr("<VTKFile type=\"Collection\""));
  EXPECT_THAT(text, HasSubstr("<DataSet timestep=\"0\" part=\"0\" file=\"frames/0000.vtu\"/>"));
  EXPECT_THAT(text, HasSubstr("<DataSet timestep=\"1.5e-06\" part=\"0\" file=\"frames/&lt;&amp;&quot;&gt;.vtu\"/>"));
  EXPECT_THROW(write_pvd(below_a_file("run.pvd"), frames), RuntimeFailure);
}

}  // namespace
}  // namespace knap
