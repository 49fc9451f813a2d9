// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <cairo.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "colour_map.hpp"

namespace ridgeway {

/// A page of a PNG or SVG picture, by the file's extension; written by `finish`. A thin coat
/// around cairo: lengths in pixels, y down.
class Canvas {
 public:
  Canvas(std::filesystem::path out, int width, int height);

  cairo_t* cairo() { return cairo_.get(); }
  void set_colour(const Colour& colour, double opacity = 1.0);
  void set_line(double width, const std::vector<double>& dashes = {});
  void fill_rectangle(double x, double y, double width, double height, const Colour& colour);

  enum class Align { kLeft, kMiddle, kRight };
  void set_font(double size, bool bold = false);
  double text_width(const std::string& text);
  /// Draws a line of text, its baseline at y.
  void draw_text(double x, double y, const std::string& text, Align align = Align::kLeft);
  /// The text, cut with three dots where it is wider than a number of pixels.
  std::string fitted(std::string text, double width);

  void finish();

 private:
  struct Closer {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
  };
  std::filesystem::path out_;
  bool svg_ = false;
  std::string bytes_;
  std::unique_ptr<cairo_surface_t, Closer> surface_;
  std::unique_ptr<cairo_t, Closer> cairo_;
};

/// Throws InputError unless the extension is that of a picture that Canvas can write.
void check_picture_extension(const std::filesystem::path& out);

}  // namespace ridgeway
