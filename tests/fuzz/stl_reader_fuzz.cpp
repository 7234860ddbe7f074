// Mutates small STL files, ASCII and binary; every outcome must be a surface that answers, or an InputError.
// usage: stl_reader_fuzz [seconds]
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>

#include "contact/read_stl.hpp"
#include "contact/repair_surface.hpp"
#include "contact/tool_shape.hpp"
#include "core/errors.hpp"
#include "core/random.hpp"
#include "tests/contact/stl_text.hpp"

namespace knap {
namespace {

std::size_t pick(std::uint64_t& random, std::size_t n) { return static_cast<std::size_t>(splitmix64(random) % n); }

const std::vector<std::string> spiteful_words{"nan", "inf",   "-0", "1e999", "1e30", "1e-300", "",     "vertex",
                                              "1",   "facet", "0",  "solid", "loop", "0.5",    "\r\n", "endsolid"};
const std::vector<std::uint32_t> spiteful_numbers{0,          1,          12,         0x7f800000,
                                                  0x7fc00000, 0xff800000, 0x3f800000, 0x3f000000,
                                                  0x00000001, 0x7f7fffff, 0xffffffff, 0x40000000};

void mutate(std::string& file, std::uint64_t& random) {
  if (file.empty()) return;
  const std::size_t place = pick(random, file.size());
  const std::size_t length = std::min(file.size() - place, 1 + pick(random, splitmix64(random) % 4 == 0 ? 200 : 8));
  switch (pick(random, 8)) {
    case 0:
      file[place] = static_cast<char>(splitmix64(random));
      break;
    case 1:
      file.erase(place, length);
      break;
    case 2:
      file.insert(place, file.substr(pick(random, file.size()), length));
      break;
    case 3:
      file.resize(place);
      break;
    case 4:
    case 5: {  // a number of a binary file, at its place; it stays readable
      if (file.size() < 88) break;
      const std::size_t number = 84 + 50 * pick(random, (file.size() - 84) / 50 + 1) + 4 * pick(random, 12);
      if (number + 4 > file.size()) break;
      const std::uint32_t value = spiteful_numbers[pick(random, spiteful_numbers.size())];
      file.replace(number, 4, reinterpret_cast<const char*>(&value), 4);
      break;
    }
    default: {  // a word of an ASCII file
      const std::size_t begin = file.find_first_of(" \n", place);
      if (begin == std::string::npos) break;
      const std::size_t end = std::min(file.find_first_of(" \n", begin + 1), file.size());
      file.replace(begin + 1, end - begin - 1, spiteful_words[pick(random, spiteful_words.size())]);
    }
  }
}

bool survives(const std::string& file, long& accepted) {
  try {
    const SurfaceTool tool{repaired_surface(parse_stl(file, "fuzz.stl", 1.0), "fuzz.stl"), 1e-3};
    ++accepted;
    for (const Vec3& p : {Vec3(0.5, 0.5, 0.5), Vec3(3, 0, 0), tool.surface.vertices.front()}) {
      const SurfaceDistance distance = surface_distance(tool, p);
      if (!std::isfinite(distance.gap) || std::abs(distance.normal.norm() - 1.0) > 1e-9) {
        fmt::print(stderr, "gap {}, length of the normal {}\n", distance.gap, distance.normal.norm());
        return false;
      }
    }
    return true;
  } catch (const InputError&) {
    return true;
  } catch (const std::exception& error) {
    fmt::print(stderr, "not an InputError: {}\n", error.what());
    return false;
  }
}

int run(double seconds) {
  Soup open = cube_soup();
  open.resize(7);
  const std::vector<std::string> seeds{ascii_stl(cube_soup()), binary_stl(cube_soup()), ascii_stl(open),
                                       binary_stl(open)};
  long runs = 0, accepted = 0;
  for (const std::string& seed : seeds)
    if (!survives(seed, accepted)) return EXIT_FAILURE;
  if (accepted != 4) return EXIT_FAILURE;
  std::uint64_t random = 20240601;
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (Clock::now() < end) {
    std::string file = seeds[pick(random, seeds.size())];
    for (std::size_t n = 1 + pick(random, 4); n > 0; --n) mutate(file, random);
    if (!survives(file, accepted)) {
      fmt::print(stderr, "run {} failed, {} bytes:\n{}\n", runs, file.size(), file);
      return EXIT_FAILURE;
    }
    ++runs;
  }
  fmt::print("{} files, {} of them surfaces\n", runs, accepted);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace knap

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 10.0;
  return knap::run(seconds);
}
