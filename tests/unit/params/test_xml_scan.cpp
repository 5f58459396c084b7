#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/params/xml_scan.hpp"

using tunica::params::deepest_list;
using tunica::params::line_of_lost_tag;
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

TEUCHOS_UNIT_TEST(xml_scan, the_line_of_the_first_list_too_deep_is_found) {
  TEST_EQUALITY(line_too_deep(nested(deepest_list)), 0);
  TEST_EQUALITY(line_too_deep(nested(deepest_list + 1)), deepest_list + 1);
  TEST_EQUALITY(line_too_deep(nested(20000)), deepest_list + 1);
}

TEUCHOS_UNIT_TEST(xml_scan, empty_elements_add_no_depth) {
  TEST_EQUALITY(
      line_too_deep(nested(deepest_list, "<ParameterList name=\"a/>b\" ></ParameterList>")),
      deepest_list + 1);
  TEST_EQUALITY(line_too_deep(nested(deepest_list - 1, "<Parameter name=\"a\" value=\"1>2\"/>")),
                0);
  TEST_EQUALITY(line_too_deep(nested(deepest_list, "<Parameter name='a' value='1>2'/>")), 0);
}

TEUCHOS_UNIT_TEST(xml_scan, comments_and_declarations_add_no_depth) {
  const std::string comment = "<!-- " + nested(deepest_list) + " it's -->";
  TEST_EQUALITY(line_too_deep("<?xml version=\"1.0\"?>" + nested(deepest_list, comment)), 0);
}

TEUCHOS_UNIT_TEST(xml_scan, neighbours_add_no_depth) {
  std::string text;
  for (int i = 0; i < 3; ++i) text += nested(deepest_list - 1);
  TEST_EQUALITY(line_too_deep("<ParameterList>" + text + "</ParameterList>"), 0);
}

TEUCHOS_UNIT_TEST(xml_scan, what_is_no_xml_is_left_to_the_parser) {
  for (const char* text : {"", "text", "<", "<!--", "</a></a>", "<a b=\"", "1 < 2"})
    TEST_EQUALITY(line_too_deep(text), 0);
}

TEUCHOS_UNIT_TEST(xml_scan, finds_the_line_of_a_tag_without_its_beginning) {
  TEST_EQUALITY(line_of_lost_tag("<a>\n<b x=\"1 > 0\"/>\n b x='2'/>\n</a>"), 3);
  TEST_EQUALITY(line_of_lost_tag("<a>\n</a>\n\nvalue=\"1\"/>\n"), 4);
  TEST_EQUALITY(line_of_lost_tag("ParameterList><a/>"), 1);
}

TEUCHOS_UNIT_TEST(xml_scan, takes_no_sentence_for_a_lost_tag) {
  TEST_EQUALITY(line_of_lost_tag("\xEF\xBB\xBF<?xml version='1.0'?>\n<!-- a=\"b\"/>, \"c -->\r\n"
                                 "<a>\t<b x='>'/> with \"a\" = \"b\", > 0 and 1</a>\n"),
                0);
  TEST_EQUALITY(line_of_lost_tag(""), 0);
  TEST_EQUALITY(line_of_lost_tag("<a"), 0);
}

}  // namespace
