#pragma once
#include <map>
#include <memory>
#include <optional>

#include "tunica/compare/solver_settings.hpp"
#include "tunica/io/csv_table.hpp"
#include "tunica/output/run_folder.hpp"
#include "tunica/output/run_record.hpp"

namespace tunica::compare {

/// Adds the settings of both fields and the tolerance.
void add_setting_keys(params::Table& table);

/// The most accurate solution that a list of settings found for a system.
struct BestSolution {
  std::string setting;
  double true_residual;
  algebra::BlockVector x;
  bool is_converged;            ///< to the tolerance
  Teuchos::ParameterList list;  ///< of the setting
};

/// Which setting found it, and how near it is: for the head of a file.
std::string note_on(const BestSolution& solution);

/// Every setting on every system, in one table: on the screen, in "solvers.csv" row by row, and
/// in "solvers.json" system by system.
///
/// The column "difference" compares each converged solution with the first converged one of its
/// system, so that a setting which solves another system than the others shows.
class SolverTable {
public:
  /// list: the resolved case. A field without settings gets that of its own "Linear Solver"
  /// list, named "case"; those of a system of another program are chosen by its matrix. The record
  /// must outlive the table.
  SolverTable(const Teuchos::ParameterList& list, const output::RunFolder& folder,
              const output::RunRecord& record, bool is_root);

  /// Adds a row for each setting of the system's field, and says so on the screen. Nothing where no
  /// setting gave a solution. Collective.
  std::optional<BestSolution> run(const LinearSystem& system);
  /// Whether the settings are not those of the case, but chosen.
  bool is_chosen() const { return is_chosen_; }

  /// One block for each field. Rank 0 only prints.
  void print() const;

private:
  std::vector<SolverSetting> settings_for(const LinearSystem& system) const;
  void add(const SolverRow& row);
  void save() const;

  std::map<std::string, std::vector<SolverSetting>> settings_;  ///< by field
  double tolerance_;
  bool is_chosen_;  ///< settings by the matrix, of which one has to converge
  double direct_operations_;
  std::map<std::string, int> place_;  ///< of the systems in the run
  bool is_root_;
  const output::RunRecord* record_;
  std::string json_file_;
  io::CsvTable csv_;
  std::vector<SolverRow> rows_;
};

/// The table of one field as text: a line for each setting, with the iterations of each Newton
/// step ("!" where it did not converge, with the verdict below), total seconds, and their ratio
/// to those of the first setting.
std::string text_of(const std::vector<SolverRow>& all, const std::string& field);

}  // namespace tunica::compare
