#include <Teuchos_UnitTestHarness.hpp>
#include <Teuchos_XMLParameterListHelpers.hpp>

#include "tunica/params/differences.hpp"

namespace {

using namespace tunica::params;

Teuchos::ParameterList list_of(const std::string& inside) {
  return *Teuchos::getParametersFromXmlString("<ParameterList name=\"Case\">" + inside +
                                              "</ParameterList>");
}

std::string number(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"double\" value=\"" + value + "\"/>";
}

std::string list(const std::string& name, const std::string& inside) {
  return "<ParameterList name=\"" + name + "\">" + inside + "</ParameterList>";
}

TEUCHOS_UNIT_TEST(differences, of_a_list_to_itself_are_none_whatever_the_order) {
  const auto one = list_of(number("a", "1") + list("L", number("b", "0.1") + number("c", "2")));
  const auto other =
      list_of(list("L", number("c", "2.0") + number("b", "1e-1")) + number("a", "1"));
  TEST_ASSERT(differences(one, other).empty());
}

TEUCHOS_UNIT_TEST(differences, are_named_with_their_path_and_both_values) {
  const auto found = differences(list_of(list("Fluid", number("viscosity", "0.0035"))),
                                 list_of(list("Fluid", number("viscosity", "0.004"))));
  TEST_EQUALITY(found.size(), 1u);
  TEST_EQUALITY(text_of(found.at(0)), "Fluid / viscosity: 0.0035 -> 0.004");
}

TEUCHOS_UNIT_TEST(differences, know_what_has_come_and_what_has_gone) {
  const auto found = differences(list_of(list("media", number("c10", "3")) + number("old", "1")),
                                 list_of(number("new", "2") + list("more", number("k", "4"))));
  TEST_EQUALITY(found.size(), 4u);
  TEST_EQUALITY(text_of(found.at(0)), "media / c10: 3 -> none");
  TEST_EQUALITY(text_of(found.at(1)), "old: 1 -> none");
  TEST_EQUALITY(text_of(found.at(2)), "new: none -> 2");
  TEST_EQUALITY(text_of(found.at(3)), "more / k: none -> 4");
}

TEUCHOS_UNIT_TEST(differences, in_the_last_digit_count_and_long_values_are_cut_in_words_alone) {
  TEST_EQUALITY(
      differences(list_of(number("a", "0.1")), list_of(number("a", "0.10000000000000001"))).size(),
      0u);
  TEST_EQUALITY(
      differences(list_of(number("a", "0.1")), list_of(number("a", "0.10000000000000002"))).size(),
      1u);
  const Difference much{"values", std::string(500, '1'), "2"};
  TEST_COMPARE(text_of(much).size(), <, 100u);
}

}  // namespace
