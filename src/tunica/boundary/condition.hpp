#pragma once
#include <functional>
#include <optional>
#include <string>

#include "tunica/boundary/boundary_term.hpp"
#include "tunica/params/table.hpp"

namespace tunica::boundary {

enum class Field { fluid, wall };

/// The condition that couples them; each has its own.
constexpr const char* interface_condition = "interface";

/// The quantity by which a condition drives the vessel, as far as its list says; cases are judged
/// by it before they run.
struct Drive {
  enum class Kind {
    none,
    pressure,  ///< on the surface [kPa]
    traction,  ///< its length [kPa]
    flow,      ///< into the fluid [mm³/ms]
    velocity,  ///< length of its mean over the surface [mm/ms]
    motion,    ///< a displacement or a force, in their units
    file       ///< a file has it
  };
  Kind kind = Kind::none;
  double size = 0.0;  ///< times the amplitude
  /// An outlet: under a mean flow Q̄ its pressure settles at p_d + R Q̄.
  struct Outlet {
    double resistance;       ///< R [kPa ms/mm³]
    double distal_pressure;  ///< p_d [kPa]
    double mean_flow;        ///< Q̄ that the list expects [mm³/ms]; 0: it does not say
    double time_constant;    ///< of what it stores [ms]; 0: nothing
  };
  std::optional<Outlet> outlet{};
};

/// A condition that the list of a surface can name: its keys, the terms it is made of, and what it
/// drives the vessel by.
struct ConditionEntry {
  using Make = std::function<Terms(const Teuchos::ParameterList& list,
                                   const fields::FieldMesh& mesh, int surface)>;

  Field field;
  std::string name;
  params::Table table;
  Make make;  ///< the terms in the order in which they are added. Collective.
  std::function<Drive(const Teuchos::ParameterList& list)> drive;
};
inline Drive drives_nothing(const Teuchos::ParameterList&) { return {}; }

/// Length of the vector of a key.
double length_of(const Teuchos::ParameterList& list, const std::string& key);

/// One term, or several.
template <class... Term>
Terms terms(std::unique_ptr<Term>... each) {
  Terms all;
  (all.push_back(std::move(each)), ...);
  return all;
}

}  // namespace tunica::boundary
