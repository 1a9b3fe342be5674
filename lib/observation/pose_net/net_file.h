// Reads a network's ONNX file and converts its weights from half precision, which OpenCV 4.6 cannot
// read and which halves the size of the file. Only the fields that are needed are known
// (onnx.proto: a model's graph is its field 7, the graph's tensors and inputs are its fields 5 and
// 11).
#pragma once

#include <string>
#include <string_view>

namespace walktrack {
inline namespace observation {

struct NetFile {
  std::string onnx;  // with 32-bit weights
  int side_px = 0;   // of the square input image
};

// InputError that names `name` if it is not an ONNX file of a network with one square input.
NetFile widened_net(std::string_view file, const std::string& name);

}  // namespace observation
}  // namespace walktrack
