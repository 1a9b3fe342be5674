// Small input files, which tests write.
#pragma once

#include <stdexcept>
#include <string>

#include "tests/run_program.h"

namespace walktrack {

// A 64 x 48 camera at (0, -5, 1) that looks along y.
inline const char* const kCalibrationText =
    "%YAML:1.0\n---\n"
    "image_width: 64\n"
    "image_height: 48\n"
    "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 60., 0., 31.5, 0., 60., 23.5, 0., 0., 1. ]\n"
    "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
    "   data: [ -0.1, 0.02, 0., 0., 0. ]\n"
    "rotation: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 1., 0., 0., 0., 0., -1., 0., 1., 0. ]\n"
    "translation: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n"
    "   data: [ 0., 1., 5. ]\n";

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("'" + from + "' is not in the text");
  return text.replace(at, from.size(), to);
}

// A calibration of another tool, "qualisys/two.xml": the seeds of the fuzzers.
inline std::string calibration_corpus(const std::string& name) {
  return read_file(std::string(WALKTRACK_SOURCE_DIR) + "/tests/fuzz/corpus/calibration_" + name);
}

inline std::string shared_data(const std::string& path) {
  return std::string(WALKTRACK_SOURCE_DIR) + "/../shared/data/" + path;
}

}  // namespace walktrack
