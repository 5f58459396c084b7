#include "tunica/io/progress.hpp"

#include <optional>
#include <vector>

#include "tunica/base/timer.hpp"
#include "tunica/io/messages.hpp"

namespace tunica::io {

namespace {

/// Of the process, as its standard output is.
struct Progress {
  std::vector<std::string> scopes;
  std::optional<double> interval;  ///< seconds; nothing where no progress is shown
  Stopwatch since_last_line;
};

Progress& progress() {
  static Progress of_process;
  return of_process;
}

void print_in_scopes(const std::string& words) {
  std::string line;
  for (const std::string& scope : progress().scopes) line += scope + ": ";
  print_line(line + words);
  restart_progress_interval();
}

}  // namespace

ProgressScope::ProgressScope(const std::string& doing) { progress().scopes.push_back(doing); }
ProgressScope::~ProgressScope() { progress().scopes.pop_back(); }

void report_progress(const std::function<std::string()>& how_far) {
  const Progress& now = progress();
  if (now.interval && now.since_last_line.seconds() >= *now.interval) print_in_scopes(how_far());
}

void announce(const std::string& words) {
  if (progress().interval) print_in_scopes(words);
}

void restart_progress_interval() { progress().since_last_line = Stopwatch(); }

void show_progress(double seconds) {
  progress().interval = seconds;
  restart_progress_interval();
}

}  // namespace tunica::io
