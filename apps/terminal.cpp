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

// A signal handler may only use static storage.
std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void request_stop(int) { stop_requested.store(true); }

constexpr auto kRedrawInterval = std::chrono::milliseconds(100),
               kJsonInterval = std::chrono::milliseconds(500),
               kLogInterval = std::chrono::milliseconds(30000);
constexpr size_t kBarWidth = 30;

// https://no-color.org: set and not empty.
bool wants_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  return no_colour == nullptr || *no_colour == '\0';
}

}  // namespace

void watch_signals() {
  struct sigaction action = {};
  action.sa_handler = request_stop;
  sigemptyset(&action.sa_mask);
  // The handler is for one signal only: the second ends the program. Reads are restarted after the
  // first.
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& stop_request() { return stop_requested; }

Terminal::Style Terminal::style_of(const CommonOptions& options) {
  if (options.progress == "json") return Style::kJson;
  if (options.quiet || options.progress == "none") return Style::kNone;
  return isatty(STDERR_FILENO) != 0 ? Style::kBar : Style::kLog;
}

Terminal::Terminal(const CommonOptions& options)
    : quiet_(options.quiet),
      colour_(wants_colour()),
      style_(style_of(options)),
      pace_(style_ == Style::kBar    ? kRedrawInterval
            : style_ == Style::kJson ? kJsonInterval
                                     : kLogInterval,
            style_ == Style::kLog) {}

Terminal::~Terminal() { finish_line(); }

JobControl Terminal::control() {
  JobControl control;
  control.stop_request = &stop_requested;
  if (!quiet_) control.message = [this](std::string_view text) { say(text); };
  if (style_ != Style::kNone) control.report = [this](const Progress& progress) { show(progress); };
  return control;
}

void Terminal::say(std::string_view text) {
  finish_line();
  std::fputs(style_ == Style::kJson ? message_json(text).c_str()
                                    : fmt::format("walktrack: {}\n", text).c_str(),
             stderr);
}

void Terminal::show(const Progress& progress) {
  const bool due = pace_.due(progress, ProgressPace::Clock::now());
  if (pace_.new_stage()) finish_line();
  if (!due) return;
  if (style_ == Style::kJson) {
    std::fputs(progress_json(progress, pace_).c_str(), stderr);
  } else if (style_ == Style::kLog) {
    std::fputs(fmt::format("walktrack: {}\n", progress_text(progress, pace_)).c_str(), stderr);
  } else {
    std::fputs(fmt::format("\r\033[K{}", progress_text(progress, pace_, bar(progress))).c_str(),
               stderr);
    line_open_ = true;
    if (progress.total > 0 && progress.done >= progress.total) finish_line();
  }
}

std::string Terminal::bar(const Progress& progress) const {
  if (progress.total == 0) return "";
  const size_t full = kBarWidth * std::min(progress.done, progress.total) / progress.total;
  return fmt::format("[{}{}{}{}] ", colour_ ? "\033[32m" : "", std::string(full, '='),
                     colour_ ? "\033[0m" : "", std::string(kBarWidth - full, ' '));
}

void Terminal::finish_line() {
  if (line_open_) std::fputs("\n", stderr);
  line_open_ = false;
}

}  // namespace walktrack
