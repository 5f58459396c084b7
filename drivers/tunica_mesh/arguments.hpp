#pragma once
#include <map>
#include <string>
#include <vector>

/// The words after a subcommand: files, and options with a value each ("--name value" or
/// "--name=value"). Unknown options, missing values and wrong numbers of files are Errors.
class Arguments {
public:
  struct Option {
    std::string name;  ///< without hyphens
    std::string fallback;
    std::string sentence;
  };
  struct Command {
    std::string name;
    std::vector<std::string> files;  ///< what each file is, in order
    std::string sentence;
    std::vector<Option> options;
  };

  Arguments(const Command& command, const std::vector<std::string>& words);

  bool wants_help() const { return wants_help_; }
  const std::string& file(int i) const { return files_[i]; }
  /// The same of a file to be written. Throws Error if there is one already and --overwrite is off,
  /// or no folder for it.
  const std::string& new_file(int i) const;
  std::string text(const std::string& option) const;
  double number(const std::string& option) const;
  int integer(const std::string& option) const;
  /// "on" or "off".
  bool flag(const std::string& option) const;
  /// Names separated by commas; none if the value is empty.
  std::vector<std::string> names(const std::string& option) const;

private:
  std::string place(const std::string& option) const;

  std::string command_;
  bool wants_help_ = false;
  std::vector<std::string> files_;
  std::map<std::string, std::string> values_;
};

/// Whether to replace the file OUT: an option of all commands that write one.
Arguments::Option overwrite_option();

/// The text of --help.
std::string help(const Arguments::Command& command);
