#include "jobs/track/results/reported_track.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "body/kinematics.h"
#include "jobs/track/results/named_track.h"
#include "jobs/track/track_run.h"
#include "metrics/steps/flat_feet.h"

namespace walktrack {
inline namespace jobs {

namespace {

// Frames that are settled at a time, frames after them that are estimated with them, and settled
// frames before them with which a piece begins: contacts and the correlation of accelerations are
// shorter. By hand.
constexpr size_t kSettled = 512, kAhead = 64, kBefore = 64;

struct Piece {
  size_t first, begin, end;  // first of the records at hand, first and last that are not settled
};

std::vector<FlatFoot> within(std::span<const FlatFoot> flat, const Piece& piece) {
  std::vector<FlatFoot> out;
  for (const FlatFoot& each : flat) {
    if (each.last < piece.first || each.first >= piece.end) continue;
    out.push_back({each.side, std::max(each.first, piece.first) - piece.first,
                   std::min(each.last, piece.end - 1) - piece.first});
  }
  return out;
}

double speed_at(std::span<const Pose> poses, size_t i, double rate) {
  const size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, poses.size() - 1);
  if (before == after) return 0;
  return (poses[after].root - poses[before].root).head<2>().norm() * rate /
         static_cast<double>(after - before);
}

// Draws of the frames that a piece begins with: by draw, its last poses.
std::vector<Poses> last_poses(const std::vector<Poses>& draws, size_t from, size_t to) {
  std::vector<Poses> out;
  for (const Poses& draw : draws)
    out.emplace_back(draw.begin() + static_cast<std::ptrdiff_t>(from),
                     draw.begin() + static_cast<std::ptrdiff_t>(to));
  return out;
}

std::vector<Pose> of_frame(const std::vector<Poses>& draws, size_t t) {
  std::vector<Pose> out;
  for (const Poses& draw : draws) out.push_back(draw[t]);
  return out;
}

void report_pose(const BodyModel& model, const Pose& pose, double velocity, FrameRecord& record) {
  const JointPositions joints = forward_kinematics(model.body, pose).joints;
  for (size_t j = 0; j < record.estimate.joint_count; ++j)
    record.estimate.joints.at[j] = joints.at[j];
  record.estimate.pose = pose;
  record.estimate.speed = velocity;
}

// Of the frames [begin, end).
std::vector<WalkingDirection> directions(const TrackedFrames& frames, size_t begin, size_t end) {
  std::vector<Eigen::Vector2d> places;
  for (size_t i = begin; i < end; ++i)
    places.emplace_back(frames.records[i].estimate.pose.root.head<2>());
  return walking_directions(places, 1 / frames.frame_rate);
}

// The frames [begin, end) of one unbroken track; those before `begin` are settled already.
void settle_track(const TrackedFrames& frames, const BodyModel& model, const Together& together,
                  size_t begin, size_t end, TrackedFrames& out) {
  const size_t track = begin;
  const double dt = 1 / frames.frame_rate;
  std::optional<Posterior> posterior;
  const BandScene* bands = together.bands;
  if (bands) posterior.emplace(model, *bands, frames.records[begin].samples.size());
  const std::vector<WalkingDirection> ways = together.walk_prior
                                                 ? directions(frames, begin, end)
                                                 : std::vector<WalkingDirection>(end - begin);
  std::vector<Poses> draws(posterior ? posterior->draws() : 0);  // of the settled frames
  while (begin < end) {
    const bool rest = end - begin <= kSettled + kAhead;
    const size_t settled = rest ? end : begin + kSettled;
    const size_t first = begin - track > kBefore ? begin - kBefore : track;
    const Piece piece{first, begin, rest ? end : settled + kAhead};
    std::vector<FrameRecord> records;
    for (size_t i = first; i < piece.end; ++i)
      records.push_back(i < begin ? out.records[i] : frames.records[i]);
    const std::vector<FlatFoot> soles = within(together.flat, piece);
    const auto here = std::span(ways).subspan(first - track, records.size());
    const TrajectoryEstimate found =
        most_probable_trajectory(model, {dt, records, soles, begin - first, here},
                                 {draws, bands ? bands->seed : 0, static_cast<uint32_t>(begin)});
    for (size_t i = begin - first; i < settled - first; ++i) {
      const double speed = speed_at(found.poses, i, frames.frame_rate);
      if (posterior)
        posterior->report(found.poses[i], of_frame(found.draws, i), speed, dt, records[i]);
      else
        report_pose(model, found.poses[i], speed, records[i]);
      out.records.append(records[i]);
    }
    const size_t next = settled - track > kBefore ? settled - kBefore : track;
    draws = last_poses(found.draws, next - first, settled - first);
    begin = settled;
  }
}

bool stands(const Motion& motion, const FlatFoot& flat) {
  Eigen::AlignedBox2d box;
  for (size_t i = flat.first; i <= flat.last; ++i) {
    const Eigen::Vector2d foot = foot_point(motion.joints[i], flat.side).head<2>();
    if (!foot.allFinite()) return false;
    box.extend(foot);
  }
  return flat.first < flat.last && box.diagonal().norm() <= kTooFarToStand;
}

// First and last frames of stretches in which somebody stands.
std::vector<std::pair<size_t, size_t>> quiet_stretches(const TrackedFrames& frames) {
  std::vector<std::pair<size_t, size_t>> out;
  size_t frame = 0;
  bool before = false;
  for (const FrameRecord& record : frames.records) {
    const bool quiet = record.tracked && record.modes.standing > 0.5;
    if (quiet && before) out.back().second = frame;
    if (quiet && !before) out.emplace_back(frame, frame);
    before = quiet;
    ++frame;
  }
  return out;
}

// Stretches of one foot that share frames become one.
void join(FlatFoot added, std::vector<FlatFoot>& flat) {
  std::erase_if(flat, [&](const FlatFoot& each) {
    if (each.side != added.side || each.last < added.first || each.first > added.last) return false;
    added.first = std::min(added.first, each.first);
    added.last = std::max(added.last, each.last);
    return true;
  });
  flat.push_back(added);
}

}  // namespace

TrackedFrames seen_together(const TrackedFrames& frames, const BodyModel& model,
                            const Together& together, const std::filesystem::path& file) {
  TrackedFrames out{frames.frame_rate, FrameFile(file)};
  std::filesystem::remove(
      file);  // an open file can still be read, and is deleted when it is closed
  const size_t count = frames.records.size();
  std::vector<char> tracked;
  for (const FrameRecord& record : frames.records) tracked.push_back(record.tracked);
  for (size_t i = 0; i < count;) {
    size_t end = i;
    while (end < count && tracked[end]) ++end;
    if (end > i) {
      settle_track(frames, model, together, i, end, out);
    } else {
      out.records.append(frames.records[end++]);
    }
    i = end;
  }
  return out;
}

std::vector<FlatFoot> standing_feet(const TrackedFrames& frames) {
  const Motion motion = motion_of(frames);
  std::vector<FlatFoot> flat = flat_feet(motion, gait_from_motion(motion));
  for (const auto& [first, last] : quiet_stretches(frames))
    for (const Side side : {Side::kLeft, Side::kRight}) join({side, first, last}, flat);
  std::erase_if(flat, [&](const FlatFoot& each) { return !stands(motion, each); });
  return flat;
}

ReportedTrack::ReportedTrack(const TrackedFrames& tracked, const BodyModel& model,
                             const SmoothingConfig& smoothing, const BandScene& bands,
                             const ResultFolder& folder)
    : tracked_(tracked) {
  const auto file = [&](std::string_view name) { return folder.file(std::string(name)); };
  if (says_names(tracked)) named_.emplace(named(tracked, model.body, file(kNamedFile)));
  const TrackedFrames& sided = moving();
  if (!smoothing.enabled) return;
  if (!smoothing.plant) {
    smoothed_.emplace(seen_together(sided, model, {.bands = &bands}, file(kSmoothedFile)));
    return;
  }
  smoothed_.emplace(seen_together(sided, model, {.walk_prior = false}, file(kSmoothedFile)));
  const std::vector<FlatFoot> flat =
      standing_feet(seen_together(sided, model, {}, file(kStandingFile)));
  planted_.emplace(
      seen_together(sided, model, {.flat = flat, .bands = &bands}, file(kPlantedFile)));
}

}  // namespace jobs
}  // namespace walktrack
