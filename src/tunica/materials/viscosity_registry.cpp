#include "tunica/materials/viscosity_registry.hpp"

#include <stdexcept>

#include "tunica/materials/carreau_yasuda.hpp"
#include "tunica/materials/newtonian.hpp"

namespace tunica::materials {

const std::vector<ViscosityEntry>& viscosity_laws() {
  static const std::vector<ViscosityEntry> all = {
      newtonian(),
      carreau_yasuda(),
  };
  return all;
}

std::unique_ptr<ViscosityLaw> make_viscosity_law(const std::string& name,
                                                 const Constants& constants) {
  for (const ViscosityEntry& law : viscosity_laws())
    if (law.name == name) return law.make(constants);
  throw std::logic_error("\"" + name + "\" is no law of viscosity");
}

}  // namespace tunica::materials
