// Vicon's camera calibration (.xcp): XML with one <Camera> element for each camera. Sources:
// Vicon's "About calibration data (XCP) files" (CaraPost reference: the attributes, quaternions
// with the real part last, the correction of lens distortion), and four readers that agree (MAMMA's
// xcp_loader; avialsync's vicon_c3d_loader, whose author verified the positions by the ring lights
// of other cameras in the images; the Imaginarium's ViconReader; OpenCap's, except for the
// principal point):
//   DEVICEID               the name, which Nexus uses in the names of videos
//   SENSOR_SIZE            width height, px
//   PIXEL_ASPECT_RATIO     width / height of a pixel; SKEW: 0
//   <KeyFrame> FOCAL_LENGTH, PRINCIPAL_POINT   px
//   ORIENTATION            x y z w, from the world to the camera's axes (x right, y down,
//                          z forward)
//   POSITION               mm
//   VICON_RADIAL "k1 k2", VICON_RADIAL2 "Vicon3Parameter x y k1 k2 k3"
//                          the undistorted position of a pixel at the distance d from the
//                          principal point (or from x, y) is 1 + k1 d^2 + k2 d^4 + k3 d^6
//                          times as far away from it
// A file may list marker cameras beside video cameras; if there are any video cameras, only those
// are read. A camera without a KeyFrame has not been calibrated.
#pragma once

#include <string>
#include <vector>

#include "camera/camera.h"

namespace walktrack {
inline namespace io {

Camera camera_from_vicon(const std::string& text, const std::string& file, const std::string& name);
std::vector<std::string> vicon_names(const std::string& text, const std::string& file);

}  // namespace io
}  // namespace walktrack
