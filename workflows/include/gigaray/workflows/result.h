// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "gigaray/applications/rig_cameras.h"
#include "gigaray/core/api.h"
#include "gigaray/core/depth_view.h"
#include "gigaray/core/light_field.h"
#include "gigaray/engine/reconstruct.h"
#include "gigaray/workflows/input.h"

namespace GIGARAY_API gigaray {

/// How a result is opened.
struct ResultRequest {
  std::filesystem::path path;  ///< An output folder of `gigaray depth`, or a .grl file
  /// Where the pictures are, when they are no more where they were; empty: there.
  std::filesystem::path input = {};
  double min_confidence = 0;  ///< estimates that are less sure are left out
  bool with_pictures = true;  ///< false: maps and geometry alone, for what needs no more
};

/// Pictures, depth and cameras of all views of a result, on disk or in memory; the one cache of its
/// views. Not thread-safe.
class DepthScene {
 public:
  /// Reads what describes the result, no map and no picture. Throws Error(kBadInput) naming the
  /// file, Error(kInvalidArgument) for min_confidence of a .grl file, which holds no confidence.
  explicit DepthScene(const ResultRequest& request);
  /// Of depth that was just computed. Only views that have depth can be read.
  DepthScene(const OpenedInput& input, std::shared_ptr<const Reconstruction> result);

  /// With pictures. Views without depth are among them where the result is in memory.
  const LightField& light_field() const { return source_.light_field; }
  const RigCameras& rig() const { return rig_; }
  /// Of disparities (inverse depths), as stated or as searched.
  DisparityRange range() const { return source_.range; }
  /// Number of hypotheses in it; 0: not known.
  int hypotheses() const { return source_.hypotheses; }
  /// The view whose maps stand for all: the centre view, or the one nearest to it that has depth.
  int top_view() const { return source_.top_view; }
  /// Where it is, for messages.
  const std::string& name() const { return source_.name; }
  double min_confidence() const { return min_confidence_; }
  /// Indices of the views that have depth.
  const std::vector<int>& views() const { return source_.views; }

  /// (v, u) in the unit of ViewDepth::disparity; NaN: no estimate, or one that is not sure enough.
  FloatMap disparity(int view) const;
  /// (v, u); empty: nothing is known of it.
  FloatMap confidence(int view) const;

  /// A view with all that is known of it. The last ones are kept: the reference holds until the
  /// next call.
  const DepthView& view(int view);
  /// Keeps so many views at most, 24 unless said.
  void keep(std::size_t most);
  /// Bytes of a view that is kept.
  double view_bytes() const;
  /// Does view() read confidence? What doesn't need it saves its memory.
  void read_confidence(bool reads) { reads_confidence_ = reads; }

  /// Camera and picture of a view; no maps.
  DepthView picture(int view) const;
  /// Index of a view by its name; −1: there is none.
  int find(const std::string& view_name) const;
  /// Camera and picture of a view that took no part in the depth (InputRequest::without). Throws
  /// Error(kInvalidArgument) when there is none of this name, Error(kBadInput) when it is gone.
  DepthView left_out(const std::string& view_name) const;

 private:
  /// How to get at what is stored.
  struct Source {
    LightField light_field;
    DisparityRange range;
    int hypotheses = 0, top_view = 0;
    std::string name;
    std::vector<int> views;
    std::function<FloatMap(int)> disparity, confidence;  ///< confidence: may be empty
    std::function<LightField()> open_input;              ///< the same
  };
  static Source open_folder(const ResultRequest& request);
  static Source open_sparse(const ResultRequest& request);
  explicit DepthScene(Source source);

  Source source_;
  RigCameras rig_;
  double min_confidence_ = 0;
  bool reads_confidence_ = true;
  struct Kept {
    int view;
    DepthView data;
  };
  std::size_t most_kept_ = 24;
  std::list<Kept> kept_;  ///< the last one used first
};

}  // namespace gigaray
