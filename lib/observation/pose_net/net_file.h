// A network's ONNX file, with its weights widened from half precision: OpenCV 4.6 reads none, and
// files with them are half as large. Only what that takes is known of the format (onnx.proto: a
// model's graph is its field 7, the graph's tensors and inputs are its fields 5 and 11).
#pragma once

#include <string>
#include <string_view>

namespace walktrack {
inline namespace observation {

struct NetFile {
  std::string onnx;  // with 32-bit weights
  int side_px = 0;   // of the square picture that it takes
};

// InputError naming `name` where that is no ONNX file of a network with one square input.
NetFile widened_net(std::string_view file, const std::string& name);

}  // namespace observation
}  // namespace walktrack
