// Cairo draws the plots: one drawing for PNG and SVG, without a display. Alternative: VTK's charts, whose SVG lacks
// the text's measures and cuts curves off.
#include "io/plot_drawing.hpp"

#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/errors.hpp"
#include "io/plot_axis.hpp"

namespace knap {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;
using Colour = std::array<double, 3>;

constexpr double text_size = 22.0, title_size = 24.0, line_width = 2.5, marker_radius = 6.5;
constexpr Colour black{0.0, 0.0, 0.0}, grey{0.45, 0.45, 0.45}, pale{0.90, 0.90, 0.90};
// Told apart also by those who see few colours (Okabe & Ito 2008), the first and the second as they always were.
constexpr std::array<Colour, 8> colours{{{0.12, 0.35, 0.63},
                                         {0.78, 0.31, 0.12},
                                         {0.00, 0.55, 0.40},
                                         {0.60, 0.30, 0.65},
                                         {0.35, 0.35, 0.35},
                                         {0.85, 0.60, 0.00},
                                         {0.34, 0.71, 0.91},
                                         {0.80, 0.47, 0.65}}};

struct Point {
  double x = 0.0, y = 0.0;
};

struct Box {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
};

void set(cairo_t* page, const Colour& colour, double opacity = 1.0) {
  cairo_set_source_rgba(page, colour[0], colour[1], colour[2], opacity);
}

double width_of(cairo_t* page, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(page, text.c_str(), &extents);
  return extents.x_advance;
}

// `anchor` is the part of the text left of the point: 0, 0.5 or 1. Outlines, so that no font is asked for later.
void write(cairo_t* page, const Point& at, const std::string& text, double anchor) {
  cairo_move_to(page, at.x - anchor * width_of(page, text), at.y);
  cairo_text_path(page, text.c_str());
  cairo_fill(page);
}

void line(cairo_t* page, const Point& a, const Point& b) {
  cairo_move_to(page, a.x, a.y);
  cairo_line_to(page, b.x, b.y);
  cairo_stroke(page);
}

/// A plot under way: where its values lie on the page.
struct Drawing {
  cairo_t* page;
  PlotInput input;  // as drawn
  PlotAxis x_axis, y_axis;
  Box frame{};

  double across(double x) const { return frame.left + x_axis.part(x) * (frame.right - frame.left); }
  double up(double y) const { return frame.bottom - y_axis.part(y) * (frame.bottom - frame.top); }
  Colour colour_of(std::size_t i) const { return colours[number_of(i) % colours.size()]; }
  std::size_t number_of(std::size_t i) const { return input.series[i].colour.value_or(i); }
};

void draw_marker(cairo_t* page, const Point& at, std::size_t number) {
  constexpr double r = marker_radius;
  switch (number % 5) {
    case 0:
      cairo_arc(page, at.x, at.y, r, 0.0, 2.0 * std::numbers::pi);
      break;
    case 1:
      cairo_rectangle(page, at.x - 0.87 * r, at.y - 0.87 * r, 1.74 * r, 1.74 * r);
      break;
    case 2:
      for (const Point& p : {Point{0.0, -1.25 * r}, {1.25 * r, 0.0}, {0.0, 1.25 * r}, {-1.25 * r, 0.0}})
        cairo_line_to(page, at.x + p.x, at.y + p.y);
      break;
    case 3:
      for (const Point& p : {Point{0.0, -1.2 * r}, {1.1 * r, 0.8 * r}, {-1.1 * r, 0.8 * r}})
        cairo_line_to(page, at.x + p.x, at.y + p.y);
      break;
    default:
      for (const Point& p : {Point{0.0, 1.2 * r}, {1.1 * r, -0.8 * r}, {-1.1 * r, -0.8 * r}})
        cairo_line_to(page, at.x + p.x, at.y + p.y);
  }
  cairo_close_path(page);
  cairo_fill(page);
}

void draw_axes(const Drawing& d) {
  const Box& f = d.frame;
  cairo_set_font_size(d.page, text_size);
  cairo_set_line_width(d.page, 1.0);
  for (std::size_t i = 0; i < d.x_axis.ticks.size(); ++i) {
    const double x = d.across(d.x_axis.ticks[i]);
    set(d.page, pale), line(d.page, {x, f.top}, {x, f.bottom});
    set(d.page, black), line(d.page, {x, f.bottom}, {x, f.bottom + 7.0});
    write(d.page, {x, f.bottom + 12.0 + 0.8 * text_size}, d.x_axis.labels[i], 0.5);
  }
  for (std::size_t i = 0; i < d.y_axis.ticks.size(); ++i) {
    const double y = d.up(d.y_axis.ticks[i]);
    set(d.page, pale), line(d.page, {f.left, y}, {f.right, y});
    set(d.page, black), line(d.page, {f.left - 7.0, y}, {f.left, y});
    write(d.page, {f.left - 12.0, y + 0.36 * text_size}, d.y_axis.labels[i], 1.0);
  }
  cairo_set_line_width(d.page, 1.5);
  cairo_rectangle(d.page, f.left, f.top, f.right - f.left, f.bottom - f.top);
  cairo_stroke(d.page);
  write(d.page, {0.5 * (f.left + f.right), plot_height - 14.0}, d.input.x_label, 0.5);
  cairo_save(d.page);
  cairo_translate(d.page, 8.0 + 0.8 * text_size, 0.5 * (f.top + f.bottom));
  cairo_rotate(d.page, -0.5 * std::numbers::pi);
  write(d.page, {}, d.input.y_label, 0.5);
  cairo_restore(d.page);
  cairo_set_font_size(d.page, title_size);
  write(d.page, {0.5 * (f.left + f.right), 0.5 * f.top + 0.36 * title_size}, d.input.title, 0.5);
  cairo_set_font_size(d.page, text_size);
}

void draw_marks(const Drawing& d) {
  for (const PlotMark& mark : d.input.marks) {
    const double x = d.across(mark.x);
    constexpr std::array dashes{10.0, 6.0};
    set(d.page, grey);
    cairo_set_line_width(d.page, 1.5);
    cairo_set_dash(d.page, dashes.data(), static_cast<int>(dashes.size()), 0.0);
    line(d.page, {x, d.frame.top}, {x, d.frame.bottom});
    cairo_set_dash(d.page, nullptr, 0, 0.0);
    cairo_save(d.page);
    cairo_translate(d.page, x - 6.0, d.frame.bottom - 10.0);
    cairo_rotate(d.page, -0.5 * std::numbers::pi);
    cairo_set_font_size(d.page, 0.8 * text_size);
    write(d.page, {}, mark.name, 0.0);
    cairo_restore(d.page);
  }
}

bool is_line(const PlotSeries& series) { return series.style != PlotSeries::Style::Points && series.x.size() > 1; }

void draw_series(const Drawing& d, std::size_t i) {
  const PlotSeries& series = d.input.series[i];
  set(d.page, d.colour_of(i));
  cairo_set_line_width(d.page, 1.5);
  for (std::size_t k = 0; k < series.low.size(); ++k) {
    constexpr double cap = 4.0;
    const double x = d.across(series.x[k]), low = d.up(series.low[k]), high = d.up(series.high[k]);
    line(d.page, {x, low}, {x, high});
    for (const double y : {low, high}) line(d.page, {x - cap, y}, {x + cap, y});
  }
  if (!is_line(series)) {
    for (std::size_t k = 0; k < series.x.size(); ++k)
      draw_marker(d.page, {d.across(series.x[k]), d.up(series.y[k])}, d.number_of(i));
    return;
  }
  constexpr std::array dashes{12.0, 7.0};
  cairo_set_line_width(d.page, line_width);
  if (series.style == PlotSeries::Style::Dashes) cairo_set_dash(d.page, dashes.data(), 2, 0.0);
  for (std::size_t k = 0; k < series.x.size(); ++k) cairo_line_to(d.page, d.across(series.x[k]), d.up(series.y[k]));
  cairo_stroke(d.page);
  cairo_set_dash(d.page, nullptr, 0, 0.0);
}

// What a curve covers, finely: long lines have few corners.
std::vector<Point> covered_points(const Drawing& d) {
  constexpr int pieces = 20;
  std::vector<Point> points;
  for (const PlotSeries& series : d.input.series)
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const Point here{d.across(series.x[i]), d.up(series.y[i])};
      points.push_back(here);
      for (const auto* bar : {&series.low, &series.high})
        if (!bar->empty()) points.push_back({here.x, d.up((*bar)[i])});
      if (i == 0 || !is_line(series)) continue;
      const Point before{d.across(series.x[i - 1]), d.up(series.y[i - 1])};
      for (int k = 1; k < pieces; ++k) {
        const double t = static_cast<double>(k) / pieces;
        points.push_back({before.x + t * (here.x - before.x), before.y + t * (here.y - before.y)});
      }
    }
  return points;
}

struct Legend {
  std::vector<std::size_t> series{};  // that have a name
  double width = 0.0, height = 0.0;
};

constexpr double legend_line = 1.3 * text_size, legend_sample = 44.0, legend_margin = 10.0;

Legend legend_of(const Drawing& d) {
  Legend legend;
  for (std::size_t i = 0; i < d.input.series.size(); ++i)
    if (!d.input.series[i].name.empty()) legend.series.push_back(i);
  if (d.input.series.size() < 2) legend.series.clear();
  for (const std::size_t i : legend.series)
    legend.width = std::max(legend.width, legend_sample + width_of(d.page, d.input.series[i].name));
  legend.width += 3.0 * legend_margin;
  legend.height = legend_line * static_cast<double>(legend.series.size()) + legend_margin;
  return legend;
}

// The corner where the legend hides least; how much that is.
std::pair<Box, int> place_of(const Legend& legend, const Drawing& d) {
  constexpr double clear = 14.0;
  const std::vector<Point> points = covered_points(d);
  std::pair<Box, int> best{{}, -1};
  for (const bool at_top : {true, false})
    for (const bool at_left : {true, false}) {
      Box box{.left = at_left ? d.frame.left + clear : d.frame.right - clear - legend.width,
              .top = at_top ? d.frame.top + clear : d.frame.bottom - clear - legend.height};
      box.right = box.left + legend.width, box.bottom = box.top + legend.height;
      const auto hidden = static_cast<int>(std::count_if(points.begin(), points.end(), [&](const Point& p) {
        return p.x > box.left - clear && p.x < box.right + clear && p.y > box.top - clear && p.y < box.bottom + clear;
      }));
      if (best.second < 0 || hidden < best.second) best = {box, hidden};
    }
  return best;
}

void draw_legend(const Drawing& d, const Legend& legend, const Box& box) {
  set(d.page, {1.0, 1.0, 1.0}, 0.85);
  cairo_rectangle(d.page, box.left, box.top, legend.width, legend.height);
  cairo_fill_preserve(d.page);
  set(d.page, grey);
  cairo_set_line_width(d.page, 1.0);
  cairo_stroke(d.page);
  double y = box.top + 0.5 * legend_margin + 0.5 * legend_line;
  for (const std::size_t i : legend.series) {
    const PlotSeries& series = d.input.series[i];
    const double x = box.left + legend_margin;
    set(d.page, d.colour_of(i));
    if (is_line(series)) {
      constexpr std::array dashes{12.0, 7.0};
      cairo_set_line_width(d.page, line_width);
      if (series.style == PlotSeries::Style::Dashes) cairo_set_dash(d.page, dashes.data(), 2, 0.0);
      line(d.page, {x, y}, {x + legend_sample - 8.0, y});
      cairo_set_dash(d.page, nullptr, 0, 0.0);
    } else {
      draw_marker(d.page, {x + 0.5 * (legend_sample - 8.0), y}, d.number_of(i));
    }
    set(d.page, black);
    write(d.page, {x + legend_sample, y + 0.36 * text_size}, series.name, 0.0);
    y += legend_line;
  }
}

// Values on a logarithmic axis are drawn as their logarithms.
PlotInput as_drawn(PlotInput input) {
  const auto take_logarithms = [](std::vector<double>& values) {
    for (double& value : values) value = std::log10(value);
  };
  for (PlotSeries& series : input.series) {
    if (input.log_x) take_logarithms(series.x);
    if (input.log_y)
      for (auto* values : {&series.y, &series.low, &series.high}) take_logarithms(*values);
  }
  if (input.log_x)
    for (PlotMark& mark : input.marks) mark.x = std::log10(mark.x);
  return input;
}

void draw(cairo_t* page, const PlotInput& input) {
  set(page, {1.0, 1.0, 1.0});
  cairo_paint(page);
  cairo_select_font_face(page, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(page, text_size);
  Drawing d{page, as_drawn(input), {}, {}};
  d.x_axis = x_axis_of(d.input), d.y_axis = y_axis_of(d.input);
  double widest = 0.0;
  for (const std::string& label : d.y_axis.labels) widest = std::max(widest, width_of(page, label));
  d.frame = {.left = 34.0 + text_size + widest, .top = 54.0, .right = plot_width - 36.0, .bottom = plot_height - 82.0};
  const Legend legend = legend_of(d);
  if (!legend.series.empty() && place_of(legend, d).second > 0) {  // no corner is free: the axis grows to make room
    const double height = d.frame.bottom - d.frame.top, room = std::min(legend.height + 40.0, 0.6 * height);
    d.y_axis.high += room / (height - room) * (d.y_axis.high - d.y_axis.low);
  }
  draw_axes(d);
  cairo_save(page);
  cairo_rectangle(page, d.frame.left, d.frame.top, d.frame.right - d.frame.left, d.frame.bottom - d.frame.top);
  cairo_clip(page);
  draw_marks(d);
  for (std::size_t i = 0; i < d.input.series.size(); ++i) draw_series(d, i);
  cairo_restore(page);
  if (!legend.series.empty()) draw_legend(d, legend, place_of(legend, d).first);
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw RuntimeFailure(std::string("plot: ") + cairo_status_to_string(status));
}

void draw_on(cairo_surface_t* surface, const PlotInput& input) {
  const Context page(cairo_create(surface), cairo_destroy);
  draw(page.get(), input);
  check(cairo_status(page.get()));
}

}  // namespace

std::string png_of_plot(const PlotInput& input) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, plot_width, plot_height), cairo_surface_destroy);
  draw_on(surface.get(), input);
  std::string bytes;
  check(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
  return bytes;
}

std::string svg_of_plot(const PlotInput& input) {
  std::string bytes;
  const Surface surface(cairo_svg_surface_create_for_stream(append, &bytes, plot_width, plot_height),
                        cairo_surface_destroy);
  draw_on(surface.get(), input);
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
  return bytes;
}

}  // namespace knap
