#include "validation/support/granule_study.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "config/load_config.hpp"
#include "validation/support/case_run.hpp"

namespace knap {
namespace {

using Field = double GranuleOutcome::*;
struct NamedField {
  const char* name;
  Field field;
};
constexpr std::array<NamedField, 12> fields{{{"tets", &GranuleOutcome::tets},
                                             {"chipping ratio [-]", &GranuleOutcome::chipping},
                                             {"largest fragment [-]", &GranuleOutcome::largest},
                                             {"second fragment [-]", &GranuleOutcome::second},
                                             {"t10 [-]", &GranuleOutcome::t10},
                                             {"restitution [-]", &GranuleOutcome::restitution},
                                             {"kinetic energy [-]", &GranuleOutcome::kinetic},
                                             {"cohesion [-]", &GranuleOutcome::cohesion},
                                             {"crack and contact friction [-]", &GranuleOutcome::friction},
                                             {"closure [-]", &GranuleOutcome::closure},
                                             {"wall friction [-]", &GranuleOutcome::wall_friction},
                                             {"crack area over section [-]", &GranuleOutcome::crack_area}}};

CsvTable open_table(const std::filesystem::path& file, const std::vector<std::string>& columns, std::size_t rows) {
  return rows > 0 ? CsvTable::resume(file, rows) : CsvTable::create(file, columns);
}

std::vector<std::vector<double>> rows_of(const std::filesystem::path& file, const std::vector<std::string>& columns) {
  std::vector<std::vector<double>> rows;
  if (!std::filesystem::exists(file)) return rows;
  const CsvColumns table = read_csv(file);
  if (table.header != columns) return rows;
  for (std::size_t row = 0; row < table.values.front().size(); ++row) {
    rows.emplace_back();
    for (const auto& column : table.values) rows.back().push_back(column[row]);
  }
  return rows;
}

std::vector<std::string> with_granule_columns(std::vector<std::string> parameters) {
  for (const std::string& name : granule_columns()) parameters.push_back(name);
  return parameters;
}

}  // namespace

std::vector<std::string> granule_columns() {
  std::vector<std::string> names;
  for (const NamedField& field : fields) names.emplace_back(field.name);
  return names;
}

std::vector<double> granule_numbers(const GranuleOutcome& outcome) {
  std::vector<double> numbers;
  for (const NamedField& field : fields) numbers.push_back(outcome.*(field.field));
  return numbers;
}

GranuleOutcome granule_from_numbers(const std::vector<double>& numbers) {
  GranuleOutcome outcome;
  for (std::size_t i = 0; i < fields.size(); ++i) outcome.*(fields[i].field) = numbers.at(i);
  return outcome;
}

GranuleOutcome break_granule(const RunConfig& config, const std::function<void(Simulation&)>& before_run) {
  const CaseRun run = run_case(config, "granule", {.before_run = before_run});
  const BreakageMeasures& measures = run.outcome.damage.measures;
  const EnergyLedger& ledger = run.s.ledger;
  const auto share = [&ledger](EnergyTerm term) { return ledger[term] / ledger.reference; };
  const double radius = 0.5 * run.outcome.card.input.diameter;
  GranuleOutcome outcome{.tets = static_cast<double>(run.s.topology.num_tets()),
                         .chipping = measures.chipping_ratio,
                         .largest = measures.largest_mass_fraction,
                         .second = measures.second_mass_fraction,
                         .restitution = run.outcome.rebound.normal,
                         .kinetic = share(EnergyTerm::Kinetic),
                         .cohesion = share(EnergyTerm::CohesiveDissipated),
                         .friction = share(EnergyTerm::CrackFriction) + share(EnergyTerm::ContactDissipated),
                         .closure = share(EnergyTerm::ClosureImpact),
                         .wall_friction = share(EnergyTerm::ToolFriction),
                         .crack_area = run.outcome.cracks.area / (std::numbers::pi * radius * radius)};
  for (const FinerFraction& finer : measures.finer)
    if (finer.divisor == 10) outcome.t10 = finer.fraction;
  return outcome;
}

RunConfig granule_case(const GranuleCase& granule) {
  const std::string text = fmt::format(R"(
[particle]
diameter = {}
[mesh]
element_size = {}
contact_element_size = {}
contact_extent = {}
[material]
preset = "{}"
[fracture]
allow_unresolved = true
[impact]
speed = {}
[run]
threads = 1
seed = {}
{}
)",
                                       granule.diameter, granule.element_size, granule.contact_element_size,
                                       granule.contact_extent, granule.preset, granule.speed, granule.seed,
                                       granule.end_time > 0.0 ? fmt::format("end_time = {}", granule.end_time) : "");
  return config_from_text(text, "validation.toml", granule.overrides);
}

GranuleStudy::GranuleStudy(std::filesystem::path file, std::vector<std::string> parameters, bool keeps)
    : num_parameters_(parameters.size()),
      rows_(keeps ? rows_of(file, with_granule_columns(parameters)) : std::vector<std::vector<double>>{}),
      num_kept_(rows_.size()),
      table_(open_table(file, with_granule_columns(parameters), rows_.size())) {}

GranuleOutcome GranuleStudy::at_parameters(const std::vector<double>& parameters,
                                           const std::function<RunConfig()>& make_case,
                                           const std::function<void(Simulation&)>& before_run) {
  const auto split = static_cast<std::ptrdiff_t>(num_parameters_);
  for (const auto& row : rows_)
    if (std::equal(parameters.begin(), parameters.end(), row.begin()))
      return granule_from_numbers({row.begin() + split, row.end()});
  const GranuleOutcome outcome = break_granule(make_case(), before_run);
  std::vector<double> row = parameters;
  for (const double number : granule_numbers(outcome)) row.push_back(number);
  table_.add_row(std::vector<CsvCell>(row.begin(), row.end()));
  rows_.push_back(row);
  fmt::print("{}: chipping {:.4g}, largest {:.4g}, restitution {:.4g}\n", fmt::join(parameters, " "), outcome.chipping,
             outcome.largest, outcome.restitution);
  std::fflush(stdout);
  return outcome;
}

void GranuleStudy::tell_kept(Evidence& evidence) const {
  if (num_kept_ > 0)
    evidence.tell("runs kept from an earlier session", static_cast<double>(num_kept_), "validate --keep");
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double spread(const std::vector<double>& values) {
  if (values.size() < 2) return 0.0;
  const double centre = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

}  // namespace knap
