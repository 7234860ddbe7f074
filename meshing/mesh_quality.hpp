#pragma once
#include <string_view>

#include "core/tet_mesh.hpp"

namespace knap {

struct MeshQuality {
  Index num_tets = 0;
  Index num_vertices = 0;
  double min_shape = 0.0;     ///< over the tets, see shape_quality [-]
  double mean_shape = 0.0;    ///< [-]
  double min_dihedral = 0.0;  ///< smallest angle between two facets of a tet [rad]
  double min_altitude = 0.0;  ///< smallest height of a tet over its facets [m]; the time step follows it
  double min_edge = 0.0;      ///< [m]
  double mean_edge = 0.0;     ///< over the distinct edges [m]
  double max_edge = 0.0;      ///< [m]
  double total_volume = 0.0;  ///< [m3]
};

/// 6 sqrt(2) V / l^3 with l the root mean square of the six edges: 1 for a regular tet, 0 for a flat one, negative for
/// an inverted one (Parthasarathy, Graichen & Hathaway 1994).
double shape_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
double shape_quality(const TetMesh& mesh, Index tet);

MeshQuality measure_quality(const TetMesh& mesh);

/// Throws InputError, beginning with `source` (e.g. the file's name), naming the first offenders, unless the mesh is
/// one piece of valid, positive tets that share facets properly, between 1 um and 10 m in size.
void check_mesh(const TetMesh& mesh, std::string_view source = "mesh");

}  // namespace knap
