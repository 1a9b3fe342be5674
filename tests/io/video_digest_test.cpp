#include "io/video/video_digest.h"

#include <chrono>
#include <set>

#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMiB = size_t{1} << 20;

TEST(VideoDigest, IsOfTheContentAlone) {
  const TemporaryFolder folder;
  const std::string video = folder.write("a.mp4", "frames");
  const std::string digest = video_digest(video);
  EXPECT_EQ(video_digest(folder.write("b.mp4", "frames")), digest);
  fs::last_write_time(video, fs::file_time_type::clock::now() - std::chrono::hours(1));
  EXPECT_EQ(video_digest(video), digest);
  EXPECT_NE(video_digest(folder.write("a.mp4", "framed")), digest);
  EXPECT_NE(video_digest(folder.write("a.mp4", "")), digest);
}

// Only parts of long videos are read; their beginning, end and length always count.
TEST(VideoDigest, OfLongFiles) {
  const TemporaryFolder folder;
  const auto of = [&](size_t size, size_t changed) {
    std::string bytes(size, 'x');
    if (changed < size) bytes[changed] = 'y';
    return video_digest(folder.write("video.mp4", bytes));
  };
  for (const size_t size : {4 * kMiB, 4 * kMiB + 1, 11 * kMiB + 77}) {
    const std::set<std::string> digests{of(size, size), of(size, 0), of(size, size - 1),
                                        of(size + 1, size + 1)};
    EXPECT_EQ(digests.size(), 4u) << size;
  }
  for (const size_t at : {size_t{70'000}, 2 * kMiB, 4 * kMiB - 65'000})
    EXPECT_NE(of(4 * kMiB, at), of(4 * kMiB, 4 * kMiB)) << "short ones count whole";
}

TEST(VideoDigest, OfImagesIsOfAllTogether) {
  const TemporaryFolder folder;
  for (const char* name : {"f/1.png", "f/2.png", "f/10.png"}) folder.write(name, name);
  folder.write("f/notes.txt", "no image");
  const std::string digest = video_digest(folder.path() / "f");
  EXPECT_EQ(video_digest(folder.path() / "f"), digest);
  folder.write("f/notes.txt", "still none");
  EXPECT_EQ(video_digest(folder.path() / "f"), digest);
  folder.write("f/2.png", "f/3.png");
  EXPECT_NE(video_digest(folder.path() / "f"), digest);
  folder.write("f/2.png", "f/2.png");
  fs::rename(folder.path() / "f/10.png", folder.path() / "f/11.png");
  EXPECT_NE(video_digest(folder.path() / "f"), digest) << "a dropped frame";
  fs::rename(folder.path() / "f/11.png", folder.path() / "f/3.png");
  const std::string pattern = video_digest(folder.path() / "f/%d.png");
  folder.write("f/4.png", "x");
  EXPECT_NE(video_digest(folder.path() / "f/%d.png"), pattern);
}

TEST(VideoDigest, OfNothingIsAnError) {
  const TemporaryFolder folder;
  EXPECT_THROW(video_digest(folder.path() / "none.mp4"), InputError);
  EXPECT_THROW(video_digest(folder.path()), InputError);  // no image
}

}  // namespace
}  // namespace walktrack
