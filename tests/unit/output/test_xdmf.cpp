#include <Teuchos_UnitTestHarness.hpp>
#include <filesystem>

#include "tunica/output/field_files.hpp"
#include "unit/output/field_run.hpp"

namespace tunica::output::test {

namespace {

/// A new one for each rank.
std::string own_folder(const std::string& name) {
  const std::string folder = scratch(name) + "/" + std::to_string(world()->getRank());
  std::filesystem::create_directories(folder);
  return folder;
}

/// Steps that a file names.
int n_steps(const std::string& path) { return count(content(path), "<Time Value="); }

}  // namespace

TEUCHOS_UNIT_TEST(xdmf, regions_have_names_whatever_is_in_them) {
  xdmf::Document document;
  document.add({0.5, {{"wall", 4, 1, {}, {"media", "a < \"b\" & c"}}, {"fluid", 4, 1, {}}}},
               "f.h5");
  const std::string path = own_folder("regions") + "/fields.xdmf";
  TEST_ASSERT(document.replace_version_3(path).is_success());
  const std::string text = content(path);
  const std::string legend =
      "<Information Name=\"region\" Value=\"0 media, 1 a &lt; &quot;b&quot; &amp; c\"/>";
  TEST_INEQUALITY(text.find(legend), std::string::npos);
  TEST_EQUALITY(text.find("<Information", text.find("Name=\"fluid\"")), std::string::npos);
}

// One file of all steps for each step would grow with the square of the run's length.
TEUCHOS_UNIT_TEST(xdmf, files_lag_behind_by_one_step_in_a_hundred_at_most) {
  const std::string folder = own_folder("lag");
  int n_replaced = 0, n_named = 0, most_behind = 0;
  {
    XdmfFiles files(folder);
    TEST_ASSERT(files.replace().is_success());
    for (int step = 1; step <= 1005; ++step) {
      files.add({0.1 * step, {{"wall", 4, 1, {}}}});
      TEST_ASSERT(files.replace_if_due().is_success());
      const int now = n_steps(folder + "/fields.xdmf");
      TEST_EQUALITY(n_steps(folder + "/fields.xdmf2"), now);
      TEST_COMPARE(100 * (step - now), <=, step);
      n_replaced += now != n_named;
      n_named = now;
      most_behind = std::max(most_behind, step - now);
    }
    TEST_COMPARE(n_replaced, <, 350);  // 100 (1 + ln 10)
    TEST_COMPARE(most_behind, >, 5);
    TEST_COMPARE(n_named, <, 1005);
  }
  TEST_EQUALITY(n_steps(folder + "/fields.xdmf"), 1005);
  TEST_EQUALITY(n_steps(folder + "/fields.xdmf2"), 1005);
}

}  // namespace tunica::output::test
