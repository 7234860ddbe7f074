// Two types of one name are one to the linker, which takes the destructor of either for both: nothing warns of it.
#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "tests/architecture/source_tree.hpp"

namespace knap {
namespace {

/// "knap::Name" of a line of a header that defines a type outside others; "" for all other lines.
std::string defined_type(const std::string& scope, const std::string& line) {
  static const std::regex definition{
      R"(^(?:struct|class|enum class|enum) (?:alignas\(.*\) )?(\w+)(?: final)?(?: :[^:;]*)?\s*\{.*)"};
  std::smatch match;
  return std::regex_match(line, match, definition) ? scope + "::" + match[1].str() : "";
}

TEST(OneDefinition, NoTwoHeadersDefineATypeOfOneName) {
  const std::regex scoped{R"(^namespace ([\w:]+) \{.*)"};
  std::map<std::string, std::string> place_of_type;
  // Files for Highway are compiled once for each kind of vector, each time into another namespace.
  const auto is_header = [](const std::filesystem::path& path) {
    return path.extension() == ".hpp" && !path.stem().string().ends_with("-inl");
  };
  for (const std::string& file :
       source_files({"src", "meshing", "solvers", "validation", "bench", "tests"}, is_header)) {
    std::string scope;
    for (const std::string& line : lines_of(file)) {
      std::smatch match;
      if (std::regex_match(line, match, scoped)) scope = match[1];
      const std::string type = defined_type(scope, line);
      if (type.empty()) continue;
      const auto [first, is_new] = place_of_type.emplace(type, file);
      EXPECT_TRUE(is_new) << type << " is defined in " << first->second << " and in " << file;
    }
  }
  EXPECT_GT(place_of_type.size(), 150U);
}

TEST(OneDefinition, SeesDefinitions) {
  EXPECT_EQ(defined_type("knap", "struct Condition {"), "knap::Condition");
  EXPECT_EQ(defined_type("knap", "class Study : public Base {"), "knap::Study");
  EXPECT_EQ(defined_type("knap", "enum class Shape : int { Sphere };"), "knap::Shape");
  EXPECT_EQ(defined_type("knap", "struct Condition;"), "");
  EXPECT_EQ(defined_type("knap", "  struct Inner {"), "");
}

}  // namespace
}  // namespace knap
