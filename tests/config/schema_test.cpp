#include "config/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "config/material_presets.hpp"
#include "config/read_value.hpp"

namespace knap {
namespace {

using testing::HasSubstr;

TEST(Schema, EveryRowIsComplete) {
  std::set<std::string> seen;
  for (const Key& key : schema()) {
    const std::string name = key.section + "." + key.name;
    EXPECT_TRUE(seen.insert(name).second) << name;
    EXPECT_TRUE(key.description.ends_with(".")) << name;
    EXPECT_TRUE(key.get && key.set) << name;
    EXPECT_EQ(key.choices.empty(), key.type != KeyType::Choice) << name;
    const bool numeric = key.type == KeyType::Quantity || key.type == KeyType::Vector || key.type == KeyType::Integer;
    EXPECT_EQ(!key.range.text.empty(), numeric) << name;
    if (numeric) {
      EXPECT_LT(key.range.low, key.range.high) << name;
    }
  }
}

TEST(Schema, DefaultsAndPresetsFitTheirKeys) {
  for (const Key& key : schema())
    if (key.fallback.kind == Fallback::Kind::Text) {
      EXPECT_EQ(read_value(key, parse_loose_value(key.fallback.text), {}).problem, "") << key.name;
    }
  for (const MaterialPreset& preset : material_presets())
    for (const PresetValue& value : preset.values) {
      const Key* key = find_key(value.section, value.key);
      ASSERT_NE(key, nullptr) << value.key;
      EXPECT_EQ(read_value(*key, parse_loose_value(value.text), {}).problem, "") << preset.name << value.key;
      EXPECT_FALSE(value.source.empty());
    }
}

TEST(Schema, SetAndGetReachTheSameField) {
  RunConfig config;
  config.particles.resize(3);
  config.tools.resize(3);
  for (const Key& key : schema()) {
    if (key.type != KeyType::Quantity) continue;
    const std::size_t last = count(scope(key), config) - 1;
    key.set(config, last, 0.123);
    EXPECT_EQ(std::get<double>(key.get(config, last)), 0.123) << key.name;
    key.set(config, last, 0.0);
    if (last > 0) {
      EXPECT_NE(key.get(config, 0), Value(0.123)) << key.name;
    }
  }
}

TEST(Schema, SectionsOfOneScopeFollowEachOther) {
  std::vector<Scope> scopes;
  for (const Section& section : sections())
    if (scopes.empty() || scopes.back() != section.scope) scopes.push_back(section.scope);
  EXPECT_EQ(scopes.size(), std::set<Scope>(scopes.begin(), scopes.end()).size());
  for (const Key& key : schema()) EXPECT_NE(find_section(key.section), nullptr) << key.section;
}

TEST(Schema, RangesReadAsWords) {
  EXPECT_EQ(in_words(find_key("impact", "angle")->range), "above 0 deg up to 90 deg");
  EXPECT_EQ(in_words(find_key("particle", "diameter")->range), "from 1 um to 10 m");
}

TEST(CaseReference, ListsEveryKey) {
  const std::string table = describe_keys();
  for (const Key& key : schema()) EXPECT_THAT(table, HasSubstr("\n" + key.section + "." + key.name + " "));
}

// After a change of the schema: KNAP_WRITE_CASE_REFERENCE=1 config_test --gtest_filter=CaseReference.*
TEST(CaseReference, ThePageIsUpToDate) {
  const std::string file = KNAP_SOURCE_DIR "/docs/case_reference.md";
  if (std::getenv("KNAP_WRITE_CASE_REFERENCE")) std::ofstream(file) << keys_as_markdown();
  std::stringstream page;
  page << std::ifstream(file).rdbuf();
  EXPECT_EQ(page.str(), keys_as_markdown()) << "write it anew with KNAP_WRITE_CASE_REFERENCE=1";
}

}  // namespace
}  // namespace knap
