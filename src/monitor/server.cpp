// SPDX-License-Identifier: BSD-3-Clause
#include "src/monitor/server.hpp"

#include <fmt/format.h>

// clang-format off: Boost 1.74 needs <optional> and <utility> and does not include them
#include <optional>
#include <utility>

#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
// clang-format on
#include <list>
#include <random>

#include "src/core/base/error.hpp"

namespace whipple::monitor {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using tcp = asio::ip::tcp;
using Clock = std::chrono::steady_clock;

namespace {

constexpr std::size_t most_connections = 64, most_head = 16 * 1024;
constexpr std::chrono::seconds silence(30), first_request(5), look(1);

using HttpRequest = http::request<http::string_body>;
using HttpResponse = http::response<http::string_body>;

std::string text(beast::string_view view) { return {view.data(), view.size()}; }

}  // namespace

std::string random_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", random());
  return token;
}

struct Server::Connections {
  class Session;
  /// Holds the open connections in order of their last authenticated request, oldest first: those without any
  /// authenticated request, and the others. At the limit the first connection is closed, so that idle connections
  /// cannot block others. Declared before `io`, whose destructor ends the waiting sessions, each of which removes
  /// itself from its list.
  std::list<Session*> strangers, known;
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer timer{io};
  asio::signal_set signals{io};
  Clock::time_point last_request = Clock::now();
  Site* site = nullptr;

  void accept();
  void make_room();
  void wait(std::chrono::seconds patience, const std::function<bool()>& may_end);
};

/// Handles one connection: reads requests and writes their responses in turn.
class Server::Connections::Session : public std::enable_shared_from_this<Session> {
 public:
  Session(Server::Connections& all, tcp::socket socket)
      : all_(all), stream_(std::move(socket)), list_(&all.strangers) {
    place_ = list_->insert(list_->end(), this);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() { leave(); }

  /// Closes the connection, aborting pending operations.
  void close() {
    leave();
    stream_.close();
  }

  void read() {
    parser_.emplace();
    parser_->body_limit(all_.site->most_body());
    parser_->header_limit(most_head);
    stream_.expires_after(list_ == &all_.known ? silence : first_request);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (error == http::error::body_limit)
                         return self->write({413, "text/plain", "too long\n"}, false);
                       if (error == http::error::header_limit)
                         return self->write({431, "text/plain", "too long\n"}, false);
                       if (!error) self->respond(self->parser_->release());
                     });
  }

 private:
  void respond(const HttpRequest& received) {
    all_.last_request = Clock::now();
    const bool changes = received.method() == http::verb::post;
    if (!changes && received.method() != http::verb::get)
      return write({405, "text/plain", "GET or POST\n"}, false);
    const Request request{.changes = changes,
                          .target = text(received.target()),
                          .host = text(received[http::field::host]),
                          .origin = text(received[http::field::origin]),
                          .site = text(received["Sec-Fetch-Site"]),
                          .token = text(received["X-Whipple-Token"]),
                          .content_type = text(received[http::field::content_type]),
                          .body = received.body()};
    Response made;
    try {
      made = all_.site->handle(request);
    } catch (const std::exception& error) {  // for example an unreadable file: the server continues
      made = {500, "text/plain; charset=utf-8", std::string(error.what()) + "\n"};
    }
    if (all_.site->has_key(request)) move_to(all_.known);
    write(made, received.keep_alive());
  }

  void leave() {
    if (list_ != nullptr) list_->erase(place_);
    list_ = nullptr;
  }
  void move_to(std::list<Session*>& list) {
    if (list_ == nullptr) return;  // it is being closed
    list.splice(list.end(), *list_, place_);
    list_ = &list;
  }

  void write(const Response& made, bool keep) {
    auto response = std::make_shared<HttpResponse>(static_cast<http::status>(made.status), 11);
    response->set(http::field::content_type, made.type);
    response->set(http::field::cache_control, "no-store");
    response->set("X-Content-Type-Options", "nosniff");
    response->set("Cross-Origin-Resource-Policy", "same-origin");
    response->set("Referrer-Policy", "no-referrer");
    response->set("Content-Security-Policy",
                  "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
                  "img-src 'self' data: blob:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
    response->keep_alive(keep);
    response->body() = made.body;
    response->prepare_payload();
    stream_.expires_after(silence);
    http::async_write(stream_, *response,
                      [self = shared_from_this(), response, keep](beast::error_code error, std::size_t) {
                        if (!error && keep) return self->read();
                        beast::error_code closed;
                        self->stream_.socket().shutdown(tcp::socket::shutdown_send, closed);
                      });
  }

  Server::Connections& all_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::list<Session*>* list_;  // list that contains this session; null: none
  std::list<Session*>::iterator place_;
};

void Server::Connections::make_room() {
  if (strangers.size() + known.size() < most_connections) return;
  (strangers.empty() ? known : strangers).front()->close();
}

void Server::Connections::accept() {
  acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (!acceptor.is_open()) return;
    if (!error) {
      make_room();
      std::make_shared<Session>(*this, std::move(socket))->read();
    }
    accept();
  });
}

void Server::Connections::wait(std::chrono::seconds patience, const std::function<bool()>& may_end) {
  timer.expires_after(look);
  timer.async_wait([this, patience, &may_end](beast::error_code error) {
    if (error) return;
    if (patience.count() > 0 && Clock::now() - last_request > patience && may_end()) return io.stop();
    wait(patience, may_end);
  });
}

Server::Server(std::uint16_t port) : connections_(std::make_unique<Connections>()) {
  beast::error_code error;
  const tcp::endpoint here(asio::ip::address_v4::loopback(), port);
  tcp::acceptor& acceptor = connections_->acceptor;
  acceptor.open(here.protocol(), error);
  if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(here, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error)
    throw InputError(fmt::format("port {} of this machine cannot be used: {}", port, error.message()));
}

Server::~Server() = default;

std::string Server::host() const {
  return fmt::format("127.0.0.1:{}", connections_->acceptor.local_endpoint().port());
}

void Server::serve(Site& site, std::chrono::seconds patience, const std::function<bool()>& may_end) {
  connections_->site = &site;
  for (const int signal : {SIGINT, SIGTERM}) connections_->signals.add(signal);
  connections_->signals.async_wait([this](beast::error_code error, int) {
    if (!error) connections_->io.stop();
  });
  connections_->accept();
  connections_->wait(patience, may_end);
  connections_->io.run();
}

}  // namespace whipple::monitor
