#include "tunica/linear/ilu.hpp"

#include <Ifpack2_Factory.hpp>

namespace tunica::linear {

struct IluPreconditioner::Factors {
  Teuchos::RCP<Ifpack2::Preconditioner<Scalar, LocalOrdinal, GlobalOrdinal, Node>> ifpack2;
  bool has_overlap = false;
};

IluPreconditioner::IluPreconditioner(const Teuchos::RCP<const CrsMatrix>& matrix, int fill_level,
                                     int overlap)
    : factors_(Teuchos::rcp(new Factors)) {
  factors_->has_overlap = overlap > 0;
  const Teuchos::RCP<const RowMatrix> rows = matrix;
  factors_->ifpack2 = Ifpack2::Factory::create<RowMatrix>("SCHWARZ", rows);
  Teuchos::ParameterList list;
  list.set("schwarz: inner preconditioner name", "RILUK");
  list.set("schwarz: overlap level", overlap);
  list.set("schwarz: combine mode", "ZERO");  // restricted: each rank gives its own rows
  list.sublist("schwarz: inner preconditioner parameters")
      .set("fact: iluk level-of-fill", fill_level);
  factors_->ifpack2->setParameters(list);
  factors_->ifpack2->initialize();
}

IluPreconditioner::~IluPreconditioner() = default;

void IluPreconditioner::refresh() {
  // Ifpack2 fetches the values of overlapping rows in initialize() only.
  if (factors_->has_overlap) factors_->ifpack2->initialize();
  factors_->ifpack2->compute();
}

Teuchos::RCP<Operator> IluPreconditioner::as_operator() const { return factors_->ifpack2; }

}  // namespace tunica::linear
