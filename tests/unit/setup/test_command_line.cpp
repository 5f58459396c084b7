#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/setup/command_line.hpp"

namespace {

using namespace tunica::setup;

CommandLine parsed(std::vector<std::string> words, const std::string& program = "tunica-fsi") {
  words.insert(words.begin(), program);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  return parse(static_cast<int>(argv.size()), argv.data(), program, "does it");
}

std::string refusal(const std::vector<std::string>& words) {
  try {
    parsed(words);
  } catch (const tunica::Error& error) {
    return error.what();
  }
  return "";
}

TEUCHOS_UNIT_TEST(command_line, every_option_arrives) {
  const CommandLine line = parsed({"case.xml", "--output", "out", "--steps", "3", "--dry-run",
                                   "--set", "A/b=c", "--set", "D/e=f=g"});
  TEST_EQUALITY(line.case_file, "case.xml");
  TEST_EQUALITY(line.output, "out");
  TEST_EQUALITY(line.steps.value(), 3);
  TEST_ASSERT(line.dry_run && !line.help && !line.print_defaults && !line.reference);
  TEST_EQUALITY(line.set.size(), 2u);
  TEST_EQUALITY(line.set[1], "D/e=f=g");
}

TEUCHOS_UNIT_TEST(command_line, values_may_follow_an_equals_sign) {
  const CommandLine line = parsed({"--output=out", "--steps=3", "--set=A/b=c", "case.xml"});
  TEST_EQUALITY(line.output, "out");
  TEST_EQUALITY(line.steps.value(), 3);
  TEST_EQUALITY(line.set[0], "A/b=c");
}

TEUCHOS_UNIT_TEST(command_line, without_options_all_is_off) {
  const CommandLine line = parsed({"case.xml"});
  TEST_ASSERT(line.output.empty() && !line.steps && line.set.empty() && !line.dry_run);
}

TEUCHOS_UNIT_TEST(command_line, an_unknown_option_names_the_nearest) {
  TEST_EQUALITY(refusal({"case.xml", "--otput", "x"}),
                "unknown option \"--otput\". Did you mean \"--output\"?");
  TEST_ASSERT(refusal({"case.xml", "--colour"}).find("Valid: \"--output\"") != std::string::npos);
}

TEUCHOS_UNIT_TEST(command_line, restart_belongs_to_what_marches) {
  TEST_ASSERT(!parsed({"case.xml"}).restart);
  for (const char* program : {"tunica-fsi", "tunica-solid", "tunica-fluid"})
    TEST_ASSERT(parsed({"case.xml", "--restart"}, program).restart);
  TEST_THROW(parsed({"case.xml", "--restart"}, "tunica-solvers"), tunica::Error);
  TEST_ASSERT(!parsed({"case.xml", "--restart"}).allow_changes);
  TEST_ASSERT(parsed({"case.xml", "--restart", "--allow-changes"}).allow_changes);
  TEST_EQUALITY(refusal({"case.xml", "--allow-changes"}), "--allow-changes is for --restart");
}

TEUCHOS_UNIT_TEST(command_line, overwrite_belongs_to_what_solves_and_excludes_restart) {
  TEST_ASSERT(!parsed({"case.xml"}).overwrite);
  for (const char* program : {"tunica-fsi", "tunica-solid", "tunica-fluid", "tunica-solvers"})
    TEST_ASSERT(parsed({"case.xml", "--overwrite"}, program).overwrite);
  TEST_THROW(parsed({"case.xml", "--overwrite"}, "tunica-check"), tunica::Error);
  TEST_ASSERT(refusal({"case.xml", "--overwrite", "--restart"}).find("one of the two") !=
              std::string::npos);
}

TEUCHOS_UNIT_TEST(command_line, reference_belongs_to_tunica_check) {
  TEST_ASSERT(parsed({"--reference"}, "tunica-check").reference);
  TEST_ASSERT(!refusal({"case.xml", "--reference"}).empty());
}

TEUCHOS_UNIT_TEST(command_line, export_belongs_to_tunica_solvers) {
  TEST_EQUALITY(parsed({"case.xml", "--export", "DIR"}, "tunica-solvers").export_folder, "DIR");
  TEST_ASSERT(!refusal({"case.xml", "--export", "DIR"}).empty());
}

TEUCHOS_UNIT_TEST(command_line, a_missing_case_file_shows_the_usage) {
  const std::string message = refusal({"--dry-run"});
  TEST_ASSERT(message.rfind("the case file is missing", 0) == 0);
  TEST_ASSERT(message.find(usage("tunica-fsi", "does it")) != std::string::npos);
  TEST_ASSERT(parsed({"--help"}).help && parsed({"-h"}).help);
  TEST_ASSERT(parsed({"--print-defaults"}).print_defaults);
}

TEUCHOS_UNIT_TEST(command_line, options_without_their_value_are_refused) {
  TEST_EQUALITY(refusal({"case.xml", "--output"}),
                "--output lacks its value, expected --output DIR");
  TEST_EQUALITY(refusal({"case.xml", "--output", "--dry-run"}),
                "--output lacks its value, expected --output DIR");
  TEST_EQUALITY(refusal({"case.xml", "--dry-run=yes"}), "--dry-run takes no value");
}

TEUCHOS_UNIT_TEST(command_line, steps_are_a_positive_whole_number) {
  for (const char* text : {"0", "-1", "2.5", "many"})
    TEST_EQUALITY(refusal({"case.xml", "--steps", text}),
                  std::string("--steps is \"") + text + "\", expected a whole number > 0");
}

TEUCHOS_UNIT_TEST(command_line, a_matrix_and_its_right_side_make_a_case_of_tunica_solvers) {
  const CommandLine line = parsed({"K.mtx", "b.mtx", "--dry-run"}, "tunica-solvers");
  TEST_EQUALITY(line.case_file, "K.mtx");
  TEST_EQUALITY(line.right_side, "b.mtx");
  TEST_EQUALITY(parsed({"K.mtx"}, "tunica-solvers").right_side, "");
  const CommandLine with_settings = parsed({"K.mtx", "lists.xml", "b.mtx"}, "tunica-solvers");
  TEST_EQUALITY(with_settings.right_side, "b.mtx");
  TEST_EQUALITY(with_settings.settings, "lists.xml");
  TEST_THROW(parsed({"K.mtx", "a.xml", "b.xml"}, "tunica-solvers"), tunica::Error);
  TEST_THROW(parsed({"K.mtx", "b.mtx", "c.mtx"}, "tunica-solvers"), tunica::Error);
  TEST_THROW(parsed({"case.xml", "b.mtx"}, "tunica-solvers"), tunica::Error);
  TEST_THROW(parsed({"K.mtx"}), tunica::Error);
}

TEUCHOS_UNIT_TEST(command_line, two_case_files_are_one_too_many) {
  TEST_EQUALITY(refusal({"a.xml", "b.xml"}),
                "two case files, \"a.xml\" and \"b.xml\", expected one");
}

TEUCHOS_UNIT_TEST(command_line, usage_names_program_and_all_options) {
  const std::string text = usage("tunica-check", "checks a case");
  for (const char* part : {"tunica-check: checks a case", "CASE.xml", "--output DIR", "--steps N",
                           "--set", "--dry-run", "--print-defaults", "--help", "--reference"})
    TEST_ASSERT(text.find(part) != std::string::npos);
}

}  // namespace
