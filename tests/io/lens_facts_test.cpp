#include "io/video/lens_facts.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/run_program.h"

namespace walktrack {
namespace {

std::string number(unsigned value, size_t bytes, bool big) {
  std::string out;
  for (size_t i = 0; i < bytes; ++i)
    out += static_cast<char>(value >> 8 * (big ? bytes - 1 - i : i) & 255);
  return out;
}

// One field of a TIFF directory.
std::string field(unsigned tag, unsigned type, unsigned value, size_t bytes, bool big) {
  return number(tag, 2, big) + number(type, 2, big) + number(1, 4, big) +
         number(value, bytes, big) + std::string(4 - bytes, '\0');
}

std::string jpeg(unsigned focal_mm, bool big) {
  const auto n = [&](unsigned value, size_t bytes) { return number(value, bytes, big); };
  // Header of 8 bytes, a directory of two fields (2 + 24 + 4), EXIF's of two.
  std::string tiff = (big ? "MM" : "II") + n(42, 2) + n(8, 4);
  tiff += n(2, 2) + field(0x0112, 3, 1, 2, big) + field(0x8769, 4, 38, 4, big) + n(0, 4);
  tiff += n(2, 2) + field(0x9207, 3, 5, 2, big) + field(0xA405, 3, focal_mm, 2, big) + n(0, 4);
  const std::string exif = std::string("Exif\0\0", 6) + tiff;
  const auto segment = [](unsigned kind, const std::string& content) {
    return number(kind, 2, true) + number(static_cast<unsigned>(content.size() + 2), 2, true) +
           content;
  };
  return number(0xFFD8, 2, true) + segment(0xFFE0, "JFIF") + segment(0xFFE1, exif) +
         number(0xFFDA, 2, true);
}

TEST(ExifFocalLength, IsReadInEitherByteOrder) {
  EXPECT_EQ(exif_focal_length_35mm(jpeg(26, true)), 26);
  EXPECT_EQ(exif_focal_length_35mm(jpeg(28, false)), 28);
}

TEST(ExifFocalLength, OfWhatDoesNotSayIsNothing) {
  EXPECT_FALSE(exif_focal_length_35mm(jpeg(0, true)));  // "unknown" by the standard
  EXPECT_FALSE(exif_focal_length_35mm("no picture"));
  EXPECT_FALSE(exif_focal_length_35mm(""));
  std::string whole = jpeg(26, true);
  for (size_t length = 0; length < whole.size(); ++length)
    exif_focal_length_35mm(whole.substr(0, length));  // nothing is read beyond the end
  EXPECT_FALSE(exif_focal_length_35mm(whole.substr(0, whole.size() - 20)));
}

// A directory with one field: the name, which is stored elsewhere if it is longer than four
// letters.
std::string named_jpeg(const std::string& name) {
  const auto n = [](unsigned value, size_t bytes) { return number(value, bytes, true); };
  std::string tiff = "MM" + n(42, 2) + n(8, 4) + n(1, 2) + n(0x0110, 2) + n(2, 2) +
                     n(static_cast<unsigned>(name.size() + 1), 4);
  tiff += name.size() < 4 ? name + std::string(4 - name.size(), '\0') : n(26, 4);
  tiff += n(0, 4) + name + std::string(1, '\0');
  const std::string exif = std::string("Exif\0\0", 6) + tiff;
  return number(0xFFD8, 2, true) + number(0xFFE1, 2, true) +
         number(static_cast<unsigned>(exif.size() + 2), 2, true) + exif + number(0xFFDA, 2, true);
}

TEST(CameraModel, IsReadAndKnown) {
  EXPECT_EQ(exif_model(named_jpeg("iPhone 12")), "iPhone 12");
  EXPECT_EQ(exif_model(named_jpeg("X5")), "X5");
  EXPECT_EQ(exif_model(jpeg(26, true)), "");
  const std::string whole = named_jpeg("Pixel 6 Pro");
  for (size_t length = 0; length < whole.size(); ++length) exif_model(whole.substr(0, length));
  EXPECT_EQ(telephone_focal_length_35mm("iPhone 12 mini"), 26);
  EXPECT_EQ(telephone_focal_length_35mm("iPhone 15 Pro Max"), 24);
  EXPECT_EQ(telephone_focal_length_35mm("iPhone X"), 28);
  EXPECT_EQ(telephone_focal_length_35mm("SM-G991B"), 26);
  EXPECT_FALSE(telephone_focal_length_35mm("EOS R5"));
  EXPECT_FALSE(telephone_focal_length_35mm(""));
}

// The video's packets in a container with the metadata of telephones.
void write_named(const std::string& source, const std::string& target,
                 const std::vector<std::pair<std::string, std::string>>& said) {
  AVFormatContext *in = nullptr, *out = nullptr;
  ASSERT_EQ(avformat_open_input(&in, source.c_str(), nullptr, nullptr), 0);
  ASSERT_GE(avformat_find_stream_info(in, nullptr), 0);
  ASSERT_GE(avformat_alloc_output_context2(&out, nullptr, "mov", target.c_str()), 0);
  AVStream* stream = avformat_new_stream(out, nullptr);
  avcodec_parameters_copy(stream->codecpar, in->streams[0]->codecpar);
  stream->codecpar->codec_tag = 0;
  for (const auto& [key, value] : said) av_dict_set(&out->metadata, key.c_str(), value.c_str(), 0);
  AVDictionary* options = nullptr;
  av_dict_set(&options, "movflags", "use_metadata_tags", 0);
  ASSERT_GE(avio_open(&out->pb, target.c_str(), AVIO_FLAG_WRITE), 0);
  ASSERT_GE(avformat_write_header(out, &options), 0);
  AVPacket* packet = av_packet_alloc();
  while (av_read_frame(in, packet) == 0) {
    av_packet_rescale_ts(packet, in->streams[0]->time_base, stream->time_base);
    packet->pos = -1;
    ASSERT_GE(av_interleaved_write_frame(out, packet), 0);
  }
  av_packet_free(&packet);
  av_write_trailer(out);
  avio_closep(&out->pb);
  av_dict_free(&options);
  avformat_free_context(out);
  avformat_close_input(&in);
}

TEST(LensFacts, OfAVideoAreItsMetadata) {
  const TemporaryFolder place;
  const std::string source = WALKTRACK_SOURCE_DIR "/data/demo/side.mp4",
                    video = (place / "named.mov");
  write_named(source, video,
              {{"com.apple.quicktime.model", "iPhone 13"},
               {"com.apple.quicktime.camera.focal_length.35mm_equivalent", "26"}});
  EXPECT_EQ(camera_model(video), "iPhone 13");
  EXPECT_EQ(focal_length_35mm(video), 26);
  EXPECT_EQ(camera_model(source), "");
}

TEST(FocalLength, OfAFolderIsThatOfItsFirstImage) {
  const TemporaryFolder place;
  place.write("frames/1.jpg", jpeg(35, true));
  place.write("frames/2.jpg", jpeg(50, true));
  EXPECT_EQ(focal_length_35mm(place / "frames"), 35);
  EXPECT_FALSE(focal_length_35mm(place / "nowhere.mp4"));
  EXPECT_FALSE(
      focal_length_35mm(std::filesystem::path(WALKTRACK_SOURCE_DIR) / "data/demo/side.mp4"));
}

}  // namespace
}  // namespace walktrack
