#pragma once
#include <string>

namespace tunica::params {

/// Lists within lists that a file may have.
constexpr int deepest_list = 100;

/// Line of the text where XML elements are nested more than deepest_list deep; 0 where they are
/// not. It counts without recursion, which the parser does not survive. Says nothing about whether
/// the text is XML.
int line_too_deep(const std::string& text);

/// Line of the first text outside of tags and comments that looks like a part of a tag; 0 where
/// there is none. The parser passes over text, and with it over a parameter whose "<" is lost.
/// Sentences are let through: examples that --print-defaults prints have some.
int line_of_lost_tag(const std::string& text);

}  // namespace tunica::params
