// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "mesh_packing.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "files/little_endian.hpp"

namespace ridgeway {
namespace {

using Bytes = std::vector<std::byte>;

static_assert(sizeof(Point) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(std::uint32_t));

constexpr std::size_t kLength = sizeof(std::uint64_t);  // sent first, to tell what came over whole
constexpr std::size_t kCounts = kLength + 1, kArrays = kCounts + 2 * sizeof(std::uint64_t);

/// Copies items to a place in the bytes; returns where they end.
template <typename Item>
std::size_t put(std::span<const Item> items, std::size_t offset, Bytes& bytes) {
  if (!items.empty())
    std::memcpy(bytes.data() + offset, static_cast<const void*>(items.data()), items.size_bytes());
  return offset + items.size_bytes();
}

template <typename Item>
void copy_items(std::span<const std::byte> bytes, std::vector<Item>& items) {
  items.resize(bytes.size() / sizeof(Item));
  if (!items.empty())
    std::memcpy(static_cast<void*>(items.data()), bytes.data(), items.size() * sizeof(Item));
}

char printable(char c) { return c >= ' ' && c <= '~' ? c : ' '; }

}  // namespace

Bytes pack(const MeshReply& reply) {
  const bool is_mesh = reply.problem.empty();
  Bytes bytes(is_mesh ? kArrays + reply.vertices.size() * sizeof(Point) +
                            reply.triangles.size() * sizeof(Triangle)
                      : kCounts + reply.problem.size());
  const std::uint64_t length = bytes.size() - kLength;
  put(std::span<const std::uint64_t>(&length, 1), 0, bytes);
  bytes[kLength] = std::byte{is_mesh};
  if (is_mesh) {
    const std::array<std::uint64_t, 2> counts = {reply.vertices.size(), reply.triangles.size()};
    put(std::span<const std::uint64_t>(counts), kCounts, bytes);
    put(std::span<const Triangle>(reply.triangles),
        put(std::span<const Point>(reply.vertices), kArrays, bytes), bytes);
  } else {
    put(std::span<const char>(reply.problem), kCounts, bytes);
  }
  return bytes;
}

std::optional<MeshReply> unpack(std::span<const std::byte> bytes) {
  if (bytes.size() <= kLength || number_at<std::uint64_t>(bytes, 0) != bytes.size() - kLength)
    return std::nullopt;
  MeshReply reply;
  if (bytes[kLength] == std::byte{0}) {
    const auto text = bytes.subspan(kCounts);
    for (const std::byte b : text.first(std::min(text.size(), MeshReply::kLongestProblem)))
      reply.problem.push_back(printable(static_cast<char>(b)));
    return reply.problem.empty() ? std::nullopt : std::optional(reply);
  }
  if (bytes[kLength] != std::byte{1} || bytes.size() < kArrays) return std::nullopt;
  const auto vertices = number_at<std::uint64_t>(bytes, kCounts, 0);
  const auto triangles = number_at<std::uint64_t>(bytes, kCounts, 1);
  const std::size_t left = bytes.size() - kArrays;
  if (vertices > left / sizeof(Point) || triangles > left / sizeof(Triangle) ||
      vertices * sizeof(Point) + triangles * sizeof(Triangle) != left)
    return std::nullopt;
  const auto arrays = bytes.subspan(kArrays);
  copy_items(arrays.first(vertices * sizeof(Point)), reply.vertices);
  copy_items(arrays.subspan(vertices * sizeof(Point)), reply.triangles);
  return reply;
}

}  // namespace ridgeway
