#include "tunica_mesh/lumen_command.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "tunica/base/error.hpp"

void become_lumen(const std::vector<std::string>& words) {
  // Beside this program; from the path where there is no /proc that says where this is.
  std::error_code unknown;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::string program = self.parent_path() / "tunica-lumen";
  std::vector<char*> arguments{const_cast<char*>(program.c_str())};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execvp(program.c_str(), arguments.data());
  throw tunica::MachineFault(program + ": cannot be run: " + std::strerror(errno) +
                             ". It belongs beside tunica-mesh.");
}
