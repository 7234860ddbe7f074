#pragma once
// Thin plates in plane strain with a slit: an element or two through the thickness, both faces held.
#include <functional>

#include "simulation/make_simulation.hpp"

namespace knap {

struct PlateOptions {
  Vec3 lengths = Vec3::Ones();  ///< from the origin [m]
  double element = 1.0;         ///< cell of the aligned mesh, mean edge of the other [m]
  bool is_aligned = true;       ///< cells of six tets: planes between cells are made of facets; else gmsh's
  std::int64_t seed = 0;        ///< of gmsh's mesh
};

TetMesh plate_mesh(const PlateOptions& options);

/// One cell through the thickness between these places along x and y, ascending [m].
TetMesh graded_plate(std::span<const double> x, std::span<const double> y, double thickness);

/// Places from `from` to `to` whose distances grow from `first` by at most `growth` each time; both ends are there.
std::vector<double> stretched(double from, double to, double first, double growth);

using Where = std::function<bool(const Vec3&)>;
std::vector<Index> vertices_where(const TetMesh& mesh, const Where& is_there);

/// Without the tets whose centroid is there.
TetMesh without_tets(const TetMesh& mesh, const Where& is_there);

/// A beam on two lines at its foot, pushed down along a line on its top.
struct BeamLoad {
  std::array<double, 2> supports{};  ///< x [m]
  double place = 0.0;                ///< of the load along x [m]
  double top = 0.0;                  ///< y [m]
  double way = 0.0;                  ///< of the load by the end [m]
  double duration = 0.0;             ///< the speed grows in the first 30 % of it [s]
};
/// Plane strain, the supports, and the load, in this order; the load's line is held along x.
std::vector<PrescribedOptions> bending(const TetMesh& mesh, const BeamLoad& load);

/// Both faces z = 0 and z = thickness held along z.
PrescribedOptions plane_strain(const TetMesh& mesh);

/// Middle of a facet in the mesh [m].
Vec3 facet_middle(const Simulation& s, Index facet);

/// The facets between tets on either side of the plane where coordinate `axis` is `place`.
std::vector<Index> facets_between(const Simulation& s, int axis, double place);

/// Cracks them for good where their middle is there, in a simulation just made. Where it is in the zone ahead they are
/// cracked without damage: facets at a sharp tip would open late, at a multiple of G_c on meshes like these.
void open_slit(
    Simulation& s, std::span<const Index> facets, const Where& is_there,
    const Where& is_zone = [](const Vec3&) { return false; });

/// Leaves only these facets breakable.
void break_only(Simulation& s, const std::function<bool(Index)>& may_break);
void break_only(Simulation& s, std::span<const Index> facets);

/// No corner of which bears anything any more.
bool has_failed(const Simulation& s, Index facet);

}  // namespace knap
