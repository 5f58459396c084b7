#include "output/atomic_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace tunica::output {

std::string system_reason() {
  return errno == 0 ? std::string() : std::string(": ") + std::strerror(errno);
}

std::string replace_file(const std::string& path, const std::string& text) {
  const std::string draft = path + ".tmp";
  errno = 0;
  std::ofstream file(draft, std::ios::trunc | std::ios::binary);
  file << text;
  file.close();
  if (!file) {
    const std::string reason = system_reason();
    std::remove(draft.c_str());
    return "cannot write " + draft + reason;
  }
  if (std::rename(draft.c_str(), path.c_str()) != 0) {
    return "cannot rename " + draft + " to " + path + system_reason();
  }
  return "";
}

}  // namespace tunica::output
