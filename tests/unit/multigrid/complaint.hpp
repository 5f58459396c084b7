#pragma once
#include <exception>
#include <string>

namespace tunica::test {

/// What the work throws says, empty if nothing.
template <class Work>
std::string complaint(const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace tunica::test
