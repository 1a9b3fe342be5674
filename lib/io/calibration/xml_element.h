// The attributes of one XML element. This is as much of XML as calibration files need, which store
// numbers in attributes.
#pragma once

#include <string>
#include <string_view>

namespace walktrack {
inline namespace io {

class XmlElement {
 public:
  // Finds the first <name …> within text[from, to). Throws an InputError if there is none;
  // `allowed` describes the expected file.
  XmlElement(const std::string& text, std::string file, std::string name, std::string_view allowed,
             size_t from = 0, size_t to = std::string::npos);

  [[noreturn]] void fail(const std::string& key, std::string_view found,
                         std::string_view allowed) const;

  bool has(const std::string& key) const;
  std::string text(const std::string& key) const;  // the text between the quotes
  double number(const std::string& key) const;     // finite
  double positive(const std::string& key) const;
  int pixels(const std::string& key) const;  // 1 to kMostPixels

  // Its offset in the text.
  size_t start() const { return start_; }

 private:
  std::string file_, name_, attributes_;
  size_t start_ = 0;
  int line_ = 0;
};

}  // namespace io
}  // namespace walktrack
