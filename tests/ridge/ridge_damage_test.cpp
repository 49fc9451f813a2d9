// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <random>

#include "ridge/ridge_container.hpp"
#include "ridge/ridge_sections.hpp"
#include "ridgeway/common/error.hpp"
#include "ridgeway/ridge/ridge_file.hpp"
#include "support/synthetic_roadmap.hpp"
#include "support/temporary_folder.hpp"

namespace ridgeway {
namespace {

class DamagedRidge : public ::testing::Test {
 protected:
  void SetUp() override {
    SyntheticConfig config;
    config.rooms_x = 2;
    config.rooms_y = 1;
    save_roadmap(synthetic_roadmap(config), folder_ / "good.ridge");
    bytes_ = read_whole(folder_ / "good.ridge");
  }

  /// The message with which a file of these bytes is refused.
  std::string refusal(const std::string& bytes) {
    write_whole(folder_ / "bad.ridge", bytes);
    try {
      load_roadmap(folder_ / "bad.ridge");
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  TemporaryFolder folder_;
  std::string bytes_;
};

TEST_F(DamagedRidge, EveryTruncationIsRefused) {
  std::mt19937 random(3);
  for (std::size_t length = 0; length < bytes_.size();
       length += length < 100 ? 1 : 1 + random() % (bytes_.size() / 150)) {
    EXPECT_FALSE(refusal(bytes_.substr(0, length)).empty()) << length;
  }
  EXPECT_NE(refusal(bytes_.substr(0, bytes_.size() - 1)).find("section 'attach' is cut off"),
            std::string::npos);
  EXPECT_FALSE(refusal(bytes_ + "x").empty());
}

TEST_F(DamagedRidge, EveryFlippedBitIsRefused) {
  std::mt19937 random(4);
  for (std::size_t at = 0; at < bytes_.size();
       at += at < 100 ? 1 : 1 + random() % (bytes_.size() / 150)) {
    std::string bad = bytes_;
    bad[at] = static_cast<char>(bad[at] ^ 1 << random() % 8);
    EXPECT_FALSE(refusal(bad).empty()) << at;
  }
}

TEST_F(DamagedRidge, OtherFilesAreNamedAsSuch) {
  EXPECT_NE(refusal("").find("is no .ridge file"), std::string::npos);
  EXPECT_NE(refusal("# OctoMap file").find("is no .ridge file"), std::string::npos);
  std::string newer = bytes_;
  newer[8] = 4;
  EXPECT_NE(refusal(newer).find("newer version"), std::string::npos);
  EXPECT_THROW(load_roadmap(folder_.path()), InputError);
  EXPECT_THROW(load_roadmap(folder_ / "none.ridge"), InputError);
  EXPECT_THROW(read_ridge_info(folder_ / "none.ridge"), InputError);
}

/// Files whose checksums are right but whose content is not.
class HostileRidge : public DamagedRidge {
 protected:
  using Bytes = std::vector<std::byte>;

  /// Writes the good file anew with one section's bytes, or the header, changed.
  std::string refusal_with(const std::string& section, const std::function<void(Bytes&)>& spoil,
                           const std::function<void(std::string&)>& spoil_header = {}) {
    {
      const RidgeReader reader(folder_ / "good.ridge");
      RidgeReader::Scratch scratch;
      std::vector<RidgeSectionSource> sources;
      for (const RidgeSectionEntry& entry : reader.sections()) {
        std::vector<Bytes> chunks(entry.chunks.size());
        for (std::size_t i = 0; i < chunks.size(); ++i) {
          reader.read_chunk(entry, i, scratch, chunks[i]);
        }
        if (entry.name == section && !chunks.empty()) spoil(chunks.front());
        sources.push_back({entry.name, entry.type, chunks.size(),
                           [chunks](std::size_t i, Bytes& raw) { raw = chunks[i]; }});
      }
      std::string header = reader.header();
      if (spoil_header) spoil_header(header);
      write_ridge_container(folder_ / "hostile.ridge", header, sources);
    }
    return refusal(read_whole(folder_ / "hostile.ridge"));
  }

  static void put(Bytes& bytes, std::size_t at, std::uint64_t value, std::size_t size) {
    ASSERT_LE(at + size, bytes.size());
    std::memcpy(bytes.data() + at, &value, size);
  }
};

TEST_F(HostileRidge, UnchangedContentIsAccepted) {
  EXPECT_EQ(refusal_with("blocks", [](Bytes&) {}), "");
}

TEST_F(HostileRidge, WrongContentIsRefused) {
  const std::uint64_t nan = 0x7ff8000000000000ull;
  const std::size_t vertices = 40, edges = load_roadmap(folder_ / "good.ridge").graph.edges.size();
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  struct Case {
    std::string section;
    std::size_t at;
    std::uint64_t value;
    std::size_t size;
  };
  for (const Case& c : {Case{"blocks", 0, 0x7fffffff, 4},
                        Case{"blocks", 4, 0, 4},
                        Case{"state", 0, 3, 1},
                        Case{"state", 0, 8, 1},
                        Case{"state", 0, 6, 1},
                        Case{"diagram", 0, ~0ull, 8},
                        Case{"attach", 0, 28, 1},
                        Case{"vertices", 0, 0x7fffffff, 4},
                        Case{"vertices", 12 * vertices, nan, 8},
                        Case{"edges", 0, 0xffffffff, 4},
                        Case{"edges", 0, 39, 4},
                        Case{"edges", 8 * edges, nan, 8},
                        Case{"edges", 8 * edges, bits(0.7), 8},
                        Case{"edges", 16 * edges, bits(2.0), 8},
                        Case{"edges", 16 * edges, bits(0.2), 8},
                        Case{"tree", 0, 40, 4},
                        Case{"tree", 0, 39, 4},
                        Case{"tree", 4 * vertices, nan, 8},
                        Case{"tree", 12 * vertices + 4, 0x7fffffff, 4},
                        Case{"corners", 0, 0x7fffffff, 4},
                        Case{"corners", 12 * vertices, nan, 8},
                        Case{"taut_edges", 0, 0xffffffff, 4},
                        Case{"taut_edges", 16 * edges, bits(2.0), 8},
                        Case{"cells", 0, 0xffffffff, 4},
                        Case{"seen", 0, 40, 4}}) {
    const std::string message =
        refusal_with(c.section, [&](Bytes& bytes) { put(bytes, c.at, c.value, c.size); });
    EXPECT_NE(message.find("'" + c.section + "'"), std::string::npos)
        << c.section << " " << c.at << ": " << message;
  }
}

TEST_F(HostileRidge, WrongSizesAreRefused) {
  for (const char* section : {"blocks", "vertices", "edges", "tree", "state", "site", "diagram",
                              "attach", "corners", "taut_edges", "cells", "seen"}) {
    EXPECT_NE(refusal_with(section, [](Bytes& b) { b.pop_back(); }).find(section),
              std::string::npos);
    EXPECT_NE(refusal_with(section, [](Bytes& b) { b.clear(); }).find(section), std::string::npos);
    EXPECT_NE(refusal_with(section, [](Bytes& b) { b.resize(2 * b.size()); }).find(section),
              std::string::npos);
  }
}

TEST_F(HostileRidge, WrongHeadersAreRefused) {
  const auto with_header = [&](const std::function<void(std::string&)>& spoil) {
    return refusal_with(
        "", [](Bytes&) {}, spoil);
  };
  const auto replace = [](const std::string& from, const std::string& to) {
    return [=](std::string& header) {
      ASSERT_NE(header.find(from), std::string::npos);
      header.replace(header.find(from), from.size(), to);
    };
  };
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"{", ""},
           {"{", std::string(100000, '[')},
           {"\"voxel_size\": 0.1", "\"voxel_size\": -0.1"},
           {"\"voxel_size\": 0.1", "\"voxel_size\": null"},
           {"\"voxel_size\": 0.1", "\"voxel_size\": 1e300"},
           {"\"min_clearance\": ", "\"min_clearance\": 0.0, \"once\": "},
           {"\"max_distance\": ", "\"max_distance\": 0.01, \"once\": "},
           {"\"voxel_size\": 0.1", "\"voxel_size\": \"big\""},
           {"\"obstacle\"", "\"maybe\""},
           {"\"vertices\": 40", "\"vertices\": 41"},
           {"\"vertices\": 40", "\"vertices\": -1"},
           {"\"vertices\": 40", "\"vertices\": 4294967294"},
           {"\"blocks\": ", "\"blocks\": 4294967"},
           {"\"blocks\": ", "\"blocks\": 1"},
           {"\"content\": \"roadmap\"", "\"content\": \"tsdf\""}}) {
    EXPECT_NE(with_header(replace(from, to)), "") << from << " -> " << to.substr(0, 40);
  }
}

/// The header of the good file without its origin, or with another one.
TEST_F(HostileRidge, FilesOfTheFirstVersionHaveTheirOriginAtZero) {
  const auto with_origin = [](const std::string& text) {
    return [text](std::string& header) {
      const std::size_t from = header.find("\"origin\""), to = header.find(']', from);
      ASSERT_NE(to, std::string::npos);
      header.replace(from, to + 2 - from, text);  // the comma too
    };
  };
  const auto refusal_of = [&](const std::string& text) {
    return refusal_with(
        "", [](Bytes&) {}, with_origin(text));
  };
  EXPECT_NE(load_roadmap(folder_ / "good.ridge").esdf.origin, VoxelIndex{});
  EXPECT_EQ(refusal_of(""), "");
  EXPECT_EQ(load_roadmap(folder_ / "hostile.ridge").esdf.origin, VoxelIndex{});
  EXPECT_EQ(refusal_of("\"origin\": [1000000000, -1000000000, 7],"), "");
  EXPECT_EQ(load_roadmap(folder_ / "hostile.ridge").esdf.origin,
            (VoxelIndex{1'000'000'000, -1'000'000'000, 7}));
  for (const char* origin : {"[1000000001, 0, 0]", "[0, -1e300, 0]", "[0, 0, 0.5]", "[0, 0]",
                             "[0, 0, 0, 0]", "7", "null", "{}", "[18446744073709551615, 0, 0]"})
    EXPECT_NE(refusal_of(std::string("\"origin\": ") + origin + ","), "") << origin;
}

TEST_F(HostileRidge, CountsThatTheHeaderDoesNotAllowAreRefusedBeforeTheyAreInflated) {
  const std::size_t regions =
      number_regions(load_roadmap(folder_ / "good.ridge").esdf.layout).count;
  // Every region sees as many corners as the file has, over and over.
  const std::string seen =
      refusal_with("cells", [&](Bytes& bytes) { put(bytes, 4 * (regions - 1), 1'000'000'000, 4); });
  EXPECT_NE(seen.find("'cells' counts more corners than are listed"), std::string::npos) << seen;
  for (const auto& [key, count, problem] :
       std::vector<std::tuple<std::string, std::string, std::string>>{
           {"vertices", "4000000000", "more vertices than voxels"},
           {"edges", "400000000", "more edges than the vertices can have"},
           {"corners", "8193", "more corners than are learnt"},
           {"taut_edges", "400000000", "more edges than the vertices can have"}}) {
    const std::string message = refusal_with(
        "", [](Bytes&) {},
        [key = key, count = count](std::string& header) {
          const std::size_t at = header.find('"' + key + "\": ", header.find("counts")),
                            first = at + key.size() + 4;
          ASSERT_NE(at, std::string::npos);
          header.replace(first, header.find_first_of(",\n", first) - first, count);
        });
    EXPECT_NE(message.find(problem), std::string::npos) << key << ": " << message;
  }
}

TEST_F(HostileRidge, AnyChangedByteGivesARoadmapOrARefusal) {
  std::mt19937 random(5);
  const std::vector<std::string> names = {"blocks",  "vertices",   "edges",   "tree",
                                          "state",   "site",       "diagram", "attach",
                                          "corners", "taut_edges", "cells",   "seen"};
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    const std::string message = refusal_with(names[random() % names.size()], [&](Bytes& bytes) {
      for (int k = 0; k < 3; ++k) {
        bytes[random() % bytes.size()] = static_cast<std::byte>(random() & 255);
      }
    });
    refused += !message.empty();
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace ridgeway
