#include "io/calibration/formats/toml.h"

#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>
#include <Eigen/Geometry>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/calibration/calibration_checks.h"

namespace walktrack {
inline namespace io {

namespace {

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

// The table of one camera, which reports errors with their place.
class CameraTable {
 public:
  CameraTable(const toml::table& table, std::string file, std::string name)
      : table_(table), file_(std::move(file)), name_(std::move(name)) {}

  [[noreturn]] void fail(const std::string& key, std::string_view found,
                         std::string_view allowed) const {
    const toml::node* node = table_.get(key);
    throw InputError(
        describe({file_, line_of(node ? *node : table_), name_ + "." + key}, found, allowed));
  }

  bool has(const std::string& key) const { return table_.contains(key); }

  bool flag(const std::string& key) const {
    const auto value = table_[key].value<bool>();
    if (!value) fail(key, "no truth value", "true or false");
    return *value;
  }

  // The numbers of a list or of a list of lists, row by row.
  std::vector<double> numbers(const std::string& key) const {
    const toml::array* list = table_[key].as_array();
    if (!list) fail(key, has(key) ? "no list" : "nothing", "a list of numbers");
    std::vector<double> values;
    for (const toml::node& item : *list) append(key, item, values);
    return values;
  }
  std::vector<double> numbers(const std::string& key, size_t count) const {
    std::vector<double> values = numbers(key);
    if (values.size() != count) {
      fail(key, fmt::format("{} numbers", values.size()), fmt::format("{}", count));
    }
    return values;
  }

 private:
  void append(const std::string& key, const toml::node& item, std::vector<double>& values) const {
    if (const toml::array* row = item.as_array()) {
      for (const toml::node& inner : *row) append(key, inner, values);
      return;
    }
    const auto value = item.value<double>();
    if (!value || !std::isfinite(*value)) fail(key, "an entry that is no number", "numbers");
    values.push_back(*value);
  }

  const toml::table& table_;
  std::string file_, name_;
};

toml::table parse(const std::string& text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw InputError(describe({file, static_cast<int>(error.source().begin.line), ""},
                              fmt::format("broken TOML ({})", error.description()), ""));
  }
}

// The table with the key `name`, or the one whose "name" entry has that value.
const toml::table& find_camera(const toml::table& root, const std::string& file,
                               const std::string& name) {
  std::vector<std::string> names;
  for (const auto& [key, node] : root) {
    const toml::table* table = node.as_table();
    if (!table || !table->contains("matrix")) continue;
    const std::string inner = (*table)["name"].value_or(std::string());
    if (key.str() == name || inner == name) return *table;
    names.emplace_back(key.str());
    if (!inner.empty() && inner != names.back()) names.push_back(inner);
  }
  throw InputError(describe({file, 0, ""}, fmt::format("no camera '{}'", name),
                            fmt::format("{}", fmt::join(names, ", "))));
}

int image_side(const CameraTable& table, double value) {
  if (value != std::floor(value) || value < 1 || value > kMostPixels) {
    table.fail("size", fmt::format("{:g}", value), "whole numbers of pixels");
  }
  return static_cast<int>(value);
}

void set_lens(Camera& camera, const CameraTable& table) {
  const std::vector<double> coefficients = table.numbers("distortions");
  const bool fisheye = table.has("fisheye") && table.flag("fisheye");
  try {
    set_distortion(camera, coefficients, fisheye);
  } catch (const InputError&) {
    table.fail("distortions", fmt::format("{} numbers", coefficients.size()),
               fisheye ? "4" : "0, 4, 5, 8, 12 or 14");
  }
}

std::string list_text(const double* values, size_t count) {
  std::string text;
  for (size_t i = 0; i < count; ++i) {
    const std::string number = shortest_number(values[i]);
    const bool whole = number.find_first_of(".e") == std::string::npos;
    text += fmt::format("{}{}{}", i > 0 ? ", " : "", number, whole ? ".0" : "");
  }
  return fmt::format("[ {}]", text);
}

// A TOML string with control characters, quotes and backslashes escaped.
std::string quoted(const std::string& name) {
  std::ostringstream stream;
  stream << toml::value<std::string>(name);
  return stream.str();
}

std::string camera_table(const std::string& name, const Camera& camera) {
  const Eigen::AngleAxisd turn(camera.rotation);
  const Eigen::Vector3d rotation = turn.angle() * turn.axis();
  const auto coefficients = distortion_coefficients(camera);
  const std::array<double, 4> none{};
  const bool any = !coefficients.empty();
  return fmt::format(
      "[{0}]\nname = {0}\nsize = [ {1}.0, {2}.0]\n"
      "matrix = [ [ {3}, 0.0, {4}], [ 0.0, {5}, {6}], [ 0.0, 0.0, 1.0]]\n"
      "distortions = {7}\nrotation = {8}\ntranslation = {9}\nfisheye = {10}\n\n",
      quoted(name), camera.width_px, camera.height_px, shortest_number(camera.focal_px.x()),
      shortest_number(camera.centre_px.x()), shortest_number(camera.focal_px.y()),
      shortest_number(camera.centre_px.y()),
      any ? list_text(coefficients.data(), coefficients.size()) : list_text(none.data(), 4),
      list_text(rotation.data(), 3), list_text(camera.translation.data(), 3),
      camera.lens == Lens::kFisheye);
}

}  // namespace

Camera camera_from_toml(const std::string& text, const std::string& file, const std::string& name) {
  const toml::table root = parse(text, file);
  const CameraTable table(find_camera(root, file, name), file, name);
  const Complain complain = [&](std::string_view key, std::string_view found,
                                std::string_view allowed) {
    table.fail(key == "camera_matrix" ? "matrix" : std::string(key), found, allowed);
  };
  Camera camera;
  const std::vector<double> size = table.numbers("size", 2);
  camera.width_px = image_side(table, size[0]);
  camera.height_px = image_side(table, size[1]);
  const std::vector<double> matrix = table.numbers("matrix", 9);
  set_camera_matrix(camera,
                    Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(matrix.data()),
                    complain);
  set_lens(camera, table);
  camera.rotation = rotation_from_rodrigues(Eigen::Vector3d(table.numbers("rotation", 3).data()));
  camera.translation = Eigen::Vector3d(table.numbers("translation", 3).data());
  return camera;
}

std::vector<std::string> toml_names(const std::string& text, const std::string& file) {
  std::vector<std::string> out;
  for (const auto& [key, node] : parse(text, file)) {
    const toml::table* table = node.as_table();
    if (!table || !table->contains("matrix")) continue;
    out.push_back((*table)["name"].value_or(std::string(key.str())));
  }
  return out;
}

std::string toml_from_cameras(const std::vector<std::pair<std::string, Camera>>& cameras) {
  std::string text;
  for (const auto& [name, camera] : cameras) text += camera_table(name, camera);
  return text + "[metadata]\nadjusted = false\nerror = 0.0\n";
}

}  // namespace io
}  // namespace walktrack
