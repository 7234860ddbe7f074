// The rows of [[tool]].
#include <algorithm>

#include "config/key_builder.hpp"
#include "config/schema_rows.hpp"

namespace knap {
namespace {

using enum Quantity;
using C = ToolConfig;

constexpr auto in = [](auto& config, std::size_t i) -> auto& { return config.tools[i]; };

// "a" or "b" or "c".
std::string alternatives(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "\"" : " or \"") + word + "\"";
  return text;
}

template <class Enum>
KeyCondition one_of(const char* key, Enum C::*member, const std::vector<Enum>& allowed,
                    const std::vector<std::string>& words) {
  std::vector<std::string> shown;
  for (const Enum value : allowed) shown.push_back(words.at(static_cast<std::size_t>(value)));
  return {std::string(key) + " = " + alternatives(shown), [=](const RunConfig& config, std::size_t i) {
            return std::find(allowed.begin(), allowed.end(), config.tools[i].*member) != allowed.end();
          }};
}

KeyCondition type_is(const std::vector<ToolKind>& allowed) {
  static const std::vector<std::string> words{"plane", "platen", "sphere", "cylinder", "stl"};
  return one_of("type", &C::type, allowed, words);
}

KeyCondition motion_is(const std::vector<MotionKind>& allowed) {
  static const std::vector<std::string> words{"rest", "velocity", "ramp", "rotation", "free"};
  return one_of("motion", &C::motion, allowed, words);
}

std::vector<Key> geometry_keys() {
  using enum ToolKind;
  return {
      only_when(type_is({Platen, ToolKind::Sphere, Cylinder}),
                quantity("radius", Length, "[1 um, 10 m]", required(), field(in, &C::radius),
                         "Radius of the sphere, the cylinder or the disc.")),
      only_when(type_is({Cylinder}), quantity("length", Length, "[1 um, 10 m]", required(), field(in, &C::length),
                                              "Length of the cylinder, whose ends are flat.")),
      only_when(type_is({Platen, Stl}),
                quantity("thickness", Length, "[1 um, 10 m]", derived("platen: 1/4 of the radius; stl: 0"),
                         field(in, &C::thickness),
                         "Thickness of the disc behind its face, or of the shell that an open STL surface is.")),
      only_when(type_is({Plane, Platen, Stl}),
                vector("normal", Ratio, "[-1e6, 1e6]", value("[0, 0, 1]"), field(in, &C::normal),
                       "Where the face looks: out of the tool, towards the particle; the file's z axis is turned "
                       "there. Of any length.")),
      only_when(type_is({Cylinder}), vector("axis", Ratio, "[-1e6, 1e6]", value("[0, 1, 0]"), field(in, &C::axis),
                                            "Direction of the cylinder's axis, of any length.")),
      only_when(type_is({Stl}), word("file", KeyType::File, {}, required(), field(in, &C::file),
                                     "Triangle surface (STL); a relative path starts at the case file's folder.")),
      only_when(type_is({Stl}), quantity("scale", Length, "[1 nm, 1 km]", value("1 mm"), field(in, &C::scale),
                                         "Length of one unit of the file.")),
      vector("position", Length, "[-100 m, 100 m]", absent("just touching the particle, see below"),
             field(in, &C::position),
             "Where the centre of sphere, cylinder or face is at the start, or the origin of an STL file."),
  };
}

std::vector<Key> motion_keys() {
  using enum MotionKind;
  const KeyCondition rotates = motion_is({Rotation});
  const KeyCondition is_driven{"motion = \"velocity\" or \"ramp\"", motion_is({MotionKind::Velocity, Ramp}).holds};
  return {
      only_when(motion_is({MotionKind::Velocity, Ramp, Free}),
                vector("velocity", Quantity::Speed, "[-5 km/s, 5 km/s]", required_when(is_driven),
                       field(in, &C::velocity), "Velocity; the final one of a ramp, the first one of a free tool.")),
      only_when(motion_is({Ramp}), quantity("ramp_time", Time, "[1 ps, 100 s]", required(), field(in, &C::ramp_time),
                                            "Time in which the velocity grows linearly from 0.")),
      only_when(rotates, quantity("angular_speed", AngularSpeed, "[-1e7 rad/s, 1e7 rad/s]", required(),
                                  field(in, &C::angular_speed), "Speed of rotation about rotation_axis.")),
      only_when(rotates, vector("rotation_axis", Ratio, "[-1e6, 1e6]", value("[0, 0, 1]"), field(in, &C::rotation_axis),
                                "Direction of the axis of rotation, of any length.")),
      only_when(rotates, vector("rotation_centre", Length, "[-100 m, 100 m]", required(),
                                field(in, &C::rotation_centre), "A point on the axis of rotation.")),
      only_when(motion_is({Free}), quantity("mass", Mass, "[1 pg, 1000 kg]", required(), field(in, &C::mass),
                                            "Mass of a tool that moves freely, such as a drop weight.")),
  };
}

}  // namespace

std::vector<Key> tool_keys() {
  const std::vector<std::string> types{"plane", "platen", "sphere", "cylinder", "stl"};
  const std::vector<std::string> motions{"rest", "velocity", "ramp", "rotation", "free"};
  std::vector<Key> keys{
      word("name", KeyType::Name, {}, derived("tool1, tool2, ..."), field(in, &C::name),
           "Name of the tool in results and in --set, of letters, digits, - and _."),
      word("type", KeyType::Choice, types, required(), choice(in, &C::type, types),
           "Shape: half space, flat disc, sphere, cylinder, or a surface from a file."),
  };
  for (Key& key : geometry_keys()) keys.push_back(std::move(key));
  keys.push_back(quantity("friction", Ratio, "[0, 10]", value("0.3"), field(in, &C::friction),
                          "Coefficient of friction between particle and tool."));
  keys.push_back(
      word("motion", KeyType::Choice, motions, value("rest"), choice(in, &C::motion, motions),
           "How it moves: prescribed; or free along its velocity (from rest: along gravity), as a weight on rails."));
  for (Key& key : motion_keys()) keys.push_back(std::move(key));
  keys.push_back(quantity("stop_at_force_drop", Ratio, "[0, 0.99]", value("0"), field(in, &C::stop_at_force_drop),
                          "The run ends when the tool's force has fallen to this part of its largest and something has "
                          "cracked; 0 = it does not."));
  return keys;
}

}  // namespace knap
