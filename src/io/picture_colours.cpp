#include "io/picture_colours.hpp"

#include <algorithm>
#include <cmath>

namespace knap {
namespace {

// The twenty colours of Tableau without its greys, dark ones first.
constexpr std::array<Rgb, 16> palette{{{78, 121, 167},
                                       {242, 142, 43},
                                       {89, 161, 79},
                                       {225, 87, 89},
                                       {118, 183, 178},
                                       {237, 201, 72},
                                       {176, 122, 161},
                                       {156, 117, 95},
                                       {255, 157, 167},
                                       {160, 203, 232},
                                       {255, 190, 125},
                                       {140, 209, 125},
                                       {212, 166, 200},
                                       {182, 153, 45},
                                       {73, 152, 148},
                                       {215, 181, 166}}};
constexpr Rgb dust{150, 150, 150};
constexpr Rgb fresh_fracture{240, 236, 228};

// magma (S. van der Walt and N. Smith, 2015) from light to dark, without its black end.
constexpr std::array<Rgb, 9> damage_scale{{{252, 253, 191},
                                           {254, 201, 141},
                                           {253, 149, 103},
                                           {241, 96, 93},
                                           {205, 64, 113},
                                           {159, 47, 127},
                                           {114, 31, 129},
                                           {69, 16, 119},
                                           {24, 15, 62}}};

}  // namespace

Rgb mixed(const Rgb& a, const Rgb& b, double share) {
  Rgb colour{};
  for (std::size_t i = 0; i < 3; ++i) colour[i] = static_cast<std::uint8_t>(std::lround(a[i] + share * (b[i] - a[i])));
  return colour;
}

Rgb fragment_colour(Index rank) { return rank == none ? dust : palette[at(rank) % palette.size()]; }

Rgb fracture_colour(const Rgb& fragment) { return mixed(fragment, fresh_fracture, 0.6); }

Rgb damage_colour(double damage) {
  const double last = static_cast<double>(damage_scale.size() - 1);
  const double place = last * (damage > 0.0 ? std::min(damage, 1.0) : 0.0);
  const auto below = static_cast<std::size_t>(std::min(std::floor(place), last - 1.0));
  return mixed(damage_scale[below], damage_scale[below + 1], place - static_cast<double>(below));
}

}  // namespace knap
