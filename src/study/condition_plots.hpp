#pragma once
// Means of runs alike over speed, angle or what follows from both, and their bootstrap.
#include <array>
#include <functional>

#include "study/findings.hpp"

namespace knap {

/// The two ways to tell how much broke, as measures; fits are made of both.
inline constexpr std::array responses{"breakage_ratio", "chipping_ratio"};
/// "breakage ratio".
std::string words(std::string measure);

/// v sin th [m/s], rounded to 0.1 mm/s: speeds alike up to round-off are one.
double normal_speed(double speed, double angle);

/// Ascending [rad].
std::vector<double> angles_of(const Series& series);
std::vector<Condition> at_angle(const Series& series, double angle);
/// The nearest to straight on.
std::vector<Condition> at_steepest_angle(const Series& series);

/// Means with intervals of a measure over x of the conditions.
PlotSeries points_of(const Study& study, const std::vector<Condition>& list, const std::string& measure_name,
                     const std::string& name, const std::function<double(const Condition&)>& x);
/// The same, one set of points for each angle.
PlotInput by_angle(const Study& study, const Series& series, const std::string& measure_name,
                   const std::function<double(const Condition&)>& x);
/// Adds a line through each set of points.
void join_points(PlotInput& plot);

/// Of each condition's runs.
double mean_of(const Study& study, const std::vector<std::size_t>& runs, const std::string& measure_name);
/// Two runs of a condition on average: without, a bootstrap says nothing.
bool has_repeats(const std::vector<Condition>& list);
/// The runs of each condition, as they were.
std::vector<std::vector<std::size_t>> runs_of(const std::vector<Condition>& list);
/// The runs of each condition drawn anew from themselves: [draw][condition][run].
std::vector<std::vector<std::vector<std::size_t>>> drawn_conditions(const std::vector<Condition>& list, int samples);

}  // namespace knap
