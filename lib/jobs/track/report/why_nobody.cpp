#include "jobs/track/report/why_nobody.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/anthropometry.h"
#include "io/video/scene_video.h"
#include "tracker/detect/figure_places.h"
#include "tracker/tracker_scene.h"

namespace walktrack {
inline namespace jobs {

namespace {

using anthropometry::kUsualSpeed;
using Eigen::Vector2d;

constexpr double kShortest = 0.5;  // s, of what is searched
constexpr double kBetween = 0.4;   // s between inspected frames
constexpr int kMostLooks = 40;     // inspected frames
constexpr double kFar = 4;         // factor by which smaller figures are tried as well

// The best figure of a frame, nats; 0 = none is better than an empty scene.
struct Seen {
  double score = 0;
  Vector2d place = Vector2d::Zero();
};

struct Account {
  Seen best, best_small;
  double speed = 0;  // m/s, of the motion at the place of the best figure
};

class Looker {
 public:
  Looker(const SearchedVideo& searched, TrackSetup& setup)
      : searched_(searched),
        setup_(setup),
        figures_(setup.scene.model, searched.prior),
        near_(place_grid(setup.scene.cameras, height(), searched.config)) {
    for (const Vector2d& place :
         standing_places(setup.scene.cameras, kFar * height(), searched.config)) {
      if (px(place) < least_px()) far_.places.push_back(place);
    }
    far_.guides.resize(far_.places.size());
  }

  bool has_pictures() const { return setup_.scene.pictures; }
  double height() const { return setup_.scene.model.body.subject.height; }
  // Height of the subject at a place in the image of the first camera, px.
  double px(const Vector2d& place) const {
    return height_px(searched_.scene.cameras[0].camera, place, height());
  }
  // Height of the smallest figure that is searched; 0 if there is none.
  double least_px() const {
    double least = near_.places.empty() ? 0 : px(near_.places[0]);
    for (const Vector2d& place : near_.places) least = std::min(least, px(place));
    return least;
  }

  Account look(const JobControl& control) {
    SceneVideo video(searched_.scene);
    const int all = std::max(1, video.frame_count());
    const int step =
        std::max(all / kMostLooks, static_cast<int>(std::lround(kBetween * video.frame_rate())));
    Account account;
    Seen before;
    SceneFrames frames;
    for (int n = 0; !control.stopping() && video.read(frames); ++n) {
      if (n % std::max(1, step) != 0) continue;
      control.progress("looking again", static_cast<size_t>(n), static_cast<size_t>(all));
      const SceneEvidence evidence = evidence_of(video, frames);
      const Seen seen = best_of(evidence, near_);
      if (std::min(seen.score, before.score) > 0 && seen.score > account.best.score)
        account.speed = (seen.place - before.place).norm() * video.frame_rate() / step;
      if (seen.score > account.best.score) account.best = seen;
      const Seen small = best_of(evidence, far_);
      if (small.score > account.best_small.score) account.best_small = small;
      before = seen;
    }
    return account;
  }

 private:
  SceneEvidence evidence_of(const SceneVideo& video, const SceneFrames& frames) {
    SceneEvidence evidence(setup_.observers.size());
    for (size_t c = 0; c < setup_.observers.size(); ++c) {
      const Region& region = searched_.everywhere[c];
      if (searched_.scene.cameras[c].video.empty()) {
        const FrameToLookAt frame{video.source(c), frames.source[c], frames.number, region};
        setup_.observers[c].observe({}, region, evidence[c], setup_.detections.look(c, frame));
      } else {
        Image picture;
        video.source(c).picture(setup_.observers[c].shrink(), picture);
        setup_.observers[c].observe(picture, region, evidence[c]);
      }
    }
    return evidence;
  }

  Seen best_of(const SceneEvidence& evidence, const PlaceGrid& grid) const {
    const auto score = [&](const Vector2d& place) {
      const double heading = side_on_heading(setup_.scene.cameras[0], place);
      return place_score(setup_.scene, evidence, setup_.scene.model.body,
                         figures_.at(kUsualSpeed, heading), place, heading);
    };
    const std::vector<Place> found = find_figures(score, grid, searched_.config, searched_.threads);
    return found.empty() ? Seen{} : Seen{found[0].score, found[0].position};
  }

  const SearchedVideo& searched_;
  TrackSetup& setup_;
  PoseTemplates figures_;
  PlaceGrid near_, far_;  // places at which figures are large enough, and at which they
                          // are smaller
};

std::string in_words(const Account& seen, const Looker& looker, const DetectorConfig& config) {
  if (seen.best.score < config.least_score && seen.best_small.score >= config.least_score) {
    return fmt::format(
        ": the person in the video is about {:.0f} px high, at least {:.0f} px are needed",
        looker.px(seen.best_small.place), std::ceil(looker.least_px()));
  }
  if (seen.best.score < config.least_score) {
    const std::string size =
        seen.best.score > 0
            ? fmt::format("; a person there is {:.0f} px high, at least {:.0f} px are needed",
                          looker.px(seen.best.place), looker.least_px())
            : std::string();
    return fmt::format(": {}; the best place has {:.1f} nats, {:g} are needed{}",
                       looker.has_pictures()
                           ? "no person stands out from the background"
                           : "no keypoints are those of a person who walks on the ground",
                       seen.best.score, config.least_score, size);
  }
  if (seen.speed < config.slowest) {
    return fmt::format(
        ": a figure stands out ({:.0f} nats) but does not walk; it moves at {:.2f} m/s, {:g} m/s "
        "are needed",
        seen.best.score, seen.speed, config.slowest);
  }
  return fmt::format(
      ": a figure stands out ({:.0f} nats), but no straight walk of {:g} to {:g} m/s explains "
      "{:g} s of it: it may be hidden, cut off by the picture's edge, or turn",
      seen.best.score, config.slowest, config.fastest, config.window);
}

// Only lines past the subject's place are walks of the subject.
std::string place_asked_for(const Scene& scene) {
  if (!scene.near) return {};
  const Vector2d& place = scene.near->position;
  return fmt::format(
      "; only walks past ({:.1f}, {:.1f}) m at {:g} s count, as subject: near states", place.x(),
      place.y(), scene.near->time);
}

}  // namespace

std::string why_nobody(const SearchedVideo& searched, TrackSetup& setup, double seconds,
                       const JobControl& control) {
  if (searched.scene.initial) return {};
  if (seconds < kShortest - 1e-9) {
    return fmt::format(": the video lasts {:.2f} s, a walk takes at least {:g} s to be found",
                       seconds, kShortest);
  }
  Looker looker(searched, setup);
  if (looker.least_px() == 0) {
    return ": no place on the ground shows a person whole and large enough in all cameras";
  }
  return in_words(looker.look(control), looker, searched.config) + place_asked_for(searched.scene);
}

}  // namespace jobs
}  // namespace walktrack
