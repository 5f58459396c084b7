#include <Teuchos_UnitTestHarness.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>

#include "tunica/linear/inverse_sum.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using linear::InverseOp;

/// Y ← c X whatever the alpha and beta it is asked for, as operators of MueLu do.
class Deaf final : public Operator {
public:
  Deaf(const Teuchos::RCP<const Map>& map, double c) : map_(map), c_(c) {}
  Teuchos::RCP<const Map> getDomainMap() const override { return map_; }
  Teuchos::RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp, Scalar,
             Scalar) const override {
    Y.update(c_, X, 0.0);
  }

private:
  Teuchos::RCP<const Map> map_;
  double c_;
};

Teuchos::RCP<const Map> three_per_rank() {
  return Teuchos::rcp(new Map(3 * test::world()->getSize(), 0, test::world()));
}

InverseOp deaf(const Teuchos::RCP<const Map>& map, double c) {
  const Teuchos::RCP<const Operator> op = Teuchos::rcp(new Deaf(map, c));
  return Thyra::createConstLinearOp<Scalar, LocalOrdinal, GlobalOrdinal, Node>(op);
}

/// alpha op(1) + beta y in each of two columns that start as y = 7 and hold x = 1 and x = 2.
std::vector<double> applied(const InverseOp& op, const Teuchos::RCP<const Map>& map, double alpha,
                            double beta) {
  const auto X = Teuchos::rcp(new MultiVector(map, 2)), Y = Teuchos::rcp(new MultiVector(map, 2));
  X->getVectorNonConst(0)->putScalar(1.0);
  X->getVectorNonConst(1)->putScalar(2.0);
  Y->putScalar(7.0);
  const auto x = Thyra::createConstMultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>(
      Teuchos::RCP<const MultiVector>(X), op->domain());
  const auto y =
      Thyra::createMultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>(Y, op->range());
  Thyra::apply<Scalar>(*op, Thyra::NOTRANS, *x, y.ptr(), alpha, beta);
  std::vector<double> values;
  for (int column = 0; column < 2; ++column)
    for (const double value : Y->getVector(column)->getData()) values.push_back(value);
  return values;
}

TEUCHOS_UNIT_TEST(inverse_sum, scales_and_adds_for_terms_that_do_not) {
  const auto map = three_per_rank();
  const InverseOp two = deaf(map, 2.0), five = deaf(map, 5.0);
  const auto sum = linear::inverse_sum({{-3.0, two}, {0.5, five}});  // −3.5 x
  for (const auto& [alpha, beta] : std::vector<std::pair<double, double>>{
           {1.0, 0.0}, {-2.0, 0.0}, {1.0, 1.0}, {4.0, -0.5}, {0.0, 3.0}}) {
    const auto values = applied(sum, map, alpha, beta);
    TEST_EQUALITY(values.size(), 6u);
    for (std::size_t i = 0; i < values.size(); ++i)
      TEST_FLOATING_EQUALITY(values[i] + 100.0,
                             alpha * -3.5 * (i < 3 ? 1.0 : 2.0) + beta * 7.0 + 100.0, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(inverse_sum, a_single_term_keeps_its_sign) {
  const auto map = three_per_rank();
  const InverseOp two = deaf(map, 2.0);
  const auto minus = linear::inverse_sum({{-1.0, two}});
  TEST_EQUALITY(applied(minus, map, 1.0, 0.0)[0], -2.0);
  const auto nested = linear::inverse_sum({{-1.0, minus}, {1.0, two}});
  TEST_EQUALITY(applied(nested, map, 1.0, 0.0)[3], 8.0);
}

TEUCHOS_UNIT_TEST(inverse_sum, what_the_result_held_does_not_count_where_beta_is_zero) {
  const auto map = three_per_rank();
  const auto sum = linear::inverse_sum({{1.0, deaf(map, 2.0)}});
  const auto X = Teuchos::rcp(new MultiVector(map, 1)), Y = Teuchos::rcp(new MultiVector(map, 1));
  X->putScalar(1.0);
  Y->putScalar(std::nan(""));
  const auto x = Thyra::createConstMultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>(
      Teuchos::RCP<const MultiVector>(X), sum->domain());
  const auto y =
      Thyra::createMultiVector<Scalar, LocalOrdinal, GlobalOrdinal, Node>(Y, sum->range());
  Thyra::apply<Scalar>(*sum, Thyra::NOTRANS, *x, y.ptr(), 1.0, 0.0);
  TEST_EQUALITY(Y->getVector(0)->normInf(), 2.0);
}

TEUCHOS_UNIT_TEST(inverse_sum, has_no_transpose) {
  const auto map = three_per_rank();
  const auto sum = linear::inverse_sum({{1.0, deaf(map, 2.0)}});
  TEST_ASSERT(Thyra::opSupported(*sum, Thyra::NOTRANS));
  TEST_ASSERT(!Thyra::opSupported(*sum, Thyra::TRANS));
}

}  // namespace
