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

double checked_value(const LawEntry& law, const Constant& constant, double value) {
  std::ostringstream message;
  message << "Material law \"" << law.name << "\": \"" << constant.name << "\" is " << value << " "
          << constant.unit << ", expected a number not below " << constant.low;
  if (std::isfinite(constant.high)) message << " and not above " << constant.high;
  message << ".";
  TUNICA_CHECK(std::isfinite(value) && value >= constant.low && value <= constant.high,
               message.str());
  return value;
}

}  // namespace

const std::vector<LawEntry>& laws() { return known_laws(); }

void register_law(LawEntry law) {
  TUNICA_CHECK(find_named(laws(), law.name) == laws().end(),
               "Material law \"" + law.name + "\" is registered twice.");
  known_laws().push_back(std::move(law));
}

std::unique_ptr<HyperelasticLaw> make_law(const std::string& name, const Constants& constants) {
  const auto law = find_named(laws(), name);
  TUNICA_CHECK(law != laws().end(), "Material law \"" + name + "\" is unknown, expected one of " +
                                        names_of(laws()) + ".");
  Constants complete;
  for (const Constant& constant : law->constants) complete[constant.name] = constant.fallback;
  for (const auto& [key, value] : constants) {
    const auto constant = find_named(law->constants, key);
    TUNICA_CHECK(constant != law->constants.end(),
                 "Material law \"" + name + "\": unknown constant \"" + key +
                     "\", expected one of " + names_of(law->constants) + ".");
    complete[key] = checked_value(*law, *constant, value);
  }
  auto made = law->make(complete);
  TUNICA_CHECK(made->stabilisation_modulus() > 0.0,
               "Material law \"" + name +
                   "\" has no stiffness in shear, expected at least one positive constant of " +
                   names_of(law->constants) + ".");
  return made;
}

}  // namespace tunica::materials
