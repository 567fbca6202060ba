// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/option_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_error;

long entries_below(const std::string& prefix) {
  return std::ranges::count_if(depth_option_table(), [&](const DepthOption& option) {
    return std::string_view(option.name).starts_with(prefix);
  });
}

long entries_at_top() {
  return std::ranges::count_if(depth_option_table(), [](const DepthOption& option) {
    return std::string_view(option.name).find('.') == std::string_view::npos;
  });
}

/// A field that is added no longer fits these names, so that it does not compile: then it needs its
/// line in the table, and a name and the number here.
TEST(OptionTable, HasEveryField) {
  const DepthOptions options;
  {
    const auto& [a, b, c, d] = options.edge;
    EXPECT_EQ(entries_below("edge."), 4);
    (void)a, (void)b, (void)c, (void)d;
  }
  {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s] = options.score;
    EXPECT_EQ(entries_below("score."), 19);
    (void)a, (void)b, (void)c, (void)d, (void)e, (void)f, (void)g, (void)h, (void)i, (void)j;
    (void)k, (void)l, (void)m, (void)n, (void)o, (void)p, (void)q, (void)r, (void)s;
  }
  {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = options.support;
    EXPECT_EQ(entries_below("support."), 13);
    (void)a, (void)b, (void)c, (void)d, (void)e, (void)f, (void)g, (void)h, (void)i, (void)j;
    (void)k, (void)l, (void)m;
  }
  {
    const auto& [a, b, c, d, e, f, g, h, i, j] = options.winner;
    EXPECT_EQ(entries_below("winner."), 10);
    (void)a, (void)b, (void)c, (void)d, (void)e, (void)f, (void)g, (void)h, (void)i, (void)j;
  }
  {
    const auto& [a, b, c, d, e, f] = options.propagation;
    EXPECT_EQ(entries_below("propagation."), 6);
    (void)a, (void)b, (void)c, (void)d, (void)e, (void)f;
  }
  {
    const auto& [a, b, c, d, e, f, g, edge, score, support, winner, propagation, l, m, n, o, p] =
        options;
    constexpr int kStructs = 5;
    EXPECT_EQ(entries_at_top(), 17 - kStructs);
    (void)a, (void)b, (void)c, (void)d, (void)e, (void)f, (void)g, (void)l, (void)m, (void)n,
        (void)o;
    (void)p, (void)edge, (void)score, (void)support, (void)winner, (void)propagation;
  }
}

TEST(OptionTable, NamesAreUniqueAndMeaningsAreOneLine) {
  std::set<std::string> names;
  std::set<const void*> places;
  DepthOptions options;
  for (const DepthOption& option : depth_option_table()) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name;
    const void* place = std::visit(
        [&](auto access) { return static_cast<const void*>(&access(options)); }, option.field);
    EXPECT_TRUE(places.insert(place).second) << option.name << " is a field that is there already";
    EXPECT_EQ(find_depth_option(option.name), &option);
    const std::string meaning = option.meaning;
    EXPECT_FALSE(meaning.empty()) << option.name;
    EXPECT_EQ(meaning.find_first_of("\n|"), std::string::npos) << option.name;
    EXPECT_LE(option.bounds.least, option.bounds.most) << option.name;
  }
  EXPECT_EQ(find_depth_option("winner.radius"), nullptr);
}

/// Values of the right type that no field has by itself.
OptionValue another_value(const DepthOption& option, const DepthOptions& options) {
  switch (option.type()) {
    case OptionType::kBool:
      return !std::get<bool>(option.get(options));
    case OptionType::kInteger:
      return std::get<int>(option.get(options)) == 3 ? 4 : 3;
    case OptionType::kNumber:
      return std::get<double>(option.get(options)) == 0.4 ? 0.7 : 0.4;
    case OptionType::kRange:
      return std::vector<double>{-1.1, 0.3};
    case OptionType::kIndices:
      return std::vector<int>{4, 0, 7};
    case OptionType::kText:
      return std::string("elsewhere, 1");
  }
  return {};
}

TEST(OptionTable, AValueThatIsSetIsTheOneThatIsRead) {
  for (const DepthOption& option : depth_option_table()) {
    DepthOptions options = auto_options();
    const OptionValue value = another_value(option, options);
    ASSERT_NE(option.get(options), value) << option.name;
    option.set(options, value);
    EXPECT_EQ(option.get(options), value) << option.name;
    DepthOptions by_words = auto_options();
    option.set(by_words, to_text(value));
    EXPECT_EQ(option.get(by_words), value) << option.name;
    // And nothing else.
    std::vector<NamedValue> expected = option_values(auto_options());
    for (NamedValue& each : expected)
      if (each.name == option.name) each.value = value;
    EXPECT_EQ(option_values(options), expected) << option.name;
  }
}

TEST(OptionTable, AllValuesGiveTheSameOptionsToTheBit) {
  DepthOptions options = auto_options();
  options.score.bandwidth = std::nextafter(0.02f, 1.0f);
  options.support.sigma_space = 1.0f / 3;
  options.hypothesis_step = 0.1 + 0.2;
  options.disparity = DisparityRange{-1.0 / 3, 0.1 + 0.2};
  options.winner.min_confidence = -std::numeric_limits<float>::infinity();
  options.views = {3, 1};
  DepthOptions again = paper_options();
  for (const NamedValue& value : option_values(options)) set_option(again, value.name, value.value);
  EXPECT_EQ(option_values(again), option_values(options));
  EXPECT_EQ(again.score.bandwidth, options.score.bandwidth);
  EXPECT_EQ(again.support.sigma_space, options.support.sigma_space);
  EXPECT_EQ(again.hypothesis_step, options.hypothesis_step);
  EXPECT_EQ(again.disparity, options.disparity);
  EXPECT_EQ(again.winner.min_confidence, options.winner.min_confidence);
  EXPECT_EQ(again.views, options.views);
}

TEST(OptionTable, FloatsReadAsTheyWereMeant) {
  EXPECT_EQ(to_text(find_depth_option("winner.min_relief")->get(auto_options())), "0.05");
}

TEST(OptionTable, WordsAreReadAsWhatTheyHold) {
  DepthOptions options = auto_options();
  set_option(options, "winner.median_radius", "3");
  EXPECT_EQ(options.winner.median_radius, 3);
  set_option(options, "winner.median_radius", 4.0);
  EXPECT_EQ(options.winner.median_radius, 4);
  set_option(options, "score.smoothing", 1);
  EXPECT_EQ(options.score.smoothing, 1);
  set_option(options, "score.cubic", "off");
  EXPECT_FALSE(options.score.cubic);
  set_option(options, "disparity", "-1.5, 2");
  EXPECT_EQ(options.disparity, (DisparityRange{-1.5, 2}));
  set_option(options, "disparity", std::vector<int>{-1, 2});
  EXPECT_EQ(options.disparity, (DisparityRange{-1, 2}));
  set_option(options, "disparity", "none");
  EXPECT_FALSE(options.disparity);
  set_option(options, "views", "4,0 7");
  EXPECT_EQ(options.views, (std::vector<int>{4, 0, 7}));
  set_option(options, "views", OptionValue());
  EXPECT_TRUE(options.views.empty());
  set_option(options, "work_folder", "3");
  EXPECT_EQ(options.work_folder, "3");
  set_option(options, "hypotheses", 0);
  EXPECT_EQ(options.hypotheses, 0);
}

TEST(OptionTable, AValueThatCannotBeMeantIsNamedAndChangesNothing) {
  struct Wrong {
    const char* name;
    OptionValue value;
    const char* words;
  };
  const Wrong wrongs[] = {
      {"winner.median_radus", 3, "winner.median_radus"},
      {"", 3, "no option"},
      {"winner.median_radius", 9, "between 0 and 8"},
      {"winner.median_radius", 3.5, "whole number"},
      {"winner.median_radius", 1e30, "whole number"},
      {"winner.median_radius", true, "whole number"},
      {"winner.median_radius", "three", "three"},
      {"winner.median_radius", "3 4", "3 4"},
      {"winner.median_radius", "", "whole number"},
      {"winner.median_radius", OptionValue(), "none"},
      {"hypotheses", 1, "between 2 and 4096"},
      {"score.bandwidth", "nan", "score.bandwidth is nan"},
      {"score.bandwidth", std::vector<double>{0.1}, "a number"},
      {"edge.threshold", std::nan(""), "not a number"},
      {"score.cubic", 1, "true or false"},
      {"score.cubic", "perhaps", "perhaps"},
      {"disparity", "1", "two numbers"},
      {"disparity", std::vector<double>{2, 1}, "disparity range 2 1"},
      {"disparity", "0 inf", "not finite"},
      {"views", "0,1.5", "whole numbers"},
      {"views", "-1", "view -1"},
      {"work_folder", 3, "a text"},
      {"memory_bytes", -1, "negative"},
  };
  DepthOptions options = auto_options();
  const std::vector<NamedValue> before = option_values(options);
  for (const Wrong& wrong : wrongs)
    expect_error(ErrorCode::kInvalidArgument, {wrong.words},
                 [&] { set_option(options, wrong.name, wrong.value); });
  EXPECT_EQ(option_values(options), before);
}

TEST(OptionTable, EveryBoundIsHeldByTheCheck) {
  const auto refused = [](const DepthOption& option, double value) {
    DepthOptions options;
    std::visit(
        [&](auto access) {
          auto& field = access(options);
          if constexpr (std::is_arithmetic_v<std::decay_t<decltype(field)>>)
            field = std::decay_t<decltype(field)>(value);
        },
        option.field);
    expect_error(ErrorCode::kInvalidArgument, {option.name}, [&] { options.check(); });
  };
  int held = 0;
  for (const DepthOption& option : depth_option_table()) {
    if (option.type() != OptionType::kInteger && option.type() != OptionType::kNumber) continue;
    if (std::isfinite(option.bounds.least)) refused(option, option.bounds.least - 1), ++held;
    if (std::isfinite(option.bounds.most)) refused(option, option.bounds.most + 1), ++held;
    if (option.type() == OptionType::kNumber) refused(option, std::nan(""));
  }
  EXPECT_GT(held, 50);
}

/// The page is made from the table: gigaray depth --list-options > docs/options.md
TEST(OptionTable, TheReferencePageIsEqualToIt) {
  std::ifstream file(GIGARAY_SOURCE_DIR "/docs/options.md");
  std::ostringstream page;
  page << file.rdbuf();
  EXPECT_EQ(page.str(), option_reference());
}

}  // namespace
}  // namespace gigaray
