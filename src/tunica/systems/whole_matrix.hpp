#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>

#include "tunica/systems/blocks.hpp"
#include "tunica/systems/matrix_files.hpp"

namespace tunica::systems {

/// The blocks of one matrix K with all unknowns. order: how the scalars stand, in words. Throws
/// tunica::Error on all ranks. Collective.
Blocks split_whole(const MatrixRows& K, const Teuchos::ParameterList& options, std::string& order);

/// Of the matrix that the key "K" names; b: the right-hand side of the key "rhs", without one
/// b = K x with x_i = sin(i). Throws tunica::Error on all ranks. Collective.
Blocks read_whole(const Teuchos::ParameterList& options, const CommPtr& comm,
                  std::size_t lines_at_once, std::string& order, ColumnRows& b);

}  // namespace tunica::systems
