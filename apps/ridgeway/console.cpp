// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "console.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace ridgeway::cli {

void print_json(const nlohmann::ordered_json& json) {
  // File names need not be UTF-8; JSON must be.
  const std::string text =
      json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::printf("%s\n", text.c_str());
}

void print_row(std::string_view label, const std::string& value) {
  std::printf("%-16.*s %s\n", static_cast<int>(label.size()), label.data(), value.c_str());
}

void note(const Globals& globals, const std::string& text) {
  if (!globals.quiet) std::fprintf(stderr, "ridgeway: %s\n", text.c_str());
}

void warn(const Globals& globals, const std::string& text) {
  note(globals, std::string("warning: ").append(text));
}

std::string text_of(double value, int decimals) {
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  constexpr double kReadable = 1e9;  // beyond it as 1.5e+12
  std::array<char, 64> buffer{};
  const char* format = std::abs(value) < kReadable ? "%.*f" : "%.*g";
  const int length = std::snprintf(buffer.data(), buffer.size(), format, decimals, value);
  std::string text(buffer.data(), static_cast<std::size_t>(length));
  if (text.find('e') == std::string::npos && text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

double rounded_down(double value) { return std::floor(value * 1000.0 + 1e-6) / 1000.0; }

std::string count_text(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, 1, ',');
  return text;
}

std::string bytes_text(std::uint64_t bytes) {
  constexpr std::array<const char*, 4> units = {"kB", "MB", "GB", "TB"};
  if (bytes < 1000) return std::to_string(bytes) + " B";
  double value = static_cast<double>(bytes) / 1000.0;
  std::size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < units.size(); ++unit) value /= 1000.0;
  return text_of(value, value < 10.0 ? 1 : 0) + " " + units[unit];
}

std::string seconds_text(double seconds) {
  if (seconds >= 1.0) return text_of(seconds, 2) + " s";
  if (seconds >= 1e-3) return text_of(seconds * 1e3, seconds >= 0.1 ? 0 : 1) + " ms";
  return text_of(seconds * 1e6, 1) + " us";
}

std::string point_text(const Point& p) {
  return text_of(p.x()) + "," + text_of(p.y()) + "," + text_of(p.z());
}

nlohmann::ordered_json json_of(const Point& p) {
  return nlohmann::ordered_json::array({p.x(), p.y(), p.z()});
}

nlohmann::ordered_json json_of(const Box& box) {
  return {{"min", json_of(box.min)}, {"max", json_of(box.max)}};
}

ProgressBar::ProgressBar(const Globals& globals)
    : enabled_(!globals.quiet && ::isatty(STDERR_FILENO) == 1) {}

void ProgressBar::show(std::string_view stage, double share) {
  if (!enabled_) return;
  constexpr int width = 30;
  const int filled = static_cast<int>(std::lround(width * std::clamp(share, 0.0, 1.0)));
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                          std::string(static_cast<std::size_t>(width - filled), '.');
  std::fprintf(stderr, "\r[%s] %-10.*s", bar.c_str(), static_cast<int>(stage.size()), stage.data());
  std::fflush(stderr);
  visible_ = true;
}

void ProgressBar::clear() {
  if (visible_) std::fputs("\r\033[K", stderr);
  visible_ = false;
}

Progress ProgressBar::callback() {
  if (!enabled_) return {};
  return [this](std::string_view stage, double share) {
    show(stage, share);
    return true;
  };
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace ridgeway::cli
