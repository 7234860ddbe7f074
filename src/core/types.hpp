#pragma once
// The few types every module shares. SI units everywhere in memory.
#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <vector>

namespace knap {

using Index = std::int32_t;  ///< tets, facets, nodes; -1 = none
using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;  ///< a nodal vector padded to 32 bytes; the fourth entry is 0
using Mat3 = Eigen::Matrix3d;
using TetCorners = std::array<Index, 4>;

inline constexpr Index none = -1;

/// The three spatial entries of a padded nodal vector.
inline auto xyz(Vec4& a) { return a.head<3>(); }
inline auto xyz(const Vec4& a) { return a.head<3>(); }
inline Vec4 padded(const Vec3& a) { return {a.x(), a.y(), a.z(), 0.0}; }

/// Conversion of a container size to Index, the one place where it narrows.
inline Index to_index(std::size_t n) { return static_cast<Index>(n); }
/// Conversion of an Index to a subscript.
inline std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Makes room for `size` items, by eighths: doubling would leave up to half of the largest arrays unused.
template <class T>
void make_room(std::vector<T>& items, std::size_t size) {
  if (size > items.capacity()) items.reserve(std::max(size, items.capacity() + items.capacity() / 8));
}

}  // namespace knap
