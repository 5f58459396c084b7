#pragma once
#include <cstdio>
#include <iostream>
#include <string>

namespace tunica {

/// What becomes of words that nobody could take down: a sentence where standard output has refused
/// any, as on a full disk; empty otherwise. For the end of a program.
inline std::string lost_output() {
  std::cout.flush();
  const bool is_flushed = std::fflush(stdout) == 0;
  if (is_flushed && std::ferror(stdout) == 0 && std::cout.good()) return "";
  return "standard output could not be written: is its disk full? What the program has printed is "
         "incomplete.";
}

}  // namespace tunica
