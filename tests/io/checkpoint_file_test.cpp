#include "io/archive/checkpoint_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const Origin kOrigin{{"version", "1"}, {"scene", "abc"}};

Checkpoint checkpoint() {
  Checkpoint out{kOrigin, 7, 5, 1234, {}, {{{1, 2, 3, 4}, .01, true}}, {}};
  ObserverState observer;
  observer.background = BackgroundModel{2, 1, {.1f, .2f}, {}, {}, {}, {}};
  observer.grey_before = {3, 1, {1, 2, 3}};
  observer.errors.scale[2] = 0.25;
  observer.use.matched = 9;
  out.observers = {observer};
  out.tracker.filter.set.states.resize(3);
  out.tracker.filter.set.states[2].pose.heading = 0.5;
  out.tracker.filter.scale = 0.25;
  out.tracker.supports = {1, 2};
  out.tracker.last_seen = LastSeen{{1, 2}, {3, 4}, 6};
  return out;
}

class CheckpointFile : public testing::Test {
 protected:
  CheckpointFile() { write_checkpoint(path_, checkpoint()); }
  const TemporaryFolder folder_;
  const fs::path path_ = folder_.path() / "checkpoint.bin";
};

TEST_F(CheckpointFile, ComesBack) {
  const FoundCheckpoint found = read_checkpoint(path_, kOrigin);
  EXPECT_EQ(found.unfit, "");
  ASSERT_TRUE(found.checkpoint);
  EXPECT_EQ(found.checkpoint->frames_read, 7u);
  EXPECT_EQ(found.checkpoint->record_bytes, 1234u);
  EXPECT_EQ(found.checkpoint->regions.at(0).area.y1, 4);
  EXPECT_EQ(found.checkpoint->observers.at(0).grey_before.pixels, (std::vector<uint8_t>{1, 2, 3}));
  EXPECT_EQ(found.checkpoint->observers[0].background->luma[1], .2f);
  EXPECT_EQ(found.checkpoint->observers[0].errors.scale[2], 0.25);
  EXPECT_EQ(found.checkpoint->observers[0].use.matched, 9);
  EXPECT_EQ(found.checkpoint->tracker.filter.set.states.at(2).pose.heading, 0.5);
  EXPECT_EQ(found.checkpoint->tracker.filter.scale, 0.25);
  EXPECT_EQ(found.checkpoint->tracker.last_seen->velocity.y(), 4);
}

TEST_F(CheckpointFile, IsOfNoUseForAnythingElseAndSaysForWhat) {
  Origin other = kOrigin;
  other[1].second = "abd";
  const FoundCheckpoint found = read_checkpoint(path_, other);
  EXPECT_FALSE(found.checkpoint);
  EXPECT_THAT(found.unfit, HasSubstr("of another scene"));
}

TEST_F(CheckpointFile, NobodyHasToLeaveOne) {
  const FoundCheckpoint found = read_checkpoint(folder_ / "none", kOrigin);
  EXPECT_FALSE(found.checkpoint);
  EXPECT_EQ(found.unfit, "");
}

// One bit of it or its last bytes: whatever is damaged.
TEST_F(CheckpointFile, ADamagedOneIsNotBelieved) {
  const std::string sound = read_file(path_);
  for (size_t at = 0; at < sound.size(); at += 97) {
    std::string damaged = sound;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    folder_.write("checkpoint.bin", damaged);
    EXPECT_THAT(read_checkpoint(path_, kOrigin).unfit, HasSubstr("no sound checkpoint")) << at;
    folder_.write("checkpoint.bin", sound.substr(0, at));
    EXPECT_THAT(read_checkpoint(path_, kOrigin).unfit, HasSubstr("no sound checkpoint")) << at;
  }
}

}  // namespace
}  // namespace walktrack
