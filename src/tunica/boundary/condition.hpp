#pragma once
#include <functional>
#include <string>

#include "tunica/boundary/boundary_term.hpp"
#include "tunica/params/table.hpp"

namespace tunica::boundary {

enum class Field { fluid, wall };

/// The condition that couples them; each has its own.
constexpr const char* interface_condition = "interface";

/// A condition that the list of a surface can name: its keys, and the terms it is made of.
struct ConditionEntry {
  using Make = std::function<Terms(const Teuchos::ParameterList& list,
                                   const fields::FieldMesh& mesh, int surface)>;

  Field field;
  std::string name;
  params::Table table;
  Make make;  ///< the terms in the order in which they are added. Collective.
};

/// One term, or several.
template <class... Term>
Terms terms(std::unique_ptr<Term>... each) {
  Terms all;
  (all.push_back(std::move(each)), ...);
  return all;
}

}  // namespace tunica::boundary
