#include "tunica/io/messages.hpp"

#include <cstdio>
#include <iostream>
#include <utility>

namespace tunica::io {

namespace {

MessageSink& present_sink() {
  static MessageSink of_process;
  return of_process;
}

void write(const std::function<void(const std::string&)>& sink, std::ostream& standard,
           const std::string& text) {
  const bool is_ended = !text.empty() && text.back() == '\n';
  if (sink)
    sink(is_ended ? text : text + "\n");
  else
    standard << (is_ended ? text : text + "\n") << std::flush;
}

}  // namespace

void redirect_messages(MessageSink sink) { present_sink() = std::move(sink); }

void print_line(const std::string& text) { write(present_sink().output, std::cout, text); }

void print_error_line(const std::string& text) { write(present_sink().error, std::cerr, text); }

SilentOutput::SilentOutput() : state_(std::cout.rdstate()), before_(std::cout.rdbuf(nullptr)) {}

SilentOutput::~SilentOutput() {
  std::cout.rdbuf(before_);  // forgets the failures since, and those before
  std::cout.setstate(state_);
}

void print_last_words(const char* where, const char* words) noexcept {
  std::fprintf(stderr, "%s: %s\n", where, words);
}

std::string lost_output() {
  std::cout.flush();
  const bool is_flushed = std::fflush(stdout) == 0;
  if (is_flushed && std::ferror(stdout) == 0 && std::cout.good()) return "";
  return "standard output could not be written: is its disk full? What the program has printed is "
         "incomplete.";
}

}  // namespace tunica::io
