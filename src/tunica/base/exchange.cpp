#include "tunica/base/exchange.hpp"

#include <Teuchos_DefaultMpiComm.hpp>
#include <numeric>

namespace tunica {

namespace {

std::vector<int> starts(const std::vector<int>& counts) {
  std::vector<int> first(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, first.begin() + 1);
  return first;
}

}  // namespace

MPI_Comm mpi_comm(const Comm& comm) {
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  if (mpi == nullptr) return MPI_COMM_SELF;
  return *mpi->getRawMpiComm();
}

std::vector<int> exchange_counts(const Comm& comm, const std::vector<int>& outgoing) {
  std::vector<int> incoming(outgoing.size(), 0);
  MPI_Alltoall(outgoing.data(), 1, MPI_INT, incoming.data(), 1, MPI_INT, mpi_comm(comm));
  return incoming;
}

void exchange_items(const Comm& comm, const void* outgoing, const std::vector<int>& to,
                    void* incoming, const std::vector<int>& from, std::size_t size) {
  MPI_Datatype item = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(static_cast<int>(size), MPI_BYTE, &item);
  MPI_Type_commit(&item);
  const std::vector<int> first_out = starts(to), first_in = starts(from);
  MPI_Alltoallv(outgoing, to.data(), first_out.data(), item, incoming, from.data(), first_in.data(),
                item, mpi_comm(comm));
  MPI_Type_free(&item);
}

}  // namespace tunica
