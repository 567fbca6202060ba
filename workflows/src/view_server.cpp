// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/view_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "gigaray/core/error.h"
#include "gigaray/workflows/view_list.h"
#include "page_template.h"

namespace gigaray {
namespace {

using nlohmann::ordered_json;

constexpr const char* kHost = "127.0.0.1";

const char* type_of(const std::string& name) {
  if (name.ends_with(".jpg")) return "image/jpeg";
  if (name.ends_with(".glb")) return "model/gltf-binary";
  return "application/octet-stream";
}

ordered_json number(float value) {
  return std::isnan(value) ? ordered_json(nullptr) : ordered_json(value);
}

ordered_json json_of(const ScoreCurve& curve, const LightField& light_field) {
  ordered_json scores = ordered_json::array(), samples = ordered_json::array();
  for (const float score : curve.scores)
    scores.push_back(score < 0 ? ordered_json(nullptr) : ordered_json(score));
  for (int i = 0; i < light_field.num_views(); ++i) {
    const Radiance& seen = curve.samples[std::size_t(i)];
    samples.push_back({{"view", light_field.views[std::size_t(i)].name},
                       {"rgb", std::isnan(seen.r) ? ordered_json(nullptr)
                                                  : ordered_json{seen.r, seen.g, seen.b}}});
  }
  return {{"hypotheses",
           {{"min", curve.hypotheses.min},
            {"max", curve.hypotheses.max},
            {"count", curve.hypotheses.count}}},
          {"scores", scores},
          {"disparity", number(curve.disparity)},
          {"confidence", number(curve.confidence)},
          {"samples", samples}};
}

/// A pixel of a request, px.
int pixel_of(const httplib::Request& request, const char* name) {
  const std::string text = request.get_param_value(name);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw Error(ErrorCode::kInvalidArgument, fmt::format("{}: must be a whole number of px", name));
  return value;
}

}  // namespace

struct ViewServer::State {
  httplib::Server server;
  std::map<std::string, std::string> files;  ///< by path, "/data/view_0000.jpg"
  CurveSource probes;
  std::optional<Estimator> estimator;  ///< from the first probe on
  std::mutex probing;                  ///< one at a time: a probe takes all cores
  RunControl control;                  ///< of probes
  int port = 0;

  void probe(const httplib::Request& request, httplib::Response& response);
  bool is_asked_here(const httplib::Request& request) const {
    const std::string host = request.get_header_value("Host");
    return host == fmt::format("{}:{}", kHost, port) || host == fmt::format("localhost:{}", port);
  }
};

void ViewServer::State::probe(const httplib::Request& request, httplib::Response& response) {
  ordered_json answer;
  try {
    const LightField& light_field = probes.light_field;
    const int view = parse_view(request.get_param_value("view"), light_field);
    const int u = pixel_of(request, "u"), v = pixel_of(request, "v");
    const std::scoped_lock lock(probing);
    if (!estimator) estimator.emplace(Estimator::of(probes.backend));
    answer =
        json_of(estimator->probe(light_field, probes.options, view, u, v, control), light_field);
  } catch (const Error& error) {
    response.status = error.code() == ErrorCode::kInvalidArgument ? 400 : 500;
    answer = {{"error", error.what()}};
  }
  response.set_content(answer.dump(-1, ' ', false, ordered_json::error_handler_t::replace),
                       "application/json");
}

ViewServer::ViewServer(const std::string& title, const MakeScene& make_scene, CurveSource probes,
                       int port)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.probes = std::move(probes);
  state.port = port;
  // Not its default, with which a second server would take the same port.
  state.server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const bool is_bound = port > 0 ? state.server.bind_to_port(kHost, port)
                                 : (state.port = state.server.bind_to_any_port(kHost)) > 0;
  if (!is_bound)
    throw Error(ErrorCode::kIo, port > 0 ? fmt::format("port {} of {} can't be had", port, kHost)
                                         : fmt::format("no port of {} can be had", kHost));
  state.files["/"] = page_with(title, "");
  state.files["/scene.json"] = make_scene([&](const std::string& name, std::string bytes) {
    state.files["/data/" + name] = std::move(bytes);
  });
  state.server.set_pre_routing_handler(
      [&state](const httplib::Request& request, httplib::Response& response) {
        // A page elsewhere whose name leads here may not read the scene.
        if (state.is_asked_here(request)) return httplib::Server::HandlerResponse::Unhandled;
        response.status = 403;
        return httplib::Server::HandlerResponse::Handled;
      });
  state.server.Get("/probe",
                   [&state](const httplib::Request& request, httplib::Response& response) {
                     state.probe(request, response);
                   });
  state.server.Get(".*", [&state](const httplib::Request& request, httplib::Response& response) {
    const auto file = state.files.find(request.path == "/index.html" ? "/" : request.path);
    if (file == state.files.end()) {
      response.status = 404;
      return;
    }
    const char* type = request.path == "/scene.json" ? "application/json"
                       : file->first == "/"          ? "text/html; charset=utf-8"
                                                     : type_of(file->first);
    response.set_content(file->second, type);
  });
}

ViewServer::~ViewServer() = default;

int ViewServer::port() const { return state_->port; }

std::string ViewServer::address() const { return fmt::format("http://{}:{}/", kHost, port()); }

void ViewServer::run(const RunControl& control) {
  State& state = *state_;
  std::thread watch([&] {
    while (!control.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    state.control.cancel();
    state.server.stop();
  });
  state.server.listen_after_bind();
  watch.join();
}

}  // namespace gigaray
