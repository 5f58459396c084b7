#pragma once
#include <unistd.h>

#include <Teuchos_Array.hpp>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "tunica/base/error.hpp"
#include "tunica/params/table.hpp"

namespace tunica::params::test {

template <class T>
Teuchos::Array<T> array(const std::vector<T>& values) {
  return Teuchos::Array<T>(values);
}

/// A small schema with every kind of key.
inline Table surface_table() {
  return Table("Condition on one surface")
      .variant(
          "condition", "velocity",
          {{"velocity", Table("Prescribed velocity").number("peak", 0.0, any(), "mm/ms", "Peak.")},
           {"traction", Table("Prescribed traction")
                            .number("backflow stabilisation", 0.2, non_negative(), "1",
                                    "Factor of the backflow term.")
                            .numbers("pressure", {{0.0}}, any(), 0, "kPa", "Pressure.")}},
          "What is prescribed.");
}

inline Table fluid_table() {
  return Table("Incompressible fluid")
      .number("density", 1.05, positive(), "mg/mm³", "Mass per volume.")
      .integer("max iterations", 20, between(1, 100), "Newton steps at most.")
      .flag("is moving", true, "Whether the mesh follows the wall.")
      .text("title", "a < b -- \"c\"", "Free text.")
      .choice("scheme", "implicit Euler", {"implicit Euler", "BDF2"}, "Time scheme.")
      .numbers("axis", {{0.0, 0.0, 1.0}}, between(-1.0, 1.0), 3, "", "Direction.")
      .names("tags", {{"inlet", "outlet"}}, "Surfaces.")
      .file("restart", "", "State to start from.")
      .removed("viscosity mu", "viscosity")
      .entries("Surfaces", surface_table(), "Open boundaries.")
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        TUNICA_CHECK(list.get<double>("density") < 50.0 || !list.get<bool>("is moving"),
                     path + ": too dense to move");
      });
}

inline Table case_table() {
  Teuchos::ParameterList valid, fallback;
  valid.set("Tolerance", 1e-8);
  valid.sublist("Output").set("Verbosity", 1);
  fallback.set("Tolerance", 1e-6);
  return Table("The whole case")
      .sublist("Fluid", fluid_table())
      .foreign("Belos", fallback, valid, "Linear solver.")
      .foreign("MueLu", Teuchos::ParameterList(), Teuchos::ParameterList(), "Multigrid.");
}

/// what() of the error that the action throws; "" if it throws none.
inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline std::string resolve_message(const Table& table, Teuchos::ParameterList list,
                                   const std::string& path = "") {
  return message_of([&] { table.resolve(list, path, "."); });
}

/// A folder of its own that vanishes with the object.
class Folder {
public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("tunica-params-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path(name);
  }
  std::string path(const std::string& name = "") const {
    return name.empty() ? path_.string() : (path_ / name).string();
  }

private:
  std::filesystem::path path_;
};

}  // namespace tunica::params::test
