#include "io/plot.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/errors.hpp"
#include "io/file_output.hpp"
#include "io/plot_drawing.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

void check_input(const PlotInput& input) {
  const auto finite = [](double value) { return std::isfinite(value); };
  const auto positive = [](double value) { return value > 0.0; };
  bool has_points = false;
  for (const PlotSeries& series : input.series) {
    if (series.x.size() != series.y.size() || series.low.size() != series.high.size() ||
        (!series.low.empty() && series.low.size() != series.y.size()))
      throw std::invalid_argument("plot: a series has unequal lengths");
    for (const auto* values : {&series.x, &series.y, &series.low, &series.high})
      if (!std::all_of(values->begin(), values->end(), finite))
        throw RuntimeFailure("plot: a value is not a finite number");
    for (const auto* values : {&series.y, &series.low, &series.high})
      if (input.log_y && !std::all_of(values->begin(), values->end(), positive))
        throw RuntimeFailure("plot: a value on a logarithmic axis is not above 0");
    if (input.log_x && !std::all_of(series.x.begin(), series.x.end(), positive))
      throw RuntimeFailure("plot: a value on a logarithmic axis is not above 0");
    has_points = has_points || !series.x.empty();
  }
  if (!has_points) throw RuntimeFailure("plot: there is nothing to draw");
}

}  // namespace

void draw_plot(const fs::path& png, const PlotInput& input) {
  check_input(input);
  write_text_atomically(png, png_of_plot(input));
}

void draw_plot_twice(const fs::path& stem, const PlotInput& input) {
  draw_plot(stem.string() + ".png", input);
  write_text_atomically(stem.string() + ".svg", svg_of_plot(input));
}

}  // namespace knap
