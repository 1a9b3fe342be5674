#include "io/archive/state_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/archive/state_fields.h"
#include "observation/background/levels.h"

namespace walktrack {
inline namespace io {

namespace {

// Visits all numbers of a struct through its fields() and checks that they are finite.
class FiniteNumbers {
 public:
  template <typename... T>
  void operator()(const T&... values) {
    (look(values), ...);
  }
  bool all() const { return all_; }

 private:
  template <typename T>
  void look(const T& value) {
    if constexpr (std::is_floating_point_v<T>) {
      all_ = all_ && std::isfinite(value);
    } else if constexpr (!std::is_arithmetic_v<T> && !std::is_enum_v<T>) {
      fields(*this, value);
    }
  }
  template <typename T>
  void look(const AnyNumber<T>&) {}
  template <typename T>
  void look(const Within<T>&) {}
  template <typename T, int Rows, int Columns>
  void look(const Eigen::Matrix<T, Rows, Columns>& value) {
    all_ = all_ && value.allFinite();
  }
  template <typename T, size_t N>
  void look(const std::array<T, N>& values) {
    for (const T& value : values) look(value);
  }

  bool all_ = true;
};

template <typename T>
bool all_finite(const T& value) {
  FiniteNumbers numbers;
  numbers(value);
  return numbers.all();
}

bool sound(const BackgroundModel& model) {
  if (model.width < 1 || model.height < 1) return false;
  const Levels& levels = model.change.levels;
  if (!(levels.gain >= 1 && levels.gain <= kMostGain)) return false;
  if (!(levels.black >= 0 && levels.black <= 255)) return false;
  const size_t pixels = static_cast<size_t>(model.width) * static_cast<size_t>(model.height);
  return std::ranges::all_of(
      std::array{&model.luma, &model.orange, &model.green, &model.luma_precision,
                 &model.chroma_precision},
      [&](const std::vector<float>* plane) { return plane->size() == pixels; });
}

bool sound(const AppearanceState& state) {
  const size_t bins = state.frames > 0 ? size_t{kColourBins} : 0;
  return state.anchor.size() == bins && state.recent.size() == bins &&
         state.log_density.size() == size_t{kColourBins};
}

bool sound_weight(double log_weight) {
  return !std::isnan(log_weight) && log_weight < std::numeric_limits<double>::infinity();
}

}  // namespace

std::string_view trouble_of(const ObserverState& state) {
  if (state.background && !sound(*state.background)) return "a background of another size";
  if (!std::ranges::all_of(state.appearance,
                           [](const AppearanceState& each) { return sound(each); }))
    return "colours of another number of bins";
  if (!state.scene.empty() && state.scene.size() != size_t{kColourBins})
    return "colours of another number of bins";
  const GreyImage& grey = state.grey_before;
  const size_t pixels = static_cast<size_t>(grey.width) * static_cast<size_t>(grey.height);
  if (!grey.pixels.empty() && grey.pixels.size() != pixels) return "an image of another size";
  return "";
}

std::string_view trouble_of(const TrackerState& state) {
  const ParticleSet<WalkerParticle>& set = state.filter.set;
  const size_t count = set.states.size();
  if (count == 0 || set.log_weights.size() != count || set.log_likelihoods.size() != count)
    return "particles and weights of different numbers";
  bool alive = false;
  for (size_t i = 0; i < count; ++i) {
    if (!sound_weight(set.log_weights[i]) || !sound_weight(set.log_likelihoods[i]))
      return "a weight that is no number";
    if (!std::isfinite(set.log_weights[i])) continue;
    alive = true;
    if (!all_finite(set.states[i])) return "a particle with a number that is not finite";
  }
  return alive ? "" : "particles that are all dead";
}

std::string_view trouble_of(const FrameRecord& record) {
  if (!record.tracked) return "";
  const FrameEstimate& estimate = record.estimate;
  if (estimate.joint_count < kJointCountWithoutArms) return "a pose without all joints";
  const bool known =
      all_finite(estimate.pose) && std::isfinite(estimate.speed) &&
      std::all_of(estimate.joints.at.begin(),
                  estimate.joints.at.begin() + static_cast<std::ptrdiff_t>(estimate.joint_count),
                  [](const Eigen::Vector3d& joint) { return joint.allFinite(); });
  return known ? "" : "a pose with a number that is not finite";
}

std::string_view trouble_of(const Checkpoint& checkpoint) {
  if (checkpoint.observers.empty() || checkpoint.regions.size() != checkpoint.observers.size())
    return "cameras and regions of different numbers";
  for (const ObserverState& observer : checkpoint.observers)
    if (const auto trouble = trouble_of(observer); !trouble.empty()) return trouble;
  return trouble_of(checkpoint.tracker);
}

}  // namespace io
}  // namespace walktrack
