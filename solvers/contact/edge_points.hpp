#pragma once
#include <span>

#include "contact/tool_shape.hpp"

namespace knap {

/// Points on the edges and corners of a tool that could poke between nodes through a face of the particle, not further
/// apart than `spacing` [m], in the tool's frame: rims of platens and cylinders; of closed surfaces the edges that
/// stick out by more than 10 deg, of shells all such edges and the rim (the middle of its thickness).
std::vector<Vec3> edge_points(const HalfSpace& shape, double spacing);
std::vector<Vec3> edge_points(const DiscPlaten& shape, double spacing);
std::vector<Vec3> edge_points(const BallTool& shape, double spacing);
std::vector<Vec3> edge_points(const CylinderTool& shape, double spacing);
std::vector<Vec3> edge_points(const SurfaceTool& shape, double spacing);

/// Points that can be asked for by box; plain data, halved along the longest side.
struct PointTree {
  struct Box {
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< [m]
    Index first = 0, count = 0;                    ///< points of a leaf; count 0 = two boxes within
    Index second = none;                           ///< the second box within; the first follows its parent
  };
  std::vector<Vec3> points;  ///< [m]
  std::vector<Box> boxes;
};
PointTree make_point_tree(std::vector<Vec3> points);

/// Lower bound, never above the true one, of the distance between a box and the points [m]; infinite without points.
double distance_to(const PointTree& tree, const ShapeBox& box);
/// Indices of the points in a box, ascending.
std::vector<Index> points_in(const PointTree& tree, const ShapeBox& box);

}  // namespace knap
