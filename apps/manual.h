// The manual page and the words for completion in shells, from the same declarations as --help: a
// command with --help-man or --help-words prints its part and exits.
#pragma once

#include <span>
#include <string>

#include <boost/program_options.hpp>

#include "command.h"

namespace walktrack {

inline constexpr const char* kManualRequest = "--help-man";
inline constexpr const char* kWordsRequest = "--help-words";

// The description of exit codes in the overview and the manual.
inline constexpr const char* kExitCodes =
    "Exit codes: 0 done, 1 failed, 2 usage or configuration, 3 input unreadable,\n"
    "            4 done but a quality check failed, or the walker fell or diverged,\n"
    "            130 interrupted\n";

// The example of a command with data/demo of the source tree replaced by `demo`, the reader's
// folder with the demo.
std::string example_with(std::string example, const std::string& demo);
// The demo of an installed program; "" if it is not installed.
std::string installed_demo();

// Prints the whole page in man(7), including the parts of all commands.
void print_manual(std::span<const Command> commands);

// One command's part of it.
std::string manual_section(const CommandHelp& help,
                           const boost::program_options::options_description& own);
// Options as a .TP list.
std::string manual_options(const boost::program_options::options_description& options);

// Options of a command, one in each line; those with a value end in "=".
std::string option_words(const boost::program_options::options_description& options);

}  // namespace walktrack
