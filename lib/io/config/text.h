// Makes text from outside (names, reasons) safe for the files into which it is written.
#pragma once

#include <string>
#include <string_view>

namespace walktrack {
inline namespace io {

// A cell of a CSV table, quoted if it contains a comma, a quote or a line end (RFC 4180).
std::string csv_cell(std::string_view text);
// Text inside an HTML element or a quoted attribute.
std::string html_text(std::string_view text);
// A relative path as a link: percent-encoded except for the characters that are allowed (RFC 3986).
std::string url_path(std::string_view path);
// Replaces control characters by spaces.
std::string one_line(std::string_view text);

}  // namespace io
}  // namespace walktrack
