#include "jobs/track/report/quality_words.h"

#include <algorithm>
#include <stdexcept>

namespace walktrack {
inline namespace jobs {

namespace {

constexpr std::string_view kLookAtFeet =
    "Look at the feet in the overlay video. Feet that slide or sink mean a wrong floor in the "
    "calibration, a wrong height or weight of the subject, or a figure that is not on the person.";

constexpr QualityWords kWords[] = {
    {"lost_percent", "Lost after the subject was found", "%", 1,
     "Share of the frames without a figure, from the first frame with a figure on. Frames in which "
     "nobody moves after the figure has walked out of every picture are left out.",
     "Look at where the figure is missing in the overlay video: the subject may be hidden, at the "
     "edge of the picture, or not walking. Cut the video to the walk (first_frame, last_frame)."},
    {"untracked_movement_percent", "Somebody moves but is not tracked", "%", 1,
     "Share of the frames in which something as large as a person moves and no figure follows it, "
     "of all frames with movement; the time before the subject was found is included.",
     "Cut the video to the walk of one person (first_frame, last_frame), or state where the walk "
     "begins (initial). Nothing is known of the frames without a figure."},
    {"frame_rate_hz", "Frames a second", "Hz", 1,
     "With fewer than four frames of a stride, which takes .8 s when somebody walks fast, left and "
     "right can be swapped between two frames.",
     "Left and right cannot be trusted in this result, nor can steps and their times. Track more "
     "frames of the video; 25 Hz and more are recommended."},
    {"foot_changes", "Changes of the standing foot", "", 0,
     "How often the figure's weight moved from one foot to the other.",
     "The tracked figure took no step: is there a person who walks in this video?"},
    {"overlap_percent", "Figure on the person, worst camera", "%", 0,
     "Overlap of the figure with the foreground near it, in the camera in which it is smallest: "
     "mean over the frames, by how much of the figure is in front of a known background. Arms that "
     "the figure lacks are left out. It never reaches 100, because the figure wears no clothes.",
     "Look at the overlay video of that camera. A figure beside the person means a wrong "
     "calibration, cameras that do not start at the same time, a wrong height, or a wrong start; "
     "state where the walk begins (initial), or run walktrack check. A figure on the person means "
     "that the empty scene (background) shows other things than the video: leave it out."},
    {"better_beside_nats", "A figure beside this one explains the images better", "nats", 2,
     "How much better the same figure 5 to 40 cm beside its place, or turned by 15 or 30 degrees, "
     "explains the outlines in a picture than the figure that is reported: logarithm of the ratio "
     "of their probabilities, mean over pictures.",
     "The figure is likely to be beside the person: look at the overlay video, state where the "
     "walk begins (initial), or run walktrack check."},
    {"on_detected_percent", "Figure on a person of the keypoints", "%", 0,
     "Share of the frames in which the figure lies on one of the people whose keypoints were "
     "detected, of all tracked frames in which anybody was detected.",
     "The figure is likely to be beside the person, or too near or too far: look at the crosses in "
     "the overlay video, state where the walk begins (initial), or cut the video to the part in "
     "which the subject walks."},
    {"legs_exchanged_percent", "Left and right may be swapped, mean probability", "%", 0,
     "The probability, estimated by the tracker, that the left leg is taken for the right one.",
     "The images hardly show which leg is which. One more camera, from another side, helps; do not "
     "compare left with right in this result."},
    {"leg_swaps_per_min", "Left and right swapped between frames", "/min", 1,
     "How often the legs change places from one frame to the next.",
     "Left and right cannot be trusted in this result. A second camera from another side helps to "
     "tell the legs apart, and so do more particles (filter.particles)."},
    {"steps_off_way_percent", "Length of all steps against the path of the body", "%", 0,
     "The difference between the length of all steps together and the path of the pelvis in the "
     "same time, as a share of that path: while a person walks, feet and body cover the same "
     "distance.",
     "Step lengths cannot be trusted: the legs in the overlay video are likely to be swapped, or "
     "to lie on something else than the subject's legs."},
    {"missing_steps", "Steps missing on the path of the body", "", 1,
     "The length of the path of the pelvis in steps of the mean length, less the complete steps "
     "and two incomplete ones at the ends of every walk: a person who walks moves forward only by "
     "taking steps.",
     "The feet of the figure did not step while the body moved on; film from the side as well, or "
     "cut the video to the walk."},
    {"longest_step_leg_lengths", "Longest step, in leg lengths", "", 2,
     "People's steps are at most about as long as their legs.",
     "A foot was lost or the figure jumped: look at the longest step in the overlay video. Is the "
     "subject's height right?"},
    {"shortest_step_m", "Shortest step", "m", 2,
     "The length is negative if a foot lands behind the other foot.",
     "Left and right are likely to be swapped there, or the subject turns or steps back: look at "
     "that step in the overlay video."},
    {"quickest_step_percent", "Quickest step, of the usual time", "%", 0,
     "All steps of a person take about the same time. A step that takes no time, or one foot that "
     "strikes twice in a row, means that left and right were swapped during the walk.",
     "Look at that step in the overlay video. A second camera from another side helps to tell the "
     "legs apart, and so do more particles (filter.particles) and other seeds."},
    {"fastest_m_s", "Fastest half second", "m/s", 2,
     "Speed of the pelvis over the ground; nobody walks faster than 2.5 m/s.",
     "The figure jumped to another place: look at the speed over time. Is the frame rate right?"},
    {"scale_sd_percent", "Distance and size, standard deviation", "%", 1,
     "How much the whole figure may be too near and too small, or too far and too large, and its "
     "steps and speed with it: the uncertainty that the cameras leave. No check sees an error of "
     "this kind.",
     ""},
    {"foot_slide_mm", "Sliding of a stance foot, mean of stances", "mm", 0,
     "How far a foot moves while it stands. In the result stance feet are held in place.", ""},
    {"worst_foot_slide_mm", "Sliding of a stance foot, worst stance", "mm", 0,
     "How far the foot moves in the stance in which it moves furthest.", ""},
    {"penetration_mm", "Deepest foot below the ground", "mm", 0,
     "How deep an ankle or toe is below the floor of the calibration.", ""},
    {"tracked_slide_along_walk_mm",
     "Sliding of a stance foot along the walk before feet are held in place", "mm", 0,
     "How far a stance foot moves along the direction of walking before feet are held in place. "
     "Across it feet slide in right results too: one camera at the side hardly sees it.",
     kLookAtFeet},
    {"tracked_penetration_mm", "Deepest foot below the ground before feet are held in place", "mm",
     0, "How deep an ankle or toe is below the floor in the track, before feet are held in place.",
     kLookAtFeet},
    {"jitter_m_s3", "Jitter: mean third derivative of the joints", "m/s³", 0,
     "The joints of people who walk stay below about 500.",
     "The figure trembles or jumps: more particles (filter.particles) or smoothing "
     "(track.estimate=map) help. Check that the figure is on the person."},
};

}  // namespace

std::span<const QualityWords> quality_words() { return kWords; }

QualityMeasure quality_measure(std::string_view name, double value) {
  const auto found =
      std::ranges::find_if(kWords, [&](const QualityWords& words) { return words.name == name; });
  if (found == std::end(kWords)) throw std::out_of_range(std::string(name));
  QualityMeasure out;
  out.name = name;
  out.what = found->what;
  out.meaning = found->meaning;
  out.advice = found->advice;
  out.value = value;
  out.unit = found->unit;
  out.digits = found->digits;
  return out;
}

}  // namespace jobs
}  // namespace walktrack
