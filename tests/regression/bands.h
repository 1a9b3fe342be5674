// Bands: the range of each value of each scene of the regression suite, stored as bands.csv in the
// repository and read in reviews.
//
// A band comes from nine seeds: its middle is their median, its half width a share of that median
// (a change that does not matter, never above a fifth) plus three standard deviations of a seed.
// A few seeds swap the legs, so that the deviation is computed from the inner seven: their range
// over its expectation for normal values. The median of three seeds is compared with a band: three
// standard deviations of a seed are four and a half of such a median. A band always contains the
// median of its first three seeds and ends at the limit of possible values. An error may shrink: an
// improvement never fails. Coverage, widths and evidence have no better side and are limited on
// both.
//
// Each band stores the best median that its scene ever had, so that small steps for the worse add
// up.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace walktrack {

using FigureValues = std::map<std::string, double>;  // by key; NaN = there is none
using SuiteValues = std::map<std::string, std::vector<FigureValues>>;  // scene -> one for each seed

enum class Better { kLower, kHigher, kNearerZero, kNeither };

struct WatchedFigure {
  std::string_view key;
  Better better;
  double share;  // of the median: a change that does not matter
  double least = -std::numeric_limits<double>::infinity();  // that is possible
  double most = std::numeric_limits<double>::infinity();
  // A band ends there at the latest, times the median, however much seeds differ: nothing that has
  // doubled is in it. Of what never is zero.
  double most_growth = std::numeric_limits<double>::infinity();
};
inline constexpr double kNotDoubled = 1.9;
inline constexpr double kLargestShare = 0.2;

// What the suite looks at, of what `evaluate` says and run.json holds.
std::span<const WatchedFigure> watched_figures();

struct Band {
  std::string scene, key;
  double low, median, high;  // low and high may be infinite
  double best;               // median that the scene ever had; kNeither: the present one
};

inline constexpr size_t kBandSeeds = 9;      // that a band is made from
inline constexpr size_t kComparedSeeds = 3;  // the first of them, that are compared with it

// Bands of all scenes and watched figures, best as now, in order of scenes, then of
// watched_figures(), from kBandSeeds runs of each scene. A figure that any of them lacks has no
// band, nor has one whose band would hold all that is possible.
std::vector<Band> bands_from(const SuiteValues& values);

// scene,figure,low,median,high,best; an open end is an empty cell.
std::string bands_csv(const std::vector<Band>& bands);
std::vector<Band> read_bands(const std::filesystem::path& path);

// One line for each band of the scene that the median over these runs is not in, and for each
// figure that has a band and no value.
std::vector<std::string> out_of_bands(const std::vector<Band>& bands, const std::string& scene,
                                      const std::vector<FigureValues>& runs);

// `now` with the best medians of `before` where those are better.
std::vector<Band> with_best(std::vector<Band> now, const std::vector<Band>& before);

// Why a figure is worse than it once was: worse.csv, scene,figure,why.
struct Excuse {
  std::string scene, key;
};
std::vector<Excuse> read_excuses(const std::filesystem::path& path);

// A line for each band whose median is farther from its best, on the worse side, than the band
// reaches, and that nobody has excused; and for each excuse that no band needs.
std::vector<std::string> unexcused(const std::vector<Band>& bands,
                                   const std::vector<Excuse>& excuses);

// What a review has to see: the bands that are new, gone or changed as they are printed, and
// whether the new median lies outside the old band.
std::string bands_difference(const std::vector<Band>& before, const std::vector<Band>& after);

}  // namespace walktrack
