#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/reduce.hpp"
#include "tunica/base/session.hpp"
#include "tunica/base/traffic.hpp"
#include "tunica/output/traffic_report.hpp"

namespace {

using namespace tunica;

const Traffic& counted(Work work) { return traffic()[static_cast<int>(work)]; }

TEUCHOS_UNIT_TEST(traffic_report, messages_and_their_bytes_belong_to_the_work_at_hand) {
  const CommPtr comm = all_ranks();
  output::restart_traffic();
  const int n = 5;
  {
    const TrafficScope scope(Work::solve);
    double x[n] = {};
    if (comm->getRank() == 0 && comm->getSize() > 1) Teuchos::send(*comm, n, x, 1);
    if (comm->getRank() == 1) Teuchos::receive(*comm, 0, n, x);
  }
  const bool is_sender = comm->getRank() == 0 && comm->getSize() > 1;
  TEST_EQUALITY(counted(Work::solve).messages, is_sender ? 1 : 0);
  TEST_EQUALITY(counted(Work::solve).bytes, is_sender ? n * 8 : 0);
  TEST_ASSERT(counted(Work::solve).partners == (is_sender ? std::set<int>{1} : std::set<int>{}));
  TEST_EQUALITY(counted(Work::other).messages, 0);
}

TEUCHOS_UNIT_TEST(traffic_report, a_scope_within_another_gives_it_back) {
  const CommPtr comm = all_ranks();
  output::restart_traffic();
  const TrafficScope outer(Work::solve);
  {
    const TrafficScope inner(Work::preconditioner);
    global_sum(*comm, 1.0);
    global_sum(*comm, 1.0);
  }
  global_sum(*comm, 1.0);
  TEST_EQUALITY(counted(Work::preconditioner).collectives, 2);
  TEST_EQUALITY(counted(Work::solve).collectives, 1);
  TEST_EQUALITY(counted(Work::other).collectives, 0);
}

TEUCHOS_UNIT_TEST(traffic_report, imports_of_vectors_are_counted) {
  const CommPtr comm = all_ranks();
  const int rank = comm->getRank(), size = comm->getSize();
  const auto owned = Teuchos::rcp(new Map(size, 1, 0, comm));
  std::vector<GlobalOrdinal> wanted{rank};
  if (size > 1) wanted.push_back((rank + 1) % size);
  const auto ghosted =
      Teuchos::rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                           Teuchos::arrayViewFromVector(wanted), 0, comm));
  const Import import(owned, ghosted);
  Vector x(owned), y(ghosted);
  output::restart_traffic();
  y.doImport(x, import, Tpetra::INSERT);
  TEST_EQUALITY(counted(Work::other).messages, size > 1 ? 1 : 0);
  TEST_EQUALITY(counted(Work::other).bytes, size > 1 ? 8 : 0);
}

}  // namespace
