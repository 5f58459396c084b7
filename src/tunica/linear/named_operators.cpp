#include "tunica/linear/named_operators.hpp"

namespace tunica::linear {

namespace {

class NoOperators final : public NamedOperators {
public:
  std::vector<std::string> operator_names() const override { return {}; }
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string&) const override {
    return Teuchos::null;
  }
};

}  // namespace

const NamedOperators& no_operators() {
  static const NoOperators none;
  return none;
}

}  // namespace tunica::linear
