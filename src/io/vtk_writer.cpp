// The XML is made in memory and written by our own code: VTK's stream reports neither the path nor the reason of a
// failure, and a frame compressed is small.
#include "io/vtk_writer.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <stdexcept>

#include "core/errors.hpp"
#include "io/file_output.hpp"
#include "io/markup.hpp"

namespace knap {
namespace {

constexpr int keep_memory = 1;  // VTK reads our memory in place and never frees or writes it

template <class VtkType, class T>
void add_fields(vtkDataSetAttributes* attributes, const std::vector<VtkArray<T>>& fields, std::size_t tuples) {
  for (const VtkArray<T>& field : fields) {
    if (field.components < 1 || field.values.size() != tuples * static_cast<std::size_t>(field.components)) {
      throw std::invalid_argument(fmt::format("VTK field '{}': {} values for {} x {}", field.name, field.values.size(),
                                              tuples, field.components));
    }
    vtkNew<VtkType> array;
    array->SetName(field.name.c_str());
    array->SetNumberOfComponents(field.components);
    array->SetArray(const_cast<T*>(field.values.data()), static_cast<vtkIdType>(field.values.size()), keep_memory);
    attributes->AddArray(array);
  }
}

void set_points(vtkUnstructuredGrid* target, const std::vector<Vec3>& points) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  auto* first = const_cast<double*>(reinterpret_cast<const double*>(points.data()));
  coordinates->SetArray(first, static_cast<vtkIdType>(3 * points.size()), keep_memory);
  vtkNew<vtkPoints> vtk_points;
  vtk_points->SetData(coordinates);
  target->SetPoints(vtk_points);
}

void set_cells(vtkUnstructuredGrid* target, const VtkGrid& grid) {
  const auto num_tets = static_cast<vtkIdType>(grid.tets.size());
  const auto num_triangles = static_cast<vtkIdType>(grid.triangles.size());
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(num_tets + num_triangles, 4 * num_tets + 3 * num_triangles);
  for (const TetCorners& tet : grid.tets) cells->InsertNextCell({tet[0], tet[1], tet[2], tet[3]});
  for (const auto& triangle : grid.triangles) cells->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfValues(num_tets + num_triangles);
  for (vtkIdType i = 0; i < num_tets + num_triangles; ++i) types->SetValue(i, i < num_tets ? VTK_TETRA : VTK_TRIANGLE);
  target->SetCells(types, cells);
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const VtkGrid& grid) {
  const std::size_t num_cells = grid.tets.size() + grid.triangles.size();
  vtkNew<vtkUnstructuredGrid> target;
  set_points(target, grid.points);
  set_cells(target, grid);
  add_fields<vtkDoubleArray>(target->GetPointData(), grid.point_fields, grid.points.size());
  add_fields<vtkIntArray>(target->GetPointData(), grid.point_int_fields, grid.points.size());
  add_fields<vtkDoubleArray>(target->GetCellData(), grid.cell_fields, num_cells);
  add_fields<vtkIntArray>(target->GetCellData(), grid.cell_int_fields, num_cells);

  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(target);
  writer->SetDataModeToAppended();
  writer->SetEncodeAppendedData(false);
  writer->SetCompressorTypeToZLib();
  writer->SetWriteToOutputString(true);
  if (writer->Write() == 0) throw RuntimeFailure(fmt::format("{}: cannot write: VTK failed", path.string()));
  write_text_atomically(path, writer->GetOutputString());
}

void write_pvd(const std::filesystem::path& path, std::span<const PvdFrame> frames) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const PvdFrame& frame : frames) {
    text +=
        fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frame.time, markup_escaped(frame.file));
  }
  text += "  </Collection>\n</VTKFile>\n";
  write_text_atomically(path, text);
}

}  // namespace knap
