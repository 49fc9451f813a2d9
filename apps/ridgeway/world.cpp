// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "json.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/formats/world_file.hpp"
#include "sensing/world_generators.hpp"

namespace ridgeway::cli {
namespace {

struct WorldOptions {
  std::string kind, output;
  std::uint64_t seed = 1;
  std::vector<Option> of_random_worlds;
};

int run(const WorldOptions& options, const Globals& globals) {
  require_extension(options.output, "a world", {".yaml", ".yml"});
  for (const Option& option : options.of_random_worlds)
    if (option.is_given() && options.kind == "house")
      throw InputError(option.name(), "is of mazes and halls: there is one house", "leave it out");
  require_writable({options.output}, {});
  const World world = options.kind == "maze"   ? make_maze({.seed = options.seed})
                      : options.kind == "hall" ? make_hall({.seed = options.seed})
                                               : make_house();
  save_world(world, options.output);
  const std::size_t solids =
      world.planes.size() + world.boxes.size() + world.spheres.size() + world.cylinders.size();
  if (globals.json) {
    print_json({{"file", options.output}, {"name", world.name}, {"solids", solids}});
  } else {
    print_row("world", world.name + ", " + count_text(solids) + " solids");
    print_row("file", options.output);
  }
  return kExitDone;
}

}  // namespace

void add_world_command(Command& program) {
  const auto options = std::make_shared<WorldOptions>();
  Command command = program.add("world", "Make a simulated world: the house, or one from a seed");
  command
      .choice("kind", options->kind, {"maze", "hall", "house"},
              "A maze of 30 x 30 m, a machine hall of 20 x 22 m, or the house of 15 x 10 m")
      .required();
  command.path("-o,--output", options->output, "World to write, .yaml").required();
  options->of_random_worlds = {
      command.seed(options->seed, "Of mazes and halls: another seed, another world")};
  command.footer(
      "Example:\n"
      "  ridgeway world maze --seed 7 -o maze.yaml");
  command.runs(options, run);
}

}  // namespace ridgeway::cli
