#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/particle_mesh.hpp"
#include "config/load_config.hpp"
#include "io/vtk_writer.hpp"

namespace knap {
namespace {

VtkGrid quality_grid(const TetMesh& mesh) {
  VtkGrid grid;
  grid.points = mesh.vertices;
  grid.tets = mesh.tets;
  VtkField shape{"shape_quality [-]", 1, {}};
  VtkField volume{"volume [m3]", 1, {}};
  for (Index tet = 0; tet < mesh.num_tets(); ++tet) {
    shape.values.push_back(shape_quality(mesh, tet));
    volume.values.push_back(tet_volume(mesh, tet));
  }
  grid.cell_fields = {std::move(shape), std::move(volume)};
  return grid;
}

void print_quality(const ParticleMesh& particle) {
  const MeshQuality& q = particle.quality;
  fmt::print("Mesh\n");
  fmt::print("  tets, nodes       {}, {}\n", q.num_tets, q.num_vertices);
  fmt::print("  volume            {:.6g} mm3\n", 1e9 * q.total_volume);
  fmt::print("  edge              {:.3g} um mean, {:.3g} to {:.3g} um\n", 1e6 * q.mean_edge, 1e6 * q.min_edge,
             1e6 * q.max_edge);
  fmt::print("  at the contact    {:.3g} um mean, far from it {:.3g} um\n", 1e6 * particle.contact_element_size,
             1e6 * particle.element_size);
  fmt::print("  smallest height   {:.3g} um\n", 1e6 * q.min_altitude);
  fmt::print("  shape quality     {:.3f} mean, {:.3f} worst (1 = regular)\n", q.mean_shape, q.min_shape);
  fmt::print("  dihedral angle    {:.1f} deg smallest\n", q.min_dihedral * 180.0 / EIGEN_PI);
}

}  // namespace

ExitCode mesh_command(const MeshArguments& arguments) {
  if (arguments.out.extension() != ".vtu")
    throw InputError(fmt::format("--out {}: must end in .vtu", arguments.out.string()));
  const RunConfig config = load_config(arguments.case_file, arguments.overrides);
  const ParticleMesh particle = make_particle_mesh(config.particles[0]);
  write_vtu(arguments.out, quality_grid(particle.mesh));
  print_quality(particle);
  fmt::print("  written to        {}\n", arguments.out.string());
  return ExitCode::Ok;
}

}  // namespace knap
