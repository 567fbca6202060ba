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
#include <iostream>
#include <iterator>
#include <new>
#include <string>
#include <system_error>

#include "command.h"
#include "console.h"
#include "terminal.h"

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
    to_stderr(fmt::format("gigaray {}: {}\n", command, one_line(message)));
    return code;
  };
  const auto fail_to_print = [&](int error) {
    return fail(fmt::format("can't print to stdout ({}){}", std::generic_category().message(error),
                            control.has_kept() ? "; the output itself is in place" : ""),
                kFailed);
  };
  try {
    what(control);
    // A full disk or a closed pipe shows when the buffer is written at last.
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) return fail_to_print(errno);
  } catch (const Error& error) {
    return fail(error.what(), exit_code(error.code()));
  } catch (const std::bad_alloc&) {
    return fail("out of memory; use a smaller input or a smaller --memory", kFailed);
  } catch (const std::exception& error) {
    if (std::ferror(stdout)) return fail_to_print(errno);
    return fail(error.what(), kFailed);
  }
  return kDone;
}

int main(int argc, char** argv) {
  CLI::App program("Depth for every view of a light field", "gigaray");
  program.set_version_flag("--version", "gigaray " GIGARAY_VERSION);
  program.require_subcommand(1);

  std::string chosen;
  Run what;
  for (const Command& command : kCommands) {
    CLI::App& app = *program.add_subcommand(command.name);
    const Run run_it = command.declare(app);
    app.callback([&, run_it, name = command.name] {
      chosen = name;
      what = run_it;
    });
  }
  const auto is_named = [&](const Command& command) {
    return argv[1] == std::string(command.name);
  };
  if (argc > 1 && argv[1][0] != '-' &&
      std::none_of(std::begin(kCommands), std::end(kCommands), is_named)) {
    to_stderr(fmt::format("gigaray: there is no command '{}' (see gigaray --help)\n", argv[1]));
    return kWrongUsage;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    program.exit(success);
    return std::fflush(stdout) == 0 && std::cout.flush() ? kDone : kFailed;
  } catch (const CLI::ParseError& error) {
    std::string command = "gigaray";
    for (const CLI::App* app : program.get_subcommands()) command += " " + app->get_name();
    to_stderr(fmt::format("{}: {} (see {} --help)\n", command, one_line(error.what()), command));
    return kWrongUsage;
  }
  return run(chosen, what);
}

}  // namespace
}  // namespace gigaray::cli

int main(int argc, char** argv) {
  gigaray::cli::secure_descriptors();
  return gigaray::cli::main(argc, argv);
}
