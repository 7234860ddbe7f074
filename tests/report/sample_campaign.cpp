#include "tests/report/sample_campaign.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>

namespace knap {
namespace {

constexpr double radius = 0.75e-3;  // [m]

// The six tets of a cube around its diagonal from corner 0 to 7; bit k of a corner = its step along axis k.
constexpr std::array<std::array<int, 4>, 6> tets_of_cube{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

using Place = std::array<Index, 3>;

// The larger sector spans the larger angle: 1, 1/2, 1/3, ...; three are seen from where the page looks at first.
Index sector(const Vec3& x, Index num) {
  double total = 0.0, angle = std::atan2(x.y(), x.x()) / (2 * std::numbers::pi) + 1.0 / 12;
  if (angle < 0.0) angle += 1.0;
  for (Index k = 1; k <= num; ++k) total += 1.0 / k;
  for (Index k = 1; k < num; ++k) {
    angle -= 1.0 / k / total;
    if (angle < 0.0) return k - 1;
  }
  return num - 1;
}

// A PNG of one grey pixel.
constexpr std::string_view tiny_png(
    "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\10\0\0\0\0\x3a\x7e\x9b\x55\0\0\0\nIDATx\xda\x63\x68\0\0\0\x82\0\x81"
    "\xda\x45\x08\x3b\0\0\0\0IEND\xae\x42\x60\x82",
    67);

void write_file(const std::filesystem::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

void write_plot(const std::filesystem::path& path, std::string_view colour) {
  write_file(
      path,
      fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 600 400\"><clipPath id=\"a\"><rect x=\"60\" "
                  "y=\"20\" width=\"520\" height=\"330\"/></clipPath><path d=\"M60 20V350H580\" fill=\"none\" "
                  "stroke=\"#444\"/><path clip-path=\"url(#a)\" d=\"M60 340Q260 340 330 200T580 40\" fill=\"none\" "
                  "stroke=\"{}\" stroke-width=\"3\"/><text x=\"320\" y=\"385\" font-family=\"sans-serif\" "
                  "text-anchor=\"middle\">speed (m/s)</text></svg>",
                  colour));
}

PageTable sample_table(Index num_runs) {
  PageTable table;
  table.columns = {"run",
                   "state",
                   "reason",
                   "impact.speed [m/s]",
                   "run.seed",
                   "stop_reason",
                   "energy.closure_error",
                   "breakage.class",
                   "breakage.chipping_ratio",
                   "breakage.t10",
                   "only.when <b>shown</b>"};
  for (Index i = 0; i < num_runs; ++i) {
    const Index seed = (7 * i) % num_runs;
    const bool done = i % 10 != 9;
    // Sorted as text, 10 would come before 9 and 2e-05 after 1.
    table.rows.push_back({fmt::format("speed_{}mps-seed_{}", 8 + i, seed), done ? "done" : "failed",
                          done ? "" : "</script><script>alert(1)</script>, \"quoted\"\nand more", std::to_string(8 + i),
                          std::to_string(seed), "at rest", fmt::format("{}", 1e-9 * std::pow(7.3, (5 * i) % 11)),
                          i < 9 ? "intact" : "chipped", done ? fmt::format("{}", 0.001234567 * ((13 * i) % 40)) : "",
                          i % 4 == 0 ? fmt::format("{}", 0.5 / (i + 1)) : "", "a & b"});
  }
  return table;
}

}  // namespace

VtkGrid broken_ball_frame(Index n, Index num_large) {
  VtkGrid grid;
  const double cube = 2 * radius / n;
  const Vec3 middle(0, 0, radius);
  const auto place_of = [&](const Place& p) { return Vec3(p[0] * cube - radius, p[1] * cube - radius, p[2] * cube); };
  std::map<std::pair<Index, Place>, Index> node_of;
  std::vector<double> displacement;
  std::vector<Index> fragment;
  Index grains = 0;
  for (Index c = 0; c < n * n * n; ++c) {
    const Place cell{c % n, c / n % n, c / n / n};
    const Vec3 centre = place_of(cell) + Vec3::Constant(cube / 2);
    if ((centre - middle).norm() > radius) continue;
    const bool is_grain = centre.head<2>().norm() < radius / 4 && centre.z() < radius / 4;
    const Index own = is_grain ? num_large + grains++ : sector(centre - middle, num_large);
    const Vec3 away = 0.03 * Vec3(centre.x(), centre.y(), 0) * (is_grain ? 3 : 1);
    const auto node = [&](int corner) {
      const Place p{cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)};
      const auto [found, is_new] = node_of.try_emplace({own, p}, to_index(grid.points.size()));
      if (is_new) {
        grid.points.push_back(place_of(p) + away);
        displacement.insert(displacement.end(), {away.x(), away.y(), away.z()});
      }
      return found->second;
    };
    for (const auto& tet : tets_of_cube) {
      grid.tets.push_back({node(tet[0]), node(tet[1]), node(tet[2]), node(tet[3])});
      fragment.push_back(own);
    }
  }
  grid.point_fields = {{"displacement [m]", 3, std::move(displacement)}};
  grid.cell_int_fields = {{"fragment", 1, std::move(fragment)}};
  return grid;
}

CampaignPage sample_campaign(const std::filesystem::path& folder) {
  write_plot(folder / "chipping.svg", "#2f5d8c");
  write_plot(folder / "size & shape.svg", "#b0413e");
  write_file(folder / "picture.png", tiny_png);
  write_vtu(folder / "first.vtu", broken_ball_frame(20, 3));
  write_vtu(folder / "second.vtu", broken_ball_frame(16, 9));

  CampaignPage page;
  page.title = "Granules on a wall: \"8 < v & v < 48 m/s\"";
  page.subtitle = "40 runs, {{title}} of which </title> 36 are done";
  page.verdicts = {"The chipping ratio grows with v², within 5 %.", "No run with <8 m/s> breaks."};
  page.runs_table = sample_table(40);
  page.sections = {{.title = "Chipping & <breakage>",
                    .paragraphs = {"A paragraph with </p><script>alert('a')</script> in it.", "And another."},
                    .rows = {{"exponent", "2.03", "1.95 … 2.11", "of the speed"}, {"threshold", "11.2 m/s", "", ""}},
                    .figures = {{"Chipping over speed", folder / "chipping.svg", "Points: runs. Line: \"fit\"."},
                                {"Sizes 'x'", folder / "size & shape.svg", ""}}},
                   {.title = "Energy", .paragraphs = {"The balance closes."}}};
  page.runs = {{page.runs_table.rows[3][0], "three large pieces", folder / "picture.png", folder / "first.vtu"},
               {page.runs_table.rows[12][0], "nine large <pieces>", folder / "none.png", folder / "second.vtu"},
               {page.runs_table.rows[20][0], "seen only as a picture", folder / "picture.png", folder / "none.vtu"}};
  return page;
}

}  // namespace knap
