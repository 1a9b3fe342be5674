#include "io/archive/frame_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/io/sample_state.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

FrameRecord record(int number) {
  FrameRecord out;
  out.tracked = number % 2 == 1;
  out.estimate.joint_count = kJointCountWithoutArms;
  for (Eigen::Vector3d& joint : out.estimate.joints.at) joint.setZero();
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

// A file of sample_record() twice, and its bytes.
class DamagedFrames : public testing::Test {
 protected:
  DamagedFrames() {
    FrameFile file(path_);
    file.append(sample_record());
    file.append(sample_record());
    file.flush();
    sound_ = read_file(path_);
  }
  std::string trouble_of_file(const std::string& content, uint64_t records = 2) const {
    folder_.write("frames.bin", content);
    return frame_file_trouble(path_, records, sound_.size());
  }
  const TemporaryFolder folder_;
  const fs::path path_ = folder_.path() / "frames.bin";
  std::string sound_;
};

TEST_F(DamagedFrames, AreSeenBeforeAnybodyCountsOnThem) {
  EXPECT_EQ(trouble_of_file(sound_), "");
  EXPECT_EQ(trouble_of_file(sound_ + "the next frame, half written"), "");
  EXPECT_THAT(trouble_of_file(sound_, 1), HasSubstr("holds other frames"));
  EXPECT_THAT(trouble_of_file(sound_, 3), HasSubstr("lacks frames"));
  for (size_t size = 0; size < sound_.size(); size += 331)
    EXPECT_THAT(trouble_of_file(sound_.substr(0, size)), HasSubstr("lacks frames")) << size;
  std::string long_record = sound_;
  long_record[3] = '\x7f';  // the highest byte of its length
  EXPECT_THAT(trouble_of_file(long_record), HasSubstr("lacks frames"));
  // Its estimate begins after `tracked`, with the number of joints.
  std::string many_joints = sound_;
  many_joints[5] = '\x7f';
  EXPECT_THAT(trouble_of_file(many_joints), HasSubstr("out of its bounds"));
  std::string flag = sound_;
  flag[4] = 2;
  EXPECT_THAT(trouble_of_file(flag), HasSubstr("neither set nor not"));
  fs::remove(path_);
  EXPECT_THAT(frame_file_trouble(path_, 2, sound_.size()), HasSubstr("lacks frames"));
}

// 2 GB are announced, but only a few kB follow.
TEST_F(DamagedFrames, TakeNoMemoryForWhatTheyAnnounce) {
  std::string long_record = sound_;
  long_record[3] = '\x7f';
  folder_.write("frames.bin", long_record);
  EXPECT_THROW(FrameFile(path_, 1), InputError);
}

// Many of them must not use up the files that a process may open.
TEST_F(DamagedFrames, AreClosedAgain) {
  const auto open_files = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  folder_.write("frames.bin", "");
  const auto before = open_files();
  for (int i = 0; i < 5; ++i) EXPECT_THROW(FrameFile(path_, 1), InputError);
  EXPECT_EQ(open_files(), before);
}

}  // namespace
}  // namespace walktrack
