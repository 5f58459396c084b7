#pragma once
#include <Teuchos_XMLParameterListHelpers.hpp>
#include <cmath>
#include <ostream>
#include <string>

#include "tunica/judge/sanity.hpp"
#include "tunica/setup/schema.hpp"

namespace tunica::test {

inline std::string number(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"double\" value=\"" + value + "\"/>";
}
inline std::string text(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>";
}
inline std::string sublist(const std::string& name, const std::string& content) {
  return "<ParameterList name=\"" + name + "\">" + content + "</ParameterList>";
}
inline std::string condition(const std::string& surface, const std::string& kind,
                             const std::string& rest = "") {
  return sublist(surface, text("condition", kind) + rest);
}
inline std::string table_of(const std::string& times, const std::string& values,
                            const std::string& rest = "") {
  const std::string array = "<Parameter type=\"Array(double)\" name=\"";
  return sublist("Amplitude", text("kind", "table") + array + "times\" value=\"{" + times +
                                  "}\"/>" + array + "values\" value=\"{" + values + "}\"/>" + rest);
}

/// A tube of meshes/tube-tiny.h5: 100 steps of 1 ms, blood, a wall of 100 kPa.
struct TubeCase {
  std::string step_size = "1", density = "1", viscosity = "0.004";
  std::string inlet = condition("inlet", "flow rate", number("flow rate", "2"));
  std::string outlet = condition("outlet", "pressure", number("pressure", "0"));
  std::string c10 = "33.3333333333";
  std::string prestress = "0";
  std::string ends = condition("struct_in", "clamped") + condition("struct_out", "clamped");
  std::string wall;  ///< further keys of it

  Teuchos::ParameterList resolved() const {
    const std::string interface = condition("interface", "interface");
    const std::string law =
        text("law", "neo-hookean") + number("c10", c10) + number("bulk modulus", "1e9");
    Teuchos::ParameterList list = *Teuchos::getParametersFromXmlString(sublist(
        "Case", sublist("Mesh", text("file", TUNICA_MESHES "/tube-tiny.h5")) +
                    sublist("Time", number("step size", step_size) +
                                        "<Parameter name=\"steps\" type=\"int\" value=\"100\"/>") +
                    sublist("Fluid", number("density", density) + number("viscosity", viscosity) +
                                         sublist("Surfaces", inlet + outlet + interface)) +
                    sublist("Wall", wall + sublist("Prestress", number("pressure", prestress)) +
                                        sublist("Layers", sublist("media", law) +
                                                              sublist("adventitia", law)) +
                                        sublist("Surfaces", ends + interface))));
    setup::fsi_table().resolve(list, "", "");
    return list;
  }
};

/// A tube of radius 1, length 40 and a wall of 0.1, as if it were measured.
inline judge::Vessel ideal_tube() {
  judge::Vessel vessel;
  vessel.fluid.emplace();
  vessel.fluid->pieces = {1};
  vessel.fluid->volume = 40.0 * M_PI;
  vessel.fluid->edge = 0.2;
  vessel.wall = vessel.fluid;
  vessel.openings = {{"inlet", M_PI, 12}, {"outlet", M_PI, 12}};
  vessel.radius = 1.0;
  vessel.length = 40.0;
  vessel.elements_across_lumen = 12;
  vessel.thickness = 0.1;
  vessel.elements_across_wall = 3;
  vessel.region_shares = {0.6, 0.4};
  return vessel;
}

inline bool doubts(const TubeCase& tube, const std::string& part, std::ostream& out) {
  for (const std::string& doubt : judge::sanity_of(tube.resolved(), ideal_tube()).doubts) {
    if (doubt.find(part) != std::string::npos) return true;
    out << doubt << "\n";
  }
  return false;
}

}  // namespace tunica::test
