#include "tunica/io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "tunica/base/error.hpp"

namespace tunica::io {

namespace {

Outcome synced(const std::string& path, int flags) {
  errno = 0;
  const int file = ::open(path.c_str(), flags);
  const bool is_synced = file >= 0 && ::fsync(file) == 0;
  const std::string reason = system_reason();
  if (file >= 0) ::close(file);
  return is_synced ? Outcome::success() : Outcome::failure("cannot flush " + path + reason);
}

Outcome renamed(const std::string& from, const std::string& to) {
  errno = 0;
  if (std::rename(from.c_str(), to.c_str()) == 0) return Outcome::success();
  return Outcome::failure("cannot rename " + from + " to " + to + system_reason());
}

}  // namespace

std::string system_reason() {
  return errno == 0 ? std::string() : std::string(": ") + std::strerror(errno);
}

AtomicFile::AtomicFile(const std::string& path) : path_(path), draft_(draft_of(path)) {}

AtomicFile::~AtomicFile() {
  if (!is_committed_) std::remove(draft_.c_str());
}

void AtomicFile::note_failure() {
  if (!file_ && outcome_.is_success())
    outcome_ = Outcome::failure("cannot write " + draft_ + system_reason());
}

void AtomicFile::add(const std::string& text) {
  if (outcome_.is_failure()) return;
  errno = 0;
  if (!file_.is_open()) file_.open(draft_, std::ios::trunc | std::ios::binary);
  file_ << text;
  note_failure();
}

Outcome AtomicFile::close() {
  errno = 0;
  if (file_.is_open()) file_.close();
  note_failure();
  return outcome_;
}

Outcome AtomicFile::commit() {
  if (close().is_success()) outcome_ = renamed(draft_, path_);
  is_committed_ = outcome_.is_success();
  return outcome_;
}

Outcome AtomicFile::commit_to_disk() {
  if (close().is_success()) outcome_ = synced(draft_, O_WRONLY);
  if (commit().is_failure()) return outcome_;
  const std::string folder = std::filesystem::path(path_).parent_path().string();
  const Outcome flushed = synced(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
  // Some network file systems cannot flush folders; the file has its name all the same.
  return errno == EINVAL || errno == ENOTSUP ? Outcome::success() : flushed;
}

Outcome replace_file(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.add(text);
  return file.commit();
}

void write_file(const std::string& path, const std::string& text) {
  TUNICA_CHECK(!path.empty(), "the name of the output file is empty");
  TUNICA_CHECK(!std::filesystem::is_directory(path), path + ": is a directory, expected a file");
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  TUNICA_CHECK(folder.empty() || std::filesystem::is_directory(folder),
               path + ": the folder does not exist. Create it first.");
  const Outcome written = replace_file(path, text);
  TUNICA_CHECK(written.is_success(), path + ": " + written.reason());
}

Result<std::string> set_aside(const std::string& path) {
  const std::filesystem::path old(path);
  const std::string stem = (old.parent_path() / old.stem()).string() + ".old";
  std::string new_name = stem + old.extension().string();
  for (int n = 2; std::filesystem::exists(new_name); ++n)
    new_name = stem + "-" + std::to_string(n) + old.extension().string();
  if (const Outcome moved = renamed(path, new_name); moved.is_failure())
    return Result<std::string>::failure(moved.reason());
  return new_name;
}

}  // namespace tunica::io
