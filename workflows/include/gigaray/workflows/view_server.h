// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// `gigaray view` without a file: the page from a server on this machine, with live probes.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gigaray/core/api.h"
#include "gigaray/core/run_control.h"
#include "gigaray/engine/depth_options.h"
#include "gigaray/engine/estimator.h"
#include "gigaray/workflows/view_page.h"

namespace GIGARAY_API gigaray {

/// Serves a scene on 127.0.0.1 alone, from memory: its own files, and probes; everything else is
/// refused, and so is who asks for another host's name.
class ViewServer {
 public:
  /// port: 0: a free one. Throws Error(kIo) when the port can't be had, and what make_scene throws.
  ViewServer(const std::string& title, const MakeScene& make_scene, CurveSource probes, int port);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  int port() const;
  std::string address() const;  ///< "http://127.0.0.1:PORT/"
  /// Until `control` is cancelled, which is its end and no error.
  void run(const RunControl& control);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gigaray
