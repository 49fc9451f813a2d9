// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "depth_png.hpp"

#include <png.h>

#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "files/atomic_file.hpp"
#include "files/read_file.hpp"
#include "mapping/memory_limit.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

constexpr unsigned kMostPixels = 16384;  // along one side

struct Source {
  std::string_view rest;
};

void read_bytes(png_structp png, png_bytep target, std::size_t count) {
  Source& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (count > source.rest.size()) png_error(png, "it ends too early");
  std::memcpy(target, source.rest.data(), count);
  source.rest.remove_prefix(count);
}

void write_bytes(png_structp png, png_bytep bytes, std::size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))
      ->append(reinterpret_cast<const char*>(bytes), count);
}

void flush_nothing(png_structp) {}

/// libpng reports by a text and a jump; the text outlives the jump here.
struct Report {
  char text[160] = "it is damaged";
};

[[noreturn]] void keep_text(png_structp png, png_const_charp text) {
  auto* report = static_cast<Report*>(png_get_error_ptr(png));
  std::strncpy(report->text, text, sizeof(report->text) - 1);
  std::longjmp(png_jmpbuf(png), 1);
}

void ignore_warning(png_structp, png_const_charp) {}

/// What libpng gives; filled between its jumps, so that nothing needs a destructor there.
struct Grey16 {
  unsigned width = 0, height = 0;
  bool is_grey16 = false;
};

/// Reads the header, then, where `rows` has been given room, all rows. False: see the report.
bool decode(png_structp png, png_infop info, Source& source, Grey16& image, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  if (rows == nullptr) {
    png_set_read_fn(png, &source, read_bytes);
    png_set_user_limits(png, kMostPixels, kMostPixels);
    png_read_info(png, info);
    image.width = png_get_image_width(png, info);
    image.height = png_get_image_height(png, info);
    image.is_grey16 =
        png_get_bit_depth(png, info) == 16 && png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY;
  } else {
    png_read_image(png, rows);
    png_read_end(png, nullptr);
  }
  return true;
}

bool encode(png_structp png, png_infop info, std::string& bytes, unsigned width, unsigned height,
            png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_write_fn(png, &bytes, write_bytes, flush_nothing);
  png_set_IHDR(png, info, width, height, 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  png_write_image(png, rows);
  png_write_end(png, nullptr);
  return true;
}

/// Rows of big-endian 16-bit values, as PNG has them.
struct Rows {
  std::vector<unsigned char> bytes;
  std::vector<png_bytep> starts;
  Rows(std::size_t width, std::size_t height) : bytes(2 * width * height), starts(height) {
    for (std::size_t v = 0; v < height; ++v) starts[v] = bytes.data() + 2 * width * v;
  }
};

/// libpng's two structs, for reading or for writing.
struct Png {
  explicit Png(bool is_reader)
      : reads(is_reader),
        png(is_reader
                ? png_create_read_struct(PNG_LIBPNG_VER_STRING, &report, keep_text, ignore_warning)
                : png_create_write_struct(PNG_LIBPNG_VER_STRING, &report, keep_text,
                                          ignore_warning)),
        info(png_create_info_struct(png)) {}
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
  ~Png() {
    if (reads)
      png_destroy_read_struct(&png, &info, nullptr);
    else
      png_destroy_write_struct(&png, &info);
  }

  const bool reads;
  Report report;
  png_structp png;
  png_infop info;
};

/// A header can promise more than the file holds, or than fusion has room for.
void require_plausible(const Grey16& header, std::size_t bytes, const std::string& name) {
  constexpr double kMostDeflated = 1032.0;  // to one byte, by the format of zlib
  constexpr double kBytesPerPixel = 200.0;  // with the rays and normals that are made of it
  const double pixels = static_cast<double>(header.width) * header.height;
  if (2.0 * pixels > kMostDeflated * static_cast<double>(bytes))
    throw InputError(name, "is no PNG image that can be read: it ends too early",
                     "copy or record it again");
  require_memory(kBytesPerPixel * pixels, name, "give images of fewer pixels");
}

}  // namespace

DepthImage read_depth_png(const std::filesystem::path& file, double units_per_metre, int none) {
  const std::string name = file.string(), bytes = read_file(file);
  const auto damaged = [&](const Png& reader) {
    throw InputError(name, std::string("is no PNG image that can be read: ") + reader.report.text,
                     "copy or record it again");
  };
  Source source{bytes};
  Png reader(true);
  Grey16 header;
  if (!decode(reader.png, reader.info, source, header, nullptr)) damaged(reader);
  if (!header.is_grey16)
    throw InputError(name, "is no 16-bit grey image", "give depths, not colours");
  require_plausible(header, bytes.size(), name);
  Rows rows(header.width, header.height);
  if (!decode(reader.png, reader.info, source, header, rows.starts.data())) damaged(reader);
  DepthImage image{static_cast<int>(header.width), static_cast<int>(header.height),
                   std::vector<float>(std::size_t{header.width} * header.height)};
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    const int value = rows.bytes[2 * i] << 8 | rows.bytes[2 * i + 1];
    image.depth[i] = value == none ? 0.0f : static_cast<float>(value / units_per_metre);
  }
  return image;
}

void write_depth_png(const DepthImage& image, const std::filesystem::path& file,
                     double units_per_metre) {
  constexpr double kLargest = 65534.0;  // 65535 often stands for no measurement
  Rows rows(static_cast<std::size_t>(image.width), static_cast<std::size_t>(image.height));
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    const double value = std::round(static_cast<double>(image.depth[i]) * units_per_metre);
    const auto unit = static_cast<unsigned>(value >= 1.0 && value <= kLargest ? value : 0.0);
    rows.bytes[2 * i] = static_cast<unsigned char>(unit >> 8);
    rows.bytes[2 * i + 1] = static_cast<unsigned char>(unit & 255);
  }
  std::string bytes;
  Png writer(false);
  if (!encode(writer.png, writer.info, bytes, static_cast<unsigned>(image.width),
              static_cast<unsigned>(image.height), rows.starts.data()))
    throw InputError(file.string(), std::string("cannot be written: ") + writer.report.text,
                     "check the size of the image");
  write_text_file(file, bytes);
}

}  // namespace ridgeway
