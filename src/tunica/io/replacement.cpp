#include "tunica/io/replacement.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tunica/base/error.hpp"

namespace tunica::io {

Replacement::Replacement(const std::string& path)
    : path_(path), temporary_(path + ".part" + std::to_string(::getpid())) {
  TUNICA_CHECK(!path.empty(), "the name of the output file is empty");
  TUNICA_CHECK(!std::filesystem::is_directory(path), path + ": is a directory, expected a file");
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  TUNICA_CHECK(folder.empty() || std::filesystem::is_directory(folder),
               path + ": the folder does not exist. Create it first.");
}

Replacement::~Replacement() {
  std::error_code ignored;
  if (!is_committed_) std::filesystem::remove(temporary_, ignored);
}

void Replacement::commit() {
  std::error_code code;
  std::filesystem::rename(temporary_, path_, code);
  TUNICA_CHECK(!code, path_ + ": cannot be written: " + code.message());
  is_committed_ = true;
}

void write_bytes(const std::string& path, const std::string& content) {
  Replacement file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  TUNICA_CHECK(out, path + ": cannot be opened for writing");
  out << content;
  out.close();
  TUNICA_CHECK(out, path + ": writing failed. Is the disk full?");
  file.commit();
}

}  // namespace tunica::io
