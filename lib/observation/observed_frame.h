// What terms are given of a camera and of one of its frames. Internal to this module: OpenCV is
// seen here.
#pragma once

#include <opencv2/core.hpp>

#include "observation/observer.h"

namespace walktrack {
inline namespace observation {

struct ObserverSetting {
  ObservationConfig config;
  Camera camera, full_camera;  // of the shrunk image, and as calibrated
  int shrink;
  int threads;
  bool occluded;  // whether there are pixels of which nothing is known
  cv::Mat mask;   // 255 there: something stands in front, or what is behind was never seen
};

struct ObservedFrame {
  Region region;
  cv::Mat bgr;                             // shrunk; empty without a picture
  const DetectedPeople* people = nullptr;  // only while the frame is prepared
  GreyImage grey;                          // see grey_of()
  // The empty scene, only while the frame is prepared and where it is modelled.
  FlowBackground background;
};

// The grey image, made when a term first asks for it.
const GreyImage& grey_of(ObservedFrame& frame);

}  // namespace observation
}  // namespace walktrack
