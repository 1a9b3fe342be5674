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
     "Frames without a figure, of those from the first frame with one on.",
     "Look at where the figure is missing in the overlay video: the subject may be hidden, outside "
     "the picture, or not walking. Cut the video to the walk (first_frame, last_frame)."},
    {"untracked_movement_percent", "Somebody moves but is not tracked", "%", 1,
     "Frames in which something as large as a person moves and no figure follows it, of all frames "
     "with movement, the time before the subject was found included.",
     "Cut the video to the walk of one person (first_frame, last_frame), or say where the walk "
     "begins (initial). Nothing is known of the frames without a figure."},
    {"foot_changes", "Changes of the standing foot", "", 0,
     "How often the figure's weight went from one foot to the other.",
     "Nobody was seen to take a step: is there a person who walks in this video?"},
    {"overlap_percent", "Figure on the person, worst camera", "%", 0,
     "How much of the figure and of what stands out from the background near it lie on each other, "
     "mean over the frames of the camera in which this is least. 100 is never reached: the figure "
     "wears no clothes and has no arms.",
     "Look at the overlay video of that camera. A figure beside the person means a wrong "
     "calibration, cameras that do not start at the same time, a wrong height, or a wrong start; "
     "say where the walk begins (initial), or run walktrack check."},
    {"better_beside_percent", "Images speak for a figure beside this one", "%", 1,
     "By how much the images speak more for the same figure 5 to 40 cm beside its place, or "
     "turned by 15 or 30 degrees, than for the one that is reported; mean over the frames.",
     "The figure is likely to be beside the person: look at the overlay video, say where the walk "
     "begins (initial), or run walktrack check."},
    {"on_detected_percent", "Figure on a person of the keypoints", "%", 0,
     "Frames in which the figure lies on one of the people whose keypoints were detected, of all "
     "tracked frames in which anybody was detected.",
     "The figure is likely to be beside the person, or too near or too far: look at the crosses in "
     "the overlay video, say where the walk begins (initial), or cut the video to the part where "
     "the subject walks."},
    {"legs_exchanged_percent", "Left and right may be swapped, mean probability", "%", 0,
     "How probable it is, as the tracker estimates, that the left leg is taken for the right.",
     "The images hardly tell left from right here: a second camera from another side does. Until "
     "then do not compare left with right."},
    {"leg_swaps_per_min", "Left and right swapped between frames", "/min", 1,
     "How often the legs change places from one frame to the next.",
     "Left and right cannot be trusted in this result. A second camera from another side tells "
     "legs apart; so do more particles (filter.particles)."},
    {"steps_off_way_percent", "Steps against the way of the body", "%", 0,
     "By how much the steps together are longer or shorter than the way that the pelvis went "
     "meanwhile: feet and body of somebody who walks go equally far.",
     "Step lengths cannot be trusted: the legs in the overlay video are likely to be swapped, or "
     "on something else than the subject's legs."},
    {"longest_step_leg_lengths", "Longest step, in leg lengths", "", 2,
     "People's steps are at most about as long as their legs.",
     "A foot was lost or the figure jumped: look at the longest step in the overlay video. Is the "
     "subject's height right?"},
    {"shortest_step_m", "Shortest step", "m", 2,
     "Less than nothing is a step that ends behind the other foot.",
     "Left and right are likely to be swapped there, or the subject turns or steps back: look at "
     "that step in the overlay video."},
    {"quickest_step_percent", "Quickest step, of the usual time", "%", 0,
     "People's steps take about as long as each other. One that takes no time, or a foot that "
     "strikes twice running, is left and right being swapped in the middle of the walk.",
     "Look at that step in the overlay video. A second camera from another side tells legs apart; "
     "so do more particles (filter.particles) and other seeds."},
    {"fastest_m_s", "Fastest half second", "m/s", 2,
     "Speed of the pelvis over the ground; nobody walks faster than 2.5 m/s.",
     "The figure jumped to another place: look at the speed over time. Is the frame rate right?"},
    {"scale_sd_percent", "Distance and size, standard deviation", "%", 1,
     "By how much the whole figure may be too near and too small, or too far and too large, with "
     "its steps and speed: what the cameras leave open. No check sees an error of this kind.",
     ""},
    {"foot_slide_mm", "Sliding of a standing foot, mean of stances", "mm", 0,
     "How far a foot travels while it stands. In the result standing feet have been planted.", ""},
    {"worst_foot_slide_mm", "Sliding of a standing foot, worst stance", "mm", 0,
     "The same of the stance in which the foot travels furthest.", ""},
    {"penetration_mm", "Deepest foot in the ground", "mm", 0,
     "How deep an ankle or toe sinks below the floor of the calibration.", ""},
    {"tracked_foot_slide_mm", "Sliding of a standing foot before feet are planted", "mm", 0,
     "How far a standing foot travels in what was tracked.", kLookAtFeet},
    {"tracked_penetration_mm", "Deepest foot in the ground before feet are planted", "mm", 0,
     "How deep an ankle or toe sinks below the floor in what was tracked.", kLookAtFeet},
    {"jitter_m_s3", "Trembling: mean third derivative of the joints", "m/s³", 0,
     "Walking people's joints stay below about 500.",
     "The figure trembles or leaps: more particles (filter.particles) or smoothing "
     "(smoothing.enabled) help; look whether the figure is on the person."},
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
