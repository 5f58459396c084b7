#pragma once
#include "tunica/base/trilinos.hpp"
#include "tunica/systems/read_system.hpp"

namespace tunica::systems {

/// Makes R b' of the system of a right-hand side b, with its rows in the order of the files on any
/// ranks, and finds its known values, round by round:
///
///   x_i = (b_i − Σ_j K_ij x_j) / K_ii   j known before i
///   b'  = b − K x_k                     in the rows of free unknowns
///
/// Returns what is doubtful, on all ranks. Throws Error on all ranks where an equation without
/// unknowns is not fulfilled. Collective.
std::vector<std::string> take_right_side(System& system, const Vector& b);

/// Which columns of a block are known, and their factors. Collective.
struct OfColumns {
  OfColumns(const System& system, int field, const CrsMatrix& A)
      : known_in(A.getColMap()), scale(A.getColMap()) {
    const Import to_columns(A.getDomainMap(), A.getColMap());
    known_in.doImport(system.known_in[field], to_columns, insert);
    scale.doImport(system.scale[field], to_columns, insert);
  }
  Vector known_in, scale;
};

/// The numbers that these unknowns have in x, each on one rank, on all ranks. Collective.
std::vector<double> values_at(const std::vector<GlobalOrdinal>& unknowns, const Vector& x);

/// x ← R x in the rows of free unknowns, 0 in the others.
void take_to_rows(const System& system, algebra::BlockVector& x);

/// C y of free unknowns, 0 of the others: what a method leaves in rows that hold nothing but their
/// diagonal is no part of x.
algebra::BlockVector of_free(const System& system, const algebra::BlockVector& y);

}  // namespace tunica::systems
