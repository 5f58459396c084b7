#include "tunica/output/run_folder.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/io/atomic_file.hpp"

namespace tunica::output {

namespace {

/// Empty if the folder exists now and takes files.
std::string create(const std::string& path) {
  const std::string advice = " Choose another folder with --output.";
  std::error_code failure;
  std::filesystem::create_directories(path, failure);
  if (failure) {
    return "Output folder \"" + path + "\" cannot be created: " + failure.message() + "." + advice;
  }
  if (!std::filesystem::is_directory(path)) {
    return "Output folder \"" + path + "\" is a file, expected a folder or nothing." + advice;
  }
  const std::string probe = path + "/.write-probe";
  const std::string problem = io::replace_file(probe, "writable\n");
  std::remove(probe.c_str());
  if (!problem.empty()) {
    return "Output folder \"" + path + "\" takes no files: " + problem + "." + advice;
  }
  return "";
}

}  // namespace

RunFolder::RunFolder(const std::string& path, const CommPtr& comm) : path_(path) {
  const std::string problem =
      agreed_message(*comm, comm->getRank() == 0 ? create(path_) : std::string());
  TUNICA_CHECK(problem.empty(), problem);
}

std::string RunFolder::file(const std::string& name) const { return path_ + "/" + name; }

}  // namespace tunica::output
