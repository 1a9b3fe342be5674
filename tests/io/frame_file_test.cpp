#include "io/archive/frame_file.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

FrameRecord record(int number) {
  FrameRecord out;
  out.tracked = number % 2 == 1;
  out.estimate.speed = 0.1 * number;
  out.estimate.spread[3][1] = {1, 2, 3, 4};
  out.samples.resize(static_cast<size_t>(number));
  for (JointPositions& sample : out.samples) sample[Joint::kHead].z() = number;
  out.fallen = number;
  return out;
}

void expect_record(const FrameRecord& found, int number) {
  EXPECT_EQ(found.tracked, number % 2 == 1);
  EXPECT_EQ(found.estimate.speed, 0.1 * number);
  EXPECT_EQ(found.estimate.spread[3][1].p05, 3);
  ASSERT_EQ(found.samples.size(), static_cast<size_t>(number));
  for (const JointPositions& sample : found.samples) EXPECT_EQ(sample[Joint::kHead].z(), number);
  EXPECT_EQ(found.fallen, number);
}

TEST(FrameFile, HandsBackWhatWasAppendedInAnyOrder) {
  const TemporaryFolder folder;
  FrameFile file(folder / "frames.bin");
  EXPECT_EQ(file.size(), 0u);
  for (int i = 0; i < 5; ++i) file.append(record(i));
  expect_record(file.back(), 4);
  for (const int i : {3, 0, 4, 1, 2}) expect_record(file[static_cast<size_t>(i)], i);
  int number = 0;
  for (const FrameRecord& each : file) expect_record(each, number++);
  EXPECT_EQ(number, 5);
}

TEST(FrameFile, GoesOnAfterTheRecordsThatAreKept) {
  const TemporaryFolder folder;
  const std::string path = folder / "frames.bin";
  {
    FrameFile file(path);
    for (int i = 0; i < 5; ++i) file.append(record(i));
  }
  fs::resize_file(path, fs::file_size(path) - 7);  // killed in the middle of the last one
  FrameFile file(path, 3);
  ASSERT_EQ(file.size(), 3u);
  expect_record(file.back(), 2);
  file.append(record(7));
  expect_record(file[3], 7);
  EXPECT_EQ(file.bytes(), fs::file_size(path));
  EXPECT_THROW(FrameFile(path, 5), InputError);
}

TEST(FrameFile, FollowsNoLink) {
  const TemporaryFolder folder;
  const std::string target = folder.write("mine.txt", "kept");
  fs::create_symlink(target, folder / "frames.bin");
  EXPECT_THROW(FrameFile(folder / "frames.bin"), std::runtime_error);
  EXPECT_EQ(read_file(target), "kept");
}

}  // namespace
}  // namespace walktrack
