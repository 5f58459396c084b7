#include "tunica/params/differences.hpp"

#include "tunica/params/content.hpp"
#include "tunica/params/value.hpp"

namespace tunica::params {

namespace {

using Teuchos::ParameterList;

void compare(const ParameterList& before, const ParameterList& after, const std::string& path,
             std::vector<Difference>& found);

/// A parameter of that name, a list of it, or none.
std::string value_in(const ParameterList& list, const std::string& name) {
  const Teuchos::ParameterEntry* entry = list.getEntryPtr(name);
  return entry == nullptr || entry->isList() ? "none" : value_text(*entry);
}

ParameterList list_in(const ParameterList& list, const std::string& name) {
  return list.isSublist(name) ? list.sublist(name) : ParameterList(name);
}

void compare_entry(const ParameterList& before, const ParameterList& after, const std::string& name,
                   const std::string& path, std::vector<Difference>& found) {
  const std::string here = joined(path, name), was = value_in(before, name),
                    is = value_in(after, name);
  if (was != is) found.push_back({here, was, is});
  if (before.isSublist(name) || after.isSublist(name))
    compare(list_in(before, name), list_in(after, name), here, found);
}

void compare(const ParameterList& before, const ParameterList& after, const std::string& path,
             std::vector<Difference>& found) {
  for (auto it = before.begin(); it != before.end(); ++it)
    compare_entry(before, after, before.name(it), path, found);
  for (auto it = after.begin(); it != after.end(); ++it)
    if (before.getEntryPtr(after.name(it)) == nullptr)
      compare_entry(before, after, after.name(it), path, found);
}

/// As much as a line bears.
std::string shortened(const std::string& value) {
  constexpr std::size_t most = 60;
  return value.size() <= most ? value : value.substr(0, most - 10) + " ...";
}

}  // namespace

std::vector<Difference> differences(const ParameterList& before, const ParameterList& after) {
  std::vector<Difference> found;
  compare(before, after, "", found);
  return found;
}

std::string text_of(const Difference& difference) {
  return difference.path + ": " + shortened(difference.before) + " -> " +
         shortened(difference.after);
}

}  // namespace tunica::params
