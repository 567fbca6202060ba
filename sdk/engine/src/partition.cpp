// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "partition.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

#include "sweep.h"

namespace gigaray {
namespace {

RowRange hull(RowRange a, RowRange b) {
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

}  // namespace

// ---- Rows ---------------------------------------------------------------------------------------

namespace {

/// Rows that begin the partitions at the finest level, and the end.
std::vector<int> first_rows(int height, int partitions) {
  std::vector<int> rows;
  for (int i = 0; i < partitions; ++i)
    rows.push_back(int(long(height) * i / partitions) / kScanlineBlock * kScanlineBlock);
  rows.push_back(height);
  return rows;
}

/// How many of so many partitions get rows on every level.
int usable_partitions(const MemoryPlan& plan, int wanted) {
  const auto all_have_rows = [&](int partitions) {
    std::vector<int> rows = first_rows(plan.levels.front().shape.height, partitions);
    for (std::size_t level = 0; level < plan.levels.size(); ++level) {
      if (std::adjacent_find(rows.begin(), rows.end()) != rows.end()) return false;
      for (int& row : rows) row = (row + 1) / 2;
    }
    return true;
  };
  while (wanted > 1 && !all_have_rows(wanted)) --wanted;
  return std::max(wanted, 1);
}

}  // namespace

std::vector<std::vector<PartitionRows>> partition_rows(
    const MemoryPlan& plan, const DepthOptions& options, const AnySampler& sampler,
    const HypothesisRange& hypotheses, const std::vector<int>& refs, int partitions) {
  partitions = usable_partitions(plan, partitions);
  std::vector<int> first = first_rows(plan.levels.front().shape.height, partitions);
  std::vector<std::vector<PartitionRows>> all(partitions);
  for (const LevelPlan& level : plan.levels) {
    const int height = level.shape.height;
    const RowRange every{0, height};
    for (int i = 0; i < partitions; ++i) {
      if (partitions == 1) {
        all[i].push_back({every, every, every, every, every});
        continue;
      }
      PartitionRows rows;
      rows.own = rows.swept = {first[i], first[i + 1]};
      std::visit(
          [&](const auto& s) {
            for (const int ref : refs) {
              const auto stages = sweep_stages(options, level.shape.level,
                                               int(s.partners(ref).size()), plan.guided);
              rows.swept = hull(rows.swept, rows_of_stages(stages, rows.own, height).front());
            }
          },
          sampler);
      // What a look scores beyond its rows, and what that goes by. Two rows at least: those of the
      // next level begin in the middle of two.
      const bool scanline = options.support.scanline && level.shape.level == 0;
      const int around = (scanline ? kScanlineReach : 0) + 2 * options.support.radius;
      const int hole = 2 * kThinHole + 1, crack = options.propagation.crack_width + 1;
      rows.todo = grown(rows.swept, around + hole + 2, height);
      rows.unpacked = grown(rows.todo, crack, height);
      rows.pixels = rows.unpacked;
      std::visit(
          [&](const auto& s) {
            const auto of_level = s.at_level(level.shape.level);
            const RowRange seen = grown(rows.todo, level.halo, height);
            for (const int ref : refs)
              rows.pixels = hull(rows.pixels, of_level.rows_needed(ref, seen, hypotheses, height));
          },
          sampler);
      all[i].push_back(rows);
    }
    for (int& row : first) row = (row + 1) / 2;
  }
  return all;
}

// ---- What passes between partitions -------------------------------------------------------------

namespace {

/// Thrown in partitions whose run another one has ended.
struct Ended {};

/// Partitions that are threads of this process.
class Team {
 public:
  explicit Team(int size) : offers_(size), values_(size) {}

  int size() const { return int(offers_.size()); }

  /// Waits until all are here.
  void meet() {
    std::unique_lock lock(mutex_);
    if (failed_) throw Ended();
    const long meeting = meetings_;
    if (++here_ == size()) {
      here_ = 0;
      ++meetings_;
      all_are_here_.notify_all();
      return;
    }
    all_are_here_.wait(lock, [&] { return failed_ || meetings_ > meeting; });
    if (meetings_ == meeting) throw Ended();
  }

  void fail(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (!failed_) error_ = std::move(error);
    failed_ = true;
    all_are_here_.notify_all();
  }
  const std::exception_ptr& error() const { return error_; }

  /// What a partition shows the others between two meetings.
  struct Offer {
    RowRange own, wanted;
    std::map<int, std::vector<std::byte>> rows;  ///< for whom
  };
  Offer& offer(int index) { return offers_[index]; }
  long& value(int index) { return values_[index]; }

 private:
  std::mutex mutex_;
  std::condition_variable all_are_here_;
  int here_ = 0;
  long meetings_ = 0;
  bool failed_ = false;
  std::exception_ptr error_;
  std::vector<Offer> offers_;
  std::vector<long> values_;
};

class Member : public Partition {
 public:
  Member(Team& team, int index) : team_(team), index_(index) {}

  int index() const override { return index_; }
  int count() const override { return team_.size(); }

  void bring(const BroughtRows& rows) override {
    if (count() == 1) return;
    Team::Offer& mine = team_.offer(index_);
    mine.own = rows.own;
    mine.wanted = rows.wanted;
    team_.meet();
    for (int i = 0; i < count(); ++i) {
      const RowRange theirs = overlap(mine.own, team_.offer(i).wanted);
      if (i == index_ || theirs.size() == 0) continue;
      mine.rows[i].resize(rows.row_bytes * theirs.size());
      rows.read(theirs, mine.rows[i].data());
    }
    team_.meet();
    for (int i = 0; i < count(); ++i) {
      const RowRange ours = overlap(mine.wanted, team_.offer(i).own);
      if (i != index_ && ours.size() > 0) rows.write(ours, team_.offer(i).rows.at(index_).data());
    }
    team_.meet();
    mine.rows.clear();
  }

  long sum(long value) override {
    if (count() == 1) return value;
    team_.value(index_) = value;
    team_.meet();
    long total = 0;
    for (int i = 0; i < count(); ++i) total += team_.value(i);
    team_.meet();
    return total;
  }

  void in_turn(const std::function<void()>& job) override {
    for (int i = 0; i < count(); ++i) {
      if (i == index_) job();
      if (count() > 1) team_.meet();
    }
  }

 private:
  Team& team_;
  const int index_;
};

}  // namespace

void run_partitions(int count, const std::function<void(Partition&)>& job) {
  Team team(count);
  const auto work = [&](int index) {
    Member member(team, index);
    try {
      job(member);
    } catch (const Ended&) {  // what ended it is thrown below
    } catch (...) {
      team.fail(std::current_exception());
    }
  };
  // Not tasks of the common pool: they wait for each other.
  std::vector<std::thread> others;
  try {
    for (int i = 1; i < count; ++i) others.emplace_back(work, i);
  } catch (...) {
    team.fail(std::current_exception());
  }
  work(0);
  for (std::thread& other : others) other.join();
  if (team.error()) std::rethrow_exception(team.error());
}

}  // namespace gigaray
