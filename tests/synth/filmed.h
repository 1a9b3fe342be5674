// A small camera that looks at a walker, and its grey images.
#pragma once

#include <cstdint>
#include <vector>

#include "core/conventions.h"
#include "synth/recording/sensor.h"
#include "synth/recording/stage.h"

namespace walktrack {

// 4 m away, `scale` times 240 x 180 pixels.
inline RenderCamera small_camera(double azimuth_deg, int scale = 1) {
  RenderCamera camera;
  camera.name = "camera";
  camera.width_px = 240 * scale;
  camera.height_px = 180 * scale;
  camera.azimuth = rad_from_deg(azimuth_deg);
  camera.height = 1.4;
  camera.distance = 4;
  camera.focal_px = 260 * scale;
  return camera;
}

// The frame at `time` (s), row by row.
inline std::vector<uint8_t> grey_picture(const Stage& stage, const View& view, uint32_t frame,
                                         double time) {
  const Picture picture = render(view, stage.world, actors_at(stage, time));
  const std::vector<uint8_t> bgr = developed(picture.colour, Sensor{}, 3, 0, frame);
  std::vector<uint8_t> grey;
  for (size_t i = 0; i < bgr.size(); i += 3)
    grey.push_back(static_cast<uint8_t>((bgr[i] + 2 * bgr[i + 1] + bgr[i + 2]) / 4));
  return grey;
}

}  // namespace walktrack
