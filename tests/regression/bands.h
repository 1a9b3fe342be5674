// Bands: between which values each figure of each scene of the regression suite may lie, kept as
// bands.csv in the repository and read in reviews.
//
// A band comes from seven seeds: its middle is their median, its half width the figure's floor (a
// change that nobody cares about) plus two standard deviations of a seed. Now and then a seed
// swaps the legs, so the deviation is taken from the inner five: their range over its
// expectation for normal values. What is compared with a band is the median of three seeds: two
// deviations of a seed are three of such a median. A band always holds that of its first three. It
// reaches as far as the figure gets better: an improvement never fails.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace walktrack {

using FigureValues = std::map<std::string, double>;  // by key; NaN = there is none
using SuiteValues = std::map<std::string, std::vector<FigureValues>>;  // scene -> one a seed

enum class Better { kLower, kHigher, kNearerZero };

struct WatchedFigure {
  std::string_view key;
  Better better;
  double floor;      // in the figure's unit
  double share = 0;  // and this share of the median
};

// What the suite looks at, of what `evaluate` says and run.json holds.
std::span<const WatchedFigure> watched_figures();

struct Band {
  std::string scene, key;
  double low, median, high;  // low and high may be infinite
};

inline constexpr size_t kBandSeeds = 7;      // that a band is made from
inline constexpr size_t kComparedSeeds = 3;  // the first of them, that are compared with it

// Bands of all scenes and watched figures, in order of scenes, then of watched_figures(), from
// kBandSeeds runs of each scene. A figure that any of them lacks has no band.
std::vector<Band> bands_from(const SuiteValues& values);

// scene,figure,low,median,high; an open end is an empty cell.
std::string bands_csv(const std::vector<Band>& bands);
std::vector<Band> read_bands(const std::filesystem::path& path);

// One line for each band of the scene that the median over these runs is not in, and for each
// figure that has a band and no value.
std::vector<std::string> out_of_bands(const std::vector<Band>& bands, const std::string& scene,
                                      const std::vector<FigureValues>& runs);

// What a review has to see: the bands that are new, gone or changed as they are printed, and
// whether the new median lies outside the old band.
std::string bands_difference(const std::vector<Band>& before, const std::vector<Band>& after);

}  // namespace walktrack
