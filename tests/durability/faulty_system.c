/* A system that goes wrong, for programs that are started with LD_PRELOAD of this:
 *   FAIL_WRITE_AT=n       the n-th write to a file fails as on a full disk, and all after it
 *   COUNT_WRITES=FILE     appends to it how many writes there were
 *   SLOW_RENAMES_MS=t     renames and the making of folders take so long, as on a busy file server
 *   CLOCK_STEPS_S=s       the clock of the day jumps by so much to and fro
 * Writes to terminals, pipes and sockets are left alone. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

static atomic_long writes;

static long number(const char* name) {
  const char* text = getenv(name);
  return text ? atol(text) : 0;
}

static int is_full(int file) {
  struct stat about;
  if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) return 0;
  const long now = atomic_fetch_add(&writes, 1) + 1, from = number("FAIL_WRITE_AT");
  if (from == 0 || now < from) return 0;
  errno = ENOSPC;
  return 1;
}

ssize_t write(int file, const void* data, size_t size) {
  ssize_t (*real)(int, const void*, size_t) =
      (ssize_t(*)(int, const void*, size_t))dlsym(RTLD_NEXT, "write");
  return is_full(file) ? -1 : real(file, data, size);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  ssize_t (*real)(int, const struct iovec*, int) =
      (ssize_t(*)(int, const struct iovec*, int))dlsym(RTLD_NEXT, "writev");
  return is_full(file) ? -1 : real(file, parts, count);
}

ssize_t pwrite(int file, const void* data, size_t size, off_t at) {
  ssize_t (*real)(int, const void*, size_t, off_t) =
      (ssize_t(*)(int, const void*, size_t, off_t))dlsym(RTLD_NEXT, "pwrite");
  return is_full(file) ? -1 : real(file, data, size, at);
}

static void wait_ms(long ms) {
  struct timespec time = {ms / 1000, ms % 1000 * 1000000};
  if (ms > 0) nanosleep(&time, NULL);
}

int rename(const char* from, const char* to) {
  int (*real)(const char*, const char*) = (int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename");
  wait_ms(number("SLOW_RENAMES_MS"));
  return real(from, to);
}

int mkdir(const char* path, mode_t mode) {
  int (*real)(const char*, mode_t) = (int (*)(const char*, mode_t))dlsym(RTLD_NEXT, "mkdir");
  wait_ms(number("SLOW_RENAMES_MS"));
  return real(path, mode);
}

int clock_gettime(clockid_t clock, struct timespec* time) {
  static atomic_long asked;
  int (*real)(clockid_t, struct timespec*) =
      (int (*)(clockid_t, struct timespec*))dlsym(RTLD_NEXT, "clock_gettime");
  const int result = real(clock, time);
  if (clock == CLOCK_REALTIME && atomic_fetch_add(&asked, 1) % 2) time->tv_sec += number("CLOCK_STEPS_S");
  return result;
}

__attribute__((destructor)) static void say(void) {
  const char* path = getenv("COUNT_WRITES");
  FILE* file = path ? fopen(path, "a") : NULL;
  if (!file) return;
  fprintf(file, "%ld\n", atomic_load(&writes));
  fclose(file);
}
