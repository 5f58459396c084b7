#include "tunica/params/value.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <charconv>
#include <cstdlib>

namespace tunica::params {

namespace {

using Entry = Teuchos::ParameterEntry;

template <class T>
bool holds(const Entry& entry) {
  return entry.isType<T>();
}

/// The stored value; does not mark the entry as used.
template <class T>
const T& stored(const Entry& entry) {
  return Teuchos::any_cast<T>(entry.getAny(false));
}

bool read(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && end == text.c_str() + text.size();
}

template <class Integer>
bool read_integer(const std::string& text, Integer& value) {
  const std::size_t sign = text.rfind('+', 0) == 0 ? 1 : 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data() + sign, end, value);
  return result.ec == std::errc() && result.ptr == end;
}
bool read(const std::string& text, int& value) { return read_integer(text, value); }
bool read(const std::string& text, long long& value) { return read_integer(text, value); }

bool read(const std::string& text, bool& value) {
  value = text == "true" || text == "1" || text == "yes";
  return value || text == "false" || text == "0" || text == "no";
}

bool read(const std::string& text, std::string& value) {
  value = text;
  return true;
}

template <class T>
std::optional<Entry> parse_one(const std::string& text) {
  T value{};
  if (!read(trimmed(text), value)) return std::nullopt;
  return Entry(value);
}

template <class T>
std::optional<Entry> parse_array(const std::string& text) {
  std::string rest = trimmed(text);
  const bool is_open = rest.rfind('{', 0) == 0;
  const bool is_closed = !rest.empty() && rest.back() == '}';
  if (is_open != is_closed) return std::nullopt;
  if (is_open) rest = trimmed(rest.substr(1, rest.size() - 2));
  Teuchos::Array<T> values;
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    T value{};
    const std::string item = trimmed(rest.substr(0, comma));
    if (item.empty() || !read(item, value)) return std::nullopt;
    values.push_back(value);
    if (comma == std::string::npos) break;
    rest = trimmed(rest.substr(comma + 1));
    if (rest.empty()) return std::nullopt;
  }
  return Entry(values);
}

std::string spell(double value) { return number_text(value); }
std::string spell(int value) { return std::to_string(value); }
std::string spell(const std::string& value) { return value; }

template <class T>
std::string spell(const Teuchos::Array<T>& values) {
  std::string text;
  for (const T& value : values) text += (text.empty() ? "" : ", ") + spell(value);
  return "{" + text + "}";
}

}  // namespace

std::optional<Entry> parse_value(const std::string& type, const std::string& text) {
  if (type == "double") return parse_one<double>(text);
  if (type == "int") return parse_one<int>(text);
  if (type == "long long") return parse_one<long long>(text);
  if (type == "bool") return parse_one<bool>(text);
  if (type == "string") return Entry(text);
  if (type == "Array(double)") return parse_array<double>(text);
  if (type == "Array(int)") return parse_array<int>(text);
  if (type == "Array(string)") return parse_array<std::string>(text);
  return std::nullopt;
}

const std::vector<std::string>& known_types() {
  static const std::vector<std::string> types{"int",           "long long",    "double",
                                              "bool",          "string",       "Array(int)",
                                              "Array(double)", "Array(string)"};
  return types;
}

std::string type_name(const Entry& entry) {
  if (holds<double>(entry)) return "double";
  if (holds<int>(entry)) return "int";
  if (holds<long long>(entry)) return "long long";
  if (holds<bool>(entry)) return "bool";
  if (holds<std::string>(entry)) return "string";
  if (holds<Teuchos::Array<double>>(entry)) return "Array(double)";
  if (holds<Teuchos::Array<int>>(entry)) return "Array(int)";
  if (holds<Teuchos::Array<std::string>>(entry)) return "Array(string)";
  return "";
}

std::string value_text(const Entry& entry) {
  const std::string type = type_name(entry);
  if (type == "double") return spell(stored<double>(entry));
  if (type == "int") return spell(stored<int>(entry));
  if (type == "long long") return std::to_string(stored<long long>(entry));
  if (type == "bool") return stored<bool>(entry) ? "true" : "false";
  if (type == "string") return stored<std::string>(entry);
  if (type == "Array(double)") return spell(stored<Teuchos::Array<double>>(entry));
  if (type == "Array(int)") return spell(stored<Teuchos::Array<int>>(entry));
  if (type == "Array(string)") return spell(stored<Teuchos::Array<std::string>>(entry));
  return Teuchos::toString(entry.getAny(false));
}

std::string describe(const Entry& entry) {
  if (entry.isList()) return "a parameter list";
  const std::string type = type_name(entry);
  const std::string text = value_text(entry);
  if (type == "string") return "the text \"" + text + "\"";
  if (type == "bool") return "the flag " + text;
  if (type == "double") return "the number " + text;
  if (type == "int" || type == "long long") return "the integer " + text;
  return type.empty() ? "of another type" : "the " + type + " " + text;
}

std::string number_text(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof(text), value);
  return std::string(text, end.ptr);
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

}  // namespace tunica::params
