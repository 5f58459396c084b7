#pragma once
#include <mpi.h>

#include <functional>
#include <string>

#include "tunica/base/outcome.hpp"
#include "tunica/base/types.hpp"

namespace tunica {

/// Does work with collective calls in it, in which some ranks may fail alone.
///
/// Returns the reason of the lowest rank that threw, the same on all. Throws MachineFault alike on
/// all ranks where one of them threw that or ran out of memory ("… while setting up the ILU").
/// A rank that fails waits for the others, some seconds. Where they do not come
/// they wait for it inside the work; nothing can be agreed, and it throws MachineFault alone: the
/// run has to end. Collective.
Outcome attempt(const Comm& comm, const std::string& doing, const std::function<void()>& work);

/// Whether all ranks come to this call within some seconds: on the way out of an exception, before
/// a collective clean-up. side_channel() has been called before.
bool all_meet(const Comm& comm);

/// Ranks of the communicator among themselves, apart from the messages of unfinished work. Made by
/// the first call and kept; that is collective. MPI_COMM_NULL where there are no messages.
MPI_Comm side_channel(const Comm& comm);

}  // namespace tunica
