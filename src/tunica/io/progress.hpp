#pragma once
#include <functional>
#include <string>

namespace tunica::io {

/// While it lives, lines of report_progress() begin with these words, behind those of the scopes
/// around it: "step 3: wall: Newton step 2: ".
class ProgressScope {
public:
  explicit ProgressScope(const std::string& doing);
  ~ProgressScope();
  ProgressScope(const ProgressScope&) = delete;
  ProgressScope& operator=(const ProgressScope&) = delete;
};

/// How far a long computation has come: prints the open scopes and the words, unless a line was
/// printed in the last seconds. Prints nothing in programs that have not called show_progress().
/// Not collective.
void report_progress(const std::function<std::string()>& how_far);

/// Prints a line with the open scopes at once, where progress is shown.
void announce(const std::string& words);

/// Another line is on the screen: the interval to the next one begins again.
void restart_progress_interval();

/// From now on progress is shown by this process, at most one line in so many seconds.
void show_progress(double seconds);

}  // namespace tunica::io
