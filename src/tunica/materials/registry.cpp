#include "tunica/materials/registry.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/materials/holzapfel.hpp"
#include "tunica/materials/mooney_rivlin.hpp"
#include "tunica/materials/st_venant_kirchhoff.hpp"

namespace tunica::materials {

namespace {

std::vector<LawEntry>& known_laws() {
  static std::vector<LawEntry> all = {
      mooney_rivlin(),
      neo_hookean(),
      holzapfel(),
      st_venant_kirchhoff(),
  };
  return all;
}

template <class List>
std::string names_of(const List& list) {
  std::string names;
  for (const auto& entry : list) names += (names.empty() ? "\"" : ", \"") + entry.name + "\"";
  return names;
}

template <class List>
auto find_named(const List& list, const std::string& name) {
  return std::find_if(list.begin(), list.end(),
                      [&](const auto& entry) { return entry.name == name; });
}

void check_value(const std::string& law, const Constant& constant, double value) {
  std::ostringstream message;
  message << law << ": \"" << constant.name << "\" is " << value << " " << constant.unit
          << ", expected a number " << (constant.is_low_excluded ? "above " : "not below ")
          << constant.low;
  if (std::isfinite(constant.high)) message << " and not above " << constant.high;
  message << ".";
  const bool is_too_low = constant.is_low_excluded ? value <= constant.low : value < constant.low;
  TUNICA_CHECK(std::isfinite(value) && !is_too_low && value <= constant.high, message.str());
}

}  // namespace

const std::vector<LawEntry>& laws() { return known_laws(); }

void register_law(LawEntry law) {
  TUNICA_CHECK(find_named(laws(), law.name) == laws().end(),
               "Material law \"" + law.name + "\" is registered twice.");
  known_laws().push_back(std::move(law));
}

Constants completed(const std::string& law, const std::vector<Constant>& constants,
                    const Constants& given) {
  Constants complete;
  for (const Constant& constant : constants) complete[constant.name] = constant.fallback;
  for (const auto& [key, value] : given) {
    TUNICA_CHECK(
        find_named(constants, key) != constants.end(),
        law + ": unknown constant \"" + key + "\", expected one of " + names_of(constants) + ".");
    complete[key] = value;
  }
  for (const Constant& constant : constants) check_value(law, constant, complete.at(constant.name));
  return complete;
}

std::unique_ptr<HyperelasticLaw> make_law(const std::string& name, const Constants& constants) {
  const auto law = find_named(laws(), name);
  TUNICA_CHECK(law != laws().end(), "Material law \"" + name + "\" is unknown, expected one of " +
                                        names_of(laws()) + ".");
  auto made = law->make(completed("Material law \"" + name + "\"", law->constants, constants));
  TUNICA_CHECK(made->stabilisation_modulus() > 0.0,
               "Material law \"" + name +
                   "\" has no stiffness in shear, expected at least one positive constant of " +
                   names_of(law->constants) + ".");
  return made;
}

}  // namespace tunica::materials
