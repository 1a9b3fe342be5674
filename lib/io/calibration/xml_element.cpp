#include "io/calibration/xml_element.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/calibration/calibration_checks.h"

namespace walktrack {
inline namespace io {

XmlElement::XmlElement(const std::string& text, std::string file, std::string name,
                       std::string_view allowed, size_t from, size_t to)
    : file_(std::move(file)), name_(std::move(name)) {
  start_ = text.find(fmt::format("<{} ", name_), from);
  const size_t end = start_ >= to ? std::string::npos : text.find('>', start_);
  if (end == std::string::npos)
    throw InputError(describe({file_, 0, ""}, fmt::format("no <{}> element", name_), allowed));
  line_ = 1 + static_cast<int>(std::count(text.begin(), text.begin() + ptrdiff_t(start_), '\n'));
  attributes_ = text.substr(start_, end - start_);
}

void XmlElement::fail(const std::string& key, std::string_view found,
                      std::string_view allowed) const {
  throw InputError(describe({file_, line_, name_ + "." + key}, found, allowed));
}

bool XmlElement::has(const std::string& key) const {
  return attributes_.find(fmt::format(" {}=\"", key)) != std::string::npos;
}

std::string XmlElement::text(const std::string& key) const {
  const size_t start = attributes_.find(fmt::format(" {}=\"", key));
  if (start == std::string::npos) fail(key, "nothing", "a number");
  const size_t first = start + key.size() + 3;
  return attributes_.substr(first, attributes_.find('"', first) - first);
}

double XmlElement::number(const std::string& key) const {
  const std::string found = text(key);
  const auto value = number_from_text(found);
  if (!value) fail(key, fmt::format("'{}'", found), "a number");
  return *value;
}

double XmlElement::positive(const std::string& key) const {
  const double value = number(key);
  if (!(value > 0)) fail(key, fmt::format("{:g}", value), "a positive number");
  return value;
}

int XmlElement::pixels(const std::string& key) const {
  const double value = number(key);
  if (value != std::floor(value) || value < 1 || value > kMostPixels)
    fail(key, fmt::format("{:g}", value), "a whole number of pixels");
  return static_cast<int>(value);
}

}  // namespace io
}  // namespace walktrack
