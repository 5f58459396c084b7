#include "tunica/params/known_keys.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <stdexcept>

#include "tunica/params/nearest.hpp"

namespace tunica::params {

void check_keys(const Teuchos::ParameterList& list, const std::vector<std::string>& known,
                const std::string& owner) {
  const std::string start = owner.empty() ? "" : owner + ": ";
  for (auto it = list.begin(); it != list.end(); ++it)
    if (std::find(known.begin(), known.end(), list.name(it)) == known.end())
      throw std::invalid_argument(start + "unknown key \"" + list.name(it) + "\". " +
                                  did_you_mean(list.name(it), known));
}

std::string complaint_about_parts(const Teuchos::ParameterList& fields,
                                  const std::vector<std::string>& of_system) {
  std::vector<std::string> covered;
  for (const auto& entry : fields)
    for (const std::string& part :
         fields.sublist(entry.first).get<Teuchos::Array<std::string>>("parts")) {
      if (std::find(of_system.begin(), of_system.end(), part) == of_system.end())
        return "Fields / " + entry.first + ": the system has no part \"" + part + "\"; it has " +
               quoted(of_system) + ".";
      covered.push_back(part);
    }
  for (const std::string& part : of_system)
    if (std::find(covered.begin(), covered.end(), part) == covered.end())
      return "no entry of \"Fields\" has the part \"" + part + "\".";
  return "";
}

}  // namespace tunica::params
