#include "tunica/stepping/wall_limit.hpp"

#include <limits>
#include <regex>

#include "tunica/base/error.hpp"

namespace tunica::stepping {

double seconds_of(const std::string& text) {
  static const std::regex parts("(?:(?:([0-9]{1,9}):)?([0-5]?[0-9]):)?([0-9]{1,9}(?:\\.[0-9]*)?)");
  if (text.empty()) return std::numeric_limits<double>::infinity();
  std::smatch found;
  const bool is_time = std::regex_match(text, found, parts);
  const auto number = [&](int part) { return found[part].matched ? std::stod(found[part]) : 0.0; };
  const double seconds = is_time ? 3600.0 * number(1) + 60.0 * number(2) + number(3) : 0.0;
  const bool has_minutes = is_time && found[2].matched;
  TUNICA_CHECK(seconds > 0.0 && (!has_minutes || number(3) < 60.0),
               "\"wall limit\" is \"" + text + "\", expected seconds > 0 or h:mm:ss");
  return seconds;
}

void add_wall_limit(params::Table& time) {
  time.text("wall limit", "",
            "seconds or h:mm:ss from the start of the program: no step is begun that would end "
            "later, judging by the last one; the run then writes a checkpoint and stops with exit "
            "status 5; empty: none")
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        try {
          seconds_of(list.get<std::string>("wall limit"));
        } catch (const Error& error) {
          throw Error(path + ": " + error.what());
        }
      });
}

}  // namespace tunica::stepping
