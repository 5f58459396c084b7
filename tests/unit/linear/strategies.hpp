#pragma once
#include <map>

#include "tunica/base/trilinos.hpp"
#include "tunica/linear/block_preconditioner.hpp"
#include "tunica/linear/linear_solver.hpp"
#include "unit/algebra/distance.hpp"
#include "unit/fields/small_tube.hpp"

namespace tunica::test {

/// The "Inverse Factory Library" of a Stratimikos list.
inline Teuchos::ParameterList& library_of(Teuchos::ParameterList& stratimikos) {
  return stratimikos.sublist("Preconditioner Types")
      .sublist("Teko")
      .sublist("Inverse Factory Library");
}

/// A Stratimikos list whose preconditioner is the member of the library with this name.
inline Teuchos::ParameterList teko_list(const std::string& name) {
  Teuchos::ParameterList list;
  list.set("Preconditioner Type", "Teko");
  list.sublist("Preconditioner Types").sublist("Teko").set("Inverse Type", name);
  return list;
}

/// One of our strategies with complete factors for A and S.
inline Teuchos::ParameterList strategy(const std::string& type, const std::string& schur) {
  Teuchos::ParameterList list = teko_list("LU");
  library_of(list)
      .sublist("LU")
      .set("Type", type)
      .set("Inverse Velocity Type", "Amesos2")
      .set("Schur Complement", schur)
      .set("Inverse Schur Type", "Amesos2");
  return list;
}

inline Teuchos::ParameterList solver_list(const std::string& method,
                                          const Teuchos::ParameterList& stratimikos) {
  Teuchos::ParameterList list;
  list.set("method", method).set("preconditioner", "block");
  list.sublist("Stratimikos") = stratimikos;
  linear::linear_solver_table().resolve(list, "Linear Solver", "");
  return list;
}

inline algebra::BlockVector apply(const linear::BlockPreconditioner& P,
                                  const fields::FieldMesh& mesh, const algebra::BlockVector& r) {
  const algebra::Concatenation blocks(r.space());
  MultiVector all_r(blocks.map(), 1), all_z(blocks.map(), 1);
  blocks.gather(r, all_r);
  P.apply(all_r, all_z);
  algebra::BlockVector z = fields::zero_vector(mesh);
  blocks.scatter(all_z, z);
  return z;
}

/// Operators of unit size: a diagonal of the given value.
class Diagonals final : public linear::NamedOperators {
public:
  Diagonals(const fields::BlockOperator& K, std::map<std::string, double> values)
      : K_(&K), values_(std::move(values)) {}
  std::vector<std::string> operator_names() const override {
    std::vector<std::string> names;
    for (const auto& [name, value] : values_) names.push_back(name);
    return names;
  }
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string& name) const override {
    const auto D = Teuchos::rcp(new CrsMatrix(*(*K_)(1, 1), Teuchos::Copy));
    D->resumeFill();
    D->setAllToScalar(0.0);
    for (std::size_t i = 0; i < n_local_rows(*D); ++i) {
      const GlobalOrdinal g = D->getRowMap()->getGlobalElement(static_cast<LocalOrdinal>(i));
      D->replaceGlobalValues(g, Teuchos::tuple<GlobalOrdinal>(g),
                             Teuchos::tuple<Scalar>(values_.at(name)));
    }
    D->fillComplete((*K_)(1, 1)->getDomainMap(), (*K_)(1, 1)->getRangeMap());
    return D;
  }

private:
  const fields::BlockOperator* K_;
  std::map<std::string, double> values_;
};

}  // namespace tunica::test
