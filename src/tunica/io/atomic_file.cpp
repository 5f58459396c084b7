#include "tunica/io/atomic_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace tunica::io {

std::string system_reason() {
  return errno == 0 ? std::string() : std::string(": ") + std::strerror(errno);
}

Outcome replace_file(const std::string& path, const std::string& text) {
  const std::string draft = path + ".tmp";
  errno = 0;
  std::ofstream file(draft, std::ios::trunc | std::ios::binary);
  file << text;
  file.close();
  if (!file) {
    const std::string reason = system_reason();
    std::remove(draft.c_str());
    return Outcome::failure("cannot write " + draft + reason);
  }
  if (std::rename(draft.c_str(), path.c_str()) != 0) {
    return Outcome::failure("cannot rename " + draft + " to " + path + system_reason());
  }
  return Outcome::success();
}

Result<std::string> set_aside(const std::string& path) {
  const std::filesystem::path old(path);
  const std::string stem = (old.parent_path() / old.stem()).string() + ".old";
  std::string new_name = stem + old.extension().string();
  for (int n = 2; std::filesystem::exists(new_name); ++n)
    new_name = stem + "-" + std::to_string(n) + old.extension().string();
  errno = 0;
  if (std::rename(path.c_str(), new_name.c_str()) == 0) return new_name;
  return Result<std::string>::failure("cannot rename " + path + " to " + new_name +
                                      system_reason());
}

}  // namespace tunica::io
