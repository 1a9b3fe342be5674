#include "io/drawing/report_page.h"

#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "io/archive/files.h"
#include "io/config/text.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kTitlePlace = "<!--TITLE-->", kDataPlace = "<!--DATA-->";
constexpr size_t kBlockBytes = 3 << 14;  // a multiple of three, so that encoded blocks join without
                                         // padding

void write_clip(const ReportClip& clip, AtomicFile& out) {
  out.write(fmt::format("<script type=\"text/plain\" class=\"clip\" data-name=\"{}\">",
                        html_text(one_line(clip.name))));
  std::ifstream video(clip.file, std::ios::binary);
  std::string block(kBlockBytes, '\0');
  while (video.read(block.data(), kBlockBytes) || video.gcount() > 0) {
    out.write(base64({block.data(), static_cast<size_t>(video.gcount())}));
  }
  if (!video.eof()) throw std::runtime_error(fmt::format("{}: cannot be read", clip.file.string()));
  out.write("</script>\n");
}

void write_link(const ReportClip& clip, AtomicFile& out) {
  out.write(fmt::format(
      "<script type=\"text/plain\" class=\"clip\" data-name=\"{}\" data-file=\"{}\"></script>\n",
      html_text(one_line(clip.name)), url_path(clip.file.filename().string())));
}

}  // namespace

void choose_embedded(std::vector<ReportClip>& clips, uintmax_t max_bytes) {
  uintmax_t sum = 0;
  for (ReportClip& clip : clips) {
    std::error_code unreadable;
    const uintmax_t bytes = fs::file_size(clip.file, unreadable);
    clip.embedded = !unreadable && bytes <= max_bytes - sum;
    if (clip.embedded) sum += bytes;
  }
}

void write_report_page(const fs::path& path, const ReportPage& page, std::string_view text) {
  const size_t title = text.find(kTitlePlace), data = text.find(kDataPlace);
  AtomicFile out(path);
  out.write(text.substr(0, title));
  out.write(html_text(one_line(page.title)));
  out.write(text.substr(title + kTitlePlace.size(), data - title - kTitlePlace.size()));
  out.write("<script type=\"application/json\" id=\"data\">");
  out.write(json_in_html(page.data_json));
  out.write("</script>\n");
  for (const ReportClip& clip : page.clips) {
    clip.embedded ? write_clip(clip, out) : write_link(clip, out);
  }
  out.write(text.substr(data + kDataPlace.size()));
  out.commit();
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string json_in_html(std::string_view json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace io
}  // namespace walktrack
