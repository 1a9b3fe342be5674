// The attributes of one XML element, found by its name: enough of XML for calibration files, which
// hold numbers in attributes.
#pragma once

#include <string>
#include <string_view>

namespace walktrack {
inline namespace io {

class XmlElement {
 public:
  // The first <name …> within text[from, to). InputError where there is none: `allowed` says what
  // the file should be.
  XmlElement(const std::string& text, std::string file, std::string name, std::string_view allowed,
             size_t from = 0, size_t to = std::string::npos);

  [[noreturn]] void fail(const std::string& key, std::string_view found,
                         std::string_view allowed) const;

  bool has(const std::string& key) const;
  std::string text(const std::string& key) const;  // what stands between the quotes
  double number(const std::string& key) const;     // finite
  double positive(const std::string& key) const;
  int pixels(const std::string& key) const;  // 1 to kMostPixels

  // Where in the text it begins.
  size_t start() const { return start_; }

 private:
  std::string file_, name_, attributes_;
  size_t start_ = 0;
  int line_ = 0;
};

}  // namespace io
}  // namespace walktrack
