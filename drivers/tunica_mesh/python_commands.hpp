#pragma once
#include <string>
#include <vector>

/// A command that is a program of its own, in Python: what fills volumes has another licence.
struct PythonCommand {
  std::string name;
  std::string sentence;  ///< of the list of commands
};

const std::vector<PythonCommand>& python_commands();

/// If the first word is one of these, the program tunica-NAME beside this one takes the place of
/// this process with the other words. Call it before MPI begins. May throw MachineFault.
void become_python_command(const std::vector<std::string>& words);
