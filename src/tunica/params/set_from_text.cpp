#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/params/content.hpp"
#include "tunica/params/nearest.hpp"
#include "tunica/params/read_xml.hpp"
#include "tunica/params/value.hpp"

namespace tunica::params {

namespace {

using Teuchos::ParameterList;

/// Follows the names of a path through table and list, and sets the value at its end.
class Setter {
public:
  explicit Setter(const std::string& assignment);
  void set(ParameterList& list, const Table& table);

private:
  const Key& find(const ParameterList& list, const Table& table) const;
  void set_value(ParameterList& list, const Key& key);
  void set_in_entries(ParameterList& list, const Key& key);
  void set_foreign(ParameterList& list, const ParameterList& valid);

  bool is_last() const { return at_ + 1 == names_.size(); }
  const std::string& name() const { return names_[at_]; }
  std::string quoted_name() const { return "\"" + name() + "\""; }
  void descend(const std::string& needed);
  [[noreturn]] void fail(const std::string& what) const;

  std::string assignment_;
  std::vector<std::string> names_;
  std::string value_;
  std::size_t at_ = 0;
};

Setter::Setter(const std::string& assignment) : assignment_(assignment) {
  const std::size_t equal = assignment.find('=');
  if (equal == std::string::npos) fail("expected \"List/key=value\"");
  value_ = trimmed(assignment.substr(equal + 1));
  std::string rest = assignment.substr(0, equal);
  for (std::size_t slash = rest.find('/'); slash != std::string::npos; slash = rest.find('/')) {
    names_.push_back(trimmed(rest.substr(0, slash)));
    rest = rest.substr(slash + 1);
  }
  names_.push_back(trimmed(rest));
  for (const std::string& one : names_)
    if (one.empty()) fail("a name is empty, expected \"List/key=value\"");
}

void Setter::fail(const std::string& what) const {
  std::string path;
  for (std::size_t i = 0; i < at_; ++i) path = joined(path, names_[i]);
  throw Error("--set \"" + assignment_ + "\": " + prefix(path) + what);
}

/// One name further; needed: what the list that was just named wants after it.
void Setter::descend(const std::string& needed) {
  if (is_last()) fail(quoted_name() + " is a list; name " + needed);
  ++at_;
}

/// The key of that name: of the chosen cases if they have it, otherwise of any case.
const Key& Setter::find(const ParameterList& list, const Table& table) const {
  std::vector<std::string> valid;
  for (const Key* key : active(table, list).keys)
    if (key->name == name() && key->kind != Kind::removed) return *key;
  for (const Owned& owned : all_keys(table)) {
    if (owned.key->kind == Kind::removed) {
      if (owned.key->name == name())
        fail(quoted_name() + " no longer exists; use \"" + owned.key->successor + "\"");
      continue;
    }
    if (owned.key->name == name()) return *owned.key;
    if (std::find(valid.begin(), valid.end(), owned.key->name) == valid.end())
      valid.push_back(owned.key->name);
  }
  fail("unknown key " + quoted_name() + ". " + did_you_mean(name(), valid));
}

void Setter::set(ParameterList& list, const Table& table) {
  const Key& key = find(list, table);
  if (!xml_type(key.kind).empty()) return set_value(list, key);
  const bool is_wrong = list.isParameter(key.name) && !list.isSublist(key.name);
  if (is_wrong) fail(quoted_name() + " is a parameter in the file, expected a list");
  if (key.kind == Kind::sublist) {
    descend("a key in it");
    return set(list.sublist(key.name), key.tables[0]);
  }
  if (key.kind == Kind::entries) return set_in_entries(list.sublist(key.name), key);
  if (!list.isSublist(key.name)) list.set(key.name, key.foreign);
  descend("a key in it");
  set_foreign(list.sublist(key.name), key.valid);
}

void Setter::set_value(ParameterList& list, const Key& key) {
  if (!is_last()) fail(quoted_name() + " is a parameter, not a list");
  const auto value = parse_value(xml_type(key.kind), value_);
  if (!value) fail(quoted_name() + " cannot be \"" + value_ + "\", expected " + expected(key));
  list.setEntry(key.name, *value);
}

void Setter::set_in_entries(ParameterList& list, const Key& key) {
  descend("an entry and a key in it");
  std::vector<std::string> present;
  for (auto it = list.begin(); it != list.end(); ++it) present.push_back(list.name(it));
  const std::string near = list.isSublist(name()) ? "" : nearest(name(), present);
  if (!near.empty())
    fail("there is no " + quoted_name() + " in the file. Did you mean \"" + near + "\"?");
  const std::string entry = name();
  descend("a key in it");
  set(list.sublist(entry), key.tables[0]);
}

/// The type of a value of which nothing is known but its text.
Teuchos::ParameterEntry guess(const std::string& text) {
  const bool is_word = text == "true" || text == "false";
  if (is_word) return *parse_value("bool", text);
  const bool is_array = !text.empty() && text.front() == '{';
  const std::vector<std::string> order =
      is_array ? std::vector<std::string>{"Array(int)", "Array(double)", "Array(string)"}
               : std::vector<std::string>{"int", "double"};
  for (const std::string& type : order)
    if (const auto value = parse_value(type, text)) return *value;
  return Teuchos::ParameterEntry(text);
}

void Setter::set_foreign(ParameterList& list, const ParameterList& valid) {
  const bool is_declared = valid.numParams() > 0;
  if (is_declared && !valid.isParameter(name())) {
    std::vector<std::string> names;
    for (auto it = valid.begin(); it != valid.end(); ++it) names.push_back(valid.name(it));
    fail("unknown key " + quoted_name() + ". " + did_you_mean(name(), names));
  }
  if (!is_last()) {
    const bool goes_on = is_declared && valid.isSublist(name());
    const std::string inner = name();
    if (list.isParameter(inner) && !list.isSublist(inner))
      fail(quoted_name() + " is a parameter, not a list");
    ++at_;
    return set_foreign(list.sublist(inner), goes_on ? valid.sublist(inner) : ParameterList());
  }
  const Teuchos::ParameterEntry* known = list.getEntryPtr(name());
  if (known == nullptr) known = valid.getEntryPtr(name());
  if (known != nullptr && known->isList()) fail(quoted_name() + " is a list; name a key in it");
  const std::string type = known == nullptr ? "" : type_name(*known);
  const auto value = type.empty() ? guess(value_) : parse_value(type, value_);
  if (!value)
    fail(quoted_name() + " cannot be \"" + value_ + "\", expected a value of type " + type);
  list.setEntry(name(), *value);
}

}  // namespace

void set_from_text(ParameterList& list, const Table& table, const std::string& assignment) {
  Setter(assignment).set(list, table);
}

}  // namespace tunica::params
