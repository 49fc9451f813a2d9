// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

#include "common/number_text.hpp"
#include "console.hpp"
#include "json.hpp"
#include "nearest_word.hpp"
#include "option_names.hpp"

namespace ridgeway::cli {

/// What is known of an option, to describe it.
struct OptionFacts {
  std::string type = {};   ///< of its value, one word
  std::string shown = {};  ///< the same in the help
  std::string help = {};
  std::string initial = {};  ///< as it would be given; empty: none
  bool repeated = false;
  std::vector<std::string> choices = {};
  std::optional<Range> range = {};
  std::optional<Wholes> wholes = {};
};

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

template <typename Values, typename Text>
std::string joined(const Values& values, const char* separator, const Text& text_of_value) {
  std::string text;
  for (const auto& value : values)
    text.append(text.empty() ? "" : separator).append(text_of_value(value));
  return text;
}

std::string joined(const std::vector<std::string>& words, const char* separator) {
  return joined(words, separator, [](const std::string& word) { return word; });
}

/// Between commas, none of them empty.
std::vector<std::string> split(const std::string& text, const std::string& name) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    if (words.back().empty())
      throw InputError(name + " " + in_quotes(text), "has an empty place",
                       "give values and commas");
    begin = end + 1;
  }
  return words;
}

void require_choice(const std::string& text, const std::string& name,
                    const std::vector<std::string>& choices) {
  if (std::find(choices.begin(), choices.end(), text) != choices.end()) return;
  const std::string nearest = nearest_word(text, choices);
  throw InputError(name + " " + in_quotes(text), "is none of " + joined(choices, ", "),
                   nearest.empty() ? "give one of them" : "did you mean " + nearest + "?");
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

Option Command::path(const std::string& names, std::string& value, const std::string& help) {
  return add_option(names, {.type = "path", .shown = "PATH", .help = help, .initial = value},
                    [&value](const std::string& text, const std::string&) { value = text; });
}

Option Command::paths(const std::string& names, std::vector<std::string>& values,
                      const std::string& help) {
  return add_option(
      names, {.type = "path", .shown = "PATH", .help = help, .repeated = true},
      [&values](const std::string& text, const std::string&) { values.push_back(text); });
}

Option Command::choice(const std::string& names, std::string& value,
                       const std::vector<std::string>& choices, const std::string& help) {
  return add_option(names,
                    {.type = "choice",
                     .shown = joined(choices, "|"),
                     .help = help,
                     .initial = value,
                     .choices = choices},
                    [&value, choices](const std::string& text, const std::string& name) {
                      require_choice(text, name, choices);
                      value = text;
                    });
}

Option Command::choice_or_number(const std::string& names, std::string& choice,
                                 const std::vector<std::string>& choices,
                                 std::optional<double>& value, Range range,
                                 const std::string& help) {
  return add_option(
      names,
      {.type = "choice",
       .shown = joined(choices, "|") + "|NUMBER",
       .help = help,
       .initial = choice,
       .choices = choices},
      [=, &choice, &value](const std::string& text, const std::string& name) {
        if (!text.empty() && text.find_first_not_of("0123456789.eE+-") == std::string::npos) {
          value = parse_number(text, range, name);
        } else {
          require_choice(text, name, choices);
          choice = text;
        }
      });
}

Option Command::choices(const std::string& names, std::vector<std::string>& values,
                        const std::vector<std::string>& choices, const std::string& help) {
  return add_option(names,
                    {.type = "choices",
                     .shown = joined(choices, "|") + ",...",
                     .help = help,
                     .initial = joined(values, ","),
                     .choices = choices},
                    [&values, choices](const std::string& text, const std::string& name) {
                      values = split(text, name);
                      for (const std::string& word : values) require_choice(word, name, choices);
                    });
}

Option Command::number(const std::string& names, double& value, Range range,
                       const std::string& help) {
  return add_option(names,
                    {.type = "number",
                     .shown = "NUMBER",
                     .help = help,
                     .initial = number_text(value),
                     .range = range},
                    [&value, range](const std::string& text, const std::string& name) {
                      value = parse_number(text, range, name);
                    });
}

Option Command::number(const std::string& names, std::optional<double>& value, Range range,
                       const std::string& help) {
  return add_option(names, {.type = "number", .shown = "NUMBER", .help = help, .range = range},
                    [&value, range](const std::string& text, const std::string& name) {
                      value = parse_number(text, range, name);
                    });
}

Option Command::numbers(const std::string& names, std::vector<double>& values, Range range,
                        const std::string& help) {
  return add_option(names,
                    {.type = "numbers",
                     .shown = "NUMBER,...",
                     .help = help,
                     .initial = joined(values, ",", number_text<double>),
                     .range = range},
                    [&values, range](const std::string& text, const std::string& name) {
                      values.clear();
                      for (const std::string& word : split(text, name))
                        values.push_back(parse_number(word, range, name));
                    });
}

Option Command::add_whole(const std::string& names, Wholes range, const std::string& help,
                          const std::string& initial,
                          const std::function<void(std::uint64_t)>& set) {
  const bool any = range.most == std::numeric_limits<std::uint64_t>::max();
  const std::string shown =
      any ? "N" : "N in " + number_text(range.least) + ".." + number_text(range.most);
  return add_option(
      names, {.type = "whole", .shown = shown, .help = help, .initial = initial, .wholes = range},
      [set, range](const std::string& text, const std::string& name) {
        set(parse_whole(text, range, name));
      });
}

Option Command::wholes(const std::string& names, std::vector<int>& values, Wholes range,
                       const std::string& help) {
  return add_option(names,
                    {.type = "wholes",
                     .shown = "N,...",
                     .help = help,
                     .initial = joined(values, ",", number_text<int>),
                     .wholes = range},
                    [&values, range](const std::string& text, const std::string& name) {
                      values.clear();
                      for (const std::string& word : split(text, name))
                        values.push_back(static_cast<int>(parse_whole(word, range, name)));
                    });
}

Option Command::tuple(const std::string& names, std::vector<double>& values, std::size_t count,
                      const std::string& shown, const std::string& help) {
  return add_option(names, {.type = "tuple", .shown = shown, .help = help},
                    [&values, count, shown](const std::string& text, const std::string& name) {
                      values = parse_numbers(text, name);
                      if (values.size() != count)
                        throw InputError(name + " " + in_quotes(text),
                                         "is not " + std::to_string(count) + " numbers",
                                         "give " + shown);
                    });
}

Option Command::point(const std::string& names, std::optional<Point>& value,
                      const std::string& help) {
  return add_option(names, {.type = "point", .shown = "X,Y,Z", .help = help},
                    [&value](const std::string& text, const std::string& name) {
                      value = parse_point(text, name);
                    });
}

Option Command::points(const std::string& names, std::vector<Point>& values,
                       const std::string& help) {
  return add_option(names, {.type = "point", .shown = "X,Y,Z", .help = help, .repeated = true},
                    [&values](const std::string& text, const std::string& name) {
                      values.push_back(parse_point(text, name));
                    });
}

Option Command::box(const std::string& names, std::optional<Box>& value, const std::string& help) {
  return add_option(
      names,
      {.type = "box", .shown = "BOX", .help = help, .initial = value ? box_text(*value) : ""},
      [&value](const std::string& text, const std::string& name) {
        value = parse_box(text, name);
      });
}

Option Command::boxes(const std::string& names, std::vector<Box>& values, const std::string& help) {
  return add_option(names, {.type = "box", .shown = "BOX", .help = help, .repeated = true},
                    [&values](const std::string& text, const std::string& name) {
                      values.push_back(parse_box(text, name));
                    });
}

Option Command::transform(const std::string& names, std::optional<Transform>& value,
                          const std::string& help) {
  return add_option(names, {.type = "transform", .shown = "TRANSFORM", .help = help},
                    [&value](const std::string& text, const std::string& name) {
                      value = Transform{text, parse_transform(text, name)};
                    });
}

Option Command::seed(std::uint64_t& value, const std::string& help) {
  return whole("--seed", value, {0, std::numeric_limits<std::uint64_t>::max()}, help);
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
