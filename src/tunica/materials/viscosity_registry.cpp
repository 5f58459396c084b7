#include "tunica/materials/viscosity_registry.hpp"

#include <stdexcept>

#include "tunica/base/error.hpp"
#include "tunica/materials/carreau_yasuda.hpp"
#include "tunica/materials/newtonian.hpp"

namespace tunica::materials {

namespace {

std::vector<ViscosityEntry>& known_viscosity_laws() {
  static std::vector<ViscosityEntry> all = {
      newtonian(),
      carreau_yasuda(),
  };
  return all;
}

}  // namespace

const std::vector<ViscosityEntry>& viscosity_laws() { return known_viscosity_laws(); }

void register_viscosity_law(ViscosityEntry law) {
  for (const ViscosityEntry& known : viscosity_laws())
    TUNICA_CHECK(known.name != law.name,
                 "Law of viscosity \"" + law.name + "\" is registered twice.");
  known_viscosity_laws().push_back(std::move(law));
}

std::unique_ptr<ViscosityLaw> make_viscosity_law(const std::string& name,
                                                 const Constants& constants) {
  for (const ViscosityEntry& law : viscosity_laws())
    if (law.name == name)
      return law.make(completed("Law of viscosity \"" + name + "\"", law.constants, constants));
  throw std::logic_error("\"" + name + "\" is no law of viscosity");
}

}  // namespace tunica::materials
