#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica {

/// Messages between failed ranks; each is sent once in a program.
enum class Tidings { ending = 1, exception = 2 };

/// Tells all ranks that fail as well a number, not zero, and returns theirs: zero of those that are
/// not heard of in time. Nothing of it is collective, but for side_channel() that was called
/// before.
std::vector<std::uint64_t> told_by_failed_ranks(const Comm& comm, Tidings what, std::uint64_t mine,
                                                std::chrono::seconds limit);

/// One-line summary of the current exception.
std::string words_of_exception();

/// While an exception is handled: does collective work if all ranks handle the same one, behind the
/// same fault_point() and at the same stage, a number of the caller; otherwise some may never come
/// to it. What the work throws is lost. The exception may have left messages on their way, so that
/// even then the work may wait for good.
void do_if_all_fail_alike(const Comm& comm, int stage, const std::function<void()>& work);

}  // namespace tunica
