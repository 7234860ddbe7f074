#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace knap {

struct StudyOptions {
  std::string title{};
  double sieve = 0.0;   ///< of the breakage ratio [m]; 0 = the diameter over 2^(1/4), the next finer of that series
  double broken = 0.1;  ///< mass loss from which a particle is broken (Tavares & King 1998)
  std::vector<double> normal_speeds{8.0, 14.0};    ///< at which the tangential effect is told [m/s]
  int collapse_samples = 300;                      ///< bootstrap draws of the equivalent velocity's fit
  std::function<void(const std::string&)> tell{};  ///< what is being done now; may be empty
};

struct StudyOutcome {
  std::size_t runs = 0, failed = 0, waiting = 0;
  std::vector<std::string> unreadable{};  ///< runs left out, and why
  std::vector<std::string> verdicts{};
};

/// Analyses the runs of campaigns into `out`: analysis.json, tables, plots, and `page`, one HTML file. Throws
/// InputError where there is nothing to analyse, RuntimeFailure where something cannot be written.
StudyOutcome write_study(std::span<const std::filesystem::path> folders, const std::filesystem::path& out,
                         const std::filesystem::path& page, const StudyOptions& options);

}  // namespace knap
