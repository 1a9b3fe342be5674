// Generated walks compared with measured ones: mean and standard deviation of healthy people, if
// their file is present. It is not part of the product.
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "body/body.h"
#include "tests/data_folders.h"
#include "walked_curves.h"

namespace walktrack {
namespace {

using Columns = std::map<std::string, std::vector<double>>;

Columns read_columns(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line, cell;
  std::vector<std::string> names;
  Columns out;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    for (size_t i = 0; std::getline(cells, cell, ','); ++i) {
      if (i >= names.size())
        names.push_back(cell);
      else
        out[names[i]].push_back(std::stod(cell));
    }
  }
  return out;
}

// Share of the stride in which the curve minus `offset` is within one standard deviation.
double share_within(const std::array<double, kWholeStride>& curve, const Columns& norms,
                    const std::string& angle, double offset) {
  const std::vector<double>& mean = norms.at(angle + "_X_mean");
  const std::vector<double>& sd = norms.at(angle + "_X_sd");
  double within = 0;
  for (size_t i = 0; i < kWholeStride; ++i)
    within += std::abs(curve[i] - offset - mean.at(i)) <= sd.at(i);
  return within / kWholeStride;
}

TEST(MadeWalkNorms, HipKneeAndAnkleAreThoseOfHealthyPeople) {
  const std::filesystem::path file = kSharedData / "norms/cgm23_spontaneous.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  const Columns norms = read_columns(file);
  MadeWalk walk;
  walk.speed = 1.3;
  const WalkedCurves curves = walked_curves(make_body(Subject{}, {}), walk);
  // Hip flexion is measured here from the trunk's lean of 4 degrees, in the norms from a pelvis
  // that its spines tilt by 11.
  constexpr double kHipOffset = -6;
  EXPECT_GE(share_within(curves.hip, norms, "HipAngles", kHipOffset), .8);
  EXPECT_GE(share_within(curves.knee, norms, "KneeAngles", 0), .8);
  EXPECT_GE(share_within(curves.ankle, norms, "AnkleAngles", 0), .8);
}

}  // namespace
}  // namespace walktrack
