#include "tunica/output/run_folder.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/io/atomic_file.hpp"

namespace tunica::output {

namespace {

/// Success if the folder exists now and takes files.
Outcome create(const std::string& path) {
  const std::string advice = " Choose another folder with --output.";
  std::error_code failure;
  std::filesystem::create_directories(path, failure);
  if (failure) {
    return Outcome::failure("Output folder \"" + path +
                            "\" cannot be created: " + failure.message() + "." + advice);
  }
  if (!std::filesystem::is_directory(path)) {
    return Outcome::failure("Output folder \"" + path +
                            "\" is a file, expected a folder or nothing." + advice);
  }
  const std::string probe = path + "/.write-probe";
  const Outcome written = io::replace_file(probe, "writable\n");
  std::remove(probe.c_str());
  if (written.is_success()) return written;
  return Outcome::failure("Output folder \"" + path + "\" takes no files: " + written.reason() +
                          "." + advice);
}

}  // namespace

RunFolder::RunFolder(const std::string& path, const CommPtr& comm) : path_(path) {
  const Outcome outcome = agreed(*comm, comm->getRank() == 0 ? create(path_) : Outcome::success());
  TUNICA_CHECK(outcome.is_success(), outcome.reason());
}

std::string RunFolder::file(const std::string& name) const { return path_ + "/" + name; }

}  // namespace tunica::output
