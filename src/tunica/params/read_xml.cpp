#include "tunica/params/read_xml.hpp"

#include <Teuchos_ParameterEntryXMLConverterDB.hpp>
#include <Teuchos_StringInputSource.hpp>
#include <Teuchos_XMLObject.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/base/out_of_memory.hpp"
#include "tunica/params/content.hpp"
#include "tunica/params/nearest.hpp"
#include "tunica/params/plain_text.hpp"
#include "tunica/params/value.hpp"
#include "tunica/params/xml_scan.hpp"

namespace tunica::params {

namespace {

using Teuchos::XMLObject;

/// Builds a list from an XML tree. path: names of the lists so far.
class Builder {
public:
  explicit Builder(std::string file) : file_(std::move(file)) {}
  void build(const XMLObject& node, Teuchos::ParameterList& list, const std::string& path) const;

private:
  Teuchos::ParameterEntry entry(const XMLObject& node, const std::string& path) const;
  std::string attribute(const XMLObject& node, const std::string& name,
                        const std::string& path) const;
  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    throw Error(file_ + ": " + prefix(path) + what);
  }

  std::string file_;
};

void Builder::build(const XMLObject& node, Teuchos::ParameterList& list,
                    const std::string& path) const {
  for (int i = 0; i < node.numChildren(); ++i) {
    const XMLObject& child = node.getChild(i);
    const std::string& tag = child.getTag();
    if (tag == "Validators" || tag == "Dependencies") continue;
    if (tag != "ParameterList" && tag != "Parameter")
      fail(path, "unknown element <" + tag + ">, expected <ParameterList> or <Parameter>");
    const std::string name = attribute(child, "name", path);
    if (list.isParameter(name)) fail(path, "\"" + name + "\" occurs twice; keep one");
    if (tag == "ParameterList")
      build(child, list.sublist(name), joined(path, name));
    else
      list.setEntry(name, entry(child, path));
  }
}

Teuchos::ParameterEntry Builder::entry(const XMLObject& node, const std::string& path) const {
  const std::string name = attribute(node, "name", path);
  const std::string type = attribute(node, "type", path);
  const std::string text = attribute(node, "value", path);
  const std::vector<std::string>& known = known_types();
  if (std::find(known.begin(), known.end(), type) != known.end()) {
    const auto value = parse_value(type, text);
    if (!value) fail(path, "\"" + name + "\" is \"" + text + "\", which is no " + type);
    return *value;
  }
  try {
    return Teuchos::ParameterEntryXMLConverterDB::getConverter(node)->fromXMLtoParameterEntry(node);
  } catch (const std::exception& error) {
    if (is_out_of_memory(error)) throw;
    fail(path, "\"" + name + "\" has the unknown type \"" + type + "\" or a value \"" + text +
                   "\" that does not fit. " + did_you_mean(type, known));
  }
}

std::string Builder::attribute(const XMLObject& node, const std::string& name,
                               const std::string& path) const {
  if (node.hasAttribute(name)) return node.getAttribute(name);
  const bool is_named = node.hasAttribute("name");
  fail(path, "a <" + node.getTag() + "> " +
                 (is_named ? "named \"" + node.getAttribute("name") + "\" " : "") +
                 "has no attribute " + name);
}

/// What the parser found wrong and where, without the lines that speak of its source code.
std::string essence(const std::string& message) {
  const std::string mark = "XML parse error at ";
  const std::size_t start = message.find(mark);
  if (start != std::string::npos) return message.substr(start + mark.size());
  const std::size_t last = trimmed(message).rfind('\n');
  return last == std::string::npos ? trimmed(message) : trimmed(message.substr(last));
}

XMLObject parse(const std::string& text, const std::string& path) {
  TUNICA_CHECK(!trimmed(text).empty(), path + ": the file is empty, expected a <ParameterList>");
  const int line = line_too_deep(text);
  TUNICA_CHECK(line == 0, path + ": at line " + std::to_string(line) +
                              " lists are nested more than " + std::to_string(deepest_list) +
                              " deep, expected at most " + std::to_string(deepest_list) + ".");
  try {
    const XMLObject root = Teuchos::StringInputSource(text).getObject();
    const int stray = line_of_lost_tag(text);
    TUNICA_CHECK(stray == 0, path + ": at line " + std::to_string(stray) +
                                 " there is a part of a tag among the text: is a \"<\" lost?");
    return root;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    if (is_out_of_memory(error)) throw;
    throw Error(path + ": not well-formed XML: " + trimmed(essence(error.what())));
  }
}

}  // namespace

Teuchos::ParameterList read_xml(const std::string& path) {
  std::error_code ignored;
  TUNICA_CHECK(std::filesystem::exists(path, ignored), path + ": there is no such file");
  TUNICA_CHECK(std::filesystem::is_regular_file(path, ignored), path + ": this is not a file");
  std::ifstream file(path, std::ios::binary);
  TUNICA_CHECK(file.good(), path + ": cannot be read; check its permissions");
  std::ostringstream text;
  text << file.rdbuf();
  return from_xml(plain_text(text.str(), path), path);
}

Teuchos::ParameterList from_xml(const std::string& text, const std::string& where) {
  const XMLObject root = parse(text, where);
  TUNICA_CHECK(root.getTag() == "ParameterList",
               where + ": starts with <" + root.getTag() + ">, expected <ParameterList>");
  Teuchos::ParameterList list(root.hasAttribute("name") ? root.getAttribute("name") : "");
  Builder(where).build(root, list, "");
  return list;
}

}  // namespace tunica::params
