// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "option_names.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace ridgeway::cli {
namespace {

struct Naming {
  std::string_view option;
  std::string_view library, command_line;
};

// What is not named as its option is, but for - in place of _.
constexpr Naming kNamings[] = {
    {"--isolated", "isolated_below", "--isolated"},
    {"--sigma", "range_sigma", "--sigma"},
    {"--from-velocity", "start_velocity", "--from-velocity"},
    {"--yaw", "start_yaw", "--yaw"},
    {"--derivative", "smoothness", "--derivative"},
    // Fields that are words of the language, too, with those around them.
    {"--bounds", "give bounds", "give --bounds"},
    {"--units", "give units", "give --units"},
    {"--bounds", "larger bounds", "larger --bounds"},
    {"--bounds", "cut the map down to a smaller box", "smaller --bounds"},
    {"--voxel-size", "use larger voxels", "give a larger --voxel-size"},
    {"--bounds", "check bounds,", "check --bounds,"},
    {"--exclude", ", exclude and", ", --exclude and"},
    {"--unknown", "ignore the unknown", "--unknown ignore"}};

bool is_part_of_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '/' ||
         c == '.';
}

/// Every place where the field stands as a word of its own.
void replace_word(std::string& text, std::string_view field, std::string_view option) {
  for (std::size_t at = text.find(field); at != std::string::npos; at = text.find(field, at)) {
    const std::size_t end = at + field.size();
    const bool is_word = (at == 0 || !is_part_of_word(text[at - 1])) &&
                         (end == text.size() || !is_part_of_word(text[end]));
    if (is_word) text.replace(at, field.size(), option);
    at += is_word ? option.size() : field.size();
  }
}

/// Whether a text begins with a field, as "radius" or "radius 0.3".
bool begins_with(std::string_view text, std::string_view field) {
  return text.starts_with(field) && (text.size() == field.size() || text[field.size()] == ' ');
}

}  // namespace

InputError with_option_names(const InputError& error, const std::vector<std::string>& options) {
  std::string where = error.where(), problem = error.problem(), remedy = error.remedy();
  const auto replace = [&](std::string_view library, std::string_view command_line) {
    replace_word(problem, library, command_line);
    replace_word(remedy, library, command_line);
  };
  for (const std::string& option : options) {
    std::string field = option.substr(2);
    std::replace(field.begin(), field.end(), '-', '_');
    if (begins_with(where, field)) where.replace(0, field.size(), option);
    if (field.find('_') != std::string::npos) replace(field, option);  // no word of the language
    for (const Naming& naming : kNamings) {
      if (naming.option != option) continue;
      if (begins_with(where, naming.library)) where.replace(0, naming.library.size(), option);
      replace(naming.library, naming.command_line);
    }
  }
  return {where, problem, remedy};
}

std::string with_option_names(std::string note) {
  constexpr std::string_view kOne = "(option ", kSeveral = "(options ";
  for (std::size_t at = note.find("(option"); at != std::string::npos;
       at = note.find("(option", at + 1)) {
    const bool several = note.compare(at, kSeveral.size(), kSeveral) == 0;
    std::size_t word = at + 1;
    note.erase(word, (several ? kSeveral : kOne).size() - 1);
    while (true) {  // "bounds" or "units, up"
      note.insert(word, "--");
      const std::size_t end = note.find_first_of(" ,)", word);
      std::replace(note.begin() + static_cast<std::ptrdiff_t>(word),
                   note.begin() + static_cast<std::ptrdiff_t>(std::min(end, note.size())), '_',
                   '-');
      if (!several || end == std::string::npos || note[end] != ',') break;
      word = end + 2;
    }
  }
  return note;
}

}  // namespace ridgeway::cli
