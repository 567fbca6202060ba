// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "adapters/light_field_files.h"

namespace gigaray {
namespace {

class MiddleburyStereo : public AdaptersTest {};

TEST_F(MiddleburyStereo, ThePairIsOneStepApart) {
  for (const auto& names : {std::vector<std::string>{"im2.png", "im6.png", "disp2.png"},
                            {"view1.png", "view5.png", "disp1.png", "disp5.png"}}) {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    for (const std::string& name : names) save(name);
    const LightField pair = open_light_field(folder);
    EXPECT_EQ(pair.format, "Middlebury stereo pair");
    ASSERT_EQ(pair.num_views(), 2);
    EXPECT_EQ(pair.views[0].name + ".png", names[0]);
    EXPECT_EQ(pair.views[0].s, -0.5);
    EXPECT_EQ(pair.views[1].s, 0.5);
    EXPECT_EQ(pair.kind, LightFieldKind::k3D);
    EXPECT_FALSE(pair.sign_is_assumed);
    EXPECT_EQ(centre_view(pair), 0);
    EXPECT_EQ(pair.declared_range, (DisparityRange{0, 4}));
    EXPECT_EQ(pair.notes.size(), 1u);
  }
}

TEST_F(MiddleburyStereo, OtherSeriesAreNone) {
  save("im2.png");
  save("im6.png");
  EXPECT_EQ(open_light_field(folder).format, "image sequence") << "without disparities";
  save("im3.png");
  save("disp2.png");
  EXPECT_EQ(open_light_field(folder).format, "image sequence") << "of a longer series";
}

TEST_F(MiddleburyStereo, TheDirectionIsStated) {
  for (const char* name : {"im2.png", "im6.png", "disp2.png"}) save(name);
  OpenOptions options;
  options.direction = Travel::kLeft;
  testing_support::expect_error(ErrorCode::kInvalidArgument, {"states"},
                                [&] { open_light_field(folder, options); });
}

}  // namespace
}  // namespace gigaray
