#include "io/video/image_files.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/scene/scene.h"
#include "io/video/image_size.h"
#include "io/video/quiet.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMostImageBytes = size_t{1} << 30;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_image(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* known :
       {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".ppm", ".pgm", ".webp"}) {
    if (extension == known) return true;
  }
  return false;
}

// The digits at `at`, without leading zeros.
std::string digits_at(const std::string& text, size_t at) {
  size_t end = at;
  while (end < text.size() && is_digit(text[end])) ++end;
  while (at + 1 < end && text[at] == '0') ++at;
  return text.substr(at, end - at);
}

std::vector<fs::path> images_of_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_image(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  if (files.empty()) throw InputError(describe({folder.string(), 0, ""}, "no image", ""));
  return files;
}

struct FramePattern {
  std::string before, after;
  size_t width = 0;  // least number of digits
};

// Parses "%d" or "%05d", which must appear once. The pattern is never passed to printf.
FramePattern parse_pattern(const fs::path& path) {
  const std::string name = path.filename().string();
  const size_t percent = name.find('%');
  size_t at = percent + 1;
  while (at < name.size() && is_digit(name[at])) ++at;
  const std::string width = name.substr(percent + 1, at - percent - 1);
  const bool once = name.find('%', percent + 1) == std::string::npos;
  if (!once || at >= name.size() || name[at] != 'd' || width.size() > 2) {
    throw InputError(describe({path.string(), 0, ""}, "a pattern of another kind",
                              "one %d or %05d in the file name"));
  }
  return {name.substr(0, percent), name.substr(at + 1),
          width.empty() ? 1 : static_cast<size_t>(std::stoi(width))};
}

// The number of a file name according to the pattern; nullopt if the name does not match.
std::optional<long> number_in(const std::string& name, const FramePattern& pattern) {
  if (name.size() < pattern.before.size() + pattern.after.size() + pattern.width ||
      !name.starts_with(pattern.before) || !name.ends_with(pattern.after)) {
    return std::nullopt;
  }
  const std::string digits = name.substr(
      pattern.before.size(), name.size() - pattern.before.size() - pattern.after.size());
  const bool padded = digits.size() == pattern.width || digits[0] != '0';
  if (!std::all_of(digits.begin(), digits.end(), is_digit) || !padded || digits.size() > 9) {
    return std::nullopt;
  }
  return std::stol(digits);
}

std::vector<fs::path> images_of_pattern(const fs::path& path) {
  const FramePattern pattern = parse_pattern(path);
  std::map<long, fs::path> found;
  const fs::path folder = path.parent_path().empty() ? "." : path.parent_path();
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto number = number_in(entry.path().filename().string(), pattern);
    if (number) found[*number] = entry.path();
  }
  if (found.empty()) {
    throw InputError(describe({path.string(), 0, ""}, "no file of this pattern", ""));
  }
  std::vector<fs::path> files;
  for (const auto& [number, file] : found) {
    const long expected = found.begin()->first + static_cast<long>(files.size());
    if (number != expected) {
      throw InputError(describe({path.string(), 0, ""},
                                fmt::format("frame {} missing before {}", expected, number),
                                "numbers without gaps"));
    }
    files.push_back(file);
  }
  return files;
}

// Whether the last scan of a JPEG has no end, so that the rest of the image would be grey.
bool breaks_off(std::string_view content) {
  constexpr std::string_view kStart = "\xff\xd8", kScan = "\xff\xda", kEnd = "\xff\xd9";
  if (!content.starts_with(kStart)) return false;
  const size_t end = content.rfind(kEnd), scan = content.rfind(kScan);
  return end == std::string_view::npos || (scan != std::string_view::npos && end < scan);
}

}  // namespace

std::vector<int> missing_before(const std::vector<fs::path>& images) {
  std::vector<int> nothing(images.size(), 0);
  std::vector<long> numbers;
  std::string around;
  for (const fs::path& image : images) {
    const std::string name = image.stem().string();
    const size_t end = name.find_last_of("0123456789") + 1;
    size_t begin = end;
    while (begin > 0 && is_digit(name[begin - 1])) --begin;
    if (begin == end || end - begin > 9) return nothing;
    const std::string rest = name.substr(0, begin) + "|" + name.substr(end);
    if (!numbers.empty() && rest != around) return nothing;
    around = rest;
    numbers.push_back(std::stol(name.substr(begin, end - begin)));
  }
  std::vector<long> steps;
  for (size_t i = 1; i < numbers.size(); ++i) steps.push_back(numbers[i] - numbers[i - 1]);
  if (steps.empty()) return nothing;
  const long usual = *std::min_element(steps.begin(), steps.end());
  std::vector<int> out = nothing;
  long missing = 0;
  for (size_t i = 0; i < steps.size(); ++i) {
    if (usual <= 0 || steps[i] % usual != 0) return nothing;
    missing += steps[i] / usual - 1;
    if (missing > std::ssize(images)) return nothing;
    out[i + 1] = static_cast<int>(steps[i] / usual - 1);
  }
  return out;
}

std::string read_image_file(const fs::path& path, cv::Mat& image) {
  const std::string content = read_text_file(path, kMostImageBytes);
  const auto* bytes = reinterpret_cast<const unsigned char*>(content.data());
  const auto size = image_size_from_header({bytes, content.size()});
  if (!size) return "no PNG, JPEG, TIFF, BMP, PNM or WebP image";
  if (std::max(size->width, size->height) > kMostPixelsAlongASide) {
    return fmt::format("{}x{} px, up to {} px are allowed", size->width, size->height,
                       kMostPixelsAlongASide);
  }
  if (breaks_off(content)) return "a JPEG that breaks off before its end";
  const cv::Mat encoded(1, static_cast<int>(content.size()), CV_8U,
                        const_cast<unsigned char*>(bytes));  // it is only read
  try {
    const QuietDecoders quiet;
    image = cv::imdecode(encoded, cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    image.release();  // some decoders report a broken file in this way
  }
  return image.empty() ? "an image that cannot be decoded" : "";
}

std::optional<int> last_number_in(std::string_view name) {
  size_t end = name.size();
  while (end > 0 && !is_digit(name[end - 1])) --end;
  size_t begin = end;
  while (begin > 0 && is_digit(name[begin - 1])) --begin;
  if (begin == end) return std::nullopt;
  int number = 0;
  for (const char digit : name.substr(begin, end - begin)) {
    number = 10 * number + (digit - '0');
    if (number > kLargestFrameNumber) return std::nullopt;
  }
  return number;
}

bool natural_less(const std::string& a, const std::string& b) {
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string left = digits_at(a, i), right = digits_at(b, j);
      if (left.size() != right.size()) return left.size() < right.size();
      if (left != right) return left < right;
      while (i < a.size() && is_digit(a[i])) ++i;
      while (j < b.size() && is_digit(b[j])) ++j;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;
}

std::vector<fs::path> image_files(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return images_of_folder(path);
  if (is_frame_pattern(path)) return images_of_pattern(path);
  if (is_image(path)) return {path};
  return {};
}

}  // namespace io
}  // namespace walktrack
