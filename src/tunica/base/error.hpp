#pragma once
#include <stdexcept>
#include <string>

namespace tunica {

/// The user's input or data is wrong. what() states where, what was found, what was
/// expected and what to do. Drivers turn it into exit status 1.
class Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The machine refuses: a full disk, a file that cannot be written. Every rank throws it alike, so
/// that it can be told once. Drivers turn it into exit status 3.
class MachineFault : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

namespace detail {
[[noreturn]] void throw_error(const std::string& message);
[[noreturn]] void broken_promise(const char* condition, const std::string& message,
                                 const char* file, int line);
}  // namespace detail

}  // namespace tunica

/// Checks the user's input or data: always on, throws tunica::Error.
#define TUNICA_CHECK(condition, message)                      \
  do {                                                        \
    if (!(condition)) ::tunica::detail::throw_error(message); \
  } while (false)

/// Checks a promise of our own code: debug builds only, throws std::logic_error.
#ifdef NDEBUG
#define TUNICA_ASSERT(condition, message) static_cast<void>(0)
#else
#define TUNICA_ASSERT(condition, message)                                                        \
  do {                                                                                           \
    if (!(condition)) ::tunica::detail::broken_promise(#condition, message, __FILE__, __LINE__); \
  } while (false)
#endif
