// Validates a case and everything it names, and solves nothing.
//
//   tunica-check xml/pulse.xml
//   tunica-check --reference > xml/PARAMETERS.md
//   tunica-check --reference Fluid/Surfaces

#include <iostream>
#include <sstream>

#include "tunica/app/guard.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/base/session.hpp"
#include "tunica/params/read_xml.hpp"
#include "tunica/params/section.hpp"
#include "tunica/run/domain.hpp"
#include "tunica/run/extent.hpp"
#include "tunica/setup/case.hpp"
#include "tunica/setup/schema.hpp"
#include "tunica/systems/read_system.hpp"

namespace {

using namespace tunica;

/// A case names its fields, and the program it is for, by its lists.
params::Table table_for(const std::string& file, const Comm& comm) {
  std::string fields;
  on_root(comm, [&] {
    const Teuchos::ParameterList list = params::read_xml(file);
    if (list.isSublist("Fluid")) fields += "fluid";
    if (list.isSublist("Wall")) fields += "wall";
    if (list.isSublist("Solvers")) fields = "solvers";
  });
  broadcast(comm, fields);
  if (fields == "fluid") return setup::fluid_table();
  if (fields == "wall") return setup::solid_table();
  if (fields == "solvers") return setup::solvers_table();
  return setup::fsi_table();
}

void print_reference(const std::string& list) {
  const params::Table table = setup::solvers_table();
  if (!list.empty()) {
    std::ostringstream full;
    table.print_markdown(full, "Case");
    std::cout << params::section_of(full.str(), list);
    return;
  }
  std::cout
      << "# Parameters\n\nPrinted by `tunica-check --reference`. `tunica-solvers` reads all lists, "
         "`tunica-fsi` leaves out\nSolvers, `tunica-solid` also Fluid, Mesh Motion and Coupling, "
         "`tunica-fluid` Wall, Mesh Motion and\nCoupling. A table that occurs at several places is "
         "printed once;\n`tunica-check --reference Fluid/Newton` prints it in full anywhere.\n\n";
  const params::Table of_system = setup::system_solvers_table();
  params::print_reference(std::cout, {{"Case", &table}, {"System Case", &of_system}});
}

/// The case completed, or every key there is.
void print_defaults(const setup::CommandLine& command, const Comm& comm) {
  if (command.case_file.empty()) {
    if (comm.getRank() == 0) setup::fsi_table().print_xml(std::cout, "Case");
    return;
  }
  const bool is_foreign = setup::has_list(command.case_file, "System", comm);
  const Teuchos::ParameterList list =
      setup::read_case(
          command, is_foreign ? setup::system_solvers_table() : table_for(command.case_file, comm),
          comm)
          .list;
  if (comm.getRank() == 0) std::cout << params::to_xml(list);
}

int check(const setup::CommandLine& command, const std::string& name) {
  const CommPtr comm = all_ranks();
  const bool is_foreign = setup::has_list(command.case_file, "System", *comm);
  const setup::Case the_case = setup::read_case(
      command, is_foreign ? setup::system_solvers_table() : table_for(command.case_file, *comm),
      *comm);
  if (is_foreign) {
    systems::read_system(the_case.list.sublist("System"), comm);
  } else {
    const run::Domain domain = run::load_domain(the_case, comm);
    run::print_extent(domain.extent, name, *comm);
    run::check_fields(the_case, domain);
    run::print_expectations(the_case, domain);
  }
  if (comm->getRank() == 0)
    std::cout << command.case_file << ": the case and its " << (is_foreign ? "files" : "mesh")
              << " are valid." << std::endl;
  return run::exit_done;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = "tunica-check", sentence = "Validates a case and solves nothing.";
  const Session session;
  const bool is_root = all_ranks()->getRank() == 0;
  return app::guarded(name, *all_ranks(), [&] {
    const setup::CommandLine command = setup::parse(argc, argv, name, sentence);
    if (command.help && is_root) std::cout << setup::usage(name, sentence);
    if (command.reference) on_root(*all_ranks(), [&] { print_reference(command.case_file); });
    if (command.print_defaults) print_defaults(command, *all_ranks());
    if (command.help || command.reference || command.print_defaults) return run::exit_done;
    return check(command, name);
  });
}
