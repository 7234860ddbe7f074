// What a user sees after a mistake: file, line, key, value, what is allowed, and the name that was probably meant.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "tests/config/case_text.hpp"

namespace knap {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using namespace testing_cases;

// The shortest case with line `line` (1..6) replaced.
std::string with_line(int line, const std::string& replacement) {
  std::size_t start = 0;
  for (int i = 1; i < line; ++i) start = shortest.find('\n', start) + 1;
  return shortest.substr(0, start) + replacement + shortest.substr(shortest.find('\n', start));
}

TEST(BadCase, AMisspeltKeyGetsASuggestion) {
  EXPECT_THAT(complaint(with_line(2, "diamter = \"2 mm\"")),
              StartsWith("case.toml:2:11: [particle] has no key \"diamter\" (did you mean \"diameter\"?)"));
}

TEST(BadCase, AMisspeltSectionGetsASuggestion) {
  EXPECT_THAT(complaint(with_line(5, "[impct]")),
              StartsWith("case.toml:5:1: unknown section [impct] (did you mean \"impact\"?)"));
}

TEST(BadCase, AKeyInTheWrongSectionIsSentToItsOwn) {
  EXPECT_THAT(complaint(shortest + "preset = \"plaster\"\n"),
              StartsWith("case.toml:7:10: [impact] has no key \"preset\"; preset belongs to [material]"));
  EXPECT_THAT(complaint("speed = 3\n" + shortest), AllOf(HasSubstr("case.toml:1:9"), HasSubstr("belongs to [impact]")));
}

TEST(BadCase, AMisspeltPresetOrWordGetsASuggestion) {
  EXPECT_THAT(
      complaint(with_line(4, "preset = \"zeolite\"")),
      AllOf(HasSubstr("case.toml:4:10: material.preset = \"zeolite\": must be one of zeolite_4ak, gamma_alumina"),
            HasSubstr("did you mean \"zeolite_4ak\"?")));
  EXPECT_THAT(complaint(shortest, {"particle.shape=spere"}), HasSubstr("did you mean \"sphere\"?"));
}

TEST(BadCase, AWrongTypeSaysWhatIsExpected) {
  EXPECT_THAT(
      complaint(with_line(6, "speed = true")),
      StartsWith("case.toml:6:9: impact.speed = true: must be a speed: a number in m/s or text such as \"15 m/s\""));
  EXPECT_THAT(complaint(with_line(6, "speed = [1, 2]")), HasSubstr("impact.speed = [1, 2]: must be a speed"));
  EXPECT_THAT(complaint(with_line(6, "speed = 2020-01-01")),
              HasSubstr("impact.speed = a date or time: must be a speed"));
  EXPECT_THAT(complaint(with_line(6, "speed = {x = 1}")), HasSubstr("impact.speed = a table: must be a speed"));
  EXPECT_THAT(complaint(with_line(4, "preset = 3")), HasSubstr("material.preset = 3: must be a word in quotes"));
  EXPECT_THAT(complaint(shortest, {"run.threads=1.5"}),
              HasSubstr("run.threads = 1.5: must be an integer from 0 to 1024"));
  EXPECT_THAT(complaint(shortest, {"output.picture=1"}), HasSubstr("output.picture = 1: must be true or false"));
  EXPECT_THAT(complaint(shortest, {"impact.spin=[1, 2]"}), HasSubstr("must be an array of three"));
  EXPECT_THAT(complaint(shortest, {"impact.spin=[1, 2, nan]"}), HasSubstr("entry 3: must be a finite number"));
}

TEST(BadCase, AWrongUnitNamesTheDimension) {
  EXPECT_THAT(complaint(with_line(6, "speed = \"15 mm\"")),
              StartsWith("case.toml:6:9: impact.speed = \"15 mm\": \"mm\" measures a length; expected a speed"));
  EXPECT_THAT(complaint(with_line(6, "speed = \"15\"")), HasSubstr("the unit is missing"));
}

TEST(BadCase, ValuesOutOfRangeAreRefused) {
  EXPECT_THAT(complaint(with_line(6, "speed = -3")),
              StartsWith("case.toml:6:9: impact.speed = -3: must be from 1 mm/s to 5 km/s"));
  const std::vector<std::string> bad{"impact.speed=0",
                                     "impact.speed=1e9 m/s",
                                     "impact.speed=inf",
                                     "impact.speed=nan",
                                     "impact.speed=1e999",
                                     "particle.diameter=0.1 um",
                                     "particle.diameter=20 m",
                                     "particle.diameter=-2 mm",
                                     "mesh.perturbation=0.31",
                                     "mesh.seed=-1",
                                     "mesh.element_size=2 m",
                                     "material.poisson_ratio=0.5",
                                     "material.density=0",
                                     "material.young_modulus=100",
                                     "fracture.strength=0",
                                     "fracture.toughness=0",
                                     "impact.angle=0",
                                     "impact.angle=91 deg",
                                     "impact.wall_friction=-0.1",
                                     "run.step_safety=0",
                                     "run.step_safety=1e-20",
                                     "fracture.weibull_modulus=-1",
                                     "run.step_safety=0.91",
                                     "run.threads=-1",
                                     "run.insertion_interval=0",
                                     "output.frames=-1",
                                     "run.threads=99999999999",
                                     "mesh.seed=99999999999999999999"};
  for (const auto& item : bad)
    EXPECT_THAT(complaint(shortest, {item}), AllOf(HasSubstr("command line --set " + item), HasSubstr("must be ")))
        << item;
  EXPECT_THAT(complaint(with_line(6, "speed = nan")), HasSubstr("impact.speed = nan: must be a finite number"));
}

TEST(BadCase, AWeibullModulusBelowOneIsRefused) {
  EXPECT_THAT(complaint(shortest, {"fracture.weibull_modulus=0.5", "fracture.weibull_reference_volume=1 mm3"}),
              HasSubstr("fracture.weibull_modulus = 0.5: must be 0"));
  EXPECT_THAT(complaint(shortest, {"fracture.crushed_zone_facets=0.5"}),
              HasSubstr("fracture.crushed_zone_facets = 0.5: must be 0"));
}

TEST(BadCase, ABareAngleIsInRadians) {
  EXPECT_THAT(
      complaint(shortest, {"impact.angle=45"}),
      HasSubstr("above 0 deg up to 90 deg; a bare number is in radians, write degrees as text such as \"60 deg\""));
}

TEST(BadCase, MissingSectionsAndKeysAreAllNamed) {
  const std::string text = complaint("[particle]\nshape = \"box\"\n");
  EXPECT_THAT(text, HasSubstr("case.toml: the section [material] is missing"));
  EXPECT_THAT(text, HasSubstr("case.toml: the section [impact] is missing"));
  EXPECT_THAT(text, HasSubstr("case.toml:1:1: particle.lengths is missing"));
  for (const char* key : {"young_modulus", "poisson_ratio", "density"})
    EXPECT_THAT(text, HasSubstr(std::string("material.") + key + " is missing"));
  EXPECT_THAT(text, HasSubstr("impact.speed is missing"));
  EXPECT_THAT(text, HasSubstr("For instance speed = \"15 m/s\"."));
  EXPECT_THAT(complaint(""), HasSubstr("section [particle] is missing"));
}

TEST(BadCase, KeysOfAnotherShapeAreRefused) {
  EXPECT_THAT(complaint(with_line(2, "diameter = \"2 mm\"\ndiameters = [1e-3, 1e-3, 1e-3]")),
              StartsWith("case.toml:3:13: particle.diameters does not apply: it needs that shape = \"ellipsoid\""));
}

TEST(BadCase, ConditionalKeysAreRequiredWithTheirCondition) {
  EXPECT_THAT(complaint(shortest, {"fracture.weibull_modulus=5"}),
              AllOf(HasSubstr("fracture.weibull_reference_volume is missing"), HasSubstr("weibull_modulus > 0")));
  EXPECT_THAT(complaint(shortest, {"material.viscous_ratio=0.3"}), HasSubstr("material.relaxation_time is missing"));
}

TEST(BadCase, SizesThatCannotBeMeshedAreRefused) {
  EXPECT_THAT(complaint(shortest, {"mesh.element_size=3 mm"}), HasSubstr("at most half the smallest extent"));
  EXPECT_THAT(complaint(shortest, {"mesh.element_size=1 um"}), HasSubstr("tets, allowed are 2e+07"));
  EXPECT_THAT(complaint(shortest, {"mesh.element_size=0.1 mm", "mesh.contact_element_size=0.2 mm"}),
              HasSubstr("at most mesh.element_size"));
}

TEST(BadCase, AllMistakesAreReportedAtOnceInTheOrderOfTheFile) {
  const std::string text =
      complaint("[particle]\ndiameter = -1\nform = 3\n[material]\npreset = \"glas\"\n[impact]\nspeed = \"fast\"\n");
  const std::size_t first = text.find("case.toml:2:12"), second = text.find("case.toml:3:8"),
                    third = text.find("case.toml:5:10"), fourth = text.find("case.toml:7:9");
  EXPECT_TRUE(first < second && second < third && third < fourth && fourth != std::string::npos) << text;
}

TEST(BadCase, TextThatIsNotTomlPointsAtTheLine) {
  EXPECT_THAT(complaint(with_line(6, "speed = 15 m/s")),
              AllOf(StartsWith("case.toml:6:"), HasSubstr("words and values with a unit need quotes: \"15 m/s\"")));
  EXPECT_THAT(complaint(with_line(6, "speed = fast")),
              AllOf(StartsWith("case.toml:6:"), HasSubstr("need quotes: \"fast\"")));
  EXPECT_THAT(complaint(with_line(6, "speed")), StartsWith("case.toml:6:"));
  EXPECT_THAT(complaint(with_line(6, "speed = \"15 m/s")), StartsWith("case.toml:6:"));
  EXPECT_THAT(complaint(with_line(5, "[impact")), StartsWith("case.toml:5:"));
  EXPECT_THAT(complaint("<html>\n<body>\n"), AllOf(StartsWith("case.toml:1:"), Not(HasSubstr("toml::"))));
}

TEST(BadCase, DuplicatesNameBothLines) {
  EXPECT_THAT(complaint(shortest + "speed = 3\n"), StartsWith("case.toml:7:9: speed is given twice (first in line 6)"));
  EXPECT_THAT(complaint(shortest + "[impact]\nangle = 1\n"),
              StartsWith("case.toml:7:1: [impact] is given twice (first in line 5)"));
}

TEST(BadCase, SectionsMustBeSections) {
  EXPECT_THAT(complaint("particle = 3\n"), HasSubstr("case.toml:1:12: particle = 3: is a section, write [particle]"));
  EXPECT_THAT(complaint(shortest + "[[run]]\nseed = 1\n"),
              StartsWith("case.toml:7:1: [[run]]: there is one of it, write [run]"));
}

TEST(BadCase, OverridesNeedTheirForm) {
  for (const char* item : {"", "speed", "speed=3", "impact.speed", ".speed=3", "impact.=3", "=", "impact.speed="})
    EXPECT_THAT(complaint(shortest, {item}), StartsWith(std::string("command line --set ") + item + ": ")) << item;
  EXPECT_THAT(complaint(shortest, {"impact.sped=3"}),
              AllOf(StartsWith("command line --set impact.sped=3: "), HasSubstr("\"speed\"?")));
  EXPECT_THAT(complaint(shortest, {"impct.speed=3"}), HasSubstr("unknown section [impct] (did you mean \"impact\"?)"));
  EXPECT_THAT(complaint(shortest, {"impact.speed=3\n[run]"}), HasSubstr("impact.speed = \"3?[run]\""));
}

TEST(BadCase, WhatBreaksTheParserIsRefusedBefore) {
  EXPECT_THAT(complaint("a = " + std::string(4000, '[')), HasSubstr("case.toml:1: brackets are nested too deeply"));
  EXPECT_THAT(complaint("a = \"]\"\nb = " + std::string(1000, '{')),
              HasSubstr("case.toml:2: brackets are nested too deeply"));
  EXPECT_THAT(complaint("[impact]\nspeed = []\nspeed.x = 1\n"), HasSubstr("case.toml:2: empty brackets []"));
  EXPECT_THAT(complaint("[run]\nseed = 0xFFFFFFFFFFFFFFFF\n"), HasSubstr("case.toml:2: only decimal numbers"));
  EXPECT_THAT(complaint("[run]\na" + std::string(6000, '.') + " = 1\n"),
              HasSubstr("case.toml:2: more than 5000 bytes in a line"));
  EXPECT_THAT(complaint(std::string(70000, ' ')), HasSubstr("more than 64 KiB"));
  EXPECT_THAT(complaint(std::string("[run]\n\0\1\2", 9)), HasSubstr("case.toml:2: a zero byte: this is a binary file"));
  EXPECT_THAT(complaint("[run]\n# \xff\xfe\n"), HasSubstr("case.toml:2: not UTF-8 text"));
  EXPECT_THAT(complaint(shortest, {"impact.spin=" + std::string(4000, '[')}), HasSubstr("must be an array of three"));
}

std::string file_complaint(const std::filesystem::path& file) {
  try {
    (void)load_config(file);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError for " << file;
  return "";
}

TEST(BadCase, FilesThatCannotBeReadAreNamed) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "knap_bad_files";
  std::filesystem::create_directories(folder);
  EXPECT_THAT(file_complaint(folder / "none.toml"), AllOf(HasSubstr("none.toml"), HasSubstr("no such case file")));
  EXPECT_THAT(file_complaint(folder), HasSubstr("is a directory"));
  EXPECT_THAT(file_complaint("/dev/null"), HasSubstr("not a regular file"));
  EXPECT_THAT(file_complaint(""), HasSubstr("no such case file"));
  std::ofstream(folder / "locked.toml") << shortest;
  ASSERT_EQ(chmod((folder / "locked.toml").c_str(), 0), 0);
  if (geteuid() != 0) {
    EXPECT_THAT(file_complaint(folder / "locked.toml"), HasSubstr("cannot be read"));
  }
  std::filesystem::remove_all(folder);
}

TEST(BadCase, IntrinsicCracksGoWithFewOptions) {
  EXPECT_THAT(complaint(shortest, {"fracture.insertion=intrinsic", "contact.rigid_fragments=true"}),
              HasSubstr("fracture.insertion = \"intrinsic\": cannot go with contact.rigid_fragments = true"));
  EXPECT_THAT(complaint(shortest, {"fracture.insertion=intrinsic", "impact.repeat=2"}),
              HasSubstr("cannot go with impact.repeat > 1"));
  EXPECT_THAT(complaint(shortest, {"fracture.penalty_ratio=20"}), HasSubstr("fracture.penalty_ratio"));
}

}  // namespace
}  // namespace knap
