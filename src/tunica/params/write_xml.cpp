#include <filesystem>
#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/params/read_xml.hpp"
#include "tunica/params/xml_text.hpp"

namespace tunica::params {

void write_xml(const Teuchos::ParameterList& list, const std::string& path) {
  const std::string unfinished = path + ".part";
  std::ofstream file(unfinished);
  TUNICA_CHECK(file.good(), path + ": cannot be written. Does its folder exist, may you write?");
  print_list(file, list, list.name(), 0);
  file.close();
  if (!file) throw std::runtime_error(path + ": writing failed; is the disk full?");
  std::filesystem::rename(unfinished, path);
}

}  // namespace tunica::params
