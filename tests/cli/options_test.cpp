// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>

#include "program.hpp"

namespace ridgeway {
namespace {

class CliOptions : public Program {
 protected:
  /// The program's own description of itself.
  Json description() { return run({"--help", "--json"}).json(); }

  /// Calls visit(words of the command, its description) for every command that can be run.
  template <typename Visit>
  static void for_each_command(const Json& command, const std::vector<std::string>& words,
                               const Visit& visit) {
    if (command["commands"].empty()) visit(words, command);
    for (const Json& inner : command["commands"]) {
      std::vector<std::string> longer = words;
      longer.push_back(inner["name"]);
      for_each_command(inner, longer, visit);
    }
  }

  /// Exit code 1, one line that names the option, and no file.
  void expect_option_refused(std::vector<std::string> words, const Json& option,
                             const std::string& value) {
    const std::string name = option["name"];
    if (option["positional"])
      words.push_back(value);
    else
      words.insert(words.end(), {name, value});
    // A word that begins with a dash is no positional; of a list of words the first bad one is
    // named.
    const bool is_unknown_option = option["positional"] && value.starts_with("-");
    const bool is_list = option["type"] == "choices";
    const std::string word = is_list ? value.substr(0, value.find(',')) : value;
    expect_refused_here(words, {(is_unknown_option ? "'" : name + " '") + word + "'"});
  }
};

TEST_F(CliOptions, AreRefusedByTheProgramAsWithinThisProcess) {
  const std::vector<std::vector<std::string>> refused = {
      {}, {"castle"}, {"plan", "--radius", "nan"}, {"build", "--bounds="}, {"info"}, {"info", ""}};
  for (const std::vector<std::string>& words : refused) {
    const Outcome there = run(words), here = run_here(words);
    EXPECT_EQ(there.code, 1);
    EXPECT_EQ(there.code, here.code);
    EXPECT_EQ(there.err, here.err);
    EXPECT_EQ(there.out, here.out);
  }
}

const std::vector<std::string> kNoNumbers = {"",       "nan",     "-nan",   "abc", "1x",
                                             "1e-310", "-5e-324", "1e9999", "1,",  "0x10"};

/// Whether an option may hold a number, by its description.
bool may_hold(const Json& option, double value) {
  const double least = option["least"], most = option["most"];
  if (std::isinf(value)) return value > 0 && option.value("infinite_allowed", false);
  return value <= most && (option.value("least_allowed", true) ? value >= least : value > least);
}

bool holds_numbers(const Json& option) {
  const std::string type = option["type"];
  return type == "number" || type == "numbers" || type == "whole" || type == "wholes";
}

TEST_F(CliOptions, EveryNumberRefusesWhatItCannotHold) {
  std::size_t tried = 0;
  const auto try_all = [&](const std::vector<std::string>& words, const Json& command) {
    for (const Json& option : command["options"]) {
      if (!holds_numbers(option)) continue;
      for (const std::string& value : kNoNumbers) {
        expect_option_refused(words, option, value);
        ++tried;
      }
      for (const char* value : {"inf", "-inf", "-1", "1e308", "-1e308", "100000000000000000000"}) {
        if (may_hold(option, std::strtod(value, nullptr))) continue;
        expect_option_refused(words, option, value);
        ++tried;
      }
    }
  };
  const Json program = description();
  for_each_command(program, {}, try_all);
  for (const Json& option : program["options"])
    if (holds_numbers(option)) expect_option_refused({"info", "x"}, option, "nan");
  EXPECT_GT(tried, 700u);
}

TEST_F(CliOptions, EveryOtherOptionRefusesWhatItCannotHold) {
  std::size_t tried = 0;
  for_each_command(
      description(), {}, [&](const std::vector<std::string>& words, const Json& command) {
        for (const Json& option : command["options"]) {
          const std::string type = option["type"];
          if (type == "flag" || holds_numbers(option)) continue;
          expect_option_refused(words, option, "");
          ++tried;
          if (type == "path") continue;
          for (const char* value :
               {"nan", "inf", "-inf", "1e-310", "1e308", "-1", "abc", "1,nan,2", "1e308,0,0"})
            expect_option_refused(words, option, value);
        }
      });
  EXPECT_GT(tried, 50u);
}

TEST_F(CliOptions, TheNumberOfAnyOptionIsRefusedAsAnEmptyWord) {
  for_each_command(description(), {}, [&](std::vector<std::string> words, const Json& command) {
    for (const Json& option : command["options"]) {
      if (option["positional"] || option["type"] == "flag") continue;
      const std::string name = option["name"];
      words.push_back(name + "=");
      expect_refused_here(words, {name, "is empty"});
      words.pop_back();
    }
  });
}

TEST_F(CliOptions, DescriptionHoldsWhatTheHelpShows) {
  std::size_t commands = 0;
  for_each_command(description(), {}, [&](std::vector<std::string> words, const Json& command) {
    ++commands;
    words.emplace_back("--help");
    const Outcome help = run(words);
    EXPECT_EQ(help.code, 0);
    EXPECT_FALSE(command["help"].get<std::string>().empty());
    for (const Json& option : command["options"]) {
      const std::string name = option["name"];
      EXPECT_NE(help.out.find(name), std::string::npos) << name << "\n" << help.out;
      EXPECT_FALSE(option["help"].get<std::string>().empty()) << name;
    }
  });
  EXPECT_EQ(commands, 20u);
  const Json plan = run({"plan", "--json", "--help"}).json();
  EXPECT_EQ(plan["name"], "plan");
}

TEST_F(CliOptions, HelpIsACommandToo) {
  EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
  EXPECT_EQ(run({"help", "bench", "maze"}).out, run({"bench", "maze", "--help"}).out);
}

TEST_F(CliOptions, MisspeltWordsNameWhatWasMeant) {
  expect_refused({"biuld", "map.bt", "-o", "x.ridge"},
                 {"'biuld'", "no such command", "did you mean build?"});
  expect_refused({"bench", "nosie"}, {"'nosie'", "no such command", "did you mean noise?"});
  expect_refused({"traj", "x.ridge"}, {"did you mean trajectory?"});
  expect_refused({"castle"}, {"'castle'", "no such command", "ridgeway --help"});
  expect_refused({"plan", "x.ridge", "--radus", "1"}, {"'--radus'", "did you mean --radius?"});
  expect_refused({"plan", "x.ridge", "y.ridge"}, {"'y.ridge'", "one argument too many"});
  expect_refused({"plan", "x.ridge", "--planner", "rrtconect"}, {"did you mean rrtconnect?"});
}

TEST_F(CliOptions, NegativeValuesAreValues) {
  for (const char* value : {"-1", "-.5", "-inf", "-nan"})
    expect_refused({"trajectory", "x.ridge", "--step", value},
                   {std::string("--step '") + value + "'"});
}

TEST_F(CliOptions, ErrorsOfTheLibraryNameOptions) {
  const std::string map = rooms();
  expect_refused({"build", two_rooms(), "-o", path("o.ridge"), "--bounds", "-3,-2,0,3,2,2"},
                 {"give --voxel-size"});
  expect_refused({"build", two_rooms(), "-o", path("o.ridge"), "--voxel-size", "0.1"},
                 {"give --bounds"});
  expect_refused({"build", kScan, "-o", path("o.ridge"), "--min-clearance", "9"},
                 {"--min-clearance 9", "give a smaller --min-clearance, or --unknown ignore"});
  expect_refused({"plan", map, "--from", "1,0,1", "--to", "2,0,1", "--planner", "rrtstar",
                  "--time-limit", "inf"},
                 {"--time-limit", "--iteration-limit"});
  expect_refused({"plan", map, "--from", "1,0,1", "--to", "2,0,1", "--planner", "rrtconnect",
                  "--range", "1e-4"},
                 {"--range", "voxel"});
}

TEST_F(CliOptions, LibraryNamesNoOption) {
  const std::regex option("\"[^\"]*--[a-z][^\"]*\"");
  std::size_t files = 0;
  for (const char* folder : {"src", "include"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             std::filesystem::path(RIDGEWAY_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      ++files;
      std::istringstream text(read_whole(entry.path()));
      for (std::string line; std::getline(text, line);)
        EXPECT_FALSE(std::regex_search(line, option)) << entry.path() << ": " << line;
    }
  EXPECT_GT(files, 100u);
}

}  // namespace
}  // namespace ridgeway
