// Searches a walk in a window of frames that slides over the video (tracker/detect/detector.h), and
// the subject standing before it (tracker/detect/standing_start.h).
#pragma once

#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "tracker/detect/search_window.h"
#include "tracker/detect/slight_walks.h"
#include "tracker/detect/standing_start.h"
#include "tracker/others/nearby_people.h"

namespace walktrack {
inline namespace tracker {

// The number of the window's first frame, and where the subject was last seen if the track was
// lost.
struct SearchMoment {
  uint32_t first_frame;
  const std::optional<LastSeen>& last_seen;
};

// A walk, and how many frames before the window it begins: the frames in which the subject came out
// from behind something. The walk's place is that in the window's first frame.
struct FoundWalk {
  DetectedWalk walk;
  size_t lead = 0;
  std::optional<DetectedWalk> first{};  // as it was found while the subject was half hidden
};

// The shortest window that is searched, s: the time for which start hypotheses compete.
inline constexpr double kShortestWindow = 0.5;

class WalkSearch {
 public:
  // Adds the next frame to the window.
  void push(const SceneEvidence& evidence);
  const std::deque<SceneEvidence>& window() const { return window_; }
  // Whether the window has the frames of so many seconds, which are `dt` apart.
  bool lasts(double seconds, double dt) const;
  // Number of frames before the window that are kept because the subject may have stood in them,
  // and whose records have not been returned yet.
  size_t waiting() const { return waiting_.size(); }

  // Seconds of such frames that are kept at most, of a subject who may stand at first or not.
  static double kept_seconds(bool may_stand);

  // Looks whether somebody walks through the window. Of a window that slides on by a frame at a
  // time only every `step`-th is looked at. Returns how many windows back the first one is that may
  // have a walk and was not looked at, or had a walk that was not believed until it had moved on;
  // nullopt if none has.
  std::optional<size_t> look(const TrackContext& context, const SearchMoment& moment, size_t step);
  // The walk through the window; nullopt if nobody walks there, or not clearly enough. If the
  // subject is half hidden at first, the place is uncertain: the walk is searched once more after
  // that. Both walks begin where the first one was found. A subject who is whole is found once more
  // by the colours of their clothes (tracker/detect/clothes.h), with which frames are compared from
  // then on.
  std::optional<FoundWalk> find(const TrackContext& context, const SearchMoment& moment);
  // The walk that the scene gives, where the window's images together with what the scene says of
  // it place it; in the colours of the subject's clothes, as find().
  DetectedWalk nearest_to(const TrackContext& context, const SearchMoment& moment,
                          const DetectedWalk& given);
  // A walk of either kind together with an estimate of the subject's height.
  SizedWalk with_size(const TrackContext& context, const SearchMoment& moment,
                      const DetectedWalk& walk) const;
  // To be called when the size of the subject has changed.
  void forget_places() { places_ = {}; }
  // To be called when the likelihood has changed.
  void forget_scores();

  // The subject standing before the walk, if they do; the score is that of standing and walking
  // together.
  std::optional<StandingStart> standing_lead(const TrackContext& context,
                                             const DetectedWalk& walk) const;
  // Mean score, nats a frame, of a walk through the window that begins so many frames before it.
  double score_with_lead(const TrackContext& context, const DetectedWalk& walk, size_t lead) const;
  // Moves the beginning of the window back by some of the frames that wait, or forward again.
  void reach_back(size_t frames);
  void let_go(size_t frames);
  // Moves the whole window back by some of the frames that wait, and on again by one; the frames
  // after it are set aside.
  void step_back(size_t frames);
  void step_on();
  // Removes what hides the subject at first from the evidence of the window and of the frames
  // before it in which the walk begins.
  void hide_occluders(const TrackContext& context, const FoundWalk& found);

  // Weighs the pixels of all frames as those of a subject at the places of a walk, whose score
  // changes accordingly; frames come with the weights of a subject at a usual distance.
  void weigh_at(const TrackContext& context, FoundWalk& found);
  // Multiplies the weight of the pixels of the frames before the window, in which the subject may
  // stand (kStillOutlines).
  void weigh_waiting(double share);
  // Follows others who are near the walk through the window; from then on their pixels are no
  // evidence, and the score of the walk changes accordingly. Returns who is near after the window.
  NearbyPeople hide_others(const TrackContext& context, FoundWalk& found);
  // Undoes these, and what find() has done to the evidence.
  void restore_evidence(const TrackContext& context);

  // Moves the beginning of the window forward by a frame. Returns whether the oldest of the frames
  // that wait was dropped.
  bool slide(const TrackContext& context);
  // Returns the window's frames; afterwards no frames wait any more.
  std::deque<SceneEvidence> take();
  // Returns the frames after the window that were set aside.
  std::deque<SceneEvidence> take_later();

 private:
  // The same walk, or a better one, by the colours that it has: the frames are compared with them
  // until restore_evidence().
  DetectedWalk in_its_clothes(const TrackContext& context, const SearchMoment& moment,
                              DetectedWalk walk);
  // Compares the frames with the clothes that somebody on that walk wears, until
  // restore_evidence(); returns whether their colours can be learned.
  bool compare_with_clothes(const TrackContext& context, const DetectedWalk& walk);
  // Nats a frame, of a walk through the window.
  double mean_score(const TrackContext& context, const DetectedWalk& walk) const;
  SearchWindow view(const TrackContext& context, const SearchMoment& moment) const;
  const std::vector<Place>& candidates(const SearchWindow& window, size_t index);
  // `clearly`: the share of the score by which a walk has to explain the window better than
  // standing.
  bool walks_clearly(const TrackContext& context, uint32_t first_frame, const DetectedWalk& walk,
                     double clearly);
  std::optional<DetectedWalk> find_here(const TrackContext& context, const SearchMoment& moment,
                                        double clearly);

  // Undoes hide_occluders().
  void show_occluders();

  struct HalfHidden {
    DetectedWalk walk;
    uint32_t frame;      // number of the first frame of its window
    uint32_t search_at;  // number of the frame from which on it is searched again
  };

  std::deque<SceneEvidence> waiting_, window_, later_;
  std::deque<std::optional<std::vector<Place>>> candidates_;  // of the window's frames, once
                                                              // computed
  PlaceGrid places_;                                          // of a figure, once computed
  std::optional<size_t> passed_;  // windows since the last one that was looked at
  SlightWalks slight_walks_;      // of the newest windows
  std::optional<HalfHidden> half_hidden_;
  std::vector<std::pair<size_t, SceneEvidence>> with_others_;  // frames of the window, before
  std::vector<SceneEvidence> unhidden_;  // frames that end with the window's, before
  std::vector<double> search_weights_;   // by camera, while the frames are weighed at a walk
  bool clothed_ = false;                 // whether frames are compared with the subject's clothes
};

}  // namespace tracker
}  // namespace walktrack
