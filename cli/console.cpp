// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "console.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "flag_names.h"
#include "terminal.h"

namespace gigaray::cli {
namespace {

constexpr int kBarWidth = 24;
constexpr auto kRedraw = std::chrono::milliseconds(100);

// Programs that pass Ctrl-C on send it to the process and to its group: that is one wish.
constexpr long kSameWishMs = 500;

std::atomic<RunControl*> running{nullptr};
volatile sig_atomic_t first = 0;  ///< the first signal
timespec first_signal = {};

extern "C" void on_signal(int signal, siginfo_t* info, void*) {
  // The system sends it in the name of the process itself when a pipe is closed; the write fails
  // too.
  if (signal == SIGPIPE && info->si_pid == getpid()) return;
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (first == 0) {
    first = signal;
    first_signal = now;
    if (RunControl* control = running.load()) control->cancel();
    return;
  }
  const long elapsed_ms =
      (now.tv_sec - first_signal.tv_sec) * 1000 + (now.tv_nsec - first_signal.tv_nsec) / 1000000;
  if (elapsed_ms < kSameWishMs) return;
  // The default action ends the program as soon as this handler returns.
  ::signal(signal, SIG_DFL);
  raise(signal);
}

void install_handlers() {
  ::signal(SIGXFSZ, SIG_IGN);
  struct sigaction action = {}, present = {};
  action.sa_sigaction = on_signal;
  action.sa_flags = SA_RESTART | SA_SIGINFO;  // files being written are not disturbed
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXCPU}) {
    sigaction(signal, nullptr, &present);
    if (signal != SIGHUP || present.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

int terminal_width() {
  winsize size = {};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string duration(double seconds) {
  const long whole = std::lround(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole % 3600 / 60);
}

}  // namespace

Console::Console(RunControl& control) : is_terminal_(isatty(STDERR_FILENO) != 0) {
  GIGARAY_CHECK(running.exchange(&control) == nullptr);
  control.on_progress = [this](const std::string& stage, double done, double total) {
    show_progress(stage, done, total);
  };
  control.on_message = [this](const std::string& text) { show_message(with_flags(text)); };
  install_handlers();
}

int Console::signal_received() { return first; }

Console::~Console() {
  running = nullptr;
  clear_bar();
}

void Console::show_progress(const std::string& stage, double done, double total) {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  if (stage != stage_) {
    stage_ = stage;
    stage_start_ = now;
    if (!is_terminal_) to_stderr(stage + "\n");
  } else if (done < total && now - last_drawn_ < kRedraw) {
    return;
  }
  if (!is_terminal_) return;
  if (done >= total) {  // what comes next, on stdout perhaps, gets a clean line
    clear_bar();
    return;
  }
  last_drawn_ = now;

  const double share = total > 0 ? std::clamp(done / total, 0.0, 1.0) : 0.0;
  const double seconds = std::chrono::duration<double>(now - stage_start_).count();
  const int filled = int(std::lround(share * kBarWidth));
  std::string line = fmt::format("{}  [{:#<{}}{:<{}}] {:3.0f} %", stage, "", filled, "",
                                 kBarWidth - filled, 100 * share);
  if (seconds > 0.5 && share > 0)
    line +=
        fmt::format("  {:.3g}/s  {} left", done / seconds, duration(seconds * (1 - share) / share));
  line.resize(std::min(line.size(), std::size_t(std::max(terminal_width() - 1, 1))));
  to_stderr("\r" + line + "\x1b[K");
  bar_visible_ = true;
}

void Console::show_message(const std::string& text) {
  const std::lock_guard lock(mutex_);
  clear_bar();
  to_stderr(with_flags(text) + "\n");
}

void Console::clear_bar() {
  if (bar_visible_) to_stderr("\r\x1b[K");
  bar_visible_ = false;
}

}  // namespace gigaray::cli
