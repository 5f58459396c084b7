#include "tunica/params/xml_text.hpp"

#include <Teuchos_ParameterEntryXMLConverterDB.hpp>
#include <sstream>

#include "tunica/params/read_xml.hpp"
#include "tunica/params/value.hpp"

namespace tunica::params {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&apos;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string comment_safe(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--"))
    text.replace(at, 2, "–");
  return text;
}

std::string parameter_text(const std::string& name, const std::string& type,
                           const std::string& value) {
  return "<Parameter name=\"" + escaped(name) + "\" type=\"" + type + "\" value=\"" +
         escaped(value) + "\"/>";
}

std::string parameter_text(const std::string& name, const Teuchos::ParameterEntry& entry) {
  std::string type = type_name(entry);
  if (type.empty())  // a type that only Teuchos can spell
    type = Teuchos::ParameterEntryXMLConverterDB::getConverter(Teuchos::rcpFromRef(entry))
               ->getTypeAttributeValue();
  return parameter_text(name, type, value_text(entry));
}

void print_list(std::ostream& out, const Teuchos::ParameterList& list, const std::string& name,
                int indent) {
  const std::string blanks(static_cast<std::size_t>(indent), ' ');
  out << blanks << "<ParameterList name=\"" << escaped(name) << "\">\n";
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string& key = list.name(it);
    const Teuchos::ParameterEntry& entry = list.entry(it);
    if (entry.isList())
      print_list(out, Teuchos::any_cast<Teuchos::ParameterList>(entry.getAny(false)), key,
                 indent + 2);
    else
      out << blanks << "  " << parameter_text(key, entry) << "\n";
  }
  out << blanks << "</ParameterList>\n";
}

std::string to_xml(const Teuchos::ParameterList& list) {
  std::ostringstream out;
  print_list(out, list, list.name(), 0);
  return out.str();
}

}  // namespace tunica::params
