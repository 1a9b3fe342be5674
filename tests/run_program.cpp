#include "tests/run_program.h"

#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fcntl.h>
#include <gtest/gtest.h>

extern char** environ;

namespace walktrack {

namespace fs = std::filesystem;

namespace {

// Starts it with its output going to two files.
pid_t start(const std::string& path, const std::vector<std::string>& arguments,
            const std::string& out, const std::string& err) {
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), flags, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), flags, 0600);
  pid_t child = 0;
  const int failed = posix_spawn(&child, path.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("cannot start " + path);
  return child;
}

// Everything that is written to a terminal until the last program that has it open ends.
std::string read_terminal(int terminal) {
  std::string text;
  char part[4096];
  for (ssize_t size = 0; (size = read(terminal, part, sizeof part)) > 0;)
    text.append(part, static_cast<size_t>(size));
  return text;
}

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

ProgramResult run_program(const std::string& path, const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  const std::string out = folder / "stdout", err = folder / "stderr";
  int status = 0;
  waitpid(start(path, arguments, out, err), &status, 0);
  return {code_of(status), read_file(out), read_file(err)};
}

ProgramResult run_on_terminal(const std::string& path, const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  const std::string out = folder / "stdout";
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0)
    throw std::runtime_error("no terminal to run " + path + " on");
  const pid_t child = start(path, arguments, out, ptsname(terminal));
  const std::string err = read_terminal(terminal);
  close(terminal);
  int status = 0;
  waitpid(child, &status, 0);
  return {code_of(status), read_file(out), err};
}

StartedProgram::StartedProgram(const std::string& path, const std::vector<std::string>& arguments)
    : pid_(start(path, arguments, "/dev/null", "/dev/null")) {}

StartedProgram::~StartedProgram() {
  if (pid_ < 0) return;
  send(SIGKILL);
  wait();
}

void StartedProgram::send(int signal) const { kill(pid_, signal); }

int StartedProgram::wait() {
  int status = 0;
  rusage usage{};
  wait4(pid_, &status, 0, &usage);
  pid_ = -1;
  peak_memory_ = static_cast<double>(usage.ru_maxrss) / 1024;  // from kB
  return code_of(status);
}

ProgramResult run_walktrack(const std::vector<std::string>& arguments) {
  return run_program(WALKTRACK_BINARY, arguments);
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "walktrack_XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make " + pattern);
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& content) const {
  const fs::path file = path_ / name;
  fs::create_directories(file.parent_path());
  fs::remove(file);  // file systems flush a file that is truncated and written again
  std::ofstream(file, std::ios::binary) << content;
  return file.string();
}

std::string read_file(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace walktrack
