#include "tunica/output/run_record.hpp"

#include <Trilinos_version.h>
#include <hdf5.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/memory.hpp"
#include "tunica/io/atomic_file.hpp"

namespace tunica::output {

namespace {

using Json = nlohmann::ordered_json;

std::string now() {
  const std::time_t seconds = std::time(nullptr);
  std::array<char, 32> date;
  std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&seconds));
  return date.data();
}

std::string mpi_version() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text;
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  return std::string(text.data()).substr(0, std::string(text.data()).find_first_of(",\n"));
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release);
}

const char* name_of(RunStatus status) {
  switch (status) {
    case RunStatus::running:
      return "running";
    case RunStatus::done:
      return "done";
    case RunStatus::stopped:
      return "stopped";
    case RunStatus::not_converged:
      return "not converged";
    case RunStatus::failed:
      return "failed";
  }
  return "failed";
}

std::string text_in(const Json& object, const char* name, const std::string& otherwise) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

int number_in(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_number_integer() ? found->get<int>() : 0;
}

Leg leg_in(const Json& entry) {
  Leg leg{number_in(entry, "after step"), text_in(entry, "at", ""), number_in(entry, "ranks"),
          text_in(entry, "parameters", "")};
  const auto changes = entry.find("changes");
  if (changes != entry.end() && changes->is_array())
    for (const Json& change : *changes)
      if (change.is_object())
        leg.changes.push_back({text_in(change, "key", ""), text_in(change, "before", ""),
                               text_in(change, "now", "")});
  return leg;
}

Json as_json(const Leg& leg) {
  Json entry{{"after step", leg.after_step},
             {"at", leg.at},
             {"ranks", leg.ranks},
             {"parameters", leg.parameters}};
  for (const Leg::Change& change : leg.changes)
    entry["changes"].push_back(
        {{"key", change.key}, {"before", change.before}, {"now", change.now}});
  return entry;
}

/// The entry of that name, appended if new.
template <class Value>
Value& entry_of(std::vector<std::pair<std::string, Value>>& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const auto& entry) { return entry.first == name; });
  return found != list.end() ? found->second : list.emplace_back(name, Value()).second;
}

}  // namespace

std::vector<Leg> read_history(const std::string& path) {
  const Json record = Json::parse(std::ifstream(path), nullptr, false);
  std::vector<Leg> history;
  if (!record.is_object() || !record.contains("history") || !record["history"].is_array())
    return history;
  for (const Json& entry : record["history"])
    if (entry.is_object() && !text_in(entry, "parameters", "").empty())
      history.push_back(leg_in(entry));
  return history;
}

const Leg& leg_of_step(const std::vector<Leg>& history, int step) {
  const Leg* found = &history.front();
  for (const Leg& leg : history)
    if (leg.after_step < step) found = &leg;
  return *found;
}

RunRecord::RunRecord(const std::string& path, const std::string& program,
                     const std::string& version, const CommPtr& comm)
    : path_(path), program_(program), started_(now()), comm_(comm) {
  set("versions", "tunica", version);
  set("versions", "Trilinos", TRILINOS_VERSION_STRING);
  set("versions", "MPI", mpi_version());
  set("versions", "HDF5", hdf5_version());
  set("versions", "compiler", __VERSION__);
}

RunRecord::~RunRecord() {
  if (status_ != RunStatus::running || comm_->getRank() != 0) return;
  status_ = RunStatus::failed;
  ended_ = now();
  try {
    static_cast<void>(io::replace_file(path_, text()));  // on the way out of another failure
  } catch (const std::exception&) {
  }
}

void RunRecord::set(const std::string& section, const std::string& key, Value value) {
  for (const char* name :
       {"program", "status", "message", "started", "ended", "ranks", "memory", "history"}) {
    if (section == name) throw std::logic_error("run record: \"" + section + "\" is no section");
  }
  entry_of(entry_of(sections_, section), key) = std::move(value);
}

void RunRecord::add_time(const std::string& name, double seconds) {
  Value& total = entry_of(entry_of(sections_, "timings"), name);
  const double* before = std::get_if<double>(&total);
  total = (before != nullptr ? *before : 0.0) + seconds;
}

void RunRecord::take_over(const std::vector<Leg>& history) {
  const auto earlier = Json::parse(std::ifstream(path_), nullptr, false);
  if (earlier.is_object()) started_ = text_in(earlier, "started", started_);
  history_ = history;
}

void RunRecord::begin_leg(Leg leg) {
  leg.at = now();
  leg.ranks = comm_->getSize();
  history_.push_back(std::move(leg));
}

void RunRecord::save() {
  measure_memory();
  replace();
}

void RunRecord::finish(RunStatus status, const std::string& message) {
  status_ = status;
  message_ = message;
  ended_ = now();
  measure_memory();
  replace();
}

void RunRecord::note_memory(const std::string& phase) {
  set(memory_section, phase, peaks_of_memory(*comm_));
}

void RunRecord::measure_memory() {
  const std::vector<double> peaks = peaks_of_memory(*comm_);
  memory_of_one_ = *std::max_element(peaks.begin(), peaks.end());
  memory_of_all_ = std::accumulate(peaks.begin(), peaks.end(), 0.0);
}

std::string RunRecord::text() const {
  nlohmann::ordered_json out;
  out["program"] = program_;
  out["status"] = name_of(status_);
  if (!message_.empty()) out["message"] = message_;
  out["started"] = started_;
  out["ended"] = nullptr;
  if (!ended_.empty()) out["ended"] = ended_;
  out["ranks"] = comm_->getSize();
  out["memory"] = {{"peak of one rank [MB]", memory_of_one_},
                   {"peak of all ranks [MB]", memory_of_all_}};
  for (const Leg& leg : history_) out["history"].push_back(as_json(leg));
  for (const auto& [section, entries] : sections_) {
    for (const auto& [key, value] : entries) {
      std::visit([&, &s = section, &k = key](const auto& v) { out[s][k] = v; }, value);
    }
  }
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void RunRecord::replace() {
  on_root_or_fault(*comm_, [&] { return io::replace_file(path_, text()); });
}

}  // namespace tunica::output
