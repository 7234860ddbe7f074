#include "observers/tool_grid.hpp"

#include <Eigen/Geometry>

#include "observers/tool_surface.hpp"

namespace knap {
namespace {

constexpr double plane_radius_over_diagonal = 1.0;  // of the box around the particles at the start

}  // namespace

VtkGrid tool_grid(const Simulation& s) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : s.reference.vertices) box.extend(x);
  VtkGrid grid;
  VtkField velocity{"velocity [m/s]", 3, {}};
  VtkIntField number{"tool", 1, {}};
  for (std::size_t k = 0; k < s.tools.size(); ++k) {
    const Tool& tool = s.tools[k];
    const auto surface = tool_surface(tool, box.center(), plane_radius_over_diagonal * box.diagonal().norm());
    const Index first = to_index(grid.points.size());
    for (const Vec3& point : surface.points) {
      grid.points.push_back(point);
      const Vec3 v = tool.velocity_at(point);
      velocity.values.insert(velocity.values.end(), {v.x(), v.y(), v.z()});
    }
    for (const auto& [a, b, c] : surface.triangles) grid.triangles.push_back({first + a, first + b, first + c});
    number.values.resize(grid.triangles.size(), static_cast<std::int32_t>(k));
  }
  grid.point_fields = {std::move(velocity)};
  grid.cell_int_fields = {std::move(number)};
  return grid;
}

}  // namespace knap
