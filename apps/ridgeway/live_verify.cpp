// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <memory>
#include <string>

#include "files/read_file.hpp"
#include "files/temporary.hpp"
#include "live_report.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"

namespace ridgeway::cli {
namespace {

/// Whether two roadmaps have the same file, made beside the output.
bool have_same_file(const Roadmap& a, const Roadmap& b, const std::string& output) {
  const Temporary folder(output, Temporary::Kind::kFolder);
  if (folder.error() != 0)
    throw InputError(output, "has no room for files beside it", "give another folder");
  save_roadmap(a, folder.path() / "live.ridge");
  save_roadmap(b, folder.path() / "batch.ridge");
  return read_file(folder.path() / "live.ridge") == read_file(folder.path() / "batch.ridge");
}

}  // namespace

void verify_by_batch(LiveRoadmap& live, const LiveConfig& config, const std::string& output,
                     const std::string& frame, LiveReplay& replay) {
  const auto note_other = [&] {
    if (replay.first_other.empty()) replay.first_other = frame;
  };
  const std::shared_ptr<const Roadmap> snapshot = live.settled();
  const Stopwatch watch;
  if (!snapshot) {
    try {
      build_roadmap(live.map(), config.build);
    } catch (const InputError&) {
      return;  // nor has batch one
    }
    ++replay.verified;
    return note_other();
  }
  BuildResult batch = build_roadmap(live.map(), config.build);
  replay.batch_seconds.push_back(watch.seconds());
  batch.roadmap.source = config.source;
  batch.roadmap.config = config.record;
  ++replay.verified;
  if (have_same_file(*snapshot, batch.roadmap, output))
    ++replay.identical;
  else
    note_other();
}

}  // namespace ridgeway::cli
