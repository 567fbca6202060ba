// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/engine/device.h"
#include "gigaray/engine/reconstruct.h"

namespace GIGARAY_API gigaray {

class CoarseGuide;

/// reconstruct() and probe() for many light fields: the device is opened once, and kernels that a
/// call built are there for the next one. What is computed is the same, to the bit. Copies are
/// cheap and share the device.
///
/// Thread-safe: one estimator, or several on one device or on several, may be called from any
/// number of threads at once. Calls at once share the device's compute units. Each plans as if it
/// were alone: within its own DepthOptions::memory_bytes, and on a device with memory of its own
/// with nine tenths of that; together they must fit, else Error(kOutOfMemory). A RunControl that
/// several of them get must have sinks that are thread-safe; cancelling it ends them all.
class Estimator {
 public:
  /// With OpenCL kernels on a device. The default throws what Device::open() throws.
  explicit Estimator(Device device = Device::open());

  /// On several devices at once: each has a part of the rows of every view, as many as the others,
  /// so they should be alike. All or none must have memory of their own. The same device may be
  /// there more than once. Throws Error(kInvalidArgument) when there is none.
  explicit Estimator(std::vector<Device> devices);

  /// With the plain loops that the kernels are checked against: slow, needs no device.
  static Estimator reference();

  /// The devices and backend of a choice. Throws Error: kInvalidArgument (no such backend),
  /// kDevice.
  static Estimator of(const BackendChoice& choice);

  /// As gigaray::reconstruct(), and throws what that throws.
  Reconstruction reconstruct(const LightField& light_field, const DepthOptions& options,
                             const RunControl& control) const;

  /// As gigaray::probe(), and throws what that throws. On the first device.
  ScoreCurve probe(const LightField& light_field, const DepthOptions& options, int view_idx, int u,
                   int v, const RunControl& control) const;
  /// The same of many pixels of a view, in their order: the pictures are looked at once, and those
  /// of one row are done together.
  std::vector<ScoreCurve> probe(const LightField& light_field, const DepthOptions& options,
                                int view_idx, const std::vector<PixelIndex>& pixels,
                                const RunControl& control) const;

  const std::vector<Device>& devices() const { return devices_; }  ///< Empty: the reference.

 private:
  struct Reference {};
  explicit Estimator(Reference) {}

  Reconstruction compute(const LightField& light_field, const DepthOptions& options,
                         const RunControl& control) const;
  std::unique_ptr<Reconstruction::Impl> run(const LightField& light_field,
                                            const DepthOptions& options,
                                            const RunControl& control) const;
  /// seen: pictures as the engine sees them.
  CoarseGuide find_guide(const LightField& seen, const DepthOptions& options,
                         const RunControl& control) const;
  std::vector<ScoreCurve> compute_curves(const LightField& light_field, const DepthOptions& options,
                                         int view_idx, const std::vector<PixelIndex>& pixels,
                                         const RunControl& control) const;

  std::vector<Device> devices_;
};

}  // namespace gigaray
