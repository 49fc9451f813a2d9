// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "view/map_answers.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/synthetic_roadmap.hpp"
#include "view/live_view.hpp"

namespace ridgeway::cli {
namespace {

TEST(MapAnswers, TellsOfAMapWhateverItsFileIsCalled) {
  const std::string odd = "\xff\"<b>\n.ridge";
  const Question question{"/api/info", {}};
  const Roadmap roadmap = synthetic_roadmap({});
  LiveView live(odd);
  for (const Reply& reply : {MapAnswers(roadmap, odd).answer(question), live.answer(question)}) {
    EXPECT_EQ(reply.status, 200) << *reply.body;
    EXPECT_EQ(nlohmann::json::parse(*reply.body)["name"], "\\xff\"<b>\\x0a.ridge");
  }
}

TEST(MapAnswers, WhereAPathIsGivenNothingThatPlansOneIsPassedOver) {
  const Roadmap roadmap = synthetic_roadmap({});
  MapAnswers answers(roadmap, "map");
  for (const char* name :
       {"from", "to", "planner", "prefer_clearance", "snap", "escape", "explain"}) {
    const Question question{"/api/trajectory", {{"path", "1,1,1;2,1,1"}, {name, "0"}}};
    const Reply reply = answers.answer(question);
    EXPECT_EQ(reply.status, 400) << name;
    EXPECT_NE(reply.body->find(name), std::string::npos) << *reply.body;
  }
  const Question alone{"/api/trajectory", {{"path", "1,1,1;2,1,1"}, {"radius", "0.3"}}};
  EXPECT_EQ(answers.answer(alone).status, 200);
}

}  // namespace
}  // namespace ridgeway::cli
