// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "view/page.hpp"

#include "ridgeway/common/error.hpp"
#include "view/base64.hpp"

// The files of the bundle, as they are, between two symbols each. An assembler takes them in at
// once, a compiler would take long over an array.
#define RIDGEWAY_INCLUDE_FILE(name, file)                                                 \
  asm(".section .rodata\n"                                                                \
      ".global ridgeway_page_" #name                                                      \
      "\n"                                                                                \
      "ridgeway_page_" #name                                                              \
      ":\n"                                                                               \
      ".incbin \"" file                                                                   \
      "\"\n"                                                                              \
      ".global ridgeway_page_" #name                                                      \
      "_end\n"                                                                            \
      "ridgeway_page_" #name                                                              \
      "_end:\n"                                                                           \
      ".byte 0\n"                                                                         \
      ".previous\n");                                                                     \
  extern "C" const char ridgeway_page_##name[], ridgeway_page_##name##_end[];             \
  std::string_view name##_file() {                                                        \
    return {ridgeway_page_##name,                                                         \
            static_cast<std::size_t>(ridgeway_page_##name##_end - ridgeway_page_##name)}; \
  }

RIDGEWAY_INCLUDE_FILE(html, RIDGEWAY_PAGE_FOLDER "/page.html")
RIDGEWAY_INCLUDE_FILE(css, RIDGEWAY_PAGE_FOLDER "/page.css")
RIDGEWAY_INCLUDE_FILE(script, RIDGEWAY_PAGE_FOLDER "/page.js")
RIDGEWAY_INCLUDE_FILE(worker, RIDGEWAY_PAGE_FOLDER "/worker.js")

namespace ridgeway::cli {
namespace {

void replace(std::string& text, std::string_view mark, std::string_view by) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos)
    throw InputError("page", "lacks its mark " + std::string(mark), "build the program again");
  text.replace(at, mark.size(), by);
}

/// As it may stand between tags.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c == '<' || c == '>' || c == '&' || c == '"')
      result += "&#" + std::to_string(static_cast<int>(c)) + ";";
    else
      result += c;
  return result;
}

}  // namespace

std::optional<PageFile> find_page_file(std::string_view path) {
  if (!has_page()) return std::nullopt;
  if (path == "/" || path == "/index.html")
    return PageFile{"text/html; charset=utf-8", html_file()};
  if (path == "/page.js") return PageFile{"text/javascript; charset=utf-8", script_file()};
  if (path == "/page.css") return PageFile{"text/css; charset=utf-8", css_file()};
  return std::nullopt;
}

bool has_page() { return !script_file().empty(); }

void require_page_planner(const std::string& file) {
  if (!has_page())
    throw InputError(file, "cannot be made: this program was built without its page", kNoPage);
  if (worker_file().empty())
    throw InputError(file, "cannot be made: this program was built without a planner for pages",
                     "install emscripten and build again with ./dev build");
}

std::string page_with_map(const std::string& name, std::string_view ridge_bytes) {
  std::string page(html_file());
  replace(page, "<link rel=\"stylesheet\" href=\"page.css\">",
          "<style>" + std::string(css_file()) + "</style>");
  // Nothing is asked of any server, and the browser sees to that.
  replace(
      page, "<meta charset=\"utf-8\">",
      "<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"default-src "
      "'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; style-src "
      "'unsafe-inline'; img-src data: blob:; connect-src data:\">");
  std::string data = "<script type=\"text/plain\" id=\"worker\">" + base64(worker_file()) +
                     "</script>\n<script type=\"text/plain\" id=\"map\" data-name=\"" +
                     escaped(name) + "\">" + base64(ridge_bytes) + "</script>\n<script>";
  data.append(script_file()).append("</script>");
  replace(page, "<script src=\"page.js\" defer></script>", data);
  return page;
}

}  // namespace ridgeway::cli
