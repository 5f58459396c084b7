#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/params/check_value.hpp"
#include "tunica/params/content.hpp"
#include "tunica/params/nearest.hpp"

namespace tunica::params {

namespace {

using Teuchos::ParameterList;

/// Walks list and table together and collects what is wrong.
class Resolver {
public:
  explicit Resolver(std::string directory) : directory_(std::move(directory)) {}

  void visit(const Table& table, ParameterList& list, const std::string& path);
  const std::vector<std::string>& problems() const { return problems_; }

private:
  /// Returns the valid keys that unknown ones were probably meant to be.
  std::vector<std::string> reject_strangers(const Table& table, const Active& valid,
                                            const ParameterList& list, const std::string& path);
  void visit_key(const Key& key, ParameterList& list, const std::string& path);
  void visit_value(const Key& key, ParameterList& list, const std::string& path);
  void visit_entries(const Key& key, ParameterList& list, const std::string& path);
  void visit_foreign(const Key& key, ParameterList& list, const std::string& path);
  void complain(const std::string& path, const std::string& what) {
    problems_.push_back(prefix(path) + what);
  }

  std::string directory_;
  std::vector<std::string> problems_;
};

std::vector<std::string> names_of(const ParameterList& list) {
  std::vector<std::string> names;
  for (auto it = list.begin(); it != list.end(); ++it) names.push_back(list.name(it));
  return names;
}

/// Conditions on the way to a key that the list does not meet.
std::vector<const Owned::Condition*> unmet(const Owned& owned, const ParameterList& list) {
  std::vector<const Owned::Condition*> conditions;
  for (const Owned::Condition& condition : owned.conditions)
    if (chosen(*condition.variant, list) != condition.value) conditions.push_back(&condition);
  return conditions;
}

/// `"condition" = "traction" or "pressure", but it is "velocity"` if only cases that are not
/// chosen have a key of that name; "" if none has. Of nested cases the nearest to the choice.
std::string owners(const std::vector<Owned>& all, const std::string& name,
                   const ParameterList& list) {
  std::vector<std::vector<const Owned::Condition*>> candidates;
  for (const Owned& owned : all)
    if (owned.key->name == name) candidates.push_back(unmet(owned, list));
  const auto nearest_one =
      std::min_element(candidates.begin(), candidates.end(),
                       [](const auto& a, const auto& b) { return a.size() < b.size(); });
  if (nearest_one == candidates.end() || nearest_one->empty()) return "";
  const std::size_t distance = nearest_one->size();
  const Key* variant = nearest_one->front()->variant;
  std::vector<std::string> values;
  for (const auto& conditions : candidates) {
    if (conditions.size() != distance || conditions.front()->variant->name != variant->name)
      continue;
    const std::string& value = conditions.front()->value;
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  std::string text = "\"" + variant->name + "\" = ";
  for (std::size_t i = 0; i < values.size(); ++i)
    text += (i == 0 ? "\"" : " or \"") + values[i] + "\"";
  return text + ", but it is \"" + chosen(*variant, list) + "\"";
}

/// `a number (double) > 0 [ms]`
std::string wanted(const Key& key) {
  const std::string range = range_text(key.range);
  std::string text = expected(key);
  if (!range.empty()) text += " " + range;
  if (!key.unit.empty()) text += " [" + key.unit + "]";
  if (!key.options.empty()) text += ": one of " + quoted(key.options);
  return text;
}

void Resolver::visit(const Table& table, ParameterList& list, const std::string& path) {
  const std::size_t before = problems_.size();
  const Active valid = active(table, list);
  const std::vector<std::string> meant = reject_strangers(table, valid, list, path);
  for (const Key* key : valid.keys) {
    // A required key that is there, but misspelled, is not missing as well.
    const bool is_misspelled = key->is_required && list.getEntryPtr(key->name) == nullptr &&
                               std::count(meant.begin(), meant.end(), key->name) > 0;
    if (!is_misspelled) visit_key(*key, list, path);
  }
  if (problems_.size() > before) return;
  for (const Table::Check* check : valid.checks) {
    try {
      (*check)(list, path);
    } catch (const Error& error) {
      problems_.push_back(error.what());
    }
  }
}

std::vector<std::string> Resolver::reject_strangers(const Table& table, const Active& valid,
                                                    const ParameterList& list,
                                                    const std::string& path) {
  const std::vector<Owned> all = all_keys(table);
  std::vector<std::string> valid_names, all_names, meant;
  for (const Key* key : valid.keys)
    if (key->kind != Kind::removed) valid_names.push_back(key->name);
  for (const Owned& owned : all)
    if (owned.key->kind != Kind::removed) all_names.push_back(owned.key->name);

  for (const std::string& name : names_of(list)) {
    const auto has_name = [&](const Key* key) { return key->name == name; };
    if (std::any_of(valid.keys.begin(), valid.keys.end(), has_name)) continue;
    const std::string conditions = owners(all, name, list);
    if (conditions.empty()) {
      meant.push_back(nearest(name, valid_names));
      const bool is_near = !meant.back().empty();
      const bool is_near_elsewhere = !is_near && !nearest(name, all_names).empty();
      complain(path, "unknown key \"" + name + "\". " +
                         did_you_mean(name, is_near_elsewhere ? all_names : valid_names));
    } else if (valid.is_certain) {
      complain(path, "\"" + name + "\" belongs to " + conditions);
    }
  }
  return meant;
}

void Resolver::visit_key(const Key& key, ParameterList& list, const std::string& path) {
  const bool is_value = !xml_type(key.kind).empty();
  if (is_value) return visit_value(key, list, path);
  const Teuchos::ParameterEntry* entry = list.getEntryPtr(key.name);
  if (key.kind == Kind::removed) {
    if (entry != nullptr)
      complain(path, "\"" + key.name + "\" no longer exists; use \"" + key.successor + "\"");
    return;
  }
  if (entry != nullptr && !entry->isList())
    return complain(path, "\"" + key.name + "\" is a parameter, expected a parameter list");
  if (key.kind == Kind::sublist)
    visit(key.tables[0], list.sublist(key.name), joined(path, key.name));
  if (key.kind == Kind::entries) visit_entries(key, list, path);
  if (key.kind == Kind::foreign) visit_foreign(key, list, path);
}

void Resolver::visit_value(const Key& key, ParameterList& list, const std::string& path) {
  if (list.getEntryPtr(key.name) == nullptr) {
    if (key.is_required)
      return complain(
          path, "\"" + key.name + "\" is missing, expected " + wanted(key) + ". " + key.sentence);
    list.setEntry(key.name, key.fallback);
  }
  const std::string problem = check_value(key, list, directory_);
  if (!problem.empty()) complain(path, problem);
}

void Resolver::visit_entries(const Key& key, ParameterList& list, const std::string& path) {
  ParameterList& entries = list.sublist(key.name);
  const std::string inside = joined(path, key.name);
  for (const std::string& name : names_of(entries)) {
    if (entries.isSublist(name))
      visit(key.tables[0], entries.sublist(name), joined(inside, name));
    else
      complain(inside, "\"" + name + "\" is a parameter, expected parameter lists only");
  }
}

void Resolver::visit_foreign(const Key& key, ParameterList& list, const std::string& path) {
  if (!list.isSublist(key.name)) list.set(key.name, key.foreign);
  const std::string problem = check_foreign(key, list.sublist(key.name), joined(path, key.name));
  if (!problem.empty()) problems_.push_back(problem);
}

}  // namespace

void Table::resolve(ParameterList& list, const std::string& path,
                    const std::string& directory) const {
  Resolver resolver(directory);
  resolver.visit(*this, list, path);
  const std::vector<std::string>& problems = resolver.problems();
  if (problems.empty()) return;
  constexpr std::size_t shown = 10;
  std::string message;
  for (std::size_t i = 0; i < std::min(shown, problems.size()); ++i)
    message += (i == 0 ? "" : "\n") + problems[i];
  if (problems.size() > shown)
    message += "\n... and " + std::to_string(problems.size() - shown) + " more";
  throw Error(message);
}

}  // namespace tunica::params
