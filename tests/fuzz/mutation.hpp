#pragma once
// What the fuzzers of file readers share: changes of bytes and words, the loop.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "core/random.hpp"

namespace knap {

inline std::size_t pick(std::uint64_t& random, std::size_t n) {
  return static_cast<std::size_t>(splitmix64(random) % n);
}

/// Puts another word in the place of the one behind a byte, in the ASCII files' sense.
inline void replace_word(std::string& file, std::size_t place, const std::string& word) {
  const std::size_t begin = file.find_first_of(" \n", place);
  if (begin == std::string::npos) return;
  const std::size_t end = std::min(file.find_first_of(" \n", begin + 1), file.size());
  file.replace(begin + 1, end - begin - 1, word);
}

/// One of five changes of bytes: another one, a bit, some gone, some twice, the end cut off.
inline void change_bytes(std::string& file, std::size_t place, std::uint64_t& random) {
  const std::size_t length = std::min(file.size() - place, 1 + pick(random, splitmix64(random) % 4 == 0 ? 200 : 8));
  switch (pick(random, 5)) {
    case 0:
      file[place] = static_cast<char>(splitmix64(random));
      break;
    case 1:
      file[place] = static_cast<char>(file[place] ^ (1 << pick(random, 8)));
      break;
    case 2:
      file.erase(place, length);
      break;
    case 3:
      file.insert(place, file.substr(pick(random, file.size()), length));
      break;
    default:
      file.resize(place);
  }
}

/// What a reader may do with a mutated file: take it, and then `is_sound` tells, or throw an InputError.
inline bool survives(const std::function<bool()>& is_sound) {
  try {
    return is_sound();
  } catch (const InputError&) {
    return true;
  } catch (const std::exception& error) {
    fmt::print(stderr, "not an InputError: {}\n", error.what());
    return false;
  }
}

/// Mutates files for that long [s]; returns how many survived, -1 if one did not.
inline long fuzz(double seconds, const std::vector<std::string>& seeds,
                 const std::function<void(std::string&, std::uint64_t&)>& mutate,
                 const std::function<bool(const std::string&)>& survives_file) {
  std::uint64_t random = 20240601;
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  long runs = 0;
  for (; Clock::now() < end; ++runs) {
    std::string file = seeds[pick(random, seeds.size())];
    for (std::size_t n = 1 + pick(random, 4); n > 0; --n)
      if (!file.empty()) mutate(file, random);
    if (survives_file(file)) continue;
    fmt::print(stderr, "run {} failed, {} bytes:\n{}\n", runs, file.size(), file);
    return -1;
  }
  return runs;
}

}  // namespace knap
