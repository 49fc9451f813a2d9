// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
#include "view/server.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <exception>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "ridgeway/common/error.hpp"
#include "view/bounded_stream.hpp"
#include "view/live_stream.hpp"
#include "view/page.hpp"

namespace ridgeway::cli {
namespace {

constexpr const char* kAddress = "127.0.0.1";
constexpr const char* kLivePath = "/api/live";
constexpr std::size_t kMostConnections = 64;
/// That are not yet taken on. httplib keeps five: a page's own would have to try again, a second
/// and more later.
constexpr int kMostWaiting = 256;
/// So that enough is left for what pages ask.
constexpr int kMostFollowers = 8;

/// Each connection brings one request.
class BoundedServer : public httplib::Server {
 public:
  explicit BoundedServer(const std::function<bool()>& is_over) : is_over_(is_over) {}

  /// Once it is bound.
  void let_many_wait() { ::listen(svr_sock_, kMostWaiting); }

 private:
  bool process_and_close_socket(socket_t socket) override {
    BoundedStream stream(socket, is_over_);
    bool closed = false;
    const bool done = process_request(stream, true, closed, [&stream](httplib::Request& request) {
      // Answers are sent whole: httplib would pass on ranges that go beyond their end.
      request.ranges.clear();
      if (request.path == kLivePath) stream.begin_endless_answer();
    });
    stream.finish();
    ::close(socket);
    return done;
  }

  const std::function<bool()>& is_over_;
};

/// A link elsewhere that a person follows: nothing of the map is in the page itself, and no other
/// page holds it (frame-ancestors, Cross-Origin-Opener-Policy).
bool opens_page(const httplib::Request& request) {
  return request.path == "/" && request.get_header_value("Sec-Fetch-Mode") == "navigate" &&
         request.get_header_value("Sec-Fetch-Dest") == "document";
}

/// Not from another page, nor from a page elsewhere whose name leads here.
bool is_from_here(const httplib::Request& request, int port) {
  const std::string at = ":" + std::to_string(port);
  const auto is_here = [&](const std::string& text) {
    constexpr int kUsualPort = 80;  // which clients leave out
    const std::string with_port =
        port == kUsualPort && text.find(':') == std::string::npos ? text + at : text;
    return with_port == kAddress + at || with_port == "localhost" + at;
  };
  if (request.get_header_value_count("Host") != 1 || !is_here(request.get_header_value("Host")))
    return false;
  for (const char* header : {"Sec-Fetch-Site", "Origin"})
    if (request.get_header_value_count(header) > 1) return false;
  const std::string site = request.get_header_value("Sec-Fetch-Site");
  if (!site.empty() && site != "same-origin" && site != "none" && !opens_page(request))
    return false;
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
  response.set_header("Cross-Origin-Opener-Policy", "same-origin");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cache-Control", "no-store");
  response.set_header("Accept-Ranges", "none");
}

/// A body that is neither copied nor packed: httplib would pack the page's script for seconds, to
/// save a moment between two programs of one machine. `owner` keeps the bytes.
void set_bytes(httplib::Response& response, const std::string& type, std::string_view bytes,
               std::shared_ptr<const void> owner = nullptr) {
  if (bytes.empty()) return response.set_content("", type);
  response.set_content_provider(
      bytes.size(), type,
      [bytes, owner = std::move(owner)](std::size_t offset, std::size_t length,
                                        httplib::DataSink& sink) {
        const std::string_view part = bytes.substr(std::min(offset, bytes.size()), length);
        return sink.write(part.data(), part.size());
      });
}

void set_body(httplib::Response& response, const Reply& reply) {
  response.status = reply.status;
  set_bytes(response, reply.type, *reply.body, reply.body);
}

/// One of those who follow, counted for as long as it is there.
class Follower {
 public:
  Follower(LiveView& view, std::atomic<int>& count) : stream_(view), count_(count) { ++count_; }
  ~Follower() { --count_; }
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;

  LiveStream& stream() { return stream_; }

 private:
  LiveStream stream_;
  std::atomic<int>& count_;
};

/// Sends what happens for as long as it is taken.
void follow(LiveView* view, std::atomic<int>& followers, httplib::Response& response) {
  if (!view)
    return set_body(response, json_reply(404, {{"error",
                                                "this map does not change: follow `ridgeway live "
                                                "--view` or `ridgeway explore --view`"}}));
  const auto follower = std::make_shared<Follower>(*view, followers);
  if (followers > kMostFollowers)
    return set_body(response, json_reply(503, {{"error",
                                                "as many pages as can follow a map already do: "
                                                "close one"}}));
  response.set_chunked_content_provider(
      "text/event-stream", [follower](std::size_t, httplib::DataSink& sink) {
        try {
          const std::string event = follower->stream().next();
          return event.empty() || sink.write(event.data(), event.size());
        } catch (const std::exception&) {  // no memory: the page asks again, and begins anew
          return false;
        }
      });
}

}  // namespace

struct PageServer::Running {
  Running(Served given, std::function<bool()> is_over)
      : served(std::move(given)),
        is_ending([this, is_over = std::move(is_over)] { return has_ended || is_over(); }),
        server(std::make_unique<BoundedServer>(is_ending)) {}

  void respond(const httplib::Request& request, httplib::Response& response) {
    set_headers(response);
    response.set_header("Ridgeway-Map", served.map);
    if (!is_from_here(request, port))
      return set_body(response,
                      json_reply(403, {{"error", "this server answers its own page alone"}}));
    if (request.method != "GET" && request.method != "HEAD") {
      response.set_header("Allow", "GET, HEAD");
      return set_body(response, json_reply(405, {{"error", "only GET and HEAD are answered"}}));
    }
    if (const auto file = find_page_file(request.path))
      return set_bytes(response, std::string(file->type), file->body);
    if (request.path == kLivePath) return follow(served.live, followers, response);
    const Question question{request.path, {request.params.begin(), request.params.end()}};
    set_body(response, served.answer(question));
  }

  const Served served;
  std::atomic<bool> has_ended = false;
  std::atomic<int> followers = 0;
  const std::function<bool()> is_ending;
  const std::unique_ptr<httplib::Server> server;
  int port = 0;
  std::thread listener;
};

PageServer::PageServer(Served served, int port, std::function<bool()> is_over)
    : running_(std::make_unique<Running>(std::move(served), std::move(is_over))) {
  auto& server = static_cast<BoundedServer&>(*running_->server);
  server.new_task_queue = [] { return new httplib::ThreadPool(kMostConnections); };
  server.set_payload_max_length(1024);
  // Two servers at one port would share its connections.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  running_->port = port == 0 ? server.bind_to_any_port(kAddress)
                             : (server.bind_to_port(kAddress, port) ? port : -1);
  if (running_->port <= 0) {
    const bool is_refused = errno == EACCES;
    throw InputError("--port " + std::to_string(port),
                     is_refused ? "is for privileged programs alone"
                                : "cannot be had: another program may use it",
                     "give another one, or leave it out");
  }
  server.let_many_wait();
  server.set_pre_routing_handler(
      [running = running_.get()](const httplib::Request& request, httplib::Response& response) {
        running->respond(request, response);
        return httplib::Server::HandlerResponse::Handled;
      });
  running_->listener = std::thread([running = running_.get()] {
    running->server->listen_after_bind();
    running->has_ended = true;
  });
}

PageServer::~PageServer() {
  running_->has_ended = true;
  running_->server->stop();
  running_->listener.join();
}

int PageServer::port() const { return running_->port; }

void PageServer::wait() const {
  using namespace std::chrono_literals;
  while (!running_->is_ending()) std::this_thread::sleep_for(50ms);
}

void require_page(const std::string& who) {
  if (!has_page())
    throw InputError(who, "has no page: this program was built without one", kNoPage);
}

}  // namespace ridgeway::cli
