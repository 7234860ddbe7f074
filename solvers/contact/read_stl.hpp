#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "contact/triangle_surface.hpp"

namespace knap {

/// The triangles of an STL file as they are there [m], ASCII or binary; the file's normals are not used. `name` is for
/// messages, `scale` the file's unit in m. Throws InputError with the line or the number of the triangle.
std::vector<std::array<Vec3, 3>> parse_stl(std::string_view bytes, const std::string& name, double scale);

/// Reads, repairs and checks an STL file (repair_surface.hpp).
TriangleSurface load_stl(const std::filesystem::path& path, double scale);

}  // namespace knap
