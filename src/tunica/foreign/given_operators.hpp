#pragma once
#include "tunica/linear/named_operators.hpp"
#include "tunica/systems/read_system.hpp"

namespace tunica::foreign {

/// What a user has handed in beside K: "Given Schur", if there is one.
class GivenOperators final : public linear::NamedOperators {
public:
  /// The system must outlive them.
  explicit GivenOperators(const systems::System& system) : system_(&system) {}

  std::vector<std::string> operator_names() const override {
    return system_->schur.is_null() ? std::vector<std::string>() : std::vector{std::string(name)};
  }
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string& wanted) const override {
    return wanted == name ? system_->schur : Teuchos::null;
  }

private:
  static constexpr const char* name = "Given Schur";

  const systems::System* system_;
};

}  // namespace tunica::foreign
