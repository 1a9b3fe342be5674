// What a recording says of the lens that it was made with, and what is known of telephones.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace walktrack {
inline namespace io {

// The focal length for which a picture of 43.27 mm diagonal (35 mm film) shows as much, mm: of a
// video what iPhones write (com.apple.quicktime.camera.focal_length.35mm_equivalent), of images the
// EXIF field FocalLengthIn35mmFilm of the first one. Nothing where the file does not say, says 0,
// or something that is no lens (below 4 or above 2000 mm).
std::optional<double> focal_length_35mm(const std::filesystem::path& video_or_images);

// The telephone or camera as the recording names it, "iPhone 12" or "SM-G991B": QuickTime's and
// Android's `model` of a video, EXIF's of the first image. "" where it does not say.
std::string camera_model(const std::filesystem::path& video_or_images);

// The focal length (as above) of a telephone's main camera by its name in recordings, as its maker
// states it; nothing for one that is not in the table of lens_facts.cpp.
std::optional<double> telephone_focal_length_35mm(std::string_view model);

// The EXIF fields in the bytes of a JPEG file.
std::optional<double> exif_focal_length_35mm(std::string_view jpeg);
std::string exif_model(std::string_view jpeg);

}  // namespace io
}  // namespace walktrack
