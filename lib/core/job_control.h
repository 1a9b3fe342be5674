// The communication of a long job with its caller: it reports its progress and asks whether it
// should stop. Both are optional; a job that is interrupted keeps the part that it has done and
// reports it.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string_view>

namespace walktrack {
inline namespace core {

struct Progress {
  std::string_view what;  // e.g. "tracking"
  size_t done = 0;
  size_t total = 0;  // 0 = unknown
};

struct JobControl {
  std::function<void(const Progress&)> report{};    // may be empty
  std::function<void(std::string_view)> message{};  // a remark of one line; may be empty
  const std::atomic<bool>* stop_request = nullptr;

  void progress(std::string_view what, size_t done, size_t total) const {
    if (report) report({what, done, total});
  }
  void say(std::string_view text) const {
    if (message) message(text);
  }
  bool stopping() const { return stop_request && stop_request->load(std::memory_order_relaxed); }
};

}  // namespace core
}  // namespace walktrack
