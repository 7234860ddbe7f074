#include "io/plot.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/errors.hpp"
#include "io/drawing_process.hpp"
#include "io/file_output.hpp"
#include "io/plot_scene.hpp"

namespace knap {
namespace {

void check_input(const PlotInput& input) {
  const auto finite = [](double value) { return std::isfinite(value); };
  const auto positive = [](double value) { return value > 0.0; };
  bool has_points = false;
  for (const PlotSeries& series : input.series) {
    if (series.x.size() != series.y.size()) throw std::invalid_argument("plot: a series has unequal lengths");
    if (!std::all_of(series.x.begin(), series.x.end(), finite) ||
        !std::all_of(series.y.begin(), series.y.end(), finite))
      throw RuntimeFailure("plot: a value is not a finite number");
    if ((input.log_x && !std::all_of(series.x.begin(), series.x.end(), positive)) ||
        (input.log_y && !std::all_of(series.y.begin(), series.y.end(), positive)))
      throw RuntimeFailure("plot: a value on a logarithmic axis is not above 0");
    has_points = has_points || !series.x.empty();
  }
  if (!has_points) throw RuntimeFailure("plot: there is nothing to draw");
}

}  // namespace

void draw_plot(const std::filesystem::path& png, const PlotInput& input) {
  check_input(input);
  write_text_atomically(png, png_drawn([&] { return png_of_plot(input); }, input.timeout));
}

}  // namespace knap
