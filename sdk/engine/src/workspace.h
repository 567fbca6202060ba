// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "estimates.h"
#include "gigaray/core/ray_sampler.h"
#include "gigaray/engine/depth_options.h"
#include "gigaray/engine/reconstruct.h"
#include "map.h"

namespace gigaray {

/// Which views a robust score is made of.
enum class ScoreViews {
  kAll,        ///< about 100 of them where there are many more, of posed ones 32
  kFirst,      ///< about 25: for a first look
  kHalfPlanes  ///< the best of eight halves of kAll
};

/// How the rows of a band are encoded.
enum class BandEncoding {
  kBits8,   ///< [row][view][u][3] bytes as decoded
  kBits16,  ///< the same, 16 bit
  kFloat    ///< [row][view][3][u] floats in the working colour space
};
std::size_t pixel_bytes(BandEncoding encoding);

/// By how much the score of the best half of the views must exceed that of the estimate so far.
inline constexpr float kStepBackLead = 0.01f;

/// Colour in a band of a pixel that shows nothing of the scene. No kernel reaches it, and a
/// negative red tells the samples that it has a part in.
inline constexpr float kMaskedColour = -1000;

/// Which pixels of some views show something of the scene: [v][view][u], 0: it doesn't, and no
/// sample is taken there.
struct ShownRows {
  RowsOnDevice rows;  ///< empty: all pixels do
  int width = 0;      ///< px of a row of one view
  int shift = 0;      ///< pixel (u, v) of the level is (u, v) << shift of the rows
};

/// Rows of views from which a band is taken.
struct EncodedRows {
  RowsOnDevice pixels;
  BandEncoding encoding = BandEncoding::kBits8;
  ShownRows shown;
  std::vector<int> at;  ///< where the views of the band lie among those of both
};

/// Half of what counts as a thin hole between estimates, px: see bound_thin_holes.
inline constexpr int kThinHole = 3;

/// Finished maps of one view.
struct ViewMaps {
  Map<float> disparity;    ///< NaN: no estimate
  Map<float> confidence;   ///< NaN: no estimate
  Map<std::int8_t> level;  ///< that decided; -1: none
};

/// What went between the host and the device, and how often the host waited for the device.
struct Traffic {
  long waits = 0;
  std::size_t bytes_up = 0;
  std::size_t bytes_down = 0;
};

/// Memory of one device and the steps of the method on it. Each step is also a kernel, a reference
/// function, a test and a section of docs/kernels.md of the same name. Steps read and write maps of
/// the reference view, or rows of the active views (RowsOnDevice); they are enqueued in order, and
/// only read() waits. The workspace holds the band (rows of all views, as floats) and the scores of
/// the last strip.
///
/// Calls: begin_level, then per band load_band, then steps on rows within it. All rows are rows of
/// the level; `ref` is a view index. Maps are of all rows
/// of the level, those called *strip* of the given rows alone. Not thread-safe.
class Workspace {
 public:
  virtual ~Workspace() = default;
  virtual std::string name() const = 0;         ///< "reference" or "opencl"
  virtual std::string description() const = 0;  ///< The device, for reports.

  // ---- Memory -----------------------------------------------------------------------------------
  virtual std::shared_ptr<Memory> allocate(std::size_t bytes) = 0;  ///< zeros
  /// The host's memory for the device to read, without a copy where they share it. It must outlive
  /// what is returned, and nobody writes it meanwhile; other devices may have it too.
  virtual std::shared_ptr<Memory> adopt(std::span<std::byte> host) = 0;
  virtual void write(Memory& memory, std::span<const std::byte> data, std::size_t offset = 0) = 0;
  /// Waits for all steps before.
  virtual void read(const Memory& memory, std::span<std::byte> data, std::size_t offset = 0) = 0;
  /// Does not wait: what is read is there after the next read(), until when `data` must live.
  virtual void read_later(const Memory& memory, std::span<std::byte> data,
                          std::size_t offset = 0) = 0;
  /// Memory as the host sees it, until unmap(); no step may use it meanwhile. Waits. To fill it:
  /// what it had is lost.
  virtual std::span<std::byte> map(Memory& memory, bool to_fill) = 0;
  virtual void unmap(Memory& memory, std::span<std::byte> mapped) = 0;
  /// Waits for all steps.
  virtual void finish() = 0;
  /// Waits for the steps before the last call, so that the host does not run far ahead.
  virtual void keep_pace() = 0;
  /// Does the device work in the host's memory?
  virtual bool shares_host_memory() const = 0;
  virtual const Traffic& traffic() const = 0;
  /// What the next steps are accounted to.
  virtual void begin_stage(const std::string& stage) = 0;
  /// Seconds that the device worked, by stage, up to the last read().
  virtual const std::map<std::string, double>& seconds() const = 0;

  template <class T>
  Map<T> make_map(int width, RowRange rows) {
    return {allocate(std::size_t(map_pitch(width)) * rows.size() * sizeof(T)), width, rows};
  }

  /// Rows of the host into those of a map that has them.
  template <class T>
  void put(const StripMap<T>& from, const Map<T>& to) {
    const std::size_t row = std::size_t(from.pitch()) * sizeof(T);
    const std::span values(from.padded_row(from.rows().begin),
                           std::size_t(from.pitch()) * from.rows().size());
    write(to.memory(), std::as_bytes(values), (from.rows().begin - to.rows().begin) * row);
  }
  /// A map on the host. Waits.
  template <class T>
  StripMap<T> get(const Map<T>& map) {
    StripMap<T> copy(map.width(), map.rows());
    read(map.memory(),
         std::as_writable_bytes(std::span(copy.padded_row(map.rows().begin),
                                          std::size_t(copy.pitch()) * map.rows().size())));
    return copy;
  }

  // ---- Pixels -----------------------------------------------------------------------------------
  /// Views that keep estimates, in the order that rows of the active views have.
  virtual void set_active_views(const std::vector<int>& views) = 0;
  /// band_rows: most rows of a band to come, as a rule.
  virtual void begin_level(const LevelShape& shape, int band_rows) = 0;
  /// The rows to load so that the band holds some rows of some views: those that it has stay.
  /// Empty: it holds them already.
  virtual RowRange missing_rows(RowRange rows, const std::vector<int>& views) const = 0;
  /// rows: what is loaded, halo included. views: whose, ascending; the steps see no others. fresh:
  /// the rows that `source` has, all or those that are missing; the others came by the same
  /// encoding and mask.
  virtual void load_band(RowRange rows, RowRange fresh, const std::vector<int>& views,
                         const EncodedRows& source) = 0;
  /// small: pixels of the level below, [v][stored view][3][(width + 1) / 2]; the loaded views are
  /// those from `first` on. The band covers rows 2v − 3 … 2v + 3 of them.
  virtual void downsample(RowRange small_rows, const RowsOnDevice& small, int first) = 0;
  virtual int channels() const = 0;  ///< of a band
  /// Mean colour along the rays of the reference view's pixels under `disparity` where `wanted`;
  /// other pixels stay as they are. means: row v · channels() + c holds channel c of row v.
  virtual void ray_mean(int ref, RowRange rows, const Map<std::uint8_t>& wanted,
                        const Map<float>& disparity, const Map<float>& means) = 0;
  /// Gradients of means, from the colours of their rows and of one more on both sides.
  virtual void mean_gradients(RowRange rows, const Map<float>& means) = 0;
  /// Lets means stand for the pixels of the reference view in the steps that look at it alone,
  /// until restore_reference(); what other views show stays.
  virtual void replace_reference(const Map<float>& means) = 0;
  virtual void restore_reference() = 0;

  // ---- What to do -------------------------------------------------------------------------------
  virtual void edge_confidence(int ref, RowRange rows, const Map<float>& strip) = 0;
  /// mask: a strip of the same rows, 1 where the confidence is above the threshold.
  virtual void edge_mask(RowRange rows, const Map<float>& strip, float threshold,
                         const Map<std::uint8_t>& mask) = 0;
  /// Least or greatest of a pixel and its four neighbours; outside the picture nothing counts. The
  /// maps may be strips, `in` of one row more on both sides.
  virtual void erode(RowRange rows, const Map<std::uint8_t>& in, const Map<std::uint8_t>& out) = 0;
  virtual void dilate(RowRange rows, const Map<std::uint8_t>& in, const Map<std::uint8_t>& out) = 0;
  /// Rows of a map into those of a view.
  virtual void put_mask(RowRange rows, const Map<std::uint8_t>& mask, const ViewRows& to) = 0;
  /// Estimates of a view as maps; NaN and 0 where there is none.
  virtual void unpack_estimates(RowRange rows, const ViewRows& estimates,
                                const Map<float>& disparity, const Map<float>& confidence) = 0;
  /// Holes of at most `width` px between estimates of a row, or of a column, that differ by no more
  /// than `apart` are filled between them; into the estimates of the view too.
  virtual void close_cracks(RowRange rows, int width, float apart, const Map<float>& disparity,
                            const Map<float>& confidence, const Map<float>& closed,
                            const Map<float>& closed_confidence, const ViewRows& estimates) = 0;
  /// todo: pixels without an estimate that are worth trying (`mask`), show something of the scene
  /// and are not decided by finer levels (`search`). Each may be empty.
  virtual void select_todo(RowRange rows, const Map<float>& disparity, const ViewRows& mask,
                           const ShownRows& shown, int shown_at, const ViewRows& search,
                           const Map<std::uint8_t>& todo, const Map<HypothesisBounds>& bounds) = 0;
  /// Holes thinner than 7 px between estimates carried over from other views show, as a rule, one
  /// of the surfaces around them: pixels of `todo` that are not in `wide`, which is todo opened by
  /// kThinHole, get narrower bounds.
  virtual void bound_thin_holes(RowRange rows, const Map<std::uint8_t>& todo,
                                const Map<std::uint8_t>& wide, const Map<float>& estimates,
                                const Map<HypothesisBounds>& bounds) = 0;
  /// All pixels within `radius` of one to do, with the union of their bounds.
  virtual void grow_todo(RowRange rows, int radius, const Map<std::uint8_t>& todo,
                         const Map<HypothesisBounds>& bounds, const Map<std::uint8_t>& grown_todo,
                         const Map<HypothesisBounds>& grown_bounds) = 0;
  /// Pixels of `todo` within `reach` of a jump of the map.
  virtual void beside_jumps(RowRange rows, const Map<float>& map, float jump, int reach,
                            const Map<std::uint8_t>& todo, const Map<std::uint8_t>& beside) = 0;
  /// Pixels of every row that are set, or have an estimate. The answers that the walk waits for.
  virtual std::vector<int> count_rows(const Map<std::uint8_t>& mask) = 0;
  virtual std::vector<int> count_estimates(const Map<float>& estimates) = 0;

  // ---- Scores -----------------------------------------------------------------------------------
  /// From now on the scores of these rows are held in one of three volumes, from 0; what it has of
  /// them stays. Steps on scores work on it.
  virtual void hold_scores(int volume, RowRange rows) = 0;
  /// Scores of `rows`, which are held, where todo: the paper's,
  virtual void density_score(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                             const Map<HypothesisBounds>& bounds) = 0;
  /// the robust one of colour and gradient (ScoreOptions::gradient).
  virtual void robust_score(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                            const Map<HypothesisBounds>& bounds, ScoreViews views) = 0;
  /// Makes supported scores for `rows` out of those that are held, which cover support.radius rows
  /// more on both sides or end at the edge of the picture.
  virtual void score_support(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                             const Map<HypothesisBounds>& bounds) = 0;
  /// The same along the slope of the surface. All hypotheses were tested.
  virtual void slanted_support(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                               const Map<HypothesisBounds>& bounds, const Map<Slope>& slopes) = 0;
  /// Follows scan-lines over the supported scores; winner() then goes by the result. rows: begin at
  /// a multiple of kScanlineBlock; supported scores and todo: of kScanlineReach rows more, clipped
  /// to the picture. All hypotheses were tested.
  virtual void scanline(int ref, RowRange rows, const Map<std::uint8_t>& todo) = 0;
  /// Scores (without scan-lines) that winner() sees for one pixel, one per hypothesis; -1 where not
  /// tested.
  virtual std::vector<float> scores_at(int u, int v) = 0;

  // ---- Estimates --------------------------------------------------------------------------------
  /// The best hypothesis by what the last step on scores left, and its contrast: strips.
  virtual void winner(RowRange rows, const Map<std::uint8_t>& todo,
                      const Map<HypothesisBounds>& bounds, const Map<float>& disparity,
                      const Map<float>& contrast) = 0;
  /// The same scores at the hypotheses next to estimates, which are a strip or a map; NaN where
  /// there is none or nothing to do. scores: a strip.
  virtual void score_of_estimate(RowRange rows, const Map<std::uint8_t>& todo,
                                 const Map<float>& disparity, const Map<float>& scores) = 0;
  /// Winners of a strip into the maps. Contrast counts for nothing where it is not above min_relief
  /// of the best score (empty: everywhere it is), and is weighed by edges (empty: it isn't). On the
  /// last level a pixel without a winner takes the farther of its bounds.
  virtual void take_winners(RowRange rows, bool is_last_level, const Map<std::uint8_t>& todo,
                            const Map<HypothesisBounds>& bounds, const Map<float>& winners,
                            const Map<float>& contrast, const Map<float>& best,
                            const Map<float>& edges, const Map<float>& disparity,
                            const Map<float>& confidence) = 0;
  /// Winners that are `farther` than the estimate and whose score leads by kStepBackLead are taken.
  /// best, own: strips of the scores of both.
  virtual void step_back(RowRange rows, float farther, const Map<float>& winners,
                         const Map<float>& contrast, const Map<float>& best, const Map<float>& own,
                         const Map<float>& disparity, const Map<float>& confidence) = 0;
  /// Beside jumps of the estimates, how much more a pixel's rays speak for the nearer side than for
  /// the farther one; NaN elsewhere, and where nothing is to do. jump: between estimates within 2
  /// px. Looks at kSideReach rows around.
  virtual void side_evidence(int ref, RowRange rows, float jump, const Map<std::uint8_t>& todo,
                             const Map<float>& disparity, const Map<float>& evidence) = 0;
  /// The same estimates, but pixels that belong to the other side by this evidence and by their
  /// colours have that one's nearest. Looks at kSideColours rows around.
  virtual void choose_sides(int ref, RowRange rows, float jump, const Map<float>& disparity,
                            const Map<float>& confidence, const Map<float>& evidence,
                            const Map<float>& chosen, const Map<float>& chosen_confidence) = 0;
  /// 1 where every view that sees an estimate sees a more confident one at the same place, that
  /// differs by more than `apart`, which moves a point by a pixel; and where no view sees it. 0
  /// where nothing is to do. Looks at kHiddenReach rows around.
  virtual void find_hidden(int ref, RowRange rows, float apart, const Map<std::uint8_t>& todo,
                           const Map<float>& disparity, const Map<float>& confidence,
                           const Map<std::uint8_t>& hidden) = 0;
  /// The same and specks: what few of the estimates around are alike, within `apart`, and not
  /// hidden. Looks at kSpeckReach rows around.
  virtual void find_specks(RowRange rows, float apart, const Map<std::uint8_t>& todo,
                           const Map<float>& disparity, const Map<std::uint8_t>& hidden,
                           const Map<std::uint8_t>& guessed) = 0;
  /// What is guessed, and not within `apart` of it, takes the farther one of the next estimates of
  /// its row, in place.
  virtual void fill_hidden(RowRange rows, float apart, const Map<std::uint8_t>& guessed,
                           const Map<float>& disparity, const Map<float>& confidence) = 0;
  /// tolerance: colour distance; infinite makes it a plain median that needs no band.
  virtual void bilateral_median(int ref, RowRange rows, int radius, float tolerance,
                                const Map<float>& in, const Map<float>& out) = 0;
  /// Slope of the surface at every estimate where todo. NaN: no estimate.
  virtual void slope_fit(int ref, RowRange rows, const Map<std::uint8_t>& todo,
                         const Map<float>& in, const Map<Slope>& slopes) = 0;
  /// Estimates that are not to do, or not more confident than the threshold, become NaN.
  virtual void accept(RowRange rows, float threshold, const Map<std::uint8_t>& todo,
                      const Map<float>& confidence, const Map<float>& estimates) = 0;
  virtual void mean_radiance(int ref, RowRange rows, const Map<float>& disparity,
                             const Map<Radiance>& radiance) = 0;
  /// The accepted estimates of some rows as tuples, row by row. Returns their number, which it
  /// waits for. tuples: room for all of them.
  virtual int compact_tuples(int view, RowRange rows, const Map<float>& disparity,
                             const Map<float>& confidence, const Map<Radiance>& radiance,
                             Memory& tuples) = 0;

  // ---- Estimates of all active views
  // --------------------------------------------------------------
  /// The first `finished` active views get a bar wherever an estimate arrives and none is yet:
  /// bar_of() what they have. Rays that leave `reached` are dropped, here and below.
  virtual void set_bars(int ref, RowRange rows, const Map<float>& disparity, RowRange reached,
                        int finished, const RowsOnDevice& estimates, const RowsOnDevice& bars) = 0;
  /// Estimates of the reference view arrive in all active views; in the first `finished` of them,
  /// those that are more confident than the bar.
  virtual void propagation(int ref, RowRange rows, const Map<float>& disparity,
                           const Map<float>& confidence, const Map<Radiance>& radiance,
                           RowRange reached, int finished, const RowsOnDevice& bars,
                           const RowsOnDevice& estimates) = 0;
  /// Takes the bars away that set_bars made.
  virtual void clear_bars(int ref, RowRange rows, const Map<float>& disparity, RowRange reached,
                          int finished, const RowsOnDevice& bars) = 0;
  /// Depth bounds of one level down, see coarsen_bounds() in search_bounds.h. rows: of the coarse
  /// level. search: of the fine level; empty at level 0.
  virtual void coarsen_bounds(RowRange rows, const ViewRows& estimates, const ViewRows& search,
                              const ViewRows& coarse) = 0;
  /// Maps of a level: its own estimates, else what the coarser level has (empty: nothing), where
  /// the view shows something of the scene.
  virtual void fill_view(RowRange rows, const LevelShape& shape, const ViewRows& estimates,
                         const ViewMaps& coarse, const ShownRows& shown, int shown_at,
                         const ViewMaps& maps) = 0;
};

/// Waits for all steps at the end of a scope that they may be left early from, before memory of the
/// host that they use goes.
class FinishSteps {
 public:
  explicit FinishSteps(Workspace& workspace) : workspace_(workspace) {}
  ~FinishSteps() {
    try {
      workspace_.finish();
    } catch (...) {  // the scope is left by the error that matters
    }
  }
  FinishSteps(const FinishSteps&) = delete;
  FinishSteps& operator=(const FinishSteps&) = delete;

 private:
  Workspace& workspace_;
};

}  // namespace gigaray
