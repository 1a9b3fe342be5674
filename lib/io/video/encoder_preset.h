// The trade-off between time and file size of the H.264 encoder, by x264's names.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace walktrack {
inline namespace io {

enum class EncoderPreset { kUltrafast, kSuperfast, kVeryfast, kFaster, kFast, kMedium };

// Fastest first.
inline std::vector<std::pair<std::string, EncoderPreset>> encoder_presets() {
  return {{"ultrafast", EncoderPreset::kUltrafast}, {"superfast", EncoderPreset::kSuperfast},
          {"veryfast", EncoderPreset::kVeryfast},   {"faster", EncoderPreset::kFaster},
          {"fast", EncoderPreset::kFast},           {"medium", EncoderPreset::kMedium}};
}

}  // namespace io
}  // namespace walktrack
