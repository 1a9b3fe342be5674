// A page that can be sent on: one HTML file that holds its style, its scripts, its data and its
// videos, and asks the network for nothing (its content policy forbids it to).
//
// The parts of the page are in data/report and become part of the program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace walktrack {
inline namespace io {

struct ReportClip {
  std::string name;            // e.g. the camera's
  std::filesystem::path file;  // an MP4 beside the page
  bool embedded = true;        // inside the page, or played from the file beside it
};

struct ReportPage {
  std::string title;
  std::string data_json;  // what the page's scripts show
  std::vector<ReportClip> clips;
};

// Marks as embedded the clips, from the first on, that together have at most `max_bytes`.
void choose_embedded(std::vector<ReportClip>& clips, uintmax_t max_bytes);

// The page without title, data and videos.
std::string_view report_template();
// The same of a comparison.
std::string_view compare_template();

// Videos are copied through block by block. std::runtime_error naming what cannot be read or
// written.
void write_report_page(const std::filesystem::path& path, const ReportPage& page,
                       std::string_view page_template = report_template());

// RFC 4648, with padding.
std::string base64(std::string_view bytes);

// JSON inside a <script> element: no "<" is left, so nothing in it can end the element.
std::string json_in_html(std::string_view json);

// The page of a batch with its places <!--HEADLINE-->, <!--STATES-->, <!--HEADINGS-->, <!--ROWS-->.
std::string_view batch_template();
// data/report/normal_gait.csv.
std::string_view normal_gait_csv();

}  // namespace io
}  // namespace walktrack
