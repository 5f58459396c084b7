#pragma once
#include <Ifpack2_Preconditioner.hpp>
#include <MueLu_SmootherPrototype.hpp>

#include "tunica/multigrid/muelu/blocked_matrix.hpp"

namespace tunica::multigrid {

/// MueLu's smoother "SCHWARZ" of Ifpack2 with the "partitioner: type" "user": one patch per
/// pressure and its neighbours, much as Vanka's, and one for all rows that are coupled to no
/// others. In MueLu's place, because MueLu takes the pressures for the last rows of each rank,
/// hands over vectors of blocks on all but the finest level, which Ifpack2 cannot take, and makes
/// patches of a single row, for which Ifpack2 writes outside of its vectors.
class PressureSchwarzSmoother
    : public MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node> {
public:
  /// schwarz: the list for Ifpack2. Throws std::invalid_argument for patches without neighbours.
  PressureSchwarzSmoother(const Teuchos::ParameterList& schwarz, int overlap);

  void DeclareInput(MueLu::Level& level) const override;
  void Setup(MueLu::Level& level) override;
  void Apply(XMultiVector& x, const XMultiVector& b, bool is_zero) const override;
  Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>> Copy()
      const override;
  std::size_t getNodeSmootherComplexity() const override;

private:
  Teuchos::ParameterList schwarz_;
  int overlap_;
  Teuchos::RCP<const ::tunica::CrsMatrix> rows_;  ///< block after block
  Teuchos::RCP<const Xpetra::MapExtractor<Scalar, LocalOrdinal, GlobalOrdinal, Node>> extractor_;
  Teuchos::RCP<Ifpack2::Preconditioner<Scalar, LocalOrdinal, GlobalOrdinal, Node>> smoother_;
};

}  // namespace tunica::multigrid
