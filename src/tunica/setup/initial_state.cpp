#include "tunica/setup/initial_state.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "tunica/base/formatted.hpp"
#include "tunica/output/stored_fields.hpp"

namespace tunica::setup {

namespace {

constexpr const char* initial_state_key = "initial state";

/// Where the time of "RUN:time" begins; the end where there is none.
std::size_t place_of_time(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon + 1 == text.size()) return text.size();
  char* end = nullptr;
  std::strtod(text.c_str() + colon + 1, &end);
  return *end == '\0' ? colon : text.size();
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The row of a step, by the names of its columns; empty where there is none.
std::map<std::string, std::string> row_of_step(const std::string& path, int step) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) return {};
  const std::vector<std::string> names = cells_of(line);
  const std::string begin = std::to_string(step) + ",";
  while (std::getline(file, line)) {
    if (line.rfind(begin, 0) != 0) continue;
    const std::vector<std::string> cells = cells_of(line);
    std::map<std::string, std::string> row;
    for (std::size_t k = 0; k < std::min(names.size(), cells.size()); ++k) row[names[k]] = cells[k];
    return row;
  }
  return {};
}

}  // namespace

std::optional<InitialState> initial_state(const Teuchos::ParameterList& time) {
  const auto& text = time.get<std::string>(initial_state_key);
  if (text.empty()) return {};
  const std::size_t end = place_of_time(text);
  InitialState state{text.substr(0, end), {}};
  if (end < text.size()) state.time = std::strtod(text.c_str() + end + 1, nullptr);
  return state;
}

void place_initial_state(Teuchos::ParameterList& time, const std::string& folder_of_case) {
  const std::filesystem::path path = time.get<std::string>(initial_state_key);
  if (path.empty() || path.is_absolute()) return;
  time.set(initial_state_key,
           (std::filesystem::path(folder_of_case) / path).lexically_normal().string());
}

void add_initial_state_key(params::Table& time) {
  time.text(initial_state_key, "",
            "RUN or RUN:time, the results folder of another run, on any mesh, and one of the times "
            "[ms] at which it wrote its fields, by default its last: its velocity, pressure and "
            "displacement, interpolated, and the stored pressures of its windkessels are where "
            "this run begins; empty: rest");
}

std::string take_outlet_pressures(Teuchos::ParameterList& the_case) {
  const auto from = initial_state(the_case.sublist("Time"));
  if (!from || !the_case.isSublist("Fluid")) return "";
  const output::StoredFields stored(from->folder, from->time);
  const auto row = row_of_step(from->folder + "/steps.csv", stored.step());
  Teuchos::ParameterList& surfaces = the_case.sublist("Fluid").sublist("Surfaces");
  std::string taken;
  for (auto it = surfaces.begin(); it != surfaces.end(); ++it) {
    const std::string& name = surfaces.name(it);
    Teuchos::ParameterList& surface = surfaces.sublist(name);
    const auto cell = row.find("stored_pressure_" + name + "_kPa");
    if (surface.get<std::string>("condition") != "windkessel" || cell == row.end()) continue;
    const double pressure = std::stod(cell->second);
    surface.set("initial pressure", pressure);
    surface.set("mean flow", 0.0);  // the other way to say it
    taken += (taken.empty() ? "" : ", ") + name + formatted(" %.4g kPa", pressure);
  }
  return taken.empty() ? "" : "windkessels begin as in " + from->folder + ": " + taken;
}

}  // namespace tunica::setup
