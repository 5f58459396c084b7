#pragma once
#include "tunica/algebra/block_matrix.hpp"

namespace tunica::foreign {

/// What sparse LU of K takes, estimated by graphs of nodes, which have fewer rows and entries than
/// K. All are operations per entry of K:
///
///   b³ N / nnz(K)    N operations of the graph, b unknowns at a node on average
///
/// Counted no further than `enough`. Collective.

/// By the nodes of vectors. 0 where they are not known. Of equal order 0.14 to 1.7 times the true
/// count in the arena. Of Taylor and Hood's elements less than half, since symmetry leaves A half
/// of the neighbours.
double operations_by_vectors(const algebra::BlockMatrix& K, double enough);

/// By the nodes of vectors and scalars, these apart. Half to twice the true count, up to nine times
/// where the order of the graph is much worse than that of K.
double operations_by_all_nodes(const algebra::BlockMatrix& K, double enough);

/// Whether it takes more than so many. by_vectors: what operations_by_vectors() says.
bool is_factoring_dear(const algebra::BlockMatrix& K, double by_vectors, double most);

}  // namespace tunica::foreign
