// Mutates small STL files, ASCII and binary; every outcome must be a surface that answers, or an InputError.
// usage: stl_reader_fuzz [seconds]
#include <cmath>

#include "contact/read_stl.hpp"
#include "contact/repair_surface.hpp"
#include "contact/tool_shape.hpp"
#include "tests/contact/stl_text.hpp"
#include "tests/fuzz/mutation.hpp"

namespace knap {
namespace {

const std::vector<std::string> spiteful_words{"nan", "inf",   "-0", "1e999", "1e30", "1e-300", "",     "vertex",
                                              "1",   "facet", "0",  "solid", "loop", "0.5",    "\r\n", "endsolid"};
const std::vector<std::uint32_t> spiteful_numbers{0,          1,          12,         0x7f800000,
                                                  0x7fc00000, 0xff800000, 0x3f800000, 0x3f000000,
                                                  0x00000001, 0x7f7fffff, 0xffffffff, 0x40000000};

// A number of a binary file, at its place; it stays readable.
void change_number(std::string& file, std::uint64_t& random) {
  if (file.size() < 88) return;
  const std::size_t number = 84 + 50 * pick(random, (file.size() - 84) / 50 + 1) + 4 * pick(random, 12);
  if (number + 4 > file.size()) return;
  const std::uint32_t value = spiteful_numbers[pick(random, spiteful_numbers.size())];
  file.replace(number, 4, reinterpret_cast<const char*>(&value), 4);
}

void mutate(std::string& file, std::uint64_t& random) {
  const std::size_t place = pick(random, file.size());
  switch (pick(random, 4)) {
    case 0:
    case 1:
      return change_bytes(file, place, random);
    case 2:
      return change_number(file, random);
    default:
      return replace_word(file, place, spiteful_words[pick(random, spiteful_words.size())]);
  }
}

bool is_sound(const std::string& file, long& accepted) {
  const SurfaceTool tool{repaired_surface(parse_stl(file, "fuzz.stl", 1.0), "fuzz.stl"), 1e-3};
  ++accepted;
  for (const Vec3& p : {Vec3(0.5, 0.5, 0.5), Vec3(3, 0, 0), tool.surface.vertices.front()}) {
    const SurfaceDistance distance = surface_distance(tool, p);
    if (std::isfinite(distance.gap) && std::abs(distance.normal.norm() - 1.0) <= 1e-9) continue;
    fmt::print(stderr, "gap {}, length of the normal {}\n", distance.gap, distance.normal.norm());
    return false;
  }
  return true;
}

int run(double seconds) {
  Soup open = cube_soup();
  open.resize(7);
  const std::vector<std::string> seeds{ascii_stl(cube_soup()), binary_stl(cube_soup()), ascii_stl(open),
                                       binary_stl(open)};
  long accepted = 0;
  const auto survives_file = [&](const std::string& file) {
    return survives([&] { return is_sound(file, accepted); });
  };
  for (const std::string& seed : seeds)
    if (!survives_file(seed)) return EXIT_FAILURE;
  if (accepted != 4) return EXIT_FAILURE;
  const long runs = fuzz(seconds, seeds, mutate, survives_file);
  fmt::print("{} files, {} of them surfaces\n", runs, accepted);
  return runs < 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}

}  // namespace
}  // namespace knap

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 10.0;
  return knap::run(seconds);
}
