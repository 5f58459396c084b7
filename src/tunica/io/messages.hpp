#pragma once
#include <functional>
#include <ios>
#include <streambuf>
#include <string>

namespace tunica::io {

/// Destination of the library's messages for people.
struct MessageSink {
  std::function<void(const std::string& text)> output;  ///< what a run does; text ends its line
  std::function<void(const std::string& text)> error;   ///< warnings, and why a run ends
};

/// From now on all lines of this process go there; a function that is empty restores the standard
/// stream. Nothing in the library writes to a stream by itself. Not collective.
void redirect_messages(MessageSink sink);

/// A line, or several, on standard output, and on the error stream: the end of the last one is
/// added where it lacks, and they are seen at once. Not collective.
void print_line(const std::string& text);
void print_error_line(const std::string& text);

/// While it lives, what other libraries print to std::cout of this process is thrown away.
class SilentOutput {
public:
  SilentOutput();
  ~SilentOutput();
  SilentOutput(const SilentOutput&) = delete;
  SilentOutput& operator=(const SilentOutput&) = delete;

private:
  std::ios_base::iostate state_;
  std::streambuf* before_;
};

/// For a process that can neither allocate nor throw: to the error stream, whatever the sink.
void print_last_words(const char* where, const char* words) noexcept;

/// A sentence about messages that were lost because standard output refused them, as on a full
/// disk; empty if none were. For the end of a program.
std::string lost_output();

}  // namespace tunica::io
