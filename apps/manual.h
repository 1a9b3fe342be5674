// The manual page and the words that a shell can complete, made of the same declarations as --help:
// a command that is asked for --help-man or --help-words prints its part and ends.
#pragma once

#include <span>
#include <string>

#include <boost/program_options.hpp>

#include "command.h"

namespace walktrack {

inline constexpr const char* kManualRequest = "--help-man";
inline constexpr const char* kWordsRequest = "--help-words";

// What the overview and the manual say about every command's end.
inline constexpr const char* kExitCodes =
    "Exit codes: 0 done, 1 failed, 2 usage or configuration, 3 input unreadable,\n"
    "            4 done but a quality check failed, or the walker fell or diverged,\n"
    "            130 interrupted\n";

// The example of a command with the demo where it is for whoever reads it: in `demo`, which stands
// for data/demo of the source tree.
std::string example_with(std::string example, const std::string& demo);
// The demo of an installed program, "" of one that was not installed.
std::string installed_demo();

// The whole page in man(7), all commands' parts included.
void print_manual(std::span<const Command> commands);

// One command's part of it.
std::string manual_section(const CommandHelp& help,
                           const boost::program_options::options_description& own);
// Options as a .TP list.
std::string manual_options(const boost::program_options::options_description& options);

// Options of a command, one a line, those that take a value ending in "=".
std::string option_words(const boost::program_options::options_description& options);

}  // namespace walktrack
