#pragma once
// What a validation problem shows: numbers against references, its curve and its plot.
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "io/csv_table.hpp"
#include "io/plot.hpp"

namespace knap {

/// A number and where it has to lie; without bounds it is only told.
struct Metric {
  std::string name;  ///< with its unit: "peak force [N]"
  double value = 0.0;
  double reference = std::numeric_limits<double>::quiet_NaN();  ///< nan where there is only a bound
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  std::string tolerance{};  ///< "5 %", "at most 1e-10"
  std::string why{};        ///< this tolerance
};

enum class Judgement { Passes, Out, Told };
Judgement judge(const Metric& metric);

/// A column of a curve: its name with unit, and its values.
struct Column {
  std::string name;
  std::vector<double> values;
};

/// How much of a problem is asked for.
struct Extent {
  bool is_short = false;
  bool keeps_runs = false;
};

/// Collects what a problem shows; writes curve and plot into its folder at once.
class Evidence {
 public:
  /// `sources` holds reference.csv; the curve and the plot are written into `folder`.
  Evidence(std::string problem, std::filesystem::path sources, std::filesystem::path folder, Extent extent = {})
      : problem_(std::move(problem)), sources_(std::move(sources)), folder_(std::move(folder)), extent_(extent) {}

  /// Whether only the quick part is asked for.
  bool is_short() const { return extent_.is_short; }
  /// Whether a study goes on from the runs that its folder has from an earlier session.
  bool keeps_runs() const { return extent_.keeps_runs; }
  const std::filesystem::path& folder() const { return folder_; }
  /// Reads a CSV file of the problem's own folder in the sources.
  CsvColumns reference(const std::string& file = "reference.csv") const { return read_csv(sources_ / file); }

  /// |value/reference - 1| <= tolerance.
  void relative(const std::string& name, double value, double reference, double tolerance, const std::string& why);
  /// |value - reference| <= tolerance.
  void absolute(const std::string& name, double value, double reference, double tolerance, const std::string& why);
  void between(const std::string& name, double value, double low, double high, const std::string& why);
  void at_most(const std::string& name, double value, double bound, const std::string& why);
  void at_least(const std::string& name, double value, double bound, const std::string& why);
  /// A number without a verdict; `why` there is none.
  void tell(const std::string& name, double value, const std::string& why);

  /// Writes a table of columns of equal lengths as CSV.
  void curve(const std::vector<Column>& columns, const std::string& file = "curve.csv") const;
  /// Draws <problem>.png.
  void plot(const PlotInput& input) const;

  const std::vector<Metric>& metrics() const { return metrics_; }

 private:
  std::string problem_;
  std::filesystem::path sources_, folder_;
  Extent extent_;
  std::vector<Metric> metrics_{};
};

}  // namespace knap
