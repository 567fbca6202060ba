// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <system_error>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"
#include "output/output_manifest.h"
#include "output/output_place.h"
#include "output/partial_folder.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& named, const std::string& why) {
  throw Error(ErrorCode::kInvalidArgument, named.string() + ": " + why);
}

std::string list_text(const std::vector<fs::path>& paths) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(paths.size(), kMost); ++i)
    text += (i ? ", " : "") + paths[i].string();
  if (paths.size() > kMost) text += " and " + std::to_string(paths.size() - kMost) + " more";
  return text;
}

/// Makes the folders above a place; those that it made are removed at the end, while empty.
class FoldersAbove {
 public:
  FoldersAbove(const fs::path& place, const fs::path& named) {
    std::error_code error;
    for (fs::path above = place.parent_path();
         !fs::exists(above, error) && above != above.root_path(); above = above.parent_path())
      made_.push_back(above);
    for (auto above = made_.rbegin(); above != made_.rend(); ++above) {
      fs::create_directory(*above, error);
      if (error) cannot_write(named, error);
    }
  }
  ~FoldersAbove() {
    for (const fs::path& above : made_) rmdir(above.c_str());
  }
  FoldersAbove(const FoldersAbove&) = delete;
  FoldersAbove& operator=(const FoldersAbove&) = delete;

 private:
  std::vector<fs::path> made_;  ///< the innermost first
};

/// What stands where the folder goes.
enum class Found { kNothing, kEmptyFolder, kOurs, kForeign };

/// All that was written to the file system of a folder reaches the disk.
void sync_all(const fs::path& folder) {
  const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool done = file >= 0 && syncfs(file) == 0;
  const std::error_code why(errno, std::generic_category());
  if (file >= 0) close(file);
  if (!done) cannot_write(folder, why);
}

}  // namespace

struct AtomicFolder::State {
  State(const fs::path& target, std::string what, OutputRules how)
      : named(target), kind(std::move(what)), rules(std::move(how)), place(output_place(target)) {
    check_folder_place(place, named, rules);
    look();
    above.emplace(place, named);
    partial.emplace(place.parent_path(), place.filename().string());
  }

  /// Looks at the place and refuses what is not to be replaced. It may change during a long run.
  Found look() const {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(place, error);
    if (!fs::exists(status)) return Found::kNothing;
    if (!fs::is_directory(status)) refuse(named, "is a file; name a folder for the output");
    if (fs::is_empty(place, error) && !error) return Found::kEmptyFolder;
    if (error) cannot_write(named, error);
    const std::string why = why_not_ours();
    if (why.empty()) return Found::kOurs;
    if (rules.replace) return Found::kForeign;
    refuse(named, "is not empty and " + why +
                      "; name another folder, or add OutputRules::replace, which " +
                      "moves this one to " + free_old_name(place).filename().string());
  }

  /// The end of a sentence about the folder; empty: all in it is an earlier output of this kind.
  std::string why_not_ours() const {
    const auto manifest = OutputManifest::read(place);
    if (!manifest) return "this program did not write it";
    if (manifest->kind() != kind) return "holds another kind of output (" + manifest->kind() + ")";
    const std::vector<fs::path> foreign = manifest->foreign(place);
    if (foreign.empty()) return {};
    return "holds what this program did not write, or what was changed since (" +
           list_text(foreign) + ")";
  }

  void put_in_place(Found found) {
    if (found == Found::kForeign) {
      rename_to_free(place, free_old_name(place));
      found = Found::kNothing;
    }
    if (found == Found::kNothing) {
      rename_to_free(partial->path(), place);
      partial->release();
    } else if (exchange_names(partial->path(), place)) {
      remove_older(partial->path());
      partial->release();
    } else {
      // The next output beside it gives the older one its name back, should this end in between.
      const fs::path older = partial_path(place.parent_path(), place.filename().string());
      rename_to_free(place, older);
      try {
        rename_to_free(partial->path(), place);
      } catch (const Error&) {
        rename_to_free(older, place);
        throw;
      }
      partial->release();
      remove_older(older);
    }
    above.reset();
    sync_names(place.parent_path());
  }

  /// What was added to it in this very moment is kept.
  void remove_older(const fs::path& older) const {
    if (rmdir(older.c_str()) == 0) return;
    const auto manifest = OutputManifest::read(older);
    if (manifest && manifest->remove(older)) return;
    rename_to_free(older, free_old_name(place));
  }

  fs::path named;
  std::string kind;
  OutputRules rules;
  fs::path place;
  std::optional<FoldersAbove> above;
  std::optional<PartialFolder> partial;
};

AtomicFolder::AtomicFolder(const fs::path& target, std::string kind, OutputRules rules)
    : state_(std::make_unique<State>(target, std::move(kind), std::move(rules))) {}

AtomicFolder::~AtomicFolder() = default;

const fs::path& AtomicFolder::path() const { return state_->partial->path(); }

void AtomicFolder::commit(const RunControl& control) {
  require_argument(!path().empty(),
                   "an output folder that is in its place already can't be put there again");
  sync_all(path());
  OutputManifest(path(), state_->kind).write(path());
  sync_all(path());
  const Found found = state_->look();
  control.keep_result();
  state_->put_in_place(found);
}

}  // namespace gigaray
