// Videos and image folders whose frames show their own number in a way that survives compression.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace walktrack {

// 64 x 48, with a grey level that encodes 0..24.
cv::Mat sample_frame(int number);
// The number that a sample frame shows after compression.
int shown_number(const cv::Mat& frame);

// 25 Hz, numbers from 0.
void write_sample_video(const std::string& path, int frames);
// 25 Hz, numbers from 0; frame i is shown until 1 / 25 s * durations[i] later.
void write_uneven_video(const std::string& path, const std::vector<double>& durations);
// These frames at this rate; frame i is shown until durations[i] / rate s later.
void write_timed_video(const std::string& path, const std::vector<cv::Mat>& frames, double rate,
                       const std::vector<double>& durations);
// Sets a rotation flag, clockwise, in an MP4 file: 90, 180 or 270.
void turn_video(const std::string& path, int clockwise_deg);
// Lets an MP4 file of 25 Hz begin some frames later without encoding it again, as telephones trim
// videos: by its edit list.
void trim_video(const std::string& path, int frames);
// frame<number>.png
void write_sample_images(const std::string& folder, const std::vector<int>& numbers);

}  // namespace walktrack
