// A report page: one HTML file that contains its style, its scripts, its data and its videos, and
// loads nothing from the network (its content policy forbids that).
//
// The parts of the page are in data/report and are compiled into the program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace walktrack {
inline namespace io {

struct ReportClip {
  std::string name;            // e.g. the name of the camera
  std::filesystem::path file;  // an MP4 beside the page
  bool embedded = true;        // inside the page, or a link to the file beside it
};

struct ReportPage {
  std::string title;
  std::string data_json;  // shown by the page's scripts
  std::vector<ReportClip> clips;
};

// Marks the first clips as embedded whose total size is at most `max_bytes`.
void choose_embedded(std::vector<ReportClip>& clips, uintmax_t max_bytes);

// The page without title, data and videos.
std::string_view report_template();
// The same for a comparison.
std::string_view compare_template();

// Copies videos block by block. Throws a std::runtime_error that names what cannot be read or
// written.
void write_report_page(const std::filesystem::path& path, const ReportPage& page,
                       std::string_view page_template = report_template());

// RFC 4648, with padding.
std::string base64(std::string_view bytes);

// Escapes JSON for a <script> element: every "<" is replaced, so that nothing can end the element.
std::string json_in_html(std::string_view json);

// The page of a batch with its marks <!--HEADLINE-->, <!--STATES-->, <!--HEADINGS-->, <!--ROWS-->.
std::string_view batch_template();
// data/report/normal_gait.csv.
std::string_view normal_gait_csv();

}  // namespace io
}  // namespace walktrack
