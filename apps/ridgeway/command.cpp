// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <utility>

#include "console.hpp"
#include "json.hpp"
#include "nearest_word.hpp"
#include "option_facts.hpp"
#include "option_names.hpp"

namespace ridgeway::cli {

/// What all commands share.
struct Program {
  Program(const std::string& name, const std::string& help) : app(help, name) {}

  struct Entry {
    const CLI::App* command;
    CLI::Option* option;
    std::shared_ptr<OptionFacts> facts;
  };

  CLI::App app;
  std::string version;
  Globals globals;
  Job job;
  std::string subject;  // the first positional value
  std::vector<Entry> options;
};

namespace {

using Json = nlohmann::ordered_json;

constexpr int kAnyNumber = CLI::detail::expected_max_vector_size;

/// "--output" of "-o,--output".
std::string long_name(const std::string& names) {
  return names.substr(names.rfind(',') == std::string::npos ? 0 : names.rfind(',') + 1);
}

/// The command that was given, of all that were named the last.
CLI::App* last_command(CLI::App& app) {
  CLI::App* last = &app;
  while (!last->get_subcommands().empty()) last = last->get_subcommands().front();
  return last;
}

/// "ridgeway bench hall".
std::string path_of(const CLI::App& command) {
  return command.get_parent() == nullptr
             ? command.get_name()
             : path_of(*command.get_parent()) + " " + command.get_name();
}

std::string see_help(const CLI::App& command) { return "see " + path_of(command) + " --help"; }

[[noreturn]] void refuse_word(CLI::App& command, const std::string& word) {
  std::vector<std::string> known;
  const bool is_option = word.starts_with('-');
  if (is_option) {
    for (const CLI::App* app = &command; app != nullptr; app = app->get_parent())
      for (const CLI::Option* option : app->get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  } else {
    for (const CLI::App* app : command.get_subcommands({})) known.push_back(app->get_name());
  }
  const std::string nearest = nearest_word(word.substr(0, word.find('=')), known);
  const std::string remedy =
      (nearest.empty() ? "" : "did you mean " + nearest + "? ") + see_help(command);
  if (is_option)
    throw InputError(in_quotes(word), "there is no such option of " + path_of(command), remedy);
  if (!known.empty()) throw InputError(in_quotes(word), "there is no such command", remedy);
  throw InputError(in_quotes(word), "is one argument too many", remedy);
}

Json json_of(const Program::Entry& entry) {
  const OptionFacts& facts = *entry.facts;
  Json json = {{"name", entry.option->get_positional() ? entry.option->get_name()
                                                       : "--" + entry.option->get_lnames().front()},
               {"positional", entry.option->get_positional()}};
  if (!entry.option->get_snames().empty()) json["short"] = "-" + entry.option->get_snames().front();
  json["type"] = facts.type;
  json["help"] = facts.help;
  json["required"] = entry.option->get_required();
  json["repeated"] = facts.repeated;
  if (!facts.initial.empty()) json["default"] = facts.initial;
  if (!facts.choices.empty()) json["choices"] = facts.choices;
  if (facts.wholes) {
    json["least"] = facts.wholes->least;
    json["most"] = facts.wholes->most;
  }
  if (facts.range) {
    json["least"] = facts.range->least;
    json["least_allowed"] = !facts.range->above;
    json["most"] = facts.range->most;
    json["infinite_allowed"] = facts.range->endless;
  }
  return json;
}

/// A command with its options and its own commands.
Json describe(const Program& program, const CLI::App& command) {
  Json json = {{"name", command.get_name()}, {"help", command.get_description()}};
  if (const std::string& footer = command.get_footer(); !footer.empty()) json["footer"] = footer;
  json["options"] = Json::array();
  for (const Program::Entry& entry : program.options)
    if (entry.command == &command) json["options"].push_back(json_of(entry));
  json["commands"] = Json::array();
  for (const CLI::App* inner : command.get_subcommands([](const CLI::App*) { return true; }))
    json["commands"].push_back(describe(program, *inner));
  return json;
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

bool Option::is_given() const { return option_->count() > 0; }

std::string Option::name() const { return option_->get_name(); }

Command::Command(std::shared_ptr<Program> program, CLI::App& app)
    : program_(std::move(program)), app_(&app) {}

const Globals& Command::globals() const { return program_->globals; }

void Command::set_job(Job job) {
  app_->callback([program = program_.get(), job = std::move(job)] { program->job = job; });
}

Command Command::add(const std::string& name, const std::string& help) {
  return Command(program_, *app_->add_subcommand(name, help));
}

void Command::require_command() { app_->require_subcommand(1)->fallthrough(); }

void Command::footer(const std::string& text) {
  const bool is_program = app_->get_parent() == nullptr;
  app_->footer((is_program ? ""
                           : "Every command has --json, --quiet and --threads N: see " +
                                 program_->app.get_name() + " --help.\n") +
               text);
}

Option Command::add_option(const std::string& names, OptionFacts facts, const Reader& read) {
  const auto shared = std::make_shared<OptionFacts>(std::move(facts));
  const bool positional = names.front() != '-';
  const auto take = [read, name = long_name(names), positional,
                     program = program_.get()](const CLI::results_t& texts) {
    for (const std::string& text : texts) {
      if (positional && program->subject.empty()) program->subject = text;
      if (text.empty())
        throw InputError(name + " ''", "is empty", "give a value, or leave the option out");
      read(text, name);
    }
    return true;
  };
  CLI::Option* option = app_->add_option(names, CLI::callback_t(take), shared->help);
  option->type_name(shared->shown);
  if (!shared->initial.empty()) option->default_str(shared->initial);
  if (shared->repeated) option->expected(1, kAnyNumber)->allow_extra_args(positional);
  program_->options.push_back({app_, option, shared});
  return {option, shared};
}

Option Command::flag(const std::string& name, bool& value, const std::string& help) {
  CLI::Option* option = app_->add_flag(name, value, help);
  const auto facts = std::make_shared<OptionFacts>(OptionFacts{.type = "flag", .help = help});
  program_->options.push_back({app_, option, facts});
  return {option, facts};
}

CommandLine::CommandLine(const std::string& name, const std::string& help,
                         const std::string& version)
    : program_(std::make_shared<Program>(name, help)) {
  program_->version = name + " " + version;
  program_->app.set_version_flag("--version", program_->version);
  program_->app.require_subcommand(0, 1);
  program_->app.fallthrough();
}

Command CommandLine::root() const { return Command(program_, program_->app); }

Globals& CommandLine::globals() const { return program_->globals; }

const std::string& CommandLine::subject() const { return program_->subject; }

Job CommandLine::parse(std::vector<std::string> words) {
  CLI::App& app = program_->app;
  try {
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app.parse(std::move(words));
  } catch (const CLI::CallForVersion&) {
    return [program = program_] {
      std::printf("%s\n", program->version.c_str());
      return kExitDone;
    };
  } catch (const CLI::CallForHelp&) {
    return [program = program_] {
      if (program->globals.json)
        print_json(describe(*program, *last_command(program->app)));
      else
        std::printf("%s", program->app.help().c_str());
      return kExitDone;
    };
  } catch (const CLI::ParseError& error) {
    CLI::App& command = *last_command(app);
    if (const auto unknown = app.remaining(true); !unknown.empty())
      refuse_word(command, unknown.front());
    throw InputError(path_of(command), error.what(), see_help(command));
  }
  if (!program_->job)
    throw InputError("no command was given", "there is nothing to do", see_help(app));
  return program_->job;
}

InputError CommandLine::with_options(const InputError& error) const {
  std::vector<std::string> options;
  const auto add = [&](const CLI::App& command) {
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  };
  add(*last_command(program_->app));
  if (error.remedy().starts_with("build the map")) add(*program_->app.get_subcommand("build"));
  return with_option_names(error, options);
}

}  // namespace ridgeway::cli
