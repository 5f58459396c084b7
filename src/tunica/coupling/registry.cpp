#include "tunica/coupling/registry.hpp"

#include <stdexcept>

#include "tunica/coupling/dirichlet_neumann.hpp"
#include "tunica/coupling/monolithic.hpp"

namespace tunica::coupling {

namespace {

/// A scheme, as XML names it.
struct Entry {
  std::string name;
  bool is_monolithic;
  params::Table (*table)();
  std::unique_ptr<Scheme> (*make)(const Teuchos::ParameterList&, const CoupledFields&);
};

std::unique_ptr<Scheme> make_dirichlet_neumann(const Teuchos::ParameterList& list,
                                               const CoupledFields& f) {
  return std::make_unique<DirichletNeumann>(list, f.interface, f.fluid, f.wall, f.motion);
}

std::unique_ptr<Scheme> make_monolithic(const Teuchos::ParameterList& list,
                                        const CoupledFields& f) {
  return std::make_unique<Monolithic>(
      list, problems::CoupledProblem::Parts{*f.mesh, f.interface, f.fluid, f.wall, f.motion});
}

/// Every scheme there is, in the order of the reference.
const std::vector<Entry>& schemes() {
  static const std::vector<Entry> all = {
      {DirichletNeumann::scheme_name, false, dirichlet_neumann_table, make_dirichlet_neumann},
      {Monolithic::scheme_name, true, monolithic_table, make_monolithic},
  };
  return all;
}

const Entry& scheme_of(const std::string& name) {
  for (const Entry& entry : schemes())
    if (entry.name == name) return entry;
  throw std::logic_error("\"" + name + "\" is no coupling scheme");
}

}  // namespace

params::Table coupling_table() {
  std::vector<params::Table::Case> cases;
  for (const Entry& entry : schemes()) cases.push_back({entry.name, entry.table()});
  params::Table table("How fluid and wall are coupled.");
  table.variant("scheme", "monolithic", cases,
                "the fields in turn until they agree, or one system for both, which is faster and "
                "more robust; monolithic coupling does not use the lists \"Newton\" and \"Linear "
                "Solver\" of fluid and wall");
  return table;
}

CouplingSettings::CouplingSettings(const Teuchos::ParameterList& of_case)
    : scheme(of_case.get<std::string>("scheme")), is_monolithic(scheme_of(scheme).is_monolithic),
      most_iterations(is_monolithic ? 0 : of_case.get<int>("max iterations")),
      most_newton(is_monolithic ? of_case.sublist("Newton").get<int>("max iterations") : 0),
      list(of_case) {}

std::unique_ptr<Scheme> make_scheme(const CouplingSettings& settings, const CoupledFields& fields) {
  return scheme_of(settings.scheme).make(settings.list, fields);
}

}  // namespace tunica::coupling
