#include "tunica_mesh/python_commands.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "tunica/base/error.hpp"

const std::vector<PythonCommand>& python_commands() {
  static const std::vector<PythonCommand> all{
      {"lumen", "Makes a mesh of the inside of a vessel's surface (STL, VTP, PLY, OBJ)."},
      {"adapt", "Makes the mesh of a run anew, with elements where its errors are."}};
  return all;
}

void become_python_command(const std::vector<std::string>& words) {
  const std::vector<PythonCommand>& all = python_commands();
  if (std::none_of(all.begin(), all.end(), [&](const auto& each) { return each.name == words[0]; }))
    return;
  // Beside this program; from the path where there is no /proc that says where this is.
  std::error_code unknown;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::string program = self.parent_path() / ("tunica-" + words[0]);
  std::vector<char*> arguments{const_cast<char*>(program.c_str())};
  for (std::size_t k = 1; k < words.size(); ++k)
    arguments.push_back(const_cast<char*>(words[k].c_str()));
  arguments.push_back(nullptr);
  execvp(program.c_str(), arguments.data());
  throw tunica::MachineFault(program + ": cannot be run: " + std::strerror(errno) +
                             ". It belongs beside tunica-mesh.");
}
