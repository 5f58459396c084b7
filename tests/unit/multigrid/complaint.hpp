#pragma once
#include <exception>
#include <string>

namespace tunica::test {

/// What the work throws says, empty if nothing. Exceptions of other kinds go on.
template <class Kind = std::exception, class Work>
std::string complaint(const Work& work) {
  try {
    work();
  } catch (const Kind& error) {
    return error.what();
  }
  return "";
}

}  // namespace tunica::test
