#include "tunica/linear/lu_strategy.hpp"

#include <Teko_BlockLowerTriInverseOp.hpp>
#include <Teko_BlockPreconditionerFactory.hpp>
#include <Teko_BlockUpperTriInverseOp.hpp>
#include <Teko_CloneFactory.hpp>
#include <Teko_InverseLibrary.hpp>
#include <Teko_LU2x2InverseOp.hpp>
#include <Teko_PreconditionerFactory.hpp>

#include "tunica/linear/inverse_sum.hpp"
#include "tunica/linear/schur.hpp"
#include "tunica/params/known_keys.hpp"

namespace tunica::linear {

namespace {

enum class Form { upper, lower, full };

template <Form form>
class LuStrategy : public Teko::BlockPreconditionerFactory {
public:
  void initializeFromParameterList(const Teuchos::ParameterList& list) override {
    Teuchos::ParameterList own(list);
    inverse_A_ = getInverseLibrary()->getInverseFactory(
        own.get<std::string>("Inverse Velocity Type", "Amesos2"));
    schur_ =
        Teuchos::rcp(make_schur_inverse(own, *getInverseLibrary(), getRequestHandler()).release());
    params::check_keys(own,
                       {"Type", "Inverse Velocity Type", "Schur Complement", "Inverse Schur Type",
                        "Inverse Mass Type", "Stabilisation", "Convection", "Theta Factor"});
  }

  Teko::LinearOp buildPreconditionerOperator(Teko::BlockedLinearOp& K,
                                             Teko::BlockPreconditionerState& state) const override {
    const Teko::LinearOp A = Teko::getBlock(0, 0, K);
    // Ã⁻¹ keeps what it can of its last set-up.
    Teko::ModifiableLinearOp& inverse_A = state.getModifiableOp("inverse A");
    if (inverse_A.is_null())
      inverse_A = Teko::buildInverse(*inverse_A_, A);
    else
      Teko::rebuildInverse(*inverse_A_, A, inverse_A);
    // Teko's full factorisation wants S̃, the others −S̃.
    Teko::LinearOp for_A = inverse_sum({{1.0, inverse_A}});
    Teko::LinearOp for_S =
        inverse_sum({{form == Form::full ? 1.0 : -1.0, schur_->build(K, state)}});
    // P_F⁻¹: u = Ã⁻¹ r_u, p = −S̃⁻¹ (r_p − B2 u), u ← u − Ã⁻¹ B1ᵀ p
    if constexpr (form == Form::full) return Teko::createLU2x2InverseOp(K, for_A, for_S);
    const std::vector<Teko::LinearOp> diagonal{for_A, for_S};
    if constexpr (form == Form::upper) {
      // P_R⁻¹: p = −S̃⁻¹ r_p, u = Ã⁻¹ (r_u − B1ᵀ p)
      Teko::BlockedLinearOp U = Teko::getUpperTriBlocks(K);
      return Teko::createBlockUpperTriInverseOp(U, diagonal);
    } else {
      // P_L⁻¹: u = Ã⁻¹ r_u, p = −S̃⁻¹ (r_p − B2 u)
      Teko::BlockedLinearOp L = Teko::getLowerTriBlocks(K);
      return Teko::createBlockLowerTriInverseOp(L, diagonal);
    }
  }

private:
  Teuchos::RCP<const Teko::InverseFactory> inverse_A_;
  Teuchos::RCP<const SchurInverse> schur_;
};

template <Form form>
void add(const std::string& name) {
  const Teuchos::RCP<Teko::Cloneable> clone = Teuchos::rcp(new Teko::AutoClone<LuStrategy<form>>());
  Teko::PreconditionerFactory::addPreconditionerFactory(name, clone);
}

}  // namespace

void register_lu_strategies() {
  static const bool is_registered = [] {
    add<Form::upper>("LU Upper");
    add<Form::lower>("LU Lower");
    add<Form::full>("LU Full");
    return true;
  }();
  static_cast<void>(is_registered);
}

}  // namespace tunica::linear
