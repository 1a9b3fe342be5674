// FFmpeg's objects with owners, for the sources of this folder that call it.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <filesystem>
#include <memory>

namespace walktrack {
inline namespace io {
namespace ffmpeg {

struct Free {
  void operator()(AVFormatContext* input) const { avformat_close_input(&input); }
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* converter) const { sws_freeContext(converter); }
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

// Silences FFmpeg's messages about broken files, which the caller reports. FFmpeg has one level for
// the process: files are opened by one thread at a time.
class Silence {
 public:
  Silence() { av_log_set_level(AV_LOG_QUIET); }
  ~Silence() { av_log_set_level(before_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int before_ = av_log_get_level();
};

// nullptr if FFmpeg cannot read the file.
inline Owned<AVFormatContext> opened(const std::filesystem::path& file) {
  AVFormatContext* input = nullptr;
  if (avformat_open_input(&input, file.c_str(), nullptr, nullptr) < 0) return nullptr;
  return Owned<AVFormatContext>(input);
}

// The best video stream; packets of other streams are discarded. nullptr if there is none.
inline const AVStream* video_stream(AVFormatContext& input) {
  const int best = av_find_best_stream(&input, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  for (unsigned i = 0; i < input.nb_streams; ++i)
    if (static_cast<int>(i) != best) input.streams[i]->discard = AVDISCARD_ALL;
  return best < 0 ? nullptr : input.streams[best];
}

}  // namespace ffmpeg
}  // namespace io
}  // namespace walktrack
