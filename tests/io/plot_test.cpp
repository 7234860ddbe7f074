#include "io/plot.hpp"

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {
namespace {

using Plot = TemporaryFolder;

// Pixels of nearly the colour of the first series.
int blue_pixels(const std::filesystem::path& png) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  EXPECT_EQ(image->GetDimensions()[0], 1200);
  EXPECT_EQ(image->GetDimensions()[1], 800);
  int count = 0;
  for (int y = 0; y < 800; ++y)
    for (int x = 0; x < 1200; ++x) {
      const auto* rgb = static_cast<const unsigned char*>(image->GetScalarPointer(x, y, 0));
      if (rgb[0] < 80 && rgb[1] < 130 && rgb[2] > 120) ++count;
    }
  return count;
}

TEST_F(Plot, ACurveIsThere) {
  PlotSeries curve{"force", {}, {}};
  for (int i = 0; i <= 100; ++i) curve.x.push_back(i), curve.y.push_back(i * (100.0 - i));
  draw_plot(folder / "plot.png", {.title = "a parabola", .x_label = "x [m]", .y_label = "y [N]", .series = {curve}});
  EXPECT_GT(blue_pixels(folder / "plot.png"), 1000);  // longer than the plot is wide
  EXPECT_EQ(num_files(), 1u);
}

TEST_F(Plot, OnePointIsEnough) {
  draw_plot(folder / "plot.png", {.series = {{"a", {1.0}, {2.0}, PlotSeries::Style::Points}}});
  EXPECT_GT(blue_pixels(folder / "plot.png"), 10);
}

TEST_F(Plot, APowerLawIsStraightOnLogarithmicAxes) {
  PlotSeries curve{"law", {}, {}};
  for (int i = 0; i <= 100; ++i) {
    curve.x.push_back(std::pow(10.0, 0.05 * i));
    curve.y.push_back(std::pow(curve.x.back(), -2.0));
  }
  draw_plot(folder / "log.png", {.series = {curve}, .log_x = true, .log_y = true});
  const int straight = blue_pixels(folder / "log.png");
  draw_plot(folder / "linear.png", {.series = {curve}});
  // The diagonal of the page, against an L along the axes.
  EXPECT_GT(straight, 1000);
  EXPECT_NE(content(folder / "log.png"), content(folder / "linear.png"));
  curve.y[3] = 0.0;
  EXPECT_THROW(draw_plot(folder / "no.png", {.series = {curve}, .log_y = true}), RuntimeFailure);
}

TEST_F(Plot, WhatCannotBeDrawnIsRefused) {
  EXPECT_THROW(draw_plot(folder / "plot.png", {.series = {{"a", {1.0}, {}}}}), std::invalid_argument);
  EXPECT_THROW(draw_plot(folder / "plot.png", {}), RuntimeFailure);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(draw_plot(folder / "plot.png", {.series = {{"a", {1.0}, {nan}}}}), RuntimeFailure);
  EXPECT_EQ(num_files(), 0u);
}

TEST_F(Plot, AlsoAsSvgWithErrorBarsAndMarks) {
  PlotSeries measured{
      .name = "measured", .x = {1.0, 2.0, 4.0}, .y = {1.0, 3.0, 9.0}, .style = PlotSeries::Style::Points};
  draw_plot_twice(folder / "plot", {.series = {measured}});
  const int without = blue_pixels(folder / "plot.png");
  const std::string bare = content(folder / "plot.svg");
  EXPECT_NE(bare.find("<svg"), std::string::npos);
  EXPECT_EQ(bare.find("<text"), std::string::npos);  // outlines: no font is needed to see it
  measured.low = {0.5, 2.0, 7.0}, measured.high = {2.0, 4.0, 9.0};
  draw_plot_twice(folder / "plot", {.series = {measured}});
  EXPECT_GT(blue_pixels(folder / "plot.png"), without + 100);
  const std::string bars = content(folder / "plot.svg");
  draw_plot_twice(folder / "plot", {.series = {measured}, .marks = {{3.0, "floor"}}});
  EXPECT_GT(content(folder / "plot.svg").size(), bars.size());
  measured.low.pop_back();
  EXPECT_THROW(draw_plot(folder / "bad.png", {.series = {measured}}), std::invalid_argument);
  measured.low = {0.0, 2.0, 7.0};
  EXPECT_THROW(draw_plot(folder / "bad.png", {.series = {measured}, .log_y = true}), RuntimeFailure);
}

}  // namespace
}  // namespace knap
