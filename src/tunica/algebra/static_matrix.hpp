#pragma once
#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// Local rows of a graph: the entries of row r begin at row_start(r).
using RowStart = CrsMatrix::local_graph_device_type::row_map_type::non_const_type;
using LocalColumns = CrsMatrix::local_graph_device_type::entries_type::non_const_type;

/// A graph with these local columns, which ascend in each row. with_ghosts: what the local columns
/// number; its range are the rows. Collective.
Teuchos::RCP<CrsGraph> static_graph(const Teuchos::RCP<const Map>& rows,
                                    const Teuchos::RCP<const Map>& with_ghosts,
                                    const RowStart& row_start, const LocalColumns& columns,
                                    const Teuchos::RCP<const Map>& domain);

/// A matrix with the entries of a graph, all of this value, and ready for products. Collective.
Teuchos::RCP<CrsMatrix> matrix_on(const Teuchos::RCP<const CrsGraph>& graph, Scalar value = 0.0);

}  // namespace tunica::algebra
