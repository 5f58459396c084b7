#include "tunica/params/check_value.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tunica/base/out_of_memory.hpp"
#include "tunica/params/nearest.hpp"
#include "tunica/params/value.hpp"

namespace tunica::params {

namespace {

using Teuchos::ParameterList;

std::string quote(const std::string& name) { return "\"" + name + "\""; }

std::string with_unit(const std::string& value, const Key& key) {
  const bool is_pure = key.unit.empty() || key.unit == "1";
  return is_pure ? value : value + " " + key.unit;
}

/// Integers where numbers are expected are fine.
void widen(const Key& key, ParameterList& list) {
  const std::string type = type_name(*list.getEntryPtr(key.name));
  if (key.kind == Kind::number && type == "int")
    list.set(key.name, static_cast<double>(list.get<int>(key.name)));
  if (key.kind == Kind::numbers && type == "Array(int)") {
    const Teuchos::Array<int> values = list.get<Teuchos::Array<int>>(key.name);
    list.set(key.name, Teuchos::Array<double>(values.begin(), values.end()));
  }
}

bool is_inside(double value, const Range& range) {
  if (!std::isfinite(value)) return false;
  return (range.low_open ? value > range.low : value >= range.low) &&
         (range.high_open ? value < range.high : value <= range.high);
}

std::string permitted(const Range& range) {
  const std::string text = range_text(range);
  return text.empty() ? "a finite number" : text;
}

std::string check_number(const Key& key, double value) {
  if (is_inside(value, key.range)) return "";
  return quote(key.name) + " is " + with_unit(number_text(value), key) + ", expected " +
         permitted(key.range);
}

std::string check_numbers(const Key& key, const Teuchos::Array<double>& values) {
  const std::size_t size = static_cast<std::size_t>(values.size());
  if (key.size != 0 && size != key.size)
    return quote(key.name) + " has " + std::to_string(size) + " numbers, expected " +
           std::to_string(key.size);
  for (const double value : values)
    if (!is_inside(value, key.range))
      return quote(key.name) + " contains " + with_unit(number_text(value), key) + ", expected " +
             permitted(key.range);
  return "";
}

std::string check_choice(const Key& key, const std::string& value) {
  if (std::find(key.options.begin(), key.options.end(), value) != key.options.end()) return "";
  const std::string best = nearest(value, key.options);
  return quote(key.name) + " is " + quote(value) + ", expected one of " + quoted(key.options) +
         (best.empty() ? "" : ". Did you mean " + quote(best) + "?");
}

std::string check_file(const Key& key, ParameterList& list, const std::string& directory) {
  namespace fs = std::filesystem;
  const std::string name = value_text(*list.getEntryPtr(key.name));
  if (name.empty()) {
    const bool may_be_none = !key.is_required && value_text(key.fallback).empty();
    return may_be_none ? "" : quote(key.name) + " is empty, expected the name of a file";
  }
  const fs::path absolute = fs::absolute(fs::path(directory) / name).lexically_normal();
  std::error_code ignored;
  const auto complain = [&](const std::string& what) {
    return quote(key.name) + " is " + quote(name) + ", but " + quote(absolute.string()) + what;
  };
  if (!fs::exists(absolute, ignored))
    return complain(" does not exist. Relative names start at the folder of the XML file");
  if (!fs::is_regular_file(absolute, ignored)) return complain(" is not a file");
  if (!std::ifstream(absolute)) return complain(" cannot be read; check its permissions");
  list.set(key.name, absolute.string());
  return "";
}

/// The first unknown key or wrong type, at any depth, in our words; "" if it is neither.
std::string foreign_problem(const ParameterList& list, const ParameterList& valid,
                            const std::string& path) {
  std::vector<std::string> names;
  for (auto it = valid.begin(); it != valid.end(); ++it) names.push_back(valid.name(it));
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string& name = list.name(it);
    if (!valid.isParameter(name))
      return prefix(path) + "unknown key " + quote(name) + ". " + did_you_mean(name, names);
    const std::string wanted = type_name(valid.getEntry(name));
    const bool has_validator = !valid.getEntry(name).validator().is_null();
    if (!wanted.empty() && !has_validator && type_name(list.entry(it)) != wanted)
      return prefix(path) + quote(name) + " is " + describe(list.entry(it)) +
             ", expected a value of type " + wanted;
    if (!list.entry(it).isList() || !valid.isSublist(name)) continue;
    const std::string inner =
        foreign_problem(list.sublist(name), valid.sublist(name), joined(path, name));
    if (!inner.empty()) return inner;
  }
  return "";
}

/// A package's message without the lines that speak of its source code.
std::string essence(const std::string& message) {
  const std::size_t start = message.find("Error, ");
  std::string text = start == std::string::npos ? message : message.substr(start + 7);
  text = trimmed(text.substr(0, text.find("Throw number")));
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

std::string check_value(const Key& key, ParameterList& list, const std::string& directory) {
  widen(key, list);
  const Teuchos::ParameterEntry& entry = *list.getEntryPtr(key.name);
  if (entry.isList() || type_name(entry) != xml_type(key.kind))
    return quote(key.name) + " is " + describe(entry) + ", expected " + expected(key);
  switch (key.kind) {
    case Kind::number:
      return check_number(key, list.get<double>(key.name));
    case Kind::integer:
      return check_number(key, list.get<int>(key.name));
    case Kind::numbers:
      return check_numbers(key, list.get<Teuchos::Array<double>>(key.name));
    case Kind::choice:
    case Kind::variant:
      return check_choice(key, value_text(entry));
    case Kind::file:
      return check_file(key, list, directory);
    default:
      return "";
  }
}

std::string check_foreign(const Key& key, const ParameterList& list, const std::string& path) {
  if (key.valid.numParams() == 0) return "";
  try {
    list.validateParameters(key.valid);
    return "";
  } catch (const std::exception& error) {
    if (is_out_of_memory(error)) throw;
    const std::string problem = foreign_problem(list, key.valid, path);
    return problem.empty() ? prefix(path) + essence(error.what()) : problem;
  }
}

}  // namespace tunica::params
