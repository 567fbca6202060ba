// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// The difference ΔE of a block of rows: predicted, the misses quantised and coded by models that
// are chosen by how well the neighbourhood was predicted.
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "bytes.h"
#include "difference_planes.h"
#include "gigaray/core/arguments.h"
#include "gigaray/sparse/sparse_coding.h"
#include "range_coder.h"

namespace gigaray {
namespace {

constexpr int kContexts = DifferencePlanes::kContexts, kChannels = DifferencePlanes::kChannels;
constexpr std::int32_t kMostWeight = 8 << kWeightBits;

/// Low bits of a code that are as good as random where the neighbours were missed by so much.
int noisy_bits(int context) { return std::max(0, (context - 1) / 2 - 4); }

/// The weights of a channel, one set for each roughness.
using ChannelWeights = std::array<Weights, DifferencePlanes::kRoughnesses>;

/// Weights that predict a channel best, least squares over a sample of its pixels.
ChannelWeights fit_weights(const DifferencePlanes& planes, int channel, int width, int height) {
  const int n = planes.num_features(channel);
  constexpr int kSamples = 60000;
  const int every = std::max(1, int(std::int64_t(width) * height / kSamples));
  std::array<Eigen::MatrixXd, DifferencePlanes::kRoughnesses> normals;
  std::array<Eigen::VectorXd, DifferencePlanes::kRoughnesses> rights;
  normals.fill(Eigen::MatrixXd::Zero(n, n));
  rights.fill(Eigen::VectorXd::Zero(n));
  Eigen::VectorXd row(n);
  for (std::int64_t i = 0; i < std::int64_t(width) * height; i += every) {
    const int u = int(i % width), v = int(i / width);
    const auto values = planes.features(channel, u, v);
    for (int k = 0; k < n; ++k) row[k] = values[k];
    const int r = planes.roughness(channel, u, v);
    normals[r].selfadjointView<Eigen::Lower>().rankUpdate(row);
    rights[r] += planes.difference(channel, u, v) * row;
  }
  ChannelWeights all;
  for (int r = 0; r < DifferencePlanes::kRoughnesses; ++r) {
    normals[r].diagonal().array() += 1e-6 * (1 + normals[r].trace() / n);
    const Eigen::VectorXd solution =
        normals[r].selfadjointView<Eigen::Lower>().ldlt().solve(rights[r]);
    all[r] = {};
    for (int k = 0; k < n; ++k) {
      const double scaled = std::ldexp(std::clamp(solution[k], -7.0, 7.0), kWeightBits);
      all[r][k] = std::isfinite(scaled) ? std::int32_t(std::lround(scaled)) : 0;
    }
  }
  return all;
}

/// The miss of a prediction in steps that keep the error within max_error.
std::int32_t quantised(std::int32_t miss, int max_error) {
  const std::int32_t steps = (std::abs(miss) + max_error) / (2 * max_error + 1);
  return miss < 0 ? -steps : steps;
}

}  // namespace

std::string encode_difference(const Image<std::uint16_t>& picture,
                              const Image<std::uint16_t>& drawn, int bit_depth, int max_error) {
  require_argument(picture.width() == drawn.width() && picture.height() == drawn.height() &&
                       picture.channels() == kChannels && drawn.channels() == kChannels,
                   "picture, drawn: must be of one size, with three channels");
  require_argument(bit_depth >= 1 && bit_depth <= 16 && max_error >= 0,
                   "bit_depth, max_error: must be 1 … 16, and 0 or more");
  const int width = picture.width(), height = picture.height();
  const std::int32_t most = (1 << bit_depth) - 1;
  DifferencePlanes planes(drawn, bit_depth);
  for (int channel = 0; channel < kChannels; ++channel)
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u)
        planes.set(channel, u, v, picture(u, v, planes.component(channel)), 0);

  ByteWriter out;
  out.number(max_error);
  std::vector<ChannelWeights> weights;
  for (int channel = 0; channel < kChannels; ++channel) {
    weights.push_back(fit_weights(planes, channel, width, height));
    for (const Weights& set : weights[channel])
      for (int k = 0; k < planes.num_features(channel); ++k) out.signed_number(set[k]);
  }
  // Neighbours that come later are never looked at; those before are set to what is decoded.
  RangeEncoder coder;
  std::vector<NumberModel> models(kChannels * kContexts);
  for (int channel = 0; channel < kChannels; ++channel)
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        const std::int32_t value = picture(u, v, planes.component(channel));
        const std::int32_t predicted =
            planes.predict(channel, u, v, weights[channel][planes.roughness(channel, u, v)]);
        const std::int32_t steps = quantised(value - predicted, max_error);
        const int context = planes.context(channel, u, v);
        models[channel * kContexts + context].put(std::uint32_t(zigzag(steps)), noisy_bits(context),
                                                  coder);
        const std::int32_t restored = std::clamp(predicted + steps * (2 * max_error + 1), 0, most);
        planes.set(channel, u, v, restored, steps);
      }
  return out.take() + coder.finish();
}

bool may_hold_difference(std::uint64_t bytes, double pixels) {
  // A decision has a probability of 1 − 2^-10 at most (BitModel), which is 0.0014 bits.
  constexpr double kDecisionsPerByte = 6000;
  return kChannels * pixels <= kDecisionsPerByte * (double(bytes) + 1);
}

Image<std::uint16_t> decode_difference(std::string_view bytes, const Image<std::uint16_t>& drawn,
                                       int bit_depth) {
  require_argument(drawn.channels() == kChannels && bit_depth >= 1 && bit_depth <= 16,
                   "drawn, bit_depth: three channels, 1 … 16 bits are needed");
  if (!may_hold_difference(bytes.size(), double(drawn.width()) * drawn.height()))
    damaged("its differences end too early");
  const int width = drawn.width(), height = drawn.height();
  const std::int32_t most = (1 << bit_depth) - 1;
  Image<std::uint16_t> picture(width, height, kChannels);
  DifferencePlanes planes(drawn, bit_depth);

  ByteReader in(bytes);
  const int max_error = int(in.number(most));
  std::vector<ChannelWeights> weights(kChannels);
  for (int channel = 0; channel < kChannels; ++channel)
    for (Weights& set : weights[channel])
      for (int k = 0; k < planes.num_features(channel); ++k)
        set[k] = std::int32_t(in.signed_number(kMostWeight));
  RangeDecoder coder(in.rest());
  std::vector<NumberModel> models(kChannels * kContexts);

  for (int channel = 0; channel < kChannels; ++channel)
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        const std::int32_t predicted =
            planes.predict(channel, u, v, weights[channel][planes.roughness(channel, u, v)]);
        const int context = planes.context(channel, u, v);
        const std::int64_t steps =
            unzigzag(models[channel * kContexts + context].get(noisy_bits(context), coder));
        if (std::abs(steps) > most) damaged("a difference is too large");
        const std::int64_t restored =
            std::clamp<std::int64_t>(predicted + steps * (2 * max_error + 1), 0, most);
        planes.set(channel, u, v, std::int32_t(restored), std::int32_t(steps));
        picture(u, v, planes.component(channel)) = std::uint16_t(restored);
      }
  if (!coder.at_end()) damaged("more follows than it should have");
  return picture;
}

}  // namespace gigaray
