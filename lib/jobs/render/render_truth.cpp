#include "jobs/render/render_truth.h"

#include <bit>
#include <vector>

#include <fmt/format.h>

#include "io/archive/files.h"
#include "io/drawing/picture.h"
#include "io/tables/csv.h"
#include "metrics/gait.h"

namespace walktrack {
inline namespace jobs {

namespace {

static_assert(std::endian::native == std::endian::little, "float files are little-endian");

constexpr float kUnknownFlow = 1e10f;

void append(std::string& out, const void* data, size_t bytes) {
  out.append(static_cast<const char*>(data), bytes);
}

}  // namespace

std::string events_csv(const Motion& whole, double duration) {
  std::string out = "t,side,event\n";
  for (const GaitEvent& event : gait_from_motion(whole).events) {
    if (event.time < 0 || event.time > duration) continue;
    out += fmt::format("{},{},{}\n", csv_number(event.time), event.side == Side::kLeft ? "l" : "r",
                       event.kind == GaitEventKind::kFootStrike ? "strike" : "toe_off");
  }
  return out;
}

void write_labels(const std::filesystem::path& file, const Plane<uint8_t>& labels) {
  write_file_atomically(file, png_bytes(grey_image(labels.values, labels.width, labels.height)));
}

void write_flow(const std::filesystem::path& file, const Plane<Eigen::Vector2f>& flow) {
  std::string out = "PIEH";
  const int32_t size[2] = {flow.width, flow.height};
  append(out, size, sizeof size);
  for (const Eigen::Vector2f& value : flow.values) {
    const Eigen::Vector2f stored =
        value.allFinite() ? value : Eigen::Vector2f::Constant(kUnknownFlow);
    append(out, stored.data(), 2 * sizeof(float));
  }
  write_file_atomically(file, out);
}

void write_depth(const std::filesystem::path& file, const Plane<float>& depth) {
  std::string out = fmt::format("Pf\n{} {}\n-1.0\n", depth.width, depth.height);
  for (int y = depth.height - 1; y >= 0; --y)
    append(out, &depth.at(0, y), static_cast<size_t>(depth.width) * sizeof(float));
  write_file_atomically(file, out);
}

}  // namespace jobs
}  // namespace walktrack
