// Mutates small .msh files of the four formats; every outcome must be a mesh or an InputError.
// usage: mesh_reader_fuzz [seconds]
#include "meshing/mesh_quality.hpp"
#include "meshing/read_msh.hpp"
#include "meshing/reorder.hpp"
#include "tests/fuzz/mutation.hpp"

namespace knap {
namespace {

// A cube of edge 1 in five tets, with one triangle and one line for the reader to skip.
const std::array<std::array<int, 3>, 8> nodes{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
const std::vector<std::vector<int>> tets{{1, 2, 4, 5}, {3, 4, 2, 7}, {6, 5, 7, 2}, {8, 7, 5, 4}, {2, 4, 5, 7}};
struct Block {
  int dimension;
  int type;
  std::vector<std::vector<int>> elements;
};
const std::vector<Block> blocks{{1, 1, {{1, 2}}}, {2, 2, {{1, 2, 4}}}, {3, 4, tets}};

struct Writer {
  bool binary;
  std::string bytes;

  template <class T>
  void number(T value) {
    if (binary)
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    else
      bytes += fmt::format("{} ", value);
  }
  void int32(int value) { number<std::int32_t>(value); }
  void size(std::size_t value) { number<std::uint64_t>(value); }
  void line_end() { bytes += '\n'; }
};

void write_header(Writer& out, const char* version) {
  out.bytes += fmt::format("$MeshFormat\n{} {} 8\n", version, out.binary ? 1 : 0);
  if (out.binary) out.int32(1), out.line_end();
  out.bytes += "$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"grain\"\n$EndPhysicalNames\n";
}

std::string msh2(bool binary) {
  Writer out{binary, {}};
  write_header(out, "2.2");
  out.bytes += fmt::format("$Nodes\n{}\n", nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    out.int32(static_cast<int>(i + 1));
    for (const int x : nodes[i]) out.number<double>(x);
    if (!binary) out.line_end();
  }
  out.bytes += "\n$EndNodes\n$Elements\n7\n";
  int tag = 0;
  for (const Block& block : blocks) {
    if (binary) out.int32(block.type), out.int32(static_cast<int>(block.elements.size())), out.int32(2);
    for (const auto& element : block.elements) {
      out.int32(++tag);
      if (!binary) out.int32(block.type), out.int32(2);
      out.int32(1), out.int32(1);
      for (const int node : element) out.int32(node);
      if (!binary) out.line_end();
    }
  }
  return out.bytes + "\n$EndElements\n";
}

std::string msh4(bool binary) {
  Writer out{binary, {}};
  write_header(out, "4.1");
  out.bytes += "$Nodes\n";
  for (const std::size_t n : {std::size_t{1}, nodes.size(), std::size_t{1}, nodes.size()}) out.size(n);
  for (const int n : {3, 1, 0}) out.int32(n);
  out.size(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) out.size(i + 1);
  for (const auto& node : nodes)
    for (const int x : node) out.number<double>(x);
  out.bytes += "\n$EndNodes\n$Elements\n";
  for (const std::size_t n : {blocks.size(), std::size_t{7}, std::size_t{1}, std::size_t{7}}) out.size(n);
  std::size_t tag = 0;
  for (const Block& block : blocks) {
    for (const int n : {block.dimension, 1, block.type}) out.int32(n);
    out.size(block.elements.size());
    for (const auto& element : block.elements) {
      out.size(++tag);
      for (const int node : element) out.size(static_cast<std::size_t>(node));
      if (!binary) out.line_end();
    }
  }
  return out.bytes + "\n$EndElements\n";
}

const std::vector<std::string> spiteful_words{
    "-1",  "0",      "2147483648", "9223372036854775807", "18446744073709551616", "1e999", "nan",
    "-",   "$Nodes", "$EndNodes",  "$Elements",           "$EndElements",         "",      "\n",
    "\r\n"};
const std::vector<std::uint64_t> spiteful_numbers{0,          1,
                                                  4,          11,
                                                  0x7fffffff, 0x80000000,
                                                  0xffffffff, 0x01000000,
                                                  ~0ULL,      0x7fffffffffffffff,
                                                  1ULL << 40, 1ULL << 61,
                                                  1ULL << 63, 0x7ff0ULL << 48};

void mutate(std::string& file, const std::vector<std::string>& seeds, std::uint64_t& random) {
  const std::size_t place = pick(random, file.size());
  switch (pick(random, 8)) {
    case 0: {
      const std::uint64_t number = spiteful_numbers[pick(random, spiteful_numbers.size())];
      const std::size_t size = std::min<std::size_t>(file.size() - place, pick(random, 2) == 0 ? 4 : 8);
      file.replace(place, size, reinterpret_cast<const char*>(&number), size);
      return;
    }
    case 1:
      return replace_word(file, place, spiteful_words[pick(random, spiteful_words.size())]);
    case 2: {
      const std::string& other = seeds[pick(random, seeds.size())];
      file = file.substr(0, place) + other.substr(pick(random, other.size()));
      return;
    }
    default:
      return change_bytes(file, place, random);
  }
}

bool is_sound(const std::string& file) {
  const TetMesh mesh = parse_msh(file, "fuzz.msh", 1e-3);
  check_mesh(mesh);
  return measure_quality(morton_ordered(mesh)).num_tets == mesh.num_tets();
}

int run(double seconds) {
  const std::vector<std::string> seeds{msh2(false), msh2(true), msh4(false), msh4(true)};
  for (const std::string& seed : seeds)
    if (parse_msh(seed, "seed.msh", 1e-3).num_tets() != 5) return EXIT_FAILURE;
  const long runs = fuzz(
      seconds, seeds, [&](std::string& file, std::uint64_t& random) { mutate(file, seeds, random); },
      [](const std::string& file) { return survives([&] { return is_sound(file); }); });
  fmt::print("{} files\n", runs);
  return runs < 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}

}  // namespace
}  // namespace knap

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 10.0;
  return knap::run(seconds);
}
