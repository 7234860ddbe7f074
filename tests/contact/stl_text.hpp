#pragma once
#include <fmt/format.h>

#include <cstring>
#include <string>

#include "contact/triangle_surface.hpp"

namespace knap {

using Soup = std::vector<std::array<Vec3, 3>>;

/// A cube from (0, 0, 0) to (edge, edge, edge), two triangles a side, normals outwards.
inline Soup cube_soup(double edge = 1.0) {
  Soup soup;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {0.0, 1.0}) {
      const auto corner = [&](double u, double v) {
        Vec3 x;
        x[axis] = side, x[(axis + 1) % 3] = u, x[(axis + 2) % 3] = v;
        return Vec3(edge * x);
      };
      const std::array<Vec3, 4> c{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
      for (const auto& [i, j, k] : {std::array{0, 1, 2}, std::array{0, 2, 3}})
        soup.push_back(side > 0.5 ? std::array{c[i], c[j], c[k]} : std::array{c[i], c[k], c[j]});
    }
  return soup;
}

inline std::string ascii_stl(const Soup& soup) {
  std::string text = "solid part\n";
  for (const auto& triangle : soup) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const Vec3& x : triangle) text += fmt::format("      vertex {} {} {}\n", x.x(), x.y(), x.z());
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid part\n";
}

inline std::string binary_stl(const Soup& soup) {
  std::string bytes(80, ' ');
  const auto add = [&bytes](const auto& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  add(static_cast<std::uint32_t>(soup.size()));
  for (const auto& triangle : soup) {
    for (int i = 0; i < 3; ++i) add(0.0f);
    for (const Vec3& corner : triangle)
      for (const double x : corner) add(static_cast<float>(x));
    add(std::uint16_t{0});
  }
  return bytes;
}

}  // namespace knap
