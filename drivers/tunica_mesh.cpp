/// tunica-mesh: make, inspect, refine, convert and partition meshes. refine, convert and partition
/// also run with mpirun.
///
///   tunica-mesh tube tube.h5 --around 20 --axial 62
///   tunica-mesh lumen lumen.stl lumen.h5
///   tunica-mesh block block.h5 --patch-x 4 --patch-y 4
///   tunica-mesh slab plane.msh slab.h5 --thickness 2
///   tunica-mesh wall lumen.msh vessel.h5 --surfaces lumen_wall --layers media=0.26:2
///   tunica-mesh adapt results/beat finer.h5 --factor 2
///   tunica-mesh info tube.h5 --interface interface
///   tunica-mesh COMMAND --help
#include <mpi.h>

#include <csignal>
#include <exception>
#include <functional>
#include <iostream>

#include "tunica/base/error.hpp"
#include "tunica/base/session.hpp"
#include "tunica/io/messages.hpp"
#include "tunica/params/nearest.hpp"
#include "tunica_mesh/commands.hpp"
#include "tunica_mesh/python_commands.hpp"

namespace {

/// Before what was at fault.
constexpr const char* fault_of_machine = "tunica-mesh: internal or system error: ";

std::string line(const std::string& name, const std::string& sentence) {
  return "\n  " + name + std::string(11 - name.size(), ' ') + sentence;
}

std::string overview() {
  std::string text = "tunica-mesh COMMAND ...; COMMAND --help says more\n";
  for (const PythonCommand& each : python_commands()) text += line(each.name, each.sentence);
  for (const Subcommand& each : subcommands())
    text += line(each.command.name, each.command.sentence);
  return text + "\n";
}

const Subcommand& find(const std::string& name) {
  std::vector<std::string> names;
  for (const PythonCommand& each : python_commands()) names.push_back(each.name);
  for (const Subcommand& each : subcommands()) {
    if (each.command.name == name) return each;
    names.push_back(each.command.name);
  }
  throw tunica::Error("tunica-mesh: unknown command \"" + name + "\". " +
                      tunica::params::did_you_mean(name, names));
}

/// Errors and faults that ranks agree on are the same on all: one speaks, before the others can
/// end, for mpirun ends all when one has. A rank that fails alone ends the others, which would wait
/// for it.
void on_ranks(const std::function<void(const tunica::CommPtr&)>& work) {
  const tunica::Session session;
  const tunica::CommPtr comm = tunica::all_ranks();
  const bool speaks = comm->getRank() == 0;
  try {
    work(comm);
  } catch (const tunica::Error& error) {
    if (speaks) std::cerr << error.what() << std::endl;
    throw tunica::Error("");  // it has been said
  } catch (const tunica::MachineFault& fault) {
    if (speaks) std::cerr << fault_of_machine << fault.what() << std::endl;
    throw tunica::MachineFault("");
  } catch (const std::exception& fault) {
    if (comm->getSize() == 1) throw;
    std::cerr << "tunica-mesh: rank " << comm->getRank() << " failed: " << fault.what()
              << std::endl;
    MPI_Abort(MPI_COMM_WORLD, 3);
  }
}

void run(const std::vector<std::string>& words) {
  if (words.empty()) throw tunica::Error(overview());
  if (words[0] == "--help" || words[0] == "-h") {  // 1. which command
    std::cout << overview();
    return;
  }
  become_python_command(words);
  const Subcommand& chosen = find(words[0]);
  const Arguments arguments(chosen.command, {words.begin() + 1, words.end()});  // 2. its words
  if (arguments.wants_help())
    std::cout << help(chosen.command);
  else
    on_ranks([&](const tunica::CommPtr& comm) { chosen.run(arguments, comm); });  // 3. do it
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a write that fails
    run({argv + 1, argv + argc});
    const std::string lost = tunica::io::lost_output();
    if (!lost.empty()) std::cerr << "tunica-mesh: " << lost << "\n";
    return lost.empty() ? 0 : 3;
  } catch (const tunica::Error& error) {
    if (*error.what() != '\0') std::cerr << error.what() << "\n";  // else it has been said
    return 1;
  } catch (const std::exception& error) {
    if (*error.what() != '\0') std::cerr << fault_of_machine << error.what() << "\n";
    return 3;
  }
}
