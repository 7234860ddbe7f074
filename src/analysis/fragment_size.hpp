#pragma once
#include <span>

#include "core/types.hpp"

namespace knap {

/// Lengths [m] of the box around the points along the columns of an orthonormal `axes`.
Vec3 extents(std::span<const Vec3> points, const Mat3& axes);

/// Side [m] of the smallest square hole that the points pass when moved along one of the columns of an orthonormal
/// `axes`, turned about it in steps of one degree. Exact for a box in its own axes: min(b, (b + c) / sqrt 2), b and c
/// its two shorter sides; at most 1 % above the exact square for any other outline.
double sieve_size(std::span<const Vec3> points, const Mat3& axes);

}  // namespace knap
