// Runs a program as a user would, without a shell, and collects its output.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace walktrack {

struct ProgramResult {
  int exit_code;  // 128 + signal if it was killed by one
  std::string out, err;
};

ProgramResult run_program(const std::string& path, const std::vector<std::string>& arguments);

// The same with its stderr on a terminal, whose lines end in "\r\n".
ProgramResult run_on_terminal(const std::string& path, const std::vector<std::string>& arguments);

// A program that runs while the test continues; killed at the end of the scope. Its output is
// discarded.
class StartedProgram {
 public:
  StartedProgram(const std::string& path, const std::vector<std::string>& arguments);
  ~StartedProgram();
  StartedProgram(const StartedProgram&) = delete;
  StartedProgram& operator=(const StartedProgram&) = delete;

  void send(int signal) const;
  // Waits for its end and returns the exit code, 128 + signal if it was killed by one.
  int wait();
  // Peak memory of the program or of one of its processes, MB; known after wait().
  double peak_memory() const { return peak_memory_; }

 private:
  int pid_ = -1;  // -1 = ended
  double peak_memory_ = 0;
};

// The walktrack of this build.
ProgramResult run_walktrack(const std::vector<std::string>& arguments);

// A fresh empty folder, removed at the end of the scope.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  // Writes a file (folders included) and returns its path.
  std::string write(const std::string& name, const std::string& content) const;

 private:
  std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& path);

}  // namespace walktrack
