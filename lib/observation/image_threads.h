// The number of threads that OpenCV uses on images: as many as the machine has by default. It is
// one number for the whole program.
#pragma once

namespace walktrack {
inline namespace observation {

void set_image_threads(int threads);

// One thread during the life of this object, the former number afterwards: OpenCV splits a
// network's layers by its threads, which changes the last bits of sums.
class OneImageThread {
 public:
  OneImageThread();
  ~OneImageThread();
  OneImageThread(const OneImageThread&) = delete;
  OneImageThread& operator=(const OneImageThread&) = delete;

 private:
  int before_;
};

}  // namespace observation
}  // namespace walktrack
