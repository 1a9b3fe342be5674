// walktrack calibrate: a camera's lens and pose.
#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "io/calibration/calibration_checks.h"
#include "jobs/calibrate/calibrate.h"
#include "jobs/calibrate/import_calibration.h"
#include "terminal.h"

namespace walktrack {
namespace {

namespace po = boost::program_options;

constexpr const char* kAbout =
    "Finds a camera's lens from views of a board (--views), and its place from a board on the "
    "floor\n(--floor) or from points measured on it (--points: u,v,x,y,z; pixels, metres, z up). "
    "Writes the\ncalibration for scenes and for Pose2Sim, the residuals, and pictures that show "
    "how good it is.\nWith --import it converts the calibration of another tool.";

// "9x6": two integers within these limits.
std::optional<std::array<int, 2>> two_whole_numbers(std::string_view text, int least, int most) {
  std::array<int, 2> out{};
  const size_t x = text.find('x');
  if (x == std::string_view::npos) return std::nullopt;
  const std::array<std::string_view, 2> parts{text.substr(0, x), text.substr(x + 1)};
  for (size_t i = 0; i < 2; ++i) {
    const auto end = parts[i].data() + parts[i].size();
    const auto [at, error] = std::from_chars(parts[i].data(), end, out[i]);
    if (error != std::errc{} || at != end || out[i] < least || out[i] > most) return std::nullopt;
  }
  return out;
}

struct BoardOptions {
  std::string kind, size;
  double spacing = 0;

  void declare(CommandLine& line) {
    auto add = line.options().add_options();
    add("board", po::value(&kind)->default_value("chessboard")->value_name("KIND"),
        "chessboard, circles or asymmetric-circles");
    add("size", po::value(&size)->value_name("CxR"),
        "number of inner corners or circles, e.g. 9x6");
    add("spacing", po::value(&spacing)->value_name("M"),
        "distance between neighbouring points (rows of asymmetric circles), m, e.g. 0.025");
  }

  std::optional<Board> board() const {
    constexpr std::array<std::string_view, 3> kKinds{"chessboard", "circles", "asymmetric-circles"};
    const auto known = std::find(kKinds.begin(), kKinds.end(), kind);
    if (known == kKinds.end())
      throw UsageError(
          describe({"", 0, "--board"}, kind, "chessboard, circles or asymmetric-circles"));
    if (size.empty() && spacing == 0) return std::nullopt;
    Board out{static_cast<BoardKind>(known - kKinds.begin()), 0, 0, spacing};
    const auto counts = two_whole_numbers(size, 3, 100);
    if (!counts)
      throw UsageError(describe({"", 0, "--size"}, fmt::format("'{}'", size),
                                "COLUMNSxROWS of inner corners or circles, 3 to 100, e.g. 9x6"));
    out.columns = (*counts)[0];
    out.rows = (*counts)[1];
    if (!(spacing > 0 && spacing <= 10))
      throw UsageError(describe({"", 0, "--spacing"}, fmt::format("{}", spacing),
                                "metres between neighbouring points, above 0, at most 10"));
    return out;
  }
};

LensModel lens_model(const std::string& name) {
  if (name == "pinhole") return LensModel::kPinhole;
  if (name == "brown") return LensModel::kBrown;
  if (name == "rational") return LensModel::kRational;
  if (name == "fisheye") return LensModel::kFisheye;
  throw UsageError(describe({"", 0, "--model"}, name, "pinhole, brown, rational or fisheye"));
}

struct ImportOptions {
  std::string file, size;

  void declare(CommandLine& line) {
    auto add = line.options().add_options();
    add("import", po::value(&file)->value_name("FILE"),
        "convert all cameras of a calibration (or only the one that --name names): OpenCap "
        ".pickle, Qualisys .qca.txt, Vicon .xcp, EasyMocap intri.yml, HumanEva .cal, Pose2Sim or "
        "Anipose .toml, Tsai .xml, OpenCV .yaml");
    add("image-size", po::value(&size)->value_name("WxH"),
        "size of the images, px, for an imported file that does not state it");
  }

  std::optional<ImageSize> image_size() const {
    if (size.empty()) return std::nullopt;
    const auto sides = two_whole_numbers(size, 1, kMostPixels);
    if (!sides)
      throw UsageError(describe({"", 0, "--image-size"}, fmt::format("'{}'", size),
                                "WIDTHxHEIGHT in pixels, e.g. 1920x1080"));
    return ImageSize{(*sides)[0], (*sides)[1]};
  }

  // Runs it if the command line asks for it; returns whether it did.
  bool run(const CommandLine& line, const std::string& name, const Arguments& arguments) const {
    if (file.empty()) {
      line.refuse({"image-size"}, "this option with --import");
      return false;
    }
    line.refuse({"views", "camera", "model", "floor", "points", "board", "size", "spacing"},
                "this option without --import");
    ImportJob job{.file = file,
                  .name = line.given("name") ? name : "",
                  .size = image_size(),
                  .output = line.required_output(),
                  .overwrite = line.common().overwrite,
                  .command_line = {"walktrack", "calibrate"}};
    job.command_line.insert(job.command_line.end(), arguments.begin(), arguments.end());
    fmt::print("{}", import_text(import_calibration(job)));
    return true;
  }
};

}  // namespace

int run_calibrate(const Arguments& arguments) {
  std::string name, model, views, camera, floor, points;
  BoardOptions board;
  CommandLine line({.name = "calibrate",
                    .operands = "",
                    .about = kAbout,
                    .example = "walktrack calibrate --camera data/demo/side.yaml --points "
                               "data/demo/side_points.csv --floor data/demo/side.mp4 -o "
                               "out/calibration"});
  auto add = line.options().add_options();
  add("name", po::value(&name)->default_value("cam0")->value_name("NAME"),
      "name of the camera and of its files");
  add("views", po::value(&views)->value_name("PATH"), "video or images of the board");
  add("camera", po::value(&camera)->value_name("FILE"),
      "use the lens of this calibration instead of --views");
  add("model", po::value(&model)->default_value("brown")->value_name("LENS"),
      "pinhole, brown, rational or fisheye");
  add("floor", po::value(&floor)->value_name("PATH"),
      "picture or video that the camera took at its place");
  add("points", po::value(&points)->value_name("FILE"), "measured points, CSV");
  board.declare(line);
  ImportOptions import;
  import.declare(line);
  if (!line.parse(arguments)) return kDone;
  if (import.run(line, name, arguments)) return kDone;
  CalibrateJob job{.name = name,
                   .board = board.board(),
                   .model = lens_model(model),
                   .views = views,
                   .camera = camera,
                   .floor = floor,
                   .points = points,
                   .output = line.required_output(),
                   .overwrite = line.common().overwrite,
                   .command_line = {"walktrack", "calibrate"}};
  job.command_line.insert(job.command_line.end(), arguments.begin(), arguments.end());
  Terminal terminal(line.common());
  fmt::print("{}", calibrate_text(calibrate(job, terminal.control())));
  return kDone;
}

}  // namespace walktrack
