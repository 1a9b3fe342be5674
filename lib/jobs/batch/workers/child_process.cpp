#include "jobs/batch/workers/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace walktrack {
inline namespace jobs {

namespace {

constexpr int kCannotStart = 127;

// Runs between fork and exec, so that only async-signal-safe calls are allowed.
[[noreturn]] void become(char* const* argv, int out, rlim_t memory_bytes, pid_t parent) {
  const int in = ::open("/dev/null", O_RDONLY);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  if (memory_bytes > 0) {
    const rlimit limit{memory_bytes, memory_bytes};
    ::setrlimit(RLIMIT_AS, &limit);
  }
  // The parent passes signals of the terminal on, and the child ends with its parent.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kCannotStart);  // the parent died before prctl
  ::execv(argv[0], argv);
  ::_exit(kCannotStart);
}

// A new file: an existing one, above all a link, is neither followed nor truncated.
int new_log(const std::filesystem::path& log) {
  const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (out >= 0) return out;
  throw std::runtime_error(
      fmt::format("{}: cannot be made: {}", log.string(), std::generic_category().message(errno)));
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& words, const std::filesystem::path& log,
                           const ChildLimits& limits)
    : limits_(limits), start_(Clock::now()) {
  std::vector<std::string> copies = words;
  std::vector<char*> argv;
  argv.reserve(copies.size() + 1);
  for (std::string& word : copies) argv.push_back(word.data());
  argv.push_back(nullptr);
  const rlim_t memory_bytes = rlim_t{limits.memory_mb} << 20;
  const int out = new_log(log);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) become(argv.data(), out, memory_bytes, parent);
  ::close(out);
  if (pid_ < 0) {
    throw std::runtime_error(
        fmt::format("cannot start a child process: {}", std::generic_category().message(errno)));
  }
}

ChildProcess::~ChildProcess() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      limits_(other.limits_),
      start_(other.start_),
      timed_out_(other.timed_out_) {}

std::optional<ChildEnd> ChildProcess::poll() {
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  int status = 0;
  const int ended = ::waitpid(pid_, &status, WNOHANG);
  if (ended == 0) {
    if (limits_.seconds > 0 && seconds > limits_.seconds) {
      timed_out_ = true;
      ::kill(pid_, SIGKILL);
    }
    return std::nullopt;
  }
  pid_ = -1;
  ChildEnd end{.timed_out = timed_out_, .seconds = seconds};
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  end.exit_code = end.signal ? 128 + end.signal : WEXITSTATUS(status);
  return end;
}

void ChildProcess::ask_to_stop() const {
  if (pid_ > 0) ::kill(pid_, SIGTERM);
}

}  // namespace jobs
}  // namespace walktrack
