// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "formats/mesh_packing.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

namespace ridgeway {
namespace {

MeshReply some_reply() {
  return {"", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 2, 3}}};
}

void put(std::vector<std::byte>& bytes, std::size_t at, std::uint64_t value) {
  ASSERT_LE(at + sizeof(value), bytes.size());
  std::memcpy(bytes.data() + at, &value, sizeof(value));
}

TEST(MeshPacking, GivesBackWhatWasPacked) {
  const MeshReply mesh = some_reply();
  const auto same = unpack(pack(mesh));
  ASSERT_TRUE(same);
  EXPECT_EQ(same->vertices, mesh.vertices);
  EXPECT_EQ(same->triangles, mesh.triangles);
  EXPECT_EQ(same->problem, "");
  const auto problem = unpack(pack({"it has\n\x1b[31m no triangles", {}, {}}));
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->problem, "it has  [31m no triangles");
  const auto wordy = unpack(pack({std::string(5000, 'a'), {}, {}}));
  ASSERT_TRUE(wordy);
  EXPECT_EQ(wordy->problem.size(), MeshReply::kLongestProblem);
}

TEST(MeshPacking, CountsThatAreNotThoseOfTheBytesAreRefused) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  const std::vector<std::byte> good = pack(some_reply());
  // 2^64 / 24 and / 12 make products that wrap around.
  for (const std::uint64_t count :
       {std::uint64_t{0}, std::uint64_t{3}, std::uint64_t{5}, std::uint64_t{1} << 32, most / 24,
        most / 24 + 1, most / 12, most / 12 + 2, most})
    for (const std::size_t at : {9u, 17u}) {
      std::vector<std::byte> bad = good;
      put(bad, at, count);
      EXPECT_FALSE(unpack(bad)) << count << " at " << at;
    }
}

TEST(MeshPacking, BytesCutShortAnywhereAreRefused) {
  for (const MeshReply& reply : {some_reply(), MeshReply{"it is damaged", {}, {}}}) {
    const std::vector<std::byte> good = pack(reply);
    for (std::size_t size = 0; size < good.size(); ++size)
      EXPECT_FALSE(unpack(std::span(good).first(size))) << size;
  }
}

TEST(MeshPacking, AnyBytesAreAMeshThatFitsThemOrNothing) {
  std::mt19937 random(4);
  int read = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<std::byte> bytes = pack(some_reply());
    for (int flips = 1 + static_cast<int>(random() % 3); flips > 0; --flips)
      bytes[random() % bytes.size()] = static_cast<std::byte>(random());
    const auto reply = unpack(bytes);
    if (!reply) continue;
    ++read;
    EXPECT_LE(24 * reply->vertices.size() + 12 * reply->triangles.size(), bytes.size());
  }
  EXPECT_GT(read, 200);
  EXPECT_LT(read, 2000);
}

}  // namespace
}  // namespace ridgeway
