// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>

#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

std::vector<std::string> environment_with(const std::vector<std::string>& settings) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry; ++entry) all.emplace_back(*entry);
  for (const std::string& setting : settings) {
    const std::string name = setting.substr(0, setting.find('=') + 1);
    if (std::none_of(all.begin(), all.end(),
                     [&](const std::string& entry) { return entry.starts_with(name); }))
      all.push_back(setting);
  }
  return all;
}

/// The first executable file of this name on PATH; a name with a slash is one already. Empty: none.
std::string find_program(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/bin:/usr/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const std::string file = std::filesystem::path(folder) / name;
        access(file.c_str(), X_OK) == 0 && !std::filesystem::is_directory(file))
      return file;
  return {};
}

/// A pipe whose ends no program inherits.
struct Pipe {
  Pipe() { is_open = pipe2(ends, O_CLOEXEC) == 0; }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int release(int end) { return std::exchange(ends[end], -1); }

  int ends[2] = {-1, -1};
  bool is_open = false;
};

extern "C" void do_nothing(int) {}

// What follows runs between fork and exec, where only async-signal-safe calls are allowed.

void set_signal(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

struct Launch {
  const char* program;
  char* const* words;
  char* const* environment;
  int output;  ///< gets stdout and stderr
  int errors;  ///< gets errno when the program can't be started
  int alive;   ///< ends when the process that started all this does
};

[[noreturn]] void become_program(const Launch& launch) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGCHLD, SIGXCPU, SIGXFSZ})
    set_signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = open("/dev/null", O_RDONLY);
  const bool ready = dup2(nothing, STDIN_FILENO) >= 0 && dup2(launch.output, STDOUT_FILENO) >= 0 &&
                     dup2(launch.output, STDERR_FILENO) >= 0;
  if (ready) execve(launch.program, launch.words, launch.environment);
  const int error = errno;
  if (write(launch.errors, &error, sizeof error) < 0) _exit(126);
  _exit(127);
}

/// Leads the group of the program and ends as it does. When `alive` ends first, by a SIGKILL say,
/// the whole group is killed.
[[noreturn]] void lead_group(const Launch& launch) {
  setpgid(0, 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) set_signal(signal, SIG_IGN);
  set_signal(SIGCHLD, do_nothing);
  sigset_t child, others;
  sigemptyset(&child);
  sigaddset(&child, SIGCHLD);
  sigprocmask(SIG_BLOCK, &child, &others);
  sigdelset(&others, SIGCHLD);

  const pid_t program = fork();
  if (program == 0) become_program(launch);
  if (program < 0) {
    const int error = errno;
    _exit(write(launch.errors, &error, sizeof error) < 0 ? 126 : 127);
  }
  // Files of the starting process stay open, and locked, no longer than it wants.
  const int alive = dup2(launch.alive, STDIN_FILENO);
  close_range(STDOUT_FILENO, ~0U, 0);
  for (int status = 0;;) {
    if (waitpid(program, &status, WNOHANG) == program) {
      if (WIFSIGNALED(status)) {
        set_signal(WTERMSIG(status), SIG_DFL);
        kill(getpid(), WTERMSIG(status));
      }
      _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 128);
    }
    pollfd starter{alive, POLLIN, 0};
    if (ppoll(&starter, 1, nullptr, &others) > 0) kill(0, SIGKILL);
  }
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& settings) {
  require_argument(!arguments.empty(), "arguments: the program is not named");
  const auto fail = [&](int error) {
    throw Error(ErrorCode::kIo, arguments.front() + ": can't be started (" +
                                    std::generic_category().message(error) + ")");
  };
  const std::string program = find_program(arguments.front());
  if (program.empty()) fail(ENOENT);
  Pipe output, errors, alive;
  if (!output.is_open || !errors.is_open || !alive.is_open) fail(errno);
  std::vector<std::string> words = arguments, environment = environment_with(settings);
  const std::vector<char*> word_list = pointers(words), environment_list = pointers(environment);
  const Launch launch{program.c_str(), word_list.data(), environment_list.data(),
                      output.ends[1],  errors.ends[1],   alive.ends[0]};
  // Ctrl-C goes to the foreground group alone: this one is stopped in an orderly way instead.
  pid_ = fork();
  if (pid_ == 0) {
    close(alive.ends[1]);  // the other end is the starting process's alone
    lead_group(launch);
  }
  if (pid_ < 0) fail(errno);
  setpgid(pid_, pid_);  // whichever of the two is first
  close(errors.release(1));
  int error = 0;
  ssize_t count = 0;
  while ((count = ::read(errors.ends[0], &error, sizeof error)) < 0 && errno == EINTR) continue;
  if (count > 0) {
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
    fail(error);
  }
  output_ = output.release(0);
  alive_ = alive.release(1);
}

ChildProcess::~ChildProcess() {
  close_output();
  if (pid_ < 0) return;
  constexpr int kTries = 40;
  constexpr std::chrono::milliseconds kPause{50};
  kill(-pid_, SIGTERM);
  bool ended = false;
  for (int i = 0; i < kTries && !ended; ++i) {
    ended = waitpid(pid_, nullptr, WNOHANG) == pid_;
    if (!ended) std::this_thread::sleep_for(kPause);
  }
  kill(-pid_, SIGKILL);  // what is left of its group, too
  if (!ended) waitpid(pid_, nullptr, 0);
  close(alive_);
}

void ChildProcess::close_output() {
  if (output_ >= 0) close(output_);
  output_ = -1;
}

std::optional<std::string> ChildProcess::read(std::chrono::milliseconds wait) {
  pollfd output{output_, POLLIN, 0};
  if (poll(&output, 1, int(wait.count())) <= 0) return "";
  char bytes[4096];
  const ssize_t count = ::read(output_, bytes, sizeof bytes);
  if (count > 0) return std::string(bytes, std::size_t(count));
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return "";
  return std::nullopt;
}

std::string ChildProcess::result() {
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) continue;
  pid_ = -1;
  close(std::exchange(alive_, -1));
  if (WIFSIGNALED(status)) return "was killed by signal " + std::to_string(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return "ended with status " + std::to_string(WEXITSTATUS(status));
  return "";
}

bool is_missing(const std::string& program) { return find_program(program).empty(); }

}  // namespace gigaray
