// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "json.hpp"
#include "ridgeway/roadmap/components.hpp"
#include "ridgeway/roadmap/roadmap.hpp"
#include "roadmap_facts.hpp"

namespace ridgeway::cli {

/// What the page asks, as the path and the decoded query of an address.
struct Question {
  std::string path;
  std::multimap<std::string, std::string> parameters;
};

struct Reply {
  int status = 200;  ///< of HTTP
  std::string type;  ///< of the body
  std::shared_ptr<const std::string> body;
};
Reply json_reply(int status, const nlohmann::ordered_json& json);

/// Answers what docs/viewer.md lists, of one roadmap: for the server, and for the page that is one
/// file, where it runs in the page. Thread-safe. Never throws for what it is asked: bad questions
/// have a status and {"error": ..} naming the parameter and a remedy.
class MapAnswers {
 public:
  /// The roadmap must outlive it. `name`: of its file, for people.
  MapAnswers(const Roadmap& roadmap, const std::string& name);

  Reply answer(const Question& question);

 private:
  /// What is made when it is first asked for, and kept.
  struct Kept {
    std::once_flag once;
    std::shared_ptr<const std::string> body;
  };
  Reply kept(Kept& kept, const char* type, const std::function<std::string()>& make);

  const ComponentReport& components();
  std::string info();
  std::string narrow_places();
  Reply components_of(const std::string& layer);
  std::string components_of_places(bool of_graph);
  nlohmann::ordered_json plan(const Question& question);
  nlohmann::ordered_json trajectory(const Question& question);
  nlohmann::ordered_json place(const Question& question);
  /// Adds why there is no route to an answer, if the question wants to know.
  void explain(const Question& question, const PlanConfig& asked, const Query& query,
               PlanStatus status, nlohmann::ordered_json& json);

  const Roadmap& roadmap_;
  const std::string name_;
  Kept info_, surface_, coarse_surface_, diagram_, gvd_, graph_, narrow_, diagram_components_,
      graph_components_;
  std::once_flag components_once_;
  ComponentReport components_;  // `asked`: of the diagram's voxels, then of the vertices
  std::mutex facts_mutex_;
  AnswerFacts facts_;
};

}  // namespace ridgeway::cli
