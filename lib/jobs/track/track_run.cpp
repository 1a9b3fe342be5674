#include "jobs/track/track_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "body/kinematics.h"
#include "core/errors.h"
#include "core/parallel_for.h"
#include "jobs/track/input/learned_background.h"
#include "jobs/track/out_of_picture.h"
#include "jobs/track/report/stated_start.h"
#include "jobs/track/report/viewing_ray.h"
#include "jobs/track/report/why_nobody.h"
#include "observation/image_threads.h"

namespace walktrack {
inline namespace jobs {

namespace {

int threads_of(const TrackJob& job) {
  const int threads = thread_count(job.config.values.threads);
  // OpenCV's threading library prints a warning if more threads are asked for than exist.
  set_image_threads(std::min(threads, hardware_threads()));
  return threads;
}

TrackSetup timed_set_up(const TrackJob& job, double frame_rate,
                        const std::vector<ObserverState>& learned, const JobControl& control,
                        Stopwatch& watch) {
  const TimePoint start;
  TrackSetup setup = set_up(job.scene, job.config.values, frame_rate, learned, control);
  if (job.config.values.observation.background.enabled)
    watch.add("background", elapsed_since(start));
  return setup;
}

// Within a time budget the track is alone: components and new starts would make it late.
TrackerConfig tracker_config(const Config& config) {
  TrackerConfig out = config.tracker;
  if (config.budget.frame_ms > 0) {
    out.motion.turning_yaw_rate_sd = 0;
    out.start_again = false;
  }
  return out;
}

// What was done to the pictures of a camera, or to its empty scene, before they were compared.
std::vector<std::string> notes_on_pictures(const std::string& camera, const Observer& observer) {
  std::vector<std::string> out;
  const PictureChange& change = observer.change();
  if (change.levels.stretch())
    out.push_back(fmt::format(
        "camera {} {}: for tracking the levels of its pictures are multiplied by "
        "{:.1f}, and their noise is blurred",
        camera, change.levels.black > 0 ? "has little contrast" : "is dark", change.levels.gain));
  if (change.colourless)
    out.push_back(
        fmt::format("the pictures of camera {} have no colours: only brightness tells "
                    "the subject from the background",
                    camera));
  if (observer.background_from_video() > 0)
    out.push_back(
        fmt::format("camera {}: {}", camera, moved_things_text(observer.background_from_video())));
  return out;
}

}  // namespace

bool CheckpointTimer::due() const {
  constexpr double kMostShare = 0.01;  // share of the time that checkpoints may take
  return seconds_ == 0 || seconds_since(last_) >= std::max(seconds_, cost_ / kMostShare);
}

void CheckpointTimer::wrote(Clock::time_point since) {
  cost_ = seconds_since(since);
  last_ = Clock::now();
}

TrackRun::TrackRun(const TrackJob& job, SceneVideo& video, const ResultFolder& folder,
                   Origin origin, std::optional<Checkpoint> checkpoint, const JobControl& control)
    : job_(job),
      checkpoint_file_(folder.file(std::string(kCheckpointFile))),
      origin_(std::move(origin)),
      threads_(threads_of(job)),
      setup_(timed_set_up(job, video.frame_rate(),
                          checkpoint ? checkpoint->observers : std::vector<ObserverState>{},
                          control, watch_)),
      prior_(load_gait_prior()),
      budget_(job.config.values.budget),
      tracker_(setup_.scene, prior_, tracker_config(job.config.values), job.config.values.seed,
               threads_),
      video_(video),
      next_(job.scene, video, setup_.observers, setup_.detections),
      regions_(checkpoint ? checkpoint->regions : std::vector<Region>{}),
      evidence_(setup_.observers.size()),
      frames_{video.frame_rate(), FrameFile(folder.file(std::string(kFramesFile)),
                                            checkpoint ? checkpoint->records : 0)},
      first_frame_(checkpoint ? checkpoint->frames_read : 0),
      frames_read_(first_frame_),
      timer_(job.config.values.checkpoint.seconds) {
  for (const Camera& camera : setup_.scene.cameras)
    everywhere_.push_back(search_region(camera, job.scene.subject.height));
  std::vector<double> scales;
  for (const Region& region : everywhere_) scales.push_back(region.metres_per_px);
  movement_.emplace(std::move(scales), setup_.scene.dt);
  // OpenCV splits the layers of the network by its threads, so that their number changes the last
  // bits of sums.
  if (setup_.detections.uses_network()) set_image_threads(1);
  if (checkpoint) tracker_.resume(std::move(checkpoint->tracker));
  if (const size_t count = frames_.records.size(); count > 0)
    left_ = frames_.records[count - 1].out_of_picture;
  if (in_doubt_only())
    for (const FrameRecord& record : frames_.records) hear_names(record);
  if (!budget_.on()) return;
  particles_used_.assign(first_frame_, std::numeric_limits<double>::quiet_NaN());
  tracker_.use_particles(
      budget_.bounded(tracker_.tracking() ? static_cast<double>(tracker_.particles().states.size())
                                          : job.config.values.tracker.filter.particles));
}

void TrackRun::skip(const JobControl& control) {
  SceneFrames images;
  for (uint64_t i = 0; i < first_frame_ && !control.stopping(); ++i) {
    if (!video_.read(images)) {
      throw InputError(fmt::format("{}: the video ends at frame {}, before the checkpoint's {}",
                                   job_.scene.file.string(), i, first_frame_));
    }
    control.progress("skipping what is done", i + 1, first_frame_);
  }
}

bool TrackRun::step() {
  const TimePoint start;
  const bool tracked = tracker_.tracking();
  if (!next_.fetched()) fetch();
  if (!next_.there()) return false;
  complete();
  watch_movement();
  follow();
  learn();
  pace(start);
  ++frames_read_;
  if (has_state() && timer_.due()) write_checkpoint();
  if (tracked && tracker_.tracking()) {
    stride_.seconds += seconds_since(start.clock);
    ++stride_.frames;
  }
  return true;
}

bool TrackRun::finish(bool resumable) {
  const bool noted = resumable && has_state() && frames_read_ > first_frame_;
  if (noted) write_checkpoint();
  keep(tracker_.finish());
  next_.close();
  return noted || (resumable && std::filesystem::exists(checkpoint_file_));
}

std::vector<KeypointTerm::State> TrackRun::keypoints() const {
  std::vector<KeypointTerm::State> out;
  for (const Observer& observer : setup_.observers) out.push_back(observer.state());
  return out;
}

std::vector<std::string> TrackRun::notes() const {
  std::vector<int> frames;
  for (size_t c = 0; c < setup_.observers.size(); ++c)
    frames.push_back(job_.scene.cameras[c].video.empty() ? 0
                                                         : video_.source(c).facts().frame_count);
  std::vector<std::string> out = setup_.detections.notes(frames);
  for (size_t c = 0; c < setup_.observers.size(); ++c)
    std::ranges::move(notes_on_pictures(job_.scene.cameras[c].name, setup_.observers[c]),
                      std::back_inserter(out));
  if (frames_beside_others() > 0)
    out.push_back(
        fmt::format("somebody else was near the subject; their pixels were left out in {} frames",
                    frames_beside_others()));
  if (job_.scene.initial) {
    const auto note = stated_start_note(motion_of(frames_), *job_.scene.initial);
    if (note) out.push_back(*note);
  }
  if (setup_.scene.cameras.size() == 1) {
    const auto note = viewing_ray_note(motion_of(frames_), setup_.scene.cameras[0]);
    if (note) out.push_back(*note);
  }
  return out;
}

std::string TrackRun::why_nobody(const JobControl& control) {
  return walktrack::why_nobody(
      {job_.scene, detector_for(setup_.scene, job_.config.values.tracker.detector), prior_,
       everywhere_, threads_},
      setup_, static_cast<double>(frames_read_) / frames_.frame_rate, control);
}

Region TrackRun::region(size_t camera) const {
  if (!tracker_.tracking()) {
    Region region = everywhere_[camera];
    region.picture = tracker_.wants_picture();
    return region;
  }
  constexpr double kReach = 0.5;   // m around the last pose, for the limbs
  constexpr double kHasty = 0.5;   // m/s; error of the speed that the search region allows for
  constexpr double kOthers = 1.5;  // m around that, in which somebody else is followed
  const auto around = [&](double margin) {
    return person_region(setup_.scene.cameras[camera], tracker_.mean_place(),
                         tracker_.body().subject.height, margin);
  };
  const double margin = kReach + 2 * setup_.scene.dt * (tracker_.speed() + kHasty);
  Region region = around(margin);
  region.points = !region.area.empty() && (!in_doubt_only() || names_.in_doubt());
  if (tracker_.somebody_is_near()) {
    region.subject = region.area;
    region.area = around(margin + kOthers).area;
  }
  return region;
}

std::vector<Region> TrackRun::regions() const {
  std::vector<Region> out;
  for (size_t c = 0; c < setup_.observers.size(); ++c) out.push_back(region(c));
  return out;
}

// Fetches the first frame, of the video or after a checkpoint.
void TrackRun::fetch() {
  const TimePoint start;
  const NextFrame::Cost cost = next_.fetch(regions_.empty() ? regions() : regions_,
                                           tracker_.tracking(), threads_, row_threads());
  const Elapsed all = elapsed_since(start);
  watch_.add("decode", cost.decode);
  watch_.add("evidence",
             {all.seconds - cost.decode.seconds, std::max(0.0, all.cpu - cost.decode.cpu)});
}

void TrackRun::complete() {
  const TimePoint start;
  next_.complete(static_cast<double>(frames_read_) / frames_.frame_rate, threads_, evidence_);
  watch_.add("evidence", elapsed_since(start));
}

void TrackRun::push() { keep(tracker_.push(evidence_)); }

// Before a frame is tracked: measures motion in it if nobody is tracked yet.
void TrackRun::watch_movement() {
  if (!tracker_.tracking()) {
    moving_.push_back(movement_->newly_covered(evidence_));
  } else {
    moving_.push_back(0);
    movement_->forget();
  }
}

void TrackRun::keep(std::vector<FrameRecord> records) {
  for (FrameRecord& record : records) {
    record.moving = moving_.front();
    moving_.pop_front();
    left_ = record.tracked && out_of_picture(setup_.scene.cameras, record.estimate, left_);
    record.out_of_picture = left_;
    if (left_) record.tracked = false;
    hear_names(record);
    frames_.records.append(record);
  }
}

bool TrackRun::in_doubt_only() const {
  return job_.config.values.observation.keypoints.in_doubt_only;
}

void TrackRun::hear_names(const FrameRecord& record) {
  names_.add({record.tracked, record.names, record.modes.p_legs_swapped}, setup_.scene.dt);
}

// Tracks this frame while the next one is fetched. The time of decoding and evidence is the time
// that this frame had to wait for them.
void TrackRun::follow() {
  const bool tracked = tracker_.tracking();
  regions_ = regions();
  prepared_for_track_ = tracked;
  const TimePoint start;
  NextFrame::Cost cost;
  run_beside(
      threads_,
      [&] {
        push();
        filter_seconds_ = seconds_since(start.clock);
      },
      [&] { cost = next_.fetch(regions_, tracked, threads_, tracked ? 1 : row_threads()); });
  const Elapsed all = elapsed_since(start);
  const double waited = all.seconds - filter_seconds_;
  const double decode = std::min(waited, cost.decode.seconds);
  watch_.add("decode", {decode, cost.decode.cpu});
  watch_.add("evidence", {waited - decode, cost.prepare.cpu});
  watch_.add("filter",
             {filter_seconds_, std::max(0.0, all.cpu - cost.decode.cpu - cost.prepare.cpu)});
  if (!tracked || tracker_.tracking() || !next_.there()) return;
  const TimePoint lost;
  next_.prepare(regions(), false, threads_, row_threads());
  watch_.add("evidence", elapsed_since(lost));
}

// Adapts the number of particles for the next frame to the time budget. Frames of a search or a
// start are not limited.
void TrackRun::pace(const TimePoint& since) {
  if (!budget_.on()) return;
  if (!tracker_.tracking()) {
    particles_used_.push_back(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const auto used = static_cast<int>(tracker_.particles().states.size());
  particles_used_.push_back(used);
  tracker_.use_particles(
      budget_.next(used, seconds_since(since.clock) - filter_seconds_, filter_seconds_));
}

// While tracking, updates the subject's appearance and the statistics of detections from every
// frame. They use the particles' mean: colours at the reported pose, which they were used to find,
// would confirm themselves.
void TrackRun::learn() {
  if (!tracker_.tracking() || !setup_.observers.front().learns()) return;
  const TimePoint start;
  learn_appearance(tracker_.body(), tracker_.mean_pose(), evidence_, threads_, setup_);
  watch_.add("appearance", elapsed_since(start));
}

void TrackRun::write_checkpoint() {
  const TimePoint start;
  Checkpoint checkpoint{origin_, frames_read_, frames_.records.size(), frames_.records.bytes(),
                        {},      regions_,     tracker_.state()};
  for (const Observer& observer : setup_.observers)
    checkpoint.observers.push_back(observer.state());
  frames_.records.flush();
  walktrack::write_checkpoint(checkpoint_file_, checkpoint);
  timer_.wrote(start.clock);
  watch_.add("checkpoints", elapsed_since(start));
}

}  // namespace jobs
}  // namespace walktrack
