// Mutates the shipped cases and reads them: each must load or end in InputError, and what loads must survive the round
// trip through effective.toml. Usage: case_reader_fuzz [SECONDS [SEED [keep]]]. The input that failed is written to
// case_reader_fuzz_failure.toml; after a crash run again with `keep`, which writes each input before it is read.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "config/load_config.hpp"
#include "config/schema.hpp"
#include "core/errors.hpp"

namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random() % n); }

// Text that is likely to matter to a reader of numbers, units, strings and tables.
constexpr std::array fragments{"[",
                               "]",
                               "{",
                               "}",
                               "[[",
                               "]]",
                               "=",
                               "\"",
                               "'",
                               "\"\"\"",
                               "'''",
                               "#",
                               ".",
                               ",",
                               "\n",
                               "\r\n",
                               "\r",
                               "\\",
                               "\\u",
                               "\\U0010FFFF",
                               "\\ud800",
                               "\\x",
                               "-",
                               "+",
                               "_",
                               "e",
                               "0x",
                               "0b1",
                               "0o7",
                               "inf",
                               "nan",
                               "-nan",
                               "1e999",
                               "1e-999",
                               "-0.0",
                               "1_000",
                               "true",
                               "false",
                               "[]",
                               "{}",
                               "[1,2,3]",
                               "[[1],[2]]",
                               "{a=1}",
                               "a.b=1",
                               "2 mm",
                               "15 m/s",
                               "1 MPa m^1/2",
                               "m^9",
                               "^",
                               "/",
                               "%",
                               "\u00b5m",
                               "1979-05-27T07:32:00Z",
                               "07:32:00",
                               "1979-05-27",
                               "9223372036854775808",
                               "99999999999999999999",
                               "\xff",
                               "\xc3",
                               "\xed\xa0\x80",
                               "\xef\xbb\xbf"};

std::vector<std::string> tokens() {
  std::vector<std::string> all(fragments.begin(), fragments.end());
  all.insert(all.end(), {std::string(1, '\0'), std::string(40, '['), std::string(300, '{'), std::string(2000, '[')});
  for (const knap::Key& key : knap::schema()) {
    all.push_back(key.name);
    all.push_back(key.name + " = ");
    all.push_back("[" + key.section + "]\n");
    all.push_back("[[" + key.section + "]]\n");
    all.push_back("\n[particle." + key.section + "]\n");
    all.push_back("\n" + key.name + " = " + key.fallback.text + "\n");
    all.insert(all.end(), key.choices.begin(), key.choices.end());
  }
  return all;
}

std::vector<std::string> shipped_cases() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(KNAP_SOURCE_DIR "/cases"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts{
      "[[particle]]\ndiameter = 0.002\nvelocity = [1, 0, 0]\n[particle.material]\npreset = \"plaster\"\n"
      "[[particle]]\nname = \"other\"\nshape = \"box\"\nlengths = [0.1, 0.1, 0.1]\nposition = [1, 1, 1]\n"
      "[particle.fracture]\nstrength = 1e6\n[material]\npreset = \"zeolite_4ak\"\n"
      "[[tool]]\nname = \"upper\"\ntype = \"platen\"\nradius = 0.01\nnormal = [0, 0, -1]\nmotion = \"ramp\"\n"
      "velocity = [0, 0, -1]\nramp_time = 1e-6\n[[tool]]\ntype = \"cylinder\"\nradius = 1\nlength = 1\n"
      "motion = \"rotation\"\nangular_speed = \"18000 rpm\"\nrotation_centre = [0, 0, 0]\n"};
  for (const auto& file : files) {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    texts.push_back(text.str());
  }
  return texts;
}

void mutate_bytes(std::string& text, Random& random) {
  const std::size_t at = below(random, text.size());
  switch (below(random, 4)) {
    case 0:
      text[at] = static_cast<char>(random());
      break;
    case 1:
      text[at] = static_cast<char>(text[at] ^ (1 << below(random, 8)));
      break;
    case 2:
      text.erase(at, 1 + below(random, 8));
      break;
    default:
      text.insert(at, 1 + below(random, 4), static_cast<char>(random()));
      break;
  }
}

void mutate_lines(std::string& text, Random& random) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  if (lines.empty()) return;
  const std::size_t from = below(random, lines.size()), to = below(random, lines.size());
  switch (below(random, 4)) {
    case 0:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(from));
      break;
    case 1:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(to), std::string(lines[from]));
      break;
    case 2:
      std::swap(lines[from], lines[to]);
      break;
    default:
      lines[from] += lines[to];
      break;
  }
  text.clear();
  for (const auto& line : lines) text += line + "\n";
}

// Puts a token at a random place, or in the place of a value.
void mutate_tokens(std::string& text, Random& random, const std::vector<std::string>& words) {
  const std::string& word = words[below(random, words.size())];
  std::size_t at = below(random, text.size());
  if (below(random, 2) == 0) {
    text.insert(at, word);
    return;
  }
  at = text.find("= ", at);
  if (at == std::string::npos) return;
  const std::size_t end = std::min(text.find('\n', at), text.size());
  text.replace(at + 2, end - at - 2, below(random, 2) == 0 ? word : "\"" + word + "\"");
}

std::string mutant(Random& random, const std::vector<std::string>& cases, const std::vector<std::string>& words) {
  std::string text = cases[below(random, cases.size())];
  const std::size_t mutations = 1 + below(random, 6);
  for (std::size_t i = 0; i < mutations; ++i) {
    if (text.empty()) text.assign(1, '=');
    switch (below(random, 4)) {
      case 0:
        mutate_bytes(text, random);
        break;
      case 1:
        mutate_lines(text, random);
        break;
      default:
        mutate_tokens(text, random, words);
        break;
    }
  }
  return text;
}

std::vector<std::string> random_overrides(Random& random, const std::vector<std::string>& words) {
  std::vector<std::string> overrides;
  if (below(random, 4) != 0) return overrides;
  const auto& keys = knap::schema();
  const knap::Key& key = keys[below(random, keys.size())];
  constexpr std::array between{".", ".1.", ".2.", ".mesh.", ".1.material.", ".tool1.", "..", ".x.y.z."};
  const std::string middle = below(random, 2) == 0 ? "." : between[below(random, between.size())];
  overrides.push_back(key.section + middle + key.name + "=" + words[below(random, words.size())]);
  if (below(random, 4) == 0) mutate_bytes(overrides.back(), random);
  return overrides;
}

struct Counts {
  long loaded = 0;
  long refused = 0;
};

// Throws what is a failure: anything but InputError out of the reader, or a broken round trip.
void read_once(const std::string& text, const std::vector<std::string>& overrides, Counts& counts) {
  const std::filesystem::path name = KNAP_SOURCE_DIR "/cases/fuzz.toml";
  knap::RunConfig config;
  try {
    config = knap::config_from_text(text, name, overrides);
  } catch (const knap::InputError& error) {
    if (std::string(error.what()).empty()) throw std::logic_error("an InputError without a message");
    ++counts.refused;
    return;
  }
  ++counts.loaded;
  const std::string effective = knap::effective_toml(config);
  const knap::RunConfig again = knap::config_from_text(effective, name);
  if (!(again == config) || knap::effective_toml(again) != effective) throw std::logic_error("broken round trip");
}

void keep_input(const std::string& text, const std::vector<std::string>& overrides) {
  std::ofstream file("case_reader_fuzz_failure.toml", std::ios::binary);
  file << text;
  for (const auto& item : overrides) file << "\n# --set " << item;
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 10.0;
  Random random(argc > 2 ? static_cast<std::uint64_t>(std::atoll(argv[2])) : 1u);
  const bool keep = argc > 3;
  const auto cases = shipped_cases();
  const auto words = tokens();
  Counts counts;
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < seconds) {
    const std::string text = mutant(random, cases, words);
    const auto overrides = random_overrides(random, words);
    if (keep) keep_input(text, overrides);
    try {
      read_once(text, overrides, counts);
    } catch (const std::exception& error) {
      keep_input(text, overrides);
      std::cerr << "failure: " << error.what() << "\n(input in case_reader_fuzz_failure.toml)\n";
      return 1;
    }
  }
  std::cout << counts.loaded << " loaded, " << counts.refused << " refused\n";
  return counts.loaded > 0 && counts.refused > 0 ? 0 : 1;
}
