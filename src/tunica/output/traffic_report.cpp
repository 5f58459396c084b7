#include "tunica/output/traffic_report.hpp"

#include <mpi.h>

#include "tunica/base/reduce.hpp"
#include "tunica/base/traffic.hpp"

namespace tunica {

namespace {

Traffic& current() { return traffic()[static_cast<int>(TrafficScope::current())]; }

void count_message(int count, MPI_Datatype type, int to) {
  int size = 0;
  MPI_Type_size(type, &size);
  Traffic& t = current();
  ++t.messages;
  t.bytes += static_cast<long long>(count) * size;
  t.partners.insert(to);
}

void count_collective() { ++current().collectives; }

}  // namespace

}  // namespace tunica

// MPI lets a program put its own functions before those of the library, which are then called by
// their second name (MPI standard 3.1, section 14.2). So the messages of Trilinos and HDF5 are
// counted as ours are. These are the functions that Teuchos and Tpetra call in a march.
// NOLINTBEGIN(readability-function-size): MPI says how many parameters its functions have.
extern "C" {

int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  tunica::count_message(count, type, to);
  return PMPI_Send(data, count, type, to, tag, comm);
}

int MPI_Ssend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  tunica::count_message(count, type, to);
  return PMPI_Ssend(data, count, type, to, tag, comm);
}

int MPI_Rsend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  tunica::count_message(count, type, to);
  return PMPI_Rsend(data, count, type, to, tag, comm);
}

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request) {
  tunica::count_message(count, type, to);
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}

int MPI_Irsend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
               MPI_Request* request) {
  tunica::count_message(count, type, to);
  return PMPI_Irsend(data, count, type, to, tag, comm, request);
}

int MPI_Allreduce(const void* mine, void* all, int count, MPI_Datatype type, MPI_Op op,
                  MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Allreduce(mine, all, count, type, op, comm);
}

int MPI_Iallreduce(const void* mine, void* all, int count, MPI_Datatype type, MPI_Op op,
                   MPI_Comm comm, MPI_Request* request) {
  tunica::count_collective();
  return PMPI_Iallreduce(mine, all, count, type, op, comm, request);
}

int MPI_Reduce(const void* mine, void* all, int count, MPI_Datatype type, MPI_Op op, int root,
               MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Reduce(mine, all, count, type, op, root, comm);
}

int MPI_Reduce_scatter(const void* mine, void* all, const int* counts, MPI_Datatype type, MPI_Op op,
                       MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Reduce_scatter(mine, all, counts, type, op, comm);
}

int MPI_Scan(const void* mine, void* all, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Scan(mine, all, count, type, op, comm);
}

int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Bcast(data, count, type, root, comm);
}

int MPI_Barrier(MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Barrier(comm);
}

int MPI_Gather(const void* mine, int n_mine, MPI_Datatype my_type, void* all, int n_all,
               MPI_Datatype their_type, int root, MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Gather(mine, n_mine, my_type, all, n_all, their_type, root, comm);
}

int MPI_Gatherv(const void* mine, int n_mine, MPI_Datatype my_type, void* all, const int* counts,
                const int* places, MPI_Datatype their_type, int root, MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Gatherv(mine, n_mine, my_type, all, counts, places, their_type, root, comm);
}

int MPI_Scatterv(const void* all, const int* counts, const int* places, MPI_Datatype their_type,
                 void* mine, int n_mine, MPI_Datatype my_type, int root, MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Scatterv(all, counts, places, their_type, mine, n_mine, my_type, root, comm);
}

int MPI_Allgather(const void* mine, int n_mine, MPI_Datatype my_type, void* all, int n_all,
                  MPI_Datatype their_type, MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Allgather(mine, n_mine, my_type, all, n_all, their_type, comm);
}

int MPI_Allgatherv(const void* mine, int n_mine, MPI_Datatype my_type, void* all, const int* counts,
                   const int* places, MPI_Datatype their_type, MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Allgatherv(mine, n_mine, my_type, all, counts, places, their_type, comm);
}

int MPI_Alltoall(const void* mine, int n_mine, MPI_Datatype my_type, void* all, int n_all,
                 MPI_Datatype their_type, MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Alltoall(mine, n_mine, my_type, all, n_all, their_type, comm);
}

int MPI_Alltoallv(const void* mine, const int* n_mine, const int* my_places, MPI_Datatype my_type,
                  void* all, const int* counts, const int* places, MPI_Datatype their_type,
                  MPI_Comm comm) {
  tunica::count_collective();
  return PMPI_Alltoallv(mine, n_mine, my_places, my_type, all, counts, places, their_type, comm);
}

}  // extern "C"
// NOLINTEND(readability-function-size)

namespace tunica::output {

void restart_traffic() { traffic() = {}; }

void record_traffic(RunRecord& record, int steps, const Comm& comm) {
  if (steps == 0) return;
  const std::array<Traffic, n_works> counted = traffic();  // before these reductions
  constexpr const char* names[n_works] = {"rest", "preconditioner", "solves", "mesh motion"};
  const char* section = "traffic of a rank and step";
  for (int work = 0; work < n_works; ++work) {
    const std::string name = names[work];
    const auto put = [&](const char* what, double mine) {
      record.set(section, name + ", " + what, global_max(comm, mine));
    };
    const Traffic& t = counted[work];
    put("messages", static_cast<double>(t.messages) / steps);
    put("kB", static_cast<double>(t.bytes) / 1e3 / steps);
    put("collective calls", static_cast<double>(t.collectives) / steps);
    put("ranks sent to", static_cast<double>(t.partners.size()));
  }
}

}  // namespace tunica::output
