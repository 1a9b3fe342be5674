// The data of a camera and of one of its frames for the terms. Internal to this module, because it
// uses OpenCV.
#pragma once

#include <opencv2/core.hpp>

#include "observation/observer.h"

namespace walktrack {
inline namespace observation {

struct ObserverSetting {
  ObservationConfig config;
  Camera camera;  // of the shrunk image
  int shrink;
  int threads;
  bool occluded;  // whether some pixels are unknown
  cv::Mat mask;   // 255 at pixels that are occluded or whose background was never seen
};

struct ObservedFrame {
  Region region;
  cv::Mat bgr;                             // shrunk; empty without an image
  const DetectedPeople* people = nullptr;  // only during preparation
  GreyImage grey;                          // see grey_of()
  // The empty scene, only during preparation and if there is a model of it.
  FlowBackground background;
};

// The grey image, which is computed when a term first asks for it.
const GreyImage& grey_of(ObservedFrame& frame);

}  // namespace observation
}  // namespace walktrack
