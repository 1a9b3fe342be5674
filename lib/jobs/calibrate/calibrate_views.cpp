#include "jobs/calibrate/calibrate_views.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/video/video.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

namespace {

namespace fs = std::filesystem;

constexpr int kMostFramesTried = 300;      // frames of a video that are searched, evenly spread
constexpr double kLeastDifference = 0.04;  // mean shift of the points that makes another view,
                                           // share of the image width

std::string board_name(const Board& board) {
  const bool chess = board.kind == BoardKind::kChessboard;
  return fmt::format("{}{} of {}x{} {}",
                     board.kind == BoardKind::kAsymmetricCircles ? "asymmetric " : "",
                     chess ? "chessboard" : "grid", board.columns, board.rows,
                     chess ? "inner corners" : "circles");
}

double mean_distance(const PixelPoints& a, const PixelPoints& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).norm();
  return sum / static_cast<double>(a.size());
}

bool is_another_view(const BoardViews& views, const PixelPoints& points) {
  const double least = kLeastDifference * views.width_px;
  return std::all_of(views.points.begin(), views.points.end(), [&](const PixelPoints& known) {
    return mean_distance(known, points) > least;
  });
}

// A board of another size, as it is found if a user has counted squares and not corners.
std::optional<Board> board_of_other_size(const Image& image, const Board& board) {
  for (const auto& [columns, rows] : {std::pair{-1, -1}, std::pair{1, 1}, std::pair{-1, 0},
                                      std::pair{0, -1}, std::pair{1, 0}, std::pair{0, 1}}) {
    Board other = board;
    other.columns += columns;
    other.rows += rows;
    if (std::min(other.columns, other.rows) >= 3 && find_board(image, other)) return other;
  }
  return std::nullopt;
}

[[noreturn]] void no_board(const fs::path& source, const Board& board, const Image& picture) {
  if (const auto other = board_of_other_size(picture, board))
    throw InputError(describe({source.string(), 0, ""},
                              fmt::format("no {}, but a {}", board_name(board), board_name(*other)),
                              fmt::format("--size {}x{}: it counts inner corners, not squares",
                                          other->columns, other->rows)));
  throw InputError(describe({source.string(), 0, ""}, "no " + board_name(board),
                            "a board that is seen whole, with its white border, in focus and not "
                            "too small; --size counts inner corners, not squares"));
}

}  // namespace

BoardViews collect_views(const fs::path& source, const Board& board, const JobControl& control) {
  FrameSource frames(source);
  BoardViews views{frames.facts().width_px, frames.facts().height_px, {}, {}, {}};
  const int count = frames.facts().frame_count;
  const int step = std::max(1, count / kMostFramesTried);
  Image frame, first;
  while (views.points.size() < kMostViews && !control.stopping()) {
    const int number = frames.next_frame();
    if (!frames.read(frame)) break;
    if (first.empty()) first = frame.clone();
    control.progress("looking for the board", static_cast<size_t>(number + 1),
                     static_cast<size_t>(std::max(count, 0)));
    const auto points = find_board(frame, board);
    if (points && is_another_view(views, *points)) {
      if (views.picture.empty()) views.picture = frame.clone();
      views.frames.push_back(number);
      views.points.push_back(*points);
    }
    if (step > 1 && !frames.skip(step - 1)) break;
  }
  if (views.points.empty()) no_board(source, board, first);
  if (views.points.size() < kFewestViews)
    throw InputError(describe(
        {source.string(), 0, ""},
        fmt::format("{} views of the board that differ", views.points.size()),
        fmt::format(
            "at least {}, better 15: tilt the board, turn it, and take it into every corner "
            "of the picture, always whole",
            kFewestViews)));
  return views;
}

BoardViews find_floor_board(const fs::path& source, const Board& board) {
  constexpr int kFramesTried = 30;
  FrameSource frames(source);
  Image frame, first;
  for (int i = 0; i < kFramesTried && frames.read(frame); ++i) {
    if (first.empty()) first = frame.clone();
    if (auto points = find_board(frame, board))
      return {frame.cols, frame.rows, {i}, {std::move(*points)}, frame.clone()};
  }
  no_board(source, board, first);
}

}  // namespace jobs
}  // namespace walktrack
