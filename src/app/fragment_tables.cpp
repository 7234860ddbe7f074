#include "app/fragment_tables.hpp"

#include "io/csv_table.hpp"

namespace knap {
namespace {

// The fragment by the strict label that each one by the damage label is part of.
std::vector<Index> strict_ids(const RunOutcome& outcome) {
  std::vector<Index> ids(outcome.damage.fragments.size(), none);
  for (std::size_t tet = 0; tet < outcome.damage.fragment_of_tet.size(); ++tet)
    ids[at(outcome.damage.fragment_of_tet[tet])] = outcome.strict.fragment_of_tet[tet];
  return ids;
}

std::vector<std::string> column_names() {
  return {"id",
          "strict_id",
          "particle",
          "mass [kg]",
          "volume [m3]",
          "tets",
          "centre_x [m]",
          "centre_y [m]",
          "centre_z [m]",
          "velocity_x [m/s]",
          "velocity_y [m/s]",
          "velocity_z [m/s]",
          "spin_x [rad/s]",
          "spin_y [rad/s]",
          "spin_z [rad/s]",
          "size_long [m]",
          "size_intermediate [m]",
          "size_short [m]",
          "sieve_size [m]",
          "surface [m2]",
          "sphericity [-]",
          "elongation [-]",
          "flatness [-]",
          "convexity [-]",
          "resolved"};
}

}  // namespace

void write_fragments(const std::filesystem::path& path, const RunOutcome& outcome) {
  CsvTable table = CsvTable::create(path, column_names());
  const auto strict = strict_ids(outcome);
  for (const Fragment& f : outcome.damage.fragments) {
    const std::int64_t resolved = f.resolved() ? 1 : 0;
    table.add_row({std::int64_t{f.id},
                   std::int64_t{strict[at(f.id)]},
                   std::int64_t{f.particle},
                   f.mass,
                   f.volume,
                   std::int64_t{f.num_tets},
                   f.centre.x(),
                   f.centre.y(),
                   f.centre.z(),
                   f.velocity.x(),
                   f.velocity.y(),
                   f.velocity.z(),
                   f.spin.x(),
                   f.spin.y(),
                   f.spin.z(),
                   f.sizes.x(),
                   f.sizes.y(),
                   f.sizes.z(),
                   f.sieve_size,
                   f.surface,
                   f.sphericity,
                   f.elongation,
                   f.flatness,
                   f.convexity,
                   resolved});
  }
}

void write_size_distribution(const std::filesystem::path& path, const RunOutcome& outcome, const Simulation& s) {
  CsvTable table = CsvTable::create(path, {"sieve_size [m]", "finer_mass_fraction [-]", "finer_count [-]"});
  const ParticleScale scale{s.reference.start.mass, outcome.card.input.diameter, s.reference.mean_edge};
  for (const SizeRow& row : size_distribution(outcome.damage.fragments, scale))
    table.add_row({row.sieve_size, row.finer_fraction, std::int64_t{row.finer_count}});
}

}  // namespace knap
