#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/output/xdmf.hpp"

namespace tunica::output {

TEUCHOS_UNIT_TEST(xdmf, regions_have_names_whatever_is_in_them) {
  const std::string text = xdmf::step(
      0.5, {{"wall", 4, 1, {}, {"media", "a < \"b\" & c"}}, {"fluid", 4, 1, {}}}, "f.h5");
  const std::string legend =
      "<Information Name=\"region\" Value=\"0 media, 1 a &lt; &quot;b&quot; &amp; c\"/>";
  TEST_INEQUALITY(text.find(legend), std::string::npos);
  TEST_EQUALITY(text.find("<Information", text.find("Name=\"fluid\"")), std::string::npos);
}

}  // namespace tunica::output
