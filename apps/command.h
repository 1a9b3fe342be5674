// Common parts of all commands: the table's entry, the common options, the exit codes.
//
// A command is one file, apps/cmd_<name>.cpp: it declares its options with a CommandLine, parses,
// fills a job struct, calls the library and returns an exit code. It is listed in main.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <boost/program_options.hpp>

#include "io/config/config.h"

namespace walktrack {

// Exit codes (the table is part of the manual).
enum ExitCode {
  kDone = 0,
  kFailed = 1,
  kUsage = 2,          // usage or configuration
  kUnreadable = 3,     // an input cannot be read or does not fit
  kDegraded = 4,       // done, but a quality check failed, or the walker fell or diverged
  kInterrupted = 130,  // stopped by a signal; the part that was done is kept
};

using Arguments = std::vector<std::string>;  // what follows the command's name

struct Command {
  std::string_view name;
  std::string_view summary;  // one line for `walktrack --help`
  int (*run)(const Arguments& arguments);
};

// Options of all commands, as stated.
struct CommonOptions {
  std::string config_file;
  std::vector<std::string> settings;  // key=value
  std::string output;
  std::string seed, threads;
  std::string progress = "auto";  // auto, json, none
  bool overwrite = false;
  bool quiet = false;
  bool verbose = false;
};

// The content of --help for a command.
struct CommandHelp {
  std::string name;
  std::string operands;  // e.g. "SCENE.yaml"
  std::string about;     // a sentence or two
  std::string example;   // a command that runs on shipped data
};

// The options of all commands, bound to `common`.
boost::program_options::options_description common_options(CommonOptions& common);

class CommandLine {
 public:
  explicit CommandLine(CommandHelp help);

  // Declare the command's own options here: options().add_options()("model", po::value(&x), "…").
  boost::program_options::options_description& options() { return own_; }
  // Declares an operand, in order. An operand that is missing is an error unless optional.
  void operand(const std::string& name, std::string* value, bool optional = false);
  // Declares an operand list that takes all remaining words, at least one.
  void operands(const std::string& name, std::vector<std::string>* values);

  // Returns false if --help was asked for and printed. Throws a UsageError that names the nearest
  // option.
  bool parse(const Arguments& arguments);

  const CommonOptions& common() const { return common_; }
  // Whether an option was given on the command line.
  bool given(const std::string& option) const { return given_.contains(option); }
  // The value of an option that was given; UsageError if it is not in [low, high].
  std::optional<double> within(const std::string& option, double value, double low,
                               double high) const;
  // UsageError that names the first of these options that was given, because it has no effect here.
  void refuse(const std::vector<std::string>& options, const std::string& allowed) const;
  // The defaults, changed by --config, then by --set, then by --seed and --threads.
  ConfigWithOrigin config() const;
  // The same for commands whose --config and --set refer to a model.
  ConfigWithOrigin config_of_run() const;
  // --output; UsageError if it is missing.
  std::string required_output() const;
  // Writes a result that is one text to --output, or prints it without --output. UsageError if it
  // would overwrite one of the inputs, or --config.
  void write_or_print(const std::string& text,
                      const std::vector<std::filesystem::path>& inputs = {}) const;

 private:
  struct Operand {
    std::string name;
    std::string* value;
    bool optional;
  };
  bool explain(const Arguments& arguments) const;
  void print_help() const;
  void take_operands(const std::vector<std::string>& words);

  CommandHelp help_;
  CommonOptions common_;
  boost::program_options::options_description own_;
  std::vector<Operand> operands_;
  std::set<std::string> given_;
  std::vector<std::string>* rest_ = nullptr;
  std::string rest_name_;
};

}  // namespace walktrack
