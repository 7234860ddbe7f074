#pragma once
// Numbers with units, as users write them. A decimal unit only moves the decimal point, so "2.45 GPa" is the same
// double as 2.45e9; converting by a factor would often differ in the last bit.
#include <string>
#include <string_view>

namespace knap {

/// What a number measures; each has one SI unit, in which it is kept in memory.
enum class Quantity {
  Ratio,          ///< [-]
  Length,         ///< [m]
  Volume,         ///< [m3]
  Time,           ///< [s]
  Speed,          ///< [m/s]
  Angle,          ///< [rad]
  AngularSpeed,   ///< [rad/s]
  Stress,         ///< [Pa]
  Density,        ///< [kg/m3]
  SurfaceEnergy,  ///< [J/m2]
  Toughness,      ///< [Pa m^1/2]
  Mass,           ///< [kg]
  Acceleration,   ///< [m/s2]
  Count
};

std::string_view name(Quantity quantity);          ///< "a speed"
std::string_view si_unit(Quantity quantity);       ///< "m/s"; "-" for a ratio
std::string_view sample_units(Quantity quantity);  ///< "m/s, mm/s, km/s, km/h"
std::string_view sample_value(Quantity quantity);  ///< "15 m/s"

/// A converted number, or why there is none.
struct Conversion {
  double value = 0.0;   ///< SI
  std::string problem;  ///< "" = converted
};

/// Converts text such as "2.45 GPa", "0.2 MPa m^1/2", "60 deg" to SI. The text must carry a unit of the expected kind
/// (a ratio: none, or %); the problem otherwise names what is expected and sample units.
Conversion convert_to_si(std::string_view text, Quantity expected);

}  // namespace knap
