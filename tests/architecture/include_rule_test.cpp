// Keeps the house in order: dependencies point down only, and third parties stay where they are fenced in. The test
// reads the #include lines (and OpenMP pragmas) of src, meshing and solvers, and what the modules' CMakeLists link.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace knap {
namespace {

namespace fs = std::filesystem;

// The floors of the house; an arrow may only go to a lower number.
const std::map<std::string, int> level_of_module{
    {"app", 8},      {"study", 7},      {"campaign", 6},    {"report", 6},  {"config", 5},  {"observers", 5},
    {"analysis", 5}, {"simulation", 4}, {"quasistatic", 3}, {"fem", 2},     {"loading", 2}, {"materials", 1},
    {"cohesive", 1}, {"contact", 1},    {"time", 1},        {"meshing", 1}, {"io", 1},      {"core", 0}};

// Arrows between modules of one level that were judged necessary, {from, to}. Each needs its reason here.
const std::set<std::pair<std::string, std::string>> sanctioned_arrows{};

// What only some files may name: lines matching `pattern` are allowed in files whose path matches `home`.
struct Fence {
  std::string what;
  std::regex pattern;
  std::regex home;
};

const std::vector<Fence>& fences() {
  static const std::vector<Fence> list{
      {"gmsh", std::regex{R"(^\s*#\s*include\s*[<"]gmsh)"}, std::regex{R"(meshing/.*\.cpp)"}},
      {"CGAL", std::regex{R"(^\s*#\s*include\s*[<"]CGAL/)"},
       std::regex{R"((meshing|src/analysis|solvers/contact)/.*)"}},
      {"VTK", std::regex{R"(^\s*#\s*include\s*[<"]vtk)"}, std::regex{R"(src/io/.*)"}},
      {"Cairo", std::regex{R"(^\s*#\s*include\s*[<"]cairo)"}, std::regex{R"(src/io/.*)"}},
      {"NLopt", std::regex{R"(^\s*#\s*include\s*[<"]nlopt)"}, std::regex{R"(src/analysis/.*\.cpp)"}},
      {"HDF5", std::regex{R"(^\s*#\s*include\s*[<"](hdf5|H5))"}, std::regex{R"(src/io/.*)"}},
      {"toml", std::regex{R"(^\s*#\s*include\s*[<"]toml)"}, std::regex{R"(src/config/.*\.cpp)"}},
      {"CHOLMOD", std::regex{R"(^\s*#\s*include\s*[<"].*[Cc]holmod)"},
       std::regex{R"(solvers/quasistatic/sparse_cholesky\..*)"}},
      {"OpenMP", std::regex{R"(^\s*#\s*pragma\s+omp)"}, std::regex{R"(src/core/parallel\.hpp)"}},
      {"omp.h", std::regex{R"(^\s*#\s*include\s*<omp\.h>)"}, std::regex{R"(src/core/parallel\..*)"}}};
  return list;
}

/// The module of a file by its path from the root of the source: src/<module>/, solvers/<module>/ or meshing/.
std::string module_of_file(const std::string& path) {
  static const std::regex in_module{R"((?:src|solvers)/([^/]+)/.*)"};
  std::smatch match;
  if (std::regex_match(path, match, in_module)) return match[1];
  return path.starts_with("meshing/") ? "meshing" : "";
}

/// What is wrong with an arrow between two modules; empty if nothing is.
std::string complaint(const std::string& from, const std::string& to) {
  const auto source = level_of_module.find(from);
  const auto target = level_of_module.find(to);
  if (source == level_of_module.end()) return "module '" + from + "' has no level";
  if (target == level_of_module.end()) return "'" + to + "' is no module";
  if (from == to || target->second < source->second || sanctioned_arrows.contains({from, to})) return "";
  return from + " -> " + to + (target->second == source->second ? " points sideways" : " points upwards");
}

/// The module that an #include "..." line names; a name without folder is in the includer's own. Nothing for other
/// lines.
std::optional<std::string> included_module(const std::string& line, const std::string& own) {
  static const std::regex include{R"re(^\s*#\s*include\s*"([^"]+)".*)re"};
  std::smatch match;
  if (!std::regex_match(line, match, include)) return std::nullopt;
  const std::string name = match[1];
  const auto slash = name.find('/');
  return slash == std::string::npos ? own : name.substr(0, slash);
}

/// Everything wrong with one line of the file at `path`.
std::vector<std::string> complaints(const std::string& path, const std::string& line) {
  std::vector<std::string> found;
  const std::string own = module_of_file(path);
  if (const auto module = included_module(line, own)) {
    if (const std::string arrow = complaint(own, *module); !arrow.empty()) found.push_back(arrow);
  }
  for (const Fence& fence : fences()) {
    if (std::regex_search(line, fence.pattern) && !std::regex_match(path, fence.home)) {
      found.push_back(fence.what + " is fenced elsewhere");
    }
  }
  return found;
}

TEST(IncludeRule, DependenciesPointDownAndThirdPartiesStayFenced) {
  const auto files = source_files({"src", "meshing", "solvers"}, is_cpp);
  ASSERT_GT(files.size(), 10u);
  for (const std::string& file : files) {
    const auto lines = lines_of(file);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (const std::string& what : complaints(file, lines[i])) {
        ADD_FAILURE() << file << ':' << i + 1 << ": " << what << '\n' << lines[i];
      }
    }
  }
}

TEST(IncludeRule, LinkedModulesPointDown) {
  const std::regex linked{R"(knap::(\w+))"};
  const auto is_list = [](const fs::path& p) { return p.filename() == "CMakeLists.txt"; };
  for (const std::string& file : source_files({"src", "meshing", "solvers"}, is_list)) {
    const std::string own = module_of_file(file);
    if (own.empty()) continue;  // the list of modules in src and solvers
    for (const std::string& line : lines_of(file)) {
      const std::string code = line.substr(0, line.find('#'));
      for (std::sregex_iterator it(code.begin(), code.end(), linked), end; it != end; ++it) {
        EXPECT_EQ(complaint(own, (*it)[1]), "") << file << ": " << line;
      }
    }
  }
}

TEST(IncludeRule, EveryFolderOfTheTreeHasALevel) {
  const fs::path root = KNAP_SOURCE_DIR;
  for (const char* floor : {"src", "solvers"}) {
    for (const auto& entry : fs::directory_iterator(root / floor)) {
      if (!entry.is_directory()) continue;
      EXPECT_TRUE(level_of_module.contains(entry.path().filename())) << entry.path();
    }
  }
}

TEST(IncludeRule, SeesWrongArrows) {
  using testing::ElementsAre;
  using testing::IsEmpty;
  EXPECT_THAT(complaints("solvers/fem/a.cpp", "#include \"core/types.hpp\""), IsEmpty());
  EXPECT_THAT(complaints("solvers/fem/a.cpp", "#include \"fem/a.hpp\""), IsEmpty());
  EXPECT_THAT(complaints("solvers/fem/a.cpp", "#include \"a.hpp\""), IsEmpty());
  EXPECT_THAT(complaints("solvers/fem/a.cpp", "// #include \"app/main.hpp\""), IsEmpty());
  EXPECT_THAT(complaints("src/core/a.hpp", "#include \"fem/a.hpp\""), ElementsAre("core -> fem points upwards"));
  EXPECT_THAT(complaints("meshing/a.cpp", "#  include \"config/a.hpp\""),
              ElementsAre("meshing -> config points upwards"));
  EXPECT_THAT(complaints("src/analysis/a.hpp", " #include \"observers/a.hpp\""),
              ElementsAre("analysis -> observers points sideways"));
  EXPECT_THAT(complaints("src/core/a.hpp", "#include \"../x.hpp\""), ElementsAre("'..' is no module"));
  EXPECT_THAT(complaints("src/new/a.hpp", "#include \"core/x.hpp\""), ElementsAre("module 'new' has no level"));
}

TEST(IncludeRule, SeesBrokenFences) {
  using testing::IsEmpty;
  using testing::SizeIs;
  EXPECT_THAT(complaints("meshing/shapes/a.cpp", "#include <gmsh.h>"), IsEmpty());
  EXPECT_THAT(complaints("meshing/a.hpp", "#include <gmsh.h>"), SizeIs(1));
  EXPECT_THAT(complaints("solvers/contact/a.cpp", "#include <CGAL/AABB_tree.h>"), IsEmpty());
  EXPECT_THAT(complaints("solvers/fem/a.cpp", "#include <CGAL/AABB_tree.h>"), SizeIs(1));
  EXPECT_THAT(complaints("src/io/vtk_writer.cpp", "#include <vtkPoints.h>"), IsEmpty());
  EXPECT_THAT(complaints("src/app/a.cpp", "#include <vtkPoints.h>"), SizeIs(1));
  EXPECT_THAT(complaints("src/observers/a.cpp", "#include <H5Cpp.h>"), SizeIs(1));
  EXPECT_THAT(complaints("src/config/a.hpp", "#include <toml.hpp>"), SizeIs(1));
  EXPECT_THAT(complaints("src/config/a.cpp", "#include <toml.hpp>"), IsEmpty());
  EXPECT_THAT(complaints("solvers/fem/a.cpp", "  #pragma omp parallel for"), SizeIs(1));
  EXPECT_THAT(complaints("src/core/parallel.hpp", "#pragma omp parallel for"), IsEmpty());
}

}  // namespace
}  // namespace knap
