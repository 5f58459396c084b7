#include <cctype>
#include <map>
#include <ostream>
#include <sstream>
#include <utility>

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

/// more: what the meaning ends with.
std::string row_of(const Key& key, const std::string& more = "") {
  return "| `" + cell(key.name) + "` | " + type_text(key) + " | " + cell(default_text(key)) +
         " | " + cell(limits_text(key)) + " | " + cell(key.sentence) + more + " |\n";
}

/// The rows without their defaults: two lists that have these in common differ in defaults alone.
std::string kinds_of_rows(const Table& table) {
  std::string text;
  for (const Key& key : table.content().keys)
    if (key.kind != Kind::removed)
      text += key.name + "|" + type_text(key) + "|" + limits_text(key) + "|" + key.sentence + "\n";
  return text;
}

/// "`max iterations` = `50`, `method` = `gcr`": the defaults that are others than there.
std::string other_defaults(const Table& table, const Table& there) {
  std::string text;
  for (std::size_t k = 0; k < table.content().keys.size(); ++k) {
    const Key &key = table.content().keys[k], &other = there.content().keys[k];
    if (key.kind == Kind::removed || default_text(key) == default_text(other)) continue;
    text += (text.empty() ? "`" : ", `") + key.name + "` = " + default_text(key);
  }
  return text;
}

/// The anchor of a heading, as GitHub and Sphinx make it.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_')
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == ' ')
      anchor += '-';
  }
  return anchor;
}

std::string link_to(const std::string& heading) {
  return "[" + heading + "](#" + anchor_of(heading) + ")";
}

/// What is done with lists that have been printed at another place.
enum class Repeats { in_full, by_reference };

class Markdown {
public:
  Markdown(std::ostream& out, Repeats repeats) : out_(&out), repeats_(repeats) {}

  void section(const Table& table, const std::string& path, const std::string& condition);

private:
  void rows(const Table& table);
  void inner(const Key& key, const std::string& path, const std::string& condition);
  /// Where all of the table has been printed; empty where nowhere.
  std::string earlier(const Table& table) const;

  struct Place {
    std::string heading;
    const Table* table;
  };
  std::ostream* out_;
  Repeats repeats_;
  std::map<std::string, std::string> whole_;  ///< headings by all that stands below them
  std::map<std::string, Place> rows_;         ///< by rows without their defaults
};

/// Of a table and all below it, wherever it stands.
std::string whole_text(const Table& table) {
  std::ostringstream text;
  Markdown(text, Repeats::in_full).section(table, "", "");
  return text.str();
}

std::string Markdown::earlier(const Table& table) const {
  if (repeats_ == Repeats::in_full || table.content().keys.empty()) return "";
  const auto found = whole_.find(whole_text(table));
  return found == whole_.end() ? "" : found->second;
}

void Markdown::rows(const Table& table) {
  for (const Key& key : table.content().keys) {
    if (key.kind == Kind::removed) continue;
    const bool is_list = key.kind == Kind::sublist || key.kind == Kind::entries;
    const std::string there = is_list ? earlier(key.tables[0]) : "";
    *out_ << row_of(key, there.empty() ? "" : " As " + link_to(there) + ".");
  }
}

void Markdown::section(const Table& table, const std::string& path, const std::string& condition) {
  const Table::Content& content = table.content();
  const std::string heading = path + (condition.empty() ? "" : ", " + condition);
  *out_ << "## " << heading << "\n" << (content.sentence.empty() ? "\n" : "");
  const bool is_short = repeats_ == Repeats::by_reference && !content.keys.empty();
  if (is_short) whole_.emplace(whole_text(table), heading);
  if (!content.sentence.empty()) *out_ << content.sentence << "\n\n";
  const auto [like, is_new] = is_short ? rows_.emplace(kinds_of_rows(table), Place{heading, &table})
                                       : std::pair(rows_.end(), true);
  if (!is_new) {
    const std::string others = other_defaults(table, *like->second.table);
    *out_ << "Keys as " << link_to(like->second.heading)
          << (others.empty() ? "" : ", but by default " + others) << ".\n\n";
  } else if (!content.keys.empty()) {
    *out_ << "| key | type | default | range, unit | meaning |\n|---|---|---|---|---|\n";
    rows(table);
    *out_ << "\n";
  }
  for (const Key& key : content.keys) inner(key, path, condition);
}

void Markdown::inner(const Key& key, const std::string& path, const std::string& condition) {
  const std::string inside = joined(path, key.name);
  const bool is_list = key.kind == Kind::sublist || key.kind == Kind::entries;
  if (is_list && earlier(key.tables[0]).empty())
    section(key.tables[0], key.kind == Kind::sublist ? inside : joined(inside, "(any name)"), "");
  if (key.kind != Kind::variant) return;
  std::string references;
  for (std::size_t i = 0; i < key.options.size(); ++i) {
    if (key.tables[i].content().keys.empty()) continue;
    const std::string chosen = condition + (condition.empty() ? "" : ", ") + "`" + key.name +
                               "` = `" + key.options[i] + "`";
    const std::string there = earlier(key.tables[i]);
    if (there.empty())
      section(key.tables[i], path, chosen);
    else
      references += (references.empty() ? "`" : "; `") + key.options[i] + "` as " + link_to(there);
  }
  if (!references.empty())
    *out_ << path << (condition.empty() ? "" : ", ") << condition << ", `" << key.name
          << "`: " << references << ".\n\n";
}

}  // namespace

void Table::print_markdown(std::ostream& out, const std::string& name) const {
  Markdown(out, Repeats::in_full).section(*this, name, "");
}

void print_reference(std::ostream& out,
                     const std::vector<std::pair<std::string, const Table*>>& tables) {
  Markdown markdown(out, Repeats::by_reference);
  for (const auto& [name, table] : tables) markdown.section(*table, name, "");
}

}  // namespace tunica::params
