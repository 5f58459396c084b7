#include "tunica/app/results_folder.hpp"

#include <filesystem>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/output/checkpoint_series.hpp"

namespace tunica::app {

namespace {

constexpr const char* case_name = "case.xml";
constexpr const char* used_name = "case-used.xml";

/// Links and relative paths lead to the same file.
bool is_same_file(const std::string& one, const std::string& other) {
  std::error_code failure;
  return std::filesystem::equivalent(one, other, failure) && !failure;
}

/// "steps.csv, run.json", or nothing.
std::string results_in(const std::string& folder) {
  std::string names;
  const auto add = [&names](const std::string& name) {
    names += (names.empty() ? "" : ", ") + name;
  };
  for (const char* name : {"steps.csv", "run.json", "fields.h5"}) {
    std::error_code ignored;
    if (std::filesystem::exists(folder + "/" + name, ignored)) add(name);
  }
  for (const output::NamedCheckpoint& checkpoint : output::checkpoints_in(folder))
    add(std::filesystem::path(checkpoint.path).filename().string());
  return names;
}

}  // namespace

void check_results_folder(const std::string& folder, const CommandLine& command,
                          const std::string& program, const Comm& comm) {
  if (command.restart || command.overwrite) return;
  on_root(comm, [&] {
    const std::string names = results_in(folder);
    const std::string go_on =
        takes(program, "--restart") ? "Go on with --restart, choose" : "Choose";
    TUNICA_CHECK(names.empty(), "\"" + folder + "\" holds results of an earlier run (" + names +
                                    "). " + go_on +
                                    " another --output, or replace them with --overwrite.");
    const std::string case_there = folder + "/" + case_name;
    std::error_code ignored;
    TUNICA_CHECK(!std::filesystem::exists(case_there, ignored) ||
                     name_for_parameters(folder, command.case_file) != case_name,
                 case_there +
                     ": a case that is not that of this run would be replaced by the parameters "
                     "that it uses. Choose another --output, or replace it with --overwrite.");
  });
}

std::string name_for_parameters(const std::string& folder, const std::string& case_file) {
  std::error_code ignored;
  const bool was_input = std::filesystem::exists(folder + "/" + used_name, ignored);
  return was_input || is_same_file(case_file, folder + "/" + case_name) ? used_name : case_name;
}

}  // namespace tunica::app
