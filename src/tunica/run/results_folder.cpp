#include "tunica/run/results_folder.hpp"

#include <algorithm>
#include <filesystem>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/output/checkpoint_series.hpp"

namespace tunica::run {

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

/// A run has written it; its own input it never writes.
bool is_result(const std::vector<output::Leg>& history, const std::string& name) {
  return std::any_of(history.begin(), history.end(),
                     [&](const output::Leg& leg) { return leg.parameters == name; });
}

/// May take the parameters of a run: nobody would miss what is there.
bool is_free(const std::string& folder, const std::string& name, const std::string& case_file) {
  std::error_code ignored;
  const std::string path = folder + "/" + name;
  if (!std::filesystem::exists(path, ignored)) return true;
  return is_result(history_of(folder), name) && !is_same_file(case_file, path);
}

}  // namespace

void check_results_folder(const std::string& folder, const setup::CommandLine& command,
                          const std::string& program, const Comm& comm) {
  if (command.restart) return;
  on_root(comm, [&] {
    const std::string names = results_in(folder);
    const bool can_go_on =
        setup::takes(program, "--restart") && (!output::checkpoints_in(folder).empty() ||
                                               std::filesystem::exists(folder + "/prestress.h5"));
    const std::string go_on = can_go_on ? "Continue with --restart, choose" : "Choose";
    TUNICA_CHECK(command.overwrite || names.empty(),
                 "\"" + folder + "\" holds results of an earlier run (" + names + "). " + go_on +
                     " another --output, or replace them with --overwrite.");
    const std::string case_there = folder + "/" + case_name;
    TUNICA_CHECK(is_free(folder, case_name, command.case_file) ||
                     is_same_file(command.case_file, case_there) ||
                     is_result(history_of(folder), used_name),
                 case_there +
                     ": another case has the file name under which this run stores its parameters. "
                     "Choose another --output.");
    TUNICA_CHECK(!name_for_parameters(folder, command.case_file).empty(),
                 folder + ": " + case_name + " and " + used_name +
                     " are cases that were not written by a run. Choose another --output.");
  });
}

void lock_results_folder(io::FolderLock& lock, const std::string& folder, const Comm& comm) {
  on_root(comm, [&] {
    const Outcome taken = lock.take(folder);
    TUNICA_CHECK(taken.is_success(), taken.reason());
  });
}

std::vector<output::Leg> history_of(const std::string& folder) {
  std::error_code ignored;
  const std::string record = folder + "/run.json";
  std::vector<output::Leg> history = output::read_history(record);
  if (!history.empty() || !std::filesystem::exists(record, ignored)) return history;
  const bool was_input = std::filesystem::exists(folder + "/" + used_name, ignored);
  return {{0, "", 1, was_input ? used_name : case_name}};
}

std::string name_for_parameters(const std::string& folder, const std::string& case_file) {
  for (const char* name : {case_name, used_name})
    if (is_free(folder, name, case_file)) return name;
  return "";
}

std::string name_for_changed(const std::string& folder, const std::string& first) {
  const std::string stem = std::filesystem::path(first).stem().string();
  std::string name = stem + "-2.xml";
  for (int n = 3; std::filesystem::exists(folder + "/" + name); ++n)
    name = stem + "-" + std::to_string(n) + ".xml";
  return name;
}

void remove_parameters(const std::string& folder, const std::vector<output::Leg>& history,
                       const std::string& case_file) {
  for (const output::Leg& leg : history) {
    const std::string path = folder + "/" + leg.parameters;
    std::error_code ignored;
    if (leg.parameters != history.front().parameters && !is_same_file(path, case_file))
      std::filesystem::remove(path, ignored);
  }
}

}  // namespace tunica::run
