#include "manual.h"

#include <filesystem>

#include <fmt/format.h>

#include "core/version.h"

namespace walktrack {

namespace po = boost::program_options;

namespace {

constexpr const char* kSystemDemo = "/usr/share/walktrack/demo";

// Text in roff: hyphens that can be copied, and no line that is taken for a request.
std::string roff(std::string_view text) {
  std::string safe;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) safe += "\\&";
    if (c == '\\') {
      safe += "\\e";
    } else if (c == '-') {
      safe += "\\-";
    } else {
      safe += c;
    }
    line_start = c == '\n';
  }
  return safe;
}

// The names of an option in bold: "-o, --output PATH".
std::string option_heading(const po::option_description& option) {
  std::string names = option.format_name();  // "-o [ --output ]" or "--set"
  std::string heading;
  for (const char c : names) {
    if (c == '[') heading += ", ";
    if (c != ' ' && c != '[' && c != ']') heading += c;
  }
  const std::string parameter = option.format_parameter();
  return fmt::format("\\fB{}\\fR{}", roff(heading),
                     parameter.empty() ? "" : " \\fI" + roff(parameter) + "\\fR");
}

void print_beginning() {
  const std::string_view version = build_facts().version;
  fmt::print(".TH WALKTRACK 1 \"\" \"walktrack {}\" \"User Commands\"\n", version);
  fmt::print(
      ".SH NAME\nwalktrack \\- tracks a walking person in calibrated video with a physical gait "
      "model\n.SH SYNOPSIS\n.B walktrack\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH "
      "DESCRIPTION\nwalktrack follows one walking person through the videos of one or more "
      "calibrated cameras\nwith a particle filter whose motion model is a simulated walker. It "
      "writes joints, angles,\ngait and forces with their uncertainty, overlay videos and a "
      "report.\n.SH COMMANDS\n");
}

void print_end() {
  fmt::print(".SH EXIT STATUS\n.nf\n{}.fi\n", roff(kExitCodes));
  fmt::print(
      ".SH ENVIRONMENT\n.TP\n.B NO_COLOR\nIf set and not empty, progress is shown without colour.\n"
      ".SH FILES\n.TP\n.I /usr/share/walktrack/demo\nA synthetic walk with its truth.\n"
      ".TP\n.I /usr/share/walktrack/configs\nPresets of the configuration and models of walkers.\n"
      ".TP\n.I /usr/share/doc/walktrack\nThe guide.\n"
      ".SH EXAMPLE\n.nf\nwalktrack check /usr/share/walktrack/demo/scene.yaml\n"
      "walktrack track /usr/share/walktrack/demo/scene.yaml \\-o demo\n.fi\n");
}

}  // namespace

void print_manual(std::span<const Command> commands) {
  print_beginning();
  for (const Command& command : commands) command.run({kManualRequest});
  CommonOptions unused;
  fmt::print(".SH COMMON OPTIONS\n{}", manual_options(common_options(unused)));
  print_end();
}

std::string manual_section(const CommandHelp& help, const po::options_description& own) {
  return fmt::format(".SS walktrack {}{}{}\n{}\n{}.PP\nExample:\n.PP\n.RS\n.nf\n{}\n.fi\n.RE\n",
                     help.name, help.operands.empty() ? "" : " ", roff(help.operands),
                     roff(help.about), manual_options(own),
                     roff(example_with(help.example, kSystemDemo)));
}

std::string example_with(std::string example, const std::string& demo) {
  constexpr std::string_view kSources = "data/demo", kAllSources = "batch data ";
  for (size_t at = 0; (at = example.find(kSources, at)) != std::string::npos; at += demo.size())
    example.replace(at, kSources.size(), demo);
  if (const size_t at = example.find(kAllSources); at != std::string::npos)
    example.replace(at, kAllSources.size(), fmt::format("batch {} ", demo));
  return example;
}

std::string installed_demo() {
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const auto demo = program.parent_path().parent_path() / "share/walktrack/demo";
  return std::filesystem::is_directory(demo, ignored) ? demo.string() : "";
}

std::string manual_options(const po::options_description& options) {
  std::string text;
  for (const auto& option : options.options())
    text += fmt::format(".TP\n{}\n{}\n", option_heading(*option), roff(option->description()));
  return text;
}

std::string option_words(const po::options_description& options) {
  std::string words;
  for (const auto& option : options.options()) {
    const bool takes_value = option->semantic()->max_tokens() > 0;
    words += fmt::format("--{}{}\n", option->long_name(), takes_value ? "=" : "");
  }
  return words;
}

}  // namespace walktrack
