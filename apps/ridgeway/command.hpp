// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): theirs
class App;
class Option;
}  // namespace CLI

namespace ridgeway::cli {

inline constexpr int kExitDone = 0;
inline constexpr int kExitBadInput = 1;
inline constexpr int kExitNoPlan = 2;

/// Options that every command has.
struct Globals {
  bool json = false;   ///< stdout is exactly one JSON object
  bool quiet = false;  ///< neither notes nor warnings nor progress
  int threads = 0;     ///< 0: all of the machine's
};

/// What was asked for; returns the exit code.
using Job = std::function<int()>;

struct OptionFacts;
struct Program;

/// An option that a command has.
class Option {
 public:
  Option& required();
  /// Not both may be given.
  Option& excludes(const Option& other);
  bool is_given() const;
  std::string name() const;  ///< "--radius", "map"

 private:
  friend class Command;
  Option(CLI::Option* option, std::shared_ptr<OptionFacts> facts)
      : option_(option), facts_(std::move(facts)) {}

  CLI::Option* option_;
  std::shared_ptr<OptionFacts> facts_;
};

/// A command of the program, or the program itself, and the options it has. Here alone words of the
/// command line become values: one that is empty, or not what its option holds, throws InputError
/// with the option, the text and what to give. The parser of command lines is seen by
/// command.cpp only, as it takes long to compile; command_options.cpp has what reads values.
///
/// Options are named as "-o,--output", positional ones as "map". What they write to must live until
/// the job has run; its value before is the default that the help shows.
class Command {
 public:
  explicit Command(std::shared_ptr<Program> program, CLI::App& app);

  /// A command of this one.
  Command add(const std::string& name, const std::string& help);
  /// One of its commands must be given.
  void require_command();
  /// Shown at the end of its help.
  void footer(const std::string& text);

  Option flag(const std::string& name, bool& value, const std::string& help);
  /// The name of a file or a folder.
  Option path(const std::string& names, std::string& value, const std::string& help);
  Option paths(const std::string& names, std::vector<std::string>& values, const std::string& help);
  Option choice(const std::string& names, std::string& value,
                const std::vector<std::string>& choices, const std::string& help);
  /// One of the choices, or a number.
  Option choice_or_number(const std::string& names, std::string& choice,
                          const std::vector<std::string>& choices, std::optional<double>& value,
                          Range range, const std::string& help);
  /// Several between commas.
  Option choices(const std::string& names, std::vector<std::string>& values,
                 const std::vector<std::string>& choices, const std::string& help);
  Option number(const std::string& names, double& value, Range range, const std::string& help);
  Option number(const std::string& names, std::optional<double>& value, Range range,
                const std::string& help);
  /// Several between commas.
  Option numbers(const std::string& names, std::vector<double>& values, Range range,
                 const std::string& help);
  template <typename Whole>
  Option whole(const std::string& names, Whole& value, Wholes range, const std::string& help) {
    return add_whole(names, range, help, std::to_string(value),
                     [&value](std::uint64_t number) { value = static_cast<Whole>(number); });
  }
  template <typename Whole>
  Option whole(const std::string& names, std::optional<Whole>& value, Wholes range,
               const std::string& help) {
    return add_whole(names, range, help, "",
                     [&value](std::uint64_t number) { value = static_cast<Whole>(number); });
  }
  /// Several between commas.
  Option wholes(const std::string& names, std::vector<int>& values, Wholes range,
                const std::string& help);
  Option point(const std::string& names, std::optional<Point>& value, const std::string& help,
               const std::string& shown = "X,Y,Z");
  /// So many numbers between commas, which the help shows as "fx,fy,cx,cy".
  Option tuple(const std::string& names, std::vector<double>& values, std::size_t count,
               const std::string& shown, const std::string& help);
  /// Given several times.
  Option points(const std::string& names, std::vector<Point>& values, const std::string& help);
  Option box(const std::string& names, std::optional<Box>& value, const std::string& help);
  Option boxes(const std::string& names, std::vector<Box>& values, const std::string& help);
  Option transform(const std::string& names, std::optional<Transform>& value,
                   const std::string& help);
  /// --seed, any whole number.
  Option seed(std::uint64_t& value, const std::string& help);

  /// What to do when it is given.
  template <typename Options>
  void runs(const std::shared_ptr<Options>& options, int (*run)(const Options&, const Globals&)) {
    const Globals& globals = this->globals();
    set_job([options, &globals, run] { return run(*options, globals); });
  }

 private:
  using Reader = std::function<void(const std::string& text, const std::string& name)>;

  const Globals& globals() const;
  void set_job(Job job);
  Option add_option(const std::string& names, OptionFacts facts, const Reader& read);
  Option add_whole(const std::string& names, Wholes range, const std::string& help,
                   const std::string& initial, const std::function<void(std::uint64_t)>& set);

  std::shared_ptr<Program> program_;
  CLI::App* app_;
};

/// The command line as a whole.
class CommandLine {
 public:
  CommandLine(const std::string& name, const std::string& help, const std::string& version);

  Command root() const;
  Globals& globals() const;

  /// What the words ask for, help and version too: --help with --json describes every command and
  /// every option. Throws InputError for words that are not understood.
  Job parse(std::vector<std::string> words);

  /// What the command was given to work on, for errors; empty where nothing was.
  const std::string& subject() const;

  /// An error of the library, whose fields are named as the options of the command that was given.
  InputError with_options(const InputError& error) const;

 private:
  std::shared_ptr<Program> program_;
};

}  // namespace ridgeway::cli
