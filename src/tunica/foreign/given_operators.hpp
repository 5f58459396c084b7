#pragma once
#include "tunica/linear/named_operators.hpp"
#include "tunica/systems/read_system.hpp"

namespace tunica::foreign {

/// What a user has handed in beside K: "Given Schur", if there is one.
class GivenOperators final : public linear::NamedOperators {
public:
  static constexpr const char* schur = "Given Schur";

  /// The system must outlive them.
  explicit GivenOperators(const systems::System& system) : system_(&system) {}

  std::vector<std::string> operator_names() const override {
    return system_->schur.is_null() ? std::vector<std::string>() : std::vector{std::string(schur)};
  }
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string& wanted) const override {
    return wanted == schur ? system_->schur : Teuchos::null;
  }

private:
  const systems::System* system_;
};

}  // namespace tunica::foreign
