// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// The program gigaray: a table of commands, one of which is run.
#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "command.h"
#include "console.h"
#include "did_you_mean.h"
#include "flag_names.h"
#include "gigaray/version.h"
#include "terminal.h"
#include "threads_option.h"

namespace gigaray::cli {

#define GIGARAY_COMMAND(name) Run name##_command(CLI::App& app);
#include "commands.inc"
#undef GIGARAY_COMMAND

namespace {

enum ExitCode { kDone = 0, kFailed = 1, kWrongUsage = 2, kSignal = 128 };

struct Command {
  const char* name;
  Declare declare;
};

/// A heading of --help and the commands under it, all in the order of use.
struct Group {
  const char* heading;
  const char* commands;
};
constexpr Group kGroups[] = {
    {"Look first", " info devices "},
    {"Make depth", " rectify depth probe "},
    {"Use it", " cloud mesh segment render view "},
    {"Keep it in one file", " encode decode "},
    {"Measure it", " evaluate compare "},
    {"Try it without pictures", " synth "},
};

std::string heading_of(const std::string& command) {
  for (const Group& group : kGroups)
    if (std::string(group.commands).find(" " + command + " ") != std::string::npos)
      return group.heading;
  return "More";
}

constexpr Command kCommands[] = {
#define GIGARAY_COMMAND(name) {#name, name##_command},
#include "commands.inc"
#undef GIGARAY_COMMAND
};

// A message of a library may hold line breaks; what a failure prints is one line.
std::string one_line(std::string text) {
  for (char& letter : text)
    if (letter == '\n' || letter == '\r') letter = ' ';
  return text;
}

int exit_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidArgument:
      return kWrongUsage;
    case ErrorCode::kCancelled:
      return kSignal + (Console::signal_received() ? Console::signal_received() : SIGINT);
    default:
      return kFailed;
  }
}

int run(const std::string& command, const Run& what) {
  RunControl control;
  const Console console(control);
  const auto fail = [&](const std::string& message, int code) {
    to_stderr(fmt::format("gigaray {}: {}\n", command, one_line(with_flags(message))));
    return code;
  };
  const auto fail_to_print = [&](int error) {
    return fail(fmt::format("can't print to stdout ({}){}", std::generic_category().message(error),
                            control.has_kept() ? "; the output itself is in place" : ""),
                kFailed);
  };
  try {
    control.stop_or_fail([&] { what(control); });
    // A full disk or a closed pipe shows when the buffer is written at last.
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) return fail_to_print(errno);
  } catch (const Error& error) {
    return fail(with_flags(error.what()), exit_code(error.code()));
  } catch (const std::bad_alloc&) {
    return fail("out of memory; use a smaller input or a smaller --memory", kFailed);
  } catch (const std::exception& error) {
    if (std::ferror(stdout)) return fail_to_print(errno);
    return fail(error.what(), kFailed);
  }
  return kDone;
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Command& command : kCommands) names.push_back(command.name);
  return names;
}

bool is_command(const std::string& word) {
  return std::ranges::find(kCommands, word, &Command::name) != std::end(kCommands);
}

/// The arguments, with `help`, `help COMMAND`, `COMMAND help` and `--help COMMAND` as what they
/// mean.
std::vector<std::string> with_help(int argc, char** argv) {
  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  const auto is_help = [](const std::string& word) {
    return word == "help" || word == "--help" || word == "-h";
  };
  if (arguments.empty() || arguments.size() > 2) return arguments;
  std::error_code ignored;
  if (arguments.size() == 1) {
    if (is_help(arguments[0])) arguments[0] = "--help";
  } else if (is_help(arguments[0])) {
    arguments = {arguments[1], "--help"};
    if (is_help(arguments[0])) arguments = {"--help"};
  } else if (is_command(arguments[0]) && arguments[1] == "help" &&
             !std::filesystem::exists("help", ignored)) {
    arguments[1] = "--help";
  }
  return arguments;
}

int main(int argc, char** argv) {
  CLI::App program("Depth for every view of a light field", "gigaray");
  program.set_version_flag("--version", "gigaray " GIGARAY_VERSION);
  program.require_subcommand(1);
  program.footer(
      "gigaray COMMAND --help tells more. To begin with: gigaray info PICTURES, gigaray depth "
      "PICTURES -o OUT, gigaray info OUT.");

  std::string chosen;
  Run what;
  for (const Command& command : kCommands) {
    CLI::App& app = *program.add_subcommand(command.name);
    app.group(heading_of(command.name));
    const Run run_it = command.declare(app);
    add_threads_option(app);
    app.callback([&, run_it, name = command.name] {
      chosen = name;
      what = run_it;
    });
  }
  std::vector<std::string> arguments = with_help(argc, argv);
  if (!arguments.empty() && !arguments.front().starts_with('-') && !is_command(arguments.front())) {
    to_stderr(fmt::format("gigaray: there is no command '{}'{} (see gigaray --help)\n",
                          one_line(arguments.front()),
                          did_you_mean(arguments.front(), command_names())));
    return kWrongUsage;
  }
  if (arguments.empty()) {
    to_stderr("gigaray: say what to do, as in gigaray info PICTURES (see gigaray --help)\n");
    return kWrongUsage;
  }
  std::ranges::reverse(arguments);  // as CLI11 wants them
  try {
    program.parse(arguments);
  } catch (const CLI::Success& success) {  // --help, --version
    program.exit(success);
    return std::fflush(stdout) == 0 && std::cout.flush() ? kDone : kFailed;
  } catch (const CLI::ParseError& error) {
    std::string command = "gigaray", problem = about_unknown_option(program);
    for (const CLI::App* app : program.get_subcommands()) {
      command += " " + app->get_name();
      problem = about_unknown_option(*app);
    }
    if (problem.empty()) problem = error.what();
    to_stderr(fmt::format("{}: {} (see {} --help)\n", command, one_line(problem), command));
    return kWrongUsage;
  }
  limit_opencl_threads();
  return run(chosen, what);
}

}  // namespace
}  // namespace gigaray::cli

int main(int argc, char** argv) {
  gigaray::cli::secure_descriptors();
  return gigaray::cli::main(argc, argv);
}
