// The list of all likelihood terms, over which evidence, likelihood, configuration, plan and
// reports iterate. Its order is that of sums and tables.
//
//   log p(images | pose) = sum over terms and cameras of T::log_likelihood + constant
#pragma once

#include <array>
#include <cstddef>

#include "observation/flow/flow_term.h"
#include "observation/flow/leg_order_term.h"
#include "observation/keypoints/keypoint_term.h"
#include "observation/silhouette/silhouette_term.h"

namespace walktrack {
inline namespace observation {

template <typename... T>
struct TermList {
  static constexpr size_t kCount = sizeof...(T);

  // The members of all terms in one struct; each term has names of its own.
  struct Evidence : T::Evidence... {};
  struct State : T::State... {};

  // Calls f.template operator()<Term>() for each of them, in order.
  template <typename F>
  static constexpr void each(F&& f) {
    (f.template operator()<T>(), ...);
  }
  // A tuple with one object for each term, such as map<std::tuple, MemoryOf>, constructed from the
  // same arguments.
  template <template <typename...> typename Of, template <typename> typename From>
  using map = Of<From<T>...>;
  template <template <typename...> typename Of, template <typename> typename From, typename... A>
  static map<Of, From> make(A&... arguments) {
    return {From<T>(arguments...)...};
  }
};

using Terms = TermList<SilhouetteTerm, FlowTerm, LegOrderTerm, KeypointTerm>;

// The evidence of a frame of one camera.
struct CameraEvidence : Terms::Evidence {
  double pixel_weight = 1;  // independent pixels that a pixel represents: tempers all sums over
                            // pixels
};

// The state that an observer of one camera keeps between frames.
struct ObserverState : Terms::State {};

// Whether a term is computed for particles at all.
template <typename Term>
inline constexpr bool kWeighsParticles = Term::kStage != TermStage::kTracks;

// Whether a term alone can distinguish a track's left leg from its right one.
template <typename Term>
inline constexpr bool kTellsLegsApart = requires {
  &Term::names_log_odds;
};

// For one camera: the sum of all terms that need no previous frame.
inline double still_log_likelihood(const ObservationConfig& config, const CameraEvidence& evidence,
                                   const Camera& camera, const PosedBody& body) {
  double sum = 0;
  Terms::each([&]<typename Term>() {
    if constexpr (kWeighsParticles<Term> && !Term::kAsksBefore)
      if (Term::says(evidence))
        sum += Term::log_likelihood(config, evidence, camera, body, nullptr);
  });
  return sum;
}

// By term, in the order of the list; NaN if it has no evidence.
using TermValues = std::array<double, Terms::kCount>;

// The flags that turn terms on.
std::vector<TermSwitch> term_switches();

}  // namespace observation
}  // namespace walktrack
