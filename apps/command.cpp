#include "command.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "manual.h"
#include "terminal.h"

namespace walktrack {

namespace po = boost::program_options;

namespace {

constexpr char kWords[] = "words that are not options";  // no option on the command line can have
                                                         // this name

std::vector<std::string> long_names(const po::options_description& options) {
  std::vector<std::string> names;
  for (const auto& option : options.options()) names.push_back("--" + option->long_name());
  return names;
}

std::string unknown_option(const std::string& found, const po::options_description& known) {
  const std::string nearest = nearest_word(found, long_names(known));
  return fmt::format("unknown option '{}'{}", found,
                     nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest));
}

// Parses without abbreviations, which a later option might make ambiguous.
po::variables_map parse_words(const Arguments& arguments, const po::options_description& known) {
  po::options_description all;
  all.add(known).add_options()(kWords, po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add(kWords, -1);
  using namespace po::command_line_style;
  po::variables_map values;
  try {
    po::store(po::command_line_parser(arguments)
                  .options(all)
                  .positional(positional)
                  .style(unix_style & ~allow_guessing)
                  .run(),
              values);
    po::notify(values);
  } catch (const po::unknown_option& error) {
    throw UsageError(unknown_option(error.get_option_name(), known));
  } catch (const po::error& error) {
    throw UsageError(error.what());
  }
  return values;
}

void apply_run_options(const CommonOptions& common, ConfigWithOrigin& config) {
  if (!common.seed.empty()) apply_setting(config, "seed=" + common.seed, "--seed");
  if (!common.threads.empty()) apply_setting(config, "threads=" + common.threads, "--threads");
}

}  // namespace

po::options_description common_options(CommonOptions& common) {
  po::options_description options("Common options");
  auto add = options.add_options();
  add("config,c", po::value(&common.config_file)->value_name("FILE"),
      "configuration: a YAML file, or a preset: fast, balanced or accurate");
  add("set", po::value(&common.settings)->composing()->value_name("KEY=VALUE"),
      "set one parameter; see 'walktrack config'");
  add("output,o", po::value(&common.output)->value_name("PATH"), "folder or file for the results");
  add("seed", po::value(&common.seed)->value_name("N"), "seed of all random numbers");
  add("threads", po::value(&common.threads)->value_name("N"),
      "threads, 0 = all that the process may use");
  add("yes,y", po::bool_switch(&common.overwrite),
      "overwrite a complete result, but no file that walktrack did not write");
  add("progress", po::value(&common.progress)->value_name("HOW"),
      "auto: a bar on a terminal, otherwise a line every half minute; json: progress, messages and "
      "errors as lines of JSON on stderr; none: no progress");
  add("quiet", po::bool_switch(&common.quiet), "print errors only");
  add("verbose", po::bool_switch(&common.verbose), "print more messages");
  add("help,h", "this text");
  return options;
}

CommandLine::CommandLine(CommandHelp help)
    : help_(std::move(help)), own_("Options of " + help_.name) {}

void CommandLine::operand(const std::string& name, std::string* value, bool optional) {
  operands_.push_back({name, value, optional});
}

void CommandLine::operands(const std::string& name, std::vector<std::string>* values) {
  rest_name_ = name;
  rest_ = values;
}

void CommandLine::print_help() const {
  CommonOptions unused;
  fmt::print("usage: walktrack {} {}{}[OPTIONS]\n\n{}\n\n", help_.name, help_.operands,
             help_.operands.empty() ? "" : " ", help_.about);
  if (!own_.options().empty()) fmt::print("{}\n", fmt::to_string(fmt::streamed(own_)));
  const std::string demo = installed_demo();
  fmt::print("{}\nExample:\n  {}\n", fmt::to_string(fmt::streamed(common_options(unused))),
             demo.empty() ? help_.example : example_with(help_.example, demo));
}

// The requests of manual.h.
bool CommandLine::explain(const Arguments& arguments) const {
  if (arguments == Arguments{kManualRequest}) {
    fmt::print("{}", manual_section(help_, own_));
  } else if (arguments == Arguments{kWordsRequest}) {
    CommonOptions unused;
    fmt::print("{}{}", option_words(own_), option_words(common_options(unused)));
  } else {
    return false;
  }
  return true;
}

bool CommandLine::parse(const Arguments& arguments) {
  if (explain(arguments)) return false;
  po::options_description known;
  known.add(own_).add(common_options(common_));
  const po::variables_map values = parse_words(arguments, known);
  if (values.count("help") > 0) {
    print_help();
    return false;
  }
  for (const auto& [name, value] : values)
    if (!value.defaulted()) given_.insert(name);
  if (common_.quiet && common_.verbose)
    throw UsageError("--quiet and --verbose exclude each other");
  const std::string& progress = common_.progress;
  if (progress != "auto" && progress != "json" && progress != "none")
    throw UsageError(describe({"", 0, "--progress"}, progress, "auto, json or none"));
  if (common_.quiet && progress == "json")
    throw UsageError("--quiet and --progress json exclude each other");
  take_operands(values.count(kWords) > 0 ? values[kWords].as<std::vector<std::string>>()
                                         : std::vector<std::string>{});
  return true;
}

void CommandLine::take_operands(const std::vector<std::string>& words) {
  size_t next = 0;
  for (const Operand& operand : operands_) {
    if (next < words.size()) {
      *operand.value = words[next++];
    } else if (!operand.optional) {
      throw UsageError(
          fmt::format("{} is missing; see 'walktrack {} --help'", operand.name, help_.name));
    }
  }
  if (rest_) {
    rest_->assign(words.begin() + static_cast<std::ptrdiff_t>(next), words.end());
    if (rest_->empty()) {
      throw UsageError(
          fmt::format("{} is missing; see 'walktrack {} --help'", rest_name_, help_.name));
    }
  } else if (next < words.size()) {
    throw UsageError(fmt::format("unexpected word '{}'", words[next]));
  }
}

ConfigWithOrigin CommandLine::config() const {
  ConfigWithOrigin config;
  if (!common_.config_file.empty()) apply_config_file(config, common_.config_file);
  for (const std::string& setting : common_.settings) apply_setting(config, setting, "--set");
  apply_run_options(common_, config);
  Terminal terminal(common_);
  for (const std::string& note : config.renamed) terminal.control().say(note);
  return config;
}

ConfigWithOrigin CommandLine::config_of_run() const {
  ConfigWithOrigin config;
  apply_run_options(common_, config);
  return config;
}

std::optional<double> CommandLine::within(const std::string& option, double value, double low,
                                          double high) const {
  if (!given(option)) return std::nullopt;
  if (!(value >= low && value <= high))
    throw UsageError(
        fmt::format("--{}: found {:g}, allowed: {:g} to {:g}", option, value, low, high));
  return value;
}

void CommandLine::refuse(const std::vector<std::string>& options,
                         const std::string& allowed) const {
  for (const std::string& option : options)
    if (given(option))
      throw UsageError(
          describe({"", 0, "--" + option}, "an option that has no effect here", allowed));
}

std::string CommandLine::required_output() const {
  if (common_.output.empty()) {
    throw UsageError(fmt::format("--output is missing; see 'walktrack {} --help'", help_.name));
  }
  return common_.output;
}

void CommandLine::write_or_print(const std::string& text,
                                 const std::vector<std::filesystem::path>& inputs) const {
  if (common_.output.empty()) {
    fmt::print("{}", text);
  } else {
    refuse_existing(common_.output, common_.overwrite);
    refuse_input(common_.output, inputs);
    refuse_input(common_.output, {common_.config_file});
    write_file_atomically(common_.output, text);
  }
}

}  // namespace walktrack
