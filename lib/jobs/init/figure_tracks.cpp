#include "jobs/init/figure_tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/median.h"

namespace walktrack {
inline namespace jobs {

namespace {

// The longest gap between two detections of the same person, and the farthest way in it, in their
// heights.
constexpr double kLongestGap_s = 0.6, kFarthestSideways = 0.6, kFarthestUpwards = 0.2;

}  // namespace

double median_size(const FigureTrack& track) {
  std::vector<double> sizes;
  for (const SeenFigure& figure : track) sizes.push_back(size_of(figure));
  return median_of(std::move(sizes));
}

void link(const SeenFigure& figure, std::vector<FigureTrack>& tracks) {
  const auto apart = [&](const FigureTrack& track) {
    const SeenFigure& last = track.back();
    const double sideways = std::abs(figure.u_px - last.u_px),
                 upwards = std::abs(figure.bottom_px - last.bottom_px);
    const bool near = last.time < figure.time && figure.time - last.time < kLongestGap_s &&
                      sideways < kFarthestSideways * size_of(last) &&
                      upwards < kFarthestUpwards * size_of(last);
    return near ? sideways : std::numeric_limits<double>::infinity();
  };
  FigureTrack* nearest = nullptr;
  for (FigureTrack& track : tracks)
    if (std::isfinite(apart(track)) && (!nearest || apart(track) < apart(*nearest)))
      nearest = &track;
  if (!nearest) nearest = &tracks.emplace_back();
  nearest->push_back(figure);
}

double way_across(const FigureTrack& track) {
  const auto [left, right] = std::minmax_element(
      track.begin(), track.end(), [](const auto& a, const auto& b) { return a.u_px < b.u_px; });
  return (right->u_px - left->u_px) / median_size(track);
}

double way_anywhere(const FigureTrack& track) {
  const auto [smallest, largest] =
      std::minmax_element(track.begin(), track.end(),
                          [](const auto& a, const auto& b) { return size_of(a) < size_of(b); });
  return way_across(track) + std::log(size_of(*largest) / size_of(*smallest));
}

FigureTrack walker_of(const std::vector<FigureTrack>& tracks, double (*way)(const FigureTrack&)) {
  const auto most =
      std::max_element(tracks.begin(), tracks.end(),
                       [&](const FigureTrack& a, const FigureTrack& b) { return way(a) < way(b); });
  return most == tracks.end() ? FigureTrack{} : *most;
}

}  // namespace jobs
}  // namespace walktrack
