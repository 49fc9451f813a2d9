// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <system_error>

#include "commands.hpp"
#include "console.hpp"
#include "interruption.hpp"
#include "json.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "view/browser.hpp"
#include "view/map_answers.hpp"
#include "view/server.hpp"

namespace ridgeway::cli {
namespace {

struct ViewOptions {
  std::string file;
  int port = 0;
  bool open = false;
};

/// Of a file that is written again another one.
std::string word_for_map(const std::string& file, std::filesystem::file_time_type written) {
  const std::string text = file + ' ' + std::to_string(written.time_since_epoch().count());
  return std::to_string(std::hash<std::string>{}(text));
}

int run(const ViewOptions& options, const Globals& globals) {
  std::error_code error;  // what is wrong with the file, loading tells
  const auto written = std::filesystem::last_write_time(options.file, error);
  const Roadmap roadmap = load_roadmap(options.file);
  require_page("view");
  stop_if_interrupted();
  MapAnswers answers(roadmap, std::filesystem::path(options.file).filename().string());
  const PageServer server(
      {.map = word_for_map(options.file, written),
       .answer = [&](const Question& question) { return answers.answer(question); }},
      options.port, is_interrupted);
  const std::string address = address_of(server.port());
  if (globals.json)
    print_json({{"address", address}});
  else
    print_row("open", address + " (Ctrl-C ends it)");
  std::fflush(stdout);
  if (options.open) open_page(address, globals);
  server.wait();
  return kExitDone;
}

}  // namespace

void add_view_command(Command& program) {
  const auto options = std::make_shared<ViewOptions>();
  Command command = program.add(
      "view", "Show a roadmap in a browser: look at it, and plan by clicking at start and goal");
  command.path("roadmap", options->file, "Roadmap, .ridge").required();
  command.whole("--port", options->port, {0, 65535}, "Port to serve at, 0 for any that is free");
  command.flag("--open", options->open, "Open it in the browser of the desktop");
  command.footer(
      "Serves this machine alone, until it is interrupted. `ridgeway export MAP.ridge -o "
      "map.html`\n"
      "writes the same page as one file.\n"
      "Example:\n"
      "  ridgeway view office.ridge --open");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
