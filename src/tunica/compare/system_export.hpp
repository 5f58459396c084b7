#pragma once
#include "tunica/compare/linear_system.hpp"
#include "tunica/compare/solver_table.hpp"

namespace tunica::compare {

/// Adds the key of the folder.
void add_export_keys(params::Table& table);

/// Writes systems for other programs, each into a folder of its own:
///
///   A, B1T, B2, C .mtx   the blocks of K = [A B1ᵀ; B2 −C]
///   W, V .mtx            where K has W Vᵀ beside its blocks: a column for each product
///   rhs.mtx              b, vector unknowns before scalar ones
///   solution.mtx         x, likewise; the best one found
///   coordinates.mtx      of the nodes in the undeformed mesh [mm]
///   nullspace.mtx        rigid motions of the nodes, six columns: the near-null space of A
///   state.json           where the system comes from, order of unknowns, units
class SystemExport {
public:
  /// folder: "" writes nothing. Throws Error on all ranks where it cannot be written. The record
  /// must outlive the object. Collective.
  SystemExport(const std::string& folder, const output::RunRecord& record, const CommPtr& comm);

  /// All but the solution, so that a system on which a solver dies is on the disk. Collective.
  void write(const LinearSystem& system) const;
  /// Takes the solution of an earlier run away where there is none now. Collective.
  void write(const LinearSystem& system, const std::optional<BestSolution>& solution) const;

private:
  /// Takes that of an earlier run away where there is none now. Collective.
  void write_low_rank(const LinearSystem& system) const;
  std::string path(const LinearSystem& system, const std::string& file) const;

  std::string folder_;
  const output::RunRecord* record_;
  CommPtr comm_;
};

}  // namespace tunica::compare
