// Reads frames back, by VTK. What is wrong with a file VTK tells to the terminal unless one listens.
#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkExecutive.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fstream>

#include "core/errors.hpp"
#include "io/fragment_surfaces.hpp"

namespace knap {
namespace {

constexpr auto fragment_name = "fragment";
constexpr auto displacement_name = "displacement [m]";

[[noreturn]] void refuse(const std::filesystem::path& vtu, const std::string& reason) {
  throw InputError(fmt::format("{}: {}", vtu.string(), reason));
}

void note_error(vtkObject*, unsigned long, void* has_failed, void*) { *static_cast<bool*>(has_failed) = true; }

// Only the arrays that are needed: the others are most of the file.
void choose(vtkDataArraySelection* selection, const char* name) {
  selection->DisableAllArrays();
  selection->EnableArray(name);
}

vtkDataArray* array_of(vtkDataSetAttributes* attributes, const char* name, int components) {
  vtkDataArray* array = attributes->GetArray(name);
  return array != nullptr && array->GetNumberOfComponents() == components ? array : nullptr;
}

void read(vtkXMLUnstructuredGridReader* reader, const std::filesystem::path& vtu) {
  if (!std::ifstream(vtu).good() || std::filesystem::is_directory(vtu)) refuse(vtu, "cannot be read");
  bool has_failed = false;
  vtkNew<vtkCallbackCommand> listener;
  listener->SetCallback(note_error);
  listener->SetClientData(&has_failed);
  reader->AddObserver("ErrorEvent", listener);
  reader->GetExecutive()->AddObserver("ErrorEvent", listener);
  reader->SetReaderErrorObserver(listener);
  reader->SetParserErrorObserver(listener);
  reader->SetFileName(vtu.c_str());
  reader->UpdateInformation();
  if (!has_failed) {
    choose(reader->GetCellDataArraySelection(), fragment_name);
    choose(reader->GetPointDataArraySelection(), displacement_name);
    reader->Update();
  }
  if (has_failed || reader->GetErrorCode() != 0) refuse(vtu, "is no complete VTK file of an unstructured grid (.vtu)");
}

std::vector<TetCorners> tets_of(vtkUnstructuredGrid* grid, const std::filesystem::path& vtu) {
  std::vector<TetCorners> tets;
  vtkNew<vtkIdList> corners;
  for (vtkIdType t = 0; t < grid->GetNumberOfCells(); ++t) {
    if (grid->GetCellType(t) != VTK_TETRA) refuse(vtu, fmt::format("cell {} is no tet: this is no frame", t));
    grid->GetCellPoints(t, corners);
    TetCorners tet{};
    for (int k = 0; k < 4; ++k) {
      const vtkIdType node = corners->GetId(k);
      if (node < 0 || node >= grid->GetNumberOfPoints()) refuse(vtu, fmt::format("tet {} has no node {}", t, node));
      tet[at(k)] = static_cast<Index>(node);
    }
    tets.push_back(tet);
  }
  return tets;
}

std::vector<Index> fragments_of(vtkUnstructuredGrid* grid, const std::filesystem::path& vtu) {
  vtkDataArray* array = array_of(grid->GetCellData(), fragment_name, 1);
  if (array == nullptr) refuse(vtu, fmt::format("has no array '{}' on its cells: this is no frame", fragment_name));
  std::vector<Index> fragments;
  for (vtkIdType t = 0; t < grid->GetNumberOfCells(); ++t) {
    const double rank = array->GetTuple1(t);
    if (!(rank >= 0.0 && rank < static_cast<double>(grid->GetNumberOfCells())))
      refuse(vtu, fmt::format("tet {}: fragment {} is out of range", t, rank));
    fragments.push_back(static_cast<Index>(rank));
  }
  return fragments;
}

}  // namespace

FragmentSurfaces read_fragment_surfaces(const std::filesystem::path& vtu) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  read(reader, vtu);
  vtkUnstructuredGrid* grid = reader->GetOutput();
  const std::vector<TetCorners> tets = tets_of(grid, vtu);
  const std::vector<Index> fragments = fragments_of(grid, vtu);
  if (tets.empty()) refuse(vtu, "has no tets");

  vtkDataArray* displacement = array_of(grid->GetPointData(), displacement_name, 3);
  std::vector<Vec3> points, reference;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
    points.emplace_back(grid->GetPoint(i));
    if (displacement != nullptr) reference.push_back(points.back() - Vec3(displacement->GetTuple3(i)));
    if (!points.back().allFinite() || (displacement != nullptr && !reference.back().allFinite()))
      refuse(vtu, fmt::format("the position of node {} is not finite", i));
  }
  return make_fragment_surfaces({.points = points, .reference = reference, .tets = tets, .fragment = fragments});
}

}  // namespace knap
