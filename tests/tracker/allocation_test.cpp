// Heap allocations of a frame of tracking.
#include <algorithm>

#include <gtest/gtest.h>

#include "counted_heap.h"
#include "fixture.h"
#include "made_evidence.h"
#include "tests/observation/scenes.h"
#include "tests/sanitized.h"
#include "tests/tracker/frame_time.h"
#include "tracker/walker_filter.h"

namespace walktrack {
namespace {

// The number for the frame with most allocations, after the first few frames.
long most_allocations(int particles) {
  const Walking walking{};
  TrackerScene scene = unseen(walking.model, kDt);
  SceneEvidence evidence;
  for (const double x : {0.0, 1.0}) {
    scene.cameras.push_back(camera_at({x, -4, 1}, {x, 0, 1}, 300, kEvidenceWidth, kEvidenceHeight));
    evidence.push_back(made_evidence(0.2, false));
  }
  const WalkerFilterContext context{scene, walking.context(kDt), 20, 1};
  WalkerFilter filter({}, 1, 1);
  filter.start(walkers_on_their_way(context.motion, particles));
  long most = 0;
  int layers = 0;
  for (uint32_t frame = 0; frame < 30; ++frame) {
    const long before = allocations();
    const FrameRecord record = advance(context, evidence, frame, 1, false, filter);
    EXPECT_TRUE(record.tracked);
    if (frame < 10) continue;  // the filter's own arrays have grown
    most = std::max(most, allocations() - before);
    layers = std::max(layers, record.filter.layers);
  }
  EXPECT_GT(layers, 1);  // resampled and moved
  return most;
}

// During a step walkers change feet, meet their knees' stops, are moved and weighted, and only the
// frame's weights and its record are allocated.
TEST(Allocation, DoesNotGrowWithParticles) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer owns the allocator";
  const long few = most_allocations(50);
  EXPECT_GT(few, 0);  // the counter works
  EXPECT_LE(few, 16);
  EXPECT_EQ(most_allocations(400), few);
}

}  // namespace
}  // namespace walktrack
