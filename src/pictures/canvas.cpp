// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "canvas.hpp"

#include <cairo-svg.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "files/atomic_file.hpp"
#include "files/text.hpp"
#include "ridgeway/common/error.hpp"

namespace ridgeway {
namespace {

cairo_status_t append_bytes(void* bytes, const unsigned char* data, unsigned int length) {
  try {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
  return CAIRO_STATUS_SUCCESS;
}

/// Length of the UTF-8 character at the front of a text; 0 where there is none.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xc2 ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                                           : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((text[i] & 0xc0) != 0x80) return 0;
  return length;
}

/// What cairo can show of a text: control characters and bytes that are no UTF-8 become '?'.
std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const bool control = static_cast<unsigned char>(text.front()) < 0x20 || text.front() == 0x7f;
    if (length == 0 || control) {
      shown += '?';
    } else {
      shown += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return shown;
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(cairo_status_to_string(status));
}

}  // namespace

void check_picture_extension(const std::filesystem::path& out) {
  if (extension_of(out) == ".png" || extension_of(out) == ".svg") return;
  throw InputError(out.string(), "names no format that a picture can be written in",
                   "use .png or .svg");
}

Canvas::Canvas(std::filesystem::path out, int width, int height)
    : out_(std::move(out)), svg_(extension_of(out_) == ".svg") {
  check_picture_extension(out_);
  surface_.reset(svg_ ? cairo_svg_surface_create_for_stream(append_bytes, &bytes_, width, height)
                      : cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  check(cairo_surface_status(surface_.get()));
  cairo_.reset(cairo_create(surface_.get()));
  check(cairo_status(cairo_.get()));
  cairo_set_line_cap(cairo(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo(), CAIRO_LINE_JOIN_ROUND);
  fill_rectangle(0, 0, width, height, {1.0, 1.0, 1.0});
}

void Canvas::set_colour(const Colour& colour, double opacity) {
  cairo_set_source_rgba(cairo(), colour.r, colour.g, colour.b, opacity);
}

void Canvas::set_line(double width, const std::vector<double>& dashes) {
  cairo_set_line_width(cairo(), width);
  cairo_set_dash(cairo(), dashes.data(), static_cast<int>(dashes.size()), 0.0);
}

void Canvas::fill_rectangle(double x, double y, double width, double height, const Colour& colour) {
  set_colour(colour);
  cairo_rectangle(cairo(), x, y, width, height);
  cairo_fill(cairo());
}

void Canvas::set_font(double size, bool bold) {
  cairo_select_font_face(cairo(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo(), size);
}

double Canvas::text_width(const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(cairo(), printable(text).c_str(), &extents);
  return extents.x_advance;
}

void Canvas::draw_text(double x, double y, const std::string& text, Align align) {
  const double width = align == Align::kLeft ? 0.0 : text_width(text);
  cairo_move_to(cairo(), x - (align == Align::kRight ? width : 0.5 * width), y);
  cairo_show_text(cairo(), printable(text).c_str());
  cairo_new_path(cairo());
}

std::string Canvas::fitted(std::string text, double width) {
  text = printable(text);
  if (text_width(text) <= width) return text;
  while (!text.empty() && text_width(text + "...") > width) {
    while (!text.empty() && (text.back() & 0xc0) == 0x80) text.pop_back();  // whole characters
    if (!text.empty()) text.pop_back();
  }
  return text + "...";
}

void Canvas::finish() {
  check(cairo_status(cairo()));
  if (svg_) {
    cairo_surface_finish(surface_.get());
  } else {
    check(cairo_surface_write_to_png_stream(surface_.get(), append_bytes, &bytes_));
  }
  check(cairo_surface_status(surface_.get()));
  write_text_file(out_, bytes_);
}

}  // namespace ridgeway
