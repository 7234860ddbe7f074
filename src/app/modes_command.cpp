#include <fmt/format.h>

#include <cstdio>
#include <numbers>

#include "app/commands.hpp"
#include "app/particle_mesh.hpp"
#include "config/load_config.hpp"
#include "core/parallel.hpp"
#include "fem/lumped_mass.hpp"
#include "fem/tet_reference.hpp"
#include "io/csv_table.hpp"
#include "io/vtk_writer.hpp"
#include "quasistatic/modes.hpp"

namespace knap {
namespace {

Material long_term_material(const MaterialConfig& material) {
  return make_material(material.young_modulus, material.poisson_ratio, material.density);
}

// eta = omega R/c_T per Hz, for a sphere; 0 for other shapes, of which no tables exist.
double eta_per_hertz(const ParticleConfig& particle, const Material& material) {
  if (particle.shape != ParticleShape::Sphere) return 0.0;
  return std::numbers::pi * particle.diameter / s_wave_speed(material.small_strain(), material.density);
}

void write_table(const std::filesystem::path& path, std::span<const Mode> modes, double eta) {
  CsvTable table = CsvTable::create(path, {"mode", "frequency [Hz]", "eta [-]", "multiplicity"});
  const auto multiplicity = multiplicities(modes);
  for (std::size_t i = 0; i < modes.size(); ++i)
    table.add_row({std::int64_t(i + 1), modes[i].frequency,
                   eta > 0.0 ? CsvCell(eta * modes[i].frequency) : CsvCell(std::string()),
                   std::int64_t(multiplicity[i])});
}

void write_shapes(const std::filesystem::path& path, const TetMesh& mesh, std::span<const Mode> modes) {
  VtkGrid grid;
  grid.points = mesh.vertices;
  grid.tets = mesh.tets;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    VtkField field{fmt::format("mode_{:02} [-]", i + 1), 3, {}};
    for (const Vec3& u : modes[i].shape) field.values.insert(field.values.end(), u.begin(), u.end());
    grid.point_fields.push_back(std::move(field));
  }
  write_vtu(path, grid);
}

void print_table(std::span<const Mode> modes, double eta) {
  const auto multiplicity = multiplicities(modes);
  fmt::print("{:>6} {:>16} {:>14} {:>13}\n", "mode", "frequency [kHz]", eta > 0.0 ? "omega R/c_T" : "", "multiplicity");
  for (std::size_t i = 0; i < modes.size(); ++i)
    fmt::print("{:>6} {:>16.6g} {:>14} {:>13}\n", i + 1, 1e-3 * modes[i].frequency,
               eta > 0.0 ? fmt::format("{:.4f}", eta * modes[i].frequency) : "", multiplicity[i]);
}

}  // namespace

ExitCode modes_command(const ModesArguments& arguments) {
  namespace fs = std::filesystem;
  const RunConfig config = load_config(arguments.case_file, arguments.overrides);
  set_num_threads(config.run.threads);
  const fs::path out =
      arguments.out.empty() ? fs::path("out") / (arguments.case_file.stem().string() + "_modes") : arguments.out;
  std::error_code failure;
  fs::create_directories(out, failure);
  if (failure) throw RuntimeFailure(fmt::format("{}: cannot be made: {}", out.string(), failure.message()));

  const ParticleMesh particle = make_particle_mesh(config.particles.front());
  const TetMesh& mesh = particle.mesh;
  fmt::print("{} tets, {} nodes\n", mesh.num_tets(), mesh.num_vertices());
  std::fflush(stdout);
  const Topology topology = make_topology(mesh);
  const Material material = long_term_material(config.particles.front().material);
  const auto masses =
      lumped_masses(topology, corner_masses(topology, tet_volumes(mesh.tets, mesh.vertices), material.density));
  const auto modes = free_modes({topology, mesh.vertices, material, masses}, {.count = arguments.count});

  const double eta = eta_per_hertz(config.particles.front(), material);
  print_table(modes, eta);
  write_table(out / "modes.csv", modes, eta);
  write_shapes(out / "modes.vtu", mesh, modes);
  fmt::print("written to {}\n", out.string());
  return ExitCode::Ok;
}

}  // namespace knap
