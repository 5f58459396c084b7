#include <Teuchos_Array.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <sstream>

#include "tunica/params/read_xml.hpp"
#include "unit/params/example.hpp"

namespace {

using namespace tunica::params;
using namespace tunica::params::test;
using Teuchos::ParameterList;

std::string read_message(const Folder& folder, const std::string& inside) {
  const std::string path =
      folder.file("case.xml", "<ParameterList name=\"Case\">\n" + inside + "\n</ParameterList>\n");
  const std::string message = message_of([&] { read_xml(path); });
  const bool names_file = message.rfind(path + ": ", 0) == 0;
  return names_file ? message.substr(path.size() + 2) : message;
}

TEUCHOS_UNIT_TEST(read_xml, every_type_is_read) {
  const Folder folder;
  const std::string path = folder.file("case.xml", R"x(<?xml version="1.0"?>
    <!-- µ ≥ 0 -->
    <ParameterList name="Case">
      <Parameter name="d" type="double" value="1e-3"/>
      <Parameter name="i" type="int" value="-3"/>
      <Parameter name="b" type="bool" value="true"/>
      <Parameter name="s" type="string" value="a &lt; &quot;b&quot;"/>
      <ParameterList name="L">
        <Parameter name="v" type="Array(double)" value="{1, 2.5}"/>
        <Parameter name="n" type="Array(string)" value="{in let, outlet}"/>
        <Parameter name="f" type="float" value="0.5"/>
      </ParameterList>
    </ParameterList>)x");
  const ParameterList list = read_xml(path);
  TEST_EQUALITY(list.name(), "Case");
  TEST_EQUALITY(list.get<double>("d"), 1e-3);
  TEST_EQUALITY(list.get<int>("i"), -3);
  TEST_EQUALITY(list.get<bool>("b"), true);
  TEST_EQUALITY(list.get<std::string>("s"), "a < \"b\"");
  TEST_EQUALITY(list.sublist("L").get<Teuchos::Array<double>>("v")[1], 2.5);
  TEST_EQUALITY(list.sublist("L").get<Teuchos::Array<std::string>>("n")[0], "in let");
  TEST_EQUALITY(list.sublist("L").get<float>("f"), 0.5f);
}

TEUCHOS_UNIT_TEST(read_xml, a_byte_order_mark_is_passed_over) {
  const Folder folder;
  const std::string text = "<?xml version=\"1.0\"?>\r\n<ParameterList name=\"Case\"/>\r\n";
  TEST_EQUALITY(read_xml(folder.file("case.xml", "\xef\xbb\xbf" + text)).name(), "Case");
  const std::string wide = folder.file("wide.xml", std::string("\xff\xfe<\0", 4));
  TEST_ASSERT(message_of([&] { read_xml(wide); }).find("expected UTF-8") != std::string::npos);
}

TEUCHOS_UNIT_TEST(read_xml, a_missing_file_is_named) {
  TEST_EQUALITY(message_of([] { read_xml("/nowhere/case.xml"); }),
                "/nowhere/case.xml: there is no such file");
}

TEUCHOS_UNIT_TEST(read_xml, malformed_xml_is_told_with_its_line) {
  const Folder folder;
  TEST_EQUALITY(read_message(folder, "<Parameter name=\"a\" type=int/>"),
                "not well-formed XML: line 2: attribute value must be quoted with either ''' or "
                "'\"'");
}

TEUCHOS_UNIT_TEST(read_xml, an_empty_file_is_an_error) {
  const Folder folder;
  const std::string path = folder.file("empty.xml", " \n");
  TEST_EQUALITY(message_of([&] { read_xml(path); }),
                path + ": the file is empty, expected a <ParameterList>");
}

TEUCHOS_UNIT_TEST(read_xml, a_name_must_not_occur_twice) {
  const Folder folder;
  TEST_EQUALITY(read_message(folder, R"x(<ParameterList name="A">
      <Parameter name="x" type="int" value="1"/><Parameter name="x" type="int" value="2"/>
      </ParameterList>)x"),
                "A: \"x\" occurs twice; keep one");
  TEST_EQUALITY(read_message(folder, R"x(<ParameterList name="A"/><ParameterList name="A"/>)x"),
                "\"A\" occurs twice; keep one");
}

TEUCHOS_UNIT_TEST(read_xml, a_value_must_wholly_be_of_its_type) {
  const Folder folder;
  TEST_EQUALITY(read_message(folder, R"x(<Parameter name="x" type="double" value="1,5"/>)x"),
                "\"x\" is \"1,5\", which is no double");
  TEST_EQUALITY(read_message(folder, R"x(<Parameter name="x" type="int" value="1.5"/>)x"),
                "\"x\" is \"1.5\", which is no int");
  TEST_EQUALITY(read_message(folder, R"x(<Parameter name="x" type="bool" value="maybe"/>)x"),
                "\"x\" is \"maybe\", which is no bool");
  TEST_EQUALITY(
      read_message(folder, R"x(<Parameter name="x" type="Array(double)" value="{1,b}"/>)x"),
      "\"x\" is \"{1,b}\", which is no Array(double)");
}

TEUCHOS_UNIT_TEST(read_xml, unknown_elements_types_and_missing_attributes_are_errors) {
  const Folder folder;
  TEST_EQUALITY(read_message(folder, "<Paramater name=\"x\"/>"),
                "unknown element <Paramater>, expected <ParameterList> or <Parameter>");
  TEST_EQUALITY(read_message(folder, R"x(<Parameter name="x" type="doubel" value="1"/>)x"),
                "\"x\" has the unknown type \"doubel\" or a value \"1\" that does not fit. "
                "Did you mean \"double\"?");
  TEST_EQUALITY(read_message(folder, R"x(<Parameter name="x" type="int"/>)x"),
                "a <Parameter> named \"x\" has no attribute value");
}

TEUCHOS_UNIT_TEST(to_xml, its_text_reads_back_to_the_last_bit) {
  const Folder folder;
  ParameterList list("Case");
  list.set("third", 1.0 / 3.0);
  list.set("text", "a & b < \"c\" 'd'");
  list.set("many", 5LL);
  list.set("ratio", 0.5f);
  list.sublist("A").sublist("B").set("v", array<double>({1.0 / 3.0, 1e300, -0.1}));
  list.sublist("A").set("n", array<std::string>({"x y", "z"}));
  list.sublist("A").set("none", Teuchos::Array<int>());
  const ParameterList again = read_xml(folder.file("out.xml", to_xml(list)));
  TEST_ASSERT(Teuchos::haveSameValues(list, again, true));
  TEST_EQUALITY(again.name(), "Case");
}

TEUCHOS_UNIT_TEST(to_xml, leaves_entries_unused) {
  ParameterList list("Case");
  list.sublist("MueLu").setEntry("x", Teuchos::ParameterEntry(1));
  TEST_ASSERT(!to_xml(list).empty());
  TEST_ASSERT(!list.sublist("MueLu").getEntry("x").isUsed());
}

TEUCHOS_UNIT_TEST(print_xml, printed_defaults_read_back_as_the_resolved_empty_list) {
  const Folder folder;
  std::ostringstream text;
  case_table().print_xml(text, "Case");
  ParameterList printed = read_xml(folder.file("defaults.xml", text.str()));
  TEST_ASSERT(printed.sublist("Fluid").isParameter("density"));
  case_table().resolve(printed, "", folder.path());
  ParameterList empty;
  case_table().resolve(empty, "", folder.path());
  TEST_ASSERT(Teuchos::haveSameValuesSorted(empty, printed, true));
}

TEUCHOS_UNIT_TEST(print_xml, comments_tell_sentence_unit_and_range) {
  std::ostringstream text;
  fluid_table().print_xml(text, "Fluid");
  TEST_ASSERT(text.str().find("<!-- Mass per volume [mg/mm³], > 0 -->\n"
                              "  <Parameter name=\"density\" type=\"double\" value=\"1.05\"/>") !=
              std::string::npos);
}

TEUCHOS_UNIT_TEST(print_xml, required_keys_are_marked_and_commented_out) {
  const Folder folder;
  const Table table = Table("Clock").number("end", std::nullopt, positive(), "ms", "End.");
  std::ostringstream text;
  table.print_xml(text, "Time");
  TEST_ASSERT(text.str().find("<!-- REQUIRED. End [ms], > 0\n") != std::string::npos);
  const ParameterList printed = read_xml(folder.file("defaults.xml", text.str()));
  TEST_EQUALITY(printed.numParams(), 0);
}

TEUCHOS_UNIT_TEST(print_xml, entries_and_other_cases_are_examples_in_comments) {
  std::ostringstream text;
  fluid_table().print_xml(text, "Fluid");
  TEST_ASSERT(text.str().find("<ParameterList name=\"a free name\">") != std::string::npos);
  TEST_ASSERT(text.str().find("with \"condition\" = \"traction\":") != std::string::npos);
}

TEUCHOS_UNIT_TEST(print_xml, comments_hold_no_double_dash) {
  std::ostringstream text;
  Table().entries("Any", case_table(), "Any -- thing.").print_xml(text, "Case");
  std::string rest = text.str();
  for (const std::string mark : {"<!--", "-->"})
    for (std::size_t at = rest.find(mark); at != std::string::npos; at = rest.find(mark))
      rest.erase(at, mark.size());
  TEST_EQUALITY(rest.find("--"), std::string::npos);
}

TEUCHOS_UNIT_TEST(print_xml, an_example_taken_out_of_its_comment_is_valid) {
  const Folder folder;
  std::ostringstream text;
  Table().entries("Surfaces", surface_table(), "Boundaries.").print_xml(text, "Case");
  std::string example = text.str();
  for (const std::string mark : {"<!--", "-->"})
    for (std::size_t at = example.find(mark); at != std::string::npos; at = example.find(mark))
      example.erase(at, mark.size());
  const ParameterList list = read_xml(folder.file("example.xml", example));
  const ParameterList& surface = list.sublist("Surfaces").sublist("a free name");
  TEST_EQUALITY(surface.get<double>("backflow stabilisation"), 0.2);
}

TEUCHOS_UNIT_TEST(print_markdown, each_key_is_one_row) {
  std::ostringstream text;
  case_table().print_markdown(text, "Case");
  const auto has = [&](const std::string& row) {
    return text.str().find(row) != std::string::npos;
  };
  TEST_ASSERT(has("## Case / Fluid\nIncompressible fluid\n\n| key | type | default |"));
  TEST_ASSERT(has("| `density` | double | `1.05` | > 0 [mg/mm³] | Mass per volume. |\n"));
  TEST_ASSERT(has("| `scheme` | choice | `implicit Euler` | \"implicit Euler\", \"BDF2\" |"));
  TEST_ASSERT(has("| `restart` | file | none |"));
  TEST_ASSERT(has("## Case / Fluid / Surfaces / (any name), `condition` = `traction`\n"));
  TEST_ASSERT(!has("viscosity mu"));
}

TEUCHOS_UNIT_TEST(print_reference, what_stands_at_two_places_is_printed_once) {
  const auto solver = [](double tolerance) {
    Table table("Solves.");
    table.number("tolerance", tolerance, positive(), "1", "of the residual")
        .integer("most", 100, any(), "iterations");
    return table;
  };
  Table first("First."), second("Second.");
  first.sublist("Solver", solver(0.1)).sublist("Finer Solver", solver(0.01));
  second.sublist("Solver", solver(0.1));
  std::ostringstream text;
  print_reference(text, {{"First", &first}, {"Second", &second}});
  const auto count = [&](const std::string& words) {
    int found = 0;
    for (auto at = text.str().find(words); at != std::string::npos;
         at = text.str().find(words, at + 1))
      ++found;
    return found;
  };
  TEST_EQUALITY(count("| `most` |"), 1);
  TEST_EQUALITY(
      count("Keys as [First / Solver](#first--solver), but by default `tolerance` = `0.01`."), 1);
  TEST_EQUALITY(count("| `Solver` | list |  |  | Solves. As [First / Solver](#first--solver). |"),
                1);
  TEST_EQUALITY(count("## Second / Solver"), 0);
}

TEUCHOS_UNIT_TEST(read_xml, a_parameter_whose_first_character_is_lost_is_refused_with_its_line) {
  const Folder folder;
  TEST_EQUALITY(read_message(folder, "Parameter name=\"a\" type=\"int\" value=\"1\"/>")
                    .find("at line 2 there is a part of a tag"),
                0u);
}

}  // namespace
