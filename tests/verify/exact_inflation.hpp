#pragma once
#include <fstream>
#include <map>
#include <sstream>

#include "field_of.hpp"
#include "tunica/setup/case.hpp"
#include "tunica/setup/schema.hpp"

namespace tunica::verify {

/// A shipped case of a wall alone.
inline Teuchos::ParameterList case_of(const std::string& file) {
  setup::CommandLine command;
  command.case_file = TUNICA_CASES "/" + file;
  return setup::read_case(command, setup::solid_table(), *Tpetra::getDefaultComm()).list;
}

/// Inner radius by pressure, of tests/data/inflation.csv.
inline std::map<double, double> exact_radius(const std::string& wanted) {
  std::ifstream file(TUNICA_TEST_DATA "/inflation.csv");
  std::map<double, double> radius;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::string law, pressure, value;
    std::getline(cells, law, ',');
    std::getline(cells, pressure, ',');
    std::getline(cells, value, ',');
    if (law == wanted) radius[std::stod(pressure)] = std::stod(value);
  }
  return radius;
}

}  // namespace tunica::verify
