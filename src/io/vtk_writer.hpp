#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "core/types.hpp"

namespace knap {

/// One value (or `components` values) a point or a cell, point by point; size = components * number of points or cells.
template <class T>
struct VtkArray {
  std::string name;  ///< with the unit, e.g. "velocity [m/s]"
  int components = 1;
  std::vector<T> values;
};
using VtkField = VtkArray<double>;
using VtkIntField = VtkArray<std::int32_t>;

/// One frame. Its cells are the tets, then the triangles; cell fields follow that order.
struct VtkGrid {
  std::vector<Vec3> points;  ///< [m]
  std::vector<TetCorners> tets;
  std::vector<std::array<Index, 3>> triangles;
  std::vector<VtkField> point_fields;
  std::vector<VtkField> cell_fields;
  std::vector<VtkIntField> point_int_fields;
  std::vector<VtkIntField> cell_int_fields;
};

/// Writes a .vtu file (raw appended binary, zlib) in one step; no points and no cells is valid. Throws RuntimeFailure
/// naming path and reason, std::invalid_argument for a field of the wrong size.
void write_vtu(const std::filesystem::path& path, const VtkGrid& grid);

/// A frame of a time series; `file` is relative to the folder of the .pvd.
struct PvdFrame {
  double time = 0.0;  ///< [s]
  std::string file;
};

/// Writes the .pvd index of a time series in one step. Throws RuntimeFailure naming path and reason.
void write_pvd(const std::filesystem::path& path, std::span<const PvdFrame> frames);

}  // namespace knap
