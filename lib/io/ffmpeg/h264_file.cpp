#include "io/ffmpeg/h264_file.h"

extern "C" {
#include <libavutil/opt.h>
}

#include <array>
#include <stdexcept>
#include <string>

#include <opencv2/imgproc.hpp>

#include "io/ffmpeg/ffmpeg.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr int kMostTicks = 1'000'000;  // ticks of a second; rates are rounded to fractions of them

std::string name_of(EncoderPreset preset) {
  for (const auto& [name, each] : encoder_presets())
    if (each == preset) return name;
  return {};
}

void require(int result) {
  if (result >= 0) return;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(result, text.data(), text.size());
  throw std::runtime_error(text.data());
}

}  // namespace

struct H264File::State {
  struct FreeFile {
    void operator()(AVFormatContext* file) const {
      avio_closep(&file->pb);
      avformat_free_context(file);
    }
  };
  std::unique_ptr<AVFormatContext, FreeFile> file;
  ffmpeg::Owned<AVCodecContext> codec;
  ffmpeg::Owned<AVFrame> frame{av_frame_alloc()};
  ffmpeg::Owned<AVPacket> packet{av_packet_alloc()};
  AVStream* stream = nullptr;  // stream of `file`
  cv::Mat planes;              // of a frame: Y, then U and V at half the size
  int64_t frames = 0;

  bool open_codec(cv::Size size, double rate, EncoderPreset preset) {
    const AVCodec* const encoder = avcodec_find_encoder(AV_CODEC_ID_H264);
    if (!encoder) return false;
    codec.reset(avcodec_alloc_context3(encoder));
    codec->width = size.width;
    codec->height = size.height;
    codec->pix_fmt = AV_PIX_FMT_YUV420P;
    codec->color_range = AVCOL_RANGE_MPEG;  // the range of cv::cvtColor
    codec->colorspace = AVCOL_SPC_SMPTE170M;
    codec->framerate = av_d2q(rate, kMostTicks);
    codec->time_base = av_inv_q(codec->framerate);
    codec->thread_count = 1;
    codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;             // MP4 requires it
    codec->log_level_offset = AV_LOG_VERBOSE - AV_LOG_INFO;  // hides settings and statistics
    av_opt_set(codec->priv_data, "preset", name_of(preset).c_str(), 0);
    // x264 164 reads memory that it has not written when it spreads bits over frames with AVX-512.
    av_opt_set(codec->priv_data, "mbtree", "0", 0);
    return avcodec_open2(codec.get(), encoder, nullptr) >= 0;
  }

  bool open_file(const std::string& path) {
    AVFormatContext* made = nullptr;
    if (avformat_alloc_output_context2(&made, nullptr, "mp4", path.c_str()) < 0) return false;
    file.reset(made);
    stream = avformat_new_stream(made, nullptr);
    if (!stream || avcodec_parameters_from_context(stream->codecpar, codec.get()) < 0) return false;
    stream->time_base = codec->time_base;
    stream->avg_frame_rate = codec->framerate;
    return avio_open(&made->pb, path.c_str(), AVIO_FLAG_WRITE) >= 0 &&
           avformat_write_header(made, nullptr) >= 0;
  }

  // Passes a frame, or the end of the video, to the encoder, and writes what it returns.
  void push(const AVFrame* next) const {
    require(avcodec_send_frame(codec.get(), next));
    for (;;) {
      const int result = avcodec_receive_packet(codec.get(), packet.get());
      if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
      require(result);
      packet->duration = 1;
      packet->stream_index = stream->index;
      av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
      require(av_interleaved_write_frame(file.get(), packet.get()));
    }
  }
};

H264File::H264File(std::unique_ptr<State> state) : state_(std::move(state)) {}
H264File::~H264File() = default;

std::unique_ptr<H264File> H264File::open(const std::filesystem::path& path, cv::Size size_px,
                                         double frame_rate, EncoderPreset preset) {
  auto state = std::make_unique<State>();
  if (!state->open_codec(size_px, frame_rate, preset) || !state->open_file(path.string()))
    return nullptr;
  return std::unique_ptr<H264File>(new H264File(std::move(state)));
}

void H264File::write(const cv::Mat& frame) {
  State& state = *state_;
  const cv::Rect area(0, 0, state.codec->width, state.codec->height);
  cv::cvtColor(frame(area), state.planes, cv::COLOR_BGR2YUV_I420);
  AVFrame& out = *state.frame;  // a view: the encoder copies what it keeps
  const ptrdiff_t pixels = area.area();
  const std::array<ptrdiff_t, 3> planes{0, pixels, pixels + pixels / 4};
  for (size_t i = 0; i < planes.size(); ++i) {
    out.data[i] = state.planes.data + planes[i];
    out.linesize[i] = i == 0 ? area.width : area.width / 2;
  }
  out.format = state.codec->pix_fmt;
  out.width = area.width;
  out.height = area.height;
  out.pts = state.frames++;
  state.push(&out);
}

void H264File::finish() {
  state_->push(nullptr);
  require(av_write_trailer(state_->file.get()));
  require(avio_closep(&state_->file->pb));
}

}  // namespace io
}  // namespace walktrack
