#include "io/ffmpeg/frame_stamps.h"

#include <algorithm>
#include <cmath>

#include "io/ffmpeg/ffmpeg.h"
#include "io/scene/scene.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr double kUneven = 0.25;       // share of the usual step
constexpr double kRoundedRate = 1e-3;  // relative; containers round their rates by as much

int64_t stamp_of(const AVPacket& packet) {
  return packet.pts != AV_NOPTS_VALUE ? packet.pts : packet.dts;
}

}  // namespace

std::vector<double> frame_stamps(const std::filesystem::path& video) {
  if (is_frame_pattern(video)) return {};  // FFmpeg would make up a rate for them
  const ffmpeg::Silence silence;
  std::vector<double> stamps;
  const auto file = ffmpeg::opened(video);
  const AVStream* stream = file ? ffmpeg::video_stream(*file) : nullptr;
  if (!stream) return stamps;
  const ffmpeg::Owned<AVPacket> packet(av_packet_alloc());
  for (; av_read_frame(file.get(), packet.get()) >= 0; av_packet_unref(packet.get())) {
    const bool shown = (packet->flags & AV_PKT_FLAG_DISCARD) == 0;
    if (packet->stream_index != stream->index || !shown) continue;
    if (stamp_of(*packet) == AV_NOPTS_VALUE) return {};
    stamps.push_back(static_cast<double>(stamp_of(*packet)) * av_q2d(stream->time_base));
  }
  std::sort(stamps.begin(), stamps.end());
  for (size_t i = stamps.size(); i-- > 0;) stamps[i] -= stamps[0];
  return stamps;
}

StampSteps steps_of(const std::vector<double>& stamps) {
  std::vector<double> steps;
  for (size_t i = 1; i < stamps.size(); ++i) steps.push_back(stamps[i] - stamps[i - 1]);
  if (steps.size() < 3) return {};
  std::vector<double> sorted = steps;
  const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double median = *middle;
  if (!(median > 0)) return {};
  StampSteps out;
  double sum = 0;
  int usual = 0;
  for (const double step : steps) {
    const double whole = std::max(1.0, std::round(step / median));
    if (std::abs(step - whole * median) > kUneven * median) {
      ++out.uneven;
    } else {
      out.dropped += static_cast<int>(whole) - 1;
      sum += step / whole;
      ++usual;
    }
  }
  out.usual = usual > 0 ? sum / usual : median;
  return out;
}

double usual_rate(const VideoFacts& facts, const StampSteps& steps) {
  if (steps.usual == 0) return facts.frame_rate;
  const bool as_said = std::abs(facts.frame_rate * steps.usual - 1) <= kRoundedRate;
  return as_said ? facts.frame_rate : 1 / steps.usual;
}

}  // namespace io
}  // namespace walktrack
