// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <thread>

#include "gigaray/error.h"

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

/// posix_spawn's two structures, released in any case.
struct SpawnSettings {
  SpawnSettings() {
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& settings) {
  const auto fail = [&](int error) {
    throw Error(ErrorCode::kIo, arguments.front() + ": can't be started (" +
                                    std::generic_category().message(error) + ")");
  };
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail(errno);
  output_ = ends[0];

  SpawnSettings spawn;
  posix_spawn_file_actions_addopen(&spawn.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&spawn.actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&spawn.actions, ends[1], STDERR_FILENO);
  // Ctrl-C goes to the foreground group alone: this one is stopped in an orderly way instead.
  posix_spawnattr_setpgroup(&spawn.attributes, 0);
  sigset_t none, usual;
  sigemptyset(&none);
  sigemptyset(&usual);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE}) sigaddset(&usual, signal);
  posix_spawnattr_setsigmask(&spawn.attributes, &none);
  posix_spawnattr_setsigdefault(&spawn.attributes, &usual);
  posix_spawnattr_setflags(&spawn.attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::vector<std::string> words = arguments, environment = environment_with(settings);
  const int error = posix_spawnp(&pid_, words.front().c_str(), &spawn.actions, &spawn.attributes,
                                 pointers(words).data(), pointers(environment).data());
  close(ends[1]);
  if (error != 0) {
    pid_ = -1;
    close_output();
    fail(error);
  }
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
  if (WIFSIGNALED(status)) return "was killed by signal " + std::to_string(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return "ended with status " + std::to_string(WEXITSTATUS(status));
  return "";
}

bool is_missing(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/bin:/usr/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return false;
  return true;
}

}  // namespace gigaray
