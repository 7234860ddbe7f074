#include "io/plot_scene.hpp"

#include <fmt/format.h>

#include <vtkAutoInit.h>
#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "io/vtk_threads.hpp"
#include "io/window_image.hpp"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)
VTK_MODULE_INIT(vtkRenderingContextOpenGL2)

namespace knap {
namespace {

constexpr int text_size = 24;
constexpr std::array<std::array<unsigned char, 3>, 6> colours{
    {{31, 90, 160}, {200, 80, 30}, {60, 130, 70}, {120, 80, 150}, {110, 110, 110}, {190, 150, 20}}};

vtkNew<vtkTable> table_of(const PlotSeries& series) {
  vtkNew<vtkTable> table;
  for (const auto* values : {&series.x, &series.y}) {
    vtkNew<vtkDoubleArray> column;
    column->SetName(values == &series.x ? "x" : series.name.c_str());
    for (const double value : *values) column->InsertNextValue(value);
    table->AddColumn(column);
  }
  return table;
}

void add_series(vtkChartXY* chart, const PlotSeries& series, std::size_t number) {
  if (series.x.empty()) return;
  const bool is_line = series.style != PlotSeries::Style::Points && series.x.size() > 1;
  vtkPlot* plot = chart->AddPlot(is_line ? vtkChart::LINE : vtkChart::POINTS);
  plot->SetInputData(table_of(series), 0, 1);
  const auto& [red, green, blue] = colours[number % colours.size()];
  plot->SetColor(red, green, blue, 255);
  plot->SetWidth(is_line ? 2.0F * enlargement : 1.0F);
  if (series.style == PlotSeries::Style::Dashes) plot->GetPen()->SetLineType(vtkPen::DASH_LINE);
  if (is_line) return;
  auto* points = vtkPlotPoints::SafeDownCast(plot);
  points->SetMarkerStyle(vtkPlotPoints::CIRCLE);
  points->SetMarkerSize(9.0F * enlargement);
}

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
};

Interval range_of(const PlotInput& input, const std::vector<double> PlotSeries::*values) {
  Interval range;
  for (const PlotSeries& series : input.series)
    for (const double value : series.*values) range = {std::min(range.low, value), std::max(range.high, value)};
  return range;
}

struct Ticks {
  double low = 0.0, high = 1.0;  // ends of the axis
  std::vector<double> positions{};
  std::vector<std::string> labels{};

  void add(double position, double value) {
    positions.push_back(position);
    labels.push_back(fmt::format("{:.6g}", value));
  }
};

// About seven round numbers around the values: steps of 1, 2 or 5 times a power of ten.
Ticks linear_ticks(const Interval& range) {
  constexpr double most_ticks = 8.0;
  const double width = std::max(range.high - range.low, 1e-3 * std::abs(range.high) + 1e-300);
  const double power = std::pow(10.0, std::floor(std::log10(width / most_ticks)));
  double step = power;
  for (const double factor : {2.0, 5.0, 10.0})
    if (width / step > most_ticks) step = factor * power;
  double first = std::floor(range.low / step), last = std::ceil(range.high / step);
  if (first == last) first -= 1.0, last += 1.0;  // a single value that is a multiple of the step
  Ticks ticks{.low = first * step, .high = last * step};
  for (double i = first; i <= last; ++i) ticks.add(i * step, i * step);
  return ticks;
}

// For values that are decimal logarithms: whole decades, also twice and five times them where there are few.
Ticks logarithmic_ticks(const Interval& range) {
  const double margin = std::max(0.04 * (range.high - range.low), 0.02);
  Ticks ticks{.low = range.low - margin, .high = range.high + margin};
  const double decades = std::ceil(ticks.high) - std::floor(ticks.low);
  const double step = std::ceil(decades / 10.0);
  for (double i = std::floor(ticks.low); i <= ticks.high; i += step)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, i), position = std::log10(value);
      if ((factor == 1.0 || decades <= 3.0) && position >= ticks.low && position <= ticks.high)
        ticks.add(position, value);
    }
  return ticks;
}

// Markers do not lie on the ends of an axis.
void leave_room(Ticks& ticks, const PlotInput& input, const std::vector<double> PlotSeries::*values) {
  PlotInput markers{.log_x = input.log_x, .log_y = input.log_y};
  for (const PlotSeries& series : input.series)
    if (series.style == PlotSeries::Style::Points) markers.series.push_back(series);
  const Interval range = range_of(markers, values);
  const double room = 0.03 * (ticks.high - ticks.low);
  ticks.low = std::min(ticks.low, range.low - room);
  ticks.high = std::max(ticks.high, range.high + room);
}

void set_axis(vtkAxis* axis, const std::string& label, const Ticks& ticks) {
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (std::size_t i = 0; i < ticks.positions.size(); ++i) {
    positions->InsertNextValue(ticks.positions[i]);
    labels->InsertNextValue(ticks.labels[i]);
  }
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(ticks.low, ticks.high);
  axis->SetCustomTickPositions(positions, labels);
  axis->SetTitle(label);
  axis->GetTitleProperties()->SetFontSize(enlargement * text_size);
  axis->GetTitleProperties()->SetBold(false);
  axis->GetLabelProperties()->SetFontSize(enlargement * (text_size - 4));
  axis->GetPen()->SetWidth(1.5F * enlargement);
  axis->GetGridPen()->SetWidth(1.0F * enlargement);
}

// How many points of the curves lie in each corner: top left, top right, bottom left, bottom right.
std::array<int, 4> points_in_corners(const PlotInput& input, const Ticks& x, const Ticks& y) {
  constexpr double width = 0.4, height = 0.25;  // of a corner, over the page
  std::array<int, 4> points{};
  for (const PlotSeries& series : input.series)
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const double right = (series.x[i] - x.low) / (x.high - x.low), up = (series.y[i] - y.low) / (y.high - y.low);
      const bool in_column = right < width || right > 1.0 - width, in_row = up < height || up > 1.0 - height;
      if (in_column && in_row) ++points[(right > 0.5 ? 1 : 0) + (up < 0.5 ? 2 : 0)];
    }
  return points;
}

// The corner with the fewest points, so that the legend hides little. Where none is free, the axis grows to make room.
void place_legend(vtkChartLegend* legend, const PlotInput& input, const Ticks& x, Ticks& y) {
  constexpr double room = 0.35;  // over the height of the axis
  std::array<int, 4> points = points_in_corners(input, x, y);
  if (input.series.size() > 1 && *std::min_element(points.begin(), points.end()) > 0) {
    y.high += room * (y.high - y.low);
    points = points_in_corners(input, x, y);
  }
  const auto corner = std::min_element(points.begin(), points.end()) - points.begin();
  legend->SetHorizontalAlignment(corner % 2 == 0 ? vtkChartLegend::LEFT : vtkChartLegend::RIGHT);
  legend->SetVerticalAlignment(corner < 2 ? vtkChartLegend::TOP : vtkChartLegend::BOTTOM);
}

// Values on a logarithmic axis are drawn as their logarithms.
PlotInput as_drawn(PlotInput input) {
  for (PlotSeries& series : input.series) {
    if (input.log_x)
      for (double& x : series.x) x = std::log10(x);
    if (input.log_y)
      for (double& y : series.y) y = std::log10(y);
  }
  return input;
}

}  // namespace

std::string png_of_plot(const PlotInput& given) {
  const PlotInput input = as_drawn(given);
  use_one_vtk_thread();
  vtkNew<vtkChartXY> chart;
  constexpr float right_margin = 30.0F * enlargement;  // for half of the last number
  chart->SetAutoSize(false);
  chart->SetSize(vtkRectf(0.0F, 0.0F, enlargement * plot_width - right_margin, enlargement * plot_height));
  chart->SetTitle(input.title);
  chart->GetTitleProperties()->SetFontSize(enlargement * (text_size + 4));
  chart->SetShowLegend(input.series.size() > 1);
  chart->GetLegend()->SetLabelSize(enlargement * (text_size - 4));
  for (std::size_t i = 0; i < input.series.size(); ++i) add_series(chart, input.series[i], i);
  const auto ticks_of = [&](bool logarithmic, const std::vector<double> PlotSeries::*values) {
    const Interval range = range_of(input, values);
    Ticks ticks = logarithmic ? logarithmic_ticks(range) : linear_ticks(range);
    leave_room(ticks, input, values);
    return ticks;
  };
  const Ticks x = ticks_of(input.log_x, &PlotSeries::x);
  Ticks y = ticks_of(input.log_y, &PlotSeries::y);
  place_legend(chart->GetLegend(), input, x, y);
  set_axis(chart->GetAxis(vtkAxis::BOTTOM), input.x_label, x);
  set_axis(chart->GetAxis(vtkAxis::LEFT), input.y_label, y);
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  vtkNew<vtkRenderer> page;
  page->SetBackground(1.0, 1.0, 1.0);
  page->AddActor(actor);
  actor->GetScene()->SetRenderer(page);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(enlargement * plot_width, enlargement * plot_height);
  if (window->SupportsOpenGL() == 0) throw RuntimeFailure("no OpenGL 3.2 on this display");
  window->AddRenderer(page);
  window->Render();
  return png_of(window);
}

}  // namespace knap
