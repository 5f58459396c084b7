#include "tunica/base/error.hpp"

namespace tunica::detail {

void throw_error(const std::string& message) { throw Error(message); }

void broken_promise(const char* condition, const std::string& message, const char* file, int line) {
  throw std::logic_error(std::string(file) + ":" + std::to_string(line) + ": " + condition + ": " +
                         message);
}

}  // namespace tunica::detail
