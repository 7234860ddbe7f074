#include "config/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace knap {
namespace {

using testing::HasSubstr;
using enum Quantity;

double si(const std::string& text, Quantity quantity) {
  const Conversion converted = convert_to_si(text, quantity);
  EXPECT_EQ(converted.problem, "") << text;
  return converted.value;
}
std::string problem(const std::string& text, Quantity quantity) { return convert_to_si(text, quantity).problem; }

TEST(Units, DecimalUnitsGiveTheSameBitsAsSi) {
  EXPECT_EQ(si("2 mm", Length), 0.002);
  EXPECT_EQ(si("1.09mm", Length), 0.00109);
  EXPECT_EQ(si("65 um", Length), 65e-6);
  EXPECT_EQ(si("65 \u00b5m", Length), 65e-6);
  EXPECT_EQ(si("2.45 GPa", Stress), 2.45e9);
  EXPECT_EQ(si("8.34 MPa", Stress), 8.34e6);
  EXPECT_EQ(si("1 N/mm2", Stress), 1e6);
  EXPECT_EQ(si("20 us", Time), 20e-6);
  EXPECT_EQ(si("1 mm3", Volume), 1e-9);
  EXPECT_EQ(si("1 mm^3", Volume), 1e-9);
  EXPECT_EQ(si("1270 kg/m3", Density), 1270.0);
  EXPECT_EQ(si("1.27 g/cm^3", Density), 1270.0);
  EXPECT_EQ(si("8.6 J/m2", SurfaceEnergy), 8.6);
  EXPECT_EQ(si("8.6 N/m", SurfaceEnergy), 8.6);
  EXPECT_EQ(si("15m/s", Speed), 15.0);
  EXPECT_EQ(si("+1.5e1 m / s", Speed), 15.0);
  EXPECT_EQ(si("30 %", Ratio), 0.3);
  EXPECT_EQ(si("0.3", Ratio), 0.3);
}

TEST(Units, EverySpellingOfAToughnessIsTheSame) {
  for (const char* text :
       {"0.2 MPa m^1/2", "0.2 MPa m^0.5", "0.2 MPa*m^(1/2)", "0.2 MPa sqrt(m)", "0.2 MPa\u00b7m^1/2"})
    EXPECT_EQ(si(text, Toughness), 0.2e6) << text;
  EXPECT_DOUBLE_EQ(si("1 MPa mm^1/2", Toughness), 1e6 * std::sqrt(1e-3));
}

TEST(Units, AnglesAndTimesConvertByTheirFactor) {
  EXPECT_EQ(si("90 deg", Angle), std::numbers::pi / 2.0);
  EXPECT_EQ(si("180\u00b0", Angle), std::numbers::pi);
  EXPECT_DOUBLE_EQ(si("60 deg", Angle), std::numbers::pi / 3.0);
  EXPECT_EQ(si("1.5 rad", Angle), 1.5);
  EXPECT_EQ(si("100 rad/s", AngularSpeed), 100.0);
  EXPECT_DOUBLE_EQ(si("60 rpm", AngularSpeed), 2.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(si("36 km/h", Speed), 10.0);
  EXPECT_EQ(si("5 min", Time), 300.0);
}

TEST(Units, AWrongDimensionNamesBothKindsAndSampleUnits) {
  const std::string text = problem("5 kg/m3", Speed);
  EXPECT_THAT(text, HasSubstr("measures a density"));
  EXPECT_THAT(text, HasSubstr("expected a speed"));
  EXPECT_THAT(text, HasSubstr("m/s, mm/s, km/s, km/h"));
  EXPECT_THAT(problem("5", Length), HasSubstr("unit is missing"));
  EXPECT_THAT(problem("5 m", Ratio), HasSubstr("measures a length"));
  EXPECT_THAT(problem("5 kg", Length), HasSubstr("\"kg\" measures a mass"));
  EXPECT_THAT(problem("5 kg2", Length), HasSubstr("\"kg2\" does not fit"));
}

TEST(Units, AnUnknownUnitGetsASuggestion) {
  EXPECT_THAT(problem("2.45 Gpa", Stress), HasSubstr("did you mean \"GPa\"?"));
  EXPECT_THAT(problem("2 mmm", Length), HasSubstr("unknown unit \"mmm\""));
  EXPECT_THAT(problem("3,5 mm", Length), HasSubstr("has a decimal comma, write a point; expected a length"));
}

TEST(Units, WhatIsNoQuantityIsRefused) {
  for (const char* text :
       {"", " ", "mm", "two mm", "nan mm", "inf mm", "-inf", "2 m/", "2 /", "2 m^", "2 m^1/", "2 m^99", "2 m^(1/2",
        "2 m**2", "2 sqrt(m", "2 sqrt(", "2 m m m m m m m m m m", "2 m;", "0x10 m"})
    EXPECT_NE(problem(text, Length), "") << text;
  EXPECT_THAT(problem("1e999 m", Length), HasSubstr("too large"));
  EXPECT_THAT(problem("1e99999999999999999999 m", Length), HasSubstr("too large"));
}

TEST(Units, TheSampleOfEachQuantityConverts) {
  for (int i = 0; i <= static_cast<int>(Toughness); ++i) {
    const auto quantity = static_cast<Quantity>(i);
    EXPECT_GT(si(std::string(sample_value(quantity)), quantity), 0.0);
    std::string units(sample_units(quantity));
    for (std::size_t comma; (comma = units.find(", ")) != std::string::npos; units.erase(0, comma + 2))
      EXPECT_GT(si("1 " + units.substr(0, comma), quantity), 0.0) << units;
    EXPECT_GT(si("1 " + units, quantity), 0.0) << units;
  }
}

}  // namespace
}  // namespace knap
