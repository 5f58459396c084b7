#pragma once
#include <optional>
#include <string>
#include <vector>

namespace tunica::setup {

/// Command line of the drivers: tunica-fsi CASE.xml --output DIR --set "Fluid/density=1.06"
struct CommandLine {
  std::string program{};           ///< the driver's name
  std::string case_file;           ///< tunica-solvers: or a matrix
  std::string right_side{};        ///< tunica-solvers with a matrix only; "" if not given
  std::string settings{};          ///< tunica-solvers with a matrix only: a case with others; ""
  std::string output;              ///< folder of the results; "" if not given
  std::optional<int> steps;        ///< stop after so many time steps
  bool dry_run = false;            ///< everything but the solve
  bool restart = false;            ///< go on from the newest checkpoint of the folder
  bool allow_changes = false;      ///< the restart may change what is solved
  bool overwrite = false;          ///< replace the results of an earlier run
  bool print_defaults = false;     ///< a complete XML; without a case file that of any, commented
  bool help = false;               ///< no case file needed
  bool reference = false;          ///< tunica-check only; the case file, if any, names a list of it
  std::string export_folder;       ///< tunica-solvers only; "" if not given
  std::vector<std::string> set{};  ///< assignments in their order, see params::set_from_text
};

/// Reads the command line. Throws tunica::Error if an option is unknown or incomplete, or if
/// the case file is missing. program: name of the driver; sentence: what it does.
CommandLine parse(int argc, char** argv, const std::string& program, const std::string& sentence);

/// True for a matrix in the place of a case file: K.mtx.
bool is_matrix_file(const std::string& name);

/// True where the program has this option.
bool takes(const std::string& program, const std::string& option);

/// The text of --help.
std::string usage(const std::string& program, const std::string& sentence);

}  // namespace tunica::setup
