#include "tools/studio/server/http_server.h"

#include <deque>
#include <map>
#include <stdexcept>
#include <utility>  // Boost 1.74 needs it in C++20

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>

namespace forage::studio {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;

constexpr std::size_t most_header = 16u << 10;   ///< bytes of a request
constexpr std::size_t most_message = 8u << 20;   ///< bytes of a message of a page
constexpr std::size_t most_waiting = 16u << 20;  ///< bytes that wait for a page
constexpr std::size_t most_pages = 64;
constexpr auto patience = std::chrono::seconds(30);

/// Compares in a time that does not depend on where the difference is.
bool same_secret(std::string_view a, std::string_view b) {
    unsigned difference = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned>(a[i] ^ (b.empty() ? '\0' : b[i % b.size()]));
    return difference == 0;
}

}  // namespace

struct HttpServer::Parts {
    class Page;
    class Connection;

    explicit Parts(Options given)
        : options(std::move(given)),
          acceptor(io, {asio::ip::address_v4::loopback(), options.port}),
          port(acceptor.local_endpoint().port()),
          cookie(fmt::format("forage_{}", port)) {}

    void accept();
    bool knows(const http::request<http::string_body>& request) const {
        const auto target = std::string_view(request.target().data(), request.target().size());
        const auto header = request[http::field::cookie];
        return same_secret(cookie_value({header.data(), header.size()}, cookie), options.token) ||
               same_secret(query_value(target, "token"), options.token);
    }

    Options options;
    asio::io_context io{1};
    tcp::acceptor acceptor;
    std::uint16_t port;
    std::string cookie;
    std::map<int, std::shared_ptr<Page>> pages;
    int next_page = 1;
};

/// The WebSocket of a page.
class HttpServer::Parts::Page : public std::enable_shared_from_this<Page> {
  public:
    Page(Parts& server, tcp::socket socket) : server_(server), socket_(std::move(socket)) {}

    void begin(const http::request<http::string_body>& request) {
        socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
        socket_.read_message_max(most_message);
        socket_.auto_fragment(false);
        socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
            if (error) return;
            self->number_ = self->server_.next_page++;
            self->server_.pages[self->number_] = self;
            self->server_.options.opened(self->number_);
            self->read();
        });
    }
    void send(bool binary, std::string data) {
        waiting_bytes_ += data.size();
        if (waiting_bytes_ > most_waiting) return end();
        waiting_.emplace_back(binary, std::move(data));
        if (waiting_.size() == 1) write();
    }
    void end() {
        if (server_.pages.erase(number_) > 0) server_.options.closed(number_);
        beast::error_code ignored;
        beast::get_lowest_layer(socket_).socket().close(ignored);
    }

  private:
    void read() {
        socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            if (error || !self->socket_.got_text()) return self->end();
            std::string text = beast::buffers_to_string(self->buffer_.data());
            self->buffer_.consume(self->buffer_.size());
            self->server_.options.received(self->number_, std::move(text));
            self->read();
        });
    }
    void write() {
        socket_.binary(waiting_.front().first);
        socket_.async_write(asio::buffer(waiting_.front().second),
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                                if (error) return self->end();
                                self->waiting_bytes_ -= self->waiting_.front().second.size();
                                self->waiting_.pop_front();
                                if (!self->waiting_.empty()) self->write();
                            });
    }

    Parts& server_;
    websocket::stream<beast::tcp_stream> socket_;
    beast::flat_buffer buffer_;
    std::deque<std::pair<bool, std::string>> waiting_;
    std::size_t waiting_bytes_ = 0;
    int number_ = 0;
};

/// A connection that asks for files, until it becomes a page.
class HttpServer::Parts::Connection : public std::enable_shared_from_this<Connection> {
  public:
    Connection(Parts& server, tcp::socket socket) : server_(server), stream_(std::move(socket)) {}

    void read() {
        parser_.emplace();
        parser_->header_limit(most_header);
        parser_->body_limit(0);
        stream_.expires_after(patience);
        http::async_read(
            stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
                if (error == http::error::header_limit || error == http::error::body_limit)
                    return self->answer({"text/plain", "The request is too large.\n", false, 413});
                if (error) return;
                self->request_ = self->parser_->release();
                self->handle();
            });
    }

  private:
    void handle() {
        const auto view = [&](auto field) {
            const auto value = request_[field];
            return std::string_view(value.data(), value.size());
        };
        const std::string_view target(request_.target().data(), request_.target().size());
        const std::string path(target.substr(0, target.find('?')));
        if (request_.count(http::field::host) != 1 ||
            !is_from_here(view(http::field::host), view(http::field::origin), server_.port))
            return refuse(403, "This address is for pages of this machine.");
        if (request_.method() != http::verb::get) return refuse(405, "Only GET is served.");
        if (!server_.knows(request_)) return refuse(403, "Open the address that 'forage studio' printed.");
        if (path == "/ws") {
            if (!websocket::is_upgrade(request_)) return refuse(400, "This is a WebSocket.");
            if (server_.pages.size() >= most_pages) return refuse(503, "Too many pages are open.");
            stream_.expires_never();
            return std::make_shared<Page>(server_, stream_.release_socket())->begin(request_);
        }
        if (path == "/" && !query_value(target, "token").empty()) return welcome();
        if (path == "/picture") {
            const std::string format = query_value(target, "format");
            return server_.options.picture(query_value(target, "what"), format.empty() ? "png" : format,
                                           [self = shared_from_this()](Content content) {
                                               asio::post(self->server_.io,
                                                          [self, content = std::move(content)]() mutable {
                                                              self->answer(std::move(content));
                                                          });
                                           });
        }
        auto file = server_.options.file(path);
        if (!file) return refuse(404, "There is no such file.");
        answer(std::move(*file));
    }
    void refuse(int status, const char* why) {
        answer({"text/plain; charset=utf-8", std::string(why) + "\n", false, status});
    }
    /// Sets the cookie, so that the token does not stay in the address.
    void welcome() {
        http::response<http::string_body> out{http::status::see_other, request_.version()};
        out.set(http::field::location, "/");
        out.set(http::field::set_cookie, fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/",
                                                     server_.cookie, server_.options.token));
        write(std::move(out));
    }
    void answer(Content content) {
        http::response<http::string_body> out{static_cast<http::status>(content.status), request_.version()};
        out.set(http::field::content_type, content.type);
        if (content.gzip) out.set(http::field::content_encoding, "gzip");
        out.body() = std::move(content.body);
        write(std::move(out));
    }
    void write(http::response<http::string_body> out) {
        out.set(http::field::cache_control, "no-store");
        out.set("Content-Security-Policy",
                "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
                "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
        out.set("X-Content-Type-Options", "nosniff");
        out.set("Referrer-Policy", "no-referrer");
        out.set("Cross-Origin-Resource-Policy", "same-origin");
        out.keep_alive(out.result_int() < 400 && request_.keep_alive());
        out.prepare_payload();
        response_ = std::move(out);
        stream_.expires_after(patience);
        http::async_write(stream_, response_,
                          [self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (!error && self->response_.keep_alive()) return self->read();
                              beast::error_code ignored;
                              self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                          });
    }

    Parts& server_;
    beast::tcp_stream stream_;
    beast::flat_buffer buffer_{most_header};
    std::optional<http::request_parser<http::string_body>> parser_;
    http::request<http::string_body> request_;
    http::response<http::string_body> response_;
};

void HttpServer::Parts::accept() {
    acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
        if (error == asio::error::operation_aborted) return;
        if (!error) {
            beast::error_code ignored;
            socket.set_option(tcp::no_delay(true), ignored);
            std::make_shared<Connection>(*this, std::move(socket))->read();
        }
        accept();
    });
}

HttpServer::HttpServer(Options options) try : parts_(std::make_unique<Parts>(std::move(options))) {
    parts_->accept();
} catch (const boost::system::system_error& e) {
    throw std::runtime_error(fmt::format("cannot listen on 127.0.0.1: {}", e.what()));
}
HttpServer::~HttpServer() = default;

std::uint16_t HttpServer::port() const { return parts_->port; }
void HttpServer::run() { parts_->io.run(); }
void HttpServer::stop() { parts_->io.stop(); }

void HttpServer::send(int client, bool binary, std::string data) {
    asio::post(parts_->io, [parts = parts_.get(), client, binary, data = std::move(data)]() mutable {
        if (const auto it = parts->pages.find(client); it != parts->pages.end()) {
            const auto page = it->second;  // a page that ends leaves the map
            page->send(binary, std::move(data));
        }
    });
}

}  // namespace forage::studio
