// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <algorithm>
#include <limits>

#include "command.hpp"
#include "common/number_text.hpp"
#include "nearest_word.hpp"
#include "option_facts.hpp"

namespace ridgeway::cli {
namespace {

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

}  // namespace

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
                      const std::string& help, const std::string& shown) {
  return add_option(names, {.type = "point", .shown = shown, .help = help},
                    [&value, shown](const std::string& text, const std::string& name) {
                      value = parse_point(text, name, shown);
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

}  // namespace ridgeway::cli
