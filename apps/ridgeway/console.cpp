// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "console.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>

#include "interruption.hpp"
#include "json.hpp"

namespace ridgeway::cli {

void print_json(const nlohmann::ordered_json& json) {
  // File names need not be UTF-8; JSON must be.
  const std::string text =
      json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::printf("%s\n", text.c_str());
}

void print_row(std::string_view label, const std::string& value) {
  std::printf("%-16.*s %s\n", static_cast<int>(label.size()), label.data(),
              printable(value).c_str());
}

namespace {

/// How many bytes of a character in UTF-8 that may be shown begin a text; 0 for any other.
std::size_t shown_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  const std::size_t count = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || count > text.size()) return 0;
  for (std::size_t i = 1; i < count; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const bool is_control = byte(0) == 0xc2 && byte(1) < 0xa0;
  const bool turns_text =
      byte(0) == 0xe2 && ((byte(1) == 0x80 && byte(2) >= 0xaa && byte(2) <= 0xae) ||
                          (byte(1) == 0x81 && byte(2) >= 0xa6 && byte(2) <= 0xa9));
  return is_control || turns_text ? 0 : count;
}

}  // namespace

std::string printable(std::string_view text) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string result;
  while (!text.empty()) {
    const std::size_t shown = shown_bytes(text);
    if (shown > 0) {
      result.append(text.substr(0, shown));
      text.remove_prefix(shown);
      continue;
    }
    const auto byte = static_cast<unsigned char>(text.front());
    result.append("\\x").append(1, kDigits[byte >> 4]).append(1, kDigits[byte & 15]);
    text.remove_prefix(1);
  }
  return result;
}

void note(const Globals& globals, const std::string& text) {
  if (!globals.quiet) std::fprintf(stderr, "ridgeway: %s\n", printable(text).c_str());
}

void warn(const Globals& globals, const std::string& text) {
  note(globals, std::string("warning: ").append(text));
}

bool warn_of_unwritten(const Globals& globals, const std::filesystem::path& file) {
  std::error_code error;
  if (file.empty() || !std::filesystem::exists(file, error)) return false;
  warn(globals, file.string() + " is from before: nothing was written to it");
  return true;
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

double rounded_up(double value) { return std::ceil(value * 1000.0 - 1e-6) / 1000.0; }

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

nlohmann::ordered_json json_of(const Spread& spread) {
  return {{"median", spread.median}, {"p95", spread.p95}, {"p99", spread.p99}, {"max", spread.max}};
}

nlohmann::ordered_json json_of(const Box& box) {
  return {{"min", json_of(box.min)}, {"max", json_of(box.max)}};
}

ProgressBar::ProgressBar(const Globals& globals)
    : enabled_(!globals.quiet && ::isatty(STDERR_FILENO) == 1) {}

void ProgressBar::show(std::string_view stage, double share) {
  stop_if_interrupted();
  draw(stage, share);
}

void ProgressBar::draw(std::string_view stage, double share) {
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
  return [this](std::string_view stage, double share) {
    draw(stage, share);
    return !is_interrupted();
  };
}

std::uint64_t peak_memory_bytes() {
  // What getrusage tells is not less than what the program that started this one had.
  constexpr std::string_view kPeak = "VmHWM:";
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(kPeak)) return std::stoull(line.substr(kPeak.size())) * 1024;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace ridgeway::cli
