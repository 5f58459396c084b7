#include "tunica/setup/command_line.hpp"

#include <charconv>

#include "tunica/base/error.hpp"
#include "tunica/params/nearest.hpp"

namespace tunica::setup {

namespace {

struct Option {
  std::string name;
  std::string value;  ///< what follows it; "" if nothing
  std::string sentence;
};

std::vector<Option> options_of(const std::string& program) {
  std::vector<Option> options{
      {"--output", "DIR", "folder for the results"},
      {"--steps", "N", "stop after N time steps"},
      {"--set", "\"A/b=c\"", "set parameter b of list A to c; may be repeated"},
      {"--dry-run", "", "do everything but the solve"},
      {"--print-defaults", "",
       program == "tunica-check" ? "print the case completed with all defaults; without a case "
                                   "every key, commented"
                                 : "print a complete, commented case file"},
      {"--help", "", "print this text"}};
  if (program != "tunica-check")
    options.insert(options.begin() + 2,
                   {"--overwrite", "", "replace the results of an earlier run in the folder"});
  if (program == "tunica-fsi" || program == "tunica-solid" || program == "tunica-fluid")
    options.insert(options.begin() + 2,
                   {{"--restart", "", "continue in the output folder from its newest checkpoint"},
                    {"--allow-changes", "",
                     "with --restart: accept changes of the physics, loads or discretisation"}});
  if (program == "tunica-check")
    options.push_back({"--reference", "",
                       "print the parameter reference (Markdown); --reference Fluid/Surfaces: of a "
                       "list or key"});
  if (program == "tunica-solvers")
    options.push_back({"--export", "DIR", "write the systems there as Matrix Market files"});
  return options;
}

const Option& find(const std::vector<Option>& options, const std::string& name) {
  std::vector<std::string> names;
  for (const Option& option : options) {
    if (option.name == name) return option;
    names.push_back(option.name);
  }
  throw Error("unknown option \"" + name + "\". " + params::did_you_mean(name, names));
}

int to_steps(const std::string& text) {
  int steps = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, steps);
  TUNICA_CHECK(result.ec == std::errc() && result.ptr == end && steps > 0,
               "--steps is \"" + text + "\", expected a whole number > 0");
  return steps;
}

void store(CommandLine& line, const std::string& name, const std::string& value) {
  if (name == "--output") line.output = value;
  if (name == "--steps") line.steps = to_steps(value);
  if (name == "--set") line.set.push_back(value);
  if (name == "--dry-run") line.dry_run = true;
  if (name == "--restart") line.restart = true;
  if (name == "--allow-changes") line.allow_changes = true;
  if (name == "--overwrite") line.overwrite = true;
  if (name == "--print-defaults") line.print_defaults = true;
  if (name == "--help") line.help = true;
  if (name == "--reference") line.reference = true;
  if (name == "--export") line.export_folder = value;
}

bool ends_with(const std::string& name, const std::string& end) {
  return name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
}

/// What follows a matrix: its right-hand side, a case with settings for it.
void store_beside_matrix(CommandLine& line, const std::string& name) {
  std::string& file = ends_with(name, ".xml") ? line.settings : line.right_side;
  TUNICA_CHECK(file.empty(), "\"" + name + "\" is one file too many beside \"" + line.case_file +
                                 "\", expected K.mtx b.mtx CASE.xml");
  file = name;
}

void store_case(CommandLine& line, const std::string& name) {
  if (is_matrix_file(line.case_file)) return store_beside_matrix(line, name);
  TUNICA_CHECK(line.program == "tunica-solvers" || !is_matrix_file(name),
               "\"" + name + "\" is a matrix, expected a case file; tunica-solvers takes both.");
  TUNICA_CHECK(line.case_file.empty(),
               "two case files, \"" + line.case_file + "\" and \"" + name + "\", expected one");
  line.case_file = name;
}

}  // namespace

CommandLine parse(int argc, char** argv, const std::string& program, const std::string& sentence) {
  const std::vector<Option> options = options_of(program);
  const std::vector<std::string> words(argv + 1, argv + argc);
  CommandLine line;
  line.program = program;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].rfind('-', 0) != 0) {
      store_case(line, words[i]);
      continue;
    }
    const std::size_t equal = words[i].find('=');
    const std::string name = words[i] == "-h" ? "--help" : words[i].substr(0, equal);
    const Option& option = find(options, name);
    std::string value = equal == std::string::npos ? "" : words[i].substr(equal + 1);
    if (option.value.empty()) {
      TUNICA_CHECK(equal == std::string::npos, name + " takes no value");
    } else if (equal == std::string::npos) {
      const bool has_next = i + 1 < words.size() && words[i + 1].rfind("--", 0) != 0;
      if (has_next) value = words[++i];
    }
    TUNICA_CHECK(option.value.empty() || !value.empty(),
                 name + " lacks its value, expected " + name + " " + option.value);
    store(line, option.name, value);
  }
  const bool needs_case = !line.help && !line.print_defaults && !line.reference;
  TUNICA_CHECK(!needs_case || !line.case_file.empty(),
               "the case file is missing\n\n" + usage(program, sentence));
  TUNICA_CHECK(line.restart || !line.allow_changes, "--allow-changes is for --restart");
  TUNICA_CHECK(
      !line.restart || !line.overwrite,
      "--restart continues earlier results, --overwrite replaces them: expected one of the two");
  return line;
}

bool is_matrix_file(const std::string& name) {
  return ends_with(name, ".mtx") || ends_with(name, ".mtx.gz");
}

bool takes(const std::string& program, const std::string& option) {
  for (const Option& one : options_of(program))
    if (one.name == option) return true;
  return false;
}

std::string usage(const std::string& program, const std::string& sentence) {
  std::string text =
      program + ": " + sentence + "\n\nUsage: " + program + " CASE.xml [options]\n" +
      (program == "tunica-solvers"
           ? "       " + program + " K.mtx [b.mtx] [CASE.xml] [options]\n\nOptions:\n"
           : "\nOptions:\n");
  for (const Option& option : options_of(program)) {
    std::string left = "  " + option.name + (option.value.empty() ? "" : " " + option.value);
    left.resize(20, ' ');
    text += left + option.sentence + "\n";
  }
  return text +
         "\nExit status: 0 done, 1 bad input, 2 not converged, 3 internal or system error, 4 done, "
         "but steps were accepted unconverged, 5 stopped by a signal or the wall limit, continue "
         "with --restart.\n";
}

}  // namespace tunica::setup
