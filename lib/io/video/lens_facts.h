// What a recording says of the lens that it was made with.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace walktrack {

// The focal length for which a picture of 43.27 mm diagonal (35 mm film) shows as much, mm: of a
// video what iPhones write (com.apple.quicktime.camera.focal_length.35mm_equivalent), of images the
// EXIF field FocalLengthIn35mmFilm of the first one. Nothing where the file does not say, says 0,
// or something that is no lens (below 4 or above 2000 mm).
std::optional<double> focal_length_35mm(const std::filesystem::path& video_or_images);

// The EXIF field in the bytes of a JPEG file.
std::optional<double> exif_focal_length_35mm(std::string_view jpeg);

}  // namespace walktrack
