// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "view/server.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "ridgeway/common/error.hpp"
#include "view/bounded_stream.hpp"
#include "view/page.hpp"

namespace ridgeway::cli {
namespace {

constexpr const char* kAddress = "127.0.0.1";
constexpr std::size_t kMostConnections = 64;

/// Each connection brings one request.
class BoundedServer : public httplib::Server {
 public:
  explicit BoundedServer(const std::function<bool()>& is_over) : is_over_(is_over) {}

 private:
  bool process_and_close_socket(socket_t socket) override {
    BoundedStream stream(socket, is_over_);
    bool closed = false;
    const bool done = process_request(stream, true, closed, nullptr);
    stream.finish();
    ::close(socket);
    return done;
  }

  const std::function<bool()>& is_over_;
};

/// Not from another page, nor from a page elsewhere whose name leads here.
bool is_from_here(const httplib::Request& request, int port) {
  const std::string at = ":" + std::to_string(port);
  const auto is_here = [&](const std::string& text) {
    return text == kAddress + at || text == "localhost" + at;
  };
  if (request.get_header_value_count("Host") != 1 || !is_here(request.get_header_value("Host")))
    return false;
  const std::string site = request.get_header_value("Sec-Fetch-Site");
  if (!site.empty() && site != "same-origin" && site != "none") return false;
  if (!request.has_header("Origin")) return true;
  const std::string origin = request.get_header_value("Origin"), scheme = "http://";
  return origin.starts_with(scheme) && is_here(origin.substr(scheme.size()));
}

void set_headers(httplib::Response& response) {
  response.set_header("Content-Security-Policy",
                      "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
                      "connect-src 'self'; img-src 'self' data: blob:; base-uri 'none'; "
                      "form-action 'none'; frame-ancestors 'none'");
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cache-Control", "no-store");
}

/// A body that is shared, not copied.
void set_body(httplib::Response& response, const Reply& reply) {
  response.status = reply.status;
  if (reply.body->empty()) return response.set_content("", reply.type.c_str());
  response.set_content_provider(
      reply.body->size(), reply.type.c_str(),
      [body = reply.body](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        return sink.write(body->data() + offset, length);
      });
}

void respond(MapAnswers& answers, int port, const httplib::Request& request,
             httplib::Response& response) {
  set_headers(response);
  if (!is_from_here(request, port))
    return set_body(response,
                    json_reply(403, {{"error", "this server answers its own page alone"}}));
  if (request.method != "GET" && request.method != "HEAD")
    return set_body(response, json_reply(405, {{"error", "only GET and HEAD are answered"}}));
  if (const auto file = find_page_file(request.path))
    return response.set_content(file->body.data(), file->body.size(),
                                std::string(file->type).c_str());
  const Question question{request.path, {request.params.begin(), request.params.end()}};
  set_body(response, answers.answer(question));
}

}  // namespace

void serve(MapAnswers& answers, int port, const std::function<void(int port)>& on_ready,
           const std::function<bool()>& is_over) {
  using namespace std::chrono_literals;
  std::atomic<bool> has_ended = false;
  const std::function<bool()> is_ending = [&] { return is_over() || has_ended; };
  BoundedServer server(is_ending);
  server.new_task_queue = [] { return new httplib::ThreadPool(kMostConnections); };
  server.set_payload_max_length(1024);
  // Two servers at one port would share its connections.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const int bound = port == 0 ? server.bind_to_any_port(kAddress)
                              : (server.bind_to_port(kAddress, port) ? port : -1);
  if (bound <= 0)
    throw InputError("--port " + std::to_string(port), "cannot be had: another program may use it",
                     "give another one, or leave it out");
  server.set_pre_routing_handler([&](const httplib::Request& request, httplib::Response& response) {
    respond(answers, bound, request, response);
    return httplib::Server::HandlerResponse::Handled;
  });
  std::thread listener([&] {
    server.listen_after_bind();
    has_ended = true;
  });
  on_ready(bound);
  while (!is_ending()) std::this_thread::sleep_for(50ms);
  server.stop();
  listener.join();
}

}  // namespace ridgeway::cli
