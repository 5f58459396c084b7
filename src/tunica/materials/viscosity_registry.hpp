#pragma once
#include "tunica/materials/registry.hpp"
#include "tunica/materials/viscosity_law.hpp"

namespace tunica::materials {

/// A law of a fluid's viscosity, as XML names it. make() receives every constant, checked and
/// completed.
struct ViscosityEntry {
  std::string name;
  std::string sentence;
  std::vector<Constant> constants;
  std::function<std::unique_ptr<ViscosityLaw>(const Constants&)> make;
};

/// Every law there is, in the order of the reference.
const std::vector<ViscosityEntry>& viscosity_laws();

/// Adds a law, before the schema of a case is asked for. Throws Error where the name is taken.
void register_viscosity_law(ViscosityEntry law);

/// The law `name` with the given constants, the others at their fallback.
std::unique_ptr<ViscosityLaw> make_viscosity_law(const std::string& name,
                                                 const Constants& constants);

}  // namespace tunica::materials
