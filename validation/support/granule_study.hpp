#pragma once
// Studies of a granule's impact: many runs, each reduced to a few numbers.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "config/run_config.hpp"
#include "io/csv_table.hpp"
#include "simulation/simulation.hpp"
#include "validation/evidence.hpp"

namespace knap {

/// What became of a granule, by the damage label; energies over the incident one.
struct GranuleOutcome {
  double tets = 0.0;
  double chipping = 0.0;       ///< mass outside the largest fragment [-]
  double largest = 0.0;        ///< mass fraction [-]
  double second = 0.0;         ///< mass fraction [-]
  double t10 = 0.0;            ///< mass finer than d/10 [-]
  double restitution = 0.0;    ///< normal, of the whole particle [-]
  double kinetic = 0.0;        ///< at the end [-]
  double cohesion = 0.0;       ///< dissipated by cohesion [-]
  double friction = 0.0;       ///< of crack faces and between fragments [-]
  double closure = 0.0;        ///< of closing cracks [-]
  double wall_friction = 0.0;  ///< [-]
  double crack_area = 0.0;     ///< over the section of a sphere of this volume [-]
};
/// Names of its numbers with units, and the numbers in the same order.
std::vector<std::string> granule_columns();
std::vector<double> granule_numbers(const GranuleOutcome& outcome);
GranuleOutcome granule_from_numbers(const std::vector<double>& numbers);

/// Runs a case to its end. Throws as run_case.
GranuleOutcome break_granule(const RunConfig& config, const std::function<void(Simulation&)>& before_run = {});

/// The case of a sphere on the wall, graded to the contact. Sizes [m], speed [m/s].
struct GranuleCase {
  std::string preset = "zeolite_4ak";
  double diameter = 1.5e-3;
  double element_size = 0.0;
  double contact_element_size = 0.0;
  double contact_extent = 0.0;
  double speed = 0.0;
  int seed = 0;           ///< of the mesh, and of strengths if they scatter
  double end_time = 0.0;  ///< [s]; 0 = when nothing breaks any more
  std::vector<std::string> overrides{};
};
RunConfig granule_case(const GranuleCase& granule);

/// The runs of a study, one row each in a CSV file that grows as they end: what was killed goes on where it was.
class GranuleStudy {
 public:
  /// Keeps the rows of an earlier session if `keeps`, else begins anew.
  GranuleStudy(std::filesystem::path file, std::vector<std::string> parameters, bool keeps);
  /// The outcome at these parameters: from the file, or by running.
  GranuleOutcome at_parameters(const std::vector<double>& parameters, const std::function<RunConfig()>& make_case,
                               const std::function<void(Simulation&)>& before_run = {});
  /// Tells how many of its runs are of an earlier session, if any.
  void tell_kept(Evidence& evidence) const;

 private:
  std::size_t num_parameters_;
  std::vector<std::vector<double>> rows_{};  ///< parameters, then numbers
  std::size_t num_kept_ = 0;
  CsvTable table_;
};

double mean(const std::vector<double>& values);
/// Standard deviation of a sample; 0 for fewer than two values.
double spread(const std::vector<double>& values);

}  // namespace knap
