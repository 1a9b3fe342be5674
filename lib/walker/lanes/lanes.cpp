// The instruction set in use.
#include "walker/lanes/lanes.h"

#include "walker/lanes/lane_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "walker/lanes/lanes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include "walker/lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace walktrack {
inline namespace walker {
namespace HWY_NAMESPACE {
namespace {

size_t lanes_of_target() { return hn::Lanes(Tag()); }
const char* name_of_target() { return hwy::TargetName(HWY_TARGET); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace walker
}  // namespace walktrack
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace walktrack {
inline namespace walker {
namespace {
HWY_EXPORT(lanes_of_target);
HWY_EXPORT(name_of_target);
}  // namespace

size_t lane_count() { return HWY_DYNAMIC_DISPATCH(lanes_of_target)(); }

const char* lane_target() { return HWY_DYNAMIC_DISPATCH(name_of_target)(); }

}  // namespace walker
}  // namespace walktrack
#endif
