#include "meshing/size_field.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <numbers>

#include "core/random.hpp"

namespace knap {
namespace {

int add_ball(const TetrahedraliseOptions& options, const Vec3& centre) {
  namespace field = gmsh::model::mesh::field;
  const int ball = field::add("Ball");
  const double inside = options.contact_element_size > 0.0 ? options.contact_element_size : options.element_size;
  field::setNumber(ball, "VIn", inside);
  field::setNumber(ball, "VOut", options.element_size);
  field::setNumber(ball, "Radius", options.contact_extent);
  field::setNumber(ball, "Thickness", options.contact_extent);
  field::setNumber(ball, "XCenter", centre.x());
  field::setNumber(ball, "YCenter", centre.y());
  field::setNumber(ball, "ZCenter", centre.z());
  return ball;
}

// The smallest size that any contact point asks for.
int add_balls(const TetrahedraliseOptions& options) {
  namespace field = gmsh::model::mesh::field;
  std::vector<double> balls;
  for (const Vec3& point : options.contact_points) balls.push_back(add_ball(options, point));
  if (balls.size() == 1) return static_cast<int>(balls.front());
  const int smallest = field::add("Min");
  field::setNumbers(smallest, "FieldsList", balls);
  return smallest;
}

// A plane wave about 8 elements long.
int add_wave(int size, const TetrahedraliseOptions& options) {
  namespace field = gmsh::model::mesh::field;
  auto random = static_cast<std::uint64_t>(options.seed);
  const Vec3 direction = random_rotation(random).col(0);
  const Vec3 k = direction * (2.0 * std::numbers::pi / (8.0 * options.element_size));
  const double phase = 2.0 * std::numbers::pi * uniform01(random);
  const int wave = field::add("MathEval");  // its parser knows no exponents and no two signs in a row
  field::setString(wave, "F",
                   fmt::format("F{} * (1 + 0.03 * Sin(({:.12f}) * x + ({:.12f}) * y + ({:.12f}) * z + {:.12f}))", size,
                               k.x(), k.y(), k.z(), phase));
  return wave;
}

}  // namespace

void add_size_field(const TetrahedraliseOptions& options, bool modulated) {
  const int size = add_balls(options);
  gmsh::model::mesh::field::setAsBackgroundMesh(modulated ? add_wave(size, options) : size);
}

}  // namespace knap
