#include "observation/image_threads.h"

#include <opencv2/core/utility.hpp>

namespace walktrack {
inline namespace observation {

void set_image_threads(int threads) { cv::setNumThreads(threads); }

OneImageThread::OneImageThread() : before_(cv::getNumThreads()) { set_image_threads(1); }
OneImageThread::~OneImageThread() { set_image_threads(before_); }

}  // namespace observation
}  // namespace walktrack
