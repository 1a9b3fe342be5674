#include "io/video/quiet.h"

#include <fcntl.h>
#include <unistd.h>

#include <mutex>

// A sanitizer's report must not be lost.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WALKTRACK_QUIET 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define WALKTRACK_QUIET 0
#endif
#endif
#ifndef WALKTRACK_QUIET
#define WALKTRACK_QUIET 1
#endif

namespace walktrack {
inline namespace io {

namespace {

// The process has one stderr: the first instance replaces it and the last one restores it.
std::mutex guard;
int users = 0;
int kept = -1;

}  // namespace

QuietDecoders::QuietDecoders() {
  const std::lock_guard lock(guard);
  if (!WALKTRACK_QUIET || users++ > 0) return;
  kept = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  const int nowhere = kept < 0 ? -1 : open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

QuietDecoders::~QuietDecoders() {
  const std::lock_guard lock(guard);
  if (!WALKTRACK_QUIET || --users > 0 || kept < 0) return;
  dup2(kept, STDERR_FILENO);
  close(kept);
  kept = -1;
}

}  // namespace io
}  // namespace walktrack
