#include <ostream>
#include <sstream>

#include "tunica/params/content.hpp"
#include "tunica/params/nearest.hpp"
#include "tunica/params/value.hpp"
#include "tunica/params/xml_text.hpp"

namespace tunica::params {

namespace {

/// Sentence, unit, range and options of a key, for a comment.
std::string explanation(const Key& key) {
  std::string text = key.sentence;
  if (!text.empty() && text.back() == '.') text.pop_back();
  if (!key.unit.empty()) text += " [" + key.unit + "]";
  const std::string range = range_text(key.range);
  if (!range.empty()) text += ", " + range;
  if (key.size != 0) text += ", " + std::to_string(key.size) + " numbers";
  if (!key.options.empty()) text += ", one of " + quoted(key.options);
  return comment_safe(text);
}

/// Prints a table as XML. Comments do not nest: inside one, explanations follow the key.
class XmlPrinter {
public:
  explicit XmlPrinter(std::ostream& out) : out_(out) {}
  void print(const Table& table, const std::string& name, int indent);

private:
  void print_keys(const Table& table, int indent);
  void print_value(const Key& key, int indent);
  void print_cases(const Key& key, int indent);
  void print_entries(const Key& key, int indent);
  void print_foreign(const Key& key, int indent);
  void remark(const std::string& text, int indent);
  bool open(const std::string& text, int indent);
  void close(bool is_mine, int indent);
  std::string blanks(int indent) const {
    return std::string(static_cast<std::size_t>(indent), ' ');
  }

  std::ostream& out_;
  bool in_comment_ = false;
};

void XmlPrinter::remark(const std::string& text, int indent) {
  if (text.empty()) return;
  out_ << blanks(indent) << (in_comment_ ? "" : "<!-- ") << text << (in_comment_ ? "" : " -->")
       << "\n";
}

/// Starts a comment unless there is one; true if it is ours to close.
bool XmlPrinter::open(const std::string& text, int indent) {
  out_ << blanks(indent) << (in_comment_ ? "" : "<!-- ") << text << "\n";
  const bool is_mine = !in_comment_;
  in_comment_ = true;
  return is_mine;
}

void XmlPrinter::close(bool is_mine, int indent) {
  if (!is_mine) return;
  out_ << blanks(indent) << "-->\n";
  in_comment_ = false;
}

void XmlPrinter::print(const Table& table, const std::string& name, int indent) {
  remark(comment_safe(table.content().sentence), indent);
  out_ << blanks(indent) << "<ParameterList name=\"" << escaped(name) << "\">\n";
  print_keys(table, indent + 2);
  out_ << blanks(indent) << "</ParameterList>\n";
}

void XmlPrinter::print_keys(const Table& table, int indent) {
  for (const Key& key : table.content().keys) {
    switch (key.kind) {
      case Kind::removed:
        break;
      case Kind::sublist:
        print(key.tables[0], key.name, indent);
        break;
      case Kind::entries:
        print_entries(key, indent);
        break;
      case Kind::foreign:
        print_foreign(key, indent);
        break;
      default:
        print_value(key, indent);
    }
    if (key.kind == Kind::variant) print_cases(key, indent);
  }
}

void XmlPrinter::print_value(const Key& key, int indent) {
  const std::string line = key.is_required ? parameter_text(key.name, xml_type(key.kind), "")
                                           : parameter_text(key.name, key.fallback);
  const std::string required = key.is_required ? "REQUIRED. " : "";
  if (in_comment_) {
    out_ << blanks(indent) << comment_safe(line) << "  " << required << explanation(key) << "\n";
  } else if (key.is_required) {
    out_ << blanks(indent) << "<!-- " << required << explanation(key) << "\n"
         << blanks(indent) << comment_safe(line) << " -->\n";
  } else {
    remark(explanation(key), indent);
    out_ << blanks(indent) << line << "\n";
  }
}

void XmlPrinter::print_cases(const Key& key, int indent) {
  const std::string chosen_value = key.is_required ? "" : value_text(key.fallback);
  for (std::size_t i = 0; i < key.options.size(); ++i)
    if (key.options[i] == chosen_value) print_keys(key.tables[i], indent);
  for (std::size_t i = 0; i < key.options.size(); ++i) {
    const Table::Content& content = key.tables[i].content();
    if (key.options[i] == chosen_value || content.keys.empty()) continue;
    const std::string reason = "with \"" + key.name + "\" = \"" + key.options[i] +
                               "\":" + (content.sentence.empty() ? "" : " ") + content.sentence;
    const bool is_mine = open(comment_safe(reason), indent);
    print_keys(key.tables[i], indent + 2);
    close(is_mine, indent);
  }
}

void XmlPrinter::print_entries(const Key& key, int indent) {
  remark(explanation(key), indent);
  out_ << blanks(indent) << "<ParameterList name=\"" << escaped(key.name) << "\">\n";
  const bool is_mine = open("any number of lists, such as", indent + 2);
  print(key.tables[0], "a free name", indent + 2);
  close(is_mine, indent + 2);
  out_ << blanks(indent) << "</ParameterList>\n";
}

void XmlPrinter::print_foreign(const Key& key, int indent) {
  remark(explanation(key), indent);
  std::ostringstream text;
  print_list(text, key.foreign, key.name, indent);
  out_ << (in_comment_ ? comment_safe(text.str()) : text.str());
}

}  // namespace

void Table::print_xml(std::ostream& out, const std::string& name) const {
  XmlPrinter(out).print(*this, name, 0);
}

}  // namespace tunica::params
