#pragma once
#include <istream>
#include <string>
#include <string_view>

namespace tunica::params {

/// Bytes of the byte-order mark of UTF-8 that a text begins with, 3 or 0: spreadsheets and shells
/// of Windows write one. Throws Error that names the file where the text is UTF-16 or UTF-32.
std::size_t mark_size(std::string_view start, const std::string& file);

/// The text without a byte-order mark; each of its lines ends with a line feed, also where that was
/// a carriage return, alone or before it. Throws Error as above.
std::string plain_text(const std::string& text, const std::string& file);

/// All of a file as such a text. Throws Error if it cannot be read.
std::string read_plain_text(const std::string& file);

/// Begins a large text, to be read line by line, behind its byte-order mark. Throws Error as above,
/// and where lines end with a carriage return alone.
void begin_text(std::istream& in, const std::string& file);

}  // namespace tunica::params
