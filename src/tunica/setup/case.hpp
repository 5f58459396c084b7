#pragma once
#include <Teuchos_ParameterList.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tunica/base/types.hpp"
#include "tunica/coupling/coupling_settings.hpp"
#include "tunica/params/table.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/mesh_motion_settings.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/setup/command_line.hpp"
#include "tunica/setup/run_settings.hpp"

namespace tunica::setup {

/// A resolved case, decoded once.
struct Case {
  /// resolved: see params::Table::resolve().
  Case(const Teuchos::ParameterList& resolved);  // NOLINT: a list is a case that is not decoded yet

  bool is_coupled() const { return fluid && wall; }

  Teuchos::ParameterList list;
  std::optional<problems::FluidSettings> fluid;
  std::optional<problems::SolidSettings> wall;
  std::optional<problems::MeshMotionSettings> motion;
  std::optional<coupling::CouplingSettings> coupling;
  std::optional<MeshSettings> mesh;  ///< none for a system of another program
  std::optional<TimeSettings> time;  ///< of a case with time steps
  OutputSettings output;
  std::vector<double> kinks;  ///< of the loads, where steps end there [ms]
};

/// Reads and validates the whole case, with the assignments of the command line, before
/// anything else is opened. Every parameter of its list is resolved. Rank 0 reads; where
/// that fails all ranks throw the same Error, which names the file. Collective.
Case read_case(const CommandLine& command, const params::Table& table, const Comm& comm);

/// True where the XML file has such a list at the top. Throws as read_case() does. Collective.
bool has_list(const std::string& file, const std::string& name, const Comm& comm);

}  // namespace tunica::setup
