#include "io/picture_captions.hpp"

#include <fmt/format.h>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <numeric>

#include "io/picture_colours.hpp"
#include "io/picture_scene.hpp"

namespace knap {
namespace {

constexpr Rgb black{25, 25, 28};
constexpr Rgb grey{95, 95, 100};
constexpr double margin = 48.0;  // all lengths in pixels of the finished picture
constexpr double caption_height = 92.0;
constexpr double key_height = 42.0;

enum class Align { Left, Centre };

struct Label {
  std::string text;
  double x = 0.0;
  double y = 0.0;  ///< of the baseline
  int size = 24;
  Rgb colour = grey;
  bool bold = false;
  Align align = Align::Left;
};

/// A page of the finished picture's pixels on an enlarged one.
struct Page {
  vtkRenderer* renderer;
  double scale;
};

void add_label(const Page& page, const Label& label) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(label.text.c_str());
  actor->SetPosition(page.scale * label.x, page.scale * label.y);
  vtkTextProperty* style = actor->GetTextProperty();
  style->SetFontFamilyToArial();
  style->SetFontSize(static_cast<int>(page.scale * label.size));
  style->SetColor(label.colour[0] / 255.0, label.colour[1] / 255.0, label.colour[2] / 255.0);
  style->SetBold(label.bold);
  style->SetVerticalJustificationToBottom();
  if (label.align == Align::Centre) style->SetJustificationToCentered();
  page.renderer->AddActor2D(actor);
  // A title too long for the page is set smaller.
  double box[4] = {};
  actor->GetBoundingBox(page.renderer, box);
  const double room = page.scale * (picture_width - 2.0 * margin);
  const double width = box[1] - box[0];
  if (width > room) style->SetFontSize(std::max(1, static_cast<int>(page.scale * label.size * room / width)));
}

struct Box {
  double x;
  double y;
  double width;
  double height;
};

void add_box(const Page& page, const Box& box, const Rgb& colour) {
  vtkNew<vtkPoints> points;
  for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    points->InsertNextPoint(page.scale * (box.x + i * box.width), page.scale * (box.y + j * box.height), 0.0);
  }
  vtkNew<vtkCellArray> quad;
  quad->InsertNextCell({0, 1, 2, 3});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(quad);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
  page.renderer->AddActor2D(actor);
}

void add_damage_scale(const Page& page, double centre) {
  constexpr double width = 320.0;
  constexpr int steps = 80;
  const double left = centre - width / 2.0;
  for (int i = 0; i < steps; ++i) {
    const double step = width / steps;
    add_box(page, {left + i * step, key_height, step, 22.0}, damage_colour((i + 0.5) / steps));
  }
  for (const double value : {0.0, 0.5, 1.0}) {
    add_label(page, {.text = fmt::format("{}", value),
                     .x = left + value * width,
                     .y = key_height - 30.0,
                     .size = 20,
                     .align = Align::Centre});
  }
}

struct Share {
  Rgb colour;
  std::string text;
};

std::vector<Share> heaviest_shares(const PictureInput& input, const PictureGeometry& geometry) {
  constexpr Index num_shown = 6;
  const double total = std::accumulate(input.fragment_mass.begin(), input.fragment_mass.end(), 0.0);
  std::vector<Share> shares(num_shown);
  Index num_heavy = 0;
  double dust = 0.0;
  for (std::size_t f = 0; f < input.fragment_mass.size(); ++f) {
    const Index rank = geometry.fragment_rank[f];
    const double share = 100.0 * input.fragment_mass[f] / total;
    if (rank == none) dust += share;
    if (rank != none) ++num_heavy;
    if (rank != none && rank < num_shown) shares[at(rank)] = {fragment_colour(rank), fmt::format("{:.1f} %", share)};
  }
  shares.resize(at(std::min(num_heavy, num_shown)));
  if (dust > 0.0) shares.push_back({fragment_colour(none), fmt::format("dust {:.1f} %", dust)});
  return shares;
}

void add_shares(const Page& page, double centre, const std::vector<Share>& shares) {
  constexpr double swatch = 20.0;
  constexpr double letter = 11.0;  // average width
  const auto width = [](const Share& share) {
    return swatch + 8.0 + letter * static_cast<double>(share.text.size()) + 14.0;
  };
  double x = centre;
  for (const Share& share : shares) x -= width(share) / 2.0;
  for (const Share& share : shares) {
    add_box(page, {x, key_height, swatch, swatch}, share.colour);
    add_label(page, {.text = share.text, .x = x + swatch + 8.0, .y = key_height - 3.0, .size = 20});
    x += width(share);
  }
}

}  // namespace

void add_captions(vtkRenderer* renderer, const PictureInput& input, const PictureGeometry& geometry, double scale) {
  const Page page{renderer, scale};
  add_label(page, {.text = input.title, .x = margin, .y = 832.0, .size = 40, .colour = black, .bold = true});
  add_label(page, {.text = input.subtitle, .x = margin, .y = 788.0, .size = 26});
  const double third = picture_width / 3.0;
  const auto caption = [&](const std::string& text, double column) {
    add_label(page, {.text = text,
                     .x = (column + 0.5) * third,
                     .y = caption_height,
                     .size = 26,
                     .colour = black,
                     .align = Align::Centre});
  };
  caption("outside", 0.0);
  caption("cut through the centre: damage", 1.0);
  caption("fragments apart: share of the mass", 2.0);
  add_damage_scale(page, 1.5 * third);
  add_shares(page, 2.5 * third, heaviest_shares(input, geometry));
}

}  // namespace knap
