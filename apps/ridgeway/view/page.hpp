// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ridgeway::cli {

/// A file of the page, which is in the program itself.
struct PageFile {
  std::string_view type;  ///< of HTTP
  std::string_view body;
};

/// Of a path of an address ("/", "/page.js", "/page.css"); nothing for any other. No path is ever
/// looked up on the disk.
std::optional<PageFile> find_page_file(std::string_view path);

/// Whether the program was built with its page. Where it was not (no node), `kNoPage` tells how.
bool has_page();
inline constexpr const char* kNoPage =
    "install nodejs and npm and build again with ./dev build, which makes the page";

/// Throws InputError, naming the file, where the program was built without what a page in one file
/// takes: the page, and the planner that runs in it.
void require_page_planner(const std::string& file);

/// The page as one file that needs nothing else: with its script, the planner, and the roadmap of
/// `ridge_bytes` in it. require_page_planner must have held.
std::string page_with_map(const std::string& name, std::string_view ridge_bytes);

}  // namespace ridgeway::cli
