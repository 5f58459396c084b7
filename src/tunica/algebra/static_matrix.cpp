#include "tunica/algebra/static_matrix.hpp"

namespace tunica::algebra {

Teuchos::RCP<CrsMatrix> static_matrix(const Teuchos::RCP<const Map>& rows,
                                      const Teuchos::RCP<const Map>& with_ghosts,
                                      const RowStart& row_start, const LocalColumns& columns,
                                      const Teuchos::RCP<const Map>& domain) {
  using Values = CrsMatrix::local_matrix_device_type::values_type::non_const_type;
  const auto matrix = Teuchos::rcp(
      new CrsMatrix(rows, with_ghosts, row_start, columns, Values("values", columns.extent(0))));
  matrix->expertStaticFillComplete(domain, rows);
  return matrix;
}

}  // namespace tunica::algebra
