// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "view/live_view.hpp"

#include <utility>

#include "console.hpp"
#include "json.hpp"

namespace ridgeway::cli {

LiveView::LiveView(const std::string& name) : name_(printable(name)) {}

void LiveView::show(LiveScene scene) {
  LiveScene before;  // let go of when nobody waits for the lock: a map may be its last owner's
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    positions_.push_back(scene.position);
    before = std::exchange(scene_, std::move(scene));
    ++version_;
  }
  shown_.notify_all();
}

std::optional<LiveView::Update> LiveView::next(Seen& seen, std::chrono::milliseconds patience) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!shown_.wait_for(lock, patience, [&] { return version_ != seen.version; }))
    return std::nullopt;
  Update update{
      scene_, {positions_.begin() + static_cast<std::ptrdiff_t>(seen.positions), positions_.end()}};
  seen = {version_, positions_.size()};
  return update;
}

std::shared_ptr<LiveView::Snapshot> LiveView::newest() {
  std::shared_ptr<Snapshot> before;  // let go of after the lock, as in show()
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!scene_.roadmap) return nullptr;
  if (!snapshot_ || snapshot_->roadmap != scene_.roadmap)
    before = std::exchange(snapshot_, std::make_shared<Snapshot>(scene_.roadmap, name_));
  return snapshot_;
}

Reply LiveView::answer(const Question& question) {
  const std::shared_ptr<Snapshot> snapshot = newest();
  if (question.path == "/api/info") {
    using nlohmann::ordered_json;
    ordered_json info = {{"name", name_}, {"bounds", nullptr}};
    if (snapshot) {
      Reply reply = snapshot->answers.answer(question);
      if (reply.status != 200) return reply;
      info = ordered_json::parse(*reply.body);
    }
    info["live"] = true;
    return json_reply(200, info);
  }
  if (!snapshot)
    return json_reply(503, {{"error", "nothing is known yet of where the robot fits: wait"}});
  return snapshot->answers.answer(question);
}

}  // namespace ridgeway::cli
