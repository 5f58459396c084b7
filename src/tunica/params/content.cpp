#include "tunica/params/content.hpp"

#include <cmath>

#include "tunica/params/value.hpp"

namespace tunica::params {

namespace {

void collect(const Table& table, const Teuchos::ParameterList& list, Active& result) {
  for (const Key& key : table.content().keys) {
    result.keys.push_back(&key);
    if (key.kind != Kind::variant) continue;
    const std::string value = chosen(key, list);
    bool is_found = false;
    for (std::size_t i = 0; i < key.options.size(); ++i) {
      if (key.options[i] != value) continue;
      collect(key.tables[i], list, result);
      is_found = true;
    }
    if (!is_found) result.is_certain = false;
  }
  for (const Table::Check& check : table.content().checks) result.checks.push_back(&check);
}

void collect(const Table& table, const std::vector<Owned::Condition>& conditions,
             std::vector<Owned>& result) {
  for (const Key& key : table.content().keys) {
    result.push_back({&key, conditions});
    if (key.kind != Kind::variant) continue;
    for (std::size_t i = 0; i < key.options.size(); ++i) {
      std::vector<Owned::Condition> inner = conditions;
      inner.push_back({&key, key.options[i]});
      collect(key.tables[i], inner, result);
    }
  }
}

}  // namespace

Active active(const Table& table, const Teuchos::ParameterList& list) {
  Active result;
  collect(table, list, result);
  return result;
}

std::vector<Owned> all_keys(const Table& table) {
  std::vector<Owned> result;
  collect(table, {}, result);
  return result;
}

std::string chosen(const Key& key, const Teuchos::ParameterList& list) {
  const Teuchos::ParameterEntry* entry = list.getEntryPtr(key.name);
  if (entry == nullptr) return key.is_required ? "" : value_text(key.fallback);
  return type_name(*entry) == "string" ? value_text(*entry) : "";
}

std::string xml_type(Kind kind) {
  switch (kind) {
    case Kind::number:
      return "double";
    case Kind::integer:
      return "int";
    case Kind::flag:
      return "bool";
    case Kind::numbers:
      return "Array(double)";
    case Kind::names:
      return "Array(string)";
    case Kind::text:
    case Kind::choice:
    case Kind::variant:
    case Kind::file:
      return "string";
    default:
      return "";
  }
}

std::string expected(const Key& key) {
  switch (key.kind) {
    case Kind::number:
      return "a number (double)";
    case Kind::integer:
      return "an integer (int)";
    case Kind::flag:
      return "true or false (bool)";
    case Kind::numbers:
      return "numbers (Array(double))";
    case Kind::names:
      return "names (Array(string))";
    case Kind::text:
      return "a text (string)";
    case Kind::choice:
    case Kind::variant:
      return "a choice (string)";
    case Kind::file:
      return "a file name (string)";
    default:
      return "a parameter list";
  }
}

std::string range_text(const Range& range) {
  const bool has_low = std::isfinite(range.low);
  const bool has_high = std::isfinite(range.high);
  if (has_low && has_high && !range.low_open && !range.high_open)
    return number_text(range.low) + ".." + number_text(range.high);
  std::string text;
  if (has_low) text = (range.low_open ? "> " : "≥ ") + number_text(range.low);
  if (has_low && has_high) text += " and ";
  if (has_high) text += (range.high_open ? "< " : "≤ ") + number_text(range.high);
  return text;
}

std::string joined(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + " / " + name;
}

std::string prefix(const std::string& path) { return path.empty() ? "" : path + ": "; }

}  // namespace tunica::params
