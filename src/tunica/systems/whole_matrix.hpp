#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>

#include "tunica/systems/blocks.hpp"

namespace tunica::systems {

/// The blocks of one matrix K with all unknowns, which the key "K" names, and of the right-hand
/// side of the key "rhs"; without one, of b = K x with x_i = sin(i). order: how the scalars stand,
/// in words. Throws tunica::Error on all ranks. Collective.
Blocks read_whole(const Teuchos::ParameterList& options, const CommPtr& comm,
                  std::size_t lines_at_once, std::string& order);

}  // namespace tunica::systems
