#include <ostream>

#include "tunica/params/content.hpp"
#include "tunica/params/nearest.hpp"
#include "tunica/params/value.hpp"

namespace tunica::params {

namespace {

/// The text with | escaped, which would end a cell.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string type_text(const Key& key) {
  switch (key.kind) {
    case Kind::file:
      return "file";
    case Kind::choice:
    case Kind::variant:
      return "choice";
    case Kind::sublist:
      return "list";
    case Kind::entries:
      return "named lists";
    case Kind::foreign:
      return "foreign list";
    default:
      return xml_type(key.kind);
  }
}

std::string default_text(const Key& key) {
  if (xml_type(key.kind).empty()) return "";
  if (key.is_required) return "**required**";
  const std::string text = value_text(key.fallback);
  return text.empty() ? "none" : "`" + text + "`";
}

std::string limits_text(const Key& key) {
  std::string text = range_text(key.range);
  if (key.size != 0) text += (text.empty() ? "" : ", ") + std::to_string(key.size) + " numbers";
  if (!key.unit.empty()) text += (text.empty() ? "" : " ") + ("[" + key.unit + "]");
  if (!key.options.empty()) text += quoted(key.options);
  return text;
}

void print_row(std::ostream& out, const Key& key) {
  out << "| `" << cell(key.name) << "` | " << type_text(key) << " | " << cell(default_text(key))
      << " | " << cell(limits_text(key)) << " | " << cell(key.sentence) << " |\n";
}

void print_section(std::ostream& out, const Table& table, const std::string& path,
                   const std::string& condition);

void print_inner(std::ostream& out, const Key& key, const std::string& path,
                 const std::string& condition) {
  const std::string inside = joined(path, key.name);
  if (key.kind == Kind::sublist) print_section(out, key.tables[0], inside, "");
  if (key.kind == Kind::entries)
    print_section(out, key.tables[0], joined(inside, "(any name)"), "");
  if (key.kind != Kind::variant) return;
  for (std::size_t i = 0; i < key.options.size(); ++i) {
    if (key.tables[i].content().keys.empty()) continue;
    print_section(out, key.tables[i], path,
                  condition + (condition.empty() ? "" : ", ") + "`" + key.name + "` = `" +
                      key.options[i] + "`");
  }
}

void print_section(std::ostream& out, const Table& table, const std::string& path,
                   const std::string& condition) {
  const Table::Content& content = table.content();
  out << "## " << path << (condition.empty() ? "" : ", " + condition) << "\n\n";
  if (!content.sentence.empty()) out << content.sentence << "\n\n";
  if (!content.keys.empty())
    out << "| key | type | default | range, unit | meaning |\n|---|---|---|---|---|\n";
  for (const Key& key : content.keys)
    if (key.kind != Kind::removed) print_row(out, key);
  if (!content.keys.empty()) out << "\n";
  for (const Key& key : content.keys) print_inner(out, key, path, condition);
}

}  // namespace

void Table::print_markdown(std::ostream& out, const std::string& name) const {
  print_section(out, *this, name, "");
}

}  // namespace tunica::params
