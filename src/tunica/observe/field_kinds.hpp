#pragma once
#include <Teuchos_ParameterList.hpp>

#include "tunica/observe/field.hpp"
#include "tunica/params/table.hpp"

namespace tunica::problems {
class FluidProblem;
class MeshMotion;
class SolidProblem;
}  // namespace tunica::problems

namespace tunica::observe {

/// Input of a field: the fields that are solved before it, and the case.
struct FieldContext {
  const Teuchos::ParameterList& the_case;  ///< resolved
  problems::FluidProblem* fluid;           ///< null where the case has none
  problems::SolidProblem* wall;
  problems::MeshMotion* motion;  ///< of the fluid's mesh; null where it stands still
};

/// A kind of field beside fluid and wall. A case names its fields in the list "Fields": each entry
/// is a field of that name, its "kind" one of these, with the keys of its table.
struct FieldKind {
  std::string name;                  ///< of "kind"
  std::string region;                ///< "fluid" or "wall": on whose mesh it lives
  params::Table table;               ///< its keys
  std::vector<Quantity> quantities;  ///< what probes may ask of it, with "field" = its name
  /// list: the resolved entry. The mesh outlives the field.
  std::function<std::unique_ptr<Field>(const std::string& name, const Teuchos::ParameterList& list,
                                       const fields::FieldMesh& mesh, const FieldContext& others)>
      make;

  /// True where the case has that region.
  bool lives_in(bool has_fluid, bool has_wall) const {
    return region == "fluid" ? has_fluid : has_wall;
  }
};

/// Adds a kind; before the schema of a case is asked for. The library itself has none so far.
void register_field_kind(FieldKind kind);
const std::vector<FieldKind>& field_kinds();
/// The kind of a resolved entry of "Fields".
const FieldKind& kind_of(const Teuchos::ParameterList& entry);

/// Adds the list "Fields" where there are kinds that live on the regions of the case.
void add_field_entries(bool has_fluid, bool has_wall, params::Table& table);

}  // namespace tunica::observe
