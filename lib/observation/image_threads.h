// How many threads work on pictures inside OpenCV: as many as the machine has unless told
// otherwise. It is one number of the whole program.
#pragma once

namespace walktrack {
inline namespace observation {

void set_image_threads(int threads);

// One thread while this lives, the number before afterwards: OpenCV splits a network's layers by
// its threads, and other sums have other last bits.
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
