// Text from outside (names, reasons), made safe for the files that it is printed into.
#pragma once

#include <string>
#include <string_view>

namespace walktrack {
inline namespace io {

// A cell of a CSV table: quoted where it holds a comma, a quote or a line end (RFC 4180).
std::string csv_cell(std::string_view text);
// Text inside an HTML element or a quoted attribute.
std::string html_text(std::string_view text);
// A relative path as a link: percent-encoded but for what may stand there (RFC 3986).
std::string url_path(std::string_view path);
// Control characters become blanks.
std::string one_line(std::string_view text);

}  // namespace io
}  // namespace walktrack
