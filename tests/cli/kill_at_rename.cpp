// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Preloaded into the program: kills it, by a SIGKILL that nothing can catch, just before or just
// after the N-th call that gives a file a name. GIGARAY_KILL_AT=N, or N+ for after it.
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>

namespace {

std::atomic<int> calls{0};

template <class Call>
int at_call(Call call) {
  const char* at = std::getenv("GIGARAY_KILL_AT");
  char* end = nullptr;
  const bool is_it = at && ++calls == std::strtol(at, &end, 10);
  if (is_it && *end != '+') kill(getpid(), SIGKILL);
  const int result = call();
  if (is_it) kill(getpid(), SIGKILL);
  return result;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int rename(const char* from, const char* to) {
  return at_call([&] { return real<int(const char*, const char*)>("rename")(from, to); });
}

extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to,
                         unsigned flags) {
  return at_call([&] {
    return real<int(int, const char*, int, const char*, unsigned)>("renameat2")(
        from_folder, from, to_folder, to, flags);
  });
}

extern "C" int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  return at_call([&] {
    return real<int(int, const char*, int, const char*, int)>("linkat")(from_folder, from,
                                                                        to_folder, to, flags);
  });
}
