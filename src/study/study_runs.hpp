#pragma once
// The finished runs of one or several campaigns, as a study needs them.
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "analysis/breakage.hpp"

namespace knap {

/// Means over the resolved fragments but the largest, by mass; NaN where there are none.
struct ShapeMeans {
  double sphericity = 0.0, elongation = 0.0, flatness = 0.0, convexity = 0.0;
};

/// One impact of a repeated one.
struct ImpactRow {
  double chipping_ratio = 0.0, specific_energy = 0.0;  ///< [-], [J/kg]
};

struct StudyRun {
  std::string name{};
  std::filesystem::path folder{};
  bool has_wall = false;      ///< one particle strikes the plane z = 0; else speed, angle and friction are 0
  double speed = 0.0;         ///< [m/s]
  double angle = 0.0;         ///< from the plane of the wall [rad]
  double friction = 0.0;      ///< of the wall
  double diameter = 0.0;      ///< [m]
  double element_size = 0.0;  ///< mean edge, the resolution floor [m]
  std::string series{};       ///< what else varies but speed, angle, mesh and seeds: "diameter = 0.001 m"; "" = nothing
  std::string mesh{};         ///< keys of the mesh that vary
  std::string seed{};         ///< seeds that vary
  std::string rest_of_case{};  ///< all that the case says but speed, angle, wall friction, mesh, seeds and output
  std::string breakage_class{};
  std::map<std::string, double> numbers{};  ///< of results.csv; a cell that is empty is not there
  std::vector<SizeRow> sizes{};             ///< ascending
  ShapeMeans shape{};
  std::vector<ImpactRow> impacts{};  ///< of a repeated impact; all else is of the first
  double breakage_ratio = 0.0;       ///< mass fraction that passes the study's sieve

  /// NaN if it is not there.
  double number(const std::string& column) const;
  double chipping_ratio() const { return number("breakage.chipping_ratio"); }
};

struct StudyTable {
  std::vector<std::string> columns{};
  std::vector<std::vector<std::string>> rows{};  ///< text, as in results.csv
};

struct Study {
  std::vector<StudyRun> runs{};  ///< done
  StudyTable table{};            ///< all, of the first folder's columns and what others add
  std::size_t failed = 0, waiting = 0;
  std::vector<std::string> unreadable{};  ///< runs that are done but cannot be read, and why
  double sieve = 0.0;                     ///< of the breakage ratio [m]; 0 = the diameter over 2^(1/4)
};

/// The last part of a folder's name.
std::string folder_name(const std::filesystem::path& folder);

/// Reads the folders of campaigns. `sieve`: of the breakage ratio [m]; 0 = each diameter over 2^(1/4). Throws
/// InputError naming folder and what is wrong; where no run is done.
Study read_study(std::span<const std::filesystem::path> folders, double sieve);

/// Runs alike but for mesh and seed.
struct Condition {
  std::string series{};
  double speed = 0.0, angle = 0.0, friction = 0.0;
  std::vector<std::size_t> runs{};  ///< of the study
};
/// By series, friction, angle, speed, ascending.
std::vector<Condition> conditions(const Study& study);

/// The different series in the order of conditions(), with the friction where that varies: what is fitted by itself.
struct Series {
  std::string name{};  ///< "" if there is only one
  std::vector<Condition> conditions{};
};
std::vector<Series> series_of(const Study& study);

}  // namespace knap
