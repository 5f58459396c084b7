#pragma once
#include "tunica/algebra/embedding.hpp"
#include "tunica/fields/block_operator.hpp"

namespace tunica::fields {

/// The unknowns of a field in those of a mesh of several fields, by their elements. Both operators
/// outlive what is returned.
algebra::Embedding embed(const BlockOperator& part, const BlockOperator& whole);

}  // namespace tunica::fields
