// Views of a board for `walktrack calibrate`: those of the lens, and the one on the floor.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/job_control.h"
#include "observation/calibration/board.h"
#include "observation/calibration/camera_fit.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

// Views of the board that differ from each other.
struct BoardViews {
  int width_px = 0, height_px = 0;
  std::vector<int> frames;
  std::vector<PixelPoints> points;
  Image picture;  // the first of them
};

inline constexpr size_t kFewestViews = 4;
inline constexpr size_t kMostViews = 40;

// Throws an InputError with advice if there are fewer than kFewestViews of them.
BoardViews collect_views(const std::filesystem::path& source, const Board& board,
                         const JobControl& control);

// Finds the board in a frame of a source in which it does not move. InputError if there is none.
BoardViews find_floor_board(const std::filesystem::path& source, const Board& board);

}  // namespace jobs
}  // namespace walktrack
