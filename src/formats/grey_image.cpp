// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "grey_image.hpp"

#include <png.h>

#include <algorithm>
#include <optional>
#include <string>

#include "files/byte_reader.hpp"
#include "files/text.hpp"
#include "mapping/memory_limit.hpp"

namespace ridgeway {
namespace {

constexpr std::uint32_t kMostPixels = 65535;  // along one side
constexpr const char* kImageRemedy = "write the image again, as 8-bit .pgm or .png";

void require_size(std::uint64_t width, std::uint64_t height, const std::string& name) {
  if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels)
    throw InputError(
        name,
        "is an image of " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
        "sides of 1 to 65535 can be read");
  require_memory(6.0 * static_cast<double>(width) * static_cast<double>(height), name,
                 "cut the image into parts");
}

// --- PGM

bool is_space(char c) { return is_blank(c) || c == '\n'; }

/// The next number of a header or of plain text, after blanks and comments.
std::uint32_t take_whole(ByteReader& reader) {
  while (true) {
    reader.require(1);
    const char c = reader.rest().front();
    if (c == '#')
      reader.take_line();
    else if (is_space(c))
      reader.skip(1);
    else
      break;
  }
  const std::string_view rest = reader.rest().substr(0, 11);
  std::size_t length = 0;
  while (length < rest.size() && rest[length] >= '0' && rest[length] <= '9') ++length;
  const auto value = to_number<std::uint32_t>(rest.substr(0, length));
  if (!value) reader.fail("has something that is no whole number", kImageRemedy);
  reader.skip(length);
  return *value;
}

GreyImage read_pgm(std::string_view bytes, const std::string& name) {
  ByteReader reader(bytes, name);
  const bool is_plain = bytes[1] == '2';
  reader.skip(2);
  const std::uint32_t width = take_whole(reader), height = take_whole(reader),
                      white = take_whole(reader);
  require_size(width, height, name);
  if (white < 1 || white > 65535)
    reader.fail("says that white is " + std::to_string(white), kImageRemedy);
  const std::size_t count = std::size_t{width} * height;
  if (!is_plain) {
    reader.skip(1);  // the one blank after the header
    reader.require(count * (white > 255 ? 2 : 1));
  }
  GreyImage image{static_cast<int>(width), static_cast<int>(height), {}, {}};
  if (is_plain) reader.require(2 * count - 1);
  image.grey.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t value = is_plain      ? take_whole(reader)
                                : white > 255 ? reader.take<std::uint16_t>(true)
                                              : reader.take<std::uint8_t>();
    if (value > white) reader.fail("has a pixel brighter than white", kImageRemedy);
    image.grey.push_back(static_cast<std::uint8_t>((255 * value + white / 2) / white));
  }
  return image;
}

// --- PNG

/// Frees what libpng holds for an image.
struct PngImage {
  png_image image{};
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&image); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;

  [[noreturn]] void fail(const std::string& name) const {
    throw InputError(name, std::string("cannot be read as .png: ") + image.message, kImageRemedy);
  }
};

/// The file without what says how bright its numbers are meant to look: in a map they are states,
/// and stay as they are.
std::string without_colour_spaces(std::string_view bytes) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // length, type and checksum of a chunk
  const auto is_kept = [](std::string_view type) {
    return type != "gAMA" && type != "cHRM" && type != "sRGB" && type != "iCCP";
  };
  std::string kept(bytes.substr(0, kSignature));
  bytes.remove_prefix(std::min(kSignature, bytes.size()));
  while (bytes.size() >= kFrame) {
    std::size_t length = 0;
    for (const char c : bytes.substr(0, 4)) length = length << 8 | static_cast<unsigned char>(c);
    if (length > bytes.size() - kFrame) break;
    if (is_kept(bytes.substr(4, 4))) kept.append(bytes.substr(0, length + kFrame));
    bytes.remove_prefix(length + kFrame);
  }
  return kept.append(bytes);
}

GreyImage read_png(std::string_view file, const std::string& name) {
  const std::string bytes = without_colour_spaces(file);
  PngImage png;
  if (png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()) == 0) png.fail(name);
  require_size(png.image.width, png.image.height, name);
  png.image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // else 16 bits would be taken for linear light
  png.image.format = PNG_FORMAT_RGBA;
  const std::size_t count = std::size_t{png.image.width} * png.image.height;
  std::vector<std::uint8_t> colours(4 * count);
  if (png_image_finish_read(&png.image, nullptr, colours.data(), 0, nullptr) == 0) png.fail(name);
  GreyImage image{static_cast<int>(png.image.width), static_cast<int>(png.image.height), {}, {}};
  image.grey.reserve(count);
  image.opaque.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned sum = colours[4 * i] + colours[4 * i + 1] + colours[4 * i + 2];
    image.grey.push_back(static_cast<std::uint8_t>((sum + 1) / 3));
    image.opaque.push_back(colours[4 * i + 3]);
  }
  return image;
}

}  // namespace

GreyImage read_grey_image(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with("P2") || bytes.starts_with("P5")) return read_pgm(bytes, name);
  if (bytes.starts_with("\x89PNG")) return read_png(bytes, name);
  throw InputError(name, "is no image that can be read here", "give a .pgm (P2, P5) or a .png");
}

}  // namespace ridgeway
