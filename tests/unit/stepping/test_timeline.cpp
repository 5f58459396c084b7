#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_Core.hpp>

#include "tunica/base/error.hpp"
#include "tunica/stepping/timeline.hpp"

namespace {

using namespace tunica;
using fields::Places;
using stepping::Rows;
using stepping::Timeline;

CommPtr world() { return Tpetra::getDefaultComm(); }

/// Two places of this rank.
Places pair() {
  const int rank = world()->getRank();
  return Places::of_this_rank({10 * rank, 10 * rank + 7}, world());
}

TEUCHOS_UNIT_TEST(timeline, keeps_as_many_steps_as_are_wanted) {
  Timeline x(pair(), 2, {"velocity"}, 3);
  TEST_EQUALITY(x.n_kept(), 1);
  TEST_ASSERT(x.value() == Rows(4, 0.0));
  for (double t = 1.0; t < 5.0; ++t) x.push({t, t * t, 1.0, -t});
  TEST_EQUALITY(x.n_kept(), 3);
  TEST_ASSERT(x.value() == Rows({4, 16, 1, -4}));
  TEST_ASSERT(x.value(2) == Rows({2, 4, 1, -2}));
  // polynomials of t at t = 5 from t = 4, 3, 2; at 4.5 after half a step
  TEST_COMPARE_FLOATING_ARRAYS(x.extrapolated(2, {1, 1, 1}), Rows({5, 25, 1, -5}), 1e-14);
  TEST_COMPARE_FLOATING_ARRAYS(x.extrapolated(2, {0.5, 1, 1}), Rows({4.5, 20.25, 1, -4.5}), 1e-14);
  TEST_COMPARE_FLOATING_ARRAYS(x.extrapolated(0, {1, 1, 1}), Rows({4, 16, 1, -4}), 1e-14);
  x.start_from({1, 2, 3, 4});
  TEST_EQUALITY(x.n_kept(), 1);
  TEST_ASSERT(x.extrapolated(2, {1, 1, 1}) == Rows({1, 2, 3, 4}));
}

TEUCHOS_UNIT_TEST(timeline, comes_back_to_what_was_saved) {
  Timeline x(pair(), 2, {"velocity"}, 3);
  x.push({1, 2, 3, 4});
  x.push({5, 6, 7, 8});
  x[0] = {-1, -2, -3, -4};
  const fields::State state = x.save();
  TEST_EQUALITY(state.places.size(), 2u);
  x.push({9, 9, 9, 9});
  x.push({8, 8, 8, 8});
  x[0] = Rows(4, 0.0);
  x.restore(state);
  TEST_EQUALITY(x.n_kept(), 3);
  TEST_ASSERT(x.value() == Rows({5, 6, 7, 8}));
  TEST_ASSERT(x.value(1) == Rows({1, 2, 3, 4}));
  TEST_ASSERT(x.value(2) == Rows(4, 0.0));
  TEST_ASSERT(x[0] == Rows({-1, -2, -3, -4}));
}

TEUCHOS_UNIT_TEST(timeline, leaves_to_others_what_they_have) {
  Timeline x(pair(), 1, {}, 2), y(pair(), 1, {"rate"}, 1);
  x.push({1, 2});
  x.push({3, 4});
  y[0] = {5, 6};
  fields::State state = pair().state();
  x.save_past("x ", state);
  y.save_past("y ", state);
  TEST_EQUALITY(state.arrays.size(), 2u);  // x of the step before the last, rate of y
  Timeline again(pair(), 1, {}, 2);
  again.restore_past("x ", state, {3, 4});
  TEST_ASSERT(again.value() == Rows({3, 4}) && again.value(1) == Rows({1, 2}));
  Timeline wider(pair(), 2, {"rate"}, 1);
  TEST_THROW(wider.restore_past("y ", state, Rows(4)), Error);
}

TEUCHOS_UNIT_TEST(timeline, of_numbers_is_a_list) {
  Timeline p(Places::everywhere(), 1, {"rate", "previous"});
  p.set_numbers({1, 2, 3});
  TEST_EQUALITY(p.value()[0], 1.0);
  TEST_EQUALITY(p[1][0], 3.0);
  TEST_ASSERT(p.numbers() == std::vector<double>({1, 2, 3}));
}

}  // namespace
