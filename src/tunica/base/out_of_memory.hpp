#pragma once
#include <exception>
#include <string>

namespace tunica {

/// Whether an exception tells of exhausted memory: std::bad_alloc, or one of Trilinos that speaks
/// of it. Such a one is a fault of the machine and no verdict on a matrix or a file: whoever turns
/// exceptions into verdicts lets it pass.
bool is_out_of_memory(const std::exception& error);

/// "out of memory on rank 1 (mesh motion)", the place being the last fault_point() of this rank.
std::string out_of_memory_text();

/// Sets memory aside that is given back when there is no more, so that a rank can still say so.
void set_memory_aside();

}  // namespace tunica
