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
constexpr std::array<std::array<unsigned char, 3>, 4> colours{
    {{31, 90, 160}, {200, 80, 30}, {60, 130, 70}, {120, 80, 150}}};

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
  const bool is_line = series.style == PlotSeries::Style::Line && series.x.size() > 1;
  vtkPlot* plot = chart->AddPlot(is_line ? vtkChart::LINE : vtkChart::POINTS);
  plot->SetInputData(table_of(series), 0, 1);
  const auto& [red, green, blue] = colours[number % colours.size()];
  plot->SetColor(red, green, blue, 255);
  plot->SetWidth(is_line ? 2.0F * enlargement : 1.0F);
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

// About seven round numbers around the values: steps of 1, 2 or 5 times a power of ten.
void set_ticks(vtkAxis* axis, const Interval& range) {
  constexpr double most_ticks = 8.0;
  const double width = std::max(range.high - range.low, 1e-3 * std::abs(range.high) + 1e-300);
  const double power = std::pow(10.0, std::floor(std::log10(width / most_ticks)));
  double step = power;
  for (const double factor : {2.0, 5.0, 10.0})
    if (width / step > most_ticks) step = factor * power;
  double first = std::floor(range.low / step), last = std::ceil(range.high / step);
  if (first == last) first -= 1.0, last += 1.0;  // a single value that is a multiple of the step
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (double i = first; i <= last; ++i) {
    positions->InsertNextValue(i * step);
    labels->InsertNextValue(fmt::format("{:.6g}", i * step));
  }
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(first * step, last * step);
  axis->SetCustomTickPositions(positions, labels);
}

void set_axis(vtkAxis* axis, const std::string& label, const Interval& range) {
  set_ticks(axis, range);
  axis->SetTitle(label);
  axis->GetTitleProperties()->SetFontSize(enlargement * text_size);
  axis->GetTitleProperties()->SetBold(false);
  axis->GetLabelProperties()->SetFontSize(enlargement * (text_size - 4));
  axis->GetPen()->SetWidth(1.5F * enlargement);
  axis->GetGridPen()->SetWidth(1.0F * enlargement);
}

}  // namespace

std::string png_of_plot(const PlotInput& input) {
  use_one_vtk_thread();
  vtkNew<vtkChartXY> chart;
  constexpr float right_margin = 30.0F * enlargement;  // for half of the last number
  chart->SetAutoSize(false);
  chart->SetSize(vtkRectf(0.0F, 0.0F, enlargement * plot_width - right_margin, enlargement * plot_height));
  chart->SetTitle(input.title);
  chart->GetTitleProperties()->SetFontSize(enlargement * (text_size + 4));
  chart->SetShowLegend(input.series.size() > 1);
  chart->GetLegend()->SetLabelSize(enlargement * (text_size - 4));
  chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::LEFT);
  for (std::size_t i = 0; i < input.series.size(); ++i) add_series(chart, input.series[i], i);
  set_axis(chart->GetAxis(vtkAxis::BOTTOM), input.x_label, range_of(input, &PlotSeries::x));
  set_axis(chart->GetAxis(vtkAxis::LEFT), input.y_label, range_of(input, &PlotSeries::y));
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
