// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/view_server.h"

#include <httplib.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "gigaray/workflows/depth.h"
#include "workflows_test.h"

namespace gigaray {
namespace {

/// A server over the grid of the fixture, running until the test ends.
class ViewServerTest : public WorkflowsTest {
 protected:
  void SetUp() override {
    ASSERT_TRUE(has_view_page()) << "nodejs and npm build it";
    input = open_input({.path = grid()}, control);
    CurveSource probes{input.light_field, prepare_depth(input, {}, control)};
    server = std::make_unique<ViewServer>(
        "grid",
        [&](const TakeSceneFile& take) {
          return view_scene(input.light_field, "grid", {.is_live = true}, take, control);
        },
        std::move(probes), 0);
    running = std::thread([&] { server->run(stop); });
  }
  void TearDown() override {
    stop.cancel();
    if (running.joinable()) running.join();
  }
  httplib::Result get(const std::string& path) {
    return httplib::Client("127.0.0.1", server->port()).Get(path);
  }

  OpenedInput input;
  RunControl stop;
  std::unique_ptr<ViewServer> server;
  std::thread running;
};

TEST_F(ViewServerTest, ServesThePageItsSceneAndItsFiles) {
  const auto page = get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_NE(page->body.find("<title>grid"), std::string::npos);
  const auto scene = get("/scene.json");
  ASSERT_TRUE(scene);
  const auto json = nlohmann::json::parse(scene->body);
  EXPECT_EQ(json["live"], true);
  const auto picture = get("/data/" + json["views"][0]["image"].get<std::string>());
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->get_header_value("Content-Type"), "image/jpeg");
  EXPECT_EQ(picture->body.substr(0, 2), "\xff\xd8");
}

TEST_F(ViewServerTest, AnswersProbes) {
  const auto answer = get("/probe?view=" + input.light_field.views[4].name + "&u=46&v=31");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  const auto json = nlohmann::json::parse(answer->body);
  EXPECT_EQ(json["scores"].size(), json["hypotheses"]["count"].get<std::size_t>());
  EXPECT_EQ(json["samples"].size(), 9u);
  const auto wrong = get("/probe?view=nobody&u=1&v=1");
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->status, 400);
  EXPECT_NE(nlohmann::json::parse(wrong->body)["error"].get<std::string>().find("nobody"),
            std::string::npos);
  EXPECT_EQ(get("/probe?view=0&u=93&v=0")->status, 400);
  EXPECT_EQ(get("/probe?view=0&u=x&v=0")->status, 400);
}

TEST_F(ViewServerTest, RefusesWhatIsNotOfTheScene) {
  for (const char* path : {"/data/../../../../etc/passwd", "/..%2f..%2fetc/passwd", "/etc/passwd",
                           "/data/", "/data/view_9999.jpg"})
    EXPECT_EQ(get(path)->status, 404) << path;
  httplib::Client elsewhere("127.0.0.1", server->port());
  elsewhere.set_default_headers({{"Host", "somewhere.example"}});
  EXPECT_EQ(elsewhere.Get("/scene.json")->status, 403);
}

TEST_F(ViewServerTest, OnlyLoopbackAnswers) {
  ifaddrs* all = nullptr;
  ASSERT_EQ(getifaddrs(&all), 0);
  for (const ifaddrs* one = all; one; one = one->ifa_next) {
    if (!one->ifa_addr || one->ifa_addr->sa_family != AF_INET) continue;
    char text[INET_ADDRSTRLEN] = {};
    inet_ntop(AF_INET, &reinterpret_cast<sockaddr_in*>(one->ifa_addr)->sin_addr, text, sizeof text);
    if (std::string(text).starts_with("127.")) continue;
    EXPECT_FALSE(httplib::Client(text, server->port()).Get("/")) << text;
  }
  freeifaddrs(all);
}

TEST_F(ViewServerTest, TwoViewersAreServedAtOnce) {
  httplib::Client first("127.0.0.1", server->port()), second("127.0.0.1", server->port());
  first.set_keep_alive(true);
  second.set_keep_alive(true);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(first.Get("/scene.json")->status, 200);
    EXPECT_EQ(second.Get("/scene.json")->status, 200);
  }
}

TEST_F(ViewServerTest, APortThatIsTakenIsNamed) {
  const auto none = [](const TakeSceneFile&) { return std::string("{}"); };
  EXPECT_NE(refusal(ErrorCode::kIo, [&] { ViewServer("twin", none, {}, server->port()); })
                .find(std::to_string(server->port())),
            std::string::npos);
}

}  // namespace
}  // namespace gigaray
