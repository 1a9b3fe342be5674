#include "terminal.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <string>

#include <fmt/format.h>

namespace walktrack {

namespace {

// A signal handler reaches nothing but static storage.
std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void request_stop(int) { stop_requested.store(true); }

constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
constexpr size_t kBarWidth = 30;

// https://no-color.org: set and not empty.
bool wants_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  return no_colour == nullptr || *no_colour == '\0';
}

// "45 s", "12 min", "3 h 20 min".
std::string duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  const int minutes = static_cast<int>(std::lround(seconds / 60));
  return minutes < 120 ? fmt::format("{} min", minutes)
                       : fmt::format("{} h {:02d} min", minutes / 60, minutes % 60);
}

}  // namespace

void watch_signals() {
  struct sigaction action = {};
  action.sa_handler = request_stop;
  sigemptyset(&action.sa_mask);
  // The handler is for one signal only: the second ends the program. Reads resume after the first.
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& stop_request() { return stop_requested; }

Terminal::Terminal(const CommonOptions& options)
    : quiet_(options.quiet),
      interactive_(!options.quiet && isatty(STDERR_FILENO) != 0),
      colour_(wants_colour()) {}

Terminal::~Terminal() { finish_line(); }

JobControl Terminal::control() {
  JobControl control;
  control.stop_request = &stop_requested;
  if (!quiet_) control.message = [this](std::string_view text) { say(text); };
  if (interactive_) control.report = [this](const Progress& progress) { draw(progress); };
  return control;
}

void Terminal::say(std::string_view text) {
  finish_line();
  std::fputs(fmt::format("walktrack: {}\n", text).c_str(), stderr);
}

void Terminal::draw(const Progress& progress) {
  const auto now = Clock::now();
  const bool complete = progress.total > 0 && progress.done >= progress.total;
  if (progress.what != what_) {
    finish_line();
    what_ = progress.what;
    start_ = now;
    done_before_ = progress.done;
  } else if (now - drawn_ < kRedrawInterval && !complete) {
    return;
  }
  drawn_ = now;
  std::fputs(fmt::format("\r\033[K{}", line(progress)).c_str(), stderr);
  line_open_ = true;
  if (complete) finish_line();
}

std::string Terminal::line(const Progress& progress) const {
  const double seconds = std::chrono::duration<double>(drawn_ - start_).count();
  // What a run that is gone on with had done before took none of this time.
  const auto since = static_cast<double>(progress.done - std::min(progress.done, done_before_));
  const double rate = seconds > 0 ? since / seconds : 0;
  const std::string pace = rate > 0 ? fmt::format("  {:.1f}/s", rate) : "";
  if (progress.total == 0) return fmt::format("{} {}{}", what_, progress.done, pace);
  const size_t done = std::min(progress.done, progress.total);
  const size_t full = kBarWidth * done / progress.total;
  const double left = static_cast<double>(progress.total - done) / rate;
  return fmt::format("{} [{}{}{}{}] {}/{}{}{}", what_, colour_ ? "\033[32m" : "",
                     std::string(full, '='), colour_ ? "\033[0m" : "",
                     std::string(kBarWidth - full, ' '), done, progress.total, pace,
                     rate > 0 ? fmt::format("  {} left", duration(left)) : "");
}

void Terminal::finish_line() {
  if (line_open_) std::fputs("\n", stderr);
  line_open_ = false;
}

}  // namespace walktrack
