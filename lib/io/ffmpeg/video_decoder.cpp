#include "io/ffmpeg/video_decoder.h"

extern "C" {
#include <libavutil/display.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/parallel_for.h"
#include "io/ffmpeg/ffmpeg.h"
#include "io/ffmpeg/mean_colours.h"
#include "observation/shrink.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr int kMostDecoderThreads = 4;  // each holds frames of its own
// Below this factor it is as fast to convert pixels first.
constexpr int kLeastPlaneMeans = 3;
constexpr int kStripRows = 32;  // of the frame, which are converted and shrunk at a time
constexpr int kRowBlock = 32;   // FFmpeg writes rows in blocks of pixels

double ratio(const AVRational& value) { return value.den == 0 ? 0 : av_q2d(value); }

// 8-bit YUV 4:2:0, what nearly every camera records.
bool has_plain_planes(const AVFrame& frame) {
  return frame.format == AV_PIX_FMT_YUV420P || frame.format == AV_PIX_FMT_YUVJ420P;
}

ColourPlanes planes_of(const AVFrame& frame) {
  return {{frame.data[0], frame.data[1], frame.data[2]},
          {frame.linesize[0], frame.linesize[1], frame.linesize[2]},
          frame.format == AV_PIX_FMT_YUVJ420P};
}

// Whether every two rows are converted from their own planes alone.
bool has_independent_rows(const AVFrame& frame) {
  return has_plain_planes(frame) && frame.height % 2 == 0;
}

// The planes of such a frame from row `first` on, an even number.
auto rows_from(const AVFrame& frame, int first) {
  std::array<const uint8_t*, AV_NUM_DATA_POINTERS> planes{};
  for (size_t p = 0; p < 3; ++p) {
    const ptrdiff_t row = p == 0 ? first : first / 2;
    planes[p] = frame.data[p] + row * frame.linesize[p];
  }
  return planes;
}

int even(int rows) { return (rows + 1) / 2 * 2; }

int whole_blocks(int width) { return (width + kRowBlock - 1) / kRowBlock * kRowBlock; }

// Frames that a video which was cut without encoding it again still holds, and does not show.
int64_t frames_not_shown(const AVFormatContext& input, const AVStream& stream) {
  if (std::string_view(input.iformat->name).substr(0, 3) != "mov") return 0;  // has no edit lists
  // Its index has the frames that are decoded, of which some are not shown.
  int64_t shown = 0;
  for (int i = 0; i < avformat_index_get_entries_count(&stream); ++i)
    shown += (avformat_index_get_entry(const_cast<AVStream*>(&stream), i)->flags &
              AVINDEX_DISCARD_FRAME) == 0;
  return shown > 0 ? std::max<int64_t>(0, stream.nb_frames - shown) : 0;
}

int rotation_of(const AVStream& stream) {
  const uint8_t* matrix = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
  if (!matrix) return 0;
  const double anticlockwise =
      av_display_rotation_get(reinterpret_cast<const int32_t*>(matrix));  // NaN: it is singular
  if (!std::isfinite(anticlockwise)) return 0;
  return ((static_cast<int>(std::lround(-anticlockwise / 90)) % 4 + 4) % 4) * 90;
}

}  // namespace

struct VideoDecoder::State {
  ffmpeg::Owned<AVFormatContext> input;
  ffmpeg::Owned<AVCodecContext> codec;
  ffmpeg::Owned<AVFrame> frame{av_frame_alloc()};
  ffmpeg::Owned<AVPacket> packet{av_packet_alloc()};
  ffmpeg::Owned<SwsContext> converter, strip_converter;
  cv::Mat padded, whole, strip;  // memory for converted frames
  const AVStream* stream = nullptr;
  bool at_end = false;

  bool open(const std::filesystem::path& path) {
    input = ffmpeg::opened(path);
    if (!input || avformat_find_stream_info(input.get(), nullptr) < 0) return false;
    stream = ffmpeg::video_stream(*input);
    const AVCodec* const decoder =
        stream ? avcodec_find_decoder(stream->codecpar->codec_id) : nullptr;
    if (!decoder) return false;
    codec.reset(avcodec_alloc_context3(decoder));
    if (avcodec_parameters_to_context(codec.get(), stream->codecpar) < 0) return false;
    codec->thread_count = std::min(kMostDecoderThreads, hardware_threads());
    codec->log_level_offset = AV_LOG_TRACE;  // hides what is said of broken frames
    return avcodec_open2(codec.get(), decoder, nullptr) >= 0;
  }

  // Passes the next packet of the stream, or the end of the file, to the decoder.
  void feed() {
    while (!at_end) {
      at_end = av_read_frame(input.get(), packet.get()) < 0;
      const bool ours = !at_end && packet->stream_index == stream->index;
      if (ours || at_end) avcodec_send_packet(codec.get(), at_end ? nullptr : packet.get());
      av_packet_unref(packet.get());
      if (ours) return;
    }
  }

  // All of the frame. A row that is short is written beyond its end.
  void convert(cv::Mat& bgr) {
    const AVFrame& f = *frame;
    const bool is_short = f.width % kRowBlock != 0;
    cv::Mat& into = is_short ? padded : bgr;
    into.create(f.height, whole_blocks(f.width), CV_8UC3);
    convert_rows(converter, 0, f.height, f.height, into);
    if (is_short) padded.colRange(0, f.width).copyTo(bgr);
  }

  // Rows of the frame, which `owner` converts as part of a picture that is `height` rows high.
  void convert_rows(ffmpeg::Owned<SwsContext>& owner, int first, int rows, int height,
                    cv::Mat& bgr) {
    const AVFrame& f = *frame;
    const auto format = static_cast<AVPixelFormat>(f.format);
    owner.reset(sws_getCachedContext(owner.release(), f.width, height, format, f.width, height,
                                     AV_PIX_FMT_BGR24, SWS_BICUBIC, nullptr, nullptr, nullptr));
    std::array<const uint8_t*, AV_NUM_DATA_POINTERS> from{};
    std::copy_n(f.data, from.size(), from.begin());
    if (first > 0) from = rows_from(f, first);
    const std::array<uint8_t*, 4> to{bgr.data};
    const std::array<int, 4> stride{static_cast<int>(bgr.step)};
    sws_scale(owner.get(), from.data(), f.linesize, 0, rows, to.data(), stride.data());
  }
};

VideoDecoder::VideoDecoder(std::unique_ptr<State> state) : state_(std::move(state)) {}
VideoDecoder::~VideoDecoder() = default;

std::unique_ptr<VideoDecoder> VideoDecoder::open(const std::filesystem::path& path) {
  const ffmpeg::Silence silence;
  auto state = std::make_unique<State>();
  if (!state->open(path)) return nullptr;
  return std::unique_ptr<VideoDecoder>(new VideoDecoder(std::move(state)));
}

cv::Size VideoDecoder::size_px() const { return {state_->codec->width, state_->codec->height}; }

double VideoDecoder::frame_rate() const {
  const double average = ratio(state_->stream->avg_frame_rate);
  return average > 0 ? average : ratio(state_->stream->r_frame_rate);
}

int VideoDecoder::frame_count() const {
  const AVStream& stream = *state_->stream;
  double count = static_cast<double>(stream.nb_frames);
  if (count > 0) {
    count -= static_cast<double>(frames_not_shown(*state_->input, stream));
  } else {
    double seconds = static_cast<double>(state_->input->duration) / AV_TIME_BASE;
    if (seconds <= 0) seconds = static_cast<double>(stream.duration) * ratio(stream.time_base);
    count = std::floor(seconds * frame_rate() + 0.5);
  }
  return count > 0 && count < 1e9 ? static_cast<int>(count) : 0;
}

int VideoDecoder::rotation_deg() const { return rotation_of(*state_->stream); }

bool VideoDecoder::advance() {
  for (;;) {
    const int result = avcodec_receive_frame(state_->codec.get(), state_->frame.get());
    if (result >= 0)
      return sws_isSupportedInput(static_cast<AVPixelFormat>(state_->frame->format)) != 0;
    if (result == AVERROR_EOF || (result == AVERROR(EAGAIN) && state_->at_end)) return false;
    if (result == AVERROR(EAGAIN)) state_->feed();
  }
}

cv::Size VideoDecoder::frame_px() const { return {state_->frame->width, state_->frame->height}; }

void VideoDecoder::picture(cv::Mat& bgr) const { state_->convert(bgr); }

void VideoDecoder::picture(const cv::Rect& area, int shrink, cv::Mat& bgr) const {
  const AVFrame& frame = *state_->frame;
  if (has_plain_planes(frame) && shrink >= kLeastPlaneMeans && shrink <= kMostMeaned)
    return mean_colours(planes_of(frame), area, shrink, bgr);
  means_of_pixels(area, shrink, bgr);
}

void VideoDecoder::means_of_pixels(const cv::Rect& area, int shrink, cv::Mat& bgr) const {
  State& state = *state_;
  if (!has_independent_rows(*state.frame)) {
    state.convert(state.whole);
    return shrunk(state.whole(area), shrink).copyTo(bgr);
  }
  const int width = area.width / shrink, height = area.height / shrink;
  const int most = std::max(1, kStripRows / shrink);  // rows of the result
  const int most_rows = even(most * shrink) + 2;      // of the frame
  bgr.create(height, width, CV_8UC3);
  state.strip.create(most_rows, whole_blocks(state.frame->width), CV_8UC3);
  for (int row = 0; row < height; row += most) {
    const int count = std::min(most, height - row);
    const int begin = area.y + row * shrink, first = begin / 2 * 2;
    const int rows = even(begin + count * shrink) - first;
    state.convert_rows(state.strip_converter, first, rows, most_rows, state.strip);
    const cv::Rect seen(area.x, begin - first, width * shrink, count * shrink);
    shrunk(state.strip(seen), shrink).copyTo(bgr.rowRange(row, row + count));
  }
}

}  // namespace io
}  // namespace walktrack
