// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "ridgeway/pictures/picture.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <set>

#include "pictures/colour_map.hpp"
#include "pictures/picture_frame.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/roadmap/build_roadmap.hpp"
#include "support/random_maps.hpp"
#include "support/synthetic_roadmap.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

Surface open_png(const std::filesystem::path& path) {
  return {cairo_image_surface_create_from_png(path.c_str()), &cairo_surface_destroy};
}

/// Pixels of a colour, 0xrrggbb, give or take the rounding.
std::size_t count_pixels(cairo_surface_t* image, std::uint32_t colour) {
  const int width = cairo_image_surface_get_width(image);
  const int height = cairo_image_surface_get_height(image);
  const unsigned char* data = cairo_image_surface_get_data(image);
  std::size_t count = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, data + y * cairo_image_surface_get_stride(image) + 4 * x, 4);
      bool same = true;
      for (const int shift : {0, 8, 16}) {
        const int a = pixel >> shift & 255, b = colour >> shift & 255;
        same = same && std::abs(a - b) <= 1;
      }
      count += same;
    }
  }
  return count;
}

std::vector<Point> diagonal(const Roadmap& roadmap) {
  const SparseGraph& graph = roadmap.graph;
  return {to_world(roadmap.esdf, graph.vertices.front().position),
          to_world(roadmap.esdf, graph.vertices.back().position)};
}

TEST(Picture, PngShowsMapAndPath) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  for (const int width : {400, 1600}) {
    PictureConfig config;
    config.width = width;
    draw_floor_plan(roadmap, diagonal(roadmap), folder / "plan.png", config);
    EXPECT_EQ(read_whole(folder / "plan.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
    const Surface image = open_png(folder / "plan.png");
    ASSERT_EQ(cairo_surface_status(image.get()), CAIRO_STATUS_SUCCESS);
    EXPECT_EQ(cairo_image_surface_get_width(image.get()), width);
    const int height = cairo_image_surface_get_height(image.get());  // 73 x 49 voxels, and text
    EXPECT_GT(height, 0.66 * width);
    EXPECT_LT(height, 0.95 * width);
    EXPECT_GT(count_pixels(image.get(), 0xd62628), 30u);    // path
    EXPECT_GT(count_pixels(image.get(), 0x292e36), 1000u);  // walls
    EXPECT_GT(count_pixels(image.get(), 0xe8ebee), 100u);   // unknown
  }
}

TEST(Picture, ChartsGoBelowTheMap) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  const auto height = [&](const PictureConfig& config) {
    draw_floor_plan(roadmap, {}, folder / "plan.png", config);
    return cairo_image_surface_get_height(open_png(folder / "plan.png").get());
  };
  PictureConfig config;
  const int without = height(config);
  config.charts = {{"speed (m/s)", {0.0, 1.0, 2.0, 3.0}, {0.0, 2.0, HUGE_VAL, 1.0}, 2.0, "limit"},
                   {"empty", {}, {}, std::nullopt, ""}};
  EXPECT_GT(height(config), without + 200);
  EXPECT_GT(count_pixels(open_png(folder / "plan.png").get(), 0xd62628), 200u);  // the curve
  config.charts[0].values.pop_back();
  EXPECT_THROW(height(config), InputError);
}

TEST(Picture, WithoutPathNothingIsRed) {
  const TemporaryFolder folder;
  draw_floor_plan(synthetic_roadmap(), {}, folder / "plan.png");
  EXPECT_EQ(count_pixels(open_png(folder / "plan.png").get(), 0xd62628), 0u);
}

TEST(Picture, EveryPathToCompareHasItsColourAndALineInTheLegend) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  PictureConfig config;
  config.diagram = config.graph = false;
  const auto height = [&] {
    draw_floor_plan(roadmap, {}, folder / "plan.png", config);
    return cairo_image_surface_get_height(open_png(folder / "plan.png").get());
  };
  const int without = height();
  const std::vector<Point> ends = diagonal(roadmap);
  for (int i = 0; i < 8; ++i)  // side by side
    config.paths.push_back({"planner " + std::to_string(i),
                            {ends[0] + Point(0.1 * i, 0, 0), ends[1] + Point(0.1 * i, 0, 0)}});
  EXPECT_GT(height(), without);  // more rows of the legend, below the map
  const Surface image = open_png(folder / "plan.png");
  for (const std::uint32_t colour :
       {0x295c94u, 0xd65e00u, 0x008c73u, 0xa64d99u, 0xe69e00u, 0x57b3e8u, 0x735233u, 0x404047u})
    EXPECT_GT(count_pixels(image.get(), colour), 1000u) << std::hex << colour;  // legend: 200
  config.paths.push_back({"one too many", ends});
  EXPECT_THROW(height(), InputError);
}

/// Pixels in the columns at the left and at the right of a picture that are not white.
std::size_t count_at_edges(cairo_surface_t* image, int columns) {
  const int width = cairo_image_surface_get_width(image);
  std::size_t count = 0;
  for (int y = 0; y < cairo_image_surface_get_height(image); ++y) {
    const unsigned char* row =
        cairo_image_surface_get_data(image) + y * cairo_image_surface_get_stride(image);
    for (int x = 0; x < width; ++x)
      if (x < columns || x >= width - columns)
        count += row[4 * x] != 255 || row[4 * x + 1] != 255 || row[4 * x + 2] != 255;
  }
  return count;
}

TEST(Picture, NothingRunsOutOfThePageWhateverCoordinatesAndNames) {
  const TemporaryFolder folder;
  for (const int far : {0, 53'000'012, -1'000'000'013}) {
    Roadmap roadmap = synthetic_roadmap();
    roadmap.esdf.origin.y = far;
    PictureConfig config;
    config.width = 1000;
    config.paths.push_back({std::string(300, 'n'), diagonal(roadmap)});
    draw_floor_plan(roadmap, {}, folder / "plan.png", config);
    EXPECT_EQ(count_at_edges(open_png(folder / "plan.png").get(), 2), 0u) << far;
  }
}

TEST(Picture, RadiiThatFitAreRoundedDown) {
  EXPECT_EQ(short_number_at_most(0.2947457, 2), "0.29");
  EXPECT_EQ(short_number_at_most(0.299999, 2), "0.29");
  for (const double exact : {0.07, 0.29, 0.3, 0.57, 1.1, 12.0})
    EXPECT_EQ(short_number_at_most(exact, 2), short_number(exact, 2));
}

TEST(Picture, SvgIsOneDocument) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  draw_floor_plan(roadmap, diagonal(roadmap), folder / "plan.svg");
  const std::string svg = read_whole(folder / "plan.svg");
  EXPECT_EQ(svg.substr(0, 5), "<?xml");
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(Picture, SamePictureEveryTime) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  draw_floor_plan(roadmap, diagonal(roadmap), folder / "a.png");
  draw_floor_plan(roadmap, diagonal(roadmap), folder / "b.png");
  EXPECT_TRUE(read_whole(folder / "a.png") == read_whole(folder / "b.png"));
}

TEST(Picture, AnyTitleAndTallMapsAreFine) {
  const TemporaryFolder folder;
  SyntheticConfig tall;
  tall.rooms_x = 1;
  tall.rooms_y = 12;
  Roadmap roadmap = synthetic_roadmap(tall);
  PictureConfig config;
  config.width = 500;
  config.title = std::string("\xff\xfe \n \xc3") + std::string(500, 'w') + "\xc3\xa4";
  config.diagram_colour = DiagramColour::kHeight;
  config.raw_path = diagonal(roadmap);
  draw_floor_plan(roadmap, diagonal(roadmap), folder / "plan.png", config);
  EXPECT_LT(cairo_image_surface_get_height(open_png(folder / "plan.png").get()), 1.6 * 500);
}

TEST(Picture, BandsChooseTheHeights) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  PictureConfig floor;
  floor.diagram = floor.graph = false;
  floor.band = HeightBand{12.0, 12.1};  // the floor itself: all occupied
  draw_floor_plan(roadmap, {}, folder / "floor.png", floor);
  PictureConfig rooms = floor;
  rooms.band.reset();
  draw_floor_plan(roadmap, {}, folder / "rooms.png", rooms);
  EXPECT_GT(count_pixels(open_png(folder / "floor.png").get(), 0x292e36),
            5 * count_pixels(open_png(folder / "rooms.png").get(), 0x292e36));
}

/// Two storeys of two rooms each, 6 x 3 x 5 m, a hole in the slab between them, and in the lower
/// storey a door of 0.5 m, which is too narrow.
Roadmap two_storeys(const FlightLimits& limits = {}) {
  const OccupancyMap map = testing::make_map(0.1, {0, 0, 0}, {59, 29, 49}, [](const VoxelIndex& v) {
    const int height = v.z % 25;
    const bool is_hull = v.x == 0 || v.y == 0 || v.x == 59 || v.y == 29 || v.z == 49;
    const bool is_slab = height == 0 || height > 22, is_wall = v.x == 30;
    const bool is_hole = v.x >= 40 && v.x <= 52 && v.y >= 5 && v.y <= 22 && v.z > 1 && v.z < 40;
    const bool is_door = is_wall && v.y >= 12 && v.y <= 16 && v.z < 23 && !is_slab;
    return (is_hull || is_slab || is_wall) && !is_hole && !is_door ? VoxelState::kOccupied
                                                                   : VoxelState::kFree;
  });
  return build_roadmap(map, {.min_clearance = 0.3, .limits = limits, .tangent_pairs = 100}).roadmap;
}

PictureConfig small_plan(bool with_graph, int width = 800) {
  PictureConfig config;
  config.width = width;
  config.diagram = config.graph = with_graph;
  return config;
}

/// Height of the picture, and its pixels of a colour.
struct Drawn {
  int height = 0;
  std::size_t pixels = 0;
};
Drawn draw(const Roadmap& roadmap, std::span<const Point> path, const PictureConfig& config,
           std::uint32_t colour) {
  const TemporaryFolder folder;
  draw_floor_plan(roadmap, path, folder / "plan.png", config);
  const Surface image = open_png(folder / "plan.png");
  return {cairo_image_surface_get_height(image.get()), count_pixels(image.get(), colour)};
}

constexpr std::uint32_t kRed = 0xd62628, kMagenta = 0xa81a85, kOrange = 0xc25405;

TEST(Picture, EveryStoreyHasAPlanWithThePathsThatAreInIt) {
  const Roadmap roadmap = two_storeys();
  const std::vector<Point> path = {{4.5, 1.4, 1.0}, {4.5, 1.4, 3.8}, {0.5, 1.4, 3.8}};
  PictureConfig config = small_plan(false);
  const Drawn one = draw(roadmap, path, config, kRed);
  config.floors = true;
  const Drawn two = draw(roadmap, path, config, kRed);
  EXPECT_GT(two.height, one.height + 300);  // 3 of 6 m at the scale of the page
  // A path below the slab is in one of the plans alone.
  const std::vector<Point> below = {{3.5, 0.5, 1.0}, {5.5, 2.5, 1.0}};
  config.floors = false;
  const Drawn plan = draw(roadmap, below, config, kRed);
  config.floors = true;
  const Drawn plans = draw(roadmap, below, config, kRed);
  EXPECT_GT(plans.pixels, plan.pixels / 2);
  EXPECT_LT(plans.pixels, plan.pixels * 3 / 2);
}

TEST(Picture, OneStoreyIsOnePlan) {
  const Roadmap roadmap = synthetic_roadmap();
  PictureConfig config = small_plan(true);
  const int height = draw(roadmap, {}, config, kRed).height;
  config.floors = true;
  EXPECT_EQ(draw(roadmap, {}, config, kRed).height, height);
}

TEST(Picture, SidesAndSectionsGoBelowThePlan) {
  const Roadmap roadmap = two_storeys();
  const std::uint32_t wall = 0x292e36;
  PictureConfig config = small_plan(false);
  const Drawn plan = draw(roadmap, {}, config, wall);
  config.section_y = 1.5;
  const Drawn section = draw(roadmap, {}, config, wall);
  EXPECT_GT(section.height, plan.height + 400);  // 5 of 6 m
  config.section_y = 0.05;                       // inside the wall: all of it is dark
  const Drawn in_wall = draw(roadmap, {}, config, wall);
  EXPECT_EQ(in_wall.height, section.height);
  EXPECT_GT(in_wall.pixels, section.pixels + 100'000);
  config.section_x = 1.0;
  EXPECT_GT(draw(roadmap, {}, config, wall).height, section.height + 200);
  config.section_y = config.section_x = std::nullopt;
  config.sides = true;
  EXPECT_GT(draw(roadmap, {}, config, wall).height, section.height + 200);
  for (const double outside : {-1.0, 3.1, HUGE_VAL, std::nan("")}) {
    config.section_y = outside;
    EXPECT_THROW(draw(roadmap, {}, config, wall), InputError) << outside;
  }
}

TEST(Picture, NarrowPlacesHaveARingAndTheirRadius) {
  const Roadmap roadmap = two_storeys();
  PictureConfig config = small_plan(true, 1600);
  EXPECT_EQ(draw(roadmap, {}, config, kOrange).pixels, 0u);
  config.narrow_places = true;
  EXPECT_GT(draw(roadmap, {}, config, kOrange).pixels, 100u);
}

TEST(Picture, ComponentsHaveColoursOfTheirOwn) {
  const Roadmap roadmap = two_storeys();
  PictureConfig config = small_plan(true, 1600);
  const std::uint32_t graph = 0x295c94;
  EXPECT_GT(draw(roadmap, {}, config, graph).pixels, 50u);
  config.diagram_colour = DiagramColour::kComponent;
  EXPECT_EQ(draw(roadmap, {}, config, graph).pixels, 0u);
  std::set<std::uint32_t> colours;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [r, g, b] = bytes_of(component_colour(i));
    const std::uint32_t colour = static_cast<std::uint32_t>(r << 16 | g << 8 | b);
    colours.insert(colour);
    EXPECT_GT(draw(roadmap, {}, config, colour).pixels, 30u) << "component " << i;
  }
  EXPECT_EQ(colours.size(), 3u);
}

TEST(Picture, BoxesWithoutFlightsAreNoWalls) {
  PictureConfig config = small_plan(false, 1600);
  EXPECT_EQ(draw(two_storeys(), {}, config, kMagenta).pixels, 0u);
  FlightLimits limits;
  limits.keep_out.push_back({{1, 1, 3}, {2, 2, 4}});  // in the upper storey
  const Roadmap roadmap = two_storeys(limits);
  const Drawn plan = draw(roadmap, {}, config, kMagenta);
  EXPECT_GT(plan.pixels, 300u);
  config.floors = true;
  EXPECT_LT(draw(roadmap, {}, config, kMagenta).pixels, plan.pixels * 3 / 2);  // not in the lower
}

/// As where unknown space is free: the legend's pixels are left.
TEST(Picture, NothingOfTheGraphIsBeyondTheFrame) {
  const TemporaryFolder folder;
  Roadmap roadmap = synthetic_roadmap();
  roadmap.graph.edges.clear();
  roadmap.graph.vertices.resize(1);
  const Point inside = roadmap.graph.vertices[0].position;
  const auto pixels_with = [&](const Point& place) {
    roadmap.graph.vertices[0].position = place;
    draw_floor_plan(roadmap, {}, folder / "plan.png");
    return count_pixels(open_png(folder / "plan.png").get(), 0x295c94);
  };
  const std::size_t legend = pixels_with(Point(1000.0, 1000.0, inside.z()));
  EXPECT_GT(pixels_with(inside), legend);
  const double beside = 0.1 * -13 - 0.2;  // metres, of the map's first voxel
  EXPECT_EQ(pixels_with(Point(beside, inside.y(), inside.z())), legend);
}

TEST(Picture, NothingOfAPathIsBeyondTheFrame) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  const auto pixels_of = [&](const std::vector<Point>& path) {
    draw_floor_plan(roadmap, path, folder / "plan.png");
    return count_pixels(open_png(folder / "plan.png").get(), 0xd62629);
  };
  const auto at = [&](double x, double y) { return to_world(roadmap.esdf, Point(x, y, 0.5)); };
  const std::vector<Point> in_the_margin = {at(-1.45, 2.0), at(-1.45, 6.0)},
                           off_the_page = {at(-900.0, 2.0), at(-900.0, 6.0)};
  EXPECT_EQ(pixels_of(in_the_margin), pixels_of(off_the_page));
  EXPECT_GT(pixels_of(diagonal(roadmap)), 2 * pixels_of(off_the_page));
}

TEST(Picture, OfEveryPathTheEndsAreMarked) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  const std::vector<Point> ends = diagonal(roadmap);
  const Point middle = 0.5 * (ends[0] + ends[1]);
  const auto starts_of = [&](std::vector<NamedPath> paths) {
    PictureConfig config;
    config.paths = std::move(paths);
    draw_floor_plan(roadmap, {}, folder / "plan.png", config);
    return count_pixels(open_png(folder / "plan.png").get(), 0x1a8c45);
  };
  const std::size_t one = starts_of({{"there", ends}});
  EXPECT_GT(starts_of({{"there", ends}, {"on", {middle, ends[1]}}}), one + one / 3);
  EXPECT_GT(starts_of({{"round", {ends[0], middle, ends[0]}}}), one - one / 10);
}

TEST(Picture, BadRequestsAreRefused) {
  const TemporaryFolder folder;
  const Roadmap roadmap = synthetic_roadmap();
  EXPECT_THROW(draw_floor_plan(roadmap, {}, folder / "plan.jpg"), InputError);
  EXPECT_THROW(draw_floor_plan(roadmap, {}, folder / "none/plan.png"), InputError);
  EXPECT_THROW(draw_floor_plan({}, {}, folder / "plan.png"), InputError);
  PictureConfig config;
  config.width = 10;
  EXPECT_THROW(draw_floor_plan(roadmap, {}, folder / "plan.png", config), InputError);
  config.width = 800;
  config.band = HeightBand{2.0, 1.0};
  EXPECT_THROW(draw_floor_plan(roadmap, {}, folder / "plan.png", config), InputError);
  EXPECT_TRUE(folder.is_empty());
}

}  // namespace
}  // namespace ridgeway
