#pragma once
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tunica/materials/hyperelastic_law.hpp"

namespace tunica::materials {

/// A constant of a law, as XML names it.
struct Constant {
  std::string name;
  double fallback;  ///< not a number where it has to be given
  double low;       ///< smallest admissible value
  std::string unit;
  std::string sentence;
  double high = std::numeric_limits<double>::infinity();  ///< largest admissible value
  bool is_low_excluded = false;
};

using Constants = std::map<std::string, double>;

/// A law, as XML names it. make() receives every constant, checked and completed.
struct LawEntry {
  std::string name;
  std::string sentence;
  std::vector<Constant> constants;
  std::function<std::unique_ptr<HyperelasticLaw>(const Constants&)> make;
  /// κ [kPa] of a law whose constants fix it; empty where it is a key of its own.
  std::function<double(const Constants&)> bulk_modulus = {};
};

/// The constants of a law with those given, the others at their fallback. Throws Error, which names
/// the law, where one is unknown, out of its range or missing.
Constants completed(const std::string& law, const std::vector<Constant>& constants,
                    const Constants& given);

/// Every law there is, in the order of the reference.
const std::vector<LawEntry>& laws();

/// Adds a law, before the schema of a case is asked for. Throws Error where the name is taken.
void register_law(LawEntry law);

/// The law `name` with the given constants, the others at their fallback.
std::unique_ptr<HyperelasticLaw> make_law(const std::string& name, const Constants& constants);

}  // namespace tunica::materials
