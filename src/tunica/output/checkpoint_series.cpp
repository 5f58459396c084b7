#include "tunica/output/checkpoint_series.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <regex>

namespace tunica::output {

namespace {

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code failure;
  for (auto it = std::filesystem::directory_iterator(folder, failure);
       !failure && it != std::filesystem::directory_iterator(); it.increment(failure))
    names.push_back(it->path().filename().string());
  return names;
}

}  // namespace

std::string checkpoint_path(const std::string& folder, int step) {
  std::array<char, 40> name;
  std::snprintf(name.data(), name.size(), "/checkpoint-%06d.h5", step);
  return folder + name.data();
}

std::vector<NamedCheckpoint> checkpoints_in(const std::string& folder) {
  static const std::regex pattern("checkpoint-([0-9]{6,9})\\.h5");
  std::vector<NamedCheckpoint> found;
  for (const std::string& name : names_in(folder)) {
    std::smatch digits;
    if (std::regex_match(name, digits, pattern))
      found.push_back({std::stoi(digits[1]), folder + "/" + name});
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.step > b.step; });
  return found;
}

void prune_checkpoints(const std::string& folder, int last_step, int count) {
  static const std::regex draft("checkpoint-[0-9]{6,9}\\.h5\\.tmp");
  std::error_code ignored;
  for (const std::string& name : names_in(folder))
    if (std::regex_match(name, draft)) std::filesystem::remove(folder + "/" + name, ignored);
  for (const NamedCheckpoint& checkpoint : checkpoints_in(folder))
    if (checkpoint.step > last_step || --count < 0)
      std::filesystem::remove(checkpoint.path, ignored);
}

}  // namespace tunica::output
