#include "io/archive/checkpoint_file.h"

#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/sample_state.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const Origin kOrigin{{"version", "1"}, {"scene", "abc"}};

class CheckpointFile : public testing::Test {
 protected:
  CheckpointFile() { write_checkpoint(path_, sample_checkpoint(kOrigin)); }
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
  EXPECT_EQ(found.checkpoint->tracker.filter.set.states.at(0).pose.heading, 0.5);
  EXPECT_EQ(found.checkpoint->tracker.filter.scale, 0.25);
  EXPECT_EQ(found.checkpoint->tracker.monitor.last_seen->velocity.y(), 4);
}

TEST_F(CheckpointFile, IsOfNoUseForAnythingElseAndSaysForWhat) {
  Origin other = kOrigin;
  other[1].second = "abd";
  const FoundCheckpoint found = read_checkpoint(path_, other);
  EXPECT_FALSE(found.checkpoint);
  EXPECT_THAT(found.unfit, HasSubstr("with other settings or inputs (scene abc -> abd)"));
  EXPECT_EQ(found.changed, "scene abc -> abd");
}

TEST_F(CheckpointFile, MayBeMissing) {
  const FoundCheckpoint found = read_checkpoint(folder_ / "none", kOrigin);
  EXPECT_FALSE(found.checkpoint);
  EXPECT_EQ(found.unfit, "");
}

// A damaged file, by one bit or without its last bytes.
TEST_F(CheckpointFile, IsRefusedIfItIsDamaged) {
  const std::string sound = read_file(path_);
  for (size_t at = 0; at < sound.size(); at += 97) {
    std::string damaged = sound;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    folder_.write("checkpoint.bin", damaged);
    EXPECT_THAT(read_checkpoint(path_, kOrigin).unfit, HasSubstr("no valid checkpoint")) << at;
    folder_.write("checkpoint.bin", sound.substr(0, at));
    EXPECT_THAT(read_checkpoint(path_, kOrigin).unfit, HasSubstr("no valid checkpoint")) << at;
  }
}

struct Damage {
  const char* what;
  std::function<void(Checkpoint&)> change;
};

// A file with changed numbers may have a correct digest.
TEST_F(CheckpointFile, IsRefusedIfItIsInconsistentEvenWithACorrectDigest) {
  const auto state = [](Checkpoint& c) -> WalkerParticle& {
    return c.tracker.filter.set.states[0];
  };
  const std::vector<Damage> all{
      {"an unknown value", [&](Checkpoint& c) { state(c).stance = static_cast<Side>(7); }},
      {"not finite", [&](Checkpoint& c) { state(c).pose.root.x() = NAN; }},
      {"not finite", [&](Checkpoint& c) { state(c).walker.qd[3] = HUGE_VAL; }},
      {"not finite", [](Checkpoint& c) { c.tracker.people.others[0].place.mean.x() = NAN; }},
      {"a weight", [](Checkpoint& c) { c.tracker.filter.set.log_weights[0] = NAN; }},
      {"all dead", [](Checkpoint& c) { c.tracker.filter.set.log_weights[0] = -HUGE_VAL; }},
      {"different numbers", [](Checkpoint& c) { c.tracker.filter.set.log_weights.pop_back(); }},
      {"different numbers", [](Checkpoint& c) { c.tracker.filter.set = {}; }},
      {"different numbers", [](Checkpoint& c) { c.regions.clear(); }},
      {"out of its bounds", [](Checkpoint& c) { c.tracker.monitor.frames_below = -1; }},
      {"out of its bounds",
       [](Checkpoint& c) {
         c.tracker.estimates.stature = Stature{-1.7, 0.1};
       }},
      {"out of its bounds", [](Checkpoint& c) { c.observers[0].frames = -1; }},
      {"a background", [](Checkpoint& c) { c.observers[0].background->green.pop_back(); }},
      {"a background", [](Checkpoint& c) { c.observers[0].background->width = 1 << 20; }},
      {"a background", [](Checkpoint& c) { c.observers[0].background->change.levels.gain = 1e6F; }},
      {"an image", [](Checkpoint& c) { c.observers[0].grey_before.width = 1 << 20; }},
      {"colours", [](Checkpoint& c) { c.observers[0].appearance.resize(1); }},
      {"colours",
       [](Checkpoint& c) {
         c.observers[0].scene = {1, 2};
       }},
  };
  for (const Damage& damage : all) {
    Checkpoint damaged = sample_checkpoint(kOrigin);
    damage.change(damaged);
    write_checkpoint(path_, damaged);
    const FoundCheckpoint found = read_checkpoint(path_, kOrigin);
    EXPECT_FALSE(found.checkpoint) << damage.what;
    EXPECT_THAT(found.unfit, testing::StartsWith(path_.string() + ": is damaged: "));
    EXPECT_THAT(found.unfit, HasSubstr(damage.what));
  }
  const std::string longer = checkpoint_bytes(sample_checkpoint(kOrigin)) + "x";
  EXPECT_THAT(parse_checkpoint(longer, "c.bin", kOrigin).unfit, HasSubstr("more than it"));
}

// The state of a dead particle is arbitrary.
TEST_F(CheckpointFile, MayHaveAnyStateOfDeadParticles) {
  Checkpoint odd = sample_checkpoint(kOrigin);
  odd.tracker.filter.set.states[1].pose.root.x() = NAN;
  write_checkpoint(path_, odd);
  EXPECT_EQ(read_checkpoint(path_, kOrigin).unfit, "");
}

}  // namespace
}  // namespace walktrack
