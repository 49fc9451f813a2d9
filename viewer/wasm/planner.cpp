// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// The planner for WebAssembly: answers the page's questions of one roadmap, where it runs.
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "ridgeway/common/error.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "view/map_answers.hpp"

namespace {

using namespace ridgeway;

std::unique_ptr<Roadmap> roadmap;
std::unique_ptr<cli::MapAnswers> answers;
cli::Reply reply;

}  // namespace

extern "C" {

/// Reads the roadmap of a file of emscripten's; 200, or the status of an error.
int planner_load(const char* file, const char* name) {
  try {
    roadmap = std::make_unique<Roadmap>(load_roadmap(file));
    answers = std::make_unique<cli::MapAnswers>(*roadmap, name);
    reply = cli::json_reply(200, {{"name", name}});
  } catch (const std::exception& error) {
    reply = cli::json_reply(400, {{"error", error.what()}});
  }
  return reply.status;
}

/// `parameters`: a JSON object of texts. The status.
int planner_ask(const char* path, const char* parameters) {
  cli::Question question{path, {}};
  const auto given = nlohmann::json::parse(parameters, nullptr, false);
  for (const auto& [name, value] : given.items())
    question.parameters.emplace(name, value.get<std::string>());
  reply = answers->answer(question);
  return reply.status;
}

/// Of the last answer.
const char* planner_bytes() { return reply.body->data(); }
std::size_t planner_size() { return reply.body->size(); }
}
