#include "tunica/io/folder_lock.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <sstream>

namespace tunica::io {

namespace {

constexpr const char* lock_name = ".tunica-lock";

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

/// As its words say.
struct Holder {
  long pid = 0;
  std::string host;

  bool is_named() const { return pid > 0 && !host.empty(); }
  bool is_gone() const { return host == io::host() && ::kill(pid, 0) != 0 && errno == ESRCH; }
};

Holder holder_in(int file) {
  std::array<char, 512> words{};
  const ssize_t size = ::pread(file, words.data(), words.size() - 1, 0);
  Holder holder;
  if (size > 0) std::istringstream(words.data()) >> holder.pid >> holder.host;
  return holder;
}

std::string held_text(const std::string& folder, const Holder& holder) {
  const std::string who = holder.is_named()
                              ? "process " + std::to_string(holder.pid) + " on host " + holder.host
                              : "another process";
  return "\"" + folder + "\" is in use: " + who +
         " writes its results there. Wait for its end, or choose another --output.";
}

int opened(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  return file >= 0 ? file : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
}

/// The file may have been removed by its holder between the opening and the lock.
bool is_still_there(int file, const std::string& path) {
  struct stat mine = {}, there = {};
  return ::fstat(file, &mine) == 0 && ::stat(path.c_str(), &there) == 0 &&
         mine.st_ino == there.st_ino && mine.st_dev == there.st_dev;
}

void write_words(int file) {
  const std::string words = std::to_string(::getpid()) + " " + host() + "\n";
  if (::ftruncate(file, 0) == 0 && ::pwrite(file, words.data(), words.size(), 0) < 0)
    return;  // a full disk: the lock holds without words
}

}  // namespace

Outcome FolderLock::take(const std::string& folder) {
  if (file_ >= 0) return Outcome::success();
  path_ = folder + "/" + lock_name;
  for (int attempt = 0; attempt < 100; ++attempt) {
    const int file = opened(path_);
    if (file < 0) return Outcome::success();
    const bool is_locked = ::flock(file, LOCK_EX | LOCK_NB) == 0;
    const bool is_refused = !is_locked && errno == EWOULDBLOCK;
    const Holder holder = holder_in(file);
    if (is_refused || (!is_locked && holder.is_named() && !holder.is_gone())) {
      ::close(file);
      const std::string advice = " If that process no longer exists, remove " + path_ + ".";
      return Outcome::failure(held_text(folder, holder) + (is_refused ? "" : advice));
    }
    if (is_still_there(file, path_)) {
      write_words(file);
      file_ = file;
      return Outcome::success();
    }
    ::close(file);
  }
  return Outcome::failure(held_text(folder, {}));
}

void FolderLock::give_back() {
  if (file_ < 0) return;
  ::unlink(path_.c_str());
  ::close(file_);
  file_ = -1;
}

}  // namespace tunica::io
