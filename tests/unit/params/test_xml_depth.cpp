#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/params/xml_depth.hpp"

using tunica::params::deepest_list;
using tunica::params::line_too_deep;

namespace {

/// One list within the other, each in a line of its own.
std::string nested(int depth, const std::string& innermost = "") {
  std::string text;
  for (int i = 0; i < depth; ++i) text += "<ParameterList name=\"a\">\n";
  text += innermost;
  for (int i = 0; i < depth; ++i) text += "</ParameterList>\n";
  return text;
}

TEUCHOS_UNIT_TEST(xml_depth, the_line_of_the_first_list_too_deep_is_found) {
  TEST_EQUALITY(line_too_deep(nested(deepest_list)), 0);
  TEST_EQUALITY(line_too_deep(nested(deepest_list + 1)), deepest_list + 1);
  TEST_EQUALITY(line_too_deep(nested(20000)), deepest_list + 1);
}

TEUCHOS_UNIT_TEST(xml_depth, empty_elements_add_no_depth) {
  TEST_EQUALITY(
      line_too_deep(nested(deepest_list, "<ParameterList name=\"a/>b\" ></ParameterList>")),
      deepest_list + 1);
  TEST_EQUALITY(line_too_deep(nested(deepest_list - 1, "<Parameter name=\"a\" value=\"1>2\"/>")),
                0);
  TEST_EQUALITY(line_too_deep(nested(deepest_list, "<Parameter name='a' value='1>2'/>")), 0);
}

TEUCHOS_UNIT_TEST(xml_depth, comments_and_declarations_add_no_depth) {
  const std::string comment = "<!-- " + nested(deepest_list) + " it's -->";
  TEST_EQUALITY(line_too_deep("<?xml version=\"1.0\"?>" + nested(deepest_list, comment)), 0);
}

TEUCHOS_UNIT_TEST(xml_depth, neighbours_add_no_depth) {
  std::string text;
  for (int i = 0; i < 3; ++i) text += nested(deepest_list - 1);
  TEST_EQUALITY(line_too_deep("<ParameterList>" + text + "</ParameterList>"), 0);
}

TEUCHOS_UNIT_TEST(xml_depth, what_is_no_xml_is_left_to_the_parser) {
  for (const char* text : {"", "text", "<", "<!--", "</a></a>", "<a b=\"", "1 < 2"})
    TEST_EQUALITY(line_too_deep(text), 0);
}

}  // namespace
