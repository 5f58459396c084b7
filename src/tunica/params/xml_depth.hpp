#pragma once
#include <string>

namespace tunica::params {

/// Lists within lists that a file may have.
constexpr int deepest_list = 100;

/// Line of the text where XML elements are nested more than deepest_list deep; 0 where they are
/// not. It counts without recursion, which the parser does not survive. Says nothing about whether
/// the text is XML.
int line_too_deep(const std::string& text);

}  // namespace tunica::params
