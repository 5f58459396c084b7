#include "tunica_mesh/arguments.hpp"

#include <charconv>
#include <filesystem>

#include "tunica/base/error.hpp"
#include "tunica/params/nearest.hpp"

namespace {

/// Converts the whole text, or fails with the message.
template <typename Number>
Number convert(const std::string& text, const std::string& message) {
  Number value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  TUNICA_CHECK(code == std::errc() && end == text.data() + text.size(), message);
  return value;
}

std::string usage(const Arguments::Command& command) {
  std::string text = "tunica-mesh " + command.name;
  for (const std::string& file : command.files) text += " " + file;
  return text + (command.options.empty() ? "" : " [--option value ...]");
}

}  // namespace

Arguments::Arguments(const Command& command, const std::vector<std::string>& words)
    : command_("tunica-mesh " + command.name) {
  std::vector<std::string> valid{"--help"};
  for (const Option& option : command.options) {
    valid.push_back("--" + option.name);
    values_[option.name] = option.fallback;
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--help" || words[i] == "-h") {
      wants_help_ = true;
      return;
    }
    if (words[i].compare(0, 1, "-") != 0) {
      files_.push_back(words[i]);
      continue;
    }
    const std::size_t equals = words[i].find('=');
    const std::string name = words[i].substr(0, equals);
    TUNICA_CHECK(
        name.size() > 2 && values_.count(name.substr(2)) == 1,
        command_ + ": unknown option " + name + ". " + tunica::params::did_you_mean(name, valid));
    TUNICA_CHECK(equals != std::string::npos || i + 1 < words.size(),
                 command_ + ": option " + name + " has no value");
    values_[name.substr(2)] =
        equals == std::string::npos ? words[++i] : words[i].substr(equals + 1);
  }
  TUNICA_CHECK(files_.size() == command.files.size(),
               command_ + ": found " + std::to_string(files_.size()) + " file names, expected " +
                   std::to_string(command.files.size()) + ": " + usage(command));
}

std::string Arguments::place(const std::string& option) const {
  return command_ + ": --" + option + " is \"" + values_.at(option) + "\", expected ";
}

std::string Arguments::text(const std::string& option) const { return values_.at(option); }

const std::string& Arguments::new_file(int i) const {
  TUNICA_CHECK(flag("overwrite") || !std::filesystem::exists(files_[i]),
               files_[i] + ": the file exists already. --overwrite on replaces it.");
  const std::filesystem::path folder = std::filesystem::path(files_[i]).parent_path();
  TUNICA_CHECK(folder.empty() || std::filesystem::is_directory(folder),
               files_[i] + ": the folder does not exist. Create it first.");
  return files_[i];
}

Arguments::Option overwrite_option() {
  return {"overwrite", "off", "on or off: whether an existing OUT is replaced"};
}

double Arguments::number(const std::string& option) const {
  return convert<double>(values_.at(option), place(option) + "a number");
}

int Arguments::integer(const std::string& option) const {
  return convert<int>(values_.at(option), place(option) + "an integer");
}

bool Arguments::flag(const std::string& option) const {
  const std::string& value = values_.at(option);
  TUNICA_CHECK(value == "on" || value == "off", place(option) + "on or off");
  return value == "on";
}

std::vector<std::string> Arguments::names(const std::string& option) const {
  std::vector<std::string> names;
  const std::string& value = values_.at(option);
  for (std::size_t at = 0; at < value.size();) {
    const std::size_t end = std::min(value.find(',', at), value.size());
    if (end > at) names.push_back(value.substr(at, end - at));
    at = end + 1;
  }
  return names;
}

std::string help(const Arguments::Command& command) {
  std::string text = usage(command) + "\n\n" + command.sentence + "\n";
  for (const auto& option : command.options) {
    std::string left = "  --" + option.name;
    left.resize(std::max<std::size_t>(left.size() + 1, 24), ' ');
    text += "\n" + left + option.sentence;
    if (!option.fallback.empty()) text += " [" + option.fallback + "]";
  }
  return text + "\n";
}
